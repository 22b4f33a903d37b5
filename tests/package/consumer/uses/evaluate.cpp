#include <fathom/evaluate.h>

#include "one_triangle.h"

bool use_evaluate() {
  return fathom::evaluate(one_triangle(), one_triangle(), {small_camera()}).depth->metrics.mae == 0;
}
