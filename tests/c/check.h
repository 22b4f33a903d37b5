/* The assertion of the programs in C that test the C interface. */
#ifndef FATHOM_TESTS_C_CHECK_H
#define FATHOM_TESTS_C_CHECK_H

#include <stdio.h>

#include "fathom.h"

/* The number of conditions that did not hold: the program's exit status is 0 only if it is 0. */
static int failures = 0;

/* Prints and counts a condition that does not hold, with the last error of the library. */
#define CHECK(condition)                                                                   \
  do {                                                                                     \
    if (!(condition)) {                                                                    \
      fprintf(stderr, "%s:%d: %s (%s)\n", __FILE__, __LINE__, #condition, fathom_error()); \
      ++failures;                                                                          \
    }                                                                                      \
  } while (0)

#endif
