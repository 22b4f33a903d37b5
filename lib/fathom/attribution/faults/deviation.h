#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>

#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/model/window_depth.h"
#include "fathom/camera/camera.h"

namespace fathom::attribution {

/// Parameters of a whole image that may deviate slightly: the camera's pose, its intrinsic
/// parameters, the lens, the stored depths.
enum class Parameter {
  turn_x,  ///< of the pose: X′ = X + turn × X + move in the camera's frame, rad
  turn_y,
  turn_z,
  move_x,  ///< scene units
  move_y,
  move_z,
  focal_x,  ///< relative
  focal_y,
  centre_x,  ///< pixels
  centre_y,
  skew,  ///< pixels
  k1,    ///< radial distortion, as of a SamplePosition
  k2,
  scale,   ///< of depths, relative
  offset,  ///< of depths, scene units
  near,    ///< of the decoder: relative, of 1/near (perspective) or of near
  far,
  bias  ///< of window depths, in steps of the storage
};
inline constexpr int parameter_count = 18;

/// A value for each parameter.
using Deviation = Eigen::Matrix<double, parameter_count, 1>;

inline double of(const Deviation& d, Parameter p) {
  return d[static_cast<int>(p)];
}

/// The deviating camera. Ignores k1, k2 and the parameters of depths. The turn is applied as a
/// rotation.
Camera deviating(const Camera& camera, const Deviation& deviation);

/// How a model stores depths; nullopt for a model without window depths.
struct WindowSteps {
  WindowDepth window;
  double step = 0;  ///< a typical step, as a window depth
};
std::optional<WindowSteps> window_steps(const Camera& camera, const RendererModel& model);

/// A deviation of depths: scaled and offset, their window depths biased, then decoded with another
/// near and far.
class DepthDeviation {
 public:
  DepthDeviation(const Camera& camera, const RendererModel& model, const Deviation& deviation);

  /// a and the result are 1/D (perspective) or D (orthographic).
  [[nodiscard]] double of(double a) const;
  /// The derivatives by a and by scale, offset, near, far and bias.
  struct Slopes {
    double a, scale, offset, near, far, bias;
  };
  [[nodiscard]] Slopes slopes(double a) const;
  /// The depth that became `depth`.
  [[nodiscard]] double undone(double depth) const;

  /// The near and far that the decoder used; scene units.
  [[nodiscard]] double near() const;
  [[nodiscard]] double far() const;

 private:
  [[nodiscard]] double scaled(double a) const;
  [[nodiscard]] double window(double a) const;
  [[nodiscard]] double biased(double a) const;

  bool perspective_, decodes_;
  double bias_factor_ = 1, bias_term_ = 0;  ///< of an affine value
  double factor_per_step_ = 0, term_per_step_ = 0;
  double scale_, offset_;
  double first_ = 0, second_ = 1;                  ///< affine values at near and far
  double read_as_first_ = 0, read_as_second_ = 1;  ///< near and far of the decoder
};

/// Parameters that deviate together as a named fault.
struct DeviationSet {
  /// As of a Finding.
  const char* kind;
  /// The subject of a sentence "… is off"; empty for kinds with a different sentence: bias, shift,
  /// decoding.
  const char* subject;
  std::span<const Parameter> parameters;
  /// Whether focal_x and focal_y are equal.
  bool one_focal = false;

  [[nodiscard]] int size() const {
    return static_cast<int>(parameters.size()) - (one_focal ? 1 : 0);
  }
  [[nodiscard]] bool moves_the_view() const;
  [[nodiscard]] bool has(Parameter p) const;
};

/// All sets that are tried, the smallest first.
std::span<const DeviationSet> deviation_sets();

/// A parameter's name and unit, as an Estimate has them.
const char* name_of(Parameter p);
const char* unit_of(Parameter p);

}  // namespace fathom::attribution
