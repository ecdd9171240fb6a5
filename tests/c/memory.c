/* SPDX-License-Identifier: MIT OR Apache-2.0
 * Sizes that cannot be had are a status, never an abort: counts whose bytes overflow, a lattice of 2^40 points, an STL
 * that claims 2^31 triangles, and address space that runs out at any point of building, asking, joining, splitting. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#include "check.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif
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

/* What the calls below are given, made before memory runs short. */
static soup ball;
static emb_mesh *one, *two;
static double *numbers;
static int32_t *tags;
static emb_mesh *wide; /* one face with `WIDE` numbers */
enum { WIDE = 1 << 21 };

/* Not a status: what was answered is wrong. */
#define WRONG 1

static emb_status build_and_ask(void) {
  emb_mesh *mesh = NULL;
  emb_geom *g = NULL;
  emb_status answer = emb_mesh_from_triangles(ball.vertices, ball.xyz, ball.triangles, ball.indices, ball.tags, NULL,
                                              &mesh);
  if (answer == EMB_OK) {
    answer = emb_geom_from_mesh(mesh, NULL, NULL, &g);
  }
  return answer == EMB_OK && !(fabs(emb_geom_value(g, 0, 0, 0) + 1.0) < 0.01) ? WRONG : answer;
}

/* The answer, where a mesh was made exactly if it is EMB_OK, with so many faces. */
static emb_status made(emb_status answer, const emb_mesh *mesh, size_t faces) {
  return emb_mesh_face_count(mesh) != (answer == EMB_OK ? faces : 0) ? WRONG : answer;
}

static emb_status join(void) {
  const emb_mesh *const meshes[2] = {one, one};
  emb_mesh *mesh = NULL;
  emb_status answer = emb_mesh_join(2, meshes, EMB_JOIN_RENUMBER, NULL, &mesh);
  return made(answer, mesh, 2 * ball.triangles);
}

static emb_status transform(void) {
  emb_mesh *mesh = NULL;
  emb_status answer = emb_mesh_transform(two, NULL, &mesh);
  return made(answer, mesh, 2 * ball.triangles);
}

static emb_status split_components(void) {
  emb_mesh *parts[2] = {NULL, NULL};
  size_t count = 0;
  emb_status answer = emb_mesh_split(two, EMB_SPLIT_COMPONENT, 2, parts, &count);
  return count != (answer == EMB_OK ? 2u : 0u) ? WRONG : made(answer, parts[1], ball.triangles);
}

static emb_status split_tags(void) {
  emb_mesh *parts[7] = {NULL, NULL, NULL, NULL, NULL, NULL, NULL};
  size_t count = 0;
  emb_status answer = emb_mesh_split(two, EMB_SPLIT_TAG, 7, parts, &count);
  return count != (answer == EMB_OK ? 7u : 0u) || (answer == EMB_OK) != (parts[6] != NULL) ? WRONG : answer;
}

static emb_status with_field(void) {
  emb_mesh *mesh = NULL;
  emb_status answer = emb_mesh_with_field(two, EMB_ON_VERTICES, "more", 2, numbers, &mesh);
  return made(answer, mesh, 2 * ball.triangles);
}

static emb_status with_tags(void) {
  emb_mesh *mesh = NULL;
  emb_status answer = emb_mesh_with_tags(two, tags, 0, NULL, NULL, &mesh);
  return made(answer, mesh, 2 * ball.triangles);
}

static emb_status interpolate(void) {
  static const int64_t face = 0;
  emb_status answer;
  numbers[0] = numbers[WIDE - 1] = -1.0;
  answer = emb_mesh_interpolate(wide, EMB_ON_FACES, 0, 1, &face, NULL, NULL, 1, NULL, numbers);
  return numbers[WIDE - 1] != (answer == EMB_OK ? 7.0 : -1.0) ? WRONG : answer;
}

/* Works with `more` bytes of address space left; 0 where all went well, 1 where it was EMB_ERROR_MEMORY, 2 otherwise.
 * In a process of its own. */
