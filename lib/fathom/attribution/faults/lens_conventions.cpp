#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fathom/attribution/faults/hypotheses.h"
#include "fathom/attribution/model/lens_samples.h"
#include "fathom/failures/errors.h"
#include "fathom/lens/iterated_inverses.h"
#include "fathom/lens/sample_plane.h"
#include "fathom/lens/stage.h"

// The right numbers of a lens, used wrongly: by the convention of another program, in the wrong
// direction, or by an inverse that stops early. Each hypothesis has a ray for every pixel, computed
// as the faulty program computes it; the bounds of the renderer's model then judge every value.
namespace fathom::attribution {
namespace {

using lens::PlanePoint;

/// A lens that a program uses in place of the right one, and the fault as a clause.
struct Misreading {
  Lens lens;
  std::string text;
};

/// A model whose numbers are passed to another model.
struct Confusion {
  LensModel right, used;
  /// The number of `right` that each number of `used` is.
  std::vector<std::size_t> places;
  std::string_view why;
};

const std::vector<Confusion>& confusions() {
  using enum LensModel;
  constexpr std::string_view
      angle_for_radius =
          "its polynomial has the radius in the plane as variable, not the angle to the axis; use "
          "the renderer's model without fisheye",
      radius_for_angle =
          "its polynomial has the angle to the axis as variable, not the radius in the plane; use "
          "the renderer's fisheye model",
      power_for_denominator =
          "OpenCV's k4 to k6 stand in the denominator, k4 is not the coefficient of r⁸";
  static const std::vector<Confusion> list{
      {brown,
       full_opencv,
       {0, 1, 4, 5, 2, 3},
       "k4 is the coefficient of r⁸, OpenCV's k4 stands in the denominator"},
      {brown,
       full_opencv,
       {0, 1, 2, 3, 4, 5},
       "OpenCV's order is k1 k2 p1 p2 k3, this list is k1 k2 k3 k4 p1 p2"},
      {full_opencv, brown, {0, 1, 4, 5, 2, 3}, power_for_denominator},
      {opencv_14, brown, {0, 1, 4, 5, 2, 3}, power_for_denominator},
      {opencv,
       brown,
       {0, 1, 2, 3},
       "the list is k1 k2 p1 p2, not k1 k2 k3 k4; pass p1 and p2 last"},
      {brown, opencv_fisheye, {0, 1, 2, 3}, angle_for_radius},
      {opencv, opencv_fisheye, {0, 1, 2, 3}, angle_for_radius},
      {radial, radial_fisheye, {0, 1}, angle_for_radius},
      {simple_radial, simple_radial_fisheye, {0}, angle_for_radius},
      {opencv_fisheye, brown, {0, 1, 2, 3}, radius_for_angle},
      {opencv_fisheye, opencv, {0, 1, 2, 3}, radius_for_angle},
      {radial_fisheye, radial, {0, 1}, radius_for_angle},
      {simple_radial_fisheye, simple_radial, {0}, radius_for_angle}};
  return list;
}

/// The lenses that misread conventions make of a lens.
class Misreadings {
 public:
  explicit Misreadings(const Lens& lens)
      : lens_(lens),
        name_(name_of(lens.model)),
        coefficients_(has_stage(lens.model) ? entry_of(lens.model).distortion
                                            : std::span<const std::string_view>()) {
    exchange();
    const Names all(coefficients_.begin(), coefficients_.end());
    for (const Names& names : std::initializer_list<Names>{all, {"k1"}, {"p1"}, {"p1", "p2"}})
      negate(names);
    for (const Names& names :
         std::initializer_list<Names>{{"p1", "p2"},
                                      {"k4", "k5", "k6"},
                                      {"k3", "k4", "k5", "k6"},
                                      {"k2", "k3", "k4", "k5", "k6", "p1", "p2"},
                                      {"k1"},
                                      all})
      leave_out(names);
    take_for_other_models();
    take_for_other_fisheyes();
  }
  [[nodiscard]] std::vector<Misreading> list() && { return std::move(list_); }

 private:
  using Names = std::vector<std::string_view>;

