/* SPDX-License-Identifier: MIT OR Apache-2.0
 * Values over a lattice written to files: what is in them, whatever the layout, and misuse. */
#include "check.h"
#include "files.h"

#include <math.h>

enum { NX = 4, NY = 3, NZ = 2, POINTS = NX * NY * NZ };

static const double xs[NX] = {-1.0, -0.5, 0.0, 0.5}, ys[NY] = {2.0, 4.0, 6.0}, zs[NZ] = {0.0, 0.25};
static const double uneven[NX] = {-1.0, -0.5, 0.0, 0.75}, falling[NY] = {3.0, 2.0, 1.0};

static emb_lattice lattice_of(const double *x, const double *y, const double *z, size_t nz) {
  emb_lattice lattice = {sizeof(emb_lattice), {NX, NY, 0}, NULL, NULL, NULL};
  lattice.n[2] = nz;
  lattice.x = x, lattice.y = y, lattice.z = z;
  return lattice;
}

static emb_array array_of(void *data, int32_t type, ptrdiff_t i, ptrdiff_t j, ptrdiff_t k) {
  emb_array array = {sizeof(emb_array), NULL, 0, {0, 0, 0}};
  array.data = data, array.type = type;
  array.stride[0] = i, array.stride[1] = j, array.stride[2] = k;
  return array;
}

/* The bytes of a file; freed by the caller. */
static char *read_file(const char *path, size_t *size) {
  FILE *file = fopen(path, "rb");
  char *bytes = need(malloc(1 << 16));
  *size = file == NULL ? 0 : fread(bytes, 1, 1 << 16, file);
  if (file != NULL) {
    fclose(file);
  }
  return bytes;
}

/* Where the data of a file begin; NULL where there are none. */
static const char *data_of(const char *bytes, size_t size) {
  static const char mark[] = "<AppendedData encoding=\"raw\">\n_";
  size_t at;
  for (at = 0; at + sizeof mark - 1 < size; at++) {
    if (memcmp(bytes + at, mark, sizeof mark - 1) == 0) {
      return bytes + at + sizeof mark - 1;
    }
  }
  return NULL;
}

static double value_at(int i, int j, int k) { return i + 10.0 * j - 30.0 * k; }

/* Each of the four types, each in a layout of its own: the files hold the same numbers, x fastest. */
static void every_type_and_layout_is_written(void) {
  static double f64[POINTS];
  static float f32[3 * POINTS];
  static int32_t i32[POINTS];
  static int8_t i8[2 * POINTS];
  static const char *const names[4] = {"f64", "f32", "i32", "i8"};
  static const char *const extensions[2] = {"grid.vti", "grid.vtr"};
  emb_array arrays[4];
  int i, j, k, e;
  for (k = 0; k < NZ; k++) {
    for (j = 0; j < NY; j++) {
      for (i = 0; i < NX; i++) {
        f64[i + NX * (j + NY * k)] = value_at(i, j, k);
        f32[3 * (k + NZ * (j + NY * i))] = (float)value_at(i, j, k);
        i32[POINTS - 1 - (i + NX * (j + NY * k))] = (int32_t)value_at(i, j, k);
        i8[2 * (j + NY * (i + NX * k))] = (int8_t)value_at(i, j, k);
      }
    }
  }
  arrays[0] = array_of(f64, EMB_F64, 0, 0, 0);
  arrays[1] = array_of(f32, EMB_F32, 3 * NZ * NY, 3 * NZ, 3);
  arrays[2] = array_of(i32 + POINTS - 1, EMB_I32, -1, -NX, -NX * NY);
  arrays[3] = array_of(i8, EMB_I8, 2 * NY, 2, 2 * NY * NX);
  for (e = 0; e < 2; e++) {
    emb_lattice lattice = lattice_of(e == 0 ? xs : uneven, ys, zs, NZ);
    file_path path;
    char *bytes;
    const char *at;
    size_t size;
    temporary_path(path, extensions[e]);
    CHECK_OK(emb_lattice_write(&lattice, path, 4, names, arrays));
    bytes = read_file(path, &size);
    at = data_of(bytes, size);
    if (CHECK(at != NULL)) {
      const size_t sizes[4] = {8, 4, 4, 1};
      int field, point;
      for (field = 0; field < 4; field++) {
        uint64_t stated;
        memcpy(&stated, at, sizeof stated);
        CHECK(stated == sizes[field] * POINTS);
        at += sizeof stated;
        for (point = 0; point < POINTS; point++, at += sizes[field]) {
          double value = f64[point], got = 0;
          float real;
          int32_t integer;
          switch (field) {
          case 0: memcpy(&got, at, 8); break;
          case 1: memcpy(&real, at, 4); got = (double)real; break;
          case 2: memcpy(&integer, at, 4); got = (double)integer; break;
          default: got = (double)*(const signed char *)at; break;
          }
          CHECK(got == value);
        }
      }
      if (e == 1) {
        double x[NX];
        at += sizeof(uint64_t);
        memcpy(x, at, sizeof x);
        CHECK(same_bits(x, uneven, NX));
      }
    }
    free(bytes);
    remove(path);
  }
}

