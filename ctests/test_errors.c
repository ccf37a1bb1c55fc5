/* Every wrong argument is an error with a message, and changes nothing. */
#include <math.h>

#include "check.h"

static void check_texts(void)
{
    CHECK(strcmp(cagedyn_status_name(CAGEDYN_OK), "OK") == 0);
    CHECK(strcmp(cagedyn_status_name(CAGEDYN_ERR_BAD_SCENE), "ERR_BAD_SCENE") == 0);
    CHECK(strcmp(cagedyn_status_name(12345), "UNKNOWN") == 0);

    const char *bad[] = {"", "{", "[]", "nonsense", "{\"schema\": 3}", "\xff\xfe", "null"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        CHECK(cagedyn_model_from_json(bad[i]) == NULL);
        int32_t status = cagedyn_error_status();
        CHECK(status == CAGEDYN_ERR_BAD_JSON || status == CAGEDYN_ERR_BAD_TEXT);
        CHECK(cagedyn_error_message()[0] != '\0');
        CHECK(strchr(cagedyn_error_message(), '\n') == NULL);
    }
    CHECK(cagedyn_model_from_json(NULL) == NULL);
    CHECK(cagedyn_error_status() == CAGEDYN_ERR_NULL_ARGUMENT);
    CHECK(cagedyn_model_from_file(NULL) == NULL);
    CHECK(cagedyn_model_from_file("no/such/file.json") == NULL);
    CHECK(cagedyn_error_status() == CAGEDYN_ERR_FILE);
    CHECK(cagedyn_model_from_json_with("{}", NULL) == NULL);
    CHECK(cagedyn_error_status() == CAGEDYN_ERR_NULL_ARGUMENT);
}

/* A host may keep the pointer: it leads to what the last call left there, never into memory that was freed. */
static void check_kept_message(const cagedyn_model *m)
{
    char path[2000];
    memset(path, 'x', sizeof path);
    path[sizeof path - 1] = '\0';
    CHECK(cagedyn_model_from_file("x") == NULL);
    const char *kept = cagedyn_error_message();
    CHECK(cagedyn_model_from_file(path) == NULL);
    CHECK(kept == cagedyn_error_message() && strstr(kept, "xxxx") != NULL);
    cagedyn_sim *sim = cagedyn_sim_new(m);
    CHECK(cagedyn_sim_step(sim, -1.0) != CAGEDYN_OK && strncmp(kept, "dt", 2) == 0);
    cagedyn_sim_free(sim);
    CHECK(strncmp(kept, "dt", 2) == 0);
    CHECK(cagedyn_sim_new(NULL) == NULL && cagedyn_model_state_count(m) > 0 && *kept == '\0');
}

/* Also where the code of a search is used as an index at once. */
static void check_nearest_name(const cagedyn_model *m, cagedyn_sim *sim)
{
    double value = 7.0;
    CHECK_FAILS(cagedyn_model_find_output(m, "cage.y_ration"), CAGEDYN_ERR_UNKNOWN_NAME,
                "'cage.y_ration', the nearest is 'cage.y_ratio'");
    CHECK_FAILS(cagedyn_sim_get_output(sim, cagedyn_model_find_output(m, "cage.zratio"), &value), CAGEDYN_ERR_BAD_INDEX,
                "'cage.zratio', the nearest is 'cage.z_ratio'");
    CHECK_FAILS(cagedyn_model_find_input(m, "inner_ring.sped"), CAGEDYN_ERR_UNKNOWN_NAME, "'inner_ring.speed'");
    CHECK(value == 7.0);
}

