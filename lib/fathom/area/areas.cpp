#include "fathom/area/areas.h"

#include <bit>
#include <functional>
#include <numeric>
#include <utility>

#include "fathom/area/plane/light_cameras.h"
#include "fathom/area/plane/plane_areas.h"
#include "fathom/camera/pose.h"
#include "fathom/failures/errors.h"
#include "fathom/numeric/ratio_sum.h"
#include "fathom/numeric/root_sum.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/scene/scene_fault.h"
#include "fathom/threads/threads.h"

namespace fathom {
using namespace area;

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

/// The part of a triangle that a light sees, exactly.
struct SeenTriangle {
  LitSide side = LitSide::edge;
  /// The visible share of the triangle's area, and this share times 3β and 3γ of its centre, as in
  /// SurfaceTerms.
  Ratio share, beta, gamma;
  /// From a camera, in pixels: the visible area, and the area with all other triangles removed.
  Ratio visible, unoccluded;
  ExactVector3 corner, to_second, to_third, normal;
  /// |n·d| of a direction.
  Dyadic facing;

  /// The share times the centre.
  [[nodiscard]] Ratio moment(std::size_t axis) const {
    return Ratio(corner[axis]) * share + Ratio(to_second[axis]) * third(beta) +
           Ratio(to_third[axis]) * third(gamma);
  }
};

/// √(x²/(4·square)), rounded once.
double rounded_across(const Real& x, const Dyadic& square) {
  return std::bit_cast<double>(x.rounded([&](const Ratio& value) {
    return std::bit_cast<std::uint64_t>(
        round_sqrt_to_binary64(quotient(value * value, Ratio(square.scaled(2)))));
  }));
}

/// Whether the image is mirrored, so that front sides look like back sides. A pose and a projection
/// may each mirror it; both together do not.
bool shows_mirror_image(const Camera& camera) {
  const bool pose_mirrors =
      determinant_of_rotation(camera.world_to_camera).sign() == Sign::negative;
  return is_mirrored(camera.projection) != pose_mirrors;
}

enum class LightKind { direction, point, camera };

/// The visible parts of all triangles, from the cameras of a light.
class SeenScene {
 public:
  SeenScene(const TriangleSource& triangles, LightKind kind, const std::vector<Camera>& cameras,
            Cull cull)
      : triangles_(triangles), kind_(kind), terms_(triangles.count()) {
    wanted_ = {.image = kind == LightKind::camera, .share = true, .moments = true};
    if (kind == LightKind::camera) {
      unoccluded_.resize(triangles.count());
      facings_.resize(triangles.count());
    }
    for (const Camera& camera : cameras) add({triangles, camera, cull});
  }

  /// Whether nothing is visible of a triangle, for certain.
  [[nodiscard]] bool is_hidden(std::uint32_t number) const { return terms_[number].share.empty(); }

