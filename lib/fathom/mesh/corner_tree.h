#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "fathom/mesh/planar_ring.h"

namespace fathom::mesh {

/// Corners of a face by where they lie: a k-d tree from which corners are taken.
class CornerTree {
 public:
  /// The corners are numbers of `points`, which must outlive this.
  CornerTree(const std::vector<Point2>& points, std::vector<Corner> corners);

  [[nodiscard]] bool contains(Corner corner) const { return place_[corner] != nowhere; }
  void remove(Corner corner);

  /// A corner that lies in the closed triangle abc and is at none of a, b and c; abc turns `way`,
  /// which is not zero. Exact. Which one of several is drawn by lot, so that no arrangement of
  /// corners can be made for which it is always the one that is removed next.
  [[nodiscard]] std::optional<Corner> find_in(const Point2& a, const Point2& b, const Point2& c,
                                              Sign way);

 private:
  static constexpr Corner nowhere = 0xFFFFFFFF;
  /// The corners [begin, end) of the list. The children of node k are 2k + 1 and 2k + 2.
  struct Range {
    std::size_t node, begin, end;
    [[nodiscard]] std::size_t middle() const { return begin + (end - begin) / 2; }
  };
  struct Node {
    Point2 least, greatest;
    std::uint32_t left = 0;  ///< how many corners have not been removed
  };
  class Triangle;

  void build(const Range& range, int depth);
  [[nodiscard]] bool is_leaf(const Range& range) const {
    return 2 * range.node + 1 >= nodes_.size();
  }

  const std::vector<Point2>& points_;
  std::vector<Corner> list_;
  /// Where a corner stands in the list.
  std::vector<Corner> place_;
  std::vector<Node> nodes_;
  std::uint64_t questions_ = 0;
};

}  // namespace fathom::mesh
