/* A cylindrical roller bearing from C: read a scene, set a state, look at the forces, run, write a table.
 *
 * `make example` compiles and runs it. With an installed library:
 *
 *   cc -std=c99 nu2310.c $(pkg-config --cflags --libs cagedyn) -o nu2310
 *   ./nu2310 scenes/nu2310.json nu2310.csv
 */
#include <stdio.h>
#include <stdlib.h>

#include "cagedyn.h"

static const char *const columns[] = {"cage.y_ratio", "cage.z_ratio", "cage.slip", "roller[0].slip",
                                      "roller[0].pocket_force"};
enum { COLUMNS = sizeof columns / sizeof columns[0] };

/* Prints the last error and ends the program. */
static void fail(const char *what)
{
    fprintf(stderr, "%s: %s (%s)\n", what, cagedyn_error_message(),
            cagedyn_status_name(cagedyn_error_status()));
    exit(EXIT_FAILURE);
}

static double *array(int64_t length)
{
    double *values = length > 0 ? (double *)malloc((size_t)length * sizeof(double)) : NULL;
    if (values == NULL) fail("array");
    return values;
}

/* Moves the cage to 100 um left of the centre, to start closer to where it runs. */
static void move_cage(const cagedyn_model *model, cagedyn_sim *sim)
{
    int64_t n = cagedyn_model_state_count(model);
    int64_t cage_y = cagedyn_model_find_state(model, "cage.y");
    double *state = array(n);
    if (cage_y < 0 || cagedyn_sim_get_state(sim, state, n) != CAGEDYN_OK) fail("get state");
    state[cage_y] = -100e-6;
    if (cagedyn_sim_set_state(sim, 0.0, state, n) != CAGEDYN_OK) fail("set state");
    free(state);
}

/* Prints the contacts that carry load at the present state. */
static void print_forces(const cagedyn_model *model, cagedyn_sim *sim)
{
    int64_t contacts = cagedyn_model_contact_count(model);
    int64_t quantities = cagedyn_model_contact_quantity_count(model);
    int64_t force = cagedyn_model_find_contact_quantity(model, "normal_force");
    int64_t film = cagedyn_model_find_contact_quantity(model, "film_thickness");
    double *values = array(contacts * quantities);
    if (force < 0 || film < 0) fail("contact quantity");
    if (cagedyn_sim_contact_forces(sim, values, contacts * quantities) != CAGEDYN_OK) fail("contact forces");
    printf("%-26s %12s %12s\n", "contact", "force [N]", "film [um]");
    for (int64_t i = 0; i < contacts; i++) {
        const double *row = values + i * quantities;
        if (row[force] > 0.0) {
            printf("%-26s %12.2f %12.3f\n", cagedyn_model_contact_name(model, i), row[force],
                   1e6 * row[film]);
        }
    }
    free(values);
}

/* Largest force between any roller and the cage since the interval began: from every step, records would miss it. */
static double largest_pocket_force(const cagedyn_model *model, cagedyn_sim *sim)
{
    int64_t watched = cagedyn_model_watched_count(model), length = cagedyn_interval_count();
    double largest = 0.0, *interval = array(length);
    for (int64_t i = 0; i < watched; i++) {
        int64_t output = cagedyn_model_watched_output(model, i);
        if (cagedyn_sim_get_interval(sim, output, interval, length) != CAGEDYN_OK) fail("interval");
        if (-interval[2] > largest) largest = -interval[2];
        if (interval[3] > largest) largest = interval[3];
    }
    free(interval);
    return largest;
}

/* Runs for 20 ms and writes one line every 0.5 ms. */
static void run(const cagedyn_model *model, cagedyn_sim *sim, FILE *csv)
{
    int64_t index[COLUMNS];
    fprintf(csv, "time [s]");
    for (int k = 0; k < COLUMNS; k++) {
        index[k] = cagedyn_model_find_output(model, columns[k]);
        if (index[k] < 0) fail(columns[k]);
        fprintf(csv, ",%s [%s]", columns[k], cagedyn_model_output_unit(model, index[k]));
    }
    fprintf(csv, "\n");
    for (int i = 0; i <= 40; i++) {
        double time = 0.5e-3 * i, value = 0.0;
        if (cagedyn_sim_advance_to(sim, time) != CAGEDYN_OK) fail("advance");
        fprintf(csv, "%.6g", time);
        for (int k = 0; k < COLUMNS; k++) {
            if (cagedyn_sim_get_output(sim, index[k], &value) != CAGEDYN_OK) fail("output");
            fprintf(csv, ",%.9g", value);
        }
        fprintf(csv, "\n");
    }
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "usage: %s SCENE.json OUT.csv\n", argv[0]);
        return EXIT_FAILURE;
    }
    cagedyn_model *model = cagedyn_model_from_file(argv[1]);
    if (model == NULL) fail(argv[1]);
    cagedyn_sim *sim = cagedyn_sim_new(model);
    if (sim == NULL) fail("simulation");
    FILE *csv = fopen(argv[2], "w");
    if (csv == NULL) {
        perror(argv[2]);
        return EXIT_FAILURE;
    }
    printf("cagedyn %s: %d states, %d outputs\n", cagedyn_version(), (int)cagedyn_model_state_count(model),
           (int)cagedyn_model_output_count(model));
    move_cage(model, sim);
    print_forces(model, sim);
    if (cagedyn_sim_begin_interval(sim) != CAGEDYN_OK) fail("interval");
    run(model, sim, csv);
    printf("largest pocket force in 20 ms: %.1f N\n", largest_pocket_force(model, sim));

    double y = 0.0, z = 0.0;
    if (cagedyn_sim_get_output(sim, cagedyn_model_find_output(model, "cage.y_ratio"), &y) != CAGEDYN_OK ||
        cagedyn_sim_get_output(sim, cagedyn_model_find_output(model, "cage.z_ratio"), &z) != CAGEDYN_OK) {
        fail("cage");
    }
    printf("cage centre after 20 ms: (%.3f, %.3f) of the guide clearance\n", y, z);
    int written = fclose(csv) == 0;
    cagedyn_sim_free(sim);
    cagedyn_model_free(model);
    return written ? EXIT_SUCCESS : EXIT_FAILURE;
}
