#include "fathom/triangle/options.h"

#include <array>
#include <utility>

namespace fathom {

std::optional<Channel> channel_named(const std::string& name) {
  static constexpr std::array<std::pair<const char*, Channel>, 10> names{
      {{"Z", Channel::Z},
       {"A", Channel::A},
       {"Zlow", Channel::Zlow},
       {"distance", Channel::distance},
       {"id", Channel::id},
       {"face", Channel::face},
       {"object", Channel::object},
       {"N", Channel::N},
       {"P", Channel::P},
       {"bary", Channel::bary}}};
  for (const auto& [known, channel] : names) {
    if (name == known) return channel;
  }
  return std::nullopt;
}

void add(RenderStatistics& sum, const RenderStatistics& part) {
  sum.degenerate_triangles += part.degenerate_triangles;
  sum.culled_triangles += part.culled_triangles;
  sum.samples_tested += part.samples_tested;
  sum.samples_covered += part.samples_covered;
  sum.pixels_with_surface += part.pixels_with_surface;
  sum.facing += part.facing;
  sum.edges += part.edges;
  sum.visibility += part.visibility;
  sum.range += part.range;
  sum.coverage += part.coverage;
  sum.coverage_rounding += part.coverage_rounding;
  sum.rounding += part.rounding;
  sum.double_word_roundings += part.double_word_roundings;
  sum.exact_setups += part.exact_setups;
  sum.same_plane += part.same_plane;
  sum.double_words += part.double_words;
  sum.grid_setups += part.grid_setups;
}

}  // namespace fathom
