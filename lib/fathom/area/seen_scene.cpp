#include "fathom/area/seen_scene.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <utility>

#include "fathom/camera/pose.h"
#include "fathom/failures/errors.h"
#include "fathom/threads/interruption.h"
#include "fathom/threads/threads.h"

namespace fathom::area {
namespace {

using Vector = std::array<double, 3>;

/// Columns and rows of the image of a direction.
constexpr std::uint32_t image_size = 1024;

bool is_finite(const Vector& v) {
  return std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); });
}

/// With the greatest number in [1, 2), if that loses no bit.
Vector normalised(const Vector& d) {
  const double greatest = std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])});
  const int exponent = std::ilogb(greatest);
  Vector scaled = d;
  for (std::size_t k = 0; k < 3; ++k) {
    scaled[k] = std::ldexp(d[k], -exponent);
    if (std::ldexp(scaled[k], exponent) != d[k]) return d;
  }
  return scaled;
}

struct Range {
  std::optional<Dyadic> low, high;
  void add(const Dyadic& x) {
    if (!low || x < *low) low = x;
    if (!high || x > *high) high = x;
  }
};

/// The exact ranges of u, v and D over the corners of all triangles.
std::array<Range, 3> ranges_of(const TriangleSource& triangles, const Pose& pose) {
  std::array<Range, 3> ranges;
  for (std::uint32_t number = 0; number < triangles.count(); ++number) {
    check_interruption();
    for (const WorldPoint& corner : triangles.world_corners(number)) {
      const CameraPoint p = to_camera(pose, corner);
      ranges[0].add(p.x);
      ranges[1].add(p.y);
      ranges[2].add(p.z);
    }
  }
  return ranges;
}

/// A binary64 number near x.
double near(const Dyadic& x) {
  return enclose(x).lower;
}

/// The principal point that shifts a range, times f, to the middle of the image.
double shift_to_middle(const Range& range, double f) {
  return image_size / 2.0 - near((*range.low + *range.high).scaled(-1) * Dyadic(f));
}

bool is_inside(const Range& range, double f, double shift) {
  return std::ranges::all_of(std::array{*range.low, *range.high}, [&](const Dyadic& x) {
    const Dyadic at = Dyadic(f) * x + Dyadic(shift);
    return at > Dyadic(1.0) && at < Dyadic(image_size - 1.0);
  });
}

void refuse_sizes() {
  throw UsageError("direction: its numbers and those of the scene differ too much in size");
}

/// Sets the power of two and the shifts. A mirrored pose has a mirrored image, so that the sides of
/// triangles are the same as for any camera.
void frame(Camera& camera, const std::array<Range, 3>& ranges, bool is_mirrored) {
  const Dyadic width = *ranges[0].high - *ranges[0].low, height = *ranges[1].high - *ranges[1].low;
  const Dyadic& extent = width > height ? width : height;
  // The image is wider than 2⁹.
  long exponent = extent.is_zero() ? 0 : 9 - extent.top();
  Projection& projection = camera.projection;
  for (int attempt = 0; attempt < 80; ++attempt, --exponent) {
    if (exponent < -1000 || exponent > 1000) refuse_sizes();
    projection.fx = std::ldexp(1.0, static_cast<int>(exponent));
    projection.fy = is_mirrored ? -projection.fx : projection.fx;
    projection.cx = shift_to_middle(ranges[0], projection.fx);
    projection.cy = shift_to_middle(ranges[1], projection.fy);
    if (!std::isfinite(projection.cx) || !std::isfinite(projection.cy)) continue;
    if (is_inside(ranges[0], projection.fx, projection.cx) &&
        is_inside(ranges[1], projection.fy, projection.cy)) {
      return;
    }
  }
  refuse_sizes();
}

}  // namespace

Camera camera_of_direction(const TriangleSource& triangles,
                           const std::array<double, 3>& direction) {
  if (!is_finite(direction)) throw UsageError("direction: a number is not finite");
  if (direction == Vector{0, 0, 0}) throw UsageError("direction: all numbers are 0");
  const Vector d = normalised(direction);
  std::size_t k = 0;
  for (std::size_t axis = 1; axis < 3; ++axis) {
    if (std::abs(d[axis]) > std::abs(d[k])) k = axis;
  }
  const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
  Camera camera;
  camera.width = camera.height = image_size;
  camera.projection = {};
  camera.projection.model = ProjectionModel::orthographic;
  Pose pose{};
  pose[0][i] = d[k];
  pose[0][k] = -d[i];
  pose[1][j] = d[k];
  pose[1][k] = -d[j];
  pose[2][k] = d[k] > 0 ? -1 : 1;
  const std::array<Range, 3> ranges = ranges_of(triangles, pose);
  if (ranges[0].low) {
    frame(camera, ranges, d[k] > 0);
    // D > 0 everywhere; adding a constant changes no order.
    const Dyadic& nearest = *ranges[2].low;
    if (nearest.sign() != Sign::positive) {
      const long exponent = nearest.is_zero() ? 0 : std::max(nearest.top() + 1, -1000L);
      if (exponent > 1000) refuse_sizes();
      pose[2][3] = std::ldexp(1.0, static_cast<int>(exponent));
    }
  }
  camera.world_to_camera = pose;
  return camera;
}

