#include "fathom/area/areas.h"

#include <algorithm>
#include <array>
#include <bit>
#include <iterator>
#include <map>
#include <numeric>
#include <utility>

#include "fathom/area/seen_scene.h"
#include "fathom/failures/errors.h"
#include "fathom/mesh/segmentation.h"
#include "fathom/numeric/certified_rounding.h"
#include "fathom/numeric/exact_words.h"
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

// Certified first: sums of double-words with bounds settle nearly every rounding. The exact sums,
// whose denominators are long, decide the rest.

/// Rounds numbers once: by their bounds, or exactly if the exact terms are known. The terms of
/// triangles that are visible as a whole are always known: a third of the sum of three corners is
/// often a tie.
class Rounding {
 public:
  /// Numbers to round depend on this triangle.
  void include(const SeenTriangle& seen) { has_exact_sums_ &= seen.has_exact_sums; }

  /// The rounded number, or anything if nothing settles it.
  template <class Exactly>
  double operator()(const Words& x, const Exactly& exactly) {
    if (const std::optional<double> settled = to_binary64(x.value, x.error)) return *settled;
    if (has_exact_sums_) return exactly();
    settles_all_ = false;
    return 0;
  }
  /// Whether a triangle is visible at all.
  bool is_visible(const SeenTriangle& seen) {
    const Words& share = seen.sums.share;
    if (is_exact_zero(share)) return false;
    if (certain_sign(share.value, share.error)) return true;
    if (seen.has_exact_sums) return seen.share().sign() != Sign::zero;
    settles_all_ = false;
    return false;
  }
  [[nodiscard]] bool settles_all() const { return settles_all_; }

 private:
  bool has_exact_sums_ = true, settles_all_ = true;
};

/// How the areas of triangles weigh in the centroid of a group.
enum class Weight : std::uint8_t { share, across, lit };

/// Quantities of a triangle or of a group: the visible area as LightAreas::areas_of() has it, twice
/// the area on the surface, the weight, and the weight times the centroid.
struct AreaWords {
  Words visible{0.0, 0}, twice_lit{0.0, 0}, weight{0.0, 0};
  std::array<Words, 3> moment{weight, weight, weight};

  AreaWords() = default;
  AreaWords(const SeenTriangle& seen, LightKind kind, Weight by) {
    if (is_exact_zero(seen.sums.share)) return;
    const Words three{3.0, 0}, share = seen.sums.share, beta = seen.sums.beta / three,
                               gamma = seen.sums.gamma / three;
    const Words facing = in_words(seen.facing),
                length = sqrt(in_words(dot(seen.normal, seen.normal)));
    visible = kind == LightKind::direction ? share * facing
              : kind == LightKind::camera  ? sum_in_words(seen.terms->image)
                                           : share;
    twice_lit = share * length;
    const Words factor = by == Weight::across ? facing : by == Weight::lit ? length : Words{1.0, 0};
    weight = share * factor;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      moment[axis] =
          factor * (in_words(seen.corner[axis]) * share + in_words(seen.to_second[axis]) * beta +
                    in_words(seen.to_third[axis]) * gamma);
    }
  }
  AreaWords& operator+=(const AreaWords& other) {
    visible = visible + other.visible;
    twice_lit = twice_lit + other.twice_lit;
    weight = weight + other.weight;
    for (std::size_t axis = 0; axis < 3; ++axis) moment[axis] = moment[axis] + other.moment[axis];
    return *this;
  }
};

/// Rounds the values of triangles and groups.
class LightAreas {
 public:
  LightAreas(LightKind kind, const std::array<double, 3>& light, const AreaOptions& options)
      : kind_(kind),
        weight_(kind == LightKind::direction && options.centroid == AreaCentroid::across
                    ? Weight::across
                    : Weight::lit),
        keeps_exact_(options.exact) {
    const ExactVector3 d{light[0], light[1], light[2]};
    if (kind != LightKind::direction) return;
    square_ = dot(d, d);
    unit_ = half_ / sqrt(in_words(square_));
  }

