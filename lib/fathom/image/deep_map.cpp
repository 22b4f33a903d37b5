#include "fathom/image/deep_map.h"

#include <limits>

#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {
namespace {

/// A channel that holds `background` so far.
template <class T>
Samples<T>& add_channel(DepthMap& map, const char* name, T background) {
  const std::size_t pixels = std::size_t{map.width} * map.height;
  map.channels.push_back({name, Samples<T>(pixels, background)});
  return std::get<Samples<T>>(map.channels.back().values);
}

}  // namespace

DepthMap flat_map(const DeepMap& deep) {
  const StandardArithmetic standard;
  constexpr float none = std::numeric_limits<float>::infinity();
  DepthMap map = deep.description;
  map.channels.reserve(5);  // references to channels stay
  auto &depth = add_channel(map, "Z", none), &back = add_channel(map, "ZBack", none);
  auto& coverage = add_channel(map, "A", 0.0F);
  auto& count = add_channel(map, samples_channel, 0.0F);
  auto& id = add_channel(map, "id", no_surface);
  std::size_t next = 0;
  for (std::size_t k = 0; k < deep.counts.size(); ++k) {
    const std::size_t first = next, end = next + deep.counts[k];
    count[k] = static_cast<float>(deep.counts[k]);
    if (first != end) {
      depth[k] = deep.samples[first].Z;
      back[k] = deep.samples[first].ZBack;
      id[k] = deep.samples[first].id;
    }
    double covered = 0;
    for (; next < end; ++next) covered += static_cast<double>(deep.samples[next].area);
    coverage[k] = static_cast<float>(covered);
  }
  return map;
}

}  // namespace fathom
