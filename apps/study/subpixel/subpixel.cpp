#include "apps/study/subpixel/subpixel.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>

#include "apps/study/page.h"
#include "apps/study/results.h"
#include "apps/study/study.h"
#include "apps/study/study_scene.h"
#include "fathom/failures/errors.h"
#include "fathom/image/depth_map.h"
#include "fathom/numeric/rounding.h"
#include "fathom/scene/triangle_source.h"
#include "fathom/triangle/projected_triangle.h"

namespace fathom::studies {
namespace {

/// Pixels beside the image that corners may lie: with 16 bits all products fit 64 bits.
constexpr double margin = 4096;

/// On the subpixel grid, doubled so that pixel centres lie on it with 0 bits too.
struct GridPoint {
  std::int64_t x, y;
};

struct Corner {
  GridPoint place;
  double quantity;  ///< 1/D, or D
};

/// The multiple of 2^−bits nearest to x, times 2^(bits + 1).
std::optional<std::int64_t> snapped(const Ratio& x, int bits) {
  const Ratio shifted = x + Ratio(Dyadic(2 * margin));  // not negative
  const auto steps = round_to_integer({shifted.numerator.scaled(bits), shifted.denominator},
                                      std::uint64_t{1} << 40);
  if (!steps) return std::nullopt;
  return 2 * (static_cast<std::int64_t>(*steps) - (static_cast<std::int64_t>(2 * margin) << bits));
}

std::optional<Corner> corner_of(const Camera& camera, const CameraPoint& p, int bits) {
  const HomogeneousImagePoint image = to_image(camera.projection, p);
  if (image.W.sign() != Sign::positive || p.z.sign() != Sign::positive) return std::nullopt;
  const auto x = snapped({image.U, image.W}, bits), y = snapped({image.V, image.W}, bits);
  const auto limit = static_cast<std::int64_t>(2 * margin) << (bits + 1);
  if (!x || !y || std::abs(*x) > limit || std::abs(*y) > limit) return std::nullopt;
  const bool perspective = is_perspective(camera.projection);
  return Corner{{*x, *y},
                perspective ? round_to_binary64({Dyadic(1.0), p.z}) : round_to_binary64(p.z)};
}

std::int64_t edge(const GridPoint& a, const GridPoint& b, const GridPoint& s) {
  return (b.x - a.x) * (s.y - a.y) - (b.y - a.y) * (s.x - a.x);
}

/// With the inside on the positive side of every edge, y down: a left edge goes up, a top edge goes
/// to the right.
bool is_left_or_top(const GridPoint& a, const GridPoint& b) {
  return b.y < a.y || (b.y == a.y && b.x > a.x);
}

class Canvas {
 public:
  Canvas(const SceneView& view, int bits, SnappedMap& map)
      : camera_(view.camera), bits_(bits), map_(map) {}

  void draw(std::array<Corner, 3> c, std::uint32_t number) {
    std::int64_t area = edge(c[0].place, c[1].place, c[2].place);
    if (area == 0) return;
    if (area < 0) {
      std::swap(c[1], c[2]);
      area = -area;
    }
    const auto [first_x, last_x] = range(c[0].place.x, c[1].place.x, c[2].place.x, camera_.width);
    const auto [first_y, last_y] = range(c[0].place.y, c[1].place.y, c[2].place.y, camera_.height);
    for (std::int64_t y = first_y; y <= last_y; ++y) {
      for (std::int64_t x = first_x; x <= last_x; ++x) {
        test(c, area, x, y, number);
      }
    }
  }

 private:
  /// Pixels whose centres may lie between three coordinates.
  [[nodiscard]] std::pair<std::int64_t, std::int64_t> range(std::int64_t a, std::int64_t b,
                                                            std::int64_t c,
                                                            std::int64_t size) const {
    const std::int64_t low = std::min({a, b, c}) >> (bits_ + 1);
    const std::int64_t high = std::max({a, b, c}) >> (bits_ + 1);
    return {std::max<std::int64_t>(low, 0), std::min(high, size - 1)};
  }

  void test(const std::array<Corner, 3>& c, std::int64_t area, std::int64_t x, std::int64_t y,
            std::uint32_t number) {
    const std::int64_t half = std::int64_t{1} << bits_;
    const GridPoint s{(2 * x + 1) * half, (2 * y + 1) * half};
    std::array<std::int64_t, 3> e{};
    for (std::size_t i = 0; i < 3; ++i) {
      const GridPoint &a = c[(i + 1) % 3].place, &b = c[(i + 2) % 3].place;
      e[i] = edge(a, b, s);
      if (e[i] < 0 || (e[i] == 0 && !is_left_or_top(a, b))) return;
    }
    // From one corner, so that a triangle of one depth has exactly that.
    double quantity = c[0].quantity;
    for (std::size_t i = 1; i < 3; ++i) {
      quantity +=
          static_cast<double>(e[i]) / static_cast<double>(area) * (c[i].quantity - c[0].quantity);
    }
    const double depth = is_perspective(camera_.projection) ? 1 / quantity : quantity;
    if (!(depth >= camera_.near && depth <= camera_.far)) return;
    const auto pixel = static_cast<std::size_t>(y) * camera_.width + static_cast<std::size_t>(x);
    if (depth < map_.depth[pixel]) {
      map_.depth[pixel] = depth;
      map_.id[pixel] = number;
    }
  }

