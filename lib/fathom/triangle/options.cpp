#include "fathom/triangle/options.h"

namespace fathom {

std::string_view name_of(Engine engine) {
  return engine == Engine::fast ? "fast" : "reference";
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
