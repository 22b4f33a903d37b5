#include "fathom/triangle/rays.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fathom/numeric/certified.h"
#include "fathom/numeric/certified_rounding.h"
#include "fathom/numeric/rounding.h"
#include "fathom/triangle/corner_normals.h"

// Over a mesh the image is affine: (U, V, D) = H·X + h, exactly. At depth D, a sample (u, v) of a
// perspective camera sees the X with H·X + h = D·(u, v, 1), as W = D; of an orthographic one, the X
// with H·X + h = (u, v, D), as W = 1. With m_j the columns of H⁻¹ and O = −H⁻¹h, X is the point in
// the header. The columns of H⁻¹ are the cross products of H's rows over det H: exact quotients,
// rounded once.
namespace fathom::triangle {
namespace {

using ExactMatrix = std::array<ExactVector3, 3>;

bool is_safe(double x) {
  const double size = std::abs(x);
  return size == 0 || (size >= least_safe && size <= greatest_safe);
}

/// Sets an entry and its magnitude; returns false if it is not safe, or if the entry is not 0 but
/// rounds to 0. lo is dropped if it is below 2⁻¹¹⁰·|hi|, so that its last bit is never far below:
/// the relative error stays below 2⁻¹⁰⁶ + 2⁻¹¹⁰.
bool set(const Ratio& exact, WordPair& entry, double& size) {
  const std::optional<double> hi = round_to_normal(exact);
  if (!hi || !is_safe(*hi)) return false;
  const double lo = round_to_binary64(exact - Ratio(Dyadic(*hi)));
  entry = {*hi, std::abs(lo) < std::abs(*hi) * 0x1p-110 ? 0 : lo};
  size = std::abs(*hi);
  return true;
}

/// The world as an object.
Object identity() {
  return {};
}

/// Rows of (U, V, D) as affine functions of the mesh point.
std::array<ExactRow, 3> image_rows_of(const Object& object, const Camera& camera) {
  const auto image = [&](const MeshPoint& X) {
    const CameraPoint p = to_camera(camera.world_to_camera, object.world_from_mesh(X));
    const HomogeneousImagePoint a = to_image(camera.projection, p);
    return ExactVector3{a.U, a.V, p.z};
  };
  const ExactVector3 origin = image({0, 0, 0});
  const ExactVector3 ends[] = {image({1, 0, 0}), image({0, 1, 0}), image({0, 0, 1})};
  std::array<ExactRow, 3> rows;
  for (std::size_t i = 0; i < 3; ++i) {
    rows[i] = ExactRow(
        {ends[0][i] - origin[i], ends[1][i] - origin[i], ends[2][i] - origin[i], origin[i]});
  }
  return rows;
}

ExactVector3 linear_part(const ExactRow& row) {
  return {row.coefficients[0], row.coefficients[1], row.coefficients[2]};
}

ExactMatrix linear_part(const std::array<ExactRow, 3>& rows) {
  return {linear_part(rows[0]), linear_part(rows[1]), linear_part(rows[2])};
}

/// False if the magnitude of an entry is not safe.
bool set(const ExactMatrix& exact, NormalMatrix& matrix) {
  bool safe = true;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      safe = set(Ratio(exact[i][k]), matrix.rows[i][k], matrix.sizes[i][k]) && safe;
    }
  }
  return safe;
}

/// R times a linear map.
ExactMatrix in_camera(const Camera& camera, const ExactMatrix& m) {
  ExactMatrix product;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t j = 0; j < 3; ++j) product[i][k] += camera.world_to_camera[i][j] * m[j][k];
    }
  }
  return product;
}

/// False if the magnitude of an entry is not safe, or H is singular.
bool invert(const std::array<ExactRow, 3>& rows, Rays& rays, double& determinant_size) {
  const ExactMatrix H = linear_part(rows);
  const Dyadic det = determinant(H[0], H[1], H[2]);
  if (det.is_zero()) return false;
  const double size = std::abs(round_to_binary64(Ratio(det)));
  if (!(size >= 0x1p-300 && size <= 0x1p300)) return false;
  determinant_size = size * (1 + 0x1p-50);
  const ExactMatrix adjugate = cofactors(H);
  bool safe = true;
  for (std::size_t i = 0; i < 3; ++i) {
    Dyadic origin;
    for (std::size_t j = 0; j < 3; ++j) {
      origin -= rows[j].coefficients[3] * adjugate[j][i];
      safe = set({adjugate[j][i], det}, rays.columns[j][i], rays.sizes[j][i]) && safe;
    }
    safe = set({origin, det}, rays.columns[3][i], rays.sizes[3][i]) && safe;
  }
  return safe;
}

}  // namespace

