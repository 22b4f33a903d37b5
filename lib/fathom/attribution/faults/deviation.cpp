#include "fathom/attribution/faults/deviation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

#include "fathom/attribution/pixels/stored_values.h"
#include "fathom/camera/camera.h"
#include "fathom/geometry/eigen_arrays.h"

namespace fathom::attribution {
namespace {

using P = Parameter;

constexpr std::array focal{P::focal_x, P::focal_y};
constexpr std::array one_x{P::focal_x};
constexpr std::array one_y{P::focal_y};
constexpr std::array roll{P::turn_z};
constexpr std::array pitch{P::turn_x};
constexpr std::array yaw{P::turn_y};
constexpr std::array right{P::move_x};
constexpr std::array down{P::move_y};
constexpr std::array forward{P::move_z};
constexpr std::array across{P::centre_x};
constexpr std::array along{P::centre_y};
constexpr std::array centre{P::centre_x, P::centre_y};
constexpr std::array skewed{P::skew};
constexpr std::array barrel{P::k1};
constexpr std::array lens{P::k1, P::k2};
constexpr std::array scaled{P::scale};
constexpr std::array offset{P::offset};
constexpr std::array affine{P::scale, P::offset};
constexpr std::array biased{P::bias};
constexpr std::array near{P::near};
constexpr std::array far{P::far};
constexpr std::array planes{P::near, P::far};
constexpr std::array turned{P::turn_x, P::turn_y, P::turn_z};
constexpr std::array moved{P::move_x, P::move_y, P::move_z};
constexpr std::array resized{P::focal_x, P::focal_y, P::centre_x, P::centre_y};
constexpr std::array intrinsic{P::focal_x, P::focal_y, P::centre_x, P::centre_y, P::skew};
constexpr std::array pose{P::turn_x, P::turn_y, P::turn_z, P::move_x, P::move_y, P::move_z};
constexpr std::array whole_lens{P::focal_x, P::focal_y, P::centre_x, P::centre_y,
                                P::skew,    P::k1,      P::k2};
constexpr std::array camera{P::turn_x, P::turn_y,  P::turn_z,  P::move_x,   P::move_y,
                            P::move_z, P::focal_x, P::focal_y, P::centre_x, P::centre_y,
                            P::skew,   P::k1,      P::k2};

constexpr std::array sets{
    DeviationSet{"bias", "", biased},
    DeviationSet{"focal-length", "the focal length", focal, true},
    DeviationSet{"scale", "the scale of depths", scaled},
    DeviationSet{"decoding", "", near},
    DeviationSet{"decoding", "", far},
    DeviationSet{"shift", "", across},
    DeviationSet{"shift", "", along},
    DeviationSet{"rotation", "the camera's roll", roll},
    DeviationSet{"rotation", "the camera's pitch", pitch},
    DeviationSet{"rotation", "the camera's yaw", yaw},
    DeviationSet{"translation", "the camera's position to the right", right},
    DeviationSet{"translation", "the camera's position downwards", down},
    DeviationSet{"translation", "the camera's position forwards", forward},
    DeviationSet{"aspect", "the horizontal focal length", one_x},
    DeviationSet{"aspect", "the vertical focal length", one_y},
    DeviationSet{"skew", "the skew", skewed},
    DeviationSet{"distortion", "the lens: its k1", barrel},
    DeviationSet{"scale", "depths have an offset: their zero", offset},
    DeviationSet{"shift", "", centre},
    DeviationSet{"aspect", "both focal lengths", focal},
    DeviationSet{"distortion", "the lens: its k1 and k2", lens},
    DeviationSet{"scale", "the scale and the zero of depths", affine},
    DeviationSet{"decoding", "", planes},
    DeviationSet{"rotation", "the camera's rotation", turned},
    DeviationSet{"translation", "the camera's position", moved},
    DeviationSet{"intrinsics", "the focal length and the principal point", resized, true},
    DeviationSet{"intrinsics", "focal lengths and principal point", resized},
    DeviationSet{"intrinsics", "the camera's intrinsic parameters", intrinsic},
    DeviationSet{"pose", "the camera's pose", pose},
    DeviationSet{"intrinsics", "the camera's intrinsic parameters and lens", whole_lens},
    DeviationSet{"camera", "the camera", camera}};

constexpr std::array<const char*, parameter_count> names{
    "turn about x", "turn about y", "turn about z",   "move in x",
    "move in y",    "move in z",    "focal length x", "focal length y",
    "centre x",     "centre y",     "skew",           "k1",
    "k2",           "scale",        "offset",         "near",
    "far",          "bias"};
constexpr std::array<const char*, parameter_count> units{
    "rad",      "rad",      "rad",         "scene units", "scene units", "scene units",
    "relative", "relative", "pixels",      "pixels",      "pixels",      "",
    "",         "relative", "scene units", "scene units", "scene units", "steps of the storage"};

}  // namespace

std::span<const DeviationSet> deviation_sets() {
  return sets;
}

const char* name_of(Parameter p) {
  return names[static_cast<std::size_t>(p)];
}
const char* unit_of(Parameter p) {
  return units[static_cast<std::size_t>(p)];
}

bool DeviationSet::has(Parameter p) const {
  return std::find(parameters.begin(), parameters.end(), p) != parameters.end();
}

bool DeviationSet::moves_the_view() const {
  return std::any_of(parameters.begin(), parameters.end(),
                     [](Parameter p) { return p < Parameter::scale; });
}

Camera deviating(const Camera& camera, const Deviation& d) {
  const Eigen::Vector3d turn(d[0], d[1], d[2]);
  const double angle = turn.norm();
  Camera result = camera;
  auto view = geometry::as_matrix(result.world_to_camera);
  if (angle > 0) {
    view = (Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() * view).eval();
  }
  view.col(3) += Eigen::Vector3d(d[3], d[4], d[5]);
  result.projection.fx *= 1 + of(d, P::focal_x);
  result.projection.fy *= 1 + of(d, P::focal_y);
  result.projection.cx += of(d, P::centre_x);
  result.projection.cy += of(d, P::centre_y);
  result.projection.skew += of(d, P::skew);
  return result;
}

std::optional<WindowSteps> window_steps(const Camera& camera, const RendererModel& model) {
  constexpr double typical_window = 0.75;
  const auto* const raster = std::get_if<RasterModel>(&model.kind);
  if (raster == nullptr) return std::nullopt;
  return WindowSteps{
      window_depth(camera.projection.model, raster->stored_mapping(), camera.near, camera.far),
      storage_step(*raster, typical_window)};
}

DepthDeviation::DepthDeviation(const Camera& c, const RendererModel& model, const Deviation& d)
    : perspective_(is_perspective(c.projection)),
      decodes_(false),
      scale_(1 + attribution::of(d, P::scale)),
      offset_(attribution::of(d, P::offset)) {
  if (const std::optional<WindowSteps> stored = window_steps(c, model)) {
    const WindowDepth& w = stored->window;
    decodes_ = w.log_range == 0 && has_clip_planes(c);
    if (w.log_range != 0) {
      factor_per_step_ = (perspective_ ? -1 : 1) * w.log_range * stored->step;
    } else {
      term_per_step_ = stored->step / (perspective_ ? w.b : w.a);
    }
    bias_factor_ = std::exp(factor_per_step_ * attribution::of(d, P::bias));
    bias_term_ = term_per_step_ * attribution::of(d, P::bias);
  }
  if (!decodes_) return;
  first_ = perspective_ ? 1 / c.near : c.near;
  second_ = perspective_ ? 1 / c.far : c.far;
  read_as_first_ = first_ * (1 + attribution::of(d, P::near));
  read_as_second_ = second_ * (1 + attribution::of(d, P::far));
}

double DepthDeviation::near() const {
  return perspective_ ? 1 / read_as_first_ : read_as_first_;
}
double DepthDeviation::far() const {
  return perspective_ ? 1 / read_as_second_ : read_as_second_;
}

double DepthDeviation::scaled(double a) const {
  return perspective_ ? 1 / (scale_ / a + offset_) : scale_ * a + offset_;
}

/// 0 at near, 1 at far.
double DepthDeviation::window(double a) const {
  return (a - first_) / (second_ - first_);
}

double DepthDeviation::biased(double a) const {
  return bias_factor_ * a + bias_term_;
}

double DepthDeviation::of(double a) const {
  const double b = biased(scaled(a));
  return decodes_ ? read_as_first_ + window(b) * (read_as_second_ - read_as_first_) : b;
}

DepthDeviation::Slopes DepthDeviation::slopes(double a) const {
  const double b = scaled(a);
  Slopes s{};
  s.a = perspective_ ? scale_ * b * b / (a * a) : scale_;
  s.scale = perspective_ ? -b * b / a : a;
  s.offset = perspective_ ? -b * b : 1;
  for (double* slope : {&s.a, &s.scale, &s.offset}) *slope *= bias_factor_;
  const double c = biased(b);
  s.bias = factor_per_step_ * bias_factor_ * b + term_per_step_;
  if (!decodes_) return s;
  const double outer = (read_as_second_ - read_as_first_) / (second_ - first_);
  for (double* slope : {&s.a, &s.scale, &s.offset, &s.bias}) *slope *= outer;
  s.near = (1 - window(c)) * first_;
  s.far = window(c) * second_;
  return s;
}

double DepthDeviation::undone(double depth) const {
  double b = perspective_ ? 1 / depth : depth;
  if (decodes_) {
    const double z = (b - read_as_first_) / (read_as_second_ - read_as_first_);
    b = first_ + z * (second_ - first_);
  }
  b = (b - bias_term_) / bias_factor_;
  return ((perspective_ ? 1 / b : b) - offset_) / scale_;
}

}  // namespace fathom::attribution