/* A plane without z, and a file without fields. */
static void planes_and_empty_files_are_written(void) {
  emb_lattice plane = lattice_of(xs, ys, NULL, 1);
  static double values[NX * NY];
  static const char *const names[1] = {"distance"};
  emb_array array = array_of(values, EMB_F64, 0, 0, 0);
  file_path path;
  char *bytes;
  size_t size;
  temporary_path(path, "plane.vti");
  CHECK_OK(emb_lattice_write(&plane, path, 1, names, &array));
  bytes = read_file(path, &size);
  CHECK(data_of(bytes, size) != NULL);
  free(bytes);
  CHECK_OK(emb_lattice_write(&plane, path, 0, NULL, NULL));
  remove(path);
}

/* Arrays of another release's size lie as far apart as they say. */
static void larger_arrays_are_found(void) {
  static struct { emb_array array; char later[24]; } wide[2];
  static double first[POINTS], second[POINTS];
  static const char *const names[2] = {"first", "second"};
  emb_lattice lattice = lattice_of(xs, ys, zs, NZ);
  file_path path;
  char *bytes;
  const char *at;
  size_t size;
  int i;
  for (i = 0; i < POINTS; i++) {
    first[i] = i, second[i] = -i;
  }
  wide[0].array = array_of(first, EMB_F64, 0, 0, 0), wide[1].array = array_of(second, EMB_F64, 0, 0, 0);
  wide[0].array.struct_size = wide[1].array.struct_size = sizeof wide[0];
  temporary_path(path, "wide.vti");
  CHECK_OK(emb_lattice_write(&lattice, path, 2, names, &wide[0].array));
  bytes = read_file(path, &size);
  at = data_of(bytes, size);
  CHECK(at != NULL && memcmp(at + 8, first, sizeof first) == 0);
  CHECK(at != NULL && memcmp(at + 16 + sizeof first, second, sizeof second) == 0);
  free(bytes);
  remove(path);
}

/* One failing call: the status, and what the message says. */
#define REFUSED(call, status, says)                                                                    \
  (CHECK_STATUS(call, status) && CHECK(strstr(emb_last_error(), says) != NULL && strchr(emb_last_error(), '\n') == NULL) \
       ? 0                                                                                             \
       : printf("    \"%s\", not \"%s\"\n", emb_last_error(), says))

