/* What hosts with their own integrator ask for: forces, outputs, energies and derivatives at arbitrary states. */
#include <math.h>

#include "check.h"

static double worst(const double *a, const double *b, int64_t n)
{
    double largest = 0.0;
    for (int64_t i = 0; i < n; i++) largest = fmax(largest, fabs(a[i] - b[i]));
    return largest;
}

/* At its own state they are what the simulation says of itself, and asking changes nothing. */
static void check_own_state(const cagedyn_model *m)
{
    int64_t n = cagedyn_model_state_count(m), outputs = cagedyn_model_output_count(m);
    int64_t contacts = cagedyn_model_contact_count(m) * cagedyn_model_contact_quantity_count(m);
    int64_t bodies = cagedyn_model_body_count(m) * cagedyn_model_force_source_count(m)
                     * cagedyn_model_force_component_count(m);
    int64_t save = 0;
    double *state = numbers(n), *shared = numbers(outputs), *own = numbers(outputs);
    double *of_contacts = numbers(contacts), *contacts_at = numbers(contacts);
    double *on_bodies = numbers(bodies), *bodies_at = numbers(bodies);
    cagedyn_sim *sim = cagedyn_sim_new_with_preset(m, CAGEDYN_PRESET_ENGINEERING);
    CHECK(cagedyn_sim_get_state(sim, state, n) == CAGEDYN_OK);
    CHECK(cagedyn_sim_get_outputs(sim, own, outputs) == CAGEDYN_OK);
    CHECK(cagedyn_sim_outputs_at(sim, 0.0, state, n, shared, outputs) == CAGEDYN_OK);
    CHECK(memcmp(own, shared, (size_t)outputs * sizeof(double)) == 0);

    CHECK(cagedyn_sim_advance_to(sim, 1e-3) == CAGEDYN_OK);
    CHECK(cagedyn_sim_get_state(sim, state, n) == CAGEDYN_OK);
    CHECK(cagedyn_sim_contact_forces(sim, of_contacts, contacts) == CAGEDYN_OK);
    CHECK(cagedyn_sim_body_forces(sim, on_bodies, bodies) == CAGEDYN_OK);
    save = cagedyn_sim_save_length(sim);
    double *before = numbers(save), *after = numbers(save);
    CHECK(cagedyn_sim_save(sim, before, save) == CAGEDYN_OK);
    CHECK(cagedyn_sim_contact_forces_at(sim, 1e-3, state, n, contacts_at, contacts) == CAGEDYN_OK);
    CHECK(cagedyn_sim_body_forces_at(sim, 1e-3, state, n, bodies_at, bodies) == CAGEDYN_OK);
    CHECK(memcmp(of_contacts, contacts_at, (size_t)contacts * sizeof(double)) == 0);
    CHECK(memcmp(on_bodies, bodies_at, (size_t)bodies * sizeof(double)) == 0);

    /* Elsewhere they differ, and the simulation goes on as if nobody had asked. */
    double *moved = numbers(n);
    memcpy(moved, state, (size_t)n * sizeof(double));
    moved[cagedyn_model_find_state(m, "inner_ring.z")] -= 1e-6;
    CHECK(cagedyn_sim_contact_forces_at(sim, 1e-3, moved, n, contacts_at, contacts) == CAGEDYN_OK);
    CHECK(worst(of_contacts, contacts_at, contacts) > 100.0);
    CHECK(cagedyn_sim_contact_forces(sim, contacts_at, contacts) == CAGEDYN_OK);
    CHECK(memcmp(of_contacts, contacts_at, (size_t)contacts * sizeof(double)) == 0);
    CHECK(cagedyn_sim_save(sim, after, save) == CAGEDYN_OK);
    CHECK(memcmp(before, after, (size_t)save * sizeof(double)) == 0);

    /* Rates may take the place of their state. */
    double *rate = numbers(n);
    CHECK(cagedyn_sim_derivative(sim, 1e-3, moved, rate, n) == CAGEDYN_OK);
    CHECK(cagedyn_sim_derivative(sim, 1e-3, moved, moved, n) == CAGEDYN_OK);
    CHECK(memcmp(rate, moved, (size_t)n * sizeof(double)) == 0);

    CHECK_FAILS(cagedyn_sim_outputs_at(sim, 0.0, state, n - 1, own, outputs), CAGEDYN_ERR_WRONG_SIZE, "state");
    CHECK_FAILS(cagedyn_sim_outputs_at(sim, 0.0, state, n, own, 1), CAGEDYN_ERR_WRONG_SIZE, "out");
    CHECK_FAILS(cagedyn_sim_contact_forces_at(sim, NAN, state, n, of_contacts, contacts),
                CAGEDYN_ERR_BAD_VALUE, "t");
    CHECK_FAILS(cagedyn_sim_body_forces_at(sim, 0.0, NULL, n, on_bodies, bodies), CAGEDYN_ERR_NULL_ARGUMENT,
                "state");
    cagedyn_sim_free(sim);
    free(state), free(shared), free(own), free(of_contacts), free(contacts_at), free(on_bodies), free(bodies_at);
    free(before), free(after), free(moved), free(rate);
}

