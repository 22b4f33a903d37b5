#include "fathom/attribution/pixels/storage_step.h"

#include <algorithm>
#include <cmath>

namespace fathom::attribution {

double binary32_spacing(double x) {
  if (x == 0 || !std::isfinite(x)) return 0x1p-149;
  return std::ldexp(1.0, std::max(std::ilogb(x), -126) - 23);
}

double storage_step(const RasterModel& model, double window) {
  double resolved = binary32_spacing(window);
  if (model.written && is_logarithmic(model.written->mapping)) {
    const double scale = model.written->scale;
    resolved = std::max(resolved, std::abs(scale) * log2_error(window / scale));
  } else if (!model.written && model.mapping == Mapping::opengl) {
    resolved = std::max(resolved, 0x1p-24);  // z_ndc/2 + 1/2: as numbers of about a half
  }
  if (model.storage == Storage::float16) return 0x1p13 * resolved;
  if (!is_unorm(model.storage)) return resolved;
  return std::max(resolved, 1.0 / greatest_code(model.storage));
}

}  // namespace fathom::attribution
