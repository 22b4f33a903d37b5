#include "apps/study/subpixel/snapped_raster.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>

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

}  // namespace fathom::studies