/* Forces drawn from points, normals and the parts of each contact are those on the rollers. */
static void check_drawn_forces(const cagedyn_model *m)
{
    const char *names[] = {"normal_force",          "friction", "rolling_resistance", "film_pressure_roller",
                           "normal_y",              "normal_z", "point_y",            "point_z",
                           "surface_speed_roller",  "slip_speed", "surface_speed_mate", "half_width",
                           "mean_pressure",         "rolling_thermal_factor"};
    enum { NORMAL, FRICTION, ROLLING, PRESSURE, NY, NZ, PY, PZ, U1, SLIP, U2, WIDTH, MEAN, FACTOR, ITEMS };
    int64_t column[ITEMS], n = cagedyn_model_state_count(m), q = cagedyn_model_contact_quantity_count(m);
    int64_t contacts = cagedyn_model_contact_count(m), sources = cagedyn_model_force_source_count(m);
    int64_t bodies = cagedyn_model_body_count(m), rollers = 12, loaded = 0;
    double *c = numbers(contacts * q), *b = numbers(bodies * sources * 3), *state = numbers(n);
    double radius = 0.0, pitch = 0.0;
    for (int i = 0; i < ITEMS; i++) CHECK((column[i] = cagedyn_model_find_contact_quantity(m, names[i])) >= 0);
    CHECK(cagedyn_model_get_geometry(m, cagedyn_model_find_geometry(m, "element_radius"), &radius) == CAGEDYN_OK);
    CHECK(cagedyn_model_get_geometry(m, cagedyn_model_find_geometry(m, "pitch_radius"), &pitch) == CAGEDYN_OK);
    CHECK(radius == 7.5e-3 && pitch > 0.03);
    cagedyn_sim *sim = cagedyn_sim_new(m);
    CHECK(cagedyn_sim_advance_to(sim, 2e-3) == CAGEDYN_OK);
    CHECK(cagedyn_sim_get_state(sim, state, n) == CAGEDYN_OK);
    CHECK(cagedyn_sim_contact_forces_at(sim, 2e-3, state, n, c, contacts * q) == CAGEDYN_OK);
    CHECK(cagedyn_sim_body_forces_at(sim, 2e-3, state, n, b, bodies * sources * 3) == CAGEDYN_OK);
    int64_t raceways[] = {cagedyn_model_find_force_source(m, "outer_raceway"),
                          cagedyn_model_find_force_source(m, "inner_raceway"),
                          cagedyn_model_find_force_source(m, "pocket")};
    for (int64_t j = 0; j < rollers; j++) {
        double drawn[2] = {0.0, 0.0}, told[2] = {0.0, 0.0}, largest = 1.0;
        for (int64_t k = j * (contacts / rollers); k < (j + 1) * (contacts / rollers); k++) {
            const double *x = c + k * q;
            double normal = x[column[NORMAL]], ny = x[column[NY]], nz = x[column[NZ]];
            double along = x[column[FRICTION]] + x[column[ROLLING]] + x[column[PRESSURE]];
            drawn[0] += -normal * ny - along * nz;
            drawn[1] += -normal * nz + along * ny;
            largest = fmax(largest, normal);
            if (normal == 0.0) continue;
            loaded++;
            CHECK(fabs(hypot(ny, nz) - 1.0) < 1e-12);
            CHECK(fabs(x[column[U1]] - x[column[U2]] - x[column[SLIP]]) < 1e-12);
            /* A contact with a raceway is a roller radius from the pitch circle. */
            double place = hypot(x[column[PY]], x[column[PZ]]);
            CHECK(fabs(place - pitch) < 1.01 * radius);
            /* P = Q/(2 b l), with l = 20.4 mm or that of the pocket. */
            CHECK(x[column[MEAN]] > 0.0 && normal / (2.0 * x[column[WIDTH]] * x[column[MEAN]]) < 25e-3);
            if (x[column[ROLLING]] != 0.0) CHECK(x[column[FACTOR]] > 0.0 && x[column[FACTOR]] <= 1.0);
        }
        const double *on = b + (bodies - rollers + j) * sources * 3;
        for (int s = 0; s < 3; s++) {
            told[0] += on[raceways[s] * 3];
            told[1] += on[raceways[s] * 3 + 1];
        }
        CHECK(fabs(drawn[0] - told[0]) < 1e-12 * largest && fabs(drawn[1] - told[1]) < 1e-12 * largest);
    }
    CHECK(loaded > 12);
    cagedyn_sim_free(sim);
    free(c), free(b), free(state);
}

