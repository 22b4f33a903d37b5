#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>
#include <optional>

#include "apps/maps/info.h"
#include "apps/shell/standard_streams.h"
#include "fathom/camera/camera_files.h"
#include "fathom/lens/preimages.h"
#include "fathom/lens/without_ray.h"
#include "fathom/text/parse_json.h"
#include "fathom/text/percentage.h"
#include "fathom/text/printable.h"

namespace fathom::app {
namespace {

using Json = nlohmann::ordered_json;

/// The eye and the line of sight in the world, rounded from the exact inverse.
struct LineOfSight {
  std::array<double, 3> eye{}, forward{};
};

LineOfSight line_of_sight(const Camera& camera) {
  const Pose world_from_camera = camera_to_world(camera.world_to_camera);
  LineOfSight line;
  for (int i = 0; i < 3; ++i) {
    line.eye[i] = world_from_camera[i][3];
    line.forward[i] = world_from_camera[i][2];
  }
  return line;
}

double degrees_of(double extent, double focal) {
  return 2 * std::atan(extent / (2 * std::abs(focal))) * 180 / std::numbers::pi;
}

const DirectionTable* directions_of(const Projection& projection) {
  return projection.lens ? projection.lens->directions.get() : nullptr;
}

/// The rays of a lens along a line of its image.
class LineOfRays {
 public:
  LineOfRays(const lens::Preimages& preimages, const ImagePoint& first, const ImagePoint& last)
      : preimages_(preimages), first_(first), last_(last) {}

  /// The angle through which the ray turns along the line, in radians, as far as there are rays.
  [[nodiscard]] double angle() const {
    constexpr int parts = 64;
    double sum = 0;
    for (int i = 0; i < parts; ++i)
      sum += angle_of_part(static_cast<double>(i) / parts, (i + 1.0) / parts);
    return sum;
  }

 private:
  using Ray = std::array<double, 3>;

  [[nodiscard]] std::optional<Ray> ray_at(double place) const {
    const auto direction =
        preimages_.of({std::lerp(first_.u, last_.u, place), std::lerp(first_.v, last_.v, place)});
    if (!direction) return std::nullopt;
    Ray ray{};
    std::ranges::transform(direction->box(), ray.begin(),
                           [](const Interval& i) { return std::midpoint(i.lower, i.upper); });
    return std::ranges::all_of(ray, [](double x) { return std::isfinite(x); }) ? std::optional(ray)
                                                                               : std::nullopt;
  }

  static double angle_between(const Ray& a, const Ray& b) {
    const double sine =
        std::hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
    return std::atan2(sine, a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
  }

  /// Where the lens ends within the part, its end is found in steps.
  [[nodiscard]] double angle_of_part(double begin, double end) const {
    std::optional<Ray> first = ray_at(begin), last = ray_at(end);
    if (!first && !last) return 0;
    if (!first) {
      std::swap(begin, end);
      std::swap(first, last);
    }
    if (last) return angle_between(*first, *last);
    last = first;
    for (int step = 0; step < 40; ++step) {
      const double middle = std::midpoint(begin, end);
      const std::optional<Ray> ray = ray_at(middle);
      (ray ? begin : end) = middle;
      if (ray) last = ray;
    }
    return angle_between(*first, *last);
  }

  const lens::Preimages& preimages_;
  ImagePoint first_, last_;
};

/// The horizontal and the vertical field of view in degrees; of a lens, along the middle row and
/// column. Nullopt of parallel rays and of a table, which has no rays between its pixels.
std::optional<std::array<double, 2>> field_of_view(const Camera& camera) {
  const Projection& projection = camera.projection;
  if (!is_perspective(projection) || directions_of(projection)) return std::nullopt;
  const double width = camera.width, height = camera.height;
  if (!bends_rays(projection))
    return std::array{degrees_of(width, projection.fx), degrees_of(height, projection.fy)};
  const lens::Preimages preimages(projection, *projection.lens);
  const auto degrees_along = [&](const ImagePoint& first, const ImagePoint& last) {
    const double degrees = LineOfRays(preimages, first, last).angle() * 180 / std::numbers::pi;
    return std::round(1e6 * degrees) / 1e6;  // further digits depend on the processor
  };
  return std::array{degrees_along({0, height / 2}, {width, height / 2}),
                    degrees_along({width / 2, 0}, {width / 2, height})};
}

/// Q of the specification, section 2.
double disc_of(const Projection& projection) {
  return lens::Preimages(projection, *projection.lens).disc();
}

/// About the share of the image that sees nothing because its lens ends.
double share_without_ray(const Camera& camera) {
  const auto found = lens::find_samples_without_ray(camera.projection, camera.width, camera.height);
  return found ? found->share : 0;
}

/// The pixels of a table that have no ray. Counting them takes a look at every pixel.
struct PixelsWithoutRay {
  std::uint64_t count, all;

