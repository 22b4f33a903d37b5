#pragma once

#include "fathom/pipeline/geometry/window_triangle.h"

/// Interpolation stage: what a fragment gets from the corners of its triangle.
namespace fathom::pipeline {

/// A sample of a triangle with all that shading and the output merger need.
struct Fragment {
  double window_z = 0;  ///< in [0, 1]
  double depth = 0;     ///< along the view, scene units
  std::array<double, attribute::of_fragments> attributes{};
  /// Texture coordinates one pixel to the right, and one pixel down, minus those here.
  std::array<double, 2> duv_dx{}, duv_dy{};
};

/// A triangle on the subpixel grid, and the values at its corners.
///
/// Window depth is affine in the window and interpolated with the weights λ = e/Σe as they are;
/// depth along the view always, and other attributes if asked for, with (λ/w)/Σ(λ/w). Interpolating
/// the window depth that way would divide by w twice.
template <class Real>
class Interpolator {
 public:
  /// nullopt if snapping left no area.
  static std::optional<Interpolator> of(const WindowTriangle<Real>& triangle,
                                        const PipelineOptions& options);

  [[nodiscard]] const GridTriangle& grid() const { return grid_; }
  [[nodiscard]] const WindowTriangle<Real>& triangle() const { return *triangle_; }

  /// Only what the depth test needs: window depth, and depth along the view.
  [[nodiscard]] Fragment depths_at(const GridPoint& sample) const;
  /// Adds the rest.
  void complete(Fragment& fragment, const GridPoint& sample) const;

  /// λ_A, λ_B, λ_C at a sample, and the weights of attributes.
  [[nodiscard]] std::array<Real, 3> linear_weights(const GridPoint& sample) const;
  [[nodiscard]] std::array<Real, 3> attribute_weights(const GridPoint& sample) const;

 private:
  Interpolator(const WindowTriangle<Real>& triangle, GridTriangle grid, bool perspective)
      : triangle_(&triangle), grid_(grid), perspective_(perspective) {}
  [[nodiscard]] std::array<Real, 3> over_w(const std::array<Real, 3>& linear) const;

  const WindowTriangle<Real>* triangle_;
  GridTriangle grid_;
  bool perspective_;
};

}  // namespace fathom::pipeline
