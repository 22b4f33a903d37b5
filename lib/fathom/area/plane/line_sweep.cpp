#include "fathom/area/plane/line_sweep.h"

#include <algorithm>

#include "fathom/area/visible_fragments.h"

namespace fathom::area {

LineSweep::LineSweep(const PlaneMesh& mesh, const PlanePart& part,
                     const std::vector<std::uint32_t>& triangles, std::uint32_t limit)
    : mesh_(mesh), part_(part), limit_(limit) {
  add_sides();
  pieces_.reserve(triangles.size());
  for (const std::uint32_t triangle : triangles) {
    if (!is_simple()) return;
    add_piece(triangle);
  }
  find_orders();
}

ExactVector3 LineSweep::localised(const ExactVector3& form) const {
  return {form[0], form[1], form[0] * part_.left + form[1] * part_.top + form[2]};
}

// u ≥ 0, v ≥ 0, u ≤ width, v ≤ height: each turns left from the one before.
void LineSweep::add_sides() {
  sides_ = {lines_.add({1.0, 0.0, 0.0}), lines_.add({0.0, 1.0, 0.0}),
            lines_.add({-1.0, 0.0, Dyadic(part_.right) - Dyadic(part_.left)}),
            lines_.add({0.0, -1.0, Dyadic(part_.bottom) - Dyadic(part_.top)})};
}

void LineSweep::add_piece(std::uint32_t triangle) {
  Piece piece;
  piece.triangle = triangle;
  const ProjectedScene& scene = mesh_.scene();
  if (mesh_.is_regular(triangle)) {
    piece.box = mesh_.box(triangle);
    const CornerIndices& corners = mesh_.corners(triangle);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = corners[k], to = corners[(k + 1) % 3];
      piece.region.push_back(
          lines_.through(from, to, [&] { return localised(scene.line_through(from, to)); }));
    }
  } else {
    for (const LinearForm& form : scene.kept_surface(mesh_.number(triangle)).region) {
      piece.region.push_back(lines_.add(localised(form.coefficients())));
    }
  }
  piece.polygon = sides_;
  for (const OrientedLine& h : piece.region) {
    if (!piece.polygon.empty()) piece.polygon = clipped(lines_, std::move(piece.polygon), h);
  }
  piece.depths = depth_of(mesh_, triangle);
  pieces_.push_back(std::move(piece));
}

const SurfaceRegion& LineSweep::surface(std::size_t piece) {
  Piece& its = pieces_[piece];
  if (!its.surface) its.surface = mesh_.scene().surface(mesh_.number(its.triangle));
  return *its.surface;
}

bool LineSweep::are_mates(std::uint32_t a, std::uint32_t b) const {
  for (std::size_t k = 0; k < 3; ++k) {
    if (mesh_.mate(a, k) == b) return true;
  }
  return false;
}

void LineSweep::find_orders() {
  const auto count = static_cast<std::uint32_t>(pieces_.size());
  orders_.resize(std::size_t{count} * count);
  for (std::uint32_t s = 0; s < count; ++s) {
    for (std::uint32_t t = s + 1; t < count && is_simple(); ++t) order(s, t) = order_of(s, t);
  }
  std::sort(changes_.begin(), changes_.end());
  changes_.erase(std::unique(changes_.begin(), changes_.end()), changes_.end());
}

/// Whether the pieces certainly have no point in common on the image.
bool LineSweep::are_apart(std::uint32_t a, std::uint32_t b) const {
  const std::optional<PlaneBox>&box = pieces_[a].box, &other = pieces_[b].box;
  return box && other && box->misses(*other);
}

const DepthPlane& LineSweep::depth_plane(std::uint32_t piece) {
  Piece& its = pieces_[piece];
  if (!its.depth_plane) its.depth_plane.emplace(mesh_, its.triangle, part_);
  return *its.depth_plane;
}

/// Whether the place where two lines cross is a corner of both triangles.
bool LineSweep::meet_at_corner(std::uint32_t a, std::uint32_t b, std::uint32_t e,
                               std::uint32_t f) const {
  const auto vertex = lines_.common_vertex(e, f);
  if (!vertex) return false;
  const CornerIndices &of_a = mesh_.corners(a), &of_b = mesh_.corners(b);
  return std::ranges::find(of_a, *vertex) != of_a.end() &&
         std::ranges::find(of_b, *vertex) != of_b.end();
}

