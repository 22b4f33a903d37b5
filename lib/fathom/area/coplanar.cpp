#include "fathom/area/coplanar.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "fathom/area/scene_surfaces.h"
#include "fathom/area/separation.h"
#include "fathom/area/visible_fragments.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/threads/threads.h"

// How to read this file: coplanar_pairs() at the end. For each triangle, within its box, each
// nearby triangle is asked whether it lies close behind where the first is visible; for the pairs
// that do, the same is asked of each pixel.
namespace fathom {
using namespace area;
using namespace triangle;

namespace {

bool share_a_corner(const std::array<WorldPoint, 3>& a, const std::array<WorldPoint, 3>& b) {
  for (const WorldPoint& p : a) {
    for (const WorldPoint& q : b) {
      if (p.x == q.x && p.y == q.y && p.z == q.z) return true;
    }
  }
  return false;
}

/// A cell with the pieces of it that triangles cover.
class CellPairs {
 public:
  CellPairs(const PixelBox& box, const SceneSurfaces& surfaces,
            const std::vector<std::uint32_t>& numbers)
      : cell_(box.first_column, box.first_row, box.last_column - box.first_column + 1,
              box.last_row - box.first_row + 1),
        visibility_(cell_) {
    for (const std::uint32_t number : numbers) visibility_.add(*surfaces.surface(number));
  }

  [[nodiscard]] std::optional<std::size_t> piece_of(std::uint32_t number) const {
    for (std::size_t i = 0; i < visibility_.size(); ++i) {
      if (visibility_.surface(i).number == number) return i;
    }
    return std::nullopt;
  }
  [[nodiscard]] std::size_t size() const { return visibility_.size(); }
  [[nodiscard]] const SurfaceRegion& surface(std::size_t piece) const {
    return visibility_.surface(piece);
  }
  [[nodiscard]] const ImageCell& cell() const { return cell_; }

  /// The boundary of where t is visible and s is not in front of it; empty if that has no area, or
  /// if s certainly lies farther behind than `within`.
  Boundary visible_before(std::size_t t, std::size_t s, double within) {
    const auto both = before(t, s);
    if (!both || is_certainly_apart(*both, t, s, within)) return {};
    std::vector<ConvexPolygon> hidden;
    for (std::size_t other = 0; other < visibility_.size(); ++other) {
      if (other == t || other == s) continue;
      auto part = visibility_.hidden_part(*both, t, other);
      if (!part) continue;
      if (part->edges() == both->edges()) return {};
      hidden.push_back(std::move(*part));
    }
    return boundary_of_difference(*both, hidden, visibility_.decisions());
  }

  /// Whether the separation of both is at most `within` over an area.
  static bool is_close(const Separation& separation, const Boundary& boundary, double within) {
    if (boundary.empty()) return false;
    return separation.is_below(boundary, within) || separation.is_constantly(within);
  }

 private:
  /// D is monotone along lines: in a polygon it lies between its values at the corners.
  [[nodiscard]] bool is_certainly_apart(const ConvexPolygon& polygon, std::size_t t, std::size_t s,
                                        double within) const {
    const CellDepths front(cell_, surface(t)), behind(cell_, surface(s));
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double greatest = -infinity, least = infinity;
    for (std::size_t k = 0; k < polygon.edges().size(); ++k) {
      const HalfPlane& edge = *polygon.edges()[k];
      greatest = std::max(greatest, front.enclose_at(edge, polygon.after(k)).upper);
      least = std::min(least, behind.enclose_at(edge, polygon.after(k)).lower);
    }
    // The difference is rounded, by less than this factor.
    return (least - greatest) * (1 - 0x1p-50) > within;
  }

  /// The points that t and s cover, with t in front, or equally deep and with the lower number.
  std::optional<ConvexPolygon> before(std::size_t t, std::size_t s) {
    ConvexPolygon part = visibility_.polygon(t);
    if (!part.bounds().may_meet(visibility_.polygon(s).bounds())) return std::nullopt;
    for (const HalfPlane* edge : visibility_.polygon(s).edges()) {
      if (cell_.is_side(edge)) continue;
      if (!part.clip(*edge, visibility_.decisions())) return std::nullopt;
    }
    const ImageForm form = in_front(visibility_.surface(s), visibility_.surface(t));
    if (form.is_zero()) {
      if (visibility_.surface(t).number < visibility_.surface(s).number) return part;
      return std::nullopt;
    }
    return cell_.clip(part, -form, visibility_.decisions());
  }

