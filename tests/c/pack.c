/* SPDX-License-Identifier: MIT OR Apache-2.0
 * Geometries as blocks: the same bytes for every instruction set, the same answers from a copy, a borrowed block and a file;
 * drop is run once; damage and misuse are a status and write nothing. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#include "check.h"
#include "files.h"

#include <sys/mman.h>
#include <sys/wait.h>

enum { COUNT = 400 };

static int drops;

static void drop(void *user) {
  CHECK(user == &drops);
  drops++;
}

static double callback(void *user, double x, double y, double z) {
  (void)user;
  return x + y + z;
}

static int32_t stop(void *user, double fraction) {
  (void)user, (void)fraction;
  return 1;
}

/* A bumpy ball of 2 * n * n triangles, in a tree with what else there is. */
static emb_geom *body(int n) {
  const size_t vertices = (size_t)(n * n), triangles = 2 * (size_t)(n * n);
  double *xyz = (double *)need(malloc(3 * vertices * sizeof *xyz));
  uint32_t *indices = (uint32_t *)need(malloc(3 * triangles * sizeof *indices));
  double low[3] = {-2.0, -2.0, -0.1}, high[3] = {2.0, 2.0, 0.1}, shift[3] = {0.1, 0.2, 0.3};
  emb_mesh *mesh = NULL;
  emb_geom *torus = NULL, *slab = NULL, *moved = NULL, *all = NULL, *labelled = NULL;
  const emb_geom *parts[3];
  int i, j;
  for (i = 0; i < n; ++i) {
    for (j = 0; j < n; ++j) {
      double a = 6.283185307179586 * i / n, b = 6.283185307179586 * j / n, d = 1.0 + 0.3 * cos(b);
      double *p = xyz + 3 * (i * n + j);
      uint32_t c[4];
      p[0] = rint(4096 * d * cos(a)) / 4096, p[1] = rint(4096 * d * sin(a)) / 4096, p[2] = rint(4096 * 0.3 * sin(b)) / 4096;
      c[0] = (uint32_t)(i * n + j), c[1] = (uint32_t)((i + 1) % n * n + j);
      c[2] = (uint32_t)((i + 1) % n * n + (j + 1) % n), c[3] = (uint32_t)(i * n + (j + 1) % n);
      {
        uint32_t *t = indices + 6 * (i * n + j);
        t[0] = c[0], t[1] = c[1], t[2] = c[2], t[3] = c[0], t[4] = c[2], t[5] = c[3];
      }
    }
  }
  CHECK_OK(emb_mesh_from_triangles(vertices, xyz, triangles, indices, NULL, NULL, &mesh));
  CHECK_OK(emb_geom_from_mesh(mesh, NULL, NULL, &torus));
  CHECK_OK(emb_geom_box(low, high, &slab));
  CHECK_OK(emb_geom_translate(torus, shift, &moved));
  CHECK_OK(emb_geom_part(moved, 7, &labelled));
  parts[0] = torus, parts[1] = slab, parts[2] = labelled;
  CHECK_OK(emb_geom_union(3, parts, &all));
  emb_mesh_free(mesh);
  emb_geom_free(torus), emb_geom_free(slab), emb_geom_free(moved), emb_geom_free(labelled);
  free(xyz), free(indices);
  return all;
}

static uint64_t answers(const emb_geom *g) {
  uint64_t hash = HASH_START;
  double p[3 * COUNT], value[COUNT], point[3 * COUNT];
  int64_t primitive[COUNT];
  int32_t part[COUNT], side;
  emb_closest_out out;
  int k;
  for (k = 0; k < 3 * COUNT; ++k) {
    p[k] = ((k * 7919) % 1000) * 0.003 - 1.5;
  }
  memset(&out, 0, sizeof out);
  out.struct_size = sizeof out;
  out.value = value, out.primitive = primitive, out.part = part;
  out.point[0] = point, out.point[1] = point + 1, out.point[2] = point + 2, out.vector_stride = 3;
  CHECK_OK(emb_geom_closest(g, COUNT, p, p + 1, p + 2, 3, INFINITY, NULL, &out));
  hash = hash_bytes(hash, value, sizeof value), hash = hash_bytes(hash, point, sizeof point);
  hash = hash_bytes(hash, primitive, sizeof primitive), hash = hash_bytes(hash, part, sizeof part);
  CHECK_OK(emb_geom_values(g, COUNT, p, p + 1, p + 2, 3, NULL, value));
  hash = hash_bytes(hash, value, sizeof value);
  for (k = 0; k + 1 < COUNT; ++k) {
    double hi[3];
    hi[0] = p[3 * k] + 0.05, hi[1] = p[3 * k + 1] + 0.05, hi[2] = p[3 * k + 2] + 0.05;
    side = emb_geom_classify_box(g, p + 3 * k, hi);
    hash = hash_bytes(hash, &side, sizeof side);
  }
  return hash;
}

