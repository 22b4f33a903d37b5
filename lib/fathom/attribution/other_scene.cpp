#include "fathom/attribution/other_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/counted.h"

namespace fathom::attribution {
namespace {

/// Rows or columns that may be missing at a border.
constexpr long most_missing = 8;

long difference(std::uint32_t a, std::uint32_t b) {
  return static_cast<long>(a) - static_cast<long>(b);
}

std::string size_of(std::uint32_t width, std::uint32_t height) {
  return fmt::format("{}x{}", width, height);
}

std::string sizes(const Camera& camera, const OtherMap& other) {
  return fmt::format("the map has {} pixels, the camera {}", size_of(other.width, other.height),
                     size_of(camera.width, camera.height));
}

template <class T>
std::vector<T> transposed(const std::vector<T>& values, std::uint32_t width) {
  std::vector<T> result(values.size());
  const std::size_t height = values.size() / width;
  for (std::size_t i = 0; i < values.size(); ++i) {
    result[i % width * height + i / width] = values[i];
  }
  return result;
}

SizedMap exchanged(const Camera& camera, const OtherMap& other) {
  OtherMap map = other;
  map.width = other.height;
  map.height = other.width;
  map.depths = transposed(other.depths, other.width);
  map.values = transposed(other.values, other.width);
  map.windows = transposed(other.windows, other.width);
  map.triangles = transposed(other.triangles, other.width);
  return {camera,
          std::move(map),
          {"axes", sizes(camera, other) + ": its rows and columns are exchanged"}};
}

/// The camera of a part of its image (or of more than it): `left` columns and `above` rows are not
/// in the map.
SizedMap cropped(const Camera& camera, const OtherMap& other, long left, long above) {
  Camera part = camera;
  part.width = other.width;
  part.height = other.height;
  part.projection.cx -= static_cast<double>(left);
  part.projection.cy -= static_cast<double>(above);
  const auto side = [](long missing, long first, const char* before, const char* after,
                       const char* what) -> std::string {
    if (missing == 0) return "";
    const char* where = first != 0 ? before : after;
    return fmt::format("{} {} {}",
                       text::counted(static_cast<std::uint64_t>(std::labs(missing)), what),
                       missing > 0 ? "missing" : "too many", where);
  };
  const std::string columns =
      side(difference(camera.width, other.width), left, "at the left", "at the right", "column");
  const std::string rows =
      side(difference(camera.height, other.height), above, "at the top", "at the bottom", "row");
  const std::string both = columns.empty() || rows.empty() ? "" : ", ";
  return {
      part, other, {"size", fmt::format("{}: {}{}{}", sizes(camera, other), columns, both, rows)}};
}

/// The whole view in an image of another size.
SizedMap drawn_in_another_size(const Camera& camera, const OtherMap& other) {
  Camera scaled = camera;
  const double x = static_cast<double>(other.width) / camera.width,
               y = static_cast<double>(other.height) / camera.height;
  scaled.width = other.width;
  scaled.height = other.height;
  scaled.projection.fx *= x;
  scaled.projection.skew *= x;
  scaled.projection.fy *= y;
  const PrincipalPoint centre = principal_point(camera.projection);
  scaled.projection.pixel_centre = 0.5;
  scaled.projection.cx = centre.x * x;
  scaled.projection.cy = centre.y * y;
  return {
      scaled, other, {"size", sizes(camera, other) + ": the whole view was drawn in that size"}};
}

}  // namespace

std::vector<SizedMap> readings_of_other_size(const Camera& camera, const OtherMap& other) {
  const StandardArithmetic standard;
  std::vector<SizedMap> readings;
  if (other.width == camera.width && other.height == camera.height) return readings;
  if (other.width == camera.height && other.height == camera.width) {
    readings.push_back(exchanged(camera, other));
  }
  const long columns = difference(camera.width, other.width);
  const long rows = difference(camera.height, other.height);
  if (std::labs(columns) <= most_missing && std::labs(rows) <= most_missing) {
    readings.push_back(cropped(camera, other, 0, 0));
    if (columns != 0) readings.push_back(cropped(camera, other, columns, 0));
    if (rows != 0) readings.push_back(cropped(camera, other, 0, rows));
    if (columns != 0 && rows != 0) readings.push_back(cropped(camera, other, columns, rows));
  }
  readings.push_back(drawn_in_another_size(camera, other));
  return readings;
}

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Numbers of pixels that show a surface in the map, in the scene, in either; with about the same
/// depth in both; and unexplained.
struct Surfaces {
  std::uint64_t in_map = 0, in_scene = 0, in_either = 0, agreeing = 0, unexplained = 0;
};

/// How near two depths have to be to count as about the same: a hundredth of the range from the
/// scene's nearest depth to its farthest. The depths of another scene that fell anywhere in that
/// range would do so at one pixel of fifty, so at nine tenths of the pixels only the same scene
/// does. A thousandth of the depth counts as well, for a wall that has no range.
class Agreement {
 public:
  explicit Agreement(const std::vector<double>& depths) {
    double least = infinity, greatest = -infinity;
    for (const double depth : depths) {
      if (!std::isfinite(depth)) continue;
      least = std::min(least, depth);
      greatest = std::max(greatest, depth);
    }
    if (least <= greatest) of_range_ = (greatest - least) / 100;
  }
  [[nodiscard]] bool holds(double truth, double other) const {
    return std::abs(other - truth) <= std::max(of_range_, std::abs(truth) / 1000);
  }