  /// `light` is the direction, or the point.
  [[nodiscard]] SeenTriangle triangle(std::uint32_t number,
                                      const std::array<double, 3>& light) const {
    SeenTriangle seen;
    const auto corners = triangles_.world_corners(number);
    seen.corner = exact(corners[0]);
    seen.to_second = difference(exact(corners[1]), seen.corner);
    seen.to_third = difference(exact(corners[2]), seen.corner);
    seen.normal = cross(seen.to_second, seen.to_third);
    seen.side = side_of(number, seen, light);
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

 private:
  void add(const CoverageFrame& frame) {
    const std::function<void(double)> no_report;
    Progress progress(no_report, 1);
    const ProjectedScene scene(frame, progress);
    std::vector<std::uint32_t> numbers(scene.count());
    std::iota(numbers.begin(), numbers.end(), 0);
    const PlaneMesh mesh(scene, numbers);
    PlaneAreas areas(mesh, wanted_);
    for (std::uint32_t i = 0; i < mesh.size(); ++i) add(scene, mesh.number(i), areas, i);
    if (kind_ == LightKind::camera) add_image(scene, shows_mirror_image(frame.camera));
  }

  void add(const ProjectedScene& scene, std::uint32_t number, const PlaneAreas& areas,
           std::uint32_t i) {
    if (areas.visibility(i) == Visibility::hidden) return;
    if (areas.visibility(i) == Visibility::whole) {
      const Ratio one(Dyadic(1.0));
      add(number, {wanted_.image ? Terms{scene.own_area(number)} : Terms(), {one}, {one}, {one}});
    } else {
      add(number, in_order(scene, number, areas.terms(i)));
    }
  }

  /// The terms for the corners in the order of the mesh.
  static SurfaceTerms in_order(const ProjectedScene& scene, std::uint32_t number,
                               SurfaceTerms terms) {
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

  void add(std::uint32_t number, const SurfaceTerms& some) {
    SurfaceTerms& all = terms_[number];
    all.image.insert(all.image.end(), some.image.begin(), some.image.end());
    all.share.insert(all.share.end(), some.share.begin(), some.share.end());
    all.beta.insert(all.beta.end(), some.beta.begin(), some.beta.end());
    all.gamma.insert(all.gamma.end(), some.gamma.begin(), some.gamma.end());
  }

  void add_image(const ProjectedScene& scene, bool is_mirrored) {
    parallel_for(std::uint32_t{0}, scene.count(), [&](std::uint32_t number) {
      const Sign turn = scene.orientation(number);
      facings_[number] = is_mirrored ? turn : -turn;
      unoccluded_[number] = unoccluded_area(scene, number);
    });
  }

  [[nodiscard]] LitSide side_of(std::uint32_t number, SeenTriangle& seen,
                                const std::array<double, 3>& light) const {
    Sign side = Sign::zero;
    if (kind_ == LightKind::camera) {
      side = facings_[number];
    } else {
      ExactVector3 towards{light[0], light[1], light[2]};
      if (kind_ == LightKind::point) towards = difference(towards, seen.corner);
      seen.facing = dot(seen.normal, towards);
      side = seen.facing.sign();
      if (side == Sign::negative) seen.facing = -seen.facing;
    }
    return side == Sign::zero       ? LitSide::edge
           : side == Sign::positive ? LitSide::front
                                    : LitSide::back;
  }

  const TriangleSource& triangles_;
  LightKind kind_;
  WantedTerms wanted_;
  std::vector<SurfaceTerms> terms_;
  /// From a camera.
  std::vector<Ratio> unoccluded_;
  /// The sign of n·d.
  std::vector<Sign> facings_;
};

/// Rounds the values of triangles and groups.
class LightAreas {
 public:
  LightAreas(LightKind kind, const std::array<double, 3>& light, AreaCentroid centroid)
      : kind_(kind), centroid_(centroid) {
    const ExactVector3 d{light[0], light[1], light[2]};
    if (kind == LightKind::direction) square_ = dot(d, d);
  }

  [[nodiscard]] LitArea of(const SeenTriangle& seen) const {
    LitArea area;
    area.side = seen.side;
    switch (kind_) {
      case LightKind::direction:
        area.visible = rounded_across(seen.share * Ratio(seen.facing), square_);
        area.projected = rounded_across(Ratio(seen.facing), square_);
        break;
      case LightKind::camera:
        area.visible = round_to_binary64(seen.visible);
        area.projected = round_to_binary64(seen.unoccluded);
        break;
      case LightKind::point:
        break;
    }
    area.fraction = fraction_of(seen);
    const Dyadic n = dot(seen.normal, seen.normal);
    area.lit = round_sqrt_to_binary64(seen.share * seen.share * Ratio(n.scaled(-2)));
    if (seen.share.sign() != Sign::zero) {
      auto& centre = area.centroid.emplace();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        centre[axis] = round_to_binary64(quotient(seen.moment(axis), seen.share));
      }
    }
    return area;
  }

  /// Of triangles of each of which something is visible.
  [[nodiscard]] LitArea of(const std::vector<SeenTriangle>& group) const {
    LitArea area;
    if (kind_ != LightKind::point) area.visible = visible(group);
    RootSum lit;
    for (const SeenTriangle& seen : group) add(lit, seen.share, seen);
    area.lit = round_to_binary64(affine(lit.value(), Ratio(Dyadic(0.5)), Ratio()));
    if (lit.is_empty()) return area;
    const bool across = kind_ == LightKind::direction && centroid_ == AreaCentroid::across;
    auto& centre = area.centroid.emplace();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      centre[axis] = across ? across_centre(group, axis) : lit_centre(group, lit, axis);
    }
    return area;
  }

 private:
  [[nodiscard]] std::optional<double> fraction_of(const SeenTriangle& seen) const {
    if (seen.side == LitSide::edge) return std::nullopt;
    if (kind_ != LightKind::camera) return round_to_binary64(seen.share);
    if (seen.unoccluded.sign() == Sign::zero) return std::nullopt;
    return round_to_binary64(quotient(seen.visible, seen.unoccluded));
  }