  /// Not if nothing changes, if the lens is in the list, or if its model does not take the numbers.
  void add(const Lens& lens, std::string text) {
    const bool is_known = std::any_of(list_.begin(), list_.end(),
                                      [&](const Misreading& other) { return other.lens == lens; });
    if (lens == lens_ || is_known || find_fault(lens)) return;
    list_.push_back({lens, std::move(text)});
  }
  [[nodiscard]] double* number(Lens& lens, std::string_view name) const {
    const auto found = std::find(coefficients_.begin(), coefficients_.end(), name);
    if (found == coefficients_.end()) return nullptr;
    return &lens.distortion.at(static_cast<std::size_t>(found - coefficients_.begin()));
  }
  /// Multiplies the numbers of these names. Returns the names of those that change.
  std::string multiply(Lens& lens, const Names& names, double factor) const {
    std::string changed;
    for (const std::string_view name : names) {
      double* const value = number(lens, name);
      if (value == nullptr || *value == 0) continue;
      *value *= factor;
      changed += (changed.empty() ? "" : ", ") + std::string(name);
    }
    return changed;
  }

  void exchange() {
    Lens lens = lens_;
    double *p1 = number(lens, "p1"), *p2 = number(lens, "p2");
    if (p1 == nullptr || p2 == nullptr) return;
    std::swap(*p1, *p2);
    add(lens, fmt::format("p1 and p2 of the lens {} are exchanged: exchange them in the renderer",
                          name_));
  }
  void negate(const Names& names) {
    Lens lens = lens_;
    const std::string changed = multiply(lens, names, -1);
    add(lens, fmt::format("the lens {} is used with the opposite sign of {}: change the sign in "
                          "the renderer",
                          name_, changed));
  }
  void leave_out(const Names& names) {
    Lens lens = lens_;
    const std::string gone = multiply(lens, names, 0);
    add(lens, fmt::format("the lens {} is used without {}: pass all its numbers to the renderer",
                          name_, gone));
  }
  void take_for_other_models() {
    for (const Confusion& confusion : confusions()) {
      if (confusion.right != lens_.model) continue;
      Lens lens{.model = confusion.used};
      std::transform(confusion.places.begin(), confusion.places.end(), lens.distortion.begin(),
                     [this](std::size_t place) { return lens_.distortion.at(place); });
      add(lens, fmt::format("the numbers of the lens {} are used as {}'s: {}", name_,
                            name_of(confusion.used), confusion.why));
    }
  }
  void take_for_other_fisheyes() {
    constexpr std::array projections{LensModel::fisheye, LensModel::fisheye_stereographic,
                                     LensModel::fisheye_orthographic, LensModel::fisheye_equisolid};
    const bool is_fisheye =
        lens_.model == LensModel::simple_fisheye ||
        std::find(projections.begin(), projections.end(), lens_.model) != projections.end();
    for (const LensModel model : projections) {
      if (!is_fisheye || model == lens_.model) continue;
      add(Lens{.model = model},
          fmt::format("the projection is {}, that of the camera is {}: choose the camera's in the "
                      "renderer",
                      name_of(model), name_));
    }
  }

