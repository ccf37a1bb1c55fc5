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

int main(int argc, char **argv)
{
    cagedyn_model *model = load_model(argc, argv);
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
