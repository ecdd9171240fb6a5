/* SPDX-License-Identifier: MIT OR Apache-2.0
 * Sizes that cannot be had are a status, never an abort: counts whose bytes overflow, a lattice of 2^40 points, an STL
 * that claims 2^31 triangles, and address space that runs out at any point of reading and building. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#include "check.h"

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

static int32_t stop_at_once(void *user, double fraction) {
  (void)fraction;
  ++*(int *)user;
  return 1;
}

/* 2^40 points: nothing as large as the lattice is allocated, and the call can be cancelled. */
static void a_huge_lattice_is_answered(const emb_geom *g) {
  const size_t nx = (size_t)1 << 14, ny = (size_t)1 << 13, nz = (size_t)1 << 13, size = (size_t)1 << 40;
  double *axis = (double *)need(malloc(nx * sizeof *axis));
  emb_lattice lattice = {sizeof lattice, {0, 0, 0}, NULL, NULL, NULL};
  emb_array out = {sizeof out, NULL, EMB_I8, {0, 0, 0}};
  int calls = 0;
  emb_run run = {sizeof run, NULL, stop_at_once, NULL};
  void *memory = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  size_t i;
  run.user = &calls;
  for (i = 0; i < nx; i++) {
    axis[i] = (double)i;
  }
  lattice.x = lattice.y = lattice.z = axis;
  lattice.n[0] = nx, lattice.n[1] = ny, lattice.n[2] = nz;
  if (memory == MAP_FAILED) {
    printf("memory: no address space for 2^40 bytes here; the fill of them is left out\n");
  } else {
    out.data = memory;
    CHECK_STATUS(emb_geom_fill(g, &lattice, EMB_FILL_SIGN, 0.0, &run, &out), EMB_ERROR_CANCELLED);
    CHECK(calls == 1);
    munmap(memory, size);
  }
  /* what cannot be addressed is refused */
  out.data = axis, out.type = EMB_F64;
  out.stride[0] = 1, out.stride[1] = (ptrdiff_t)1 << 40, out.stride[2] = (ptrdiff_t)1 << 53;
  CHECK_STATUS(emb_geom_fill(g, &lattice, EMB_FILL_EXACT, 0.0, &run, &out), EMB_ERROR_INVALID_ARGUMENT);
  free(axis);
}

/* 2^58 vertices exist in no memory, and are asked for before they are looked at. */
static void huge_counts_are_refused(void) {
  static const float xyz[9] = {0};
  static const uint32_t indices[3] = {0, 1, 2};
  emb_mesh *mesh = NULL;
  CHECK_STATUS(emb_mesh_from_triangles_f32((size_t)1 << 57, xyz, 1, indices, NULL, NULL, &mesh), EMB_ERROR_MEMORY);
  CHECK(strstr(emb_last_error(), "432345564227567616") != NULL); /* 3 * 2^57 */
  CHECK(mesh == NULL);
}

static void a_claim_is_not_believed(void) {
  unsigned char stl[184] = {0};
  emb_mesh *mesh = NULL;
  stl[83] = 0x80; /* 2^31 triangles, little endian; two are there */
  CHECK_STATUS(emb_mesh_read_memory(stl, sizeof stl, NULL, NULL, &mesh), EMB_ERROR_PARSE);
  stl[80] = stl[81] = stl[82] = stl[83] = 0xFF;
  CHECK_STATUS(emb_mesh_read_memory(stl, sizeof stl, NULL, NULL, &mesh), EMB_ERROR_PARSE);
  CHECK(mesh == NULL);
}

/* How much address space this process uses, in bytes. */
static size_t used(void) {
  FILE *file = fopen("/proc/self/statm", "r");
  unsigned long pages = 0;
  if (file != NULL) {
    if (fscanf(file, "%lu", &pages) != 1) {
      pages = 0;
    }
    fclose(file);
  }
  return (size_t)pages * (size_t)sysconf(_SC_PAGESIZE);
}

/* Builds and asks with `more` bytes of address space left; 0 where all went well, 1 where each failure was
 * EMB_ERROR_MEMORY, 2 otherwise. In a process of its own. */
static int with_little_memory(const soup *s, size_t more) {
  int status;
  pid_t child;
  fflush(stdout);
  child = fork();
  if (child == 0) {
    struct rlimit limit;
    emb_mesh *mesh = NULL;
    emb_geom *g = NULL;
    emb_status answer;
    limit.rlim_cur = limit.rlim_max = used() + more;
    if (setrlimit(RLIMIT_AS, &limit) != 0) {
      _exit(3);
    }
    answer = emb_mesh_from_triangles(s->vertices, s->xyz, s->triangles, s->indices, s->tags, NULL, &mesh);
    if (answer == EMB_OK) {
      answer = emb_geom_from_mesh(mesh, NULL, NULL, &g);
    }
    if (answer == EMB_OK && !(fabs(emb_geom_value(g, 0, 0, 0) + 1.0) < 0.01)) {
      _exit(4);
    }
    _exit(answer == EMB_OK ? 0 : answer == EMB_ERROR_MEMORY ? 1 : 2);
  }
  if (child < 0 || waitpid(child, &status, 0) != child) {
    return 5;
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 100 + WTERMSIG(status);
}

static void memory_that_runs_out_is_a_status(void) {
  soup s = soup_sphere(1.0, 300);
  size_t more;
  int refused = 0, answered = 0;
  /* from hardly anything to enough */
  for (more = (size_t)1 << 18; more < (size_t)1 << 29; more += more / 8) {
    int outcome = with_little_memory(&s, more);
    if (!check_that(outcome == 0 || outcome == 1, "EMB_OK or EMB_ERROR_MEMORY", __FILE__, __LINE__)) {
      printf("    with %lu bytes left: %s %d\n", (unsigned long)more, outcome > 100 ? "signal" : "outcome",
             outcome > 100 ? outcome - 100 : outcome);
    }
    refused += outcome == 1;
    answered += outcome == 0;
    if (answered > 2) {
      break;
    }
  }
  CHECK(refused > 5 && answered > 0);
  soup_free(&s);
}

/* valgrind needs address space of its own. */
static int under_valgrind(void) {
  const char *preload = getenv("LD_PRELOAD");
  return preload != NULL && strstr(preload, "vgpreload") != NULL;
}

int main(void) {
  const double origin[3] = {0, 0, 0};
  emb_geom *g;
  CHECK_OK(emb_geom_sphere(origin, 1.0, &g));
  a_huge_lattice_is_answered(g);
  emb_geom_free(g);
  huge_counts_are_refused();
  a_claim_is_not_believed();
  if (used() == 0 || under_valgrind()) {
    printf("memory: address space cannot be limited here; running out of it is left out\n");
  } else {
    memory_that_runs_out_is_a_status();
  }
  return checks_done("memory");
}