/* Sparse derivatives are the dense ones without what is always zero. */
static void check_sparse(const cagedyn_model *m)
{
    int64_t n = cagedyn_model_state_count(m), entries = cagedyn_model_jacobian_entry_count(m), seen = 0;
    double *state = numbers(n), *dense = numbers(n * n), *values = numbers(entries);
    int64_t *starts = (int64_t *)calloc((size_t)(n + 1), sizeof(int64_t));
    int64_t *rows = (int64_t *)calloc((size_t)entries, sizeof(int64_t));
    cagedyn_sim *sim = cagedyn_sim_new(m);
    CHECK(entries > 0 && entries < n * n / 3);
    CHECK(cagedyn_sim_advance_to(sim, 1e-3) == CAGEDYN_OK);
    CHECK(cagedyn_sim_get_state(sim, state, n) == CAGEDYN_OK);
    CHECK(cagedyn_model_jacobian_pattern(m, starts, n + 1, rows, entries) == CAGEDYN_OK);
    CHECK(cagedyn_sim_sparse_jacobian(sim, 1e-3, state, n, values, entries) == CAGEDYN_OK);
    CHECK(cagedyn_sim_jacobian(sim, 1e-3, state, n, dense, n * n) == CAGEDYN_OK);
    CHECK(starts[0] == 0 && starts[n] == entries);
    for (int64_t k = 0; k < n; k++)
        for (int64_t i = starts[k]; i < starts[k + 1]; i++) {
            CHECK(i == starts[k] || rows[i] > rows[i - 1]);
            CHECK(dense[rows[i] + k * n] == values[i]);
            dense[rows[i] + k * n] = 0.0;
            seen++;
        }
    for (int64_t i = 0; i < n * n; i++) CHECK(dense[i] == 0.0);
    CHECK(seen == entries);

    CHECK_FAILS(cagedyn_model_jacobian_pattern(m, starts, n, rows, entries), CAGEDYN_ERR_WRONG_SIZE,
                "column_starts");
    CHECK_FAILS(cagedyn_model_jacobian_pattern(m, starts, n + 1, NULL, entries), CAGEDYN_ERR_NULL_ARGUMENT,
                "rows");
    CHECK_FAILS(cagedyn_sim_sparse_jacobian(sim, 1e-3, state, n, values, n * n), CAGEDYN_ERR_WRONG_SIZE,
                "values");
    cagedyn_sim_free(sim);
    free(state), free(dense), free(values), free(starts), free(rows);
}

