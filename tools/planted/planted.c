/* Defects that sanitizers must find in C, one by the name that is given. */
#include <limits.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

static int shared;

static void *write_shared(void *data)
{
    shared = *(int *)data;
    return NULL;
}

int main(int argc, char **argv)
{
    const char *defect = argc > 1 ? argv[1] : "";
    volatile int n = argc;
    if (strcmp(defect, "overflow") == 0) {
        double *x = (double *)malloc(3 * sizeof(double));
        if (x == NULL) return 0;
        x[n + 1] = 1.0; /* argc is 2 */
        n = (int)x[n + 1];
        free(x);
    }
    if (strcmp(defect, "undefined") == 0) n = INT_MAX - 1 + n;
    if (strcmp(defect, "race") == 0) {
        pthread_t other;
        int one = 1, two = 2;
        if (pthread_create(&other, NULL, write_shared, &one) != 0) return 0;
        write_shared(&two);
        pthread_join(other, NULL);
    }
    return n == 12345 || shared == 12345;
}