  ImageCell cell_;
  CellVisibility visibility_;
};

class PairFinder {
 public:
  PairFinder(const CoverageFrame& frame, double within)
      : triangles_(frame.triangles), surfaces_(frame), within_(within) {}

  [[nodiscard]] std::uint32_t count() const { return surfaces_.count(); }

  /// The pairs in which triangle t is the visible one.
  [[nodiscard]] std::vector<CoplanarPair> pairs_of(std::uint32_t t) const {
    if (!surfaces_.surface(t)) return {};
    std::vector<std::uint32_t> numbers = surfaces_.near(t);
    numbers.insert(numbers.begin(), t);
    CellPairs pairs(surfaces_.box(t), surfaces_, numbers);
    std::vector<CoplanarPair> found;
    if (pairs.piece_of(t) != 0) return found;
    for (std::size_t s = 1; s < pairs.size(); ++s) {
      const SurfaceRegion& other = pairs.surface(s);
      if (within_ == 0 && !in_front(other, *surfaces_.surface(t)).is_zero()) continue;
      if (share_a_corner(triangles_.world_corners(t), triangles_.world_corners(other.number))) {
        continue;
      }
      const Boundary boundary = pairs.visible_before(0, s, within_);
      const Separation separation(pairs.cell(), *surfaces_.surface(t), other);
      if (!CellPairs::is_close(separation, boundary, within_)) continue;
      CoplanarPair pair{t, other.number, separation.least(boundary), 0, {}};
      count_pixels(pair, numbers);
      found.push_back(pair);
    }
    return found;
  }

 private:
  void count_pixels(CoplanarPair& pair, const std::vector<std::uint32_t>& numbers) const {
    const PixelBox& a = surfaces_.box(pair.visible);
    const PixelBox& b = surfaces_.box(pair.behind);
    const std::uint32_t first_column = std::max(a.first_column, b.first_column);
    const std::uint32_t last_column = std::min(a.last_column, b.last_column);
    for (std::uint32_t row = std::max(a.first_row, b.first_row);
         row <= std::min(a.last_row, b.last_row); ++row) {
      for (std::uint32_t column = first_column; column <= last_column; ++column) {
        if (is_close_in(pair, {column, column, row, row}, numbers)) add_pixel(pair, column, row);
      }
    }
  }

  [[nodiscard]] bool is_close_in(const CoplanarPair& pair, const PixelBox& pixel,
                                 const std::vector<std::uint32_t>& numbers) const {
    std::vector<std::uint32_t> here;
    for (const std::uint32_t number : numbers) {
      if (surfaces_.box(number).contains(pixel.first_column, pixel.first_row)) {
        here.push_back(number);
      }
    }
    CellPairs pairs(pixel, surfaces_, here);
    const auto t = pairs.piece_of(pair.visible), s = pairs.piece_of(pair.behind);
    if (!t || !s) return false;
    const Separation separation(pairs.cell(), pairs.surface(*t), pairs.surface(*s));
    return CellPairs::is_close(separation, pairs.visible_before(*t, *s, within_), within_);
  }

  static void add_pixel(CoplanarPair& pair, std::uint32_t column, std::uint32_t row) {
    PixelBox& box = pair.box;
    if (pair.pixels == 0) box = {column, column, row, row};
    ++pair.pixels;
    box.first_column = std::min(box.first_column, column);
    box.last_column = std::max(box.last_column, column);
    box.first_row = std::min(box.first_row, row);
    box.last_row = std::max(box.last_row, row);
  }

  TriangleSource triangles_;
  SceneSurfaces surfaces_;
  double within_;
};

}  // namespace

std::vector<CoplanarPair> coplanar_pairs(const TriangleSource& triangles, const Camera& camera,
                                         double within, const RenderOptions& options) {
  const StandardArithmetic standard;
  return with_threads(options.threads, [&] {
    const PairFinder finder({triangles, camera, options.cull}, within);
    std::vector<std::vector<CoplanarPair>> found(finder.count());
    constexpr std::uint32_t chunk = 64;
    const std::uint32_t chunks = finder.count() / chunk + 1;
    Progress progress(options.progress, chunks);
    parallel_for(std::uint32_t{0}, chunks, [&](std::uint32_t k) {
      const std::uint32_t end = std::min(finder.count(), (k + 1) * chunk);
      for (std::uint32_t t = k * chunk; t < end; ++t) found[t] = finder.pairs_of(t);
      progress.part_done();
    });
    std::vector<CoplanarPair> all;
    for (const auto& pairs : found) all.insert(all.end(), pairs.begin(), pairs.end());
    return all;
  });
}

}  // namespace fathom
