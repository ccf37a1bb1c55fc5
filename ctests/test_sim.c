/* State, forces, stepping, inputs, outputs, saving and restoring. */
#include <math.h>

#include "check.h"

enum { STATISTICS = 31 };

static void check_state_and_derivative(const cagedyn_model *m)
{
    int64_t n = cagedyn_model_state_count(m), nq = cagedyn_model_position_count(m), nv = n - nq;
    double *state = numbers(n), *rate = numbers(n), *a = numbers(nv);
    cagedyn_sim *sim = cagedyn_sim_new(m);
    CHECK(sim != NULL);
    CHECK(cagedyn_sim_get_state(sim, state, n) == CAGEDYN_OK);

    /* The derivative of the present state holds the velocities and the accelerations. */
    CHECK(cagedyn_sim_derivative(sim, 0.0, state, rate, n) == CAGEDYN_OK);
    CHECK(cagedyn_sim_accelerations(sim, a, nv) == CAGEDYN_OK);
    CHECK(memcmp(rate, state + nq, (size_t)nq * sizeof(double)) == 0);
    CHECK(memcmp(rate + nq, a, (size_t)nv * sizeof(double)) == 0);

    /* The same array for state and rate. */
    CHECK(cagedyn_sim_derivative(sim, 0.0, state, state, n) == CAGEDYN_OK);
    CHECK(memcmp(rate, state, (size_t)n * sizeof(double)) == 0);

    /* A changed state is taken over with its time. */
    double time = -1.0;
    CHECK(cagedyn_sim_get_state(sim, state, n) == CAGEDYN_OK);
    state[2] = 50e-6;
    CHECK(cagedyn_sim_set_state(sim, 0.25, state, n) == CAGEDYN_OK);
    CHECK(cagedyn_sim_time(sim, &time) == CAGEDYN_OK && time == 0.25);
    CHECK(cagedyn_sim_get_state(sim, rate, n) == CAGEDYN_OK && rate[2] == 50e-6);
    cagedyn_sim_free(sim);
    free(state), free(rate), free(a);
}

/* A change of a state that moves forces by about the same share, whatever the unit. */
static double small_change(const cagedyn_model *m, int64_t k)
{
    const char *units[] = {"m", "rad", "m/s", "rad/s"};
    const double changes[] = {1e-9, 25e-9, 1e-5, 25e-5};
    for (int i = 0; i < 4; i++)
        if (strcmp(cagedyn_model_state_unit(m, k), units[i]) == 0) return changes[i];
    CHECK(!"a known unit");
    return NAN;
}

/* Column k of the derivatives over the state by central differences with step h. */
static void difference(cagedyn_sim *sim, double *state, int64_t n, int64_t k, double h, double *out)
{
    double x = state[k], *up = numbers(n);
    state[k] = x + h;
    CHECK(cagedyn_sim_derivative(sim, 1e-3, state, up, n) == CAGEDYN_OK);
    state[k] = x - h;
    CHECK(cagedyn_sim_derivative(sim, 1e-3, state, out, n) == CAGEDYN_OK);
    state[k] = x;
    for (int64_t i = 0; i < n; i++) out[i] = (up[i] - out[i]) / (2.0 * h);
    free(up);
}