static void same(const emb_geom *g, const emb_geom *h) {
  emb_geom_properties p, q;
  p.struct_size = q.struct_size = sizeof p;
  CHECK(emb_geom_fingerprint(g) == emb_geom_fingerprint(h) && answers(g) == answers(h));
  CHECK_OK(emb_geom_properties_get(g, &p));
  CHECK_OK(emb_geom_properties_get(h, &q));
  CHECK(p.kind == q.kind && p.primitives == q.primitives && p.bytes == q.bytes && same_double(p.lipschitz, q.lipschitz));
}

/* As a block at a multiple of 64. */
static unsigned char *packed(const emb_geom *g, size_t *size) {
  unsigned char *block;
  size_t again = 0;
  CHECK_OK(emb_geom_pack(g, 0, NULL, size));
  block = (unsigned char *)need(aligned_alloc(64, *size + 64));
  memset(block, 0xA5, *size + 64);
  CHECK_OK(emb_geom_pack(g, *size, block, &again));
  CHECK(again == *size && block[*size] == 0xA5);
  return block;
}

static void blocks_give_the_geometry_back(const emb_geom *g) {
  size_t size = 0, other = 0;
  unsigned char *block = packed(g, &size), *again;
  emb_geom *copy = NULL, *lent = NULL, *moved = NULL;
  double shift[3] = {0.5, 0.0, 0.0};
  int32_t flags;
  printf("hash %016llx of %lu bytes\n", (unsigned long long)hash_bytes(HASH_START, block, size), (unsigned long)size);
  for (flags = 0; flags <= EMB_UNPACK_TRUST; flags += EMB_UNPACK_TRUST) {
    drops = 0;
    CHECK_OK(emb_geom_unpack(block, size, flags, drop, &drops, &copy));
    CHECK(drops == 1);
    CHECK_OK(emb_geom_unpack(block, size, flags | EMB_UNPACK_BORROW, drop, &drops, &lent));
    CHECK(drops == 1);
    same(g, copy), same(g, lent);
    again = packed(lent, &other);
    CHECK(other == size && memcmp(block, again, size) == 0);
    free(again);
    CHECK_OK(emb_geom_translate(lent, shift, &moved));
    emb_geom_free(copy), emb_geom_free(lent);
    CHECK(drops == 1 && isfinite(emb_geom_value(moved, 0.1, 0.2, 0.3)));
    emb_geom_free(moved);
    CHECK(drops == 2);
    copy = lent = moved = NULL;
    CHECK_OK(emb_geom_unpack(block, size, flags, NULL, NULL, &copy));
    emb_geom_free(copy), copy = NULL;
  }
  /* A ball has no arrays, and holds its block all the same. */
  {
    double center[3] = {0.1, 0.2, 0.3};
    emb_geom *ball = NULL;
    size_t small = 0;
    CHECK_OK(emb_geom_sphere(center, 0.5, &ball));
    again = packed(ball, &small);
    drops = 0;
    CHECK_OK(emb_geom_unpack(again, small, EMB_UNPACK_BORROW, drop, &drops, &lent));
    CHECK(drops == 0);
    same(ball, lent);
    emb_geom_free(lent), emb_geom_free(ball);
    CHECK(drops == 1);
    free(again);
  }
  free(block);
}

