/* Forces without simulating: set a state, compute and print the force of every contact and on every body.
 *
 *   cc -std=c99 forces.c $(pkg-config --cflags --libs cagedyn) -o forces
 *   ./forces scenes/nu2310.json
 */
#include "example.h"

/* Index of a quantity of contacts. */
static int64_t quantity(const cagedyn_model *model, const char *name)
{
    int64_t index = cagedyn_model_find_contact_quantity(model, name);
    if (index < 0) fail(name);
    return index;
}

/* Where each loaded contact is, and the force on the rolling element there. */
static void print_contacts(const cagedyn_model *model, cagedyn_sim *sim, const double *state)
{
    int64_t contacts = cagedyn_model_contact_count(model), columns = cagedyn_model_contact_quantity_count(model);
    int64_t normal = quantity(model, "normal_force"), pressure = quantity(model, "mean_pressure");
    int64_t point_y = quantity(model, "point_y"), point_z = quantity(model, "point_z");
    int64_t normal_y = quantity(model, "normal_y"), normal_z = quantity(model, "normal_z");
    int64_t along[3] = {quantity(model, "friction"), quantity(model, "rolling_resistance"),
                        quantity(model, "film_pressure_roller")};
    double *values = array(contacts * columns);
    if (cagedyn_sim_contact_forces_at(sim, 0.0, state, cagedyn_model_state_count(model), values,
                                      contacts * columns) != CAGEDYN_OK) {
        fail("contact forces");
    }
    printf("%-26s %9s %9s %10s %10s %9s\n", "contact", "y [mm]", "z [mm]", "F_y [N]", "F_z [N]", "p [MPa]");
    for (int64_t i = 0; i < contacts; i++) {
        const double *x = values + i * columns;
        /* The normal n points from the element to the contact; t is n turned by +90 degrees. */
        double tangential = x[along[0]] + x[along[1]] + x[along[2]];
        double y = -x[normal] * x[normal_y] - tangential * x[normal_z];
        double z = -x[normal] * x[normal_z] + tangential * x[normal_y];
        if (x[normal] > 0.0) {
            printf("%-26s %9.3f %9.3f %10.2f %10.2f %9.1f\n", cagedyn_model_contact_name(model, i),
                   1e3 * x[point_y], 1e3 * x[point_z], y, z, 1e-6 * x[pressure]);
        }
    }
    free(values);
}

/* The forces on the inner ring and the cage by their source. */
static void print_bodies(const cagedyn_model *model, cagedyn_sim *sim, const double *state)
{
    int64_t bodies = cagedyn_model_body_count(model), sources = cagedyn_model_force_source_count(model);
    int64_t columns = cagedyn_model_force_component_count(model), block = sources * columns;
    const char *const names[] = {"inner_ring", "cage"};
    double *values = array(bodies * block);
    if (cagedyn_sim_body_forces_at(sim, 0.0, state, cagedyn_model_state_count(model), values, bodies * block) !=
        CAGEDYN_OK) {
        fail("body forces");
    }
    for (int k = 0; k < 2; k++) {
        int64_t body = cagedyn_model_find_body(model, names[k]);
        if (body < 0) fail(names[k]);
        for (int64_t s = 0; s < sources; s++) {
            const double *x = values + body * block + s * columns;
            if (x[0] != 0.0 || x[1] != 0.0 || x[2] != 0.0) {
                printf("%-11s %-14s %10.2f N %10.2f N %10.4f N m\n", names[k],
                       cagedyn_model_force_source_name(model, s), x[0], x[1], x[2]);
            }
        }
    }
    free(values);
}

int main(int argc, char **argv)
{
    cagedyn_model *model = model_of(argc, argv);
    cagedyn_sim *sim = cagedyn_sim_new(model);
    if (sim == NULL) fail("simulation");
    int64_t n = cagedyn_model_state_count(model);
    double *state = array(n);
    if (cagedyn_sim_get_state(sim, state, n) != CAGEDYN_OK) fail("get state");
    /* The ring 5 um lower than where the load holds it, the cage 50 um to the left. */
    state[cagedyn_model_find_state(model, "inner_ring.z")] -= 5e-6;
    state[cagedyn_model_find_state(model, "cage.y")] = -50e-6;
    print_contacts(model, sim, state);
    print_bodies(model, sim, state);
    free(state);
    cagedyn_sim_free(sim);
    cagedyn_model_free(model);
    return EXIT_SUCCESS;
}