  [[nodiscard]] LitArea of(const SeenTriangle& seen, Rounding& round) const {
    LitArea area;
    area.side = seen.side;
    const AreaWords words(seen, kind_, Weight::share);
    if (kind_ != LightKind::point) {
      const Words projected =
          kind_ == LightKind::camera ? in_words(seen.unoccluded) : in_words(seen.facing);
      area.visible = rounded(round, words.visible, [&] { return areas_of(seen).first; });
      area.projected = rounded(round, projected, [&] { return areas_of(seen).second; });
    }
    area.fraction = fraction_of(seen, words, round);
    area.lit = round(words.twice_lit * half_, [&] {
      const Ratio share = seen.share();
      const Dyadic n = dot(seen.normal, seen.normal);
      return round_sqrt_to_binary64(share * share * Ratio(n.scaled(-2)));
    });
    if (round.is_visible(seen)) {
      auto& centre = area.centroid.emplace();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        centre[axis] = round(words.moment[axis] / words.weight, [&] {
          return round_to_binary64(quotient(seen.moment(axis), seen.share()));
        });
      }
    }
    if (keeps_exact_) {
      const auto [visible, unoccluded] = areas_of(seen);
      area.exact = ExactArea{unscaled(visible), unscaled(unoccluded)};
    }
    return area;
  }

  /// The sums of a group.
  [[nodiscard]] AreaWords words_of(const std::vector<SeenTriangle>& group) const {
    AreaWords words;
    for (const SeenTriangle& seen : group) words += AreaWords(seen, kind_, weight_);
    return words;
  }

  /// The area of triangles each of which is at least partly visible.
  [[nodiscard]] LitArea of(const std::vector<SeenTriangle>& group, const AreaWords& words,
                           Rounding& round) const {
    LitArea area;
    if (kind_ != LightKind::point) {
      area.visible = rounded(round, words.visible, [&] { return real_sum(visible_terms(group)); });
    }
    area.lit = round(words.twice_lit * half_, [&] {
      return round_to_binary64(affine(lit_of(group).value(), Ratio(Dyadic(0.5)), Ratio()));
    });
    if (keeps_exact_) area.exact.emplace();
    if (keeps_exact_ && kind_ != LightKind::point) {
      area.exact->visible = unscaled(sum_of(visible_terms(group)));
    }
    if (group.empty()) return area;
    auto& centre = area.centroid.emplace();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      centre[axis] = round(words.moment[axis] / words.weight, [&] {
        return weight_ == Weight::across ? across_centre(group, axis) : lit_centre(group, axis);
      });
    }
    return area;
  }

  /// Adds the values that a group has if its areas with all other triangles removed are known.
  void add_alone(LitArea& area, const std::vector<SeenTriangle>& group, const AreaWords& words,
                 const Terms& alone, Rounding& round) const {
    const Words projected = sum_in_words(alone);
    area.projected = rounded(round, projected, [&] { return real_sum(alone); });
    if (!alone.empty()) {
      area.fraction = round(words.visible / projected, [&] {
        return group.empty() ? 0 : round_to_binary64(real_quotient(visible_terms(group), alone));
      });
    }
    if (keeps_exact_) area.exact->projected = unscaled(sum_of(alone));
  }

 private:
  /// Of a direction share·|n·d| and |n·d|, of a camera pixels, of a point shares.
  [[nodiscard]] std::pair<Ratio, Ratio> areas_of(const SeenTriangle& seen) const {
    switch (kind_) {
      case LightKind::direction:
        return {seen.share() * Ratio(seen.facing), seen.facing};
      case LightKind::camera:
        return {seen.visible(), seen.unoccluded};
      case LightKind::point:
        break;
    }
    return {seen.share(), Dyadic(seen.side == LitSide::edge ? 0.0 : 1.0)};
  }

  [[nodiscard]] std::optional<double> fraction_of(const SeenTriangle& seen, const AreaWords& words,
                                                  Rounding& round) const {
    if (seen.side == LitSide::edge) return std::nullopt;
    if (kind_ != LightKind::camera) {
      return round(words.weight, [&] { return round_to_binary64(seen.share()); });
    }
    if (seen.unoccluded.sign() == Sign::zero) return std::nullopt;
    return round(words.visible / in_words(seen.unoccluded),
                 [&] { return round_to_binary64(quotient(seen.visible(), seen.unoccluded)); });
  }

  /// An area of areas_of(), rounded once.
  template <class Exactly>
  [[nodiscard]] double rounded(Rounding& round, const Words& area, const Exactly& exactly) const {
    if (kind_ != LightKind::direction) {
      return round(area, [&] { return round_to_binary64(Real(exactly())); });
    }
    return round(area * unit_, [&] { return rounded_across(exactly(), square_); });
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
  /// Twice the area on the surface.
  static RootSum lit_of(const std::vector<SeenTriangle>& group) {
    RootSum lit;
    for (const SeenTriangle& seen : group) add(lit, seen.share(), seen);
    return lit;
  }

  static double across_centre(const std::vector<SeenTriangle>& group, std::size_t axis) {
    Terms over, under;
    for (const SeenTriangle& seen : group) {
      over.push_back(seen.moment(axis) * Ratio(seen.facing));
      under.push_back(seen.share() * Ratio(seen.facing));
    }
    return round_to_binary64(real_quotient(std::move(over), std::move(under)));
  }

  static double lit_centre(const std::vector<SeenTriangle>& group, std::size_t axis) {
    RootSum over;
    for (const SeenTriangle& seen : group) add(over, seen.moment(axis), seen);
    return round_to_binary64(quotient(over, lit_of(group)));
  }

  LightKind kind_;
  Weight weight_;
  bool keeps_exact_;
  /// Of a direction d: d·d and 1/(2|d|).
  Dyadic square_;
  Words unit_;
  Words half_{0.5, 0};
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
                                     const std::vector<std::uint32_t>& numbers, Rounding& round) {
  std::vector<SeenTriangle> seen;
  for (const std::uint32_t number : numbers) {
    if (scene.is_hidden(number)) continue;
    SeenTriangle triangle = scene.triangle(number);
    if (!round.is_visible(triangle)) continue;
    round.include(triangle);
    seen.push_back(std::move(triangle));
  }
  return seen;
}

