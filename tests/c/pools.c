/* SPDX-License-Identifier: MIT OR Apache-2.0
 * Pools: own workers, and executors of the caller that run tasks serially, in reverse, twice over or on threads. The
 * same bits from each; many callers of one pool; calls from within its tasks; progress only on the calling thread;
 * cancellation; and no thread that nobody asked for. */
#include "check.h"

#include <pthread.h>
#include <unistd.h>

#define N 40
#define CELLS (N * N * N)

static double axis[N], expected[CELLS];
static emb_geom *mesh_geometry;

static void fill(const emb_geom *g, const emb_run *run, double *out, emb_status status) {
  emb_lattice lattice = {sizeof lattice, {N, N, N}, axis, axis, axis};
  emb_array array = {sizeof array, NULL, EMB_F64, {0, 0, 0}};
  array.data = out;
  CHECK_STATUS(emb_geom_fill(g, &lattice, EMB_FILL_EXACT, 0.0, run, &array), status);
}

/* How many threads this process has; 0 where that cannot be read. */
static int threads(void) {
  FILE *file = fopen("/proc/self/status", "r");
  char line[200];
  int count = 0;
  while (file != NULL && fgets(line, sizeof line, file) != NULL) {
    if (sscanf(line, "Threads: %d", &count) == 1) {
      break;
    }
  }
  if (file != NULL) {
    fclose(file);
  }
  return count;
}

/* A thread that has ended may still be counted for a moment. */
static int threads_settle_at(int wanted) {
  int tries;
  for (tries = 0; tries < 200 && threads() != wanted; tries++) {
    usleep(10000);
  }
  return threads() == wanted;
}

static void no_thread_that_nobody_asked_for(void) {
  static double out[CELLS];
  int before = threads();
  emb_pool *pool = NULL;
  emb_run run = {sizeof run, NULL, NULL, NULL};
  fill(mesh_geometry, NULL, out, EMB_OK);
  CHECK(same_bits(out, expected, CELLS));
  CHECK(threads() == before);
  CHECK_OK(emb_pool_new(1, &pool));
  CHECK(threads_settle_at(before) && emb_pool_width(pool) == 1);
  emb_pool_free(pool);
  CHECK_OK(emb_pool_new(4, &pool));
  CHECK(emb_pool_width(pool) == 4);
  CHECK(threads_settle_at(before + 3));
  run.pool = pool;
  fill(mesh_geometry, &run, out, EMB_OK);
  CHECK(same_bits(out, expected, CELLS));
  CHECK(threads_settle_at(before + 3)); /* no second pool behind the first */
  {
    emb_pool *again = emb_pool_clone(pool);
    emb_pool_free(pool);
    fill(mesh_geometry, &run, out, EMB_OK);
    emb_pool_free(again);
  }
  CHECK(threads_settle_at(before));
  CHECK_OK(emb_pool_new(0, &pool));
  CHECK(emb_pool_width(pool) >= 1);
  emb_pool_free(pool);
  CHECK(threads_settle_at(before));
}

/* Executors. */

typedef void (*task_function)(void *context, size_t index);

static void serial(void *user, size_t tasks, task_function task, void *context) {
  size_t i;
  ++*(int *)user;
  for (i = 0; i < tasks; i++) {
    task(context, i);
  }
}

static void reversed(void *user, size_t tasks, task_function task, void *context) {
  ++*(int *)user;
  while (tasks-- > 0) {
    task(context, tasks);
  }
}

static void twice_over(void *user, size_t tasks, task_function task, void *context) {
  serial(user, tasks, task, context);
  serial(user, tasks, task, context);
}

static void only_the_first(void *user, size_t tasks, task_function task, void *context) {
  serial(user, tasks < 1 ? tasks : 1, task, context);
}

typedef struct job {
  task_function task;
  void *context;
  size_t index;
} job;

static void *run_job(void *given) {
  job *j = (job *)given;
  j->task(j->context, j->index);
  return NULL;
}

static void threaded(void *user, size_t tasks, task_function task, void *context) {
  pthread_t handles[16];
  job jobs[16];
  size_t i;
  (void)user;
  CHECK(tasks <= 16);
  for (i = 0; i < tasks; i++) {
    jobs[i].task = task, jobs[i].context = context, jobs[i].index = i;
    if (pthread_create(&handles[i], NULL, run_job, &jobs[i]) != 0) {
      printf("no threads\n");
      exit(2);
    }
  }
  for (i = 0; i < tasks; i++) {
    pthread_join(handles[i], NULL);
  }
}

