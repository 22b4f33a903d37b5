#include "fathom/area/areas.h"

#include <bit>
#include <map>
#include <utility>

#include "fathom/area/seen_scene.h"
#include "fathom/failures/errors.h"
#include "fathom/mesh/segmentation.h"
#include "fathom/numeric/real_sums.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/scene/scene_fault.h"
#include "fathom/scene/scene_segments.h"
#include "fathom/threads/threads.h"

namespace fathom {
using namespace area;

namespace {

/// √(x²/(4·square)), rounded once.
double rounded_across(const Real& x, const Dyadic& square) {
  return std::bit_cast<double>(x.rounded([&](const Ratio& value) {
    return std::bit_cast<std::uint64_t>(
        round_sqrt_to_binary64(quotient(value * value, Ratio(square.scaled(2)))));
  }));
}

/// Rounds the values of triangles and groups.
class LightAreas {
 public:
  LightAreas(LightKind kind, const std::array<double, 3>& light, const AreaOptions& options)
      : kind_(kind), centroid_(options.centroid), keeps_exact_(options.exact) {
    const ExactVector3 d{light[0], light[1], light[2]};
    if (kind == LightKind::direction) square_ = dot(d, d);
  }

  [[nodiscard]] LitArea of(const SeenTriangle& seen) const {
    LitArea area;
    area.side = seen.side;
    const auto [visible, projected] = areas_of(seen);
    if (kind_ != LightKind::point) {
      area.visible = rounded(visible);
      area.projected = rounded(projected);
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
    if (keeps_exact_) area.exact = ExactArea{unscaled(visible), unscaled(projected)};
    return area;
  }

  /// The area of triangles each of which is at least partly visible.
  [[nodiscard]] LitArea of(const std::vector<SeenTriangle>& group) const {
    LitArea area;
    const Terms terms = visible_terms(group);
    if (kind_ != LightKind::point) area.visible = rounded(real_sum(terms));
    RootSum lit;
    for (const SeenTriangle& seen : group) add(lit, seen.share, seen);
    area.lit = round_to_binary64(affine(lit.value(), Ratio(Dyadic(0.5)), Ratio()));
    if (keeps_exact_) area.exact.emplace();
    if (keeps_exact_ && kind_ != LightKind::point) area.exact->visible = unscaled(sum_of(terms));
    if (lit.is_empty()) return area;
    const bool across = kind_ == LightKind::direction && centroid_ == AreaCentroid::across;
    auto& centre = area.centroid.emplace();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      centre[axis] = across ? across_centre(group, axis) : lit_centre(group, lit, axis);
    }
    return area;
  }

  /// Adds the values that a group has if its areas with all other triangles removed are known.
  void add_alone(LitArea& area, const std::vector<SeenTriangle>& group, const Terms& alone) const {
    area.projected = rounded(real_sum(alone));
    if (!alone.empty()) {
      const Terms visible = visible_terms(group);
      area.fraction = visible.empty() ? 0 : round_to_binary64(real_quotient(visible, alone));
    }
    if (keeps_exact_) area.exact->projected = unscaled(sum_of(alone));
  }

 private:
  /// Of a direction share·|n·d| and |n·d|, of a camera pixels, of a point shares.
  [[nodiscard]] std::pair<Ratio, Ratio> areas_of(const SeenTriangle& seen) const {
    switch (kind_) {
      case LightKind::direction:
        return {seen.share * Ratio(seen.facing), seen.facing};
      case LightKind::camera:
        return {seen.visible, seen.unoccluded};
      case LightKind::point:
        break;
    }
    return {seen.share, Dyadic(seen.side == LitSide::edge ? 0.0 : 1.0)};
  }

  [[nodiscard]] std::optional<double> fraction_of(const SeenTriangle& seen) const {
    if (seen.side == LitSide::edge) return std::nullopt;
    if (kind_ != LightKind::camera) return round_to_binary64(seen.share);
    if (seen.unoccluded.sign() == Sign::zero) return std::nullopt;
    return round_to_binary64(quotient(seen.visible, seen.unoccluded));
  }

  /// An area of areas_of(), rounded once.
  [[nodiscard]] double rounded(const Real& area) const {
    return kind_ == LightKind::direction ? rounded_across(area, square_) : round_to_binary64(area);
  }
  /// The same as in ExactArea.
  [[nodiscard]] Ratio unscaled(const Ratio& area) const {
    return kind_ == LightKind::direction ? area * Ratio(Dyadic(0.5)) : area;
  }