/// Whether the line is that of a common edge of both triangles, along which they are equally deep:
/// the form of in_front() is affine, and zero at both ends of the edge. The triangles are regular,
/// so that their corners are different places of the image and two corners determine the line.
bool LineSweep::meet_on_line(std::uint32_t a, std::uint32_t b, std::uint32_t line) const {
  const CornerIndices &of_a = mesh_.corners(a), &of_b = mesh_.corners(b);
  return std::ranges::count_if(of_a, [&](std::uint32_t vertex) {
           return std::ranges::find(of_b, vertex) != of_b.end() && lines_.has(line, vertex);
         }) == 2;
}

/// The signs of in_front() where edges k and k + 1 of a polygon meet, as long as bounds, a common
/// corner or a common edge, where the sign is zero, settle all of them; otherwise nothing.
std::vector<Sign> LineSweep::certain_signs(std::uint32_t s, std::uint32_t t,
                                           const LinePolygon& common) {
  const std::uint32_t a = pieces_[s].triangle, b = pieces_[t].triangle;
  if (!mesh_.is_regular(a) || !mesh_.is_regular(b)) return {};
  const DepthPlane::Comparison comparison(depth_plane(s), depth_plane(t));
  std::vector<Sign> signs;
  signs.reserve(common.size());
  bool settles_order = false;
  for (std::size_t k = 0; k < common.size(); ++k) {
    const std::uint32_t e = common[k].line, f = common[(k + 1) % common.size()].line;
    signs.push_back(comparison.sign_at(approximate_crossing(lines_[e], lines_[f])));
    if (signs.back() != Sign::zero) {
      settles_order = true;
    } else if (!meet_on_line(a, b, e) && !meet_on_line(a, b, f) && !meet_at_corner(a, b, e, f)) {
      return {};
    }
  }
  if (!settles_order) signs.clear();
  return signs;
}

/// The form of in_front() in the coordinates of the part.
ExactVector3 LineSweep::in_front_here(std::uint32_t s, std::uint32_t t) {
  return localised(in_front(surface(s), surface(t)).coefficients());
}

// The form of in_front() is affine; where the pieces overlap, its signs at the corners decide.
LineSweep::Order LineSweep::order_of(std::uint32_t s, std::uint32_t t) {
  const Piece &a = pieces_[s], &b = pieces_[t];
  if (a.polygon.empty() || b.polygon.empty() || are_apart(s, t)) return {};
  if (a.depths.upper < b.depths.lower) return {Sign::positive, {}};
  if (b.depths.upper < a.depths.lower) return {Sign::negative, {}};
  if (are_mates(a.triangle, b.triangle)) return {};
  LinePolygon common = a.polygon;
  for (const OrientedLine& h : b.region) {
    common = clipped(lines_, std::move(common), h);
    if (common.empty()) return {};
  }
  std::vector<Sign> signs = certain_signs(s, t, common);
  if (signs.empty()) {
    const ExactVector3 form = in_front_here(s, t);
    if (form[0].is_zero() && form[1].is_zero()) {
      if (!form[2].is_zero()) return {form[2].sign(), {}};
      return {mesh_.number(a.triangle) < mesh_.number(b.triangle) ? Sign::positive : Sign::negative,
              {}};
    }
    const HalfPlane half(form);
    TierCounts counts;
    for (std::size_t k = 0; k < common.size(); ++k) {
      const OrientedLine &e = common[k], &f = common[(k + 1) % common.size()];
      signs.push_back(oriented(sign_of_determinant(half, lines_[e.line], lines_[f.line], counts),
                               e.reversed != f.reversed));
    }
  }
  const bool in_front = std::ranges::find(signs, Sign::positive) != signs.end();
  const bool behind = std::ranges::find(signs, Sign::negative) != signs.end();
  if (!in_front || !behind) {
    find_meetings(common, signs);
    return {in_front ? Sign::positive : Sign::negative, {}};
  }
  const OrientedLine line = lines_.add(in_front_here(s, t));
  changes_.push_back(line.line);
  return {Sign::zero, line};
}