static void check_null_handles(void)
{
    double x[3] = {1.0, 2.0, 3.0};
    const int32_t null = CAGEDYN_ERR_NULL_ARGUMENT;
    CHECK(cagedyn_law_count() > 0 && cagedyn_model_state_count(NULL) < 0);
    CHECK(cagedyn_sim_new_with_preset(NULL, CAGEDYN_PRESET_DRAFT) == NULL && cagedyn_sim_new(NULL) == NULL);
    CHECK(cagedyn_error_status() == CAGEDYN_ERR_NULL_ARGUMENT);
    CHECK_FAILS(cagedyn_model_state_count(NULL), null, "model");
    CHECK_FAILS(cagedyn_model_position_count(NULL), null, "model");
    CHECK_FAILS(cagedyn_model_velocity_count(NULL), null, "model");
    CHECK(cagedyn_model_scene_json(NULL)[0] == '\0');
    CHECK_FAILS(cagedyn_sim_reset(NULL), null, "sim");
    CHECK_FAILS(cagedyn_sim_time(NULL, x), null, "sim");
    CHECK_FAILS(cagedyn_sim_get_state(NULL, x, 3), null, "sim");
    CHECK_FAILS(cagedyn_sim_set_state(NULL, 0.0, x, 3), null, "sim");
    CHECK_FAILS(cagedyn_sim_derivative(NULL, 0.0, x, x, 3), null, "sim");
    CHECK_FAILS(cagedyn_sim_jacobian(NULL, 0.0, x, 3, x, 3), null, "sim");
    CHECK_FAILS(cagedyn_sim_linearize(NULL, 0.0, x, 3), null, "sim");
    CHECK_FAILS(cagedyn_sim_factorize(NULL, 1e-6), null, "sim");
    CHECK_FAILS(cagedyn_sim_solve(NULL, x, 3), null, "sim");
    CHECK_FAILS(cagedyn_sim_step(NULL, 0.0), null, "sim");
    CHECK_FAILS(cagedyn_sim_advance_to(NULL, 0.0), null, "sim");
    CHECK_FAILS(cagedyn_sim_accelerations(NULL, x, 3), null, "sim");
    CHECK_FAILS(cagedyn_sim_contact_forces(NULL, x, 3), null, "sim");
    CHECK_FAILS(cagedyn_sim_body_forces(NULL, x, 3), null, "sim");
    CHECK_FAILS(cagedyn_sim_get_input(NULL, 0, x), null, "sim");
    CHECK_FAILS(cagedyn_sim_set_input(NULL, 0, 0.0), null, "sim");
    CHECK_FAILS(cagedyn_sim_release_input(NULL, 0), null, "sim");
    CHECK_FAILS(cagedyn_sim_get_outputs(NULL, x, 3), null, "sim");
    CHECK_FAILS(cagedyn_sim_get_output(NULL, 0, x), null, "sim");
    CHECK_FAILS(cagedyn_sim_save_length(NULL), null, "sim");
    CHECK_FAILS(cagedyn_sim_save(NULL, x, 3), null, "sim");
    CHECK_FAILS(cagedyn_sim_restore(NULL, x, 3), null, "sim");
    CHECK_FAILS(cagedyn_sim_statistics(NULL, x, 3), null, "sim");
    CHECK(x[0] == 1.0 && x[1] == 2.0 && x[2] == 3.0);
}

