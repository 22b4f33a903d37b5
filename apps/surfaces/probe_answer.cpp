#include "apps/surfaces/probe_answer.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include "apps/shell/standard_streams.h"
#include "fathom/camera/camera.h"
#include "fathom/lens/preimages.h"
#include "fathom/lens/without_ray.h"
#include "fathom/numeric/rounding.h"
#include "fathom/rendering/rendered.h"
#include "fathom/rendering/segment_channels.h"
#include "fathom/scene/scene_segments.h"
#include "fathom/text/printable.h"

namespace fathom::app {
namespace {

/// The ray of a pixel that a lens bends, or why the pixel has none: a part of the answer of
/// `fathom probe`.
class ProbedRay {
 public:
  /// nullopt if the camera bends no rays.
  static std::optional<ProbedRay> of(const Camera& camera, std::uint32_t column, std::uint32_t row);

  /// Lines that end in a line break.
  [[nodiscard]] std::string text() const;
  [[nodiscard]] nlohmann::ordered_json json() const;

 private:
  std::string_view lens_;
  /// Decimals of the direction, whose greatest component is 1 or −1, and the angle to the z axis in
  /// degrees; empty, with a reason, where there is no ray.
  std::array<std::string, 3> direction_;
  double degrees_ = 0;
  std::string why_none_;
  /// Q of the specification, section 2; +∞ if the lens folds nowhere.
  double disc_ = 0;
};

constexpr int digits = 25;
/// More than `digits` decimal digits.
constexpr long bits = 128;

/// The middles of the components over the greatest one.
std::array<Ratio, 3> scaled(const std::array<DyadicInterval, 3>& enclosure) {
  std::array<Dyadic, 3> middle;
  for (std::size_t k = 0; k < 3; ++k) middle[k] = (enclosure[k].low + enclosure[k].high).scaled(-1);
  const Dyadic greatest = std::max({abs(middle[0]), abs(middle[1]), abs(middle[2])});
  return {Ratio(middle[0], greatest), Ratio(middle[1], greatest), Ratio(middle[2], greatest)};
}

std::optional<ProbedRay> ProbedRay::of(const Camera& camera, std::uint32_t column,
                                       std::uint32_t row) {
  if (!bends_rays(camera.projection)) return std::nullopt;
  const lens::Preimages preimages(camera.projection, *camera.projection.lens);
  ProbedRay ray;
  ray.lens_ = name_of(camera.projection.lens->model);
  ray.disc_ = preimages.disc();
  const auto d = preimages.of_pixel(column, row);
  if (!d) {
    ray.why_none_ = lens::why_no_ray(camera.projection, column, row);
    return ray;
  }
  const std::array<Ratio, 3> direction = scaled(d->enclosure(bits));
  std::array<double, 3> rounded{};
  for (std::size_t k = 0; k < 3; ++k) {
    ray.direction_[k] = to_decimal(direction[k], digits);
    rounded[k] = round_to_binary64(direction[k]);
  }
  ray.degrees_ =
      std::atan2(std::hypot(rounded[0], rounded[1]), rounded[2]) * 180 / std::numbers::pi;
  return ray;
}

std::string ProbedRay::text() const {
  std::string lines =
      why_none_.empty()
          ? fmt::format("ray     ({}, {}, {})\n        {:.6f} degrees from the axis\n",
                        direction_[0], direction_[1], direction_[2], degrees_)
          : fmt::format("ray     none: {}\n", why_none_);
  lines += fmt::format("lens    {}", lens_);
  if (std::isfinite(disc_)) lines += fmt::format(", folds beyond x^2 + y^2 = {}", disc_);
  return lines + "\n";
}

nlohmann::ordered_json ProbedRay::json() const {
  nlohmann::ordered_json json{{"lens", lens_}};
  if (std::isfinite(disc_)) json["lens_disc"] = disc_;
  if (!why_none_.empty()) {
    json["none_because"] = why_none_;
    return json;
  }
  json["direction"] = direction_;
  json["degrees_from_axis"] = degrees_;
  return json;
}

using Json = nlohmann::ordered_json;

/// The file that a triangle comes from.
std::string file_of(const Scene& scene, const CoveringTriangle& triangle) {
  return scene.sources[scene.objects[triangle.origin.object].source].path;
}

/// Why a triangle that covers the sample does not count (specification, section 5).
std::string_view why_not_counted(const CoveringTriangle& triangle) {
  switch (triangle.standing) {
    case Standing::behind:
      return "behind the camera or in its plane (D <= 0)";
    case Standing::before_near:
      return "nearer than near";
    case Standing::beyond_far:
      return "beyond far";
    case Standing::culled:
      return triangle.front_facing ? "culled: it is front-facing" : "culled: it is back-facing";
    case Standing::counts:
      break;
  }
  return "";
}

/// The rule that decided about triangle `i` of the list.
std::string rule(const Probe& probe, std::size_t i) {
  const CoveringTriangle& triangle = probe.triangles[i];
  if (!triangle.counts) return fmt::format("does not count: {}", why_not_counted(triangle));
  if (i > 0) {
    const CoveringTriangle& visible = probe.triangles[0];
    return triangle.as_near_as_first
               ? fmt::format("hidden: exactly as deep as triangle {}, whose number is lower",
                             visible.number)
               : fmt::format("hidden: deeper than triangle {}", visible.number);
  }
  if (probe.triangles.size() == 1 || !probe.triangles[1].counts) {
    return "visible: no other triangle counts here";
  }
  return probe.triangles[1].as_near_as_first ? "visible: the lowest number among equal depths"
                                             : "visible: the least depth";
}

char sign_letter(Sign sign) {
  return sign == Sign::zero ? '0' : sign == Sign::positive ? '+' : '-';
}

std::string edge_text(const CoveringTriangle& triangle) {
  std::string text;
  for (int i = 0; i < 3; ++i) {
    text +=
        fmt::format("{}e_{} {}", i == 0 ? "" : ", ", "ABC"[i], sign_letter(triangle.edge_signs[i]));
    if (triangle.edge_signs[i] == Sign::zero) {
      text += triangle.left_or_top[i] ? " (on a left or top edge: covered)"
                                      : " (on an edge that is neither left nor top)";
    }
  }
  return text;
}

/// Which arithmetic settles the signs: "Δ by CGAL::determinant over CGAL::Interval_nt; e_A, e_B,
/// e_C by …".
std::string deciders_text(const CoveringTriangle& triangle) {
  std::string text = fmt::format("Δ by {}", triangle.facing_decided_by());
  for (const std::string_view decider : {cgal_form, dyadic_numbers}) {
    std::string edges;
    for (std::size_t i = 0; i < 3; ++i) {
      if (triangle.edge_decided_by(i) != decider) continue;
      edges += fmt::format("{}e_{}", edges.empty() ? "" : ", ", "ABC"[i]);
    }
    if (!edges.empty()) text += fmt::format("; {} by {}", edges, decider);
  }
  return text;
}

Json deciders_json(const CoveringTriangle& triangle) {
  Json json{{"facing", triangle.facing_decided_by()}};
  for (std::size_t i = 0; i < 3; ++i) {
    json[fmt::format("e_{}", "ABC"[i])] = triangle.edge_decided_by(i);
  }
  json["depth"] = dyadic_numbers;
  return json;
}

std::array<MeshPoint, 3> corners_of(const Scene& scene, const CoveringTriangle& triangle) {
  const Mesh& mesh = scene.meshes[scene.objects[triangle.origin.object].mesh];
  const CornerIndices& corners = mesh.triangles[triangle.origin.triangle];
  return {mesh.vertices[corners[0]], mesh.vertices[corners[1]], mesh.vertices[corners[2]]};
}

/// The segments of a scene, and the words for them.
class NamedSegments {
 public:
  explicit NamedSegments(const Scene& scene)
      : segments_(scene, {all_segmentations.begin(), all_segmentations.end()}) {}

