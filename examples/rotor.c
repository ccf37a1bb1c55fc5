/* A rigid rotor of 50 kg on two bearings, integrated by the host, which owns the motion of both inner rings: at each of its steps of
 * 0.1 ms it sets their velocities with the accelerations as slopes, and takes the forces of the bearings back (velocity Verlet).
 *
 *   cc -std=c99 rotor.c $(pkg-config --cflags --libs cagedyn) -lm -o rotor
 *   ./rotor scenes/nu2310.json
 */
#include <math.h>

#include "example.h"

enum { BEARINGS = 2, AXES = 2 };

/* The rotor between the bearings: mass, inertia about an axis across it, distance of the bearings; unbalance at each of them. */
static const double mass = 50.0, inertia = 1.2, span = 0.4;         /* kg, kg m^2, m */
static const double unbalance[BEARINGS] = {2e-2, 1e-2};             /* kg m */
static const double phase[BEARINGS] = {0.0, 1.5}, speed = -314.159; /* rad, rad/s */
static const double gravity = -9.81, load = -4900.0;                /* m/s^2; N at each end */

typedef struct {
    cagedyn_sim *sim;
    int64_t velocity[AXES], force[AXES];
    double v[AXES], a[AXES], f[AXES];
} bearing;

static const char *const velocities[AXES] = {"inner_ring.vy", "inner_ring.vz"};
static const char *const forces[AXES] = {"inner_ring.force_y", "inner_ring.force_z"};

/* A bearing whose inner ring is the host's. */
static bearing made(const char *scene)
{
    bearing b;
    cagedyn_model *model = cagedyn_model_from_json_with(
        scene, "inner_ring.motion={\"prescribed\": {\"y\": 0, \"z\": -27e-6}}\ninitial.inner_ring=equilibrium");
    b.sim = model ? cagedyn_sim_new(model) : NULL;
    if (b.sim == NULL) fail("bearing");
    for (int k = 0; k < AXES; k++) {
        b.v[k] = b.a[k] = b.f[k] = 0.0;
        b.velocity[k] = cagedyn_model_find_input(model, velocities[k]);
        b.force[k] = cagedyn_model_find_output(model, forces[k]);
        if (b.velocity[k] < 0 || b.force[k] < 0) fail(velocities[k]);
    }
    cagedyn_model_free(model);
    return b;
}

/* Accelerations of both ends by the forces of the bearings, weight and unbalance. */
static void accelerate(bearing *b, double t)
{
    /* Masses of the ends: m/4 + I/l^2 on the diagonal, m/4 - I/l^2 beside it. */
    const double own = mass / 4 + inertia / (span * span), other = mass / 4 - inertia / (span * span);
    const double scale = 1 / (own * own - other * other);
    for (int k = 0; k < AXES; k++) {
        double total[BEARINGS];
        for (int i = 0; i < BEARINGS; i++) {
            double angle = speed * t + phase[i], direction = k == 0 ? cos(angle) : sin(angle);
            if (cagedyn_sim_get_output(b[i].sim, b[i].force[k], &b[i].f[k]) != CAGEDYN_OK) fail("force");
            total[i] = b[i].f[k] + unbalance[i] * speed * speed * direction + (k == 1 ? 0.5 * mass * gravity + load : 0.0);
        }
        b[0].a[k] = scale * (own * total[0] - other * total[1]);
        b[1].a[k] = scale * (own * total[1] - other * total[0]);
    }
}

int main(int argc, char **argv)
{
    const double dt = 1e-4;
    cagedyn_model *scene = model_of(argc, argv);
    bearing b[BEARINGS];
    for (int i = 0; i < BEARINGS; i++) b[i] = made(cagedyn_model_scene_json(scene));
    accelerate(b, 0.0);
    printf("%8s %12s %12s %12s %12s\n", "t [ms]", "F1 y [N]", "F1 z [N]", "F2 y [N]", "F2 z [N]");
    for (int n = 1; n <= 120; n++) {
        double before[BEARINGS][AXES];
        for (int i = 0; i < BEARINGS; i++) {
            for (int k = 0; k < AXES; k++) {
                before[i][k] = b[i].a[k];
                if (cagedyn_sim_set_input_slope(b[i].sim, b[i].velocity[k], b[i].v[k], b[i].a[k]) != CAGEDYN_OK) {
                    fail("velocity");
                }
            }
            if (cagedyn_sim_advance_to(b[i].sim, n * dt) != CAGEDYN_OK) fail("advance");
        }
        accelerate(b, n * dt);
        for (int i = 0; i < BEARINGS; i++) {
            for (int k = 0; k < AXES; k++) b[i].v[k] += 0.5 * dt * (before[i][k] + b[i].a[k]);
        }
        if (n % 30 == 0) {
            printf("%8.1f %12.1f %12.1f %12.1f %12.1f\n", 1e3 * n * dt, b[0].f[0], b[0].f[1], b[1].f[0], b[1].f[1]);
        }
    }
    for (int i = 0; i < BEARINGS; i++) {
        if (cagedyn_sim_trust(b[i].sim) != CAGEDYN_OK) fail("a run is not to be trusted");
        cagedyn_sim_free(b[i].sim);
    }
    cagedyn_model_free(scene);
    return EXIT_SUCCESS;
}
