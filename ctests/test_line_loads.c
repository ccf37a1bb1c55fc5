/* Load along rollers that move in space, in C: of a simulation and of an equilibrium. The scene is that of the NU2310 in space. */
#include "check.h"

#include <math.h>

/* Along a contact of a roller the loads sum up to the normal force, in their order along the roller. */
static void check_contact(cagedyn_sim *sim, const cagedyn_model *m, int64_t contact, double length)
{
    const int64_t columns = cagedyn_model_line_load_quantity_count(m);
    const int64_t place = cagedyn_model_find_line_load_quantity(m, "place");
    const int64_t extent = cagedyn_model_find_line_load_quantity(m, "extent");
    const int64_t load = cagedyn_model_find_line_load_quantity(m, "line_load");
    const int64_t pressure = cagedyn_model_find_line_load_quantity(m, "largest_pressure");
    const int64_t known = cagedyn_model_contact_quantity_count(m), contacts = cagedyn_model_contact_count(m);
    const int64_t normal = cagedyn_model_find_contact_quantity(m, "normal_force");
    const int64_t largest = cagedyn_model_find_contact_quantity(m, "largest_pressure");
    double *forces = numbers(known * contacts);
    CHECK(cagedyn_sim_contact_forces(sim, forces, known * contacts) == CAGEDYN_OK);
    const double force = forces[known * contact + normal];
    const int64_t rows = cagedyn_sim_line_load_count(sim, contact);
    CHECK(rows >= 0 && (force <= 0.0 || rows > 1));
    double *out = numbers(rows * columns + 1);
    CHECK(cagedyn_sim_line_loads(sim, contact, out, rows * columns) == CAGEDYN_OK);
    double sum = 0.0, most = 0.0;
    for (int64_t i = 0; i < rows; i++) {
        const double *row = out + i * columns;
        CHECK(i == 0 || row[place] > out[(i - 1) * columns + place]);
        CHECK(fabs(row[place]) < 0.5 * length && row[extent] > 0.0 && row[extent] < length);
        sum += row[load] * row[extent];
        if (row[pressure] > most) most = row[pressure];
    }
    CHECK(fabs(sum - force) <= 1e-12 * fabs(force));
    CHECK(fabs(most - forces[known * contact + largest]) <= 1e-12 * most);
    free(out), free(forces);
}

static void check_sim(const cagedyn_model *m, double length)
{
    cagedyn_sim *sim = cagedyn_sim_new(m);
    double x[3] = {7.0, 7.0, 7.0};
    const int64_t outer = cagedyn_model_find_contact(m, "roller[9].outer_raceway");
    const int64_t columns = cagedyn_model_line_load_quantity_count(m);
    CHECK(columns > 0 && strcmp(cagedyn_model_line_load_quantity_name(m, 0), "place") == 0);
    CHECK(strcmp(cagedyn_model_line_load_quantity_unit(m, 2), "N/m") == 0);
    CHECK(cagedyn_model_line_load_quantity_description(m, 0)[0] != '\0');
    CHECK(cagedyn_model_line_load_quantity_name(m, columns)[0] == '\0');
    CHECK(cagedyn_error_status() == CAGEDYN_ERR_BAD_INDEX);

    CHECK(cagedyn_sim_advance_to(sim, 2e-3) == CAGEDYN_OK);
    for (int64_t i = 0; i < cagedyn_model_contact_count(m); i++) {
        if (strstr(cagedyn_model_contact_name(m, i), "_raceway") != NULL) {
            check_contact(sim, m, i, length);
        } else if (strstr(cagedyn_model_contact_name(m, i), "_rib_") != NULL) {
            CHECK(cagedyn_sim_line_load_count(sim, i) == 0);
            CHECK(cagedyn_sim_line_loads(sim, i, NULL, 0) == CAGEDYN_OK);
        }
    }

    const int64_t numbers_of = columns * cagedyn_sim_line_load_count(sim, outer);
    CHECK(numbers_of > 3);
    CHECK_FAILS(cagedyn_sim_line_load_count(NULL, outer), CAGEDYN_ERR_NULL_ARGUMENT, "sim");
    CHECK_FAILS(cagedyn_sim_line_loads(NULL, outer, x, 3), CAGEDYN_ERR_NULL_ARGUMENT, "sim");
    CHECK_FAILS(cagedyn_sim_line_load_count(sim, -1), CAGEDYN_ERR_BAD_INDEX, "contact");
    CHECK_FAILS(cagedyn_sim_line_loads(sim, cagedyn_model_contact_count(m), x, 3), CAGEDYN_ERR_BAD_INDEX, "contact");
    CHECK_FAILS(cagedyn_sim_line_loads(sim, outer, NULL, numbers_of), CAGEDYN_ERR_NULL_ARGUMENT, "out");
    CHECK_FAILS(cagedyn_sim_line_loads(sim, outer, x, 3), CAGEDYN_ERR_WRONG_SIZE, "out");
    CHECK_FAILS(cagedyn_sim_line_loads(sim, outer, x, -1), CAGEDYN_ERR_WRONG_SIZE, "out");
    CHECK_FAILS(cagedyn_model_line_load_quantity_count(NULL), CAGEDYN_ERR_NULL_ARGUMENT, "model");
    CHECK(x[0] == 7.0 && x[1] == 7.0 && x[2] == 7.0);
    cagedyn_sim_free(sim);
}