  static std::string_view kind(Segmentation by) { return description_of(channel_of(by)).name; }
  /// Its name or, of a label, its number; null where the triangle has none.
  [[nodiscard]] Json value(Segmentation by, const TriangleOrigin& origin) const {
    const std::uint32_t number = segments_.number(by, origin);
    if (number == unsegmented) return nullptr;
    return by == Segmentation::label ? Json(number) : Json(segments_.names(by)[number]);
  }
  /// "steel", or "7" of a label.
  [[nodiscard]] std::string text(Segmentation by, const TriangleOrigin& origin) const {
    const std::uint32_t number = segments_.number(by, origin);
    if (by == Segmentation::label) return std::to_string(number);
    return text::printable(segments_.names(by)[number]);
  }

 private:
  SceneSegments segments_;
};

Json to_json(const Probe& probe, const NamedSegments& segments, std::size_t i) {
  const CoveringTriangle& triangle = probe.triangles[i];
  Json corners = Json::array();
  for (const MeshPoint& p : corners_of(probe.scene, triangle)) corners.push_back({p.x, p.y, p.z});
  Json edges = Json::object();
  for (int edge = 0; edge < 3; ++edge) {
    edges[fmt::format("e_{}", "ABC"[edge])] = {
        {"sign", static_cast<int>(triangle.edge_signs[edge])},
        {"left_or_top", triangle.left_or_top[edge]}};
  }
  const float stored = triangle.stored_depth;
  Json depth = Json::object();
  if (triangle.depth_is_exact) depth["exact"] = to_fraction(triangle.depth);
  depth.update(Json{{"decimal", to_decimal(triangle.depth, 40)},
                    {"binary32", stored},
                    {"binary32_hex", fmt::format("{:a}", stored)}});
  if (triangle.stored_distance) depth["distance_binary32"] = *triangle.stored_distance;
  Json answer{{"number", triangle.number},
              {"file", file_of(probe.scene, triangle)},
              {"object", triangle.origin.object},
              {"object_name", probe.scene.objects[triangle.origin.object].name},
              {"face", triangle.origin.face}};
  for (const Segmentation by : all_segmentations)
    answer[std::string(NamedSegments::kind(by))] = segments.value(by, triangle.origin);
  answer.update(Json{{"corners", corners},
                     {"front_facing", triangle.front_facing},
                     {"edges", edges},
                     {"decided_by", deciders_json(triangle)},
                     {"depth", depth},
                     {"counts", triangle.counts},
                     {"visible", i == 0 && triangle.counts},
                     {"rule", rule(probe, i)}});
  return answer;
}

/// A line for what the triangle is called, if anything.
std::string segments_text(const NamedSegments& segments, const TriangleOrigin& origin) {
  std::string text;
  for (const Segmentation by : all_segmentations) {
    if (segments.value(by, origin).is_null()) continue;
    text += fmt::format("{}{} {}", text.empty() ? "  " : ", ", NamedSegments::kind(by),
                        segments.text(by, origin));
  }
  return text.empty() ? text : text + "\n";
}

}  // namespace

std::string as_text(const Probe& probe) {
  std::string text =
      fmt::format("pixel ({}, {}) of {}x{}: the sample is ({}.5, {}.5)\n", probe.x, probe.y,
                  probe.camera.width, probe.camera.height, probe.x, probe.y);
  const std::optional<ProbedRay> ray = ProbedRay::of(probe.camera, probe.x, probe.y);
  if (ray) text += ray->text();
  text += fmt::format("{} covers it{}\n",
                      probe.triangles.empty() ? "no triangle"
                      : probe.triangles.size() == 1
                          ? "one triangle"
                          : fmt::format("each of {} triangles", probe.triangles.size()),
                      probe.triangles.size() > 1 ? ", nearest first" : "");
  const NamedSegments segments(probe.scene);
  for (std::size_t i = 0; i < probe.triangles.size(); ++i) {
    const CoveringTriangle& triangle = probe.triangles[i];
    text += fmt::format("\ntriangle {}: face {} of {}, {}-facing\n", triangle.number,
                        triangle.origin.face, text::printable(file_of(probe.scene, triangle)),
                        triangle.front_facing ? "front" : "back");
    text += segments_text(segments, triangle.origin);
    const auto corners = corners_of(probe.scene, triangle);
    for (int corner = 0; corner < 3; ++corner) {
      text += fmt::format("  {}       ({}, {}, {})\n", "ABC"[corner], corners[corner].x,
                          corners[corner].y, corners[corner].z);
    }
    const float stored = triangle.stored_depth;
    text += fmt::format("  edges   {}\n", edge_text(triangle));
    text += fmt::format("  decided {}\n", deciders_text(triangle));
    text += fmt::format("  depth   {}\n", to_decimal(triangle.depth, 40));
    if (triangle.depth_is_exact) text += fmt::format("  exactly {}\n", to_fraction(triangle.depth));
    text += fmt::format("  stored  {} = {:a} (binary32, rounded once)\n", stored, stored);
    if (const auto distance = triangle.stored_distance)
      text += fmt::format("  distance {} = {:a} (binary32, rounded once)\n", *distance, *distance);
    text += fmt::format("  {}\n", rule(probe, i));
  }
  return text;
}

std::string as_json(const Probe& probe) {
  Json triangles = Json::array();
  const NamedSegments segments(probe.scene);
  for (std::size_t i = 0; i < probe.triangles.size(); ++i)
    triangles.push_back(to_json(probe, segments, i));
  Json answer{{"pixel", {probe.x, probe.y}},
              {"sample", {probe.x + 0.5, probe.y + 0.5}},
              {"width", probe.camera.width},
              {"height", probe.camera.height}};
  if (const auto ray = ProbedRay::of(probe.camera, probe.x, probe.y)) answer["ray"] = ray->json();
  answer["triangles"] = triangles;
  return json_answer(answer);
}

}  // namespace fathom::app
