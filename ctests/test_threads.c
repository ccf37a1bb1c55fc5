/* Two simulations of one model in two threads do not affect each other. */
#include <pthread.h>

#include "check.h"

enum { THREADS = 2, STEPS = 20 };

typedef struct {
    const cagedyn_model *model;
    double speed;
    double *state;
    int status;
} job;

static void *run(void *data)
{
    job *j = (job *)data;
    int64_t n = cagedyn_model_state_count(j->model);
    cagedyn_sim *sim = cagedyn_sim_new(j->model);
    j->status = cagedyn_sim_set_input(sim, 0, j->speed);
    for (int i = 0; i < STEPS && j->status == CAGEDYN_OK; i++) {
        j->status = cagedyn_sim_step(sim, 1e-4);
        /* Errors of one thread are not seen by the other. */
        if (j->speed > -200.0 && cagedyn_sim_step(sim, -1.0) == CAGEDYN_OK) j->status = 1;
        if (j->speed < -200.0 && cagedyn_error_message()[0] != '\0') j->status = 1;
    }
    if (j->status == CAGEDYN_OK) j->status = cagedyn_sim_get_state(sim, j->state, n);
    cagedyn_sim_free(sim);
    return NULL;
}

/* What is used by one thread is refused to another, and is none the worse for it. */
static void *run_batch(void *data) { return cagedyn_batch_advance_to((cagedyn_batch *)data, 0.02, 1) == CAGEDYN_OK ? NULL : data; }

static void use_of_a_running_batch(const cagedyn_model *model)
{
    cagedyn_batch *batch = cagedyn_batch_new();
    cagedyn_sim *sim = cagedyn_sim_new(model);
    CHECK(cagedyn_batch_add(batch, sim) == 0);
    cagedyn_monitor *monitor = cagedyn_monitor_new(batch);
    pthread_t thread;
    CHECK(pthread_create(&thread, NULL, run_batch, batch) == 0);
    double progress[6], time = -1.0;
    int64_t n = cagedyn_progress_count();
    do {
        CHECK(n <= 6 && cagedyn_monitor_progress(monitor, progress, n) == CAGEDYN_OK);
    } while (progress[2] == 0.0 && progress[3] == 0.0);
    int busy = cagedyn_sim_time(sim, &time);
    if (busy != CAGEDYN_OK) {
        CHECK(busy == CAGEDYN_ERR_BUSY && time == -1.0 && cagedyn_sim_step(sim, 1e-6) == CAGEDYN_ERR_BUSY);
        CHECK_FAILS(cagedyn_batch_advance_to(batch, 0.03, 1), CAGEDYN_ERR_BUSY, "batch: is used by another thread");
    }
    void *failed = batch;
    CHECK(pthread_join(thread, &failed) == 0 && failed == NULL);
    CHECK(cagedyn_sim_time(sim, &time) == CAGEDYN_OK && time == 0.02);
    cagedyn_batch_free(batch);
    cagedyn_monitor_free(monitor);
}

int main(int argc, char **argv)
{
    cagedyn_model *model = load_model(argc, argv);
    use_of_a_running_batch(model);
    int64_t n = cagedyn_model_state_count(model);
    job alone[THREADS], together[THREADS];
    pthread_t thread[THREADS];
    for (int i = 0; i < THREADS; i++) {
        alone[i].model = together[i].model = model;
        alone[i].speed = together[i].speed = -100.0 - 200.0 * i;
        alone[i].state = numbers(n);
        together[i].state = numbers(n);
        run(&alone[i]);
    }
    for (int i = 0; i < THREADS; i++) CHECK(pthread_create(&thread[i], NULL, run, &together[i]) == 0);
    for (int i = 0; i < THREADS; i++) {
        CHECK(pthread_join(thread[i], NULL) == 0);
        CHECK(alone[i].status == CAGEDYN_OK && together[i].status == CAGEDYN_OK);
        CHECK(memcmp(alone[i].state, together[i].state, (size_t)n * sizeof(double)) == 0);
        free(alone[i].state);
        free(together[i].state);
    }
    cagedyn_model_free(model);
    return failures != 0;
}