/// signs[k] is the sign of an order's form where edges k and k + 1 meet. Where it is 0 at both ends
/// of an edge, that is on the form's line.
void LineSweep::find_meetings(const LinePolygon& common, const std::vector<Sign>& signs) {
  for (std::size_t k = 0; k < common.size(); ++k) {
    const std::size_t next = (k + 1) % common.size();
    if (signs[k] != Sign::zero || signs[next] != Sign::zero) continue;
    const auto side = std::ranges::find(sides_, common[next].line, &OrientedLine::line);
    if (side != sides_.end())
      meets_at_side_[static_cast<std::size_t>(side - sides_.begin())] = true;
  }
}

/// The walk along one line, and then along others in the same memory.
class LineSweep::Walk {
 public:
  explicit Walk(LineSweep& sweep) : sweep_(sweep), lines_(sweep.lines_) {}

  void add_spans(std::uint32_t along, std::vector<Span>& spans) {
    along_ = along;
    order_.find(lines_, along, sweep_.sides_);
    extents_.clear();
    const auto part = extent_of(0, sweep_.sides_, 0, order_.end());
    if (!part) return;
    ends_.assign({part->from, part->to});
    for (std::uint32_t k = 0; k < sweep_.pieces_.size(); ++k) {
      const Piece& piece = sweep_.pieces_[k];
      if (piece.polygon.empty()) continue;
      auto extent = extent_of(k, piece.region, part->from, part->to);
      if (!extent) continue;
      extent->left &= part->left;
      extent->right &= part->right;
      extents_.push_back(*extent);
      ends_.push_back(extent->from);
      ends_.push_back(extent->to);
    }
    for (const std::uint32_t change : sweep_.changes_) {
      if (lines_.turn(along_, change) == Sign::zero) continue;
      const std::uint32_t rank = order_.rank(change);
      if (part->from < rank && rank < part->to) ends_.push_back(rank);
    }
    std::sort(ends_.begin(), ends_.end());
    ends_.erase(std::unique(ends_.begin(), ends_.end()), ends_.end());
    add_between(ends_, spans);
  }

 private:
  /// The part of the line between two places that lies in all half-planes, if it has a length.
  [[nodiscard]] std::optional<Extent> extent_of(std::uint32_t piece,
                                                const std::vector<OrientedLine>& region,
                                                std::uint32_t from, std::uint32_t to) const {
    Extent extent{piece, from, to, true, true, none};
    for (std::uint32_t k = 0; k < region.size(); ++k) {
      const OrientedLine& h = region[k];
      if (h.line == along_) {
        // The inside of the line itself is on the left.
        (h.reversed ? extent.left : extent.right) = false;
        if (extent.edge == none) extent.edge = k;
        continue;
      }
      const Sign turn = oriented(lines_.turn(along_, h.line), h.reversed);
      if (turn == Sign::zero) {
        if (side_of_parallel(h) == Sign::negative) return std::nullopt;
      } else if (turn == Sign::negative) {
        extent.from = std::max(extent.from, order_.rank(h.line));
      } else {
        extent.to = std::min(extent.to, order_.rank(h.line));
      }
      if (extent.from >= extent.to) return std::nullopt;
    }
    if (!extent.left && !extent.right) return std::nullopt;
    return extent;
  }

  /// On which side of a parallel line this one is.
  [[nodiscard]] Sign side_of_parallel(OrientedLine h) const {
    return oriented(side_at(h.line, order_.line_at(0)), h.reversed);
  }

  /// The sign of the inside of m where `at` crosses; as side_of_crossing().
  [[nodiscard]] Sign side_at(std::uint32_t m, std::uint32_t at) const {
    return lines_.determinant(along_, at, m) * lines_.turn(along_, at);
  }