/* Every derivative that is not zero stands in the pattern; a load changes no output at once. */
static void check_feedthrough(const cagedyn_model *m, const double *by_inputs, int64_t outputs, int64_t inputs, int64_t load)
{
    int64_t entries = cagedyn_model_feedthrough_entry_count(m), found = 0, of_inputs = 0;
    int64_t *starts = (int64_t *)calloc((size_t)(inputs + 1), sizeof(int64_t));
    int64_t *rows = (int64_t *)calloc((size_t)entries, sizeof(int64_t));
    CHECK(entries > 0 && entries < outputs * inputs);
    CHECK(cagedyn_model_feedthrough_pattern(m, starts, inputs + 1, rows, entries) == CAGEDYN_OK);
    CHECK(starts[0] == 0 && starts[inputs] == entries && starts[load] == starts[load + 1]);
    for (int64_t k = 0; k < inputs; k++)
        for (int64_t i = starts[k]; i < starts[k + 1]; i++) found += by_inputs[rows[i] + k * outputs] != 0.0;
    for (int64_t i = 0; i < outputs * inputs; i++) of_inputs += by_inputs[i] != 0.0;
    CHECK(found == of_inputs && found > 0);
    CHECK_FAILS(cagedyn_model_feedthrough_pattern(m, starts, inputs, rows, entries), CAGEDYN_ERR_WRONG_SIZE,
                "column_starts");
    free(starts), free(rows);
}

/* Derivatives over a load are those of the ring alone; an output that is a state has a one. */
static void check_inputs_and_outputs(const cagedyn_model *m)
{
    int64_t n = cagedyn_model_state_count(m), inputs = cagedyn_model_input_count(m);
    int64_t outputs = cagedyn_model_output_count(m), load = cagedyn_model_find_input(m, "load.z");
    int64_t ring = cagedyn_model_find_state(m, "inner_ring.vz"), cage = cagedyn_model_find_state(m, "cage.y");
    int64_t place = cagedyn_model_find_output(m, "cage.y");
    double *state = numbers(n), *over_inputs = numbers(n * inputs), event = 0.0;
    double *by_states = numbers(n * outputs), *by_inputs = numbers(inputs * outputs);
    cagedyn_sim *sim = cagedyn_sim_new(m);
    CHECK(cagedyn_sim_get_state(sim, state, n) == CAGEDYN_OK);
    CHECK(cagedyn_sim_input_jacobian(sim, 0.0, state, n, over_inputs, n * inputs) == CAGEDYN_OK);
    for (int64_t i = 0; i < n; i++) CHECK((over_inputs[i + load * n] != 0.0) == (i == ring));
    CHECK(cagedyn_sim_output_jacobian(sim, 0.0, state, n, by_states, n * outputs, by_inputs, inputs * outputs) ==
          CAGEDYN_OK);
    CHECK(fabs(by_states[place + cage * outputs] - 1.0) < 1e-6);
    CHECK(cagedyn_sim_next_event(sim, 0.0, &event) == CAGEDYN_OK && event > 1e300);
    check_feedthrough(m, by_inputs, outputs, inputs, load);
    CHECK_FAILS(cagedyn_sim_input_jacobian(sim, 0.0, state, n, over_inputs, n), CAGEDYN_ERR_WRONG_SIZE, "jacobian");
    CHECK_FAILS(cagedyn_sim_output_jacobian(sim, 0.0, state, n, by_states, n, by_inputs, inputs * outputs),
                CAGEDYN_ERR_WRONG_SIZE, "over_states");
    CHECK_FAILS(cagedyn_sim_next_event(sim, 0.0, NULL), CAGEDYN_ERR_NULL_ARGUMENT, "event");
    cagedyn_sim_free(sim);
    free(state), free(over_inputs), free(by_states), free(by_inputs);
}

