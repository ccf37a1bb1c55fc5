/* What ends a run from outside, and what can still be asked afterwards. */
#define _POSIX_C_SOURCE 200112L
#include <math.h>
#include <pthread.h>
#include <time.h>

#include "check.h"

/* Cancels after a while. */
static void *cancel_soon(void *canceller)
{
    struct timespec pause = {0, 50 * 1000 * 1000};
    nanosleep(&pause, NULL);
    CHECK(cagedyn_canceller_cancel((const cagedyn_canceller *)canceller) == CAGEDYN_OK);
    return NULL;
}

/* The run ended somewhere in the middle; everything can be asked for there, and the run goes on. */
static void check_in_the_middle(cagedyn_sim *sim)
{
    double time = 0.0, output = NAN;
    CHECK(cagedyn_sim_time(sim, &time) == CAGEDYN_OK && time > 0.0 && time < 1e3);
    CHECK(cagedyn_sim_get_output(sim, 0, &output) == CAGEDYN_OK && isfinite(output));
    CHECK(cagedyn_sim_set_wall_time_limit(sim, INFINITY) == CAGEDYN_OK);
    CHECK(cagedyn_sim_advance_to(sim, time + 1e-4) == CAGEDYN_OK);
}

static void check_limits(cagedyn_sim *sim)
{
    CHECK_FAILS(cagedyn_sim_set_wall_time_limit(sim, NAN), CAGEDYN_ERR_BAD_VALUE, "seconds: NaN");
    CHECK_FAILS(cagedyn_sim_set_wall_time_limit(sim, -1.0), CAGEDYN_ERR_BAD_VALUE, "seconds: -1");
    /* Long enough for a step, however slow the machine. */
    double time = 0.0;
    for (double seconds = 0.05; time == 0.0 && seconds < 100.0; seconds *= 2.0) {
        CHECK(cagedyn_sim_set_wall_time_limit(sim, seconds) == CAGEDYN_OK);
        CHECK_FAILS(cagedyn_sim_advance_to(sim, 1e3), CAGEDYN_ERR_OUT_OF_TIME, "wall time");
        CHECK(cagedyn_sim_time(sim, &time) == CAGEDYN_OK);
    }
    CHECK_FAILS(cagedyn_sim_advance_to(sim, 1e3), CAGEDYN_ERR_OUT_OF_TIME, "at t = ");
    check_in_the_middle(sim);
}

static void check_cancelling(cagedyn_sim *sim)
{
    pthread_t thread;
    cagedyn_canceller *canceller = cagedyn_canceller_new(sim);
    CHECK(canceller != NULL);
    CHECK(pthread_create(&thread, NULL, cancel_soon, canceller) == 0);
    CHECK_FAILS(cagedyn_sim_advance_to(sim, 1e3), CAGEDYN_ERR_CANCELLED, "stopped on request");
    CHECK(pthread_join(thread, NULL) == 0);
    check_in_the_middle(sim);

    /* A request between two calls meets the next one. */
    CHECK(cagedyn_canceller_cancel(canceller) == CAGEDYN_OK);
    CHECK_FAILS(cagedyn_sim_step(sim, 1e-3), CAGEDYN_ERR_CANCELLED, "stopped on request");
    CHECK(cagedyn_sim_step(sim, 1e-3) == CAGEDYN_OK);

    CHECK_FAILS(cagedyn_canceller_cancel(NULL), CAGEDYN_ERR_NULL_ARGUMENT, "canceller: is NULL");
    CHECK(cagedyn_canceller_new(NULL) == NULL);
    cagedyn_canceller_free(NULL);
    cagedyn_canceller_free(canceller);
}

static double item(const double *balance, const char *name)
{
    for (int64_t i = 0; i < cagedyn_balance_count(); i++)
        if (strcmp(cagedyn_balance_name(i), name) == 0) return balance[i];
    CHECK(!"a known item");
    return NAN;
}

static void check_balance(cagedyn_sim *sim)
{
    int64_t n = cagedyn_balance_count();
    double *balance = numbers(n);
    CHECK(strcmp(cagedyn_balance_name(-1), "") == 0 && strcmp(cagedyn_balance_name(n), "") == 0);
    CHECK(cagedyn_sim_reset(sim) == CAGEDYN_OK);
    CHECK(cagedyn_sim_advance_to(sim, 0.01) == CAGEDYN_OK);
    CHECK_FAILS(cagedyn_sim_power_balance(sim, balance, n - 1), CAGEDYN_ERR_WRONG_SIZE, "out: length");
    CHECK_FAILS(cagedyn_sim_power_balance(sim, NULL, n), CAGEDYN_ERR_NULL_ARGUMENT, "out: is NULL");
    CHECK(cagedyn_sim_power_balance(sim, balance, n) == CAGEDYN_OK);
    CHECK(item(balance, "from") == 0.0 && item(balance, "to") >= 0.01);
    CHECK(item(balance, "ring_drive") > 0.0 && item(balance, "raceway_friction") < 0.0);
    CHECK(fabs(item(balance, "relative_residual")) < 1e-3);
    free(balance);
}

int main(int argc, char **argv)
{
    cagedyn_model *model = load_model(argc, argv);
    cagedyn_sim *sim = cagedyn_sim_new(model);
    CHECK(sim != NULL);
    check_limits(sim);
    check_cancelling(sim);
    check_balance(sim);
    cagedyn_sim_free(sim);
    cagedyn_model_free(model);
    return failures != 0;
}