static void check_arrays(const cagedyn_model *m, cagedyn_sim *sim)
{
    int64_t n = cagedyn_model_state_count(m);
    double *x = numbers(n), *y = numbers(n), *before = numbers(n);
    const int32_t size = CAGEDYN_ERR_WRONG_SIZE, null = CAGEDYN_ERR_NULL_ARGUMENT;
    x[0] = 7.0;
    CHECK_FAILS(cagedyn_sim_get_state(sim, x, n - 1), size, "state");
    CHECK_FAILS(cagedyn_sim_get_state(sim, x, -1), size, "state");
    CHECK_FAILS(cagedyn_sim_get_state(sim, NULL, n), null, "state");
    CHECK_FAILS(cagedyn_sim_set_state(sim, 0.0, x, n + 1), size, "state");
    CHECK_FAILS(cagedyn_sim_set_state(sim, 0.0, NULL, n), null, "state");
    CHECK_FAILS(cagedyn_sim_derivative(sim, 0.0, x, NULL, n), null, "rate");
    CHECK_FAILS(cagedyn_sim_derivative(sim, 0.0, NULL, x, n), null, "state");
    CHECK_FAILS(cagedyn_sim_accelerations(sim, x, n), size, "out");
    CHECK_FAILS(cagedyn_sim_contact_forces(sim, x, 1), size, "out");
    CHECK_FAILS(cagedyn_sim_body_forces(sim, x, 1), size, "out");
    CHECK_FAILS(cagedyn_sim_get_outputs(sim, NULL, cagedyn_model_output_count(m)), null, "out");
    CHECK_FAILS(cagedyn_sim_get_outputs(sim, x, 1), size, "out");
    CHECK_FAILS(cagedyn_sim_time(sim, NULL), null, "time");
    CHECK_FAILS(cagedyn_sim_statistics(sim, x, 3), size, "out");
    CHECK_FAILS(cagedyn_sim_save(sim, x, 3), size, "out");
    CHECK_FAILS(cagedyn_sim_restore(sim, x, 3), size, "saved");
    CHECK(x[0] == 7.0);

    /* Numbers that are not finite, and a state without a guide film. */
    CHECK(cagedyn_sim_get_state(sim, before, n) == CAGEDYN_OK);
    memcpy(x, before, (size_t)n * sizeof(double));
    x[5] = NAN;
    CHECK_FAILS(cagedyn_sim_set_state(sim, 0.0, x, n), CAGEDYN_ERR_BAD_VALUE, "state[5]");
    y[0] = 7.0;
    CHECK_FAILS(cagedyn_sim_derivative(sim, 0.0, x, y, n), CAGEDYN_ERR_BAD_VALUE, "state[5]");
    x[5] = before[5];
    CHECK_FAILS(cagedyn_sim_set_state(sim, INFINITY, x, n), CAGEDYN_ERR_BAD_VALUE, "time");
    CHECK_FAILS(cagedyn_sim_derivative(sim, NAN, x, y, n), CAGEDYN_ERR_BAD_VALUE, "t:");
    x[2] = 1e-3;
    CHECK_FAILS(cagedyn_sim_set_state(sim, 0.0, x, n), CAGEDYN_ERR_BAD_STATE, "film");
    CHECK_FAILS(cagedyn_sim_derivative(sim, 0.0, x, y, n), CAGEDYN_ERR_BAD_STATE, "film");
    CHECK(y[0] == 7.0);
    CHECK(cagedyn_sim_get_state(sim, x, n) == CAGEDYN_OK);
    CHECK(memcmp(x, before, (size_t)n * sizeof(double)) == 0);
    free(x), free(y), free(before);
}

static void check_newton(const cagedyn_model *m, cagedyn_sim *sim)
{
    int64_t n = cagedyn_model_state_count(m);
    double *state = numbers(n), *x = numbers(n);
    CHECK_FAILS(cagedyn_sim_factorize(sim, 1e-6), CAGEDYN_ERR_BAD_STATE, "linearize");
    CHECK(cagedyn_sim_get_state(sim, state, n) == CAGEDYN_OK);
    CHECK_FAILS(cagedyn_sim_linearize(sim, 0.0, state, n + 1), CAGEDYN_ERR_WRONG_SIZE, "state");
    CHECK_FAILS(cagedyn_sim_linearize(sim, 0.0, NULL, n), CAGEDYN_ERR_NULL_ARGUMENT, "state");
    CHECK(cagedyn_sim_linearize(sim, 0.0, state, n) == CAGEDYN_OK);
    CHECK_FAILS(cagedyn_sim_factorize(sim, -1.0), CAGEDYN_ERR_BAD_VALUE, "gamma");
    CHECK_FAILS(cagedyn_sim_solve(sim, x, n), CAGEDYN_ERR_BAD_STATE, "factorize");
    x[1] = NAN;
    CHECK_FAILS(cagedyn_sim_solve(sim, x, n), CAGEDYN_ERR_BAD_STATE, "factorize");
    CHECK(cagedyn_sim_factorize(sim, 1e-6) == CAGEDYN_OK);
    CHECK_FAILS(cagedyn_sim_solve(sim, x, n), CAGEDYN_ERR_BAD_VALUE, "x[1]");
    x[1] = 0.0;
    CHECK_FAILS(cagedyn_sim_solve(sim, NULL, n), CAGEDYN_ERR_NULL_ARGUMENT, "x");
    CHECK_FAILS(cagedyn_sim_solve(sim, x, n - 1), CAGEDYN_ERR_WRONG_SIZE, "x");
    CHECK(x[0] == 0.0);

    /* A speed of the cage hardly changes within a microsecond, and moves it. */
    int64_t y = cagedyn_model_find_state(m, "cage.y"), v = cagedyn_model_position_count(m) + y;
    x[v] = 1e-3;
    CHECK(cagedyn_sim_solve(sim, x, n) == CAGEDYN_OK);
    CHECK(fabs(x[v] - 1e-3) < 1e-6 && fabs(x[y] - 1e-6 * x[v]) < 1e-18);
    free(state), free(x);
}