static void check_jacobian(const cagedyn_model *m)
{
    int64_t n = cagedyn_model_state_count(m), nn = n * n;
    double *state = numbers(n), *other = numbers(n), *jacobian = numbers(nn), *overlapping = numbers(nn);
    double *coarse = numbers(n), *fine = numbers(n), *size = numbers(n), before[STATISTICS], after[STATISTICS];
    cagedyn_sim *sim = cagedyn_sim_new(m);
    CHECK(cagedyn_sim_advance_to(sim, 1e-3) == CAGEDYN_OK);
    CHECK(cagedyn_sim_get_state(sim, state, n) == CAGEDYN_OK);
    CHECK(cagedyn_sim_statistics(sim, before, STATISTICS) == CAGEDYN_OK);
    CHECK(cagedyn_sim_jacobian(sim, 1e-3, state, n, jacobian, nn) == CAGEDYN_OK);

    /* Entries in units of the largest share that a small change of one state has in a row. */
    for (int64_t k = 0; k < n; k++)
        for (int64_t i = 0; i < n; i++)
            size[i] = fmax(size[i], fabs(jacobian[i + k * n]) * small_change(m, k));
    /* Both differences are off by up to 6e-5 of that, by terms that fall with the square of the step and cancel in
     * the extrapolation; what is left is of fourth order, 5e-9. */
    for (int64_t k = 0; k < n; k++) {
        double h = small_change(m, k);
        difference(sim, state, n, k, h, coarse);
        difference(sim, state, n, k, 0.5 * h, fine);
        for (int64_t i = 0; i < n; i++) {
            double extrapolated = (4.0 * fine[i] - coarse[i]) / 3.0;
            double error = fabs(jacobian[i + k * n] - extrapolated) * h / size[i];
            CHECK(error < 1e-7);
        }
    }

    /* Nothing is changed or counted; the state may lie inside of the matrix. */
    memcpy(overlapping + 3, state, (size_t)n * sizeof(double));
    CHECK(cagedyn_sim_jacobian(sim, 1e-3, overlapping + 3, n, overlapping, nn) == CAGEDYN_OK);
    CHECK(memcmp(jacobian, overlapping, (size_t)nn * sizeof(double)) == 0);
    CHECK(cagedyn_sim_get_state(sim, other, n) == CAGEDYN_OK);
    CHECK(memcmp(state, other, (size_t)n * sizeof(double)) == 0);
    CHECK(cagedyn_sim_statistics(sim, after, STATISTICS) == CAGEDYN_OK);
    CHECK(memcmp(before, after, sizeof before) == 0);
    cagedyn_sim_free(sim);
    free(state), free(other), free(jacobian), free(overlapping), free(coarse), free(fine), free(size);
}

static void check_forces(const cagedyn_model *m)
{
    int64_t bodies = cagedyn_model_body_count(m), sources = cagedyn_model_force_source_count(m);
    int64_t components = cagedyn_model_force_component_count(m);
    int64_t z = cagedyn_model_find_force_component(m, "force_z");
    int64_t contacts = cagedyn_model_contact_count(m), columns = cagedyn_model_contact_quantity_count(m);
    double *force = numbers(bodies * sources * components), *contact = numbers(contacts * columns);
    cagedyn_sim *sim = cagedyn_sim_new(m);
    CHECK(cagedyn_sim_body_forces(sim, force, bodies * sources * components) == CAGEDYN_OK);
    CHECK(cagedyn_sim_contact_forces(sim, contact, contacts * columns) == CAGEDYN_OK);

    /* At the static start the raceways carry load and weight of the ring. */
    int64_t ring = cagedyn_model_find_body(m, "inner_ring");
    int64_t raceway = cagedyn_model_find_force_source(m, "inner_raceway");
    int64_t load = cagedyn_model_find_force_source(m, "load");
    double up = force[(ring * sources + raceway) * components + z],
           down = force[(ring * sources + load) * components + z];
    CHECK(down == -4900.0);
    CHECK(fabs(up - (4900.0 + 3.0 * 9.80665)) < 60.0);

    /* The sum over the contacts of one column is the sum the raceways report. */
    int64_t q = cagedyn_model_find_contact_quantity(m, "normal_force");
    double sum = 0.0;
    for (int64_t i = 0; i < contacts; i++) sum += contact[i * columns + q];
    CHECK(sum > 2.0 * 4900.0);
    cagedyn_sim_free(sim);
    free(force), free(contact);
}