static int with_little_memory(emb_status (*work)(void), size_t more) {
  int status;
  pid_t child;
  fflush(stdout);
  child = fork();
  if (child == 0) {
    struct rlimit limit;
    emb_status answer;
    limit.rlim_cur = limit.rlim_max = used() + more;
    if (setrlimit(RLIMIT_AS, &limit) != 0) {
      _exit(3);
    }
    answer = work();
    _exit(answer == EMB_OK ? 0 : answer == EMB_ERROR_MEMORY ? 1 : 2);
  }
  if (child < 0 || waitpid(child, &status, 0) != child) {
    return 5;
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 100 + WTERMSIG(status);
}

/* From hardly anything to enough. */
static void memory_runs_out(emb_status (*work)(void), size_t from, const char *name) {
  size_t more;
  int refused = 0, answered = 0;
  for (more = from; more < (size_t)1 << 29 && answered < 3; more += more / 8) {
    int outcome = with_little_memory(work, more);
    if (!check_that(outcome == 0 || outcome == 1, name, __FILE__, __LINE__)) {
      printf("    with %lu bytes left: %s %d\n", (unsigned long)more, outcome > 100 ? "signal" : "outcome",
             outcome > 100 ? outcome - 100 : outcome);
    }
    refused += outcome == 1;
    answered += outcome == 0;
  }
  check_that(refused > 5 && answered > 0, name, __FILE__, __LINE__);
}

/* Frees blocks that do not touch, of which small allocations (a name, a handle) can be had to the last: only what grows
 * with the mesh is to fail. */
static void leave_small_blocks(void) {
  enum { BLOCKS = 128 };
  static void *blocks[BLOCKS];
  int i;
  for (i = 0; i < BLOCKS; i++) {
    blocks[i] = need(malloc(i % 2 == 0 ? 2048 : 32));
  }
  for (i = 0; i < BLOCKS; i += 2) {
    free(blocks[i]);
  }
}

static void memory_that_runs_out_is_a_status(void) {
  static const double corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  static const uint32_t triangle[3] = {0, 1, 2};
  emb_mesh_options aside;
  emb_mesh *plain = NULL, *moved = NULL;
  const emb_mesh *both[2];
  size_t i;
  CHECK_OK(emb_mesh_options_init(&aside, sizeof aside));
  aside.shift[0] = 5.0;
  ball = soup_sphere(1.0, 300);
  memory_runs_out(build_and_ask, 1 << 18, "building and asking");
  soup_free(&ball);
  leave_small_blocks();
  ball = soup_sphere(1.0, 120);
  tags = (int32_t *)need(calloc(2 * ball.triangles, sizeof *tags));
  numbers = (double *)need(malloc(WIDE * sizeof *numbers));
  for (i = 0; i < WIDE; i++) {
    numbers[i] = 7.0;
  }
  plain = soup_mesh(&ball);
  CHECK_OK(emb_mesh_with_field(plain, EMB_ON_VERTICES, "data", 1, numbers, &one));
  CHECK_OK(emb_mesh_transform(one, &aside, &moved));
  both[0] = one, both[1] = moved;
  CHECK_OK(emb_mesh_join(2, both, EMB_JOIN_KEEP, NULL, &two));
  emb_mesh_free(plain);
  CHECK_OK(emb_mesh_from_triangles(3, corners, 1, triangle, NULL, NULL, &plain));
  CHECK_OK(emb_mesh_with_field(plain, EMB_ON_FACES, "wide", WIDE, numbers, &wide));
  memory_runs_out(join, 1 << 16, "emb_mesh_join");
  memory_runs_out(transform, 1 << 16, "emb_mesh_transform");
  memory_runs_out(split_components, 1 << 16, "emb_mesh_split by component");
  memory_runs_out(split_tags, 1 << 16, "emb_mesh_split by tag");
  memory_runs_out(with_field, 1 << 16, "emb_mesh_with_field");
  memory_runs_out(with_tags, 1 << 16, "emb_mesh_with_tags");
  memory_runs_out(interpolate, 1 << 16, "emb_mesh_interpolate");
  emb_mesh_free(plain);
  emb_mesh_free(moved);
  emb_mesh_free(one);
  emb_mesh_free(two);
  emb_mesh_free(wide);
  free(numbers);
  free(tags);
  soup_free(&ball);
}

/* valgrind needs address space of its own. */
static int under_valgrind(void) {
  const char *preload = getenv("LD_PRELOAD");
  return preload != NULL && strstr(preload, "vgpreload") != NULL;
}

int main(void) {
  const double origin[3] = {0, 0, 0};
  emb_geom *g;
#ifdef __GLIBC__
  /* What is large goes back to the system at once, so that no reserve of the heap hides that memory is short. */
  mallopt(M_MMAP_THRESHOLD, 1 << 14);
#endif
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