  explicit PixelsWithoutRay(const DirectionTable& table)
      : count(table.pixels_without_ray()), all(std::uint64_t{table.width()} * table.height()) {}
  double share() const { return static_cast<double>(count) / static_cast<double>(all); }
};

Json describe(const Camera& camera) {
  Json answer = text::parse_json<Json>(fathom::to_json(camera));
  const LineOfSight sight = line_of_sight(camera);
  answer["eye"] = sight.eye;
  answer["forward"] = sight.forward;
  if (const auto degrees = field_of_view(camera)) answer["fov_degrees"] = *degrees;
  if (const DirectionTable* const table = directions_of(camera.projection)) {
    answer["share_without_ray"] = PixelsWithoutRay(*table).share();
  } else if (camera.projection.lens) {
    answer["lens_disc"] = disc_of(camera.projection);
    answer["share_without_ray"] = share_without_ray(camera);
  }
  return answer;
}

/// The lens, the disc on which it is one to one, and how much of the image it shows.
std::string describe_lens(const Camera& camera) {
  const Lens& lens = *camera.projection.lens;
  const LensModelEntry& model = entry_of(lens.model);
  std::string lines = fmt::format("    lens          {}", model.name);
  for (std::size_t i = 0; i < model.distortion.size(); ++i)
    lines += fmt::format(", {} {}", model.distortion[i], lens.distortion[i]);
  const double disc = disc_of(camera.projection);
  if (std::isfinite(disc))
    lines += fmt::format("\n    folds         beyond x^2 + y^2 = {} on the plane z = 1", disc);
  const double share = share_without_ray(camera);
  lines += share == 0 ? "\n    has rays      everywhere"
                      : fmt::format("\n    has rays      except at about {} of the image",
                                    text::percentage(share));
  if (std::isfinite(lens.max_radius)) lines += fmt::format(", max_radius {}", lens.max_radius);
  return lines + "\n";
}

/// The file of a table, and how many of its pixels have a ray.
std::string describe_table(const Lens& lens) {
  const DirectionTable& table = *lens.directions;
  const PixelsWithoutRay without_ray(table);
  std::string lines = fmt::format(
      "    lens          {}, {}x{} directions from {}\n    sha256        {}\n"
      "    has rays      except at {} of {} pixels ({})",
      name_of(lens.model), table.width(), table.height(), text::printable(table.source().path),
      table.sha256(), without_ray.count, without_ray.all, text::percentage(without_ray.share()));
  if (std::isfinite(lens.max_radius)) lines += fmt::format(", max_radius {}", lens.max_radius);
  return lines + "\n";
}

/// What the model calls fx and fy.
std::string names_of_scales(const Projection& projection) {
  if (!projection.lens || !is_panorama(projection.lens->model)) return "fx, fy";
  const auto names = entry_of(projection.lens->model).intrinsics;
  return fmt::format("{}, {}", names[0], names[1]);
}

/// fx, fy, cx, cy and skew, and the lens.
std::string describe_projection(const Camera& camera) {
  const Projection& projection = camera.projection;
  if (directions_of(projection)) return describe_table(*projection.lens);
  std::string lines = fmt::format(
      "    {:<14}{}, {}\n    cx, cy        {}, {}   (the centre of the top left pixel is "
      "{})\n"
      "    skew          {}\n",
      names_of_scales(projection), projection.fx, projection.fy, projection.cx, projection.cy,
      projection.pixel_centre, projection.skew);
  if (projection.lens) lines += describe_lens(camera);
  return lines;
}

std::string describe_as_text(const Camera& camera) {
  const LineOfSight sight = line_of_sight(camera);
  std::string lines = fmt::format("  {} camera of {}x{} pixels\n", name_of(camera.projection.model),
                                  camera.width, camera.height);
  if (!camera.name.empty())
    lines += fmt::format("    name          {}\n", text::printable(camera.name));
  lines += describe_projection(camera);
  if (const auto degrees = field_of_view(camera)) {
    lines +=
        fmt::format("    field of view {:.4f} x {:.4f} degrees\n", (*degrees)[0], (*degrees)[1]);
  }
  const auto vector = [](const std::array<double, 3>& v) {
    return fmt::format("({}, {}, {})", v[0], v[1], v[2]);
  };
  return lines +
         fmt::format("    eye           {}\n    looks along   {}\n    near, far     {}, {}\n",
                     vector(sight.eye), vector(sight.forward), camera.near, camera.far);
}

/// Rows of texts in columns, each as wide as its longest text; a column without texts is left out.
std::string in_columns(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::string> lines(rows.size());
  for (std::size_t column = 0; column < rows.front().size(); ++column) {
    std::size_t width = 0;
    bool has_texts = false;
    for (const auto& row : rows) {
      width = std::max(width, row[column].size());
      has_texts = has_texts || (&row != &rows.front() && !row[column].empty());
    }
    if (!has_texts) continue;
    for (std::size_t i = 0; i < rows.size(); ++i)
      lines[i] += fmt::format("  {:<{}}", rows[i][column], width);
  }
  std::string text;
  for (std::string& line : lines) text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  return text;
}

/// In degrees, or "orthographic".
std::string field_of_view_text(const Camera& camera) {
  if (!is_perspective(camera.projection)) return std::string(name_of(camera.projection.model));
  const auto degrees = field_of_view(camera);
  return degrees ? fmt::format("{:.2f} x {:.2f}", (*degrees)[0], (*degrees)[1]) : "";
}

std::string lens_name(const Camera& camera) {
  return camera.projection.lens ? std::string(name_of(camera.projection.lens->model)) : "";
}

/// A line for each camera, below a line of headings.
std::string table_of(const std::vector<Camera>& cameras) {
  std::vector<std::vector<std::string>> rows{
      {"number", "name", "size", "field of view", "lens", "eye", "looks along", "near, far"}};
  const auto vector = [](const std::array<double, 3>& v) {
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", v[0], v[1], v[2]);
  };
  for (const Camera& camera : cameras) {
    const LineOfSight sight = line_of_sight(camera);
    rows.push_back({std::to_string(rows.size() - 1), text::printable(camera.name),
                    fmt::format("{}x{}", camera.width, camera.height), field_of_view_text(camera),
                    lens_name(camera), vector(sight.eye), vector(sight.forward),
                    fmt::format("{}, {}", camera.near, camera.far)});
  }
  return in_columns(rows);
}

}  // namespace

std::string info_of_cameras(const std::vector<Camera>& cameras, const std::string& file,
                            AnswerForm form) {
  if (form == AnswerForm::json) {
    Json list = Json::array();
    for (const Camera& camera : cameras) list.push_back(describe(camera));
    return json_answer({{"kind", "camera"}, {"file", file}, {"cameras", list}});
  }
  std::string text = fmt::format(
      "{}: {}\n", text::printable(file),
      cameras.size() == 1 ? "a camera" : fmt::format("a path of {} cameras", cameras.size()));
  return text + (cameras.size() == 1 ? describe_as_text(cameras.front()) : table_of(cameras));
}

}  // namespace fathom::app
