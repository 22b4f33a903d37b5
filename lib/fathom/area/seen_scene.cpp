#include "fathom/area/seen_scene.h"

#include <functional>
#include <numeric>
#include <utility>

#include "fathom/camera/pose.h"
#include "fathom/threads/threads.h"

namespace fathom::area {
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

/// Calls visit(number, terms) for each triangle of the mesh that is not hidden for certain.
template <class Visit>
void visit_seen(const PlaneMesh& mesh, const WantedTerms& wanted, const Visit& visit) {
  const ProjectedScene& scene = mesh.scene();
  const PlaneAreas areas(mesh, wanted);
  for (std::uint32_t i = 0; i < mesh.size(); ++i) {
    const std::uint32_t number = mesh.number(i);
    if (areas.visibility(i) == Visibility::hidden) continue;
    if (areas.visibility(i) == Visibility::whole) {
      const Ratio one(Dyadic(1.0));
      visit(number,
            SurfaceTerms{
                wanted.image ? Terms{scene.own_area(number)} : Terms(), {one}, {one}, {one}});
    } else {
      visit(number, in_order(scene, number, areas.terms(i)));
    }
  }
}

}  // namespace

Ratio SeenTriangle::moment(std::size_t axis) const {
  return Ratio(corner[axis]) * share + Ratio(to_second[axis]) * third(beta) +
         Ratio(to_third[axis]) * third(gamma);
}

SeenScene::SeenScene(const TriangleSource& triangles, LightKind kind,
                     const std::vector<Camera>& cameras, const std::array<double, 3>& light,
                     Cull cull)
    : triangles_(triangles), kind_(kind), light_(light), terms_(triangles.count()) {
  wanted_ = {.image = kind == LightKind::camera, .share = true, .moments = true};
  if (kind == LightKind::camera) {
    unoccluded_.resize(triangles.count());
    facings_.resize(triangles.count());
  }
  for (const Camera& camera : cameras) {
    const std::function<void(double)> no_report;
    Progress progress(no_report, 1);
    add(scenes_.emplace_back(CoverageFrame{triangles, camera, cull}, progress));
    if (kind == LightKind::camera) add_image(scenes_.back(), shows_mirror_image(camera));
  }
}

SeenTriangle SeenScene::triangle(std::uint32_t number) const {
  SeenTriangle seen = placed(number);
  const SurfaceTerms& terms = terms_[number];
  seen.share = sum_of(terms.share);
  seen.beta = sum_of(terms.beta);
  seen.gamma = sum_of(terms.gamma);
  if (kind_ == LightKind::camera) {
    seen.visible = sum_of(terms.image);
    seen.unoccluded = unoccluded_[number];
  }
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
  visit_seen(mesh, {.image = in_pixels, .share = !in_pixels},
             [&](std::uint32_t number, const SurfaceTerms& terms) {
               Ratio area = in_pixels ? sum_of(terms.image)
                                      : sum_of(terms.share) * Ratio(placed(number).facing);
               if (area.sign() != Sign::zero) areas.push_back(std::move(area));
             });
  return areas;
}

void SeenScene::add(const ProjectedScene& scene) {
  std::vector<std::uint32_t> numbers(scene.count());
  std::iota(numbers.begin(), numbers.end(), 0);
  visit_seen(PlaneMesh(scene, numbers), wanted_,
             [&](std::uint32_t number, const SurfaceTerms& terms) { add(number, terms); });
}

void SeenScene::add(std::uint32_t number, const SurfaceTerms& some) {
  SurfaceTerms& all = terms_[number];
  all.image.insert(all.image.end(), some.image.begin(), some.image.end());
  all.share.insert(all.share.end(), some.share.begin(), some.share.end());
  all.beta.insert(all.beta.end(), some.beta.begin(), some.beta.end());
  all.gamma.insert(all.gamma.end(), some.gamma.begin(), some.gamma.end());
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