std::vector<Camera> cameras_of_point(const std::array<double, 3>& point) {
  if (!is_finite(point)) throw UsageError("point: a number is not finite");
  std::vector<Camera> cameras;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double forward : {1.0, -1.0}) {
      Camera camera;
      camera.width = camera.height = 2;
      camera.projection.cx = camera.projection.cy = 1;
      const std::size_t right = (axis + 1) % 3, down = (axis + 2) % 3;
      Pose pose{};
      // The other axes change places, so that no camera is mirrored.
      pose[0][forward > 0 ? right : down] = 1;
      pose[1][forward > 0 ? down : right] = 1;
      pose[2][axis] = forward;
      for (auto& row : pose) row[3] = -(row[0] * point[0] + row[1] * point[1] + row[2] * point[2]);
      camera.world_to_camera = pose;
      cameras.push_back(camera);
    }
  }
  return cameras;
}

namespace {

ExactVector3 exact(const WorldPoint& p) {
  return {p.x, p.y, p.z};
}
ExactVector3 difference(const ExactVector3& a, const ExactVector3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Ratio third(const Ratio& x) {
  return {x.numerator, x.denominator * Dyadic(3.0)};
}

/// The numbers of all triangles.
std::vector<std::uint32_t> numbers_of(const ProjectedScene& scene) {
  std::vector<std::uint32_t> numbers(scene.count());
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

/// Whether the image is mirrored, so that front sides look like back sides. A pose and a projection
/// may each mirror it; both together do not.
bool shows_mirror_image(const Camera& camera) {
  const bool pose_mirrors =
      determinant_of_rotation(camera.world_to_camera).sign() == Sign::negative;
  return is_mirrored(camera.projection) != pose_mirrors;
}

/// The terms for the corners in the order of the mesh.
SurfaceTerms in_order(const ProjectedScene& scene, std::uint32_t number, SurfaceTerms terms) {
  if (scene.orientation(number) == Sign::positive) return terms;
  if (scene.kind(number) == TriangleKind::regular) {
    std::swap(terms.beta, terms.gamma);
    return terms;
  }
  for (Terms* some : {&terms.share, &terms.beta, &terms.gamma}) {
    for (Ratio& term : *some) term.numerator = -term.numerator;
  }
  return terms;
}

/// The same for sums.
SurfaceSums in_order(const ProjectedScene& scene, std::uint32_t number, SurfaceSums sums) {
  if (scene.orientation(number) == Sign::positive) return sums;
  if (scene.kind(number) == TriangleKind::regular) {
    std::swap(sums.beta, sums.gamma);
  } else {
    for (Words* some : {&sums.share, &sums.beta, &sums.gamma}) *some = -*some;
  }
  return sums;
}

/// Calls visit(number, terms, sums) for each triangle of the mesh that is not hidden for certain.
template <class Visit>
void visit_seen(const PlaneMesh& mesh, PlaneAreas& areas, const WantedTerms& wanted,
                const Visit& visit) {
  const ProjectedScene& scene = mesh.scene();
  for (std::uint32_t i = 0; i < mesh.size(); ++i) {
    const std::uint32_t number = mesh.number(i);
    if (areas.visibility(i) == Visibility::hidden) continue;
    if (areas.visibility(i) == Visibility::whole) {
      SurfaceTerms terms;
      if (wanted.image) terms.image = {scene.own_area(number)};
      if (wanted.on_surface() || wanted.sums) {
        terms.share = terms.beta = terms.gamma = {Dyadic(1.0)};
      }
      SurfaceSums sums;
      if (wanted.sums) sums.share = sums.beta = sums.gamma = {1.0, 0};
      visit(number, terms, sums);
    } else {
      const SurfaceSums sums = wanted.sums ? in_order(scene, number, areas.sums(i)) : SurfaceSums();
      visit(number, in_order(scene, number, areas.take_terms(i)), sums);
    }
  }
}

}  // namespace

Ratio SeenTriangle::moment(std::size_t axis) const {
  return Ratio(corner[axis]) * share() + Ratio(to_second[axis]) * third(sum_of(terms->beta)) +
         Ratio(to_third[axis]) * third(sum_of(terms->gamma));
}

SeenScene::SeenScene(const TriangleSource& triangles, LightKind kind,
                     const std::vector<Camera>& cameras, const std::array<double, 3>& light,
                     Cull cull)
    : triangles_(triangles),
      kind_(kind),
      light_(light),
      sums_(triangles.count()),
      terms_(triangles.count()),
      has_exact_sums_(triangles.count()) {
  if (kind == LightKind::camera) {
    unoccluded_.resize(triangles.count());
    facings_.resize(triangles.count());
  }
  for (const Camera& camera : cameras) {
    const std::function<void(double)> no_report;
    Progress progress(no_report, 1);
    const ProjectedScene& scene =
        scenes_.emplace_back(CoverageFrame{triangles, camera, cull}, progress);
    const WantedTerms wanted{.image = kind == LightKind::camera, .sums = true};
    add(views_.emplace_back(scene, wanted), wanted);
    if (kind == LightKind::camera) add_image(scene, shows_mirror_image(camera));
  }
}

SeenScene::View::View(const ProjectedScene& scene, const WantedTerms& wanted)
    : mesh(scene, numbers_of(scene)), areas(mesh, wanted) {}

// A triangle with terms of its share is visible as a whole: in one view, and in no other.
void SeenScene::find_exact_sums(std::span<const std::uint32_t> numbers) {
  std::vector<bool> is_open(triangles_.count());
  for (const std::uint32_t number : numbers) is_open[number] = terms_[number].share.empty();
  for (View& view : views_) {
    std::vector<bool> open_in_view(view.mesh.size());
    for (std::uint32_t i = 0; i < view.mesh.size(); ++i) {
      open_in_view[i] = is_open[view.mesh.number(i)];
    }
    view.areas.find_terms({.image = false, .share = true, .moments = true}, open_in_view);
    for (std::uint32_t i = 0; i < view.mesh.size(); ++i) {
      if (!open_in_view[i]) continue;
      const std::uint32_t number = view.mesh.number(i);
      append(terms_[number], in_order(view.mesh.scene(), number, view.areas.take_terms(i)));
    }
  }
  for (const std::uint32_t number : numbers) has_exact_sums_[number] = true;
}

SeenTriangle SeenScene::triangle(std::uint32_t number) const {
  SeenTriangle seen = placed(number);
  seen.sums = sums_[number];
  seen.terms = &terms_[number];
  // Triangles that are visible as a whole have terms before find_exact_sums(). Those of hidden
  // triangles are empty.
  seen.has_exact_sums = has_exact_sums_[number] || is_hidden(number) || !seen.terms->share.empty();
  if (kind_ == LightKind::camera) seen.unoccluded = unoccluded_[number];
  return seen;
}

Terms SeenScene::image_terms() const {
  Terms all;
  for (const SurfaceTerms& terms : terms_) {
    all.insert(all.end(), terms.image.begin(), terms.image.end());
  }
  return all;
}

Terms SeenScene::alone(std::span<const std::uint32_t> numbers) const {
  Terms areas;
  const PlaneMesh mesh(scenes_.front(), numbers);
  const bool in_pixels = kind_ == LightKind::camera;
  const WantedTerms wanted{.image = in_pixels, .share = !in_pixels};
  PlaneAreas measured(mesh, wanted);
  visit_seen(mesh, measured, wanted,
             [&](std::uint32_t number, const SurfaceTerms& terms, const SurfaceSums&) {
               Ratio area = in_pixels ? sum_of(terms.image)
                                      : sum_of(terms.share) * Ratio(placed(number).facing);
               if (area.sign() != Sign::zero) areas.push_back(std::move(area));
             });
  return areas;
}

void SeenScene::add(View& view, const WantedTerms& wanted) {
  visit_seen(view.mesh, view.areas, wanted,
             [&](std::uint32_t number, const SurfaceTerms& terms, const SurfaceSums& sums) {
               append(terms_[number], SurfaceTerms(terms));
               if (wanted.sums) sums_[number] += sums;
             });
}

void SeenScene::add_image(const ProjectedScene& scene, bool is_mirrored) {
  parallel_for(std::uint32_t{0}, scene.count(), [&](std::uint32_t number) {
    const Sign turn = scene.orientation(number);
    facings_[number] = is_mirrored ? turn : -turn;
    unoccluded_[number] = unoccluded_area(scene, number);
  });
}

SeenTriangle SeenScene::placed(std::uint32_t number) const {
  SeenTriangle seen;
  const auto corners = triangles_.world_corners(number);
  seen.corner = exact(corners[0]);
  seen.to_second = difference(exact(corners[1]), seen.corner);
  seen.to_third = difference(exact(corners[2]), seen.corner);
  seen.normal = cross(seen.to_second, seen.to_third);
  seen.side = side_of(number, seen);
  return seen;
}

LitSide SeenScene::side_of(std::uint32_t number, SeenTriangle& seen) const {
  Sign side = Sign::zero;
  if (kind_ == LightKind::camera) {
    side = facings_[number];
  } else {
    ExactVector3 towards{light_[0], light_[1], light_[2]};
    if (kind_ == LightKind::point) towards = difference(towards, seen.corner);
    seen.facing = dot(seen.normal, towards);
    side = seen.facing.sign();
    if (side == Sign::negative) seen.facing = -seen.facing;
  }
  return side == Sign::zero       ? LitSide::edge
         : side == Sign::positive ? LitSide::front
                                  : LitSide::back;
}

}  // namespace fathom::area
