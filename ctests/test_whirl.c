/* Steady whirl: one, a branch over the speed, and what is refused. The scene is that of a greased guide. */
#include "check.h"

static int64_t quantity(const char *name)
{
    return place_of(name, cagedyn_whirl_quantity_name, cagedyn_whirl_quantity_count());
}

int main(int argc, char **argv)
{
    cagedyn_model *model = load_model(argc, argv);
    int64_t n = cagedyn_whirl_quantity_count(), speed = quantity("whirl_speed"), stable = quantity("stable");
    int64_t parameter = quantity("parameter"), place = quantity("eccentricity"), rate = quantity("leading_rate");
    double *x = numbers(n);
    CHECK(n == 11 && speed > 0 && stable > 0 && parameter == 0 && place > 0 && rate > 0);
    CHECK(strcmp(cagedyn_whirl_quantity_name(n), "") == 0 && strcmp(cagedyn_whirl_quantity_name(-1), "") == 0);

    cagedyn_whirl *one = cagedyn_whirl_steady(model);
    CHECK(one != NULL && cagedyn_whirl_point_count(one) == 1 && cagedyn_whirl_wave_count(one) == 0);
    CHECK(cagedyn_whirl_point(one, 0, x, n) == CAGEDYN_OK);
    CHECK(x[speed] > -1963.0 && x[speed] < -1961.0 && x[stable] == 1.0);
    CHECK(x[place] > 134.0e-6 && x[place] < 134.4e-6);
    CHECK(strcmp(cagedyn_whirl_end(one), "range") == 0 && strcmp(cagedyn_whirl_why(one), "") == 0);
    double rates[5], frequencies[5];
    CHECK(cagedyn_whirl_eigenvalue_count(one) == 5);
    CHECK(cagedyn_whirl_eigenvalues(one, 0, rates, frequencies, 5) == CAGEDYN_OK && rates[0] == x[rate]);
    CHECK(cagedyn_whirl_amplitudes(one, 0, x, 0) == CAGEDYN_OK);
    CHECK_FAILS(cagedyn_whirl_point(one, 1, x, n), CAGEDYN_ERR_BAD_INDEX, "point: index 1, there are 1");
    CHECK_FAILS(cagedyn_whirl_point(one, 0, x, n - 1), CAGEDYN_ERR_WRONG_SIZE, "out: length 10, must be 11");
    CHECK_FAILS(cagedyn_whirl_point(one, 0, NULL, n), CAGEDYN_ERR_NULL_ARGUMENT, "out: is NULL");
    rates[0] = -7.0;
    CHECK_FAILS(cagedyn_whirl_eigenvalues(one, 0, rates, NULL, 5), CAGEDYN_ERR_NULL_ARGUMENT, "frequencies: is NULL");
    CHECK(rates[0] == -7.0);
    cagedyn_whirl_free(one);

    cagedyn_whirl *branch = cagedyn_whirl_follow(model, "inner_ring.speed.constant", 314.16, 600.0);
    int64_t count = cagedyn_whirl_point_count(branch);
    CHECK(branch != NULL && count > 3 && strcmp(cagedyn_whirl_end(branch), "range") == 0);
    double before = 0.0;
    for (int64_t i = 0; i < count; i++) {
        CHECK(cagedyn_whirl_point(branch, i, x, n) == CAGEDYN_OK && x[stable] == 1.0 && x[speed] < before);
        before = x[speed];
    }
    CHECK(x[parameter] == 600.0);
    cagedyn_whirl_free(branch);

    /* A branch that is ended keeps its points. */
    cagedyn_watch *watch = cagedyn_watch_new();
    double progress[2];
    CHECK(watch != NULL && cagedyn_watch_cancel(watch) == CAGEDYN_OK);
    CHECK(cagedyn_whirl_steady_with_watch(model, watch) == NULL && cagedyn_error_status() == CAGEDYN_ERR_CANCELLED);
    one = cagedyn_whirl_steady_with_watch(model, watch);
    CHECK(one != NULL && cagedyn_whirl_status(one) == CAGEDYN_OK);
    cagedyn_whirl_free(one);
    CHECK(cagedyn_watch_progress(watch, progress, 2) == CAGEDYN_OK && progress[0] == 1.0 && progress[1] == 1.0);
    /* Long enough for a point, however slow the machine, and too short for the branch. */
    branch = NULL;
    for (double seconds = 0.02; branch == NULL && seconds < 100.0; seconds *= 1.5) {
        CHECK(cagedyn_watch_set_wall_time_limit(watch, seconds) == CAGEDYN_OK);
        branch = cagedyn_whirl_follow_with_watch(model, "inner_ring.speed.constant", 5.0, 1500.0, watch);
        CHECK(branch != NULL || cagedyn_error_status() == CAGEDYN_ERR_OUT_OF_TIME);
    }
    CHECK(cagedyn_whirl_point_count(branch) > 0 && strcmp(cagedyn_whirl_end(branch), "out of time") == 0);
    CHECK_FAILS(cagedyn_whirl_status(branch), CAGEDYN_ERR_OUT_OF_TIME, "wall time");
    CHECK(strstr(cagedyn_whirl_why(branch), "wall time") != NULL);
    cagedyn_whirl_free(branch);
    CHECK_FAILS(cagedyn_watch_set_wall_time_limit(watch, -1.0), CAGEDYN_ERR_BAD_VALUE, "seconds: -1");
    CHECK_FAILS(cagedyn_watch_progress(watch, progress, 1), CAGEDYN_ERR_WRONG_SIZE, "out: length 1, must be 2");
    CHECK_FAILS(cagedyn_watch_cancel(NULL), CAGEDYN_ERR_NULL_ARGUMENT, "watch: is NULL");
    CHECK_FAILS(cagedyn_whirl_status(NULL), CAGEDYN_ERR_NULL_ARGUMENT, "whirl: is NULL");
    cagedyn_watch_free(watch);
    cagedyn_watch_free(NULL);

    CHECK(cagedyn_whirl_steady(NULL) == NULL && cagedyn_error_status() == CAGEDYN_ERR_NULL_ARGUMENT);
    CHECK(cagedyn_whirl_follow(model, "inner_ring.sped", 1.0, 2.0) == NULL);
    CHECK(cagedyn_error_status() == CAGEDYN_ERR_BAD_JSON && strstr(cagedyn_error_message(), "sped") != NULL);
    CHECK(cagedyn_whirl_follow(model, NULL, 1.0, 2.0) == NULL && cagedyn_error_status() == CAGEDYN_ERR_NULL_ARGUMENT);
    CHECK(cagedyn_whirl_follow(model, "inner_ring.speed.constant", 300.0, 300.0) == NULL);
    CHECK(cagedyn_error_status() == CAGEDYN_ERR_BAD_VALUE && strstr(cagedyn_error_message(), "range") != NULL);
    CHECK(cagedyn_whirl_point_count(NULL) == CAGEDYN_ERR_NULL_ARGUMENT);
    CHECK(strcmp(cagedyn_whirl_end(NULL), "") == 0 && strcmp(cagedyn_whirl_why(NULL), "") == 0);
    cagedyn_whirl_free(NULL);

    free(x);
    cagedyn_model_free(model);
    return failures != 0;
}
