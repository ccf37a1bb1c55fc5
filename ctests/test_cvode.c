/* CVODE of SUNDIALS integrates a scene with the derivatives and the Jacobian of the library, and ends where the
 * library's own solver ends. Arguments: scene, end of the run in s, pitch radius in m, largest step of CVODE in s,
 * largest difference of a position in units of the guide clearance. */
#include <math.h>

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "check.h"

/* Error of a step of CVODE, relative and in units of the clearance. */
static const double TOLERANCE = 1e-12;
/* Velocity that counts as much as a position, 1/s. */
static const double RATE = 1e4;

/* What the callbacks of CVODE see. */
typedef struct {
    cagedyn_sim *sim;
    int64_t states;
    long refused;
} host;

/* The answer that CVODE understands: it avoids states without forces by a smaller step; all else ends the run. */
static int answer(host *h, int32_t status)
{
    if (status == CAGEDYN_OK) return 0;
    h->refused += 1;
    return status == CAGEDYN_ERR_BAD_STATE ? 1 : -1;
}

static int rates(sunrealtype t, N_Vector y, N_Vector rate, void *data)
{
    host *h = data;
    double *state = N_VGetArrayPointer(y), *out = N_VGetArrayPointer(rate);
    return answer(h, cagedyn_sim_derivative(h->sim, t, state, out, h->states));
}

static int jacobian(sunrealtype t, N_Vector y, N_Vector rate, SUNMatrix matrix, void *data, N_Vector a,
                    N_Vector b, N_Vector c)
{
    host *h = data;
    int64_t n = h->states;
    double *state = N_VGetArrayPointer(y), *out = SUNDenseMatrix_Data(matrix);
    (void)rate, (void)a, (void)b, (void)c;
    return answer(h, cagedyn_sim_jacobian(h->sim, t, state, n, out, n * n));
}

/* An integration by CVODE. */
typedef struct {
    host host;
    SUNContext context;
    N_Vector y, tolerance;
    SUNMatrix matrix;
    SUNLinearSolver solver;
    void *memory;
} run;

/* Errors of angles count as arcs of the pitch circle. */
static double scale(const cagedyn_model *m, int64_t k, double clearance, double pitch_radius)
{
    const char *unit = cagedyn_model_state_unit(m, k);
    double length = strncmp(unit, "rad", 3) == 0 ? clearance / pitch_radius : clearance;
    return strstr(unit, "/s") != NULL ? RATE * length : length;
}

static void start(run *r, const cagedyn_model *m, const double *state, double tolerance, double clearance,
                  double pitch_radius)
{
    int64_t n = cagedyn_model_state_count(m);
    r->host.sim = cagedyn_sim_new(m);
    r->host.states = n;
    r->host.refused = 0;
    CHECK(SUNContext_Create(SUN_COMM_NULL, &r->context) == 0);
    CHECK(SUNContext_ClearErrHandlers(r->context) == 0);
    r->y = N_VNew_Serial(n, r->context);
    r->tolerance = N_VNew_Serial(n, r->context);
    memcpy(N_VGetArrayPointer(r->y), state, (size_t)n * sizeof(double));
    for (int64_t k = 0; k < n; k++)
        N_VGetArrayPointer(r->tolerance)[k] = tolerance * scale(m, k, clearance, pitch_radius);
    r->matrix = SUNDenseMatrix(n, n, r->context);
    r->solver = SUNLinSol_Dense(r->y, r->matrix, r->context);
    r->memory = CVodeCreate(CV_BDF, r->context);
    CHECK(CVodeInit(r->memory, rates, 0.0, r->y) == CV_SUCCESS);
    CHECK(CVodeSVtolerances(r->memory, tolerance, r->tolerance) == CV_SUCCESS);
    CHECK(CVodeSetUserData(r->memory, &r->host) == CV_SUCCESS);
    CHECK(CVodeSetMaxNumSteps(r->memory, 1000000) == CV_SUCCESS);
    CHECK(CVodeSetLinearSolver(r->memory, r->solver, r->matrix) == CV_SUCCESS);
    CHECK(CVodeSetJacFn(r->memory, jacobian) == CV_SUCCESS);
}

static void advance(run *r, double t)
{
    double reached = 0.0;
    CHECK(CVodeSetStopTime(r->memory, t) == CV_SUCCESS);
    CHECK(CVode(r->memory, t, r->y, &reached, CV_NORMAL) >= 0);
    CHECK(reached == t);
}

static void finish(run *r)
{
    CVodeFree(&r->memory);
    SUNLinSolFree(r->solver);
    SUNMatDestroy(r->matrix);
    N_VDestroy(r->tolerance);
    N_VDestroy(r->y);
    SUNContext_Free(&r->context);
    cagedyn_sim_free(r->host.sim);
}

