#include "fathom/attribution/other_size.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <string>

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

}  // namespace fathom::attribution