static void executors_give_the_same_bits(void) {
  static const emb_parallel_for_fn executors[5] = {serial, reversed, twice_over, only_the_first, threaded};
  static double out[CELLS];
  int k, drops = 0, calls = 0;
  for (k = 0; k < 5; k++) {
    emb_run run = {sizeof run, NULL, NULL, NULL};
    emb_pool *pool = NULL;
    CHECK_OK(emb_pool_from_callback(5, executors[k], &calls, NULL, &pool));
    CHECK(emb_pool_width(pool) == 5);
    run.pool = pool;
    memset(out, 0, sizeof out);
    fill(mesh_geometry, &run, out, EMB_OK);
    CHECK(same_bits(out, expected, CELLS));
    emb_pool_free(pool);
    CHECK_OK(emb_pool_from_callback(2, executors[k], &drops, count_drop, &pool));
    emb_pool_free(pool);
    CHECK(drops == k + 1);
  }
  CHECK(calls == 5);
}

/* Functions that ask embound themselves. */

typedef struct nested {
  const emb_geom *inner;
  emb_pool *pool;
} nested;

static double nested_function(void *user, double x, double y, double z) {
  nested *n = (nested *)user;
  emb_run run = {sizeof run, NULL, NULL, NULL};
  double xs[2], ys[2], zs[2], out[2];
  run.pool = n->pool;
  xs[0] = xs[1] = x, ys[0] = ys[1] = y, zs[0] = zs[1] = z;
  if (emb_geom_values(n->inner, 2, xs, ys, zs, 1, &run, out) != EMB_OK) {
    return NAN;
  }
  return out[1];
}

static void nested_calls_do_not_deadlock(emb_pool *pool) {
  static double x[600], y[600], z[600], out[600], plain[600];
  emb_callback_options options;
  emb_geom *outer;
  nested n;
  emb_run run = {sizeof run, NULL, NULL, NULL};
  int i;
  n.inner = mesh_geometry, n.pool = pool;
  run.pool = pool;
  CHECK_OK(emb_callback_options_init(&options, sizeof options));
  options.thread_safe = 1;
  CHECK_OK(emb_geom_callback(nested_function, &n, NULL, &options, &outer));
  for (i = 0; i < 600; i++) {
    x[i] = random_between(-1, 1), y[i] = random_between(-1, 1), z[i] = random_between(-1, 1);
  }
  CHECK_OK(emb_geom_values(mesh_geometry, 600, x, y, z, 1, NULL, plain));
  CHECK_OK(emb_geom_values(outer, 600, x, y, z, 1, &run, out));
  CHECK(same_bits(plain, out, 600));
  emb_geom_free(outer);
}

/* Many callers of one pool. */

typedef struct caller {
  emb_pool *pool;
  int fails;
} caller;

static void *call_often(void *given) {
  caller *c = (caller *)given;
  double *out = (double *)need(malloc(CELLS * sizeof *out));
  emb_lattice lattice = {sizeof lattice, {N, N, N}, axis, axis, axis};
  emb_array array = {sizeof array, NULL, EMB_F64, {0, 0, 0}};
  emb_run run = {sizeof run, NULL, NULL, NULL};
  int i;
  array.data = out;
  run.pool = c->pool;
  for (i = 0; i < 3; i++) {
    emb_geom *own = emb_geom_clone(mesh_geometry);
    memset(out, 0, CELLS * sizeof *out);
    c->fails += emb_geom_fill(own, &lattice, EMB_FILL_EXACT, 0.0, &run, &array) != EMB_OK;
    c->fails += !same_bits(out, expected, CELLS);
    emb_geom_free(own);
    /* the last message is the thread's own */
    c->fails += emb_geom_sphere(axis, (double)-i - 1, &own) != EMB_ERROR_INVALID_ARGUMENT;
    c->fails += strchr(emb_last_error(), '1' + i) == NULL;
  }
  free(out);
  return NULL;
}

static void many_callers_share_a_pool(emb_pool *pool) {
  pthread_t handles[4];
  caller callers[4];
  int i;
  for (i = 0; i < 4; i++) {
    callers[i].pool = pool, callers[i].fails = 0;
    CHECK(pthread_create(&handles[i], NULL, call_often, &callers[i]) == 0);
  }
  for (i = 0; i < 4; i++) {
    pthread_join(handles[i], NULL);
    CHECK(callers[i].fails == 0);
  }
}

/* Functions that are not thread-safe, and progress, stay on the calling thread. */

typedef struct watch {
  pthread_t thread;
  int calls, elsewhere, stop_at, fell;
  double last;
} watch;

static double watched_function(void *user, double x, double y, double z) {
  watch *w = (watch *)user;
  w->calls++;
  w->elsewhere += !pthread_equal(w->thread, pthread_self());
  return sqrt(x * x + y * y + z * z) - 1.0;
}