static void files_are_shared(const emb_geom *g) {
  file_path path;
  emb_geom *mapped = NULL;
  emb_pool *pool = NULL;
  emb_run run;
  uint64_t own = answers(g), *shared;
  pid_t children[2];
  int32_t flags;
  int k, state;
  memset(&run, 0, sizeof run);
  run.struct_size = sizeof run;
  CHECK_OK(emb_pool_new(2, &pool));
  run.pool = pool;
  temporary_path(path, "packed");
  CHECK_OK(emb_geom_save(g, path, &run));
  for (flags = 0; flags <= (EMB_UNPACK_BORROW | EMB_UNPACK_TRUST); ++flags) {
    CHECK_OK(emb_geom_open(path, flags, flags == 0 ? &run : NULL, &mapped));
    same(g, mapped);
    /* What is open stays as it is when the file is written anew, by itself even. */
    CHECK_OK(emb_geom_save(mapped, path, NULL));
    same(g, mapped);
    emb_geom_free(mapped), mapped = NULL;
  }
  shared = (uint64_t *)mmap(NULL, 4096, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  fflush(stdout);
  for (k = 0; k < 2; ++k) {
    children[k] = fork();
    if (children[k] == 0) {
      emb_geom *h = NULL;
      shared[k] = emb_geom_open(path, EMB_UNPACK_TRUST, NULL, &h) == EMB_OK ? answers(h) : 0;
      emb_geom_free(h);
      _exit(0);
    }
  }
  for (k = 0; k < 2; ++k) {
    CHECK(waitpid(children[k], &state, 0) == children[k] && WIFEXITED(state) && shared[k] == own);
  }
  munmap(shared, 4096);
  run.progress = stop;
  CHECK_STATUS(emb_geom_save(g, path, &run), EMB_ERROR_CANCELLED);
  CHECK_STATUS(emb_geom_open(path, 0, &run, &mapped), EMB_ERROR_CANCELLED);
  CHECK_STATUS(emb_geom_open(path, 4, NULL, &mapped), EMB_ERROR_INVALID_ARGUMENT);
  CHECK_STATUS(emb_geom_open(path, 0, NULL, NULL), EMB_ERROR_NULL_ARGUMENT);
  CHECK_STATUS(emb_geom_open(NULL, 0, NULL, &mapped), EMB_ERROR_NULL_ARGUMENT);
  CHECK_STATUS(emb_geom_save(NULL, path, NULL), EMB_ERROR_NULL_ARGUMENT);
  CHECK_STATUS(emb_geom_save(g, NULL, NULL), EMB_ERROR_NULL_ARGUMENT);
  CHECK_STATUS(emb_geom_save(g, "/no/such/folder/file", NULL), EMB_ERROR_IO);
  remove(path);
  CHECK_STATUS(emb_geom_open(path, 0, NULL, &mapped), EMB_ERROR_IO);
  CHECK(strstr(emb_last_error(), path) != NULL && mapped == NULL);
  write_file(path, "no block", 8);
  CHECK_STATUS(emb_geom_open(path, EMB_UNPACK_TRUST, NULL, &mapped), EMB_ERROR_PARSE);
  write_file(path, "", 0);
  CHECK_STATUS(emb_geom_open(path, 0, NULL, &mapped), EMB_ERROR_PARSE);
  remove(path);
  emb_pool_free(pool);
}

static void damage_and_misuse_are_answered(void) {
  emb_geom *g = body(3), *out = NULL, *function = NULL;
  size_t size = 0, k, written = 12345;
  unsigned char *block = packed(g, &size), *copy = (unsigned char *)need(malloc(size));
  const int32_t borrow = EMB_UNPACK_BORROW;
  drops = 0;
  memset(copy, 0x5A, size);
  CHECK_STATUS(emb_geom_pack(g, size - 1, copy, &written), EMB_ERROR_INVALID_ARGUMENT);
  CHECK(written == 12345 && copy[0] == 0x5A);
  CHECK_STATUS(emb_geom_pack(NULL, 0, NULL, &written), EMB_ERROR_NULL_ARGUMENT);
  CHECK_STATUS(emb_geom_pack(g, 0, NULL, NULL), EMB_ERROR_NULL_ARGUMENT);
  CHECK_STATUS(emb_geom_pack(g, size, NULL, &written), EMB_ERROR_NULL_ARGUMENT);
  CHECK_OK(emb_geom_callback(callback, NULL, NULL, NULL, &function));
  CHECK_STATUS(emb_geom_pack(function, 0, NULL, &written), EMB_ERROR_UNSUPPORTED);
  CHECK(strstr(emb_last_error(), "emb_geom_callback") != NULL && written == 12345);
  CHECK_STATUS(emb_geom_unpack(NULL, size, 0, drop, &drops, &out), EMB_ERROR_NULL_ARGUMENT);
  CHECK_STATUS(emb_geom_unpack(block, size, 0, drop, &drops, NULL), EMB_ERROR_NULL_ARGUMENT);
  CHECK_STATUS(emb_geom_unpack(block, size, 4, drop, &drops, &out), EMB_ERROR_INVALID_ARGUMENT);
  CHECK_STATUS(emb_geom_unpack(block, SIZE_MAX, 0, drop, &drops, &out), EMB_ERROR_INVALID_ARGUMENT);
  CHECK_STATUS(emb_geom_unpack(block, 0, borrow, drop, &drops, &out), EMB_ERROR_PARSE);
  memmove(block + 8, block, size);
  CHECK_STATUS(emb_geom_unpack(block + 8, size, borrow, drop, &drops, &out), EMB_ERROR_INVALID_ARGUMENT);
  CHECK_OK(emb_geom_unpack(block + 8, size, 0, drop, &drops, &out));
  emb_geom_free(out), out = NULL;
  CHECK(drops == 1);
  memmove(block, block + 8, size);
  for (k = 0; k < size; ++k) {
    emb_status status;
    block[k] ^= (unsigned char)(1 + k % 255);
    status = emb_geom_unpack(block, size, borrow, drop, &drops, &out);
    block[k] ^= (unsigned char)(1 + k % 255);
    CHECK(status == EMB_ERROR_PARSE || status == EMB_ERROR_UNSUPPORTED);
    CHECK(strchr(emb_last_error(), '\n') == NULL && strstr(emb_last_error(), "block") != NULL);
    status = emb_geom_unpack(block, k, borrow, drop, &drops, &out);
    CHECK(status == EMB_ERROR_PARSE);
  }
  CHECK(drops == 1 && out == NULL);
  free(block), free(copy);
  emb_geom_free(g), emb_geom_free(function);
}

int main(void) {
  emb_geom *g = body(24);
  blocks_give_the_geometry_back(g);
  files_are_shared(g);
  damage_and_misuse_are_answered();
  emb_geom_free(g);
  return checks_done("pack");
}
