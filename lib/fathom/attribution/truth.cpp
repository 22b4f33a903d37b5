#include "fathom/attribution/truth.h"

#include <limits>

#include "fathom/attribution/pixels/corner_numbers.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/render.h"

namespace fathom::attribution {

Truth make_truth(const Scene& scene, const Camera& camera) {
  const StandardArithmetic standard;
  Truth truth{.mesh = world_mesh(scene), .camera = camera};
  truth.corner_numbers = corner_numbers(truth.mesh);
  const DepthMap map =
      render(scene, camera, {.channels = {Channel::Z, Channel::Zlow, Channel::id}});
  const auto& high = *map.values<float>("Z");
  const auto& low = *map.values<float>("Zlow");
  const auto& id = *map.values<std::uint32_t>("id");
  truth.triangles.assign(id.begin(), id.end());
  truth.depths.resize(high.size());
  for (std::size_t i = 0; i < high.size(); ++i) {
    truth.depths[i] = id[i] == no_surface ? std::numeric_limits<double>::infinity()
                                          : double{high[i]} + double{low[i]};
  }
  return truth;
}

}  // namespace fathom::attribution