static void check_equilibrium(const cagedyn_model *m, double length)
{
    cagedyn_equilibrium *found = cagedyn_equilibrium_find(m, NULL);
    CHECK(found != NULL);
    const int64_t n = cagedyn_equilibrium_line_load_count(found);
    CHECK(n > 10);
    double *places = numbers(n), *loads = numbers(n), known[64] = {0};
    CHECK(cagedyn_equilibrium_line_load_places(found, places, n) == CAGEDYN_OK);
    CHECK(fabs(places[0] + 0.5 * length) < 1e-12 && fabs(places[n - 1] - 0.5 * length) < 1e-12);
    const int64_t columns = cagedyn_equilibrium_contact_quantity_count(found);
    for (int64_t i = 0; i < cagedyn_equilibrium_contact_count(found); i++) {
        CHECK(cagedyn_equilibrium_line_loads(found, i, loads, n) == CAGEDYN_OK);
        CHECK(cagedyn_equilibrium_contact(found, i, known, columns) == CAGEDYN_OK);
        double sum = 0.0;
        for (int64_t k = 0; k + 1 < n; k++) sum += 0.5 * (loads[k] + loads[k + 1]) * (places[k + 1] - places[k]);
        CHECK(fabs(sum - known[0]) < 1e-3 * known[0] + 1e-6);
    }
    loads[0] = 7.0;
    CHECK_FAILS(cagedyn_equilibrium_line_load_count(NULL), CAGEDYN_ERR_NULL_ARGUMENT, "found");
    CHECK_FAILS(cagedyn_equilibrium_line_load_places(found, loads, n - 1), CAGEDYN_ERR_WRONG_SIZE, "out");
    CHECK_FAILS(cagedyn_equilibrium_line_loads(found, -1, loads, n), CAGEDYN_ERR_BAD_INDEX, "contact");
    CHECK_FAILS(cagedyn_equilibrium_line_loads(found, 0, loads, n + 1), CAGEDYN_ERR_WRONG_SIZE, "out");
    CHECK_FAILS(cagedyn_equilibrium_line_loads(found, 0, NULL, n), CAGEDYN_ERR_NULL_ARGUMENT, "out");
    CHECK(loads[0] == 7.0);
    free(places), free(loads);
    cagedyn_equilibrium_free(found);
}

/* Of rollers in the plane nothing is told, and nothing is wrong. */
static void check_plane(const cagedyn_model *m)
{
    static const char *const plane =
        "rollers.space=null\nribs=null\nraceways.slices=null\ncage.space=null\n"
        "inner_ring.motion={\"free\": {\"mass\": 3.0, \"load\": {\"y\": {\"constant\": 0}, \"z\": {\"constant\": -4900}}}}";
    cagedyn_model *flat = cagedyn_model_from_json_with(cagedyn_model_scene_json(m), plane);
    CHECK(flat != NULL);
    cagedyn_sim *sim = cagedyn_sim_new(flat);
    CHECK(cagedyn_sim_line_load_count(sim, 0) == 0 && cagedyn_sim_line_loads(sim, 0, NULL, 0) == CAGEDYN_OK);
    cagedyn_equilibrium *found = cagedyn_equilibrium_find(flat, NULL);
    CHECK(cagedyn_equilibrium_line_load_count(found) == 0);
    CHECK(cagedyn_equilibrium_line_loads(found, 0, NULL, 0) == CAGEDYN_OK);
    cagedyn_equilibrium_free(found);
    cagedyn_sim_free(sim);
    cagedyn_model_free(flat);
}

int main(int argc, char **argv)
{
    cagedyn_model *model = load_model(argc, argv);
    const double length = 0.0204;
    check_sim(model, length);
    check_equilibrium(model, length);
    check_plane(model);
    cagedyn_model_free(model);
    return failures > 0;
}