  const Lens& lens_;
  std::string name_;
  std::span<const std::string_view> coefficients_;
  std::vector<Misreading> list_;
};

/// With the samples of other rays.
Hypothesis with_rays(std::string text, std::string kind, const OtherMap& other,
                     const RendererModel& model, std::shared_ptr<const LensSamples> samples) {
  Hypothesis h{std::move(kind), std::move(text), model, other};
  h.model.sample.lens = std::move(samples);
  return h;
}

std::optional<Hypothesis> misread(const Truth& truth, const OtherMap& other,
                                  const RendererModel& model, const Misreading& misreading) {
  Camera camera = whole_camera(truth);
  camera.projection.lens = misreading.lens;
  try {
    return with_rays(misreading.text, "lens-convention", other, model,
                     std::make_shared<LensSamples>(camera, 0.5, 0.5));
  } catch (const UsageError&) {
    return std::nullopt;  // some of its rays do not go forwards
  }
}

/// A program's way from a point in which the lens distorts to the point before the stage.
using Way = std::function<PlanePoint(const lens::StageNumbers<double>& stage, const PlanePoint& y)>;

/// The pixels' samples by that way. A program that finds no finite point, or a ray that does not go
/// forwards, shows nothing there.
std::shared_ptr<const LensSamples> samples_by(const Camera& camera, const Way& way) {
  const Lens& lens = *camera.projection.lens;
  const lens::StageNumbers<double> stage = lens::stage_of(lens);
  const RoundedProjection projection(without_lens(camera).projection);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::array<double, 2>> points;
  points.reserve(std::size_t{camera.width} * camera.height);
  for (std::uint32_t row = 0; row < camera.height; ++row) {
    for (std::uint32_t column = 0; column < camera.width; ++column) {
      auto [x, y] = way(stage, projection.plane_point_at(column + 0.5, row + 0.5));
      const double angle = std::hypot(x, y);
      double factor = 1;
      if (!is_plane(lens.model) && angle > 0) factor = std::tan(angle) / angle;
      const bool goes_forwards = is_plane(lens.model) || angle < std::numbers::pi / 2;
      points.push_back(goes_forwards && std::isfinite(angle)
                           ? projection.image_of({factor * x, factor * y, 1})
                           : std::array<double, 2>{nan, nan});
    }
  }
  return std::make_shared<LensSamples>(camera, std::move(points));
}

/// Whether a lens is a stage that can be inverted by steps.
bool is_stage(const Lens& lens) {
  return has_stage(lens.model) && !lens::Tilt::of(lens) && !lens::is_identity(lens::stage_of(lens));
}

Hypothesis wrong_direction(const Truth& truth, const OtherMap& other, const RendererModel& model) {
  const Camera& camera = whole_camera(truth);
  const auto samples = samples_by(camera, [](const auto& stage, const auto& y) {
    const auto [x_d, y_d] = lens::stage_value<double>(stage, y[0], y[1]);
    return PlanePoint{x_d, y_d};
  });
  return with_rays(
      fmt::format("the lens {} is applied in the wrong direction: its formula takes rays to the "
                  "image; invert it to find the rays of pixels",
                  name_of(camera.projection.lens->model)),
      "lens-convention", other, model, samples);
}

/// An inverse of a stage that other programs compute step by step.
struct SteppedInverse {
  PlanePoint (*invert)(const lens::StageNumbers<double>& stage, const PlanePoint& y, int steps);
  /// As many steps are tried at most.
  int most;
  const char* text;
};

constexpr int most_steps = 10;
constexpr std::array stepped_inverses{
    SteppedInverse{lens::invert_by_fixed_point, most_steps, "of the fixed point, as in OpenCV"},
    SteppedInverse{lens::invert_by_residuals, most_steps, "of the fixed point, by residuals"},
    SteppedInverse{lens::invert_by_newton, 3, "of Newton's method"}};

/// OpenCV's fixed point divides by the radial factor of a single stage.
bool can_invert(const SteppedInverse& inverse, const Lens& lens) {
  return inverse.invert != lens::invert_by_fixed_point || !lens::stage_of(lens).is_double();
}

Hypothesis early_stop(const Truth& truth, const OtherMap& other, const RendererModel& model,
                      const SteppedInverse& inverse, int steps) {
  const Camera& camera = whole_camera(truth);
  const auto samples = samples_by(
      camera, [&](const auto& stage, const auto& y) { return inverse.invert(stage, y, steps); });
  return with_rays(
      fmt::format("the inverse of the lens {} stops after {} step{} {}: iterate until nothing "
                  "changes (cv2.undistortPointsIter)",
                  name_of(camera.projection.lens->model), steps, steps == 1 ? "" : "s",
                  inverse.text),
      "lens-inverse", other, model, samples);
}

/// Each inverse of the lens after 1, 2, … steps.
std::vector<MakeHypothesis> early_inverses(const Truth& truth, const OtherMap& other,
                                           const RendererModel& model) {
  std::vector<MakeHypothesis> list;
  for (const SteppedInverse& inverse : stepped_inverses) {
    if (!can_invert(inverse, *whole_camera(truth).projection.lens)) continue;
    for (int steps = 1; steps <= inverse.most; ++steps) {
      list.emplace_back([&truth, &other, &model, &inverse, steps] {
        return early_stop(truth, other, model, inverse, steps);
      });
    }
  }
  return list;
}

}  // namespace

std::vector<MakeHypothesis> lens_convention_hypotheses(const Truth& truth, const OtherMap& other,
                                                       const RendererModel& model) {
  const Lens& lens = *whole_camera(truth).projection.lens;
  std::vector<MakeHypothesis> list;
  for (const Misreading& misreading : Misreadings(lens).list())
    list.emplace_back(
        [&truth, &other, &model, misreading] { return misread(truth, other, model, misreading); });
  if (!is_stage(lens)) return list;
  list.emplace_back([&truth, &other, &model] { return wrong_direction(truth, other, model); });
  for (MakeHypothesis& make : early_inverses(truth, other, model)) list.push_back(std::move(make));
  return list;
}

}  // namespace fathom::attribution
