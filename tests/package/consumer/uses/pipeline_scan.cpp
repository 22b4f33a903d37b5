#include <fathom/pipeline/scan/line.h>

bool use_pipeline_scan() {
  int pixels = 0;
  fathom::pipeline::bresenham_line({0, 0, 4, 2}, {}, [&](const auto&, const auto&) { ++pixels; });
  return pixels == 5;
}
