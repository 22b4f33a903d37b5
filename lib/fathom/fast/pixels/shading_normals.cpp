#include "fathom/fast/pixels/shading_normals.h"

#include <algorithm>
#include <cmath>

#include "fathom/numeric/certified.h"
#include "fathom/numeric/rounding.h"

// Bounds are as in numeric/certified_value.h: sums and products propagate them, for operands of any
// magnitude; a value that overflows has a bound of +∞ or NaN, which settles nothing. A component
// that has lost more than half of its bits, or may be 0, is computed from exact numbers and rounded
// once: at the samples, components are small only if the components at the corners are small, or
// cancel. docs/error-analysis.md, "Channels".
namespace fathom::fast {
using namespace triangle;

namespace {

using Normal = Vector<Certified<double>>;
constexpr double ulp = epsilon<double>;

/// How much of itself a component may err by.
constexpr double component_condition = 0x1p-40;

/// The difference of two exact numbers, rounded.
Certified<double> exact_difference(double a, double b) {
  return sum<double>({a, 0}, {-b, 0});
}

Normal displacement(const MeshPoint& a, const MeshPoint& b) {
  return {exact_difference(a.x, b.x), exact_difference(a.y, b.y), exact_difference(a.z, b.z)};
}

Normal certified_sum(const Normal& a, const Normal& b) {
  return {sum(a[0], b[0]), sum(a[1], b[1]), sum(a[2], b[2])};
}

Certified<double> certified_dot(const Normal& a, const Normal& b) {
  return sum(sum(product(a[0], b[0]), product(a[1], b[1])), product(a[2], b[2]));
}

Normal certified_area_vector(const std::array<MeshPoint, 3>& corners) {
  const Normal p = displacement(corners[1], corners[0]), r = displacement(corners[2], corners[0]);
  const auto minor = [&](std::size_t j, std::size_t k) {
    return sum(product(p[j], r[k]), -product(p[k], r[j]));
  };
  return {minor(1, 2), minor(2, 0), minor(0, 1)};
}

/// The leading words of a row, which err by u of themselves.
Normal row_of(const NormalMatrix& matrix, std::size_t i) {
  Normal row;
  for (std::size_t k = 0; k < 3; ++k) {
    row[k] = {matrix.rows[i][k].hi, matrix.sizes[i][k] * (ulp * slack)};
  }
  return row;
}

bool is_accurate(const Certified<double>& x) {
  return is_exact_zero(x) || x.error < std::abs(x.value) * component_condition;
}

/// Unknown if it overflows or underflows.
Certified<double> certified_rounding(const Dyadic& x) {
  if (x.is_zero()) return {0, 0};
  const std::optional<double> value = round_to_normal(Ratio(x));
  if (!value) return {};
  return {*value, std::abs(*value) * (ulp * slack)};
}

}  // namespace

Normal ShadingNormals::in_mesh(const TriangleOrigin& origin, std::size_t corner) {
  const CornerNormal normal = normals_->at(origin, corner);
  if (normal.given) {
    const auto& [x, y, z] = *normal.given;
    return {Certified<double>{x, 0}, {y, 0}, {z, 0}};
  }
  return sums_.get(normal.number, [&](Normal& all) {
    all.fill({0, 0});
    const Mesh& mesh = normals_->mesh_of(origin);
    for (const std::uint32_t t : normal.triangles) {
      all = certified_sum(all, certified_area_vector(corners_of(mesh, t)));
    }
  });
}

ShadingNormals::Corners ShadingNormals::in_world(const SurfaceFacts& surface) {
  Corners corners;
  for (std::size_t k = 0; k < 3; ++k) corners[k] = in_mesh(surface.origin, k);
  const ObjectRays& object = *surface.object;
  if (object.placed_as_is) return corners;
  for (Normal& n : corners) {
    const Normal mesh = n;
    for (std::size_t i = 0; i < 3; ++i) {
      n[i] = certified_dot(row_of(object.to_world, i), mesh);
      if (object.mirrored) n[i] = -n[i];
    }
  }
  return corners;
}

SurfaceNormals ShadingNormals::of_surface(std::uint32_t number, const SurfaceFacts& surface) {
  Corners corners = in_world(surface);
  std::optional<std::array<ExactVector3, 3>> exact;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (is_accurate(corners[k][i])) continue;
      if (!exact) exact = exact_.of_triangle(number);
      corners[k][i] = certified_rounding((*exact)[k][i]);
    }
  }
  SurfaceNormals normals;
  normals.at_A = corners[0];
  for (std::size_t i = 0; i < 3; ++i) {
    normals.to_B[i] = sum(corners[1][i], -corners[0][i]);
    normals.to_C[i] = sum(corners[2][i], -corners[0][i]);
  }
  return normals;
}

std::array<long, 3> ShadingNormals::last_bits(std::uint32_t number) {
  std::array<long, 3> bits{bit_of_zero, bit_of_zero, bit_of_zero};
  for (const ExactVector3& n : exact_.of_triangle(number)) {
    for (std::size_t i = 0; i < 3; ++i) bits[i] = std::min(bits[i], last_bit(n[i]));
  }
  return bits;
}

Normal interpolated(const SurfaceNormals& normals,
                    const std::array<Certified<double>, 2>& weights) {
  Normal n;
  for (std::size_t i = 0; i < 3; ++i) {
    n[i] = sum(normals.at_A[i],
               sum(product(weights[0], normals.to_B[i]), product(weights[1], normals.to_C[i])));
  }
  return n;
}

// |n̂| and |n| differ by at most the sum of the components' errors, as in length_of(). Squares stay
// in range: the greatest component is between 2⁻⁴⁰⁰ and 2⁴⁰⁰, and the squares of others lose less
// than 2⁻²⁰⁰ of its square below 2⁻¹⁰⁷⁴.
Normal unit(const Normal& normal) {
  if (std::ranges::all_of(normal, is_exact_zero<double>)) return normal;
  Vector<double> values, errors;
  double greatest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    values[i] = normal[i].value;
    errors[i] = normal[i].error;
    greatest = std::max(greatest, std::abs(normal[i].value));
  }
  if (!(greatest >= least_shading_normal && greatest <= greatest_shading_normal)) return {};
  const Certified<double> length = length_of(values, errors);
  return {quotient(normal[0], length), quotient(normal[1], length), quotient(normal[2], length)};
}

}  // namespace fathom::fast