static void check_steps_and_outputs(const cagedyn_model *m)
{
    int64_t n = cagedyn_model_output_count(m), states = cagedyn_model_state_count(m);
    double *all = numbers(n), *one = numbers(states), *many = numbers(states), count[STATISTICS], time = 0.0;
    cagedyn_sim *sim = cagedyn_sim_new(m), *other = cagedyn_sim_new(m);

    /* Many small calls give the trajectory of one call. */
    CHECK(cagedyn_sim_advance_to(sim, 2e-3) == CAGEDYN_OK);
    for (int i = 1; i <= 333; i++) CHECK(cagedyn_sim_advance_to(other, 2e-3 * i / 333.0) == CAGEDYN_OK);
    CHECK(cagedyn_sim_get_state(sim, one, states) == CAGEDYN_OK);
    CHECK(cagedyn_sim_get_state(other, many, states) == CAGEDYN_OK);
    CHECK(memcmp(one, many, (size_t)states * sizeof(double)) == 0);
    CHECK(cagedyn_sim_step(sim, 1e-3) == CAGEDYN_OK);
    CHECK(cagedyn_sim_time(sim, &time) == CAGEDYN_OK && fabs(time - 3e-3) < 1e-15);

    CHECK(cagedyn_sim_get_outputs(sim, all, n) == CAGEDYN_OK);
    for (int64_t i = 0; i < n; i++) {
        double value = NAN;
        CHECK(cagedyn_sim_get_output(sim, i, &value) == CAGEDYN_OK);
        CHECK(value == all[i] && isfinite(value));
    }
    CHECK(cagedyn_statistic_count() == STATISTICS);
    CHECK(strcmp(cagedyn_statistic_name(0), "steps") == 0);
    CHECK(strcmp(cagedyn_statistic_name(STATISTICS - 1), "radau_steps") == 0);
    CHECK(cagedyn_statistic_name(STATISTICS)[0] == '\0');
    CHECK(cagedyn_sim_statistics(sim, count, STATISTICS) == CAGEDYN_OK && count[0] > 100.0);
    CHECK(strstr(cagedyn_sim_report(sim), " steps by leapfrog, ") != NULL);
    CHECK(cagedyn_sim_report(NULL)[0] == '\0');
    CHECK(cagedyn_sim_trust(sim) == CAGEDYN_OK);
    CHECK_FAILS(cagedyn_sim_trust(NULL), CAGEDYN_ERR_NULL_ARGUMENT, "sim: is NULL");
    cagedyn_sim_free(sim);
    cagedyn_sim_free(other);
    free(all), free(one), free(many);
}

/* A run that lost its energy says so, and can still be asked and driven. */
static void check_trust(const cagedyn_model *m)
{
    const char *solver = "solver={\"method\": {\"leapfrog\": {\"step\": 1e-5}}}";
    cagedyn_model *coarse = cagedyn_model_from_json_with(cagedyn_model_scene_json(m), solver);
    cagedyn_sim *sim = cagedyn_sim_new(coarse);
    double output = NAN;
    CHECK(sim != NULL);
    CHECK(cagedyn_sim_advance_to(sim, 2e-3) == CAGEDYN_OK);
    CHECK_FAILS(cagedyn_sim_trust(sim), CAGEDYN_ERR_UNTRUSTED, "leapfrog steps of 1.000e-5 s are unstable");
    CHECK_FAILS(cagedyn_sim_trust(sim), CAGEDYN_ERR_UNTRUSTED, "% of the energy that passed through is missing");
    CHECK(cagedyn_sim_get_output(sim, 0, &output) == CAGEDYN_OK && isfinite(output));
    CHECK(cagedyn_sim_step(sim, 1e-4) == CAGEDYN_OK);
    cagedyn_sim_free(sim);
    cagedyn_model_free(coarse);

    /* Of motion that the host imposes the balance knows nothing. */
    int64_t n = cagedyn_model_state_count(m);
    double *state = numbers(n);
    sim = cagedyn_sim_new(m);
    CHECK(cagedyn_sim_get_state(sim, state, n) == CAGEDYN_OK);
    CHECK(cagedyn_sim_advance_to(sim, 1e-3) == CAGEDYN_OK && cagedyn_sim_trust(sim) == CAGEDYN_OK);
    CHECK(cagedyn_sim_set_state(sim, 1e-3, state, n) == CAGEDYN_OK);
    CHECK(cagedyn_sim_step(sim, 1e-4) == CAGEDYN_OK);
    CHECK_FAILS(cagedyn_sim_trust(sim), CAGEDYN_ERR_NOT_JUDGED, "set the state once");
    cagedyn_sim_free(sim);
    free(state);
}

