#include "fathom/pipeline/scan/area_fill.h"

#include <algorithm>
#include <utility>

#include "fathom/threads/interruption.h"

namespace fathom::pipeline {
namespace {

/// An edge, and where it crosses the next scan line.
template <class Number>
struct Edge {
  std::int64_t y_begin, y_end;  ///< the scan lines that it crosses
  Crossing<Number> crossing;

  void advance() {
    crossing.x += crossing.dx_dy;
    for (std::size_t i = 0; i < crossing.attributes.size(); ++i)
      crossing.attributes[i] += crossing.dr_dy[i];
  }
};

/// The first row whose centre is not above y.
template <class Number>
std::int64_t first_row(const Number& y) {
  return ceiling_of(Number(y - Number(1) / Number(2)));
}

/// The edge from a to b, at its first scan line in the window; y_begin = y_end if it crosses none.
template <class Number>
Edge<Number> edge_between(const FillCorner<Number>& a, const FillCorner<Number>& b,
                          const PixelWindow& window) {
  const bool down = a.y < b.y;
  const FillCorner<Number>&top = down ? a : b, &bottom = down ? b : a;
  Edge<Number> edge{std::max(first_row(top.y), window.y_begin),
                    std::min(first_row(bottom.y), window.y_end),
                    {Number(0), down ? 1 : -1, {}, Number(0), {}}};
  if (edge.y_begin >= edge.y_end) return {0, 0, {}};
  const Number height = bottom.y - top.y;
  const Number below_top = centre_of<Number>(edge.y_begin) - top.y;
  Crossing<Number>& c = edge.crossing;
  c.dx_dy = (bottom.x - top.x) / height;
  c.x = top.x + below_top * c.dx_dy;
  for (std::size_t i = 0; i < top.attributes.size(); ++i) {
    c.dr_dy.push_back(Number((bottom.attributes[i] - top.attributes[i]) / height));
    c.attributes.push_back(Number(top.attributes[i] + below_top * c.dr_dy[i]));
  }
  return edge;
}

template <class Number>
std::vector<Edge<Number>> edges_of(const FillPolygon<Number>& polygon, const PixelWindow& window) {
  std::vector<Edge<Number>> edges;
  for (const auto& ring : polygon) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      Edge<Number> edge = edge_between(ring[i], ring[(i + 1) % ring.size()], window);
      if (edge.y_begin < edge.y_end) edges.push_back(std::move(edge));
    }
  }
  std::sort(edges.begin(), edges.end(),
            [](const auto& a, const auto& b) { return a.y_begin < b.y_begin; });
  return edges;
}

/// The first column whose centre is not left of x.
template <class Number>
std::int64_t first_column(const Number& x) {
  return ceiling_of(Number(x - Number(1) / Number(2)));
}

template <class Number>
FilledSpan<Number> span_between(const ScanLine<Number>& line, std::size_t l, std::size_t r,
                                const PixelWindow& window) {
  const Crossing<Number>&left = line.crossings[l], &right = line.crossings[r];
  FilledSpan<Number> span{
      clipped({line.y, first_column(left.x), first_column(right.x)}, window), l, r, {}, {}};
  if (span.pixels.x_begin >= span.pixels.x_end) return span;
  const Number width = right.x - left.x;
  const Number beyond_left = centre_of<Number>(span.pixels.x_begin) - left.x;
  for (std::size_t i = 0; i < left.attributes.size(); ++i) {
    span.dr_dx.push_back(Number((right.attributes[i] - left.attributes[i]) / width));
    span.first.push_back(Number(left.attributes[i] + beyond_left * span.dr_dx[i]));
  }
  return span;
}

template <class Number>
void find_spans(ScanLine<Number>& line, FillRule rule, const PixelWindow& window) {
  int winding = 0;
  std::size_t entered = 0;
  for (std::size_t i = 0; i < line.crossings.size(); ++i) {
    const bool was_inside = winding != 0;
    winding = rule == FillRule::even_odd ? 1 - winding : winding + line.crossings[i].winding;
    if (!was_inside && winding != 0) entered = i;
    if (was_inside && winding == 0) line.spans.push_back(span_between(line, entered, i, window));
  }
}

}  // namespace

