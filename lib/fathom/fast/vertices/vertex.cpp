#include "fathom/fast/vertices/vertex.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <new>
#include <utility>

#include "fathom/numeric/rounding.h"
#include "fathom/scene/element_checks.h"
#include "fathom/threads/threads.h"

// The bounds of this file, with u = 2⁻⁵³ (docs/error-analysis.md, "Vertices").
//
// Matrix. U, V, W, D are affine in the mesh's coordinates. The entries of that map are computed
// exactly and rounded once, so that a rounded entry is m(1 + δ), |δ| ≤ u: an entry is 0 only if the
// exact one is (RoundedRows::set). Entries are 0 or between 2⁻²⁰⁰ and 2²⁰⁰ in magnitude (is_safe).
// Else the object is not usable.
//
// Affine value. m₀x + m₁y + m₂z + m₃ from rounded entries: each term goes through at most one
// rounding of its entry, one of the product and three of sums, so the error is at most γ₅·S, where
// S = |m₀x| + |m₁y| + |m₂z| + |m₃| and γ₅ = 5u/(1 − 5u). S is computed with a relative error of at
// most γ₅ as well. 6u·S, computed, is therefore a bound; the excess of 6 over 5 covers the second
// order. A product that underflows adds at most 2⁻¹⁰⁷⁵ absolutely, which each user covers.
namespace fathom::fast {
namespace {

using vertex_bounds::affine_error;
using vertex_bounds::missed_form;
using vertex_bounds::underflow_floor;
using Row = ImageRows::Row;

double apply(const Row& m, double x, double y, double z) {
  return m[0] * x + m[1] * y + m[2] * z + m[3];
}

Row magnitudes(const Row& a, const Row& b) {
  Row greatest;
  for (std::size_t k = 0; k < 4; ++k) greatest[k] = std::max(std::abs(a[k]), std::abs(b[k]));
  return greatest;
}

/// U, V, W, D of a mesh point, exactly.
std::array<Dyadic, 4> exact_image(const Object& object, const Camera& camera, const MeshPoint& X) {
  const CameraPoint p = to_camera(camera.world_to_camera, object.world_from_mesh(X));
  const HomogeneousImagePoint image = to_image(camera.projection, p);
  return {image.U, image.V, image.W, p.z};
}

bool is_safe(double entry) {
  const double size = std::abs(entry);
  return size == 0 || (size >= 0x1p-200 && size <= 0x1p200);
}

struct RoundedRows {
  std::array<Row, 4> rows{};
  /// Whether the bounds were derived for all entries.
  bool usable = true;
  /// Whether no entry was changed by rounding.
  bool exact = true;

  void set(std::size_t i, std::size_t k, const Dyadic& entry) {
    const std::optional<double> rounded = round_to_normal(Ratio(entry));
    usable = usable && rounded && is_safe(*rounded);
    if (rounded) rows[i][k] = *rounded;
    exact = exact && rounded && compare(Dyadic(*rounded), entry) == 0;
  }
};

/// The rows of the affine map from the mesh to U, V, W, D: its values at the origin and how they
/// change along the axes; rounded.
RoundedRows rounded_rows(const Object& object, const Camera& camera) {
  const MeshPoint axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto origin = exact_image(object, camera, {0, 0, 0});
  RoundedRows rounded;
  for (std::size_t i = 0; i < 4; ++i) rounded.set(i, 3, origin[i]);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto end = exact_image(object, camera, axes[k]);
    for (std::size_t i = 0; i < 4; ++i) rounded.set(i, k, end[i] - origin[i]);
  }
  return rounded;
}

/// m·x without rounding; false if unknown.
bool multiply_exactly(double m, double x, double& product) {
  product = m * x;
  if (m == 0 || x == 0) return true;
  const bool no_underflow = std::abs(product) > 0x1p-900;
  return no_underflow && std::fma(m, x, -product) == 0;
}

/// a + b without rounding; false if unknown. TwoSum ([Knu97] 4.2.2) gives the rounding error.
bool add_exactly(double a, double b, double& sum) {
  sum = a + b;
  const double b_part = sum - a;
  return (a - (sum - b_part)) + (b - b_part) == 0;
}

/// The affine value without any rounding; false if unknown.
bool apply_exactly(const Row& m, const MeshPoint& X, double& value) {
  double mx, my, mz, xy, xyz;
  return multiply_exactly(m[0], X.x, mx) && multiply_exactly(m[1], X.y, my) &&
         multiply_exactly(m[2], X.z, mz) && add_exactly(mx, my, xy) && add_exactly(xy, mz, xyz) &&
         add_exactly(xyz, m[3], value);
}

}  // namespace

VertexTransform::VertexTransform(const Object& object, const Camera& camera)
    : perspective_(fathom::is_perspective(camera.projection)),
      width_(camera.width),
      height_(camera.height) {
  const RoundedRows rounded = rounded_rows(object, camera);
  usable_ = rounded.usable;
  exact_ = rounded.exact;
  rows_.U = rounded.rows[0];
  rows_.V = rounded.rows[1];
  rows_.W = rounded.rows[2];
  rows_.D = rounded.rows[3];
  rows_.size_UV = magnitudes(rows_.U, rows_.V);
  rows_.size_W = magnitudes(rows_.W, rows_.W);
  rows_.size_D = magnitudes(rows_.D, rows_.D);
}

ImageVertex VertexTransform::operator()(const MeshPoint& X) const {
  ImageVertex vertex;
  (*this)(std::span(&X, 1), &vertex);
  return vertex;
}

