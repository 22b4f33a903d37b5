#pragma once

#include "fathom/depth_format/encode.h"
#include "fathom/pipeline/geometry/window_triangle.h"

/// Fragments: their values, interpolated from the corners of a triangle, and the depth test.
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
/// Window depth is affine in the window and interpolated with the weights λ = e/Σe; depth along the
/// view always, and other attributes if requested, with (λ/w)/Σ(λ/w). Interpolating the window
/// depth that way would divide by w twice.
template <class Real>
class Interpolator {
 public:
  /// nullopt if snapping left no area.
  static std::optional<Interpolator> of(const WindowTriangle<Real>& triangle,
                                        const PipelineOptions& options);

  [[nodiscard]] const GridTriangle& grid() const { return grid_; }
  [[nodiscard]] const WindowTriangle<Real>& triangle() const { return *triangle_; }

  /// Only the values that the depth test needs: window depth, and depth along the view.
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

// The depth test: the stored form of a fragment's depth, and which of two depths is nearer.

/// A window depth in [0, 1], rounded once to a storage: to nearest, ties to even.
StoredDepth store(Storage storage, double window_z);

class DepthTest {
 public:
  explicit DepthTest(const PipelineOptions& options);

  /// The depth that the depth buffer stores for a fragment. Mappings that are not projections are
  /// computed here, from the depth along the view, in the options' precision.
  [[nodiscard]] StoredDepth stored(const Fragment& fragment) const;

  /// The strictly nearer depth wins, so the first of equal depths remains.
  [[nodiscard]] bool is_nearer(StoredDepth a, StoredDepth b) const {
    return greater_is_nearer_ ? a > b : a < b;
  }

 private:
  DepthFormat format_;
  bool binary32_;
  bool greater_is_nearer_;
};

}  // namespace fathom::pipeline