/* Extremes and impulses between two times, from every step. */
static void check_intervals(const cagedyn_model *m)
{
    cagedyn_sim *sim = cagedyn_sim_new(m);
    int64_t length = cagedyn_interval_count(), force = cagedyn_model_find_output(m, "roller[3].pocket_force");
    double *interval = numbers(length), *sum = numbers(length), value = NAN;
    CHECK(cagedyn_model_watched_count(m) == 12);
    CHECK(cagedyn_model_watched_output(m, 3) == force);
    CHECK_FAILS(cagedyn_model_watched_output(m, 12), CAGEDYN_ERR_BAD_INDEX, "index");
    CHECK(strcmp(cagedyn_interval_name(2), "min") == 0 && strcmp(cagedyn_interval_name(length), "") == 0);
    for (int k = 1; k <= 40; k++) {
        CHECK(cagedyn_sim_begin_interval(sim) == CAGEDYN_OK);
        CHECK(cagedyn_sim_step(sim, 1e-4) == CAGEDYN_OK);
        CHECK(cagedyn_sim_get_interval(sim, force, interval, length) == CAGEDYN_OK);
        CHECK(interval[0] <= interval[1] && interval[2] <= interval[4] && interval[4] <= interval[3]);
        CHECK(fabs(interval[5] - interval[4] * (interval[1] - interval[0])) <= 1e-15 + 1e-12 * fabs(interval[5]));
        sum[5] += interval[5];
        if (k == 1 || interval[3] > sum[3]) sum[3] = interval[3];
    }
    CHECK(cagedyn_sim_reset(sim) == CAGEDYN_OK && cagedyn_sim_advance_to(sim, 4e-3) == CAGEDYN_OK);
    CHECK(cagedyn_sim_get_interval(sim, force, interval, length) == CAGEDYN_OK);
    CHECK(interval[0] == 0.0 && interval[1] == 4e-3 && interval[3] == sum[3]);
    CHECK(fabs(interval[5] - sum[5]) < 1e-12);
    CHECK(cagedyn_sim_get_output(sim, force, &value) == CAGEDYN_OK && value <= interval[3] + 1e-9);

    interval[0] = -1.0;
    CHECK_FAILS(cagedyn_sim_get_interval(sim, 0, interval, length), CAGEDYN_ERR_BAD_VALUE, "record.extremes");
    CHECK_FAILS(cagedyn_sim_get_interval(sim, -1, interval, length), CAGEDYN_ERR_BAD_INDEX, "output");
    CHECK_FAILS(cagedyn_sim_get_interval(sim, force, interval, length - 1), CAGEDYN_ERR_WRONG_SIZE, "out");
    CHECK_FAILS(cagedyn_sim_get_interval(NULL, force, interval, length), CAGEDYN_ERR_NULL_ARGUMENT, "sim");
    CHECK_FAILS(cagedyn_sim_begin_interval(NULL), CAGEDYN_ERR_NULL_ARGUMENT, "sim");
    CHECK(interval[0] == -1.0);
    cagedyn_sim_free(sim);
    free(interval), free(sum);
}

/* A step that cannot be made to its end leaves the last one that could. */
static void check_failed_advance(const cagedyn_model *m)
{
    cagedyn_model *few = cagedyn_model_from_json_with(cagedyn_model_scene_json(m), "solver.max_steps=50");
    cagedyn_sim *sim = cagedyn_sim_new(few);
    int64_t n = cagedyn_model_state_count(m);
    double time = NAN, *before = numbers(n), *after = numbers(n);
    CHECK(sim != NULL && cagedyn_sim_get_state(sim, before, n) == CAGEDYN_OK);
    CHECK_FAILS(cagedyn_sim_advance_to(sim, -1.0), CAGEDYN_ERR_BAD_VALUE, "t");
    CHECK_FAILS(cagedyn_sim_step(sim, NAN), CAGEDYN_ERR_BAD_VALUE, "dt");
    CHECK(cagedyn_sim_time(sim, &time) == CAGEDYN_OK && time == 0.0);
    CHECK_FAILS(cagedyn_sim_advance_to(sim, 1.0), CAGEDYN_ERR_TOO_MANY_STEPS, "max_steps");
    CHECK(cagedyn_sim_time(sim, &time) == CAGEDYN_OK && time > 0.0 && time < 1.0);
    CHECK(cagedyn_sim_get_state(sim, after, n) == CAGEDYN_OK && memcmp(before, after, (size_t)n * sizeof(double)) != 0);
    CHECK(cagedyn_sim_step(sim, 1e-6) == CAGEDYN_OK);
    cagedyn_sim_free(sim);
    cagedyn_model_free(few);
    free(before), free(after);
}

/* Why there is no model is still known when everything that follows from it has been tried. */
static void check_errors_that_stay(void)
{
    cagedyn_model *model = cagedyn_model_from_file("no/such/scene.json");
    cagedyn_sim *sim = cagedyn_sim_new(model);
    CHECK(model == NULL && sim == NULL);
    CHECK(strstr(cagedyn_error_message(), "no/such/scene.json") != NULL);
    CHECK(cagedyn_error_status() == CAGEDYN_ERR_FILE);
    cagedyn_sim_free(sim);
    cagedyn_model_free(model);
    cagedyn_canceller_free(NULL);
    CHECK(cagedyn_error_status() == CAGEDYN_ERR_FILE);
    model = cagedyn_model_from_json("{");
    CHECK(model == NULL && cagedyn_sim_new_with_preset(model, 7) == NULL);
    CHECK(cagedyn_error_status() == CAGEDYN_ERR_BAD_JSON);
    /* Without an error before it, NULL is the error. */
    CHECK(cagedyn_law_count() > 0 && cagedyn_sim_new(NULL) == NULL);
}