 private:
  double of_range_ = 0;
};

Surfaces surfaces_of(const Judgement& judged) {
  Surfaces s;
  const Agreement agreement(judged.truth->depths);
  for (std::size_t i = 0; i < judged.other.depths.size(); ++i) {
    const double truth = judged.truth->depths[i], other = judged.other.depths[i];
    const bool in_map = std::isfinite(other), in_scene = std::isfinite(truth);
    s.in_map += in_map;
    s.in_scene += in_scene;
    s.in_either += in_map || in_scene;
    s.agreeing += in_map && in_scene && agreement.holds(truth, other);
    s.unexplained += judged.attribution.classes[i] == PixelClass::unexplained;
  }
  return s;
}

bool has_named_fault(const Attribution& found) {
  return found.count(PixelClass::convention) > 0 ||
         std::any_of(found.findings.begin(), found.findings.end(), [](const Finding& f) {
           return f.kind == "isolated-pixels" || f.kind == "decoding";
         });
}

/// Whether the map holds values from 0 to 1, as a depth buffer does, of a scene whose depths are
/// greater.
bool looks_undecoded(const Judgement& judged) {
  bool is_within_one = true, is_scene_beyond = true;
  for (std::size_t i = 0; i < judged.other.depths.size(); ++i) {
    const double other = judged.other.depths[i];
    is_within_one = is_within_one && (std::isinf(other) || (other >= 0 && other <= 1));
    is_scene_beyond = is_scene_beyond && judged.truth->depths[i] > 1;
  }
  return is_within_one && is_scene_beyond;
}

std::string what_does_not_fit(const Judgement& judged) {
  const Surfaces s = surfaces_of(judged);
  if (s.in_either == 0 || s.unexplained == 0) return "";
  if (s.in_map == 0) {
    return "the map shows no surface at all: expected depths that are finite and above 0";
  }
  if (s.in_scene == 0) {
    return "SCENE is out of the camera's sight: expected the camera that the map was drawn with";
  }
  if (has_named_fault(judged.attribution) || s.unexplained * 10 < s.in_either * 9) return "";
  if (s.agreeing * 10 >= s.in_either * 9) return "";
  std::string text =
      "neither outlines nor depths fit: expected the SCENE and the camera that the map was drawn "
      "from, and its channel of depths";
  if (looks_undecoded(judged))
    text += "; values from 0 to 1: rows of a depth buffer from the bottom, not decoded?";
  return text;
}

}  // namespace

void name_other_scene(const Camera& camera, const OtherMap& other, Judgement& judged) {
  const StandardArithmetic standard;
  std::string text = what_does_not_fit(judged);
  if (text.empty()) return;
  // No reading of another size explains the map: the sizes remain.
  if (other.width != camera.width || other.height != camera.height)
    text = sizes(camera, other) + "; " + text;
  judged.attribution.findings = {
      {"other-scene", text, judged.attribution.count(PixelClass::unexplained)}};
}

}  // namespace fathom::attribution