/// area_of(0, round), …, area_of(count − 1, round), of the triangles of members_of(0), … Exact sums
/// are computed only of items of which a bound leaves a rounding open, or if `exact`.
template <class MembersOf, class AreaOf>
std::vector<LitArea> rounded_areas(SeenScene& scene, std::uint32_t count, bool exact,
                                   const MembersOf& members_of, const AreaOf& area_of) {
  std::vector<LitArea> result(count);
  std::vector<std::uint32_t> open(count);
  std::iota(open.begin(), open.end(), 0);
  for (bool has_exact_sums : {false, true}) {
    if (exact && !has_exact_sums) continue;
    if (open.empty()) break;
    if (has_exact_sums) {
      std::vector<std::uint32_t> numbers;
      for (const std::uint32_t item : open) {
        const auto& members = members_of(item);
        std::copy_if(members.begin(), members.end(), std::back_inserter(numbers),
                     [&](std::uint32_t number) { return !scene.is_hidden(number); });
      }
      scene.find_exact_sums(numbers);
    }
    std::vector<std::uint8_t> is_open(count);
    in_parallel(open.size(), [&](std::size_t k) {
      const std::uint32_t item = open[k];
      Rounding round;
      result[item] = area_of(item, round);
      is_open[item] = round.settles_all() ? 0 : 1;
    });
    std::erase_if(open, [&](std::uint32_t item) { return is_open[item] == 0; });
  }
  return result;
}

std::vector<LitArea> measure(const TriangleSource& triangles, LightKind kind,
                             const std::vector<Camera>& cameras, const std::array<double, 3>& light,
                             const AreaOptions& options) {
  const auto count = static_cast<std::uint32_t>(triangles.count());
  SeenScene scene(triangles, kind, cameras, light, options.cull);
  const LightAreas areas(kind, light, options);
  if (options.groups.empty() && count > 0) {
    return rounded_areas(
        scene, count, options.exact, [](std::uint32_t number) { return std::array{number}; },
        [&](std::uint32_t number, Rounding& round) {
          const SeenTriangle seen = scene.triangle(number);
          round.include(seen);
          return areas.of(seen, round);
        });
  }
  const auto members = members_of(options);
  const bool alone = options.alone && kind != LightKind::point;
  std::vector<Terms> areas_alone(alone ? members.size() : 0);
  in_parallel(areas_alone.size(),
              [&](std::size_t group) { areas_alone[group] = scene.alone(members[group]); });
  return rounded_areas(
      scene, options.group_count,
      options.exact, [&](std::uint32_t group) -> const auto& { return members[group]; },
      [&](std::uint32_t group, Rounding& round) {
        const std::vector<SeenTriangle> seen = seen_among(scene, members[group], round);
        const AreaWords words = areas.words_of(seen);
        LitArea area = areas.of(seen, words, round);
        if (alone) areas.add_alone(area, seen, words, areas_alone[group], round);
        return area;
      });
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
