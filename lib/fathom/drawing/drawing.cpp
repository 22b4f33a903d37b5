#include "fathom/drawing/drawing.h"

#include <algorithm>
#include <map>
#include <utility>

#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {
namespace {

struct DrawnLine {
  DrawnPoint from, to;
};

DrawnPoint rounded(const ImagePlace& place) {
  return {round_to_binary32(place.u), round_to_binary32(place.v)};
}

/// The visible edges of an object.
class ObjectLines {
 public:
  /// Edges of one name come one after another; edges that touch become one line. Edges that round
  /// to a point are left out.
  void add(const VisibleEdge& edge) {
    const DrawnLine line{rounded(edge.from), rounded(edge.to)};
    if (line.from == line.to) return;
    if (!lines_.empty() && last_ == edge.name && lines_.back().to == line.from) {
      lines_.back().to = line.to;
    } else {
      lines_.push_back(line);
    }
    last_ = edge.name;
  }

  /// Paths along the lines: each goes on where a line begins or ends at the end of the last one.
  [[nodiscard]] std::vector<DrawnPath> paths() const {
    std::multimap<DrawnPoint, std::size_t> at_point;
    for (std::size_t k = 0; k < lines_.size(); ++k) {
      at_point.emplace(lines_[k].from, k);
      at_point.emplace(lines_[k].to, k);
    }
    std::vector<bool> is_drawn(lines_.size());
    std::vector<DrawnPath> paths;
    for (std::size_t first = 0; first < lines_.size(); ++first) {
      if (is_drawn[first]) continue;
      is_drawn[first] = true;
      DrawnPath path{lines_[first].from, lines_[first].to};
      extend(path, at_point, is_drawn);
      std::reverse(path.begin(), path.end());
      extend(path, at_point, is_drawn);
      paths.push_back(std::move(path));
    }
    return paths;
  }

 private:
  void extend(DrawnPath& path, std::multimap<DrawnPoint, std::size_t>& at_point,
              std::vector<bool>& is_drawn) const {
    while (true) {
      const DrawnPoint end = path.back();
      auto [next, last] = at_point.equal_range(end);
      while (next != last && is_drawn[next->second]) next = at_point.erase(next);
      if (next == last) return;
      const DrawnLine& line = lines_[next->second];
      is_drawn[next->second] = true;
      path.push_back(line.from == end ? line.to : line.from);
    }
  }

  std::vector<DrawnLine> lines_;
  EdgeName last_;
};

}  // namespace

Drawing draw(const TriangleSource& triangles, const Camera& camera, const EdgeOptions& options,
             const std::function<void(double)>& progress) {
  const StandardArithmetic standard;
  std::vector<ObjectLines> objects(triangles.objects().size());
  visible_edges(
      triangles, camera, options,
      [&](const VisibleEdge& edge) { objects[triangles.origin(edge.owner).object].add(edge); },
      progress);
  Drawing drawing{camera.width, camera.height, {}};
  for (std::size_t k = 0; k < objects.size(); ++k) {
    drawing.layers.push_back({triangles.objects()[k].name, objects[k].paths()});
  }
  return drawing;
}

}  // namespace fathom