  void add_between(const std::vector<std::uint32_t>& ends, std::vector<Span>& spans) const {
    const Extent *left = nullptr, *right = nullptr;
    std::uint32_t from = ends[0];
    const auto close = [&](std::uint32_t to) {
      if (left == right) return;
      spans.push_back(
          {along_, order_.line_at(from), order_.line_at(to), side_of(left), side_of(right)});
    };
    for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
      const Extent *next_left = front(ends[k], ends[k + 1], true),
                   *next_right = front(ends[k], ends[k + 1], false);
      if (next_left == left && next_right == right) continue;
      close(ends[k]);
      left = next_left;
      right = next_right;
      from = ends[k];
    }
    close(ends.back());
  }

  static Side side_of(const Extent* extent) {
    return extent ? Side{extent->piece, extent->edge} : Side{};
  }

  /// The piece that is visible on one side of the line, between neighbouring ends.
  [[nodiscard]] const Extent* front(std::uint32_t from, std::uint32_t to, bool on_left) const {
    const Extent* nearest = nullptr;
    for (const Extent& extent : extents_) {
      if (!(on_left ? extent.left : extent.right)) continue;
      if (extent.from > from || extent.to < to) continue;
      if (!nearest || !is_in_front(nearest->piece, extent.piece, from, to, on_left)) {
        nearest = &extent;
      }
    }
    return nearest;
  }

  /// Of pieces s < t that both are there.
  [[nodiscard]] bool is_in_front(std::uint32_t s, std::uint32_t t, std::uint32_t from,
                                 std::uint32_t to, bool on_left) const {
    const Order& order = sweep_.order(s, t);
    if (!order.line) return order.sign == Sign::positive;
    // The line has no crossing between the ends. Where it is this one, its inside is on the left.
    const std::uint32_t change = order.line->line;
    Sign sign = Sign::zero;
    if (change == along_) {
      sign = on_left ? Sign::positive : Sign::negative;
    } else {
      sign = side_at(change, order_.line_at(from));
      if (sign == Sign::zero) sign = side_at(change, order_.line_at(to));
    }
    return oriented(sign, order.line->reversed) == Sign::positive;
  }

  LineSweep& sweep_;
  const PartLines& lines_;
  std::uint32_t along_ = 0;
  LineOrder order_;
  std::vector<Extent> extents_;
  std::vector<std::uint32_t> ends_;
};

/// Whether the part is not strictly on one side of a line.
bool LineSweep::meets_part(std::uint32_t line) const {
  const auto side_of_corner = [&](std::size_t k) {
    return lines_.determinant(line, sides_[k].line, sides_[(k + 1) % 4].line);
  };
  const Sign side = side_of_corner(0);
  if (side == Sign::zero) return true;
  for (std::size_t k = 1; k < 4; ++k) {
    if (side_of_corner(k) != side) return true;
  }
  return false;
}

std::vector<LineSweep::Span> LineSweep::spans() {
  std::vector<Span> spans;
  Walk walk(*this);
  for (std::uint32_t along = 0; along < lines_.size(); ++along) {
    if (meets_part(along)) walk.add_spans(along, spans);
  }
  return spans;
}

// The lines divide the piece's polygon P in the part, which is convex, into faces, and the piece is
// visible in all of a face or in nothing of it. Between a visible face and a hidden face there is a
// span of the piece, inside P: no edge of the piece and no side of the part passes there
// (Walk::extent_of() sets `edge` on every line of the piece's half-planes). So if all spans of the
// piece lie on such lines, all faces are visible or none is, and if there is such a span, all are.
std::vector<bool> LineSweep::hidden_somewhere(const std::vector<Span>& spans) const {
  std::vector<bool> has_span(pieces_.size()), is_hidden(pieces_.size());
  for (const Span& span : spans) {
    const bool on_side = std::ranges::find(sides_, span.along, &OrientedLine::line) != sides_.end();
    for (const Side& side : {span.left, span.right}) {
      if (side.piece == none) continue;
      has_span[side.piece] = true;
      if (side.edge == none && !on_side) is_hidden[side.piece] = true;
    }
  }
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    if (!has_span[k] && !pieces_[k].polygon.empty()) is_hidden[k] = true;
  }
  return is_hidden;
}

std::vector<Boundary> LineSweep::boundaries(const std::vector<Span>& spans) const {
  std::vector<Boundary> boundaries(pieces_.size());
  for (const Span& span : spans) {
    const HalfPlane &e = lines_[span.along], &from = lines_[span.from], &to = lines_[span.to];
    if (span.left.piece != none) boundaries[span.left.piece].push_back({&e, &from, &to, false});
    if (span.right.piece != none) boundaries[span.right.piece].push_back({&e, &from, &to, true});
  }
  return boundaries;
}

}  // namespace fathom::area