/* The derivative over time is that of the inputs, and kinetic energy grows by the power of the forces. */
static void check_time_and_energy(const char *scene)
{
    cagedyn_model *m = cagedyn_model_from_json_with(
        scene, "inner_ring.motion.free.load.z={\"sine\": {\"mean\": -4900, \"amplitude\": 500, \"frequency\": 50, \"phase\": 0}}");
    CHECK(m != NULL);
    int64_t n = cagedyn_model_state_count(m), nq = cagedyn_model_position_count(m);
    double t = 1e-3, h = 1e-6, gain[2][3], names_length = 0.0;
    double *state = numbers(n), *rate = numbers(n), *up = numbers(n), *down = numbers(n);
    cagedyn_sim *sim = cagedyn_sim_new(m);
    CHECK(cagedyn_sim_advance_to(sim, t) == CAGEDYN_OK);
    CHECK(cagedyn_sim_get_state(sim, state, n) == CAGEDYN_OK);
    CHECK(cagedyn_sim_time_derivative(sim, t, state, rate, n) == CAGEDYN_OK);
    CHECK(cagedyn_sim_derivative(sim, t + h, state, up, n) == CAGEDYN_OK);
    CHECK(cagedyn_sim_derivative(sim, t - h, state, down, n) == CAGEDYN_OK);
    int64_t ring = cagedyn_model_find_state(m, "inner_ring.vz");
    CHECK(ring >= nq && fabs(rate[ring]) > 1e4);
    for (int64_t i = 0; i < n; i++) {
        double difference = (up[i] - down[i]) / (2.0 * h);
        CHECK(fabs(rate[i] - difference) < 1e-6 * fabs(rate[ring]));
    }

    CHECK(cagedyn_energy_count() == 3 && cagedyn_energy_name(3)[0] == '\0');
    for (int i = 0; i < 3; i++) names_length += (double)strlen(cagedyn_energy_name(i));
    CHECK(names_length == 23.0);
    CHECK(cagedyn_sim_derivative(sim, t, state, rate, n) == CAGEDYN_OK);
    for (int side = 0; side < 2; side++) {
        double step = side == 0 ? -1e-9 : 1e-9;
        for (int64_t i = 0; i < n; i++) up[i] = state[i] + step * rate[i];
        CHECK(cagedyn_sim_energies_at(sim, t, up, n, gain[side], 3) == CAGEDYN_OK);
        for (int i = 0; i < 3; i++) CHECK(gain[side][i] != 0.0);
    }
    CHECK(fabs(gain[1][0] - gain[0][0]) < 1e-3 && gain[0][0] > 0.0 && gain[0][1] > 0.0);
    CHECK_FAILS(cagedyn_sim_energies_at(sim, t, up, n, gain[0], 2), CAGEDYN_ERR_WRONG_SIZE, "out");
    cagedyn_sim_free(sim);
    cagedyn_model_free(m);
    free(state), free(rate), free(up), free(down);
}

static void check_geometry(const cagedyn_model *m)
{
    int64_t n = cagedyn_model_geometry_count(m);
    double value = NAN;
    CHECK(n == 9);
    for (int64_t i = 0; i < n; i++) {
        CHECK(cagedyn_model_get_geometry(m, i, &value) == CAGEDYN_OK && value > 0.0);
        CHECK(cagedyn_model_find_geometry(m, cagedyn_model_geometry_name(m, i)) == i);
        CHECK(cagedyn_model_geometry_unit(m, i)[0] != '\0');
        CHECK(cagedyn_model_geometry_description(m, i)[0] != '\0');
    }
    CHECK_FAILS(cagedyn_model_get_geometry(m, n, &value), CAGEDYN_ERR_BAD_INDEX, "index");
    CHECK_FAILS(cagedyn_model_get_geometry(m, 0, NULL), CAGEDYN_ERR_NULL_ARGUMENT, "value");
    CHECK_FAILS(cagedyn_model_find_geometry(m, "pitch"), CAGEDYN_ERR_UNKNOWN_NAME, "pitch");
}

int main(int argc, char **argv)
{
    cagedyn_model *m = load_model(argc, argv);
    check_own_state(m);
    check_drawn_forces(m);
    check_sparse(m);
    check_inputs_and_outputs(m);
    check_time_and_energy(cagedyn_model_scene_json(m));
    check_geometry(m);
    cagedyn_model_free(m);
    return failures > 0;
}