static void check_jacobian(const cagedyn_model *m, cagedyn_sim *sim)
{
    int64_t n = cagedyn_model_state_count(m), nn = n * n;
    double *x = numbers(n), *jacobian = numbers(nn);
    const int32_t size = CAGEDYN_ERR_WRONG_SIZE, null = CAGEDYN_ERR_NULL_ARGUMENT;
    const int32_t value = CAGEDYN_ERR_BAD_VALUE;
    for (int64_t i = 0; i < nn; i++) jacobian[i] = 7.0;
    CHECK(cagedyn_sim_get_state(sim, x, n) == CAGEDYN_OK);
    CHECK_FAILS(cagedyn_sim_jacobian(sim, 0.0, NULL, n, jacobian, nn), null, "state");
    CHECK_FAILS(cagedyn_sim_jacobian(sim, 0.0, x, n, NULL, nn), null, "jacobian");
    CHECK_FAILS(cagedyn_sim_jacobian(sim, 0.0, x, n - 1, jacobian, nn), size, "state");
    CHECK_FAILS(cagedyn_sim_jacobian(sim, 0.0, x, -1, jacobian, nn), size, "state");
    CHECK_FAILS(cagedyn_sim_jacobian(sim, 0.0, x, n, jacobian, n), size, "jacobian");
    CHECK_FAILS(cagedyn_sim_jacobian(sim, 0.0, x, n, jacobian, -1), size, "jacobian");
    CHECK_FAILS(cagedyn_sim_jacobian(sim, NAN, x, n, jacobian, nn), value, "t:");
    CHECK_FAILS(cagedyn_sim_jacobian(sim, -1.0, x, n, jacobian, nn), value, "t:");
    x[5] = NAN;
    CHECK_FAILS(cagedyn_sim_jacobian(sim, 0.0, x, n, jacobian, nn), value, "state[5]");
    CHECK(cagedyn_sim_get_state(sim, x, n) == CAGEDYN_OK);
    x[2] = 1e-3;
    CHECK_FAILS(cagedyn_sim_jacobian(sim, 0.0, x, n, jacobian, nn), CAGEDYN_ERR_BAD_STATE, "film");
    for (int64_t i = 0; i < nn; i++) CHECK(jacobian[i] == 7.0);
    free(x), free(jacobian);
}

