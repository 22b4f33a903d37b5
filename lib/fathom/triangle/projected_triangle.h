#pragma once

#include <array>
#include <cstdint>

#include "fathom/camera/camera.h"
#include "fathom/geometry/frames.h"
#include "fathom/lens/exact_direction.h"
#include "fathom/numeric/certified.h"
#include "fathom/numeric/ratio.h"
#include "fathom/rendering/options.h"
#include "fathom/scene/scene.h"

namespace fathom::triangle {

/// Where a triangle is looked at: a sample of an image of straight edges, or the ray of a sample
/// where a camera bends rays. The linear forms of a triangle are functions of (u, v) there, or of
/// the direction of the ray (specification, sections 2 and 4).
class Sample {
 public:
  Sample(const ImagePoint& point) : point_(point) {}
  /// `direction` must outlive the sample.
  explicit Sample(const lens::ExactDirection& direction) : direction_(&direction) {}

  [[nodiscard]] const ImagePoint& point() const { return point_; }
  /// nullptr: the image has straight edges.
  [[nodiscard]] const lens::ExactDirection* direction() const { return direction_; }

  /// An interval that contains the value of a form.
  [[nodiscard]] Interval enclose(const LinearForm& form) const {
    return direction_ ? form.enclose_at(direction_->box()) : form.enclose_at(point_.u, point_.v);
  }
  /// The sign of a form.
  [[nodiscard]] Sign sign_of(const LinearForm& form, TierCounts& counts) const {
    return direction_ ? sign_at_ray(form, counts) : form.sign_at(point_.u, point_.v, counts);
  }

 private:
  [[nodiscard]] Sign sign_at_ray(const LinearForm& form, TierCounts& counts) const {
    const Interval value = enclose(form);
    if (value.lower > 0 || value.upper < 0) {
      ++counts.interval;
      return value.lower > 0 ? Sign::positive : Sign::negative;
    }
    ++counts.exact;
    return direction_->sign_of(form.coefficients());
  }

  ImagePoint point_;
  const lens::ExactDirection* direction_ = nullptr;
};

// Where a pixel is sampled, and which depths count (specification, sections 2 and 5).

/// The sample of a pixel: its centre.
inline ImagePoint centre_of_pixel(std::uint32_t column, std::uint32_t row) {
  return {column + 0.5, row + 0.5};
}

/// D > 0 and near ≤ D ≤ far, exactly.
bool is_in_range(const Ratio& depth, const Camera& camera);

/// A triangle of the scene seen by a camera, all exact (specification, sections 4 and 5, with its
/// symbols). It contains the data for coverage and depth at a sample. The forms are functions of
/// the image, or of directions in the camera frame where the camera bends rays.
struct ProjectedTriangle {
  std::uint32_t number = 0;
  std::array<WorldPoint, 3> world;
  std::array<CameraPoint, 3> camera;

  /// sign(Δ); zero if the triangle is seen edge on, in which case nothing below is set.
  Sign orientation = Sign::zero;
  /// sign(Δ)·(b × c), sign(Δ)·(c × a), sign(Δ)·(a × b): the edge functions e_A, e_B, e_C times
  /// sign(Δ), so that the inside of every edge is positive.
  std::array<LinearForm, 3> edges;
  /// Whether samples on an edge count: on a left or top edge of a front-facing triangle.
  std::array<bool, 3> left_or_top{};
  /// D(s) = depth_numerator(s) / weight(s); weight = e_A + e_B + e_C, positive where covered.
  LinearForm depth_numerator;
  LinearForm weight;
  /// |T| where the camera bends rays: the triangle is at |T| / weight(d) along the ray d.
  Dyadic volume;

  [[nodiscard]] bool front_facing() const { return orientation == Sign::negative; }
};

/// The three corners of a triangle in the world.
std::array<WorldPoint, 3> world_corners(const Object& object, const Mesh& mesh,
                                        std::uint32_t triangle);

/// Projects a triangle of the scene. `counts` records how sign(Δ) was decided.
ProjectedTriangle project(const std::array<WorldPoint, 3>& world, std::uint32_t number,
                          const Camera& camera, TierCounts& counts);

/// Whether the triangle covers the sample (specification, section 4).
bool covers(const ProjectedTriangle& triangle, const Sample& s, TierCounts& counts);

/// Whether culling keeps a triangle.
bool is_kept(const ProjectedTriangle& triangle, Cull cull);

/// Σ eᵢ·aᵢ: the numerator of interpolated corner values.
LinearForm interpolated_form(const ProjectedTriangle& triangle,
                             const std::array<Dyadic, 3>& corner_values);

/// Σ eᵢ·aᵢ / Σ eᵢ at a covered sample: perspective-correct interpolation of corner values.
Ratio interpolate(const ProjectedTriangle& triangle, const ImagePoint& s,
                  const std::array<Dyadic, 3>& corner_values);

/// D(s) at a covered sample, exactly.
Ratio depth_at(const ProjectedTriangle& triangle, const ImagePoint& s);

/// A certified box where edges are straight: around the corners' images if all are in front of the
/// camera; empty if no corner is (every point of the triangle then has D ≤ 0); otherwise the whole
/// image.
PixelBox bounding_box(const ProjectedTriangle& triangle, const Camera& camera);

}  // namespace fathom::triangle
