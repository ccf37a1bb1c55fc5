/* A rotor code as the host: it turns the shaft, loads it and heats the oil between steps, and takes the drag of the bearing back.
 *
 *   cc -std=c99 host_loop.c $(pkg-config --cflags --libs cagedyn) -lm -o host_loop
 *   ./host_loop scenes/nu2310.json
 */
#include <math.h>

#include "example.h"

/* The scene has a constant viscosity; this one follows the temperature of the oil. */
static const char *const oil =
    "lubricant.viscosity={\"walther\": {\"cold\": {\"temperature\": 313.15, \"kinematic_viscosity\": 56e-6}, "
    "\"hot\": {\"temperature\": 373.15, \"kinematic_viscosity\": 8.4e-6}, \"density\": 870, "
    "\"temperature\": {\"over_time\": {\"constant\": 308.15}}}}";

static int64_t input(const cagedyn_model *model, const char *name)
{
    int64_t index = cagedyn_model_find_input(model, name);
    if (index < 0) fail(name);
    return index;
}

static double output(const cagedyn_model *model, cagedyn_sim *sim, const char *name)
{
    double value = 0.0;
    if (cagedyn_sim_get_output(sim, cagedyn_model_find_output(model, name), &value) != CAGEDYN_OK) fail(name);
    return value;
}

int main(int argc, char **argv)
{
    const double inertia = 2e-3, drive = -8.0, unbalance = 2e-4, weight = -4900.0; /* kg m^2, N m, kg m, N */
    const double heat_capacity = 0.5, surroundings = 308.15, conductance = 5.0;  /* J/K, K, W/K */
    cagedyn_model *scene = model_of(argc, argv);
    cagedyn_model *model = cagedyn_model_from_json_with(cagedyn_model_scene_json(scene), oil);
    cagedyn_sim *sim = model ? cagedyn_sim_new(model) : NULL;
    if (sim == NULL) fail("simulation");
    int64_t speed_input = input(model, "inner_ring.speed"), temperature_input = input(model, "lubricant.temperature");
    int64_t load_y = input(model, "load.y"), load_z = input(model, "load.z");
    double speed = -300.0, angle = 0.0, temperature = surroundings, dt = 0.1e-3;

    printf("%8s %12s %12s %12s %12s\n", "t [ms]", "w [rad/s]", "drag [N m]", "T [K]", "ring z [um]");
    for (int i = 0; i <= 40; i++) {
        /* What the bearing does to the rotor. */
        double drag = output(model, sim, "inner_ring.drag_torque");
        if (i % 10 == 0) {
            printf("%8.2f %12.3f %12.4f %12.4f %12.3f\n", 1e3 * dt * i, speed, drag, temperature,
                   1e6 * output(model, sim, "inner_ring.z"));
        }
        /* What the rotor does: the drag works against the rotation, which is clockwise. */
        speed += dt * (drive + drag) / inertia;
        angle += dt * speed;
        temperature += dt * (drag * fabs(speed) - conductance * (temperature - surroundings)) / heat_capacity;
        double force = unbalance * speed * speed;
        if (cagedyn_sim_set_input(sim, speed_input, speed) != CAGEDYN_OK ||
            cagedyn_sim_set_input(sim, temperature_input, temperature) != CAGEDYN_OK ||
            cagedyn_sim_set_input(sim, load_y, force * cos(angle)) != CAGEDYN_OK ||
            cagedyn_sim_set_input(sim, load_z, weight + force * sin(angle)) != CAGEDYN_OK) {
            fail("input");
        }
        if (cagedyn_sim_step(sim, dt) != CAGEDYN_OK) fail("step");
    }
    /* A host that asks for trust gets it or the reasons. */
    if (cagedyn_sim_trust(sim) != CAGEDYN_OK) fail("the run is not to be trusted");
    cagedyn_sim_free(sim);
    cagedyn_model_free(model);
    cagedyn_model_free(scene);
    return EXIT_SUCCESS;
}