static void misuse_is_refused(void) {
  static double values[POINTS];
  static const char *const names[2] = {"a", "b"}, *const hollow[2] = {"a", NULL}, *const twice[2] = {"a", "a"},
                           *const empty[2] = {"a", ""}, *const lines[2] = {"a\nb", "b"}, *const wild[2] = {"a", "\xFF"};
  emb_array arrays[2], spoilt[2];
  emb_lattice lattice = lattice_of(xs, ys, zs, NZ), wrong;
  file_path path, other;
  char *bytes;
  size_t size;
  temporary_path(path, "misuse.vti");
  temporary_path(other, "misuse.vtx");
  write_file(path, "older", 5);
  arrays[0] = arrays[1] = array_of(values, EMB_F64, 0, 0, 0);
#define SPOILT(member, value) (spoilt[0] = spoilt[1] = arrays[0], spoilt[1].member = (value), spoilt)
#define WRONG(member, value) (wrong = lattice, wrong.member = (value), &wrong)
  REFUSED(emb_lattice_write(NULL, path, 2, names, arrays), EMB_ERROR_NULL_ARGUMENT, "lattice");
  REFUSED(emb_lattice_write(&lattice, NULL, 2, names, arrays), EMB_ERROR_NULL_ARGUMENT, "path");
  REFUSED(emb_lattice_write(&lattice, path, 2, NULL, arrays), EMB_ERROR_NULL_ARGUMENT, "names");
  REFUSED(emb_lattice_write(&lattice, path, 2, names, NULL), EMB_ERROR_NULL_ARGUMENT, "arrays[0]");
  REFUSED(emb_lattice_write(&lattice, path, SIZE_MAX, names, arrays), EMB_ERROR_INVALID_ARGUMENT, "count");
  REFUSED(emb_lattice_write(&lattice, path, 2, hollow, arrays), EMB_ERROR_NULL_ARGUMENT, "names[1]");
  REFUSED(emb_lattice_write(&lattice, path, 2, twice, arrays), EMB_ERROR_INVALID_ARGUMENT, "names[1]: \"a\" is there");
  REFUSED(emb_lattice_write(&lattice, path, 2, empty, arrays), EMB_ERROR_INVALID_ARGUMENT, "names[1]");
  REFUSED(emb_lattice_write(&lattice, path, 2, lines, arrays), EMB_ERROR_INVALID_ARGUMENT, "names[0]");
  REFUSED(emb_lattice_write(&lattice, path, 2, wild, arrays), EMB_ERROR_INVALID_ARGUMENT, "names[1]");
  REFUSED(emb_lattice_write(&lattice, path, 2, names, SPOILT(data, NULL)), EMB_ERROR_NULL_ARGUMENT, "arrays[1].data");
  REFUSED(emb_lattice_write(&lattice, path, 2, names, SPOILT(type, 4)), EMB_ERROR_INVALID_ARGUMENT, "arrays[1].type: 4");
  REFUSED(emb_lattice_write(&lattice, path, 2, names, SPOILT(struct_size, 3)), EMB_ERROR_INVALID_ARGUMENT,
          "arrays[1].struct_size: 3");
  REFUSED(emb_lattice_write(&lattice, path, 2, names, SPOILT(stride[0], 1)), EMB_ERROR_INVALID_ARGUMENT,
          "arrays[1].stride[1]: 0");
  REFUSED(emb_lattice_write(&lattice, path, 2, names, SPOILT(data, (char *)values + 1)), EMB_ERROR_INVALID_ARGUMENT,
          "arrays[1].data");
  REFUSED(emb_lattice_write(WRONG(struct_size, 7), path, 2, names, arrays), EMB_ERROR_INVALID_ARGUMENT,
          "lattice.struct_size: 7");
  REFUSED(emb_lattice_write(WRONG(x, NULL), path, 2, names, arrays), EMB_ERROR_NULL_ARGUMENT, "lattice.x");
  REFUSED(emb_lattice_write(WRONG(x, uneven), path, 2, names, arrays), EMB_ERROR_UNSUPPORTED, "x[1]: -0.5");
  REFUSED(emb_lattice_write(WRONG(y, falling), path, 2, names, arrays), EMB_ERROR_UNSUPPORTED, "y[1]: 2 after 3");
  REFUSED(emb_lattice_write(WRONG(n[0], 0), path, 2, names, arrays), EMB_ERROR_INVALID_ARGUMENT, "x: no nodes");
  REFUSED(emb_lattice_write(&lattice, other, 2, names, arrays), EMB_ERROR_UNSUPPORTED, "\"vtx\"");
  REFUSED(emb_lattice_write(&lattice, "/nonexistent/a.vti", 2, names, arrays), EMB_ERROR_IO, "/nonexistent/a.vti");
  bytes = read_file(path, &size);
  CHECK(size == 5 && memcmp(bytes, "older", 5) == 0);
  free(bytes);
  remove(path);
}

int main(void) {
  every_type_and_layout_is_written();
  planes_and_empty_files_are_written();
  larger_arrays_are_found();
  misuse_is_refused();
  return checks_done("lattice");
}
