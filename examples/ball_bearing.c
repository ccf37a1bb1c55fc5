/* Balls that move in space: stiffness for a rotor code, then a run with a load that a host changes, and what the balls do.
 *
 *   cc -std=c99 ball_bearing.c $(pkg-config --cflags --libs cagedyn) -o ball_bearing
 *   ./ball_bearing scenes/angular_contact_70.json
 */
#include "example.h"

static void print_stiffness(const cagedyn_model *model)
{
    /* Friction of the balls themselves decides where they spin. */
    cagedyn_equilibrium *found = cagedyn_equilibrium_find(model, "friction");
    if (found == NULL) fail("equilibrium");
    int64_t n = cagedyn_equilibrium_coordinate_count(found);
    double *at = array(n), *stiffness = array(n * n);
    if (cagedyn_equilibrium_displacement(found, at, n) != CAGEDYN_OK) fail("displacement");
    if (cagedyn_equilibrium_stiffness(found, stiffness, n * n) != CAGEDYN_OK) fail("stiffness");
    printf("equilibrium: x = %.3f um; stiffness along x, y, z: %.2f, %.2f, %.2f N/um\n", 1e6 * at[0],
           1e-6 * stiffness[0], 1e-6 * stiffness[n + 1], 1e-6 * stiffness[2 * (n + 1)]);
    free(stiffness);
    free(at);
    cagedyn_equilibrium_free(found);
}

int main(int argc, char **argv)
{
    cagedyn_model *model = model_of(argc, argv);
    print_stiffness(model);
    cagedyn_sim *sim = cagedyn_sim_new(model);
    if (sim == NULL) fail("simulation");
    const char *const names[] = {"ball[0].inner_angle", "ball[0].outer_angle", "ball[0].inner_force",
                                 "balls.orbit_ratio", "inner_ring.x"};
    int64_t outputs = cagedyn_model_output_count(model), load = cagedyn_model_find_input(model, "load.x"), place[5];
    if (load < 0) fail("load.x");
    for (int i = 0; i < 5; i++) {
        place[i] = cagedyn_model_find_output(model, names[i]);
        if (place[i] < 0) fail(names[i]);
    }
    double *values = array(outputs);
    for (int step = 0; step <= 3; step++) {
        if (cagedyn_sim_advance_to(sim, 4e-3 * step) != CAGEDYN_OK) fail("advance");
        if (cagedyn_sim_get_outputs(sim, values, outputs) != CAGEDYN_OK) fail("outputs");
        printf("%4.1f ms: contact angles %.2f and %.2f deg, %.2f N, orbit %.4f of rolling, x = %.3f um\n", 4.0 * step,
               57.29577951308232 * values[place[0]], 57.29577951308232 * values[place[1]], values[place[2]],
               values[place[3]], 1e6 * values[place[4]]);
        /* From here on the machine presses harder. */
        if (cagedyn_sim_set_input(sim, load, 900.0) != CAGEDYN_OK) fail("load");
    }
    printf("%s\n", cagedyn_sim_trust(sim) == CAGEDYN_OK ? "the run kept its power balance" : cagedyn_error_message());
    free(values);
    cagedyn_sim_free(sim);
    cagedyn_model_free(model);
    return EXIT_SUCCESS;
}
