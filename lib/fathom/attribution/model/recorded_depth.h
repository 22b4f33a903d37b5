#pragma once

#include "fathom/numeric/interval.h"

namespace fathom::attribution {

/// What a depth D is recorded by: itself, 1/D, or ln D.
enum class DepthTerm { depth, inverse, logarithm };

double term_of(DepthTerm term, double depth);
/// The depth of a term; of one that no finite depth has, infinity.
double depth_of(DepthTerm term, double value);

/// How depths were written down after a renderer had made them: as factor·term + offset, rounded.
/// Millimetres, codes of 16 bits, half floats, window depths that were not decoded.
///
/// Exact    in binary64; what is recorded as a number of binary32 is known to two roundings of it.
struct RecordedDepth {
  enum class Rounding {
    binary32,  ///< as other maps are
    binary16,
    nearest,  ///< to origin + k·step
    down
  };

  DepthTerm term = DepthTerm::depth;
  double factor = 1, offset = 0;
  Rounding rounding = Rounding::binary32;
  double origin = 0, step = 0;  ///< of what is recorded
  /// How far off what is recorded may be besides: of constants that were estimated.
  double error = 0;

  /// What is recorded for a depth, before it is rounded and after.
  [[nodiscard]] double exact(double depth) const;
  [[nodiscard]] double rounded(double recorded) const;
  [[nodiscard]] double to_depth(double recorded) const;
  /// The distance of neighbours about a recorded value.
  [[nodiscard]] double step_at(double recorded) const;
  /// The depths that may be read where one of `depths` was recorded.
  [[nodiscard]] Interval read_back(const Interval& depths) const;
};

/// The number of binary16 that is nearest; greater ones than 65504 stay what they are.
double round_to_binary16(double x);

}  // namespace fathom::attribution
