#include "fathom/attribution/model/opengl_drivers.h"

#include <algorithm>
#include <cmath>

#include "fathom/numeric/unit_roundoff.h"

namespace fathom::attribution {
namespace {

/// The finest grid with which snapping moves corners by as much as softpipe's roundings may move an
/// edge: 12u of the image's size (docs/validation.md, "A driver that does not snap").
int bits_of_roundings(const Camera& camera) {
  const double moved = 12 * unit_roundoff<float> * (std::max(camera.width, camera.height) + 1.0);
  return static_cast<int>(std::floor(-std::log2(2 * moved)));
}

}  // namespace

DriverFacts driver_facts(const std::string& version) {
  const auto names = [&](const char* driver) { return version.find(driver) != std::string::npos; };
  if (names("llvmpipe")) return {.depth_before_snap = true, .nearest_codes = true};
  if (names("softpipe")) return {.depth_before_snap = true, .snaps = false};
  return {};
}

void set_driver_facts(const std::string& version, int subpixel_bits, const Camera& camera,
                      RendererModel& model) {
  const DriverFacts facts = driver_facts(version);
  auto& raster = std::get<RasterModel>(model.kind);
  raster.depth_before_snap = facts.depth_before_snap;
  raster.nearest_codes = facts.nearest_codes;
  raster.subpixel_bits = facts.snaps ? subpixel_bits : bits_of_roundings(camera);
  model.watertight = facts.snaps;
}

}  // namespace fathom::attribution
