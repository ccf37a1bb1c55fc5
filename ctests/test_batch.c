/* Batches: results of single runs for any number of threads, errors of their own, progress and stopping from outside. */
#define _POSIX_C_SOURCE 199309L
#include <math.h>
#include <pthread.h>
#include <time.h>

#include "check.h"

enum { RUNS = 5 };

static cagedyn_sim *start(const cagedyn_model *m, int k)
{
    int64_t n = cagedyn_model_state_count(m);
    double *state = numbers(n);
    cagedyn_sim *sim = cagedyn_sim_new(m);
    CHECK(cagedyn_sim_get_state(sim, state, n) == CAGEDYN_OK);
    state[cagedyn_model_find_state(m, "cage.z")] += 1e-6 * k;
    CHECK(cagedyn_sim_set_state(sim, 0.0, state, n) == CAGEDYN_OK);
    free(state);
    return sim;
}

static cagedyn_batch *batch_of(const cagedyn_model *m)
{
    cagedyn_batch *batch = cagedyn_batch_new();
    for (int k = 0; k < RUNS; k++) CHECK(cagedyn_batch_add(batch, start(m, k)) == k);
    CHECK(cagedyn_batch_count(batch) == RUNS);
    return batch;
}

static void check_same_bits(const cagedyn_model *m)
{
    int64_t n = cagedyn_model_state_count(m);
    double *alone = numbers(n * RUNS), *state = numbers(n), progress[6];
    CHECK(cagedyn_progress_count() == 6 && strcmp(cagedyn_progress_name(3), "arrived") == 0);
    for (int k = 0; k < RUNS; k++) {
        cagedyn_sim *sim = start(m, k);
        CHECK(cagedyn_sim_advance_to(sim, 1e-3) == CAGEDYN_OK);
        CHECK(cagedyn_sim_get_state(sim, alone + k * n, n) == CAGEDYN_OK);
        cagedyn_sim_free(sim);
    }
    for (int64_t threads = 0; threads < 4; threads++) {
        cagedyn_batch *batch = batch_of(m);
        cagedyn_monitor *monitor = cagedyn_monitor_new(batch);
        CHECK(cagedyn_batch_advance_to(batch, 1e-3, threads) == CAGEDYN_OK);
        for (int k = 0; k < RUNS; k++) {
            cagedyn_sim *sim = cagedyn_batch_sim(batch, k);
            CHECK(cagedyn_sim_get_state(sim, state, n) == CAGEDYN_OK);
            CHECK(memcmp(state, alone + k * n, (size_t)n * sizeof(double)) == 0);
            /* It belongs to the batch: this does nothing. */
            cagedyn_sim_free(sim);
            CHECK(cagedyn_sim_get_state(sim, state, n) == CAGEDYN_OK);
        }
        CHECK(cagedyn_monitor_progress(monitor, progress, 6) == CAGEDYN_OK);
        CHECK(progress[0] == RUNS && progress[3] == RUNS && progress[4] == 0.0 && progress[5] == 1.0);
        cagedyn_batch_free(batch);
        CHECK(cagedyn_monitor_progress(monitor, progress, 6) == CAGEDYN_OK);
        cagedyn_monitor_free(monitor);
    }
    free(alone), free(state);
}