  const Camera& camera_;
  int bits_;
  SnappedMap& map_;
};

}  // namespace

SnappedMap draw_snapped(const SceneView& view, int bits) {
  const std::size_t pixels = static_cast<std::size_t>(view.camera.width) * view.camera.height;
  SnappedMap map{std::vector<std::uint32_t>(pixels, no_surface),
                 std::vector<double>(pixels, std::numeric_limits<double>::infinity()), 0};
  Canvas canvas(view, bits, map);
  const TriangleSource triangles(view.scene);
  for (std::uint32_t number = 0; number < triangles.count(); ++number) {
    std::array<std::optional<Corner>, 3> corners;
    const auto world = triangles.world_corners(number);
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = corner_of(view.camera, to_camera(view.camera.world_to_camera, world[i]), bits);
    }
    if (corners[0] && corners[1] && corners[2]) {
      canvas.draw({*corners[0], *corners[1], *corners[2]}, number);
    } else {
      ++map.left_out;
    }
  }
  return map;
}

namespace {

constexpr int most_bits = 16;

/// A map with corners on the grid against the exact one.
struct Row {
  int bits;
  std::uint64_t pixels = 0;  ///< with a surface in either map
  std::uint64_t lost = 0, gained = 0, other_triangle = 0;
  /// |D − exact|/exact, where both maps show the same triangle.
  double greatest_error = 0, mean_error = 0;
  std::uint64_t left_out = 0;

  [[nodiscard]] std::uint64_t covered_otherwise() const { return lost + gained; }
};

Row compare(const SnappedMap& snapped, const DepthMap& exact, int bits) {
  Row row{.bits = bits, .left_out = snapped.left_out};
  const auto& id = *exact.values<std::uint32_t>("id");
  const auto& Z = *exact.values<double>("Z");
  std::uint64_t same = 0;
  for (std::size_t i = 0; i < id.size(); ++i) {
    const bool here = snapped.id[i] != no_surface, there = id[i] != no_surface;
    if (!here && !there) continue;
    ++row.pixels;
    row.lost += !here ? 1 : 0;
    row.gained += !there ? 1 : 0;
    if (!here || !there) continue;
    if (snapped.id[i] != id[i]) {
      ++row.other_triangle;
      continue;
    }
    const double error = std::abs(snapped.depth[i] - Z[i]) / Z[i];
    row.greatest_error = std::max(row.greatest_error, error);
    row.mean_error += error;
    ++same;
  }
  if (same > 0) row.mean_error /= static_cast<double>(same);
  return row;
}

std::vector<Row> compare_all(const SceneView& view, const std::function<void(double)>& tick) {
  RenderOptions options{.channels = {Channel::Z, Channel::id}};
  options.depth_encoding.type = DepthEncoding::Type::binary64;
  const DepthMap exact = render(view.scene, view.camera, options).map;
  std::vector<Row> rows;
  for (int bits = 0; bits <= most_bits; ++bits) {
    rows.push_back(compare(draw_snapped(view, bits), exact, bits));
    tick(0.9 * (bits + 1) / (most_bits + 1));
  }
  return rows;
}

Table table_of(const std::vector<Row>& rows) {
  return {rows,
          {{Column("bits").page("bits"), &Row::bits},
           {"pixels", &Row::pixels},
           {Column("lost").page("lost"), &Row::lost},
           {Column("gained").page("gained"), &Row::gained},
           {Column("other_triangle").page("another triangle"), &Row::other_triangle},
           {Column("greatest_relative_depth_error", ".6g").page("greatest depth error", ".3g"),
            &Row::greatest_error},
           {Column("mean_relative_depth_error", ".6g").page("mean", ".3g"), &Row::mean_error},
           {"triangles_left_out", &Row::left_out}}};
}

Plot coverage_plot(const std::vector<Row>& rows) {
  return {.name = "coverage",
          .title = "Pixels that differ from the exact map, by subpixel bits",
          .x_label = "subpixel bits",
          .y_label = "pixels",
          .logarithmic_y = true,
          .series = {series_of("covered or not", rows, &Row::bits, &Row::covered_otherwise),
                     series_of("another triangle", rows, &Row::bits, &Row::other_triangle)}};
}

Plot depth_plot(const std::vector<Row>& rows) {
  return {.name = "depth",
          .title = "Error of depth where the same triangle shows, by subpixel bits",
          .x_label = "subpixel bits",
          .y_label = "relative error of the depth",
          .logarithmic_y = true,
          .series = {series_of("greatest", rows, &Row::bits, &Row::greatest_error),
                     series_of("mean", rows, &Row::bits, &Row::mean_error)}};
}

}  // namespace

std::vector<StudyFile> study_subpixel(const StudyOptions& options,
                                      const std::function<void(double)>& tick) {
  if (options.separation || options.samples) {
    throw UsageError("the study subpixel has no --separation and no --samples");
  }
  const SceneView view = scene_or_wheel(options);
  require_gnuplot(options);
  const std::vector<Row> rows = compare_all(view, tick);

  Results results("subpixel", page_texts::subpixel, options);
  results.figure("scene", view.name);
  results.table(table_of(rows), {.csv = "subpixel", .json = "bits", .page = "rows"});
  for (const Row& row : rows)
    results.quote("changed " + std::to_string(row.bits),
                  row.covered_otherwise() + row.other_triangle);
  results.plot(coverage_plot(rows));
  results.plot(depth_plot(rows));
  if (rows[0].left_out > 0) results.quote("left_out", rows[0].left_out);
  tick(1);
  return results.files();
}

}  // namespace fathom::studies
