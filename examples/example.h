/* What the C examples share: the end of the program after a failure, and arrays. */
#ifndef CAGEDYN_EXAMPLE_H
#define CAGEDYN_EXAMPLE_H

#include <stdio.h>
#include <stdlib.h>

#include "cagedyn.h"

/* Prints the last error and ends the program. */
static void fail(const char *what)
{
    fprintf(stderr, "%s: %s (%s)\n", what, cagedyn_error_message(), cagedyn_status_name(cagedyn_error_status()));
    exit(EXIT_FAILURE);
}

static inline double *array(int64_t length)
{
    double *values = length > 0 ? (double *)calloc((size_t)length, sizeof(double)) : NULL;
    if (values == NULL) fail("array");
    return values;
}

/* The model of the scene file that the program was called with. */
static inline cagedyn_model *model_of(int argc, char **argv)
{
    if (argc != 2) {
        fprintf(stderr, "usage: %s SCENE.json\n", argv[0]);
        exit(EXIT_FAILURE);
    }
    cagedyn_model *model = cagedyn_model_from_file(argv[1]);
    if (model == NULL) fail(argv[1]);
    return model;
}

#endif