template <class Number>
void fill_polygon(const FillPolygon<Number>& polygon, FillRule rule, const PixelWindow& window,
                  const std::function<void(const ScanLine<Number>&)>& visit) {
  std::vector<Edge<Number>> edges = edges_of(polygon, window);
  std::vector<Edge<Number>> active;
  std::size_t next = 0;
  std::int64_t y = 0;
  while (next < edges.size() || !active.empty()) {
    check_interruption();
    if (active.empty()) y = edges[next].y_begin;
    for (; next < edges.size() && edges[next].y_begin == y; ++next)
      active.push_back(std::move(edges[next]));
    std::stable_sort(active.begin(), active.end(),
                     [](const auto& a, const auto& b) { return a.crossing.x < b.crossing.x; });
    ScanLine<Number> line{y, {}, {}};
    for (const Edge<Number>& edge : active) line.crossings.push_back(edge.crossing);
    find_spans(line, rule, window);
    visit(line);
    ++y;
    std::erase_if(active, [&](const auto& edge) { return edge.y_end <= y; });
    for (Edge<Number>& edge : active) edge.advance();
  }
}

template <class Number>
std::vector<std::vector<Number>> values_along(const FilledSpan<Number>& span) {
  std::vector<std::vector<Number>> values;
  std::vector<Number> value = span.first;
  for (std::int64_t x = span.pixels.x_begin; x < span.pixels.x_end; ++x) {
    check_interruption();
    values.push_back(value);
    for (std::size_t i = 0; i < value.size(); ++i) value[i] += span.dr_dx[i];
  }
  return values;
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs no parentheses
#define FATHOM_INSTANTIATE(Number)                                                     \
  template void fill_polygon(const FillPolygon<Number>&, FillRule, const PixelWindow&, \
                             const std::function<void(const ScanLine<Number>&)>&);     \
  template std::vector<std::vector<Number>> values_along(const FilledSpan<Number>&);
FATHOM_INSTANTIATE(Exact)
FATHOM_INSTANTIATE(double)
FATHOM_INSTANTIATE(float)
#undef FATHOM_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

namespace {

class Flood {
 public:
  Flood(const CharacterGrid& grid, char colour, Connectivity connectivity)
      : grid_(grid),
        colour_(colour),
        reach_(connectivity == Connectivity::eight ? 1 : 0),
        filled_(grid.size()) {
    for (std::size_t y = 0; y < grid.size(); ++y) filled_[y].resize(grid[y].size(), false);
  }

  void run(const Pixel& seed) {
    waiting_.push_back(seed);
    while (!waiting_.empty()) {
      check_interruption();
      const Pixel p = waiting_.back();
      waiting_.pop_back();
      if (is_open(p)) fill_span(p);
    }
  }

  [[nodiscard]] std::vector<Pixel> pixels() const {
    std::vector<Pixel> result;
    for (std::int64_t y = 0; y < height(); ++y)
      for (std::int64_t x = 0; x < width(); ++x)
        if (filled_[y][x]) result.push_back({x, y});
    return result;
  }

 private:
  [[nodiscard]] std::int64_t height() const { return static_cast<std::int64_t>(grid_.size()); }
  [[nodiscard]] std::int64_t width() const {
    return static_cast<std::int64_t>(grid_.front().size());
  }
  [[nodiscard]] bool is_open(const Pixel& p) const {
    return p.x >= 0 && p.y >= 0 && p.x < width() && p.y < height() && grid_[p.y][p.x] == colour_ &&
           !filled_[p.y][p.x];
  }

  void fill_span(const Pixel& p) {
    std::int64_t left = p.x, right = p.x;
    while (is_open({left - 1, p.y})) --left;
    while (is_open({right + 1, p.y})) ++right;
    for (std::int64_t x = left; x <= right; ++x) filled_[p.y][x] = true;
    for (const std::int64_t y : {p.y - 1, p.y + 1}) {
      bool in_run = false;  // one seed for each run of open pixels is enough
      for (std::int64_t x = left - reach_; x <= right + reach_; ++x) {
        const bool open = is_open({x, y});
        if (open && !in_run) waiting_.push_back({x, y});
        in_run = open;
      }
    }
  }

  const CharacterGrid& grid_;
  char colour_;
  std::int64_t reach_;
  std::vector<std::vector<bool>> filled_;
  std::vector<Pixel> waiting_;
};

}  // namespace

std::vector<Pixel> flood_fill(const CharacterGrid& grid, const Pixel& seed,
                              Connectivity connectivity) {
  const auto height = static_cast<std::int64_t>(grid.size());
  if (seed.y < 0 || seed.y >= height) return {};
  if (seed.x < 0 || seed.x >= static_cast<std::int64_t>(grid[seed.y].size())) return {};
  Flood flood(grid, grid[seed.y][seed.x], connectivity);
  flood.run(seed);
  return flood.pixels();
}

}  // namespace fathom::pipeline
