#include "fathom/pipeline/scan/diamond_exit.h"

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "fathom/threads/interruption.h"

namespace fathom::pipeline {
namespace {

/// value + first·ε + second·ε² for an infinitely small ε > 0.
template <class Number>
struct Perturbed {
  Number value, first = Number(0), second = Number(0);

  friend bool operator<(const Perturbed& a, const Perturbed& b) {
    return std::tie(a.value, a.first, a.second) < std::tie(b.value, b.first, b.second);
  }
};

template <class Number>
struct Passage {
  Pixel pixel;
  Perturbed<Number> enters, leaves;
};

/// The strip between two parallel sides of a diamond: |s − s_c| < ½, where s runs from s_a + shift
/// to s_a + shift + ds. Finds the parameters at which the segment is in it.
template <class Number>
class Strip {
 public:
  Strip(Number s_a, Number ds, Number first, Number second)
      : s_a_(s_a), ds_(ds), first_(first), second_(second) {}

  /// Narrows enters < t < leaves; false if the segment is never between them.
  bool narrow(const Number& s_c, Perturbed<Number>& enters, Perturbed<Number>& leaves) const {
    const Number half = Number(1) / Number(2);
    const Perturbed<Number> low{Number(s_c - half - s_a_), Number(-first_), Number(-second_)};
    const Perturbed<Number> high{Number(s_c + half - s_a_), Number(-first_), Number(-second_)};
    const Perturbed<Number> zero{Number(0)};
    if (ds_ == 0) return low < zero && zero < high;
    Perturbed<Number> a = over(low), b = over(high);
    if (ds_ < 0) std::swap(a, b);
    enters = std::max(enters, a);
    leaves = std::min(leaves, b);
    return true;
  }

 private:
  Perturbed<Number> over(const Perturbed<Number>& s) const {
    return {Number(s.value / ds_), Number(s.first / ds_), Number(s.second / ds_)};
  }
  Number s_a_, ds_, first_, second_;
};

template <class Number>
class Segment {
 public:
  /// x + y moves by −ε − ε², x − y by −ε + ε².
  explicit Segment(const WindowSegment<Number>& s)
      : s_(s),
        dx_(s.x1 - s.x0),
        dy_(s.y1 - s.y0),
        sums_(Number(s.x0 + s.y0), Number(dx_ + dy_), Number(-1), Number(-1)),
        differences_(Number(s.x0 - s.y0), Number(dx_ - dy_), Number(-1), Number(1)) {}

  [[nodiscard]] bool steep() const { return abs_of(dy_) > abs_of(dx_); }

  /// How it passes through the pixel's diamond, if it leaves that before its end.
  std::optional<Passage<Number>> passage(const Pixel& p) const {
    Perturbed<Number> enters{Number(0)}, leaves{Number(2)};
    if (!sums_.narrow(number_of<Number>(p.x + p.y + 1), enters, leaves)) return std::nullopt;
    if (!differences_.narrow(number_of<Number>(p.x - p.y), enters, leaves)) return std::nullopt;
    const Perturbed<Number> end{Number(1)};
    if (!(enters < leaves) || !(leaves < end)) return std::nullopt;
    return Passage<Number>{p, enters, leaves};
  }

  /// The minor coordinates that the segment can have while the major one is between a and b.
  [[nodiscard]] std::pair<std::int64_t, std::int64_t> minor_range(const Number& a,
                                                                  const Number& b) const {
    const Number major0 = steep() ? s_.y0 : s_.x0, minor0 = steep() ? s_.x0 : s_.y0;
    const Number m = steep() ? Number(dx_ / dy_) : dx_ == 0 ? Number(0) : Number(dy_ / dx_);
    const Number at_a = minor0 + m * (a - major0), at_b = minor0 + m * (b - major0);
    return {floor_of(std::min(at_a, at_b)) - 1, floor_of(std::max(at_a, at_b)) + 1};
  }

 private:
  static Number abs_of(const Number& x) { return x < 0 ? Number(-x) : x; }

  WindowSegment<Number> s_;
  Number dx_, dy_;
  Strip<Number> sums_, differences_;
};

}  // namespace

template <class Number>
void diamond_exit_passages(const WindowSegment<Number>& ends, const PixelWindow& window,
                           const std::function<void(const DiamondPassage<Number>&)>& visit) {
  const Segment<Number> segment(ends);
  const bool steep = segment.steep();
  const Number from = steep ? ends.y0 : ends.x0, to = steep ? ends.y1 : ends.x1;
  const bool backwards = to < from;
  const std::int64_t first =
      std::max(floor_of(std::min(from, to)) - 1, steep ? window.y_begin : window.x_begin);
  const std::int64_t last =
      std::min(floor_of(std::max(from, to)) + 1, (steep ? window.y_end : window.x_end) - 1);
  for (std::int64_t k = 0; k <= last - first; ++k) {
    check_interruption();
    const std::int64_t major = backwards ? last - k : first + k;
    // The diamonds of a column are inside it: their order along the segment is the order of the
    // columns.
    std::vector<Passage<Number>> column;
    const auto [low, high] =
        segment.minor_range(number_of<Number>(major), number_of<Number>(major + 1));
    for (std::int64_t minor = low; minor <= high; ++minor) {
      const Pixel pixel = steep ? Pixel{minor, major} : Pixel{major, minor};
      if (!window.contains(pixel)) continue;
      if (auto passage = segment.passage(pixel)) column.push_back(std::move(*passage));
    }
    std::sort(column.begin(), column.end(),
              [](const auto& a, const auto& b) { return a.enters < b.enters; });
    for (const auto& [pixel, enters, leaves] : column) visit({pixel, enters.value, leaves.value});
  }
}

template <class Number>
void diamond_exit_line(const WindowSegment<Number>& ends, const PixelWindow& window,
                       const std::function<void(const Pixel&)>& visit) {
  diamond_exit_passages<Number>(
      ends, window, [&](const DiamondPassage<Number>& passage) { visit(passage.pixel); });
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs no parentheses
#define FATHOM_INSTANTIATE(Number)                                                      \
  template void diamond_exit_line(const WindowSegment<Number>&, const PixelWindow&,     \
                                  const std::function<void(const Pixel&)>&);            \
  template void diamond_exit_passages(const WindowSegment<Number>&, const PixelWindow&, \
                                      const std::function<void(const DiamondPassage<Number>&)>&);
FATHOM_INSTANTIATE(Exact)
FATHOM_INSTANTIATE(double)
FATHOM_INSTANTIATE(float)
#undef FATHOM_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fathom::pipeline
