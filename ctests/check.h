/* Small test macros: a failed check prints its place and makes the program return 1. */
#ifndef CAGEDYN_CHECK_H
#define CAGEDYN_CHECK_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cagedyn.h"

static int failures = 0;

#define CHECK(condition)                                                                                     \
    do {                                                                                                     \
        if (!(condition)) {                                                                                  \
            failures += 1;                                                                                   \
            fprintf(stderr, "%s:%d: %s (last error: %s)\n", __FILE__, __LINE__, #condition,                  \
                    cagedyn_error_message());                                                                \
        }                                                                                                    \
    } while (0)

/* Fails with a given status and a message that contains a text. */
#define CHECK_FAILS(call, status, text)                                                                      \
    do {                                                                                                     \
        CHECK((call) == (status));                                                                           \
        CHECK(cagedyn_error_status() == (status));                                                           \
        CHECK(strstr(cagedyn_error_message(), (text)) != NULL);                                              \
    } while (0)

/* The model of a scene file, or the end of the program. */
static inline cagedyn_model *load_model(int argc, char **argv)
{
    cagedyn_model *model = argc > 1 ? cagedyn_model_from_file(argv[1]) : NULL;
    if (model == NULL) {
        fprintf(stderr, "usage: %s SCENE (%s)\n", argv[0], cagedyn_error_message());
        exit(2);
    }
    return model;
}

/* Place of a name among `count` of them, or -1. */
static inline int64_t place_of(const char *name, const char *(*name_at)(int64_t), int64_t count)
{
    for (int64_t i = 0; i < count; i++) {
        if (strcmp(name_at(i), name) == 0) return i;
    }
    return -1;
}

static inline double *numbers(int64_t n)
{
    double *x = (double *)calloc((size_t)n, sizeof(double));
    if (x == NULL) exit(2);
    return x;
}

#endif
