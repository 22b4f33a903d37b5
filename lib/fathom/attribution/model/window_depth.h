#pragma once

#include "fathom/camera/camera.h"
#include "fathom/depth_format/depth_format.h"
#include "fathom/numeric/interval.h"

namespace fathom::attribution {

/// How a depth D becomes a window depth z: perspective z = a + b/D, orthographic z = a·D + b,
/// logarithmic z = ln(D/near)/ln(far/near).
///
/// Units    depths in scene units; window depths without a unit, 0 to 1 between near and far.
/// Exact    rounded to binary64 several times.
struct WindowDepth {
  bool perspective = true;
  /// Whether the renderer passes through z_ndc = 2z − 1 (OpenGL's default).
  bool minus_one_to_one = true;
  double a = 0, b = 0;
  /// Of a logarithmic one; ln(far/near) is 0 for the others.
  double near = 0, log_range = 0;

  [[nodiscard]] double of_depth(double depth) const;
  /// Infinite where no finite depth has this window depth or one beyond it.
  [[nodiscard]] double to_depth(double window) const;
  /// Whether nearer surfaces have greater window depths.
  [[nodiscard]] bool reversed() const { return log_range == 0 && (perspective ? b > 0 : a < 0); }
};

/// `mapping` is standard, opengl, log_ulrich or one of the reversed and infinite mappings; `near`
/// and `far` are depths.
WindowDepth window_depth(ProjectionModel projection, Mapping mapping, double near, double far);

/// A window depth z that a fragment shader computes in binary32 from q, which is 1/w as it is
/// interpolated (perspective), or the interpolated window depth (orthographic):
///   t = term + factor·q;  reversed: z = t;  log_ulrich: z = scale·log2(t).
struct WrittenDepth {
  Mapping mapping = Mapping::reversed;
  bool of_w = true;  ///< q is 1/w
  float term = 0, factor = 0, scale = 1;

  /// Without the roundings of the shader.
  [[nodiscard]] double value(double q) const;
  /// All values that the shader may compute if its q is at most `q_error` from `q`, with log2 as
  /// exact as the shading language demands ([GLSL46] 4.7.1).
  [[nodiscard]] Interval values(double q, double q_error) const;
};

/// The constants for a mapping, `reversed` or `log_ulrich`, from OpenGL's window depths. `near` and
/// `far` are depths in scene units.
/// Fails    InputError for a logarithmic depth whose near plane is not in front of the eye.
WrittenDepth written_depth(ProjectionModel projection, Mapping mapping, double near, double far);

/// The greatest error that a shader's log2 may have in binary32 where its exact value is `log2_x`:
/// 3 ulp, but 2⁻²¹ for x from ½ to 2 ([GLSL46] 4.7.1).
double log2_error(double log2_x);

/// The quantity that records a depth D: D, 1/D, or ln D.
enum class DepthTerm { depth, inverse, logarithm };

double term_of(DepthTerm term, double depth);
/// The depth of a term; infinity if no finite depth has this term.
double depth_of(DepthTerm term, double value);

/// How the depths of a renderer were recorded: as factor·term + offset, rounded. Examples are
/// millimetres, codes of 16 bits, half floats, and window depths that were not decoded.
///
/// Exact    in binary64; a value recorded in binary32 is known up to two of its roundings.
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
  double origin = 0, step = 0;  ///< of recorded values
  /// An additional error of recorded values, from estimated constants.
  double error = 0;

  /// The recorded value of a depth, before and after rounding.
  [[nodiscard]] double exact(double depth) const;
  [[nodiscard]] double rounded(double recorded) const;
  [[nodiscard]] double to_depth(double recorded) const;
  /// The distance between neighbouring values about a recorded value.
  [[nodiscard]] double step_at(double recorded) const;
  /// The depths that may be read where one of `depths` was recorded.
  [[nodiscard]] Interval read_back(const Interval& depths) const;
};

/// The nearest binary16 number; numbers above 65504 remain unchanged.
double round_to_binary16(double x);

}  // namespace fathom::attribution