static void check_inputs(const cagedyn_model *m)
{
    cagedyn_sim *sim = cagedyn_sim_new(m);
    int64_t load = cagedyn_model_find_input(m, "load.z");
    int64_t ring = cagedyn_model_find_output(m, "inner_ring.z");
    double value = 0.0, before = 0.0, after = 0.0;
    CHECK(cagedyn_sim_get_input(sim, load, &value) == CAGEDYN_OK && value == -4900.0);
    CHECK(cagedyn_sim_advance_to(sim, 1e-3) == CAGEDYN_OK);
    CHECK(cagedyn_sim_get_output(sim, ring, &before) == CAGEDYN_OK);
    CHECK(cagedyn_sim_set_input(sim, load, -9800.0) == CAGEDYN_OK);
    CHECK(cagedyn_sim_get_input(sim, load, &value) == CAGEDYN_OK && value == -9800.0);
    CHECK(cagedyn_sim_step(sim, 4e-3) == CAGEDYN_OK);
    CHECK(cagedyn_sim_get_output(sim, ring, &after) == CAGEDYN_OK);
    CHECK(after < before - 1e-6);
    CHECK(cagedyn_sim_release_input(sim, load) == CAGEDYN_OK);
    CHECK(cagedyn_sim_get_input(sim, load, &value) == CAGEDYN_OK && value == -4900.0);
    cagedyn_sim_free(sim);
}

static void check_save_and_reset(const cagedyn_model *m)
{
    int64_t n = cagedyn_model_state_count(m);
    double *first = numbers(n), *again = numbers(n), *start = numbers(n);
    size_t bytes = (size_t)n * sizeof(double);
    cagedyn_sim *sim = cagedyn_sim_new(m), *other = cagedyn_sim_new(m);
    int64_t length = cagedyn_sim_save_length(sim);
    double *saved = numbers(length);
    CHECK(cagedyn_sim_get_state(sim, start, n) == CAGEDYN_OK);
    CHECK(cagedyn_sim_set_input(sim, 0, -300.0) == CAGEDYN_OK);
    CHECK(cagedyn_sim_advance_to(sim, 1.2345e-3) == CAGEDYN_OK);
    CHECK(cagedyn_sim_save(sim, saved, length) == CAGEDYN_OK);
    CHECK(cagedyn_sim_advance_to(sim, 3e-3) == CAGEDYN_OK);
    CHECK(cagedyn_sim_get_state(sim, first, n) == CAGEDYN_OK);
    CHECK(cagedyn_sim_restore(other, saved, length) == CAGEDYN_OK);
    CHECK(cagedyn_sim_advance_to(other, 3e-3) == CAGEDYN_OK);
    CHECK(cagedyn_sim_get_state(other, again, n) == CAGEDYN_OK);
    CHECK(memcmp(first, again, bytes) == 0);

    CHECK(cagedyn_sim_reset(sim) == CAGEDYN_OK);
    CHECK(cagedyn_sim_get_state(sim, again, n) == CAGEDYN_OK && memcmp(start, again, bytes) == 0);

    saved[1] += 1.0;
    CHECK_FAILS(cagedyn_sim_restore(other, saved, length), CAGEDYN_ERR_BAD_SNAPSHOT, "other physics");
    CHECK(cagedyn_sim_get_state(other, again, n) == CAGEDYN_OK && memcmp(first, again, bytes) == 0);
    cagedyn_sim_free(sim);
    cagedyn_sim_free(other);
    free(first), free(again), free(start), free(saved);
}

int main(int argc, char **argv)
{
    cagedyn_model *model = load_model(argc, argv);
    check_state_and_derivative(model);
    check_jacobian(model);
    check_forces(model);
    check_steps_and_outputs(model);
    check_trust(model);
    check_intervals(model);
    check_failed_advance(model);
    check_errors_that_stay();
    check_inputs(model);
    check_save_and_reset(model);

    /* A simulation outlives its model. */
    cagedyn_sim *sim = cagedyn_sim_new(model);
    cagedyn_model_free(model);
    CHECK(cagedyn_sim_step(sim, 1e-4) == CAGEDYN_OK);
    cagedyn_sim_free(sim);
    cagedyn_sim_free(NULL);
    return failures != 0;
}
