#include "fathom/pipeline/output/area_sampling.h"

#include <algorithm>

#include "fathom/threads/interruption.h"

namespace fathom::pipeline {
namespace {

/// The area and, times three times the area, the centroid.
struct Moments {
  double area = 0, x = 0, y = 0;
};

Moments moments_of(const std::vector<PixelPoint>& polygon) {
  Moments m;
  const PixelPoint& o = polygon[0];
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const PixelPoint &p = polygon[i - 1], &q = polygon[i];
    const double area = ((p.x - o.x) * (q.y - o.y) - (p.y - o.y) * (q.x - o.x)) / 2;
    m.area += area;
    m.x += area * (o.x + p.x + q.x);
    m.y += area * (o.y + p.y + q.y);
  }
  return m;
}

PixelPoint crossing(const PixelPoint& p, const PixelPoint& q, double at_p, double at_q) {
  const double t = at_p / (at_p - at_q);
  return {p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)};
}

}  // namespace

void PixelPartition::clear() {
  count_ = 0;
  Piece& all = spare_piece(count_);
  all.number = nothing;
  all.polygon = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
}

PixelPartition::Piece& PixelPartition::spare_piece(std::size_t& count) {
  if (count == pieces_.size()) pieces_.emplace_back();
  return pieces_[count++];
}

/// Reduces `inside_` to its part on the positive side; the rest becomes a piece that still shows
/// the surface of piece `seen_in`.
void PixelPartition::cut(const PixelForm& line, std::size_t seen_in, std::size_t& spare) {
  const Polygon& polygon = inside_.polygon;
  values_.clear();
  for (const PixelPoint& p : polygon) values_.push_back(line.at(p));
  const auto [least, greatest] = std::minmax_element(values_.begin(), values_.end());
  if (*least >= 0 && *greatest > 0) return;
  if (*greatest <= 0) {
    inside_.polygon.clear();
    return;
  }
  Piece& outside = spare_piece(spare);
  outside.number = pieces_[seen_in].number;
  outside.nearness = pieces_[seen_in].nearness;
  outside.polygon.clear();
  kept_.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::size_t j = i + 1 == polygon.size() ? 0 : i + 1;
    const double here = values_[i], next = values_[j];
    if (here >= 0) kept_.push_back(polygon[i]);
    if (here <= 0) outside.polygon.push_back(polygon[i]);
    if ((here < 0 && next > 0) || (here > 0 && next < 0)) {
      const PixelPoint p = crossing(polygon[i], polygon[j], here, next);
      kept_.push_back(p);
      outside.polygon.push_back(p);
    }
  }
  inside_.polygon.swap(kept_);
}

void PixelPartition::add(const PixelSurface& surface, bool always) {
  check_interruption();
  const std::size_t before = count_;
  for (std::size_t i = 0; i < before; ++i) {
    inside_.polygon = pieces_[i].polygon;
    std::size_t spare = count_;
    for (const PixelForm& edge : surface.edges) {
      cut(edge, i, spare);
      if (inside_.polygon.empty()) break;
    }
    if (inside_.polygon.empty()) continue;
    if (pieces_[i].number != nothing && !always) {
      const PixelForm nearer = surface.nearness - pieces_[i].nearness;
      const bool same = std::all_of(inside_.polygon.begin(), inside_.polygon.end(),
                                    [&](const PixelPoint& p) { return nearer.at(p) == 0; });
      if (same && surface.number > pieces_[i].number) continue;
      if (!same) cut(nearer, i, spare);
      if (inside_.polygon.empty()) continue;
    }
    // Only now is it known that anything changes.
    count_ = spare;
    Piece& piece = pieces_[i];
    piece.number = surface.number;
    piece.nearness = surface.nearness;
    piece.polygon.swap(inside_.polygon);
  }
}

const std::vector<SeenPart>& PixelPartition::seen() {
  seen_.clear();
  for (std::size_t i = 0; i < count_; ++i) {
    const Piece& piece = pieces_[i];
    const Moments m = moments_of(piece.polygon);
    auto part = std::find_if(seen_.begin(), seen_.end(),
                             [&](const SeenPart& s) { return s.number == piece.number; });
    if (part == seen_.end()) part = seen_.insert(part, {piece.number, 0, {}});
    part->area += m.area;
    part->centroid.x += m.x / 3;
    part->centroid.y += m.y / 3;
  }
  std::erase_if(seen_, [](const SeenPart& s) { return !(s.area > 0); });
  for (SeenPart& part : seen_) {
    // Of a part that is all rounding, the quotient can be anything.
    part.centroid = {std::clamp(part.centroid.x / part.area, 0.0, 1.0),
                     std::clamp(part.centroid.y / part.area, 0.0, 1.0)};
  }
  std::sort(seen_.begin(), seen_.end(),
            [](const SeenPart& a, const SeenPart& b) { return a.number < b.number; });
  return seen_;
}

