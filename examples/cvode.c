/* The host's own integrator: CVODE of SUNDIALS with the derivative, the sparse Jacobian and the linear solver of the library.
 *
 * CVODE solves its linear systems by GMRES. Products with the Jacobian come from its sparse form; the preconditioner is the
 * library's solver for (I - gamma J) x = b, which takes time in proportion to the number of rollers, so that GMRES needs one or
 * two iterations.
 *
 *   cc -std=c99 cvode.c $(pkg-config --cflags --libs cagedyn) -lsundials_cvode -lsundials_nvecserial \
 *       -lsundials_sunlinsolspgmr -lsundials_core -lm -o cvode
 *   ./cvode scenes/nu2310.json
 *
 * With SUNDIALS 7; in version 6 (libsundials-dev of Debian 12) the library sundials_core is called sundials_generic.
 */
#include <math.h>
#include <string.h>

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_spgmr.h>

#include "example.h"

/* SUNDIALS 6 has no name for "no communicator". */
#ifndef SUN_COMM_NULL
#define SUN_COMM_NULL NULL
#endif

/* Error of a step in units of the scales below. */
static const double TOLERANCE = 1e-4;

typedef struct {
    cagedyn_sim *sim;
    int64_t states, entries;
    /* The Jacobian by compressed sparse columns. */
    int64_t *starts, *rows;
    double *values;
} bearing;

/* The answer that CVODE understands: a state without forces is avoided by a smaller step, all else ends the run. */
static int answer(int32_t status)
{
    if (status == CAGEDYN_OK) return 0;
    return status == CAGEDYN_ERR_BAD_STATE ? 1 : -1;
}

static int rates(sunrealtype t, N_Vector y, N_Vector rate, void *data)
{
    bearing *b = data;
    return answer(cagedyn_sim_derivative(b->sim, t, N_VGetArrayPointer(y), N_VGetArrayPointer(rate), b->states));
}

/* Evaluates the Jacobian for products with it. */
static int set_up_product(sunrealtype t, N_Vector y, N_Vector rate, void *data)
{
    bearing *b = data;
    (void)rate;
    return answer(
        cagedyn_sim_sparse_jacobian(b->sim, t, N_VGetArrayPointer(y), b->states, b->values, b->entries));
}

static int product(N_Vector v, N_Vector jv, sunrealtype t, N_Vector y, N_Vector rate, void *data, N_Vector memory)
{
    bearing *b = data;
    const double *x = N_VGetArrayPointer(v);
    double *out = N_VGetArrayPointer(jv);
    (void)t, (void)y, (void)rate, (void)memory;
    memset(out, 0, (size_t)b->states * sizeof(double));
    for (int64_t k = 0; k < b->states; k++)
        for (int64_t i = b->starts[k]; i < b->starts[k + 1]; i++) out[b->rows[i]] += b->values[i] * x[k];
    return 0;
}

/* Factors of I - gamma J for the preconditioner; with the derivatives of before where CVODE allows it. */
static int set_up_solver(sunrealtype t, N_Vector y, N_Vector rate, sunbooleantype keep, sunbooleantype *renewed,
                         sunrealtype gamma, void *data)
{
    bearing *b = data;
    (void)rate;
    *renewed = keep ? SUNFALSE : SUNTRUE;
    if (!keep) {
        int refused = answer(cagedyn_sim_linearize(b->sim, t, N_VGetArrayPointer(y), b->states));
        if (refused != 0) return refused;
    }
    return answer(cagedyn_sim_factorize(b->sim, gamma));
}

static int solve(sunrealtype t, N_Vector y, N_Vector rate, N_Vector r, N_Vector z, sunrealtype gamma,
                 sunrealtype delta, int side, void *data)
{
    bearing *b = data;
    (void)t, (void)y, (void)rate, (void)gamma, (void)delta, (void)side;
    N_VScale(1.0, r, z);
    return answer(cagedyn_sim_solve(b->sim, N_VGetArrayPointer(z), b->states));
}

static void need(int ok, const char *what)
{
    if (!ok) {
        fprintf(stderr, "%s failed (%s)\n", what, cagedyn_error_message());
        exit(EXIT_FAILURE);
    }
}