static void check_values(cagedyn_sim *sim)
{
    double x = 7.0;
    const int32_t index = CAGEDYN_ERR_BAD_INDEX, value = CAGEDYN_ERR_BAD_VALUE;
    CHECK_FAILS(cagedyn_sim_get_input(sim, 3, &x), index, "input");
    CHECK_FAILS(cagedyn_sim_get_input(sim, -1, &x), index, "input");
    CHECK_FAILS(cagedyn_sim_set_input(sim, 99, 0.0), index, "input");
    CHECK_FAILS(cagedyn_sim_set_input(sim, 0, NAN), value, "value");
    CHECK_FAILS(cagedyn_sim_release_input(sim, INT64_MIN), index, "input");
    CHECK_FAILS(cagedyn_sim_get_output(sim, INT64_MAX, &x), index, "output");
    CHECK_FAILS(cagedyn_sim_get_output(sim, 0, NULL), CAGEDYN_ERR_NULL_ARGUMENT, "value");
    CHECK_FAILS(cagedyn_sim_step(sim, -1e-3), value, "dt");
    CHECK_FAILS(cagedyn_sim_step(sim, NAN), value, "dt");
    CHECK_FAILS(cagedyn_sim_advance_to(sim, INFINITY), value, "t:");
    CHECK(x == 7.0);

    /* The object stays usable, and success clears the error. */
    CHECK(cagedyn_sim_step(sim, 1e-4) == CAGEDYN_OK);
    CHECK(cagedyn_error_status() == CAGEDYN_OK && cagedyn_error_message()[0] == '\0');
    CHECK_FAILS(cagedyn_sim_advance_to(sim, 0.0), value, "before the current time");
}

/* A run that cannot go on says so and stays where it is. */
static void check_limits(const cagedyn_model *m)
{
    cagedyn_model *limited = cagedyn_model_from_json_with(cagedyn_model_scene_json(m), "solver.max_steps=50");
    cagedyn_sim *sim = cagedyn_sim_new(limited);
    double time = -1.0;
    CHECK_FAILS(cagedyn_sim_advance_to(sim, 1.0), CAGEDYN_ERR_TOO_MANY_STEPS, "max_steps");
    CHECK(cagedyn_sim_time(sim, &time) == CAGEDYN_OK && time > 0.0 && time < 1.0);
    CHECK(cagedyn_sim_reset(sim) == CAGEDYN_OK);
    CHECK(cagedyn_sim_step(sim, 1e-4) == CAGEDYN_OK);
    cagedyn_sim_free(sim);
    cagedyn_model_free(limited);
}

/* A preset is one of three, and a coarser one takes fewer steps. */
static void check_presets(const cagedyn_model *m)
{
    double steps[2] = {0.0, 0.0}, all[64];
    const int32_t presets[2] = {CAGEDYN_PRESET_DRAFT, CAGEDYN_PRESET_ENGINEERING};
    const int64_t count = cagedyn_statistic_count();
    CHECK(count > 0 && count <= 64);
    for (int i = 0; i < 2; i++) {
        cagedyn_sim *sim = cagedyn_sim_new_with_preset(m, presets[i]);
        CHECK(sim != NULL);
        CHECK(cagedyn_sim_step(sim, 1e-3) == CAGEDYN_OK);
        CHECK(cagedyn_sim_statistics(sim, all, count) == CAGEDYN_OK);
        for (int64_t k = 0; k < count; k++) {
            if (strcmp(cagedyn_statistic_name(k), "steps") == 0) steps[i] = all[k];
        }
        cagedyn_sim_free(sim);
    }
    CHECK(steps[0] > 0.0 && steps[0] < steps[1]);
    for (int32_t wrong = -1; wrong <= 3; wrong += 4) {
        CHECK(cagedyn_sim_new_with_preset(m, wrong) == NULL);
        CHECK(cagedyn_error_status() == CAGEDYN_ERR_BAD_VALUE);
        CHECK(strstr(cagedyn_error_message(), "preset") != NULL);
    }
}

int main(int argc, char **argv)
{
    cagedyn_model *model = load_model(argc, argv);
    cagedyn_sim *sim = cagedyn_sim_new(model);
    CHECK(sim != NULL);
    check_texts();
    check_null_handles();
    check_kept_message(model);
    check_nearest_name(model, sim);
    check_arrays(model, sim);
    check_jacobian(model, sim);
    check_newton(model, sim);
    check_values(sim);
    check_limits(model);
    check_presets(model);
    cagedyn_sim_free(sim);
    cagedyn_model_free(model);
    return failures != 0;
}