  [[nodiscard]] Terms visible_terms(const std::vector<SeenTriangle>& group) const {
    Terms terms;
    for (const SeenTriangle& seen : group) terms.push_back(areas_of(seen).first);
    return terms;
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
  bool keeps_exact_;
  Dyadic square_;
};

/// The triangles of each group, in ascending order.
std::vector<std::vector<std::uint32_t>> members_of(const AreaOptions& options) {
  std::vector<std::vector<std::uint32_t>> members(options.group_count);
  for (std::uint32_t number = 0; number < options.groups.size(); ++number) {
    if (options.groups[number] < options.group_count) {
      members[options.groups[number]].push_back(number);
    }
  }
  return members;
}

/// The visible parts of some triangles, without hidden triangles.
std::vector<SeenTriangle> seen_among(const SeenScene& scene,
                                     const std::vector<std::uint32_t>& numbers) {
  std::vector<SeenTriangle> seen;
  for (const std::uint32_t number : numbers) {
    if (scene.is_hidden(number)) continue;
    SeenTriangle triangle = scene.triangle(number);
    if (triangle.share.sign() != Sign::zero) seen.push_back(std::move(triangle));
  }
  return seen;
}

std::vector<LitArea> measure(const TriangleSource& triangles, LightKind kind,
                             const std::vector<Camera>& cameras, const std::array<double, 3>& light,
                             const AreaOptions& options) {
  const auto count = static_cast<std::uint32_t>(triangles.count());
  const SeenScene scene(triangles, kind, cameras, light, options.cull);
  const LightAreas areas(kind, light, options);
  if (options.groups.empty() && count > 0) {
    std::vector<LitArea> result(count);
    parallel_for(std::uint32_t{0}, count,
                 [&](std::uint32_t number) { result[number] = areas.of(scene.triangle(number)); });
    return result;
  }
  const auto members = members_of(options);
  const bool alone = options.alone && kind != LightKind::point;
  std::vector<LitArea> result(options.group_count);
  parallel_for(std::uint32_t{0}, options.group_count, [&](std::uint32_t group) {
    const std::vector<SeenTriangle> seen = seen_among(scene, members[group]);
    result[group] = areas.of(seen);
    if (alone) areas.add_alone(result[group], seen, scene.alone(members[group]));
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

double background_from_camera(const TriangleSource& triangles, const Camera& camera,
                              const AreaOptions& options) {
  const StandardArithmetic standard;
  return with_threads(options.threads, [&] {
    require_renderable(triangles, camera);
    const SeenScene scene(triangles, LightKind::camera, {camera}, {}, options.cull);
    const Ratio image = Dyadic(1.0 * camera.width) * Dyadic(1.0 * camera.height);
    return round_to_binary64(affine(real_sum(scene.image_terms()), Ratio(Dyadic(-1.0)), image));
  });
}

namespace {

AreaItems triangles_of(const Scene& scene, const TriangleSource& triangles) {
  AreaItems result;
  for (std::uint32_t number = 0; number < triangles.count(); ++number) {
    const TriangleOrigin origin = triangles.origin(number);
    result.items.push_back({number, scene.objects[origin.object].name, origin.object, origin.face});
  }
  return result;
}

AreaItems objects_of(const Scene& scene, const TriangleSource& triangles) {
  AreaItems result;
  for (std::size_t object = 0; object < scene.objects.size(); ++object) {
    result.items.push_back({object, scene.objects[object].name, {}, {}});
  }
  for (std::uint32_t number = 0; number < triangles.count(); ++number) {
    result.of_triangle.push_back(triangles.origin(number).object);
  }
  return result;
}

AreaItems faces_of(const Scene& scene, const TriangleSource& triangles) {
  AreaItems result;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known;
  for (std::uint32_t number = 0; number < triangles.count(); ++number) {
    const TriangleOrigin origin = triangles.origin(number);
    const auto next = static_cast<std::uint32_t>(result.items.size());
    const auto [face, is_new] = known.emplace(std::pair(origin.object, origin.face), next);
    if (is_new) {
      result.items.push_back(
          {origin.face, scene.objects[origin.object].name, origin.object, origin.face});
    }
    result.of_triangle.push_back(face->second);
  }
  return result;
}

AreaItems segments_of(const TriangleSource& triangles, Segmentation by) {
  AreaItems result;
  const SceneSegments segments(triangles, {by});
  std::map<std::uint32_t, std::uint32_t> known;
  for (std::uint32_t number = 0; number < triangles.count(); ++number) {
    const std::uint32_t segment = segments.number(by, triangles.origin(number));
    if (segment == unsegmented) {
      result.of_triangle.push_back(AreaOptions::no_group);
      continue;
    }
    const auto next = static_cast<std::uint32_t>(result.items.size());
    const auto [item, is_new] = known.emplace(segment, next);
    if (is_new) {
      const auto& names = segments.names(by);
      result.items.push_back({segment, names.empty() ? std::string() : names[segment], {}, {}});
    }
    result.of_triangle.push_back(item->second);
  }
  return result;
}

}  // namespace

const char* name_of(AreaItemKind kind) {
  switch (kind) {
    case AreaItemKind::object:
      return "object";
    case AreaItemKind::face:
      return "face";
    case AreaItemKind::triangle:
      return "triangle";
    case AreaItemKind::material:
      return "material";
    case AreaItemKind::group:
      return "group";
    case AreaItemKind::part:
      return "part";
    case AreaItemKind::label:
      break;
  }
  return "label";
}

AreaItems area_items(const Scene& scene, AreaItemKind kind) {
  const TriangleSource triangles(scene);
  switch (kind) {
    case AreaItemKind::object:
      return objects_of(scene, triangles);
    case AreaItemKind::face:
      return faces_of(scene, triangles);
    case AreaItemKind::triangle:
      return triangles_of(scene, triangles);
    case AreaItemKind::material:
      return segments_of(triangles, Segmentation::material);
    case AreaItemKind::group:
      return segments_of(triangles, Segmentation::group);
    case AreaItemKind::part:
      return segments_of(triangles, Segmentation::part);
    case AreaItemKind::label:
      break;
  }
  return segments_of(triangles, Segmentation::label);
}

AreaOptions options_of(const AreaItems& items) {
  AreaOptions options;
  options.groups = items.of_triangle;
  options.group_count = static_cast<std::uint32_t>(items.items.size());
  return options;
}

}  // namespace fathom