namespace {

/// A triangle on the grid, and how near its corners are: greater is nearer, affine in the window.
template <class Real>
struct AreaTriangle {
  Interpolator<Real> interpolator;
  std::array<double, 3> nearness;
  std::array<double, 3> dx, dy;  ///< the change of the edge functions per pixel

  [[nodiscard]] PixelSurface in_pixel(std::uint32_t number, const Pixel& pixel) const {
    const GridTriangle& grid = interpolator.grid();
    const auto corner = grid.edges_at({pixel.x * grid_one, pixel.y * grid_one});
    const auto area = static_cast<double>(grid.twice_area());
    PixelSurface surface{number, {}, {}};
    for (std::size_t k = 0; k < 3; ++k) {
      // Neighbours have the same edge with the other sign, so they are cut along the same line.
      const PixelForm edge{dx[k], dy[k], static_cast<double>(corner[k])};
      surface.edges[k] = edge;
      surface.nearness.a += nearness[k] * (edge.a / area);
      surface.nearness.b += nearness[k] * (edge.b / area);
      surface.nearness.c += nearness[k] * (edge.c / area);
    }
    return surface;
  }
};

template <class Real>
class AreaSampler {
 public:
  AreaSampler(const std::vector<WindowTriangle<Real>>& triangles, const Camera& camera,
              const PipelineOptions& options, const PixelWindow& window, Shader<Real>& shader,
              PipelineStatistics& statistics)
      : camera_(camera),
        options_(options),
        window_(window),
        shader_(shader),
        count_(statistics),
        in_column_(static_cast<std::size_t>(
            std::max<std::int64_t>(0, window.is_empty() ? 0 : window.x_end - window.x_begin))) {
    for (const auto& t : triangles) {
      check_interruption();
      if (const auto i = Interpolator<Real>::of(t, options)) triangles_.push_back(prepared(*i));
    }
  }

  /// Draws row by row, so that only one row's triangles are remembered by pixel.
  void draw(ColourImage& image) {
    const auto starting = by_first_row();
    std::vector<std::uint32_t> active;
    for (std::int64_t y = window_.y_begin; y < window_.y_end; ++y) {
      const auto& more = starting[static_cast<std::size_t>(y - window_.y_begin)];
      active.insert(active.end(), more.begin(), more.end());
      std::erase_if(active, [&](std::uint32_t i) { return box_of(i).y_end <= y; });
      for (const std::uint32_t i : active) note(i, y);
      for (std::int64_t x = window_.x_begin; x < window_.x_end; ++x) {
        auto& touching = in_column_[static_cast<std::size_t>(x - window_.x_begin)];
        if (touching.empty()) continue;
        image.pixels[static_cast<std::size_t>(y) * image.width + static_cast<std::size_t>(x)] =
            colour_of({x, y}, touching);
        touching.clear();
      }
    }
  }

 private:
  [[nodiscard]] AreaTriangle<Real> prepared(const Interpolator<Real>& interpolator) const {
    AreaTriangle<Real> t{interpolator, {}, {}, {}};
    const bool nearer_is_greater = DepthTest(options_).is_nearer({1}, {0});
    for (std::size_t k = 0; k < 3; ++k) {
      const double depth = affine_depth(interpolator.triangle(), k);
      t.nearness[k] = nearer_is_greater ? depth : -depth;
    }
    const auto here = interpolator.grid().edges_at({0, 0});
    const auto right = interpolator.grid().edges_at({grid_one, 0});
    const auto below = interpolator.grid().edges_at({0, grid_one});
    for (std::size_t k = 0; k < 3; ++k) {
      t.dx[k] = static_cast<double>(right[k] - here[k]);
      t.dy[k] = static_cast<double>(below[k] - here[k]);
    }
    return t;
  }

  /// At a corner. The stored depth is a growing function of it, and it is affine in the window.
  [[nodiscard]] double affine_depth(const WindowTriangle<Real>& t, std::size_t k) const {
    const WindowVertex<Real>& corner = t.corners[k];
    if (!is_per_fragment(options_.depth_format.mapping))
      return static_cast<double>(corner.z) + static_cast<double>(t.depth_offset);
    if (is_perspective(camera_.projection)) return -static_cast<double>(corner.inverse_w);
    return static_cast<double>(corner.attributes[attribute::depth]);
  }

