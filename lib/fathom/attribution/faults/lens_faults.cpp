#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>

#include "fathom/attribution/faults/hypotheses.h"
#include "fathom/attribution/model/lens_samples.h"
#include "fathom/attribution/ray/model_ray.h"
#include "fathom/lens/preimages.h"
#include "fathom/lens/sample_plane.h"
#include "fathom/lens/stage.h"

namespace fathom::attribution {
namespace {

using Point = std::array<double, 2>;

std::string name_of_lens(const Truth& truth) {
  return std::string(name_of(whole_camera(truth).projection.lens->model));
}

std::optional<Hypothesis> ignored(const Truth& truth, const OtherMap& other,
                                  const RendererModel& model) {
  Hypothesis h{"lens-ignored",
               "the lens " + name_of_lens(truth) + " is left out: the map is of a pinhole camera",
               model, other};
  h.model.sample.lens = nullptr;
  h.truth = seen_by(truth, truth.camera);
  return h;
}

std::optional<Hypothesis> remapped(const Truth& truth, const OtherMap& other,
                                   const RendererModel& model, LensSamples::Places places) {
  Hypothesis h{"remapped",
               "the map of a pinhole camera was looked up at the nearest pixel: the lens " +
                   name_of_lens(truth) + " was applied to an image",
               model, other};
  h.model.sample.lens = std::make_shared<LensSamples>(whole_camera(truth), 0.5, 0.5, places);
  return h;
}

std::optional<Hypothesis> displaced(const Truth& truth, const OtherMap& other,
                                    const RendererModel& model, const Point& by) {
  const Camera& camera = whole_camera(truth);
  if (camera.projection.lens->directions) return std::nullopt;  // of centres only
  Hypothesis h{"shift",
               fmt::format("the image is shifted by ({}, {}) pixels: it was sampled that far from "
                           "the pixel centres",
                           by[0], by[1]),
               model, other};
  h.model.sample.lens = std::make_shared<LensSamples>(camera, 0.5 + by[0], 0.5 + by[1]);
  return h;
}

/// Where a lens takes points of the plane at depth 1, in binary64.
class ForwardLens {
 public:
  explicit ForwardLens(const Camera& camera)
      : lens_(*camera.projection.lens),
        stage_(lens::stage_of(has_stage(lens_.model) || has_stage_before_root(lens_) ? lens_
                                                                                     : Lens())),
        disc_(lens::Preimages(camera.projection, lens_).disc()) {
    if (const auto formula = lens::root_formula(lens_)) roots_.emplace(*formula);
  }

  /// Not of a table, nor of a tilted sensor.
  [[nodiscard]] static bool knows(const Lens& lens) {
    return !lens.directions && !lens::Tilt::of(lens);
  }
  /// Nothing beyond the end of the lens.
  [[nodiscard]] std::optional<Point> at(double x, double y) const {
    const double square = x * x + y * y;
    if (has_stage(lens_.model)) {
      const double r = std::sqrt(square);
      const double angle = is_plane(lens_.model) || r == 0 ? 1 : std::atan(r) / r;
      if (angle * angle * square > disc_) return std::nullopt;
      const auto [x_d, y_d] = lens::stage_value<double>(stage_, angle * x, angle * y);
      return Point{x_d, y_d};
    }
    if (roots_) return by_root(x, y);
    if (lens_.model == LensModel::ftheta) return by_angle(x, y);
    if (lens_.model == LensModel::fov) return in_field_of_view(x, y);
    if (is_panorama(lens_.model)) {
      const double down = y / std::sqrt(1 + x * x);
      const bool is_cylinder = lens_.model == LensModel::cylindrical;
      return Point{std::atan(x) / (2 * std::numbers::pi),
                   is_cylinder ? down : std::atan(down) / std::numbers::pi};
    }
    // r/(1 + k·r²) = |m|
    const double k = lens::division_term(lens_);
    const double rest = 1 - 4 * k * square;
    if (rest < 0) return std::nullopt;
    const double factor = 2 / (1 + std::sqrt(rest));
    return Point{factor * x, factor * y};
  }

