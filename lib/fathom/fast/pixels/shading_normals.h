#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "fathom/fast/pixels/surface_values.h"
#include "fathom/triangle/corner_normals.h"

/// Channel Ns in binary64, with bounds.
namespace fathom::fast {

/// Limits on the greatest component of a normal, so that its square stays in range.
inline constexpr double least_shading_normal = 0x1p-400, greatest_shading_normal = 0x1p400;

/// Computes shading normals. One for each thread, because it caches the sums that it used last.
class ShadingNormals {
 public:
  explicit ShadingNormals(std::shared_ptr<const triangle::CornerNormals> normals)
      : normals_(normals), exact_(std::move(normals)) {}

  /// Every component errs by less than 2⁻⁴⁰ of itself, and is 0 only if it is exactly 0, or is not
  /// known.
  /// Needs    a usable surface.
  SurfaceNormals of_surface(std::uint32_t number, const SurfaceFacts& surface);
  /// Exponents of powers of two of which x, y and z of all three are multiples.
  std::array<long, 3> last_bits(std::uint32_t number);

 private:
  using Corners = std::array<Vector<Certified<double>>, 3>;

  Vector<Certified<double>> in_mesh(const TriangleOrigin& origin, std::size_t corner);
  Corners in_world(const SurfaceFacts& surface);

  std::shared_ptr<const triangle::CornerNormals> normals_;
  triangle::ExactCornerNormals exact_;
  triangle::RecentTriangles<Vector<Certified<double>>, 1024> sums_;
};

/// The normal, of any length, at a point whose weights of B and C these are.
Vector<Certified<double>> interpolated(const SurfaceNormals& normals,
                                       const std::array<Certified<double>, 2>& weights);
/// The same scaled to unit length; 0 where it is exactly 0.
Vector<Certified<double>> unit(const Vector<Certified<double>>& normal);

}  // namespace fathom::fast
