#include "fathom/triangle/options.h"

#include <cmath>

#include "fathom/failures/errors.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/threads/threads.h"

namespace fathom {

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
  sum.areas_with_exact_ends += part.areas_with_exact_ends;
  sum.exact_setups += part.exact_setups;
  sum.same_plane += part.same_plane;
  sum.double_words += part.double_words;
  sum.samples_in_binary64 += part.samples_in_binary64;
  sum.grid_setups += part.grid_setups;
}

void require_meaningful(const RenderOptions& options) {
  const StandardArithmetic standard;
  require_thread_count(options.threads);
  if (options.channels.empty()) throw UsageError(Setting{"channels"}, "expected at least one");
  const DepthEncoding& encoding = options.depth_encoding;
  const auto is_positive = [](double x) { return x > 0 && std::isfinite(x); };
  if (encoding.type == StoredType::scaled_unorm16 &&
      !(is_positive(encoding.scale) && is_positive(encoding.divisor) &&
        is_positive(encoding.scale / encoding.divisor))) {
    throw UsageError(Setting{"depth_encoding.scale"}, "expected a positive number");
  }
  if (!(options.fast.widening >= 1 && std::isfinite(options.fast.widening))) {
    throw UsageError(Setting{"fast.widening"}, "expected a number from 1 on");
  }
}

}  // namespace fathom
