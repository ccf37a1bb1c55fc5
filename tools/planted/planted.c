/* Defects that sanitizers must find in C, one by the name that is given. */
#include <limits.h>
#include <stdlib.h>
#include <string.h>

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
    return n == 12345;
}
