#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "fathom/depth_format/depth_format.h"

/// How far apart the depths are that a format can store.
namespace fathom::studies {

/// At one depth.
struct Step {
  double depth;
  double step;       ///< the larger distance to a neighbouring code's depth
  double bin_width;  ///< of the depths that are stored alike
};

struct FormatSteps {
  DepthFormat format;
  std::vector<Step> steps;
  std::uint64_t codes;                    ///< between near and far
  double share_below_2, share_below_10;   ///< of the codes, up to 2 and to 10 times near
  double greatest_relative, greatest_at;  ///< step over depth, and the depth where it is greatest
};

/// Of every format, at these depths from near to far.
std::vector<FormatSteps> measure_formats(double near, double far, const std::vector<double>& depths,
                                         const std::function<void(double)>& tick);

/// The mapping of the least step of a storage at a depth.
struct BestMapping {
  Storage storage;
  double depth;
  Mapping mapping;
  double step;
};
/// opengl is standard in the ideal model, and is left out.
std::vector<BestMapping> best_mappings(const std::vector<FormatSteps>& all);

/// Neighbouring depths over which one mapping is the best of a storage.
struct BestRange {
  Storage storage;
  Mapping mapping;
  double from, to;
};
std::vector<BestRange> best_ranges(const std::vector<BestMapping>& best);

/// The step at a depth when near or far is moved.
enum class Moved { near, far };
struct MovedStep {
  Moved moved;
  DepthFormat format;
  double depth;
  double step;

  [[nodiscard]] double place() const { return moved == Moved::near ? format.near : format.far; }
};
/// By factors from 0.01 to 100, at the geometric mean of near and far.
std::vector<MovedStep> move_near_and_far(double near, double far);

}  // namespace fathom::studies
