#include <fathom/drawing/drawing.h>

#include <string>

#include "one_triangle.h"

bool use_drawing() {
  const fathom::Scene scene = one_triangle();
  const fathom::Drawing drawing = fathom::draw(scene, small_camera(), {});
  return svg_of(drawing).find("<path") != std::string::npos;
}