// If U, V and W are computed without rounding, U/W is exactly the given multiple u if u·W = U; the
// fused multiply-add rounds u·W − U once, and a number that is not 0 does not round to 0 here (no
// underflow: u·W and U are multiples of 2⁻⁹⁰⁰⁻⁵³⁻⁸).
bool VertexTransform::lies_exactly_at(const MeshPoint& X, double u, double v) const {
  double U, V, W;
  if (!exact_ || !apply_exactly(rows_.U, X, U) || !apply_exactly(rows_.V, X, V)) return false;
  if (!perspective_) return U == u && V == v;
  return apply_exactly(rows_.W, X, W) && std::fma(u, W, -U) == 0 && std::fma(v, W, -V) == 0;
}

VertexTransform::Homogeneous VertexTransform::homogeneous(const MeshPoint& X) const {
  const auto [x, y, z] = X;
  const double ax = std::abs(x), ay = std::abs(y), az = std::abs(z);
  return {apply(rows_.U, x, y, z), apply(rows_.V, x, y, z), apply(rows_.W, x, y, z),
          affine_error * apply(rows_.size_UV, ax, ay, az),
          affine_error * apply(rows_.size_W, ax, ay, az)};
}

// With k = 0, w or h, the computed form kŴ − Û errs by at most E_UV + k·E_W and by roundings of k·Ŵ
// and of the difference, at most u(|Û| + 2k|Ŵ|)(1 + u), which is less than (E_UV + 2k·E_W)/5, as
// |Û| ≤ E_UV/(6u)·(1 + 2⁻⁵⁰) and likewise for Ŵ: together 1.2·E_UV + 1.4k·E_W. 1.5 is used, for the
// roundings of the bound as well.
std::array<VertexForm, 5> VertexTransform::forms_of_image(const MeshPoint& X) const {
  const Homogeneous p = homogeneous(X);
  const auto form = [&](double value, double k) {
    return VertexForm{value, missed_form * (p.error_UV + k * p.error_W + underflow_floor)};
  };
  return {VertexForm{p.W, missed_form * (p.error_W + underflow_floor)}, form(p.U, 0),
          form(width_ * p.W - p.U, width_), form(p.V, 0), form(height_ * p.W - p.V, height_)};
}

// A covered sample s is a combination of the corners with weights that are not negative (the edge
// functions divided by Δ), so a linear form in (U, V, W) that is negative at every corner is
// negative at (s_u, s_v, 1). The forms are W itself; U and V, which are positive at every sample;
// wW − U and hW − V, which are too. The rounding of the last sum does not change its sign. Where
// something overflows, the comparison is false.
bool VertexTransform::misses_image(const std::array<MeshPoint, 3>& corners) const {
  if (!usable_) return false;
  std::array<bool, 5> misses;
  misses.fill(true);
  for (const MeshPoint& X : corners) {
    const auto forms = forms_of_image(X);
    for (std::size_t i = 0; i < forms.size(); ++i) {
      misses[i] = misses[i] && forms[i].value + forms[i].error < 0;
    }
  }
  return std::find(misses.begin(), misses.end(), true) != misses.end();
}

namespace {

/// Throws scene::ElementFault if a number is not finite. That is looked at after the work, while
/// the points are in the innermost cache: before it, a twentieth of a map's time would go into
/// waiting for them.
void transform_finite(const VertexTransform& transform, std::span<const MeshPoint> points,
                      ImageVertex* image) {
  constexpr std::size_t part = 512;
  for (std::size_t first = 0; first < points.size(); first += part) {
    const auto some = points.subspan(first, std::min(part, points.size() - first));
    transform(some, image + first);
    if (!scene::all_finite(some)) throw scene::ElementFault();
  }
}

}  // namespace

ImageObject::ImageObject(const Object& object, const Mesh& its_mesh, const Camera& camera,
                         std::uint32_t first_triangle, VertexMemory* where_kept,
                         std::span<const std::uint32_t> numbers)
    : mesh(its_mesh),
      first_number(first_triangle),
      transform(object, camera),
      vertices(where_kept ? where_kept->take(mesh.vertices.size())
                          : std::make_unique_for_overwrite<ImageVertex[]>(mesh.vertices.size())),
      kept(where_kept),
      scene_numbers(numbers.empty() ? nullptr : numbers.data()) {
  constexpr std::size_t part = 4096;
  const std::size_t count = mesh.vertices.size();
  in_parallel((count + part - 1) / part, [&](std::size_t i) {
    const std::size_t first = i * part;
    transform_finite(transform,
                     std::span(mesh.vertices).subspan(first, std::min(part, count - first)),
                     vertices.get() + first);
  });
}

ImageObject::~ImageObject() {
  if (kept) kept->give_back(std::move(vertices), mesh.vertices.size());
}

VertexMemory::Vertices VertexMemory::take(std::size_t count) {
  const auto fits = std::find_if(blocks_.begin(), blocks_.end(),
                                 [&](const Block& block) { return block.count == count; });
  if (fits == blocks_.end()) return std::make_unique_for_overwrite<ImageVertex[]>(count);
  Vertices vertices = std::move(fits->vertices);
  blocks_.erase(fits);
  return vertices;
}

void VertexMemory::give_back(Vertices vertices, std::size_t count) noexcept try {
  blocks_.push_back({std::move(vertices), count});
} catch (const std::bad_alloc&) {
}

const ImageObject& object_of(const ImageObjects& objects, std::uint32_t number) {
  const auto next = std::upper_bound(
      objects.begin(), objects.end(), number,
      [](std::uint32_t n, const ImageObject& object) { return n < object.first_number; });
  return *std::prev(next);
}

}  // namespace fathom::fast