static int32_t watched_progress(void *user, double fraction) {
  watch *w = (watch *)user;
  w->calls++;
  w->elsewhere += !pthread_equal(w->thread, pthread_self());
  w->fell += fraction < w->last || fraction < 0 || fraction > 1;
  w->last = fraction;
  return w->calls == w->stop_at;
}

static watch watch_new(int stop_at) {
  watch w;
  memset(&w, 0, sizeof w);
  w.thread = pthread_self();
  w.stop_at = stop_at;
  return w;
}

static void what_is_not_thread_safe_stays_on_the_calling_thread(emb_pool *pool) {
  static double out[CELLS];
  watch function = watch_new(0), progress = watch_new(0);
  emb_callback_options options;
  emb_geom *g;
  emb_run run = {sizeof run, NULL, NULL, NULL};
  run.pool = pool;
  CHECK_OK(emb_callback_options_init(&options, sizeof options));
  options.kind = EMB_EXACT;
  CHECK_OK(emb_geom_callback(watched_function, &function, NULL, &options, &g));
  fill(g, &run, out, EMB_OK);
  CHECK(function.calls >= CELLS && function.elsewhere == 0);
  emb_geom_free(g);
  run.progress = watched_progress, run.user = &progress;
  fill(mesh_geometry, &run, out, EMB_OK);
  CHECK(progress.calls > 0 && progress.elsewhere == 0 && progress.fell == 0 && progress.last == 1.0);
}

static void a_call_can_be_cancelled(emb_pool *pool) {
  static double out[CELLS];
  soup ball = soup_sphere(1.0, 64);
  emb_mesh *mesh;
  emb_geom *untouched = NULL;
  watch progress = watch_new(1);
  emb_run run = {sizeof run, NULL, NULL, NULL};
  run.pool = pool;
  run.progress = watched_progress, run.user = &progress;
  fill(mesh_geometry, &run, out, EMB_ERROR_CANCELLED);
  CHECK(progress.calls == 1 && progress.elsewhere == 0);
  CHECK(strstr(emb_last_error(), "progress") != NULL);
  run.progress = NULL;
  fill(mesh_geometry, &run, out, EMB_OK);
  CHECK(same_bits(out, expected, CELLS));
  mesh = soup_mesh(&ball);
  progress = watch_new(1);
  run.progress = watched_progress;
  CHECK_STATUS(emb_geom_from_mesh(mesh, NULL, &run, &untouched), EMB_ERROR_CANCELLED);
  CHECK(untouched == NULL && progress.elsewhere == 0);
  emb_mesh_free(mesh);
  soup_free(&ball);
}

/* A worker's failure reaches the caller, with its message. */
static double failing_function(void *user, double x, double y, double z) {
  (void)user;
  return x > 0.99 && y > 0.99 && z > 0.99 ? NAN : x - 0.5;
}

static void a_failure_on_a_worker_reaches_the_caller(emb_pool *pool) {
  static double out[CELLS];
  emb_callback_options options;
  emb_geom *g;
  emb_run run = {sizeof run, NULL, NULL, NULL};
  run.pool = pool;
  CHECK_OK(emb_callback_options_init(&options, sizeof options));
  options.thread_safe = 1, options.kind = EMB_LOWER_BOUND;
  CHECK_OK(emb_geom_callback(failing_function, NULL, NULL, &options, &g));
  fill(g, &run, out, EMB_ERROR_CALLBACK);
  CHECK(strstr(emb_last_error(), "function") != NULL);
  emb_geom_free(g);
}

int main(void) {
  soup ball = soup_sphere(0.8, 32);
  emb_pool *own = NULL, *over = NULL;
  int i, calls = 0;
  for (i = 0; i < N; i++) {
    axis[i] = -1.0 + 2.0 * i / (N - 1);
  }
  mesh_geometry = soup_geometry(&ball);
  fill(mesh_geometry, NULL, expected, EMB_OK);
  no_thread_that_nobody_asked_for();
  executors_give_the_same_bits();
  CHECK_OK(emb_pool_new(3, &own));
  CHECK_OK(emb_pool_from_callback(3, threaded, &calls, NULL, &over));
  for (i = 0; i < 2; i++) {
    emb_pool *pool = i == 0 ? own : over;
    nested_calls_do_not_deadlock(pool);
    many_callers_share_a_pool(pool);
    what_is_not_thread_safe_stays_on_the_calling_thread(pool);
    a_call_can_be_cancelled(pool);
    a_failure_on_a_worker_reaches_the_caller(pool);
  }
  emb_pool_free(own);
  emb_pool_free(over);
  emb_geom_free(mesh_geometry);
  soup_free(&ball);
  return checks_done("pools");
}