  [[nodiscard]] double visible(const std::vector<SeenTriangle>& group) const {
    Terms terms;
    const bool in_pixels = kind_ == LightKind::camera;
    for (const SeenTriangle& seen : group) {
      terms.push_back(in_pixels ? seen.visible : seen.share * Ratio(seen.facing));
    }
    const Real sum = real_sum(std::move(terms));
    return in_pixels ? round_to_binary64(sum) : rounded_across(sum, square_);
  }

  static void add(RootSum& sum, const Ratio& factor, const SeenTriangle& seen) {
    sum.add(factor, dot(seen.normal, seen.normal));
  }

  static double across_centre(const std::vector<SeenTriangle>& group, std::size_t axis) {
    Terms over, under;
    for (const SeenTriangle& seen : group) {
      over.push_back(seen.moment(axis) * Ratio(seen.facing));
      under.push_back(seen.share * Ratio(seen.facing));
    }
    return round_to_binary64(real_quotient(std::move(over), std::move(under)));
  }

  static double lit_centre(const std::vector<SeenTriangle>& group, const RootSum& lit,
                           std::size_t axis) {
    RootSum over;
    for (const SeenTriangle& seen : group) add(over, seen.moment(axis), seen);
    return round_to_binary64(quotient(over, lit));
  }

  LightKind kind_;
  AreaCentroid centroid_;
  Dyadic square_;
};

std::vector<LitArea> measure(const TriangleSource& triangles, LightKind kind,
                             const std::vector<Camera>& cameras, const std::array<double, 3>& light,
                             const AreaOptions& options) {
  const auto count = static_cast<std::uint32_t>(triangles.count());
  const SeenScene scene(triangles, kind, cameras, options.cull);
  const LightAreas areas(kind, light, options.centroid);
  if (options.groups.empty()) {
    std::vector<LitArea> result(count);
    parallel_for(std::uint32_t{0}, count, [&](std::uint32_t number) {
      result[number] = areas.of(scene.triangle(number, light));
    });
    return result;
  }
  std::vector<std::vector<std::uint32_t>> members(options.group_count);
  for (std::uint32_t number = 0; number < count; ++number) {
    if (options.groups[number] < options.group_count) {
      members[options.groups[number]].push_back(number);
    }
  }
  std::vector<LitArea> result(options.group_count);
  parallel_for(std::uint32_t{0}, options.group_count, [&](std::uint32_t group) {
    std::vector<SeenTriangle> seen;
    for (const std::uint32_t number : members[group]) {
      if (scene.is_hidden(number)) continue;
      SeenTriangle member = scene.triangle(number, light);
      if (member.share.sign() != Sign::zero) seen.push_back(std::move(member));
    }
    result[group] = areas.of(seen);
  });
  return result;
}

void require_groups(const TriangleSource& triangles, const AreaOptions& options) {
  if (options.groups.empty() || options.groups.size() == triangles.count()) return;
  throw UsageError("groups: expected one number for each triangle");
}

template <class Work>
std::vector<LitArea> in_arena(const TriangleSource& triangles, const AreaOptions& options,
                              const Work& work) {
  return with_threads(options.threads, [&] {
    require_groups(triangles, options);
    return work();
  });
}

}  // namespace

std::vector<LitArea> areas_in_direction(const TriangleSource& triangles,
                                        const AreaDirection& direction,
                                        const AreaOptions& options) {
  const StandardArithmetic standard;
  return in_arena(triangles, options, [&] {
    require_valid(triangles);
    return measure(triangles, LightKind::direction, {camera_of_direction(triangles, direction)},
                   direction, options);
  });
}

std::vector<LitArea> areas_from_point(const TriangleSource& triangles, const AreaPoint& point,
                                      const AreaOptions& options) {
  const StandardArithmetic standard;
  return in_arena(triangles, options, [&] {
    require_valid(triangles);
    return measure(triangles, LightKind::point, cameras_of_point(point), point, options);
  });
}

std::vector<LitArea> areas_from_camera(const TriangleSource& triangles, const Camera& camera,
                                       const AreaOptions& options) {
  const StandardArithmetic standard;
  return in_arena(triangles, options, [&] {
    require_renderable(triangles, camera);
    return measure(triangles, LightKind::camera, {camera}, {}, options);
  });
}

}  // namespace fathom
