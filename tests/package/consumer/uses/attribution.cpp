#include <fathom/attribution/attribution.h>
#include <fathom/attribution/model/named_models.h>
#include <fathom/render.h>

#include "one_triangle.h"

bool use_attribution() {
  using namespace fathom::attribution;
  const fathom::Scene scene = one_triangle();
  const fathom::Camera camera = small_camera();
  const OtherMap other = other_map(fathom::render(scene, camera).map);
  const Attribution found =
      attribute_and_name(make_truth(scene, camera), other, model_named("float32-ray"));
  return found.count(PixelClass::unexplained) == 0;
}