/* What counts as much as one guide clearance of a position: angles by the pitch circle, velocities in 0.1 ms. */
static double scale(const cagedyn_model *model, int64_t state)
{
    double clearance = 0.0, pitch = 1.0;
    const char *unit = cagedyn_model_state_unit(model, state);
    need(cagedyn_model_get_geometry(model, cagedyn_model_find_geometry(model, "guide_clearance"), &clearance) == 0
             && cagedyn_model_get_geometry(model, cagedyn_model_find_geometry(model, "pitch_radius"), &pitch) == 0,
         "geometry");
    return clearance / (strncmp(unit, "rad", 3) == 0 ? pitch : 1.0) * (strstr(unit, "/s") != NULL ? 1e4 : 1.0);
}

int main(int argc, char **argv)
{
    cagedyn_model *model = model_of(argc, argv);
    cagedyn_sim *sim = cagedyn_sim_new(model);
    if (sim == NULL) fail("simulation");
    bearing b = {sim, cagedyn_model_state_count(model), cagedyn_model_jacobian_entry_count(model), NULL, NULL, NULL};
    b.starts = (int64_t *)calloc((size_t)b.states + 1, sizeof(int64_t));
    b.rows = (int64_t *)calloc((size_t)b.entries, sizeof(int64_t));
    b.values = array(b.entries);
    if (cagedyn_model_jacobian_pattern(model, b.starts, b.states + 1, b.rows, b.entries) != CAGEDYN_OK) fail("pattern");

    SUNContext context = NULL;
    need(SUNContext_Create(SUN_COMM_NULL, &context) == 0, "SUNContext_Create");
    N_Vector y = N_VNew_Serial(b.states, context), tolerance = N_VNew_Serial(b.states, context);
    if (cagedyn_sim_get_state(sim, N_VGetArrayPointer(y), b.states) != CAGEDYN_OK) fail("get state");
    for (int64_t k = 0; k < b.states; k++) N_VGetArrayPointer(tolerance)[k] = TOLERANCE * scale(model, k);
    SUNLinearSolver linear = SUNLinSol_SPGMR(y, SUN_PREC_LEFT, 0, context);
    void *cvode = CVodeCreate(CV_BDF, context);
    need(CVodeInit(cvode, rates, 0.0, y) == CV_SUCCESS && CVodeSVtolerances(cvode, 0.0, tolerance) == CV_SUCCESS
             && CVodeSetUserData(cvode, &b) == CV_SUCCESS && CVodeSetMaxNumSteps(cvode, 1000000) == CV_SUCCESS
             && CVodeSetMaxStep(cvode, 1e-5) == CV_SUCCESS
             && CVodeSetLinearSolver(cvode, linear, NULL) == CV_SUCCESS
             && CVodeSetJacTimes(cvode, set_up_product, product) == CV_SUCCESS
             && CVodeSetPreconditioner(cvode, set_up_solver, solve) == CV_SUCCESS,
         "CVODE");

    int64_t outputs = cagedyn_model_output_count(model);
    int64_t place[] = {cagedyn_model_find_output(model, "cage.y_ratio"), cagedyn_model_find_output(model, "cage.z_ratio"),
                       cagedyn_model_find_output(model, "inner_ring.drag_torque")};
    double *values = array(outputs), t = 0.0;
    for (int i = 1; i <= 4; i++) {
        need(CVode(cvode, 0.5e-3 * i, y, &t, CV_NORMAL) >= 0, "CVode");
        /* Outputs of the host's own state; the simulation stays at its start. */
        if (cagedyn_sim_outputs_at(sim, t, N_VGetArrayPointer(y), b.states, values, outputs) != CAGEDYN_OK) fail("outputs");
        printf("%.1f ms: cage centre (%.4f, %.4f) of the clearance, drag %.3f N m\n", 1e3 * t, values[place[0]],
               values[place[1]], values[place[2]]);
    }
    long steps = 0, iterations = 0, newton = 0, failures = 0;
    need(CVodeGetNumSteps(cvode, &steps) == 0 && CVodeGetNumLinIters(cvode, &iterations) == 0
             && CVodeGetNumNonlinSolvIters(cvode, &newton) == 0 && CVodeGetNumLinConvFails(cvode, &failures) == 0,
         "counts");
    need(steps > 0 && iterations < 2 * newton && failures == 0, "the preconditioner");
    CVodeFree(&cvode);
    SUNLinSolFree(linear);
    N_VDestroy(tolerance);
    N_VDestroy(y);
    SUNContext_Free(&context);
    free(b.starts), free(b.rows), free(b.values), free(values);
    cagedyn_sim_free(sim);
    cagedyn_model_free(model);
    return EXIT_SUCCESS;
}