 private:
  [[nodiscard]] Point in_field_of_view(double x, double y) const {
    const double omega = std::abs(lens_.distortion[0]), size = std::hypot(x, y);
    if (omega == 0 || size == 0) return {x, y};
    const double factor = std::atan(2 * std::tan(omega / 2) * size) / (omega * size);
    return {factor * x, factor * y};
  }
  [[nodiscard]] std::optional<Point> by_angle(double x, double y) const {
    const double size = std::hypot(x, y);
    if (size == 0) return Point{0, 0};
    const lens::AnglePolynomial angle(lens_);
    const double radius = angle.radius_at(std::atan(size));
    if (!(radius < angle.end())) return std::nullopt;
    return Point{x / size * radius, y / size * radius};
  }
  [[nodiscard]] std::optional<Point> by_root(double x, double y) const {
    constexpr double farthest = 0x1p40;
    const double size = std::hypot(x, y);
    if (size == 0) return Point{0, 0};
    const std::optional<double> radius = roots_->radius_at(std::atan(size), farthest);
    if (!radius) return std::nullopt;
    const Point m{x / size * *radius, y / size * *radius};
    if (!has_stage_before_root(lens_)) return m;
    if (*radius * *radius > disc_) return std::nullopt;
    const auto [x_d, y_d] = lens::stage_value<double>(stage_, m[0], m[1]);
    return Point{x_d, y_d};
  }

  const Lens& lens_;
  lens::StageNumbers<double> stage_;
  double disc_;
  std::optional<lens::RootProfile> roots_;
};

/// The mesh in the frame of the camera, its points moved so that a pinhole shows them where the
/// lens does, at the same depth. Triangles with a point that cannot be moved cover nothing.
Truth with_bent_points(const Truth& truth) {
  const ForwardLens lens(whole_camera(truth));
  const auto camera_from_world = as_matrix(truth.camera.world_to_camera);
  Truth bent{.mesh = truth.mesh, .camera = truth.camera, .corner_numbers = truth.corner_numbers};
  bent.camera.world_to_camera = Camera().world_to_camera;
  std::vector<bool> is_moved;
  for (auto& point : bent.mesh.points) {
    const Vector3 p = camera_from_world * as_vector(point).homogeneous();
    std::optional<Point> image;
    if (p.z() > 0) image = lens.at(p.x() / p.z(), p.y() / p.z());
    is_moved.push_back(image.has_value());
    if (image) point = {(*image)[0] * p.z(), (*image)[1] * p.z(), p.z()};
  }
  for (CornerIndices& t : bent.mesh.triangles)
    if (!is_moved[t[0]] || !is_moved[t[1]] || !is_moved[t[2]]) t = {t[0], t[0], t[0]};
  return bent;
}

std::optional<Hypothesis> straight_edges(const Truth& truth, const OtherMap& other,
                                         const RendererModel& model) {
  if (!ForwardLens::knows(*whole_camera(truth).projection.lens)) return std::nullopt;
  const Truth bent = with_bent_points(truth);
  Hypothesis h{"straight-edges",
               "the lens " + name_of_lens(truth) +
                   " bends only the vertices: edges between them are straight in the image",
               model, other};
  h.model.sample.lens = nullptr;
  h.truth = seen_by(bent, bent.camera);
  return h;
}

}  // namespace

std::vector<MakeHypothesis> lens_hypotheses(const Truth& truth, const OtherMap& other,
                                            const RendererModel& model) {
  std::vector<MakeHypothesis> list;
  for (const auto make : {ignored, straight_edges})
    list.emplace_back([&truth, &other, &model, make] { return make(truth, other, model); });
  for (const auto places :
       {LensSamples::Places::at_pixel_centres, LensSamples::Places::at_centres_of_endless})
    list.emplace_back(
        [&truth, &other, &model, places] { return remapped(truth, other, model, places); });
  for (const double y : {-0.5, 0.0, 0.5}) {
    for (const double x : {-0.5, 0.0, 0.5}) {
      if (x == 0 && y == 0) continue;
      list.emplace_back([&truth, &other, &model, x, y] {
        return displaced(truth, other, model, {x, y});
      });
    }
  }
  for (MakeHypothesis& make : lens_convention_hypotheses(truth, other, model))
    list.push_back(std::move(make));
  return list;
}

}  // namespace fathom::attribution