static void check_errors(const cagedyn_model *m)
{
    cagedyn_batch *batch = batch_of(m);
    cagedyn_sim *second = cagedyn_batch_sim(batch, 1), *other = cagedyn_sim_new(m);
    double time = 0.0, progress[6];
    CHECK(cagedyn_sim_set_wall_time_limit(second, 0.0) == CAGEDYN_OK);
    CHECK_FAILS(cagedyn_batch_advance_to(batch, 1e-4, 2), CAGEDYN_ERR_OUT_OF_TIME, "simulation 1: ");
    CHECK(strstr(cagedyn_error_message(), "1 of 5") != NULL);
    for (int k = 0; k < RUNS; k++) {
        CHECK(cagedyn_batch_status(batch, k) == (k == 1 ? CAGEDYN_ERR_OUT_OF_TIME : CAGEDYN_OK));
        CHECK((cagedyn_batch_message(batch, k)[0] == '\0') == (k != 1));
        CHECK(cagedyn_sim_time(cagedyn_batch_sim(batch, k), &time) == CAGEDYN_OK);
        CHECK(k == 1 ? time == 0.0 : time == 1e-4);
    }
    CHECK(cagedyn_sim_set_wall_time_limit(second, INFINITY) == CAGEDYN_OK);
    CHECK(cagedyn_batch_advance_to(batch, 2e-4, 0) == CAGEDYN_OK);
    CHECK(cagedyn_batch_status(batch, 1) == CAGEDYN_OK && cagedyn_batch_message(batch, 1)[0] == '\0');

    CHECK_FAILS(cagedyn_batch_advance_to(batch, 1e-4, 0), CAGEDYN_ERR_BAD_VALUE, "before the current time");
    CHECK_FAILS(cagedyn_batch_advance_to(batch, NAN, 0), CAGEDYN_ERR_BAD_VALUE, "t");
    CHECK_FAILS(cagedyn_batch_advance_to(batch, 3e-4, -1), CAGEDYN_ERR_BAD_VALUE, "threads: -1");
    CHECK_FAILS(cagedyn_batch_advance_to(NULL, 3e-4, 0), CAGEDYN_ERR_NULL_ARGUMENT, "batch");
    CHECK_FAILS((int32_t)cagedyn_batch_add(batch, second), CAGEDYN_ERR_BAD_VALUE, "already");
    CHECK_FAILS((int32_t)cagedyn_batch_add(batch, NULL), CAGEDYN_ERR_NULL_ARGUMENT, "sim");
    CHECK_FAILS((int32_t)cagedyn_batch_add(NULL, other), CAGEDYN_ERR_NULL_ARGUMENT, "batch");
    CHECK(cagedyn_batch_sim(batch, RUNS) == NULL && cagedyn_error_status() == CAGEDYN_ERR_BAD_INDEX);
    CHECK(cagedyn_batch_status(batch, -1) == CAGEDYN_ERR_BAD_INDEX);
    CHECK(cagedyn_batch_message(batch, -1)[0] == '\0');
    CHECK(cagedyn_monitor_new(NULL) == NULL);
    CHECK_FAILS(cagedyn_monitor_progress(NULL, progress, 6), CAGEDYN_ERR_NULL_ARGUMENT, "monitor");
    CHECK_FAILS(cagedyn_monitor_cancel(NULL), CAGEDYN_ERR_NULL_ARGUMENT, "monitor");
    cagedyn_sim_free(other);
    cagedyn_batch_free(batch);
    cagedyn_batch_free(NULL);
    cagedyn_monitor_free(NULL);
}

static void *stop(void *monitor)
{
    const struct timespec pause = {0, 1000000};
    double progress[6] = {0.0};
    while (progress[2] == 0.0) {
        CHECK(cagedyn_monitor_progress((cagedyn_monitor *)monitor, progress, 6) == CAGEDYN_OK);
        nanosleep(&pause, NULL);
    }
    CHECK(cagedyn_monitor_cancel((cagedyn_monitor *)monitor) == CAGEDYN_OK);
    return NULL;
}

static void check_stopping(const cagedyn_model *m)
{
    cagedyn_batch *batch = batch_of(m);
    cagedyn_monitor *monitor = cagedyn_monitor_new(batch);
    pthread_t thread;
    double furthest = 0.0, time = 0.0;
    CHECK(pthread_create(&thread, NULL, stop, monitor) == 0);
    CHECK(cagedyn_batch_advance_to(batch, 1e4, 2) == CAGEDYN_ERR_CANCELLED);
    CHECK(pthread_join(thread, NULL) == 0);
    for (int k = 0; k < RUNS; k++) {
        CHECK(cagedyn_batch_status(batch, k) == CAGEDYN_ERR_CANCELLED);
        CHECK(cagedyn_sim_time(cagedyn_batch_sim(batch, k), &time) == CAGEDYN_OK);
        furthest = fmax(furthest, time);
    }
    CHECK(cagedyn_batch_advance_to(batch, furthest + 1e-5, 2) == CAGEDYN_OK);
    cagedyn_monitor_free(monitor);
    cagedyn_batch_free(batch);
}

int main(int argc, char **argv)
{
    cagedyn_model *m = load_model(argc, argv);
    check_same_bits(m);
    check_errors(m);
    check_stopping(m);
    cagedyn_model_free(m);
    return failures > 0;
}
