#include "fathom/pipeline/output/pixel_partition.h"

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

/// Leaves of `inside_` what lies on the positive side; the rest becomes a piece in which what is
/// seen in piece `seen_in` is seen as before.
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

}  // namespace fathom::pipeline
