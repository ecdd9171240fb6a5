/* SPDX-License-Identifier: MIT OR Apache-2.0
 * Tables of misuse. A program includes this after it has defined `arguments` (of which a call is given a copy that may
 * be spoilt), `outputs` and reset_outputs() (all that a call may write to), and `drops` (the drop functions run). */
#ifndef EMBOUND_TEST_MISUSE_H
#define EMBOUND_TEST_MISUSE_H

#include <stddef.h>

/* A function, called with what the table spoils. */
#define CALL(name, expression) \
  static emb_status name(arguments *a) { return expression; }

/* One row: the argument at `offset` is spoilt by `value`, and the message must contain `name`. */
typedef struct misuse {
  const char *function;
  emb_status (*call)(arguments *);
  enum { POINTER, HANDLE, SIZE, INT, REAL, BYTE, STEP } kind;
  size_t offset;
  const void *pointer;
  size_t size;
  int32_t integer;
  double real;
  emb_status status;
  const char *name;
} misuse;

#define AT(member) offsetof(arguments, member)
#define ROW(call, kind, member, p, s, i, r, status, name) \
  { #call, call, kind, AT(member), p, s, i, r, status, name }
#define NULLED(call, member, name) ROW(call, POINTER, member, NULL, 0, 0, 0, EMB_ERROR_NULL_ARGUMENT, name)
#define BENT(call, member, name) \
  ROW(call, POINTER, member, (const char *)xs + 1, 0, 0, 0, EMB_ERROR_INVALID_ARGUMENT, name)
#define POINTED(call, member, to, status, name) ROW(call, POINTER, member, to, 0, 0, 0, status, name)
#define HELD(call, member, handle, status, name) ROW(call, HANDLE, member, handle, 0, 0, 0, status, name)
#define SIZED(call, member, s, name) ROW(call, SIZE, member, NULL, s, 0, 0, EMB_ERROR_INVALID_ARGUMENT, name)
#define SIZED_AS(call, member, s, status, name) ROW(call, SIZE, member, NULL, s, 0, 0, status, name)
#define INTEGER(call, member, i, status, name) ROW(call, INT, member, NULL, 0, i, 0, status, name)
#define UNKNOWN(call, member, name)                                     \
  INTEGER(call, member, 77, EMB_ERROR_INVALID_ARGUMENT, name ": 77"),   \
  INTEGER(call, member, -5, EMB_ERROR_INVALID_ARGUMENT, name ": -5")
#define REAL_ONE(call, member, r, name) ROW(call, REAL, member, NULL, 0, 0, r, EMB_ERROR_INVALID_ARGUMENT, name)
#define NOT_FINITE(call, member, name)                                                   \
  REAL_ONE(call, member, NAN, name), REAL_ONE(call, member, INFINITY, name), \
  REAL_ONE(call, member, -INFINITY, name)
/* Sizes that no release has; one too large whose tail is not zero. */
#define VERSIONED(call, member, type, name)                                                       \
  SIZED(call, member.value.struct_size, 0, name ".struct_size: 0"),                               \
  SIZED(call, member.value.struct_size, sizeof(type) / 2, name ".struct_size"),                   \
  SIZED(call, member.value.struct_size, 5000, name ".struct_size: 5000"),                         \
  SIZED(call, member.value.struct_size, SIZE_MAX, name ".struct_size"),                           \
  ROW(call, BYTE, member, NULL, sizeof(type), 0, 0, EMB_ERROR_INVALID_ARGUMENT, name ".struct_size")
#define LATTICE(call)                                                                                  \
  NULLED(call, lattice, "lattice"), VERSIONED(call, lattice_value, emb_lattice, "lattice"),            \
  NULLED(call, lattice_value.value.x, "lattice.x"), NULLED(call, lattice_value.value.y, "lattice.y"),  \
  NULLED(call, lattice_value.value.z, "lattice.z"), BENT(call, lattice_value.value.y, "lattice.y"),    \
  SIZED(call, lattice_value.value.n[0], SIZE_MAX, "lattice.n[0]"),                                     \
  SIZED(call, lattice_value.value.n[1], SIZE_MAX / 4, "lattice.n[1]"),                                 \
  SIZED(call, lattice_value.value.n[2], (size_t)1 << 62, "lattice.n[2]"),                              \
  POINTED(call, lattice_value.value.x, not_finite, EMB_ERROR_INVALID_ARGUMENT, "lattice.x[1]"),        \
  POINTED(call, lattice_value.value.y, not_finite, EMB_ERROR_INVALID_ARGUMENT, "lattice.y[1]"),        \
  POINTED(call, lattice_value.value.x, zigzag, EMB_ERROR_INVALID_ARGUMENT, "lattice.x[2]")
#define RUN(call) VERSIONED(call, run_value, emb_run, "run")
#define MESH_OPTIONS(call)                                                                             \
  VERSIONED(call, mesh_options_value, emb_mesh_options, "options"),                                    \
  UNKNOWN(call, mesh_options_value.value.orient, "options.orient"),                                    \
  UNKNOWN(call, mesh_options_value.value.format, "options.format"),                                    \
  UNKNOWN(call, mesh_options_value.value.index_base, "options.index_base"),                            \
  NOT_FINITE(call, mesh_options_value.value.scale, "scale"),                                           \
  REAL_ONE(call, mesh_options_value.value.scale, 0.0, "scale"),                                        \
  REAL_ONE(call, mesh_options_value.value.scale, -2.0, "scale"),                                       \
  NOT_FINITE(call, mesh_options_value.value.rotation[4], "rotation"),                                  \
  NOT_FINITE(call, mesh_options_value.value.shift[2], "shift"),                                        \
  NOT_FINITE(call, mesh_options_value.value.weld_tolerance, "weld_tolerance"),                         \
  REAL_ONE(call, mesh_options_value.value.weld_tolerance, -1e-9, "weld_tolerance")

static const double not_finite[9] = {0, NAN, 2, 3, 4, 5, 6, 7, 8}, zigzag[8] = {0, 2, 1, 3};

/* Strides of a 3 x 2 x 2 lattice that cannot be. */
static void spoil_strides(emb_array *array, size_t which) {
  static const ptrdiff_t wrong[4][3] = {
      {0, 0, 0}, {1, 2, 6}, {1, 3, 0}, {1, 3, PTRDIFF_MAX}};
  memcpy(array->stride, wrong[which], sizeof array->stride);
}

static void spoil(arguments *a, const misuse *row) {
  char *at = (char *)a + row->offset;
  switch (row->kind) {
    case POINTER:
      memcpy(at, &row->pointer, sizeof row->pointer);
      break;
    case HANDLE:
      memcpy(at, row->pointer, sizeof(void *));
      break;
    case SIZE:
      memcpy(at, &row->size, sizeof row->size);
      break;
    case INT:
      memcpy(at, &row->integer, sizeof row->integer);
      break;
    case REAL:
      memcpy(at, &row->real, sizeof row->real);
      break;
    case BYTE: {
      /* a struct of 16 bytes more, whose last byte says something */
      size_t size = row->size + 16;
      memcpy(at, &size, sizeof size);
      at[size - 1] = 1;
      break;
    }
    case STEP:
      spoil_strides((emb_array *)at, row->size);
      break;
  }
}

static void check_row(const misuse *row, arguments *a) {
  static struct outputs before;
  char context[200];
  arguments given;
  emb_status status;
  const char *message;
  spoil(a, row);
  snprintf(context, sizeof context, "%s with %s spoilt (kind %d)", row->function, row->name, (int)row->kind);
  reset_outputs(0xA5);
  before = outputs;
  given = *a;
  emb_geom_sphere(NULL, 1.0, NULL); /* another message */
  status = row->call(a);
  message = emb_last_error();
  check_that(status == row->status, context, __FILE__, __LINE__);
  if (status != row->status) {
    printf("    status %d, not %d: %s\n", (int)status, (int)row->status, message);
  }
  if (row->status == EMB_OK) {
    return;
  }
  if (!check_that(strstr(message, row->name) != NULL && strchr(message, '\n') == NULL && message[0] != '\0' &&
                      strcmp(message, "out_geom: NULL") != (strcmp(row->name, "out_geom") == 0),
                  context, __FILE__, __LINE__)) {
    printf("    the message: %s\n", message);
  }
  check_that(memcmp(&before, &outputs, sizeof outputs) == 0, context, __FILE__, __LINE__);
  check_that(memcmp(&given, a, sizeof given) == 0, context, __FILE__, __LINE__);
  check_that(drops == 0, context, __FILE__, __LINE__);
}

#endif
