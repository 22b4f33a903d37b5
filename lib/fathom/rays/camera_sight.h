#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "fathom/camera/camera.h"
#include "fathom/numeric/certified.h"
#include "fathom/rays/cast.h"
#include "fathom/rays/sight_line.h"
#include "fathom/rays/walk_ray.h"
#include "fathom/rendering/options.h"

namespace fathom::rays {

/// Decides which points a camera sees, by section 10 of the specification: edges hide on both
/// sides, because the points are not samples of a grid, which must each be covered once. Scene and
/// camera must outlive it.
/// Exact    every decision: by binary64 with bounds, and by exact numbers if the bounds do not
///          settle it.
/// Needs    a valid camera whose lens bends no rays.
class CameraSight {
 public:
  CameraSight(const RayScene& scene, const Camera& camera, Cull cull);

  [[nodiscard]] bool sees(const SightEnd& p) const;

 private:
  /// A point in the camera's frame, in the unit of the tree.
  struct View {
    CertifiedNumber x, y, z;
  };
  /// Its image before the lens: (x, y, W), where the image is K·(x, y, W), in the same unit.
  using Image = std::array<CertifiedNumber, 3>;
  /// Finds a triangle that hides a point.
  class HidingTriangle;

  [[nodiscard]] View view_of(const CertifiedVector& p) const;
  [[nodiscard]] Image image_of(const View& view) const;
  [[nodiscard]] bool is_in_image(const SightEnd& p, const View& view) const;
  [[nodiscard]] bool is_in_range(const SightEnd& p, const View& view) const;
  [[nodiscard]] bool shows_a_side(std::uint32_t triangle) const;
  [[nodiscard]] CertifiedVector end_of_sight(const SightEnd& p, const View& view) const;
  [[nodiscard]] ExactRay exact_ray(const SightEnd& p) const;
  [[nodiscard]] bool is_hidden(const SightEnd& p, const View& view) const;
  [[nodiscard]] bool hides(const TestedTriangle& triangle, const SightEnd& p,
                           const View& view) const;
  [[nodiscard]] std::optional<bool> hides_certainly(const TestedTriangle& triangle,
                                                    const View& view) const;
  [[nodiscard]] bool hides_exactly(std::uint32_t number, const SightEnd& p) const;
  /// Of a triangle whose Δ in the camera's frame has this sign.
  [[nodiscard]] bool is_kept(Sign turn) const;

  const RayScene& scene_;
  const Camera& camera_;
  Cull cull_;
  /// [R | t] and near in the unit of the tree.
  std::array<std::array<CertifiedNumber, 4>, 3> pose_;
  CertifiedNumber near_;
  /// W of every point of an orthographic camera: 1, in that unit.
  CertifiedNumber one_;
  /// The signs of det K and det R.
  Sign lens_, rotation_;
  /// det R·R⁻¹, transposed.
  std::array<ExactVector3, 3> cofactors_;
  /// Where the camera is, in that unit; of an orthographic one the way to it for each unit of
  /// depth.
  CertifiedVector eye_;
};

}  // namespace fathom::rays
