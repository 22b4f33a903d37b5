#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "fathom/numeric/interval.h"
#include "fathom/rays/exact_ray.h"
#include "fathom/rays/ray.h"
#include "fathom/rays/ray_bounds.h"
#include "fathom/rays/ray_tree.h"

namespace fathom::rays {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// An origin with a greater coordinate is moved.
inline constexpr double near_scene = 2;

/// A ray as a tree is walked along it: in the tree's unit, its direction scaled by a power of two
/// until the greatest component is in [1, 2), and its origin moved along it to near the scene.
///
/// With the tree's coordinates x/2^power, the direction d/2^k and the moved origin at `start`,
///   t = (s + start)·2^(power − k)
/// for the parameter s of the walk, which is at most 8 in the scene.
struct WalkRay {
  /// For every s from 0 to 8, each coordinate of origin + s·direction is within origin_error of the
  /// exact one. The origin is below 8; the direction is within direction_error of the exact one.
  Vector origin{}, direction{};
  double origin_error = 0, direction_error = 0;

  /// The searched stretch, which certainly contains the requested stretch: s ≥ 0.
  float first = 0, last = 0;
  /// Intervals that contain the ends of the segment, as s.
  Interval segment_first, segment_last;

  /// For the sides of a box that the ray meets first and last: bounds on the origin, by axis.
  std::array<float, 3> origin_near{}, origin_far{};
  /// 1/d, and the same times 1 + 2⁻²¹.
  std::array<float, 3> inverse{}, inverse_far{};
  /// Whether the ray goes towards smaller coordinates, and whether it goes neither way.
  std::array<bool, 3> backward{}, parallel{};

  /// The power of two that scales t: t = (s + start)·2^scale.
  long scale = 0;
  Interval start;
};

/// k for which the greatest component of d/2^k is in [1, 2).
long power_of_direction(const Ray& ray);

/// The ray, or nullopt if it certainly misses everything in the segment.
/// Needs    a finite ray with a direction that is not 0.
std::optional<WalkRay> prepare(const Ray& ray, const RaySegment& segment, const RayTree& tree);

/// The same of a ray whose numbers need not be binary64 numbers. Its direction is not 0.
std::optional<WalkRay> prepare(const ExactRay& ray, const RaySegment& segment, const RayTree& tree);

/// Sets all that follows from the segment and from origin, direction, their errors, scale and
/// start. Returns false if the ray certainly misses everything in the segment.
bool set_stretch(WalkRay& ray, const RaySegment& segment);

/// An interval that contains the s of a t in the interval.
Interval s_of(const WalkRay& ray, const Interval& t);

/// A triangle that the ray is not certain to miss: w = n·d and n·t in binary64 with the bounds of
/// ray_bounds.h.
struct TestedTriangle {
  std::uint32_t number = 0;
  /// Where the tree has it (RayTree::corners).
  std::size_t place = 0;
  /// Whether it is certain that the ray meets the triangle, at some t.
  bool is_met = false;
  double w = 0, height = 0;
  /// Bounds on their errors; the bound of w also bounds the weights.
  double error = 0, height_error = 0;

  /// Contains the s where the ray meets the plane. With x = height/w and the exact X,
  /// │x − X│ ≤ (E_t + │x│·E)/(│w│ − E); the division and the ends lose less than 4u of x.
  [[nodiscard]] Interval s() const {
    const double room = std::abs(w) - error;
    if (!(room > 0)) return {-infinity, infinity};
    const double s = height / w;
    const double s_error =
        ((height_error + std::abs(s) * error) / room + 4 * unit_roundoff<double> * std::abs(s)) *
            bounds::slack +
        bounds::floor;
    return {s - s_error, s + s_error};
  }
};

/// Receives the triangles that walk() finds along a ray.
class TriangleVisitor {
 public:
  TriangleVisitor() = default;
  TriangleVisitor(const TriangleVisitor&) = delete;
  TriangleVisitor& operator=(const TriangleVisitor&) = delete;
  virtual ~TriangleVisitor() = default;

  /// Returns whether the answer is known, so that the walk can end.
  virtual bool offer(const TestedTriangle& triangle) = 0;
  /// Nothing beyond this s can change the answer.
  [[nodiscard]] float last() const { return last_; }

 protected:
  void set_last(float last) { last_ = last; }

 private:
  float last_ = 0;
};

/// Offers every triangle that the ray may meet in its stretch, nearer boxes first, until the answer
/// is known.
void walk(const RayTree& tree, const WalkRay& ray, TriangleVisitor& visitor);

}  // namespace fathom::rays