ExactRow::ExactRow(std::array<Dyadic, 4> exact) : coefficients(std::move(exact)) {
  std::array<double, 4> values{};
  bool all = true;
  for (std::size_t k = 0; k < 4; ++k) {
    last_bits[k] = last_bit(coefficients[k]);
    const Interval enclosure = enclose(coefficients[k]);
    values[k] = enclosure.lower;
    all = all && enclosure.lower == enclosure.upper && is_safe(values[k]);
  }
  if (all) binary64 = values;
}

long ExactRow::last_bit_at(const std::array<long, 3>& bits) const {
  long least = last_bits[3];
  for (std::size_t k = 0; k < 3; ++k) least = std::min(least, last_bits[k] + bits[k]);
  return least;
}

// Products are kept as two words; words are added to a double-word sum as long as that is exact.
// (Magnitudes are safe, so that nothing underflows.)
std::optional<WordPair> ExactRow::value_at(const MeshPoint& X) const {
  if (!binary64) return std::nullopt;
  WordPair sum;
  bool is_exact = true;
  const auto add = [&](double x) {
    const WordPair s = two_sum(sum.hi, x);
    const WordPair t = two_sum(sum.lo, s.lo);
    is_exact = is_exact && t.lo == 0;
    sum = two_sum(s.hi, t.hi);
  };
  const std::array<double, 4> point{X.x, X.y, X.z, 1};
  for (std::size_t k = 0; k < 4; ++k) {
    if (!is_safe(point[k])) return std::nullopt;
    const WordPair product = two_product<false>((*binary64)[k], point[k]);
    add(product.hi);
    add(product.lo);
  }
  if (!is_exact) return std::nullopt;
  return sum;
}

ObjectRays::ObjectRays(const Object& object, const Camera& camera)
    : placed_as_is(object.placed_as_is), image_rows(image_rows_of(object, camera)) {
  for (std::size_t i = 0; i < 3; ++i) world_rows[i] = ExactRow(object.world_from_mesh.rows[i]);
  usable = invert(image_rows, rays, determinant);
  const ExactMatrix M = linear_part(world_rows);
  camera_normals_usable = set(cofactors(in_camera(camera, M)), to_camera);
  if (placed_as_is) return;
  mirrored = fathom::determinant(M[0], M[1], M[2]).sign() == Sign::negative;
  usable = set(cofactors(M), to_world) && usable;
}

// x = (u − cx' − skew·y)/fx with y = (v − cy')/fy. cx' is −(U of the point (0, 0, 1) at W = 1).
SceneRays::SceneRays(const TriangleSource& triangles, const Camera& camera)
    : triangles_(triangles),
      camera_(camera),
      perspective_(is_perspective(camera.projection)),
      greatest_u_(camera.width),
      greatest_v_(camera.height),
      handedness_(determinant_of_rotation(camera.world_to_camera).sign()),
      world_(identity(), camera),
      objects_(triangles.objects().size()) {
  const auto [cx, cy] = exact_principal_point(camera.projection);
  const Dyadic fx(camera.projection.fx), fy(camera.projection.fy), skew(camera.projection.skew);
  const Dyadic product = fx * fy;
  const std::array<std::array<Ratio, 3>, 2> exact{
      {{Ratio(1.0, fx), Ratio(-skew, product), Ratio(skew * cy - cx * fy, product)},
       {Ratio(), Ratio(1.0, fy), Ratio(-cy, fy)}}};
  bool safe = true;
  lens_size_ = 1;
  for (std::size_t i = 0; i < 2; ++i) {
    std::array<double, 3> sizes{};
    for (std::size_t k = 0; k < 3; ++k) safe = set(exact[i][k], lens_[i][k], sizes[k]) && safe;
    const double sum = sizes[0] * greatest_u_ + sizes[1] * greatest_v_ + sizes[2];
    lens_size_ += sum * sum;
  }
  if (!safe) lens_size_ = std::numeric_limits<double>::infinity();
}

const ObjectRays& SceneRays::object(std::uint32_t number) const {
  const Object& object = triangles_.objects()[number];
  if (object.placed_as_is) return world_;
  Slot& slot = objects_[number];
  std::call_once(slot.made, [&] { slot.rays.emplace(object, camera_); });
  return *slot.rays;
}

}  // namespace fathom::triangle