/* The radial guide clearance: what the output "cage.y_ratio" is measured by. */
static double clearance_of(const cagedyn_model *m)
{
    int64_t n = cagedyn_model_state_count(m), y = cagedyn_model_find_state(m, "cage.y");
    double *state = numbers(n), ratio = NAN;
    cagedyn_sim *sim = cagedyn_sim_new(m);
    CHECK(y >= 0 && cagedyn_sim_get_state(sim, state, n) == CAGEDYN_OK);
    state[y] = 1e-6;
    CHECK(cagedyn_sim_set_state(sim, 0.0, state, n) == CAGEDYN_OK);
    CHECK(cagedyn_sim_get_output(sim, cagedyn_model_find_output(m, "cage.y_ratio"), &ratio) == CAGEDYN_OK);
    cagedyn_sim_free(sim);
    free(state);
    return 1e-6 / ratio;
}

/* Both integrators end at the same positions, and CVODE lives on the Jacobian of the library. */
static void check_end(const cagedyn_model *m, const double *state, double clearance, char **argv)
{
    double duration = atof(argv[2]), pitch_radius = atof(argv[3]), max_step = atof(argv[4]);
    double bound = atof(argv[5]);
    double largest = 0.0, *end = numbers(cagedyn_model_state_count(m));
    long steps = 0, evaluations = 0, jacobians = 0, quotients = -1, failures_of_newton = -1;
    run r;
    start(&r, m, state, TOLERANCE, clearance, pitch_radius);
    CHECK(CVodeSetMaxStep(r.memory, max_step) == CV_SUCCESS);
    advance(&r, duration);
    CHECK(CVodeGetNumSteps(r.memory, &steps) == CV_SUCCESS);
    CHECK(CVodeGetNumRhsEvals(r.memory, &evaluations) == CV_SUCCESS);
    CHECK(CVodeGetNumJacEvals(r.memory, &jacobians) == CV_SUCCESS && jacobians > 0);
    CHECK(CVodeGetNumLinRhsEvals(r.memory, &quotients) == CV_SUCCESS && quotients == 0);

    /* A wrong matrix shows as equations that Newton's method does not solve; kinks let it fail now and then. */
    CHECK(CVodeGetNumNonlinSolvConvFails(r.memory, &failures_of_newton) == CV_SUCCESS);
    CHECK(failures_of_newton >= 0 && 100 * failures_of_newton < steps);

    /* CVODE left the simulation where it was; now it runs by itself. */
    double time = NAN;
    CHECK(cagedyn_sim_time(r.host.sim, &time) == CAGEDYN_OK && time == 0.0);
    CHECK(cagedyn_sim_advance_to(r.host.sim, duration) == CAGEDYN_OK);
    CHECK(cagedyn_sim_get_state(r.host.sim, end, r.host.states) == CAGEDYN_OK);
    for (int64_t k = 0; k < cagedyn_model_position_count(m); k++) {
        double difference = fabs(N_VGetArrayPointer(r.y)[k] - end[k]) / scale(m, k, clearance, pitch_radius);
        CHECK(difference < bound);
        largest = fmax(largest, difference);
    }
    printf("difference %.1e of the clearance; CVODE: %ld steps, %ld evaluations, %ld Jacobians, "
           "%ld failures of Newton's method\n",
           largest, steps, evaluations, jacobians, failures_of_newton);
    finish(&r);
    free(end);
}

/* A first step that throws the cage out of its guide is refused by the library and shortened by CVODE. */
static void check_recovery(const cagedyn_model *m, double *state, double clearance, double pitch_radius)
{
    const double h = 1e-3, far = 10.0 * clearance;
    int64_t speed = cagedyn_model_position_count(m) + cagedyn_model_find_state(m, "cage.y");
    run r;
    state[speed] = far / h;
    start(&r, m, state, 1e-6, clearance, pitch_radius);
    CHECK(CVodeSetInitStep(r.memory, h) == CV_SUCCESS);
    advance(&r, h);
    CHECK(r.host.refused > 0);

    /* States without forces may be tried again, what is not a number may not. */
    double *y = N_VGetArrayPointer(r.y);
    N_Vector rate = N_VClone(r.y);
    y[cagedyn_model_find_state(m, "cage.y")] = 1.0;
    CHECK(rates(h, r.y, rate, &r.host) == 1);
    CHECK(jacobian(h, r.y, rate, r.matrix, &r.host, NULL, NULL, NULL) == 1);
    y[0] = NAN;
    CHECK(rates(h, r.y, rate, &r.host) == -1);
    CHECK(jacobian(h, r.y, rate, r.matrix, &r.host, NULL, NULL, NULL) == -1);
    N_VDestroy(rate);
    finish(&r);
}

int main(int argc, char **argv)
{
    if (argc != 6) return 2;
    cagedyn_model *model = load_model(argc, argv);
    cagedyn_sim *sim = cagedyn_sim_new(model);
    int64_t n = cagedyn_model_state_count(model);
    double *state = numbers(n), clearance = clearance_of(model);
    CHECK(cagedyn_sim_get_state(sim, state, n) == CAGEDYN_OK);
    check_end(model, state, clearance, argv);
    check_recovery(model, state, clearance, atof(argv[3]));
    cagedyn_sim_free(sim);
    cagedyn_model_free(model);
    free(state);
    return failures != 0;
}
