#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "fathom/area/convex_polygon.h"

namespace fathom::area {

/// A half-plane of a line of PartLines: the line's own inside, or its outside.
struct OrientedLine {
  std::uint32_t line = 0;
  bool reversed = false;
  friend bool operator==(const OrientedLine&, const OrientedLine&) = default;
};

/// The lines of a part of the image, each once, in the coordinates of the part.
/// Exact    whether two lines are equal, and every sign. Lines that pass through the same vertex of
///          a mesh are recognised by its number, which bounds could never decide.
class PartLines {
 public:
  PartLines() = default;
  PartLines(const PartLines&) = delete;
  PartLines& operator=(const PartLines&) = delete;

  /// The line of some coefficients; `vertices` are numbers of vertices on it.
  OrientedLine add(ExactVector3 coefficients, std::span<const std::uint32_t> vertices = {});
  /// The line through two vertices, with the inside on the left of the way from the first to the
  /// second. Calls coefficients(), for a line of that direction, if the line is new.
  template <class Coefficients>
  OrientedLine through(std::uint32_t from, std::uint32_t to, const Coefficients& coefficients) {
    const bool reversed = from > to;
    const auto ends = std::minmax(from, to);
    auto known = by_ends_.find(ends);
    if (known == by_ends_.end()) {
      OrientedLine line = add(coefficients(), std::array{from, to});
      line.reversed ^= reversed;
      known = by_ends_.emplace(ends, line).first;
    }
    return {known->second.line, known->second.reversed != reversed};
  }

  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(lines_.size()); }
  /// It stays where it is.
  [[nodiscard]] const HalfPlane& operator[](std::uint32_t line) const { return *places_[line]; }

  /// The sign of turn(a, b), and of det(a, b, c), of the lines with their own insides.
  [[nodiscard]] Sign turn(std::uint32_t a, std::uint32_t b) const {
    return a < b ? -turns_[b][a] : turns_[a][b];
  }
  [[nodiscard]] Sign determinant(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  /// A known vertex through which both lines pass.
  [[nodiscard]] std::optional<std::uint32_t> common_vertex(std::uint32_t a, std::uint32_t b) const;
  /// Whether a line is known to pass through a vertex.
  [[nodiscard]] bool has(std::uint32_t line, std::uint32_t vertex) const;
  /// Whether the lines pass through one known vertex.
  [[nodiscard]] bool share_vertex(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;

  /// How signs were decided so far.
  [[nodiscard]] const TierCounts& decisions() const { return counts_; }

 private:
  std::deque<HalfPlane> lines_;
  /// Where the lines are: a deque takes longer to find them.
  std::vector<const HalfPlane*> places_;
  std::vector<std::vector<std::uint32_t>> vertices_;
  /// turns_[a][b] for b ≤ a.
  std::vector<std::vector<Sign>> turns_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, OrientedLine> by_ends_;
  mutable TierCounts counts_;
};

/// The same with the orientation of a half-plane.
inline Sign oriented(Sign sign, bool reversed) {
  return reversed ? -sign : sign;
}
inline Sign turn(const PartLines& lines, OrientedLine a, OrientedLine b) {
  return oriented(lines.turn(a.line, b.line), a.reversed != b.reversed);
}
inline Sign determinant(const PartLines& lines, OrientedLine a, OrientedLine b, OrientedLine c) {
  return oriented(lines.determinant(a.line, b.line, c.line),
                  (a.reversed != b.reversed) != c.reversed);
}

/// A bounded convex polygon as the half-planes of its edges; each turns left from the previous
/// edge. Empty if there is no area. (ConvexPolygon over PartLines, without bounds.)
using LinePolygon = std::vector<OrientedLine>;
/// The part of the polygon in a half-plane.
LinePolygon clipped(const PartLines& lines, LinePolygon polygon, OrientedLine h);

/// The places where the other lines cross a line, in the order of a walk along it with its inside
/// on the left.
class LineOrder {
 public:
  /// If a polygon `within` is given, places that lie certainly outside it have the rank of the
  /// nearer end of the line's part in it. That saves most comparisons of coinciding places.
  LineOrder(const PartLines& lines, std::uint32_t along, const LinePolygon& within = {}) {
    find(lines, along, within);
  }
  LineOrder() = default;
  /// Becomes LineOrder(lines, along, within), in the same memory.
  void find(const PartLines& lines, std::uint32_t along, const LinePolygon& within);

  /// The rank, from 0, of the place where a line that is not parallel crosses; equal places have
  /// the same rank.
  [[nodiscard]] std::uint32_t rank(std::uint32_t line) const { return ranks_[line]; }
  /// A line that crosses at the place of a rank.
  [[nodiscard]] std::uint32_t line_at(std::uint32_t rank) const { return first_of_rank_[rank]; }
  [[nodiscard]] std::uint32_t end() const {
    return static_cast<std::uint32_t>(first_of_rank_.size());
  }

 private:
  struct Place {
    double low, high;
    std::uint32_t line;
  };
  [[nodiscard]] static Place place_of(const Certified<double>& value, const Certified<double>& turn,
                                      std::uint32_t line);

  /// The greatest lower bound of the places where the line enters a half-plane of a polygon, and
  /// the least upper bound of the places where it leaves a half-plane.
  struct Ends {
    double least_low, greatest_high;
  };
  [[nodiscard]] static Ends ends_in(const PartLines& lines, std::uint32_t along,
                                    const LinePolygon& within, const std::vector<Place>& places);

  std::vector<std::uint32_t> ranks_, first_of_rank_;
  // Kept for the next line.
  std::vector<Place> places_;
  std::vector<std::uint32_t> before_, after_;
};

}  // namespace fathom::area