  [[nodiscard]] PixelWindow box_of(std::uint32_t i) const {
    return triangles_[i].interpolator.grid().bounding_box();
  }

  /// For each row of the window the triangles whose first row it is.
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> by_first_row() const {
    std::vector<std::vector<std::uint32_t>> rows(
        static_cast<std::size_t>(std::max<std::int64_t>(0, window_.y_end - window_.y_begin)));
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
      const PixelWindow box = box_of(i);
      const std::int64_t first = std::max(box.y_begin, window_.y_begin);
      if (first < std::min(box.y_end, window_.y_end))
        rows[static_cast<std::size_t>(first - window_.y_begin)].push_back(i);
    }
    return rows;
  }

  /// Notes a triangle in each pixel of a row that it can touch.
  void note(std::uint32_t i, std::int64_t y) {
    check_interruption();
    const PixelWindow box = box_of(i);
    const GridTriangle& grid = triangles_[i].interpolator.grid();
    for (auto x = std::max(box.x_begin, window_.x_begin); x < std::min(box.x_end, window_.x_end);
         ++x) {
      if (grid.test_block({x, y}, 1) != GridTriangle::BlockCoverage::none)
        in_column_[static_cast<std::size_t>(x - window_.x_begin)].push_back(i);
    }
  }

  Colour colour_of(const Pixel& pixel, std::vector<std::uint32_t>& touching) {
    const bool painter = options_.hidden_surface == HiddenSurface::painter;
    std::sort(touching.begin(), touching.end());
    surfaces_.clear();
    for (const std::uint32_t i : touching) surfaces_.push_back(triangles_[i].in_pixel(i, pixel));
    // Near triangles first: then farther triangles usually change nothing.
    if (!painter) {
      std::stable_sort(surfaces_.begin(), surfaces_.end(), [](const auto& a, const auto& b) {
        return a.nearness.at({0.5, 0.5}) > b.nearness.at({0.5, 0.5});
      });
    }
    partition_.clear();
    for (const PixelSurface& surface : surfaces_) partition_.add(surface, painter);
    count_.fragments += surfaces_.size();
    Colour sum{};
    for (const SeenPart& part : partition_.seen()) {
      const Colour colour = part.number == PixelPartition::nothing
                                ? options_.background
                                : shade(triangles_[part.number].interpolator,
                                        {pixel.x * grid_one + on_grid(part.centroid.x),
                                         pixel.y * grid_one + on_grid(part.centroid.y)});
      for (std::size_t k = 0; k < 3; ++k) sum[k] += part.area * colour[k];
    }
    return sum;
  }

  static std::int64_t on_grid(double part) {
    return static_cast<std::int64_t>(part * static_cast<double>(grid_one));
  }

  Colour shade(const Interpolator<Real>& t, const GridPoint& place) {
    ++count_.shaded;
    shader_.begin(t.triangle());
    Fragment fragment;
    t.complete(fragment, place);
    return shader_.shade(fragment, t.attribute_weights(place));
  }

  const Camera& camera_;
  const PipelineOptions& options_;
  PixelWindow window_;
  Shader<Real>& shader_;
  PipelineStatistics& count_;
  std::vector<AreaTriangle<Real>> triangles_;
  std::vector<std::vector<std::uint32_t>> in_column_;
  std::vector<PixelSurface> surfaces_;
  PixelPartition partition_;
};

}  // namespace

template <class Real>
ColourImage area_sampled(const std::vector<WindowTriangle<Real>>& triangles, const Camera& camera,
                         const PipelineOptions& options, const PixelWindow& window,
                         Shader<Real>& shader, PipelineStatistics& statistics) {
  ColourImage image{
      camera.width, camera.height,
      std::vector<Colour>(std::size_t{camera.width} * camera.height, options.background)};
  AreaSampler<Real> sampler(triangles, camera, options, window, shader, statistics);
  sampler.draw(image);
  return image;
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs no parentheses
#define FATHOM_INSTANTIATE(Real)                                                               \
  template ColourImage area_sampled(const std::vector<WindowTriangle<Real>>&, const Camera&,   \
                                    const PipelineOptions&, const PixelWindow&, Shader<Real>&, \
                                    PipelineStatistics&);
FATHOM_INSTANTIATE(float)
FATHOM_INSTANTIATE(double)
#undef FATHOM_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fathom::pipeline
