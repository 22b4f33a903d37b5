#include "fathom/rays/ray_tree.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "fathom/rays/tree_elements.h"
#include "fathom/threads/threads.h"

namespace fathom::rays {
namespace {

/// A part of the tree, whose nodes and blocks are numbered from 0.
template <class Stored>
struct Branch {
  std::vector<TreeNode> nodes;
  std::vector<TriangleBlock<Stored>> blocks;
  std::vector<Repetition> repeated;

  /// Returns the number that its first node has here.
  std::uint32_t append(Branch branch) {
    const auto first_node = static_cast<std::uint32_t>(nodes.size());
    const auto first_block = static_cast<std::uint32_t>(blocks.size());
    for (TreeNode& node : branch.nodes) {
      for (std::size_t i = 0; i < TreeNode::most_children; ++i)
        node.child[i] += node.triangles[i] > 0 ? first_block : first_node;
    }
    nodes.insert(nodes.end(), branch.nodes.begin(), branch.nodes.end());
    blocks.insert(blocks.end(), branch.blocks.begin(), branch.blocks.end());
    repeated.insert(repeated.end(), branch.repeated.begin(), branch.repeated.end());
    return first_node;
  }
};

/// A smaller part is built by one thread.
constexpr std::size_t worth_threads = 20000;
/// Below this level the elements are halved by number, which ends within 32 more levels.
constexpr std::size_t levels_by_area = RayTree::most_levels - 34;

template <class Stored>
class Builder {
 public:
  Builder(const PlacedTriangles& triangles, const TriangleSource& source)
      : triangles_(triangles), source_(source) {}

  /// Adds the node of these elements and all below it; returns its number.
  std::uint32_t add_node(Elements elements, std::size_t level, Branch<Stored>& to) const {
    if (is_crowd(elements))
      elements = without_repetitions(elements, triangles_, source_, to.repeated);
    const std::vector<Part> parts = split_into_children(elements, level > levels_by_area);
    const auto number = static_cast<std::uint32_t>(to.nodes.size());
    to.nodes.emplace_back();
    std::vector<Branch<Stored>> branches(elements.size() >= worth_threads ? parts.size() : 0);
    in_parallel(branches.size(), [&](std::size_t i) {
      if (parts[i].elements.size() > triangles_together)
        add_node(parts[i].elements, level + 1, branches[i]);
    });
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const Elements of_child = parts[i].elements;
      const bool is_leaf = of_child.size() <= triangles_together;
      const std::uint32_t child = is_leaf            ? add_block(of_child, to)
                                  : branches.empty() ? add_node(of_child, level + 1, to)
                                                     : to.append(std::move(branches[i]));
      TreeNode& node = to.nodes[number];
      node.child[i] = child;
      node.triangles[i] = is_leaf ? static_cast<std::uint32_t>(of_child.size()) : 0;
      for (std::size_t k = 0; k < 3; ++k) {
        node.lower[k][i] = parts[i].box.lower[k];
        node.upper[k][i] = parts[i].box.upper[k];
      }
    }
    return number;
  }

 private:
  std::uint32_t add_block(Elements elements, Branch<Stored>& to) const {
    TriangleBlock<Stored> block;
    for (std::size_t i = 0; i < elements.size(); ++i) {
      const std::uint32_t number = elements[i].number;
      block.numbers[i] = number;
      for (std::size_t corner = 0; corner < 3; ++corner)
        for (std::size_t axis = 0; axis < 3; ++axis)
          block.corners[corner][axis][i] = static_cast<Stored>(triangles_[number][corner][axis]);
    }
    to.blocks.push_back(block);
    return static_cast<std::uint32_t>(to.blocks.size() - 1);
  }

  const PlacedTriangles& triangles_;
  const TriangleSource& source_;
};

}  // namespace

std::array<Vector, 3> RayTree::corners(std::size_t place) const {
  std::array<Vector, 3> result;
  const auto copy = [&](const auto& blocks) {
    for (std::size_t corner = 0; corner < 3; ++corner)
      for (std::size_t axis = 0; axis < 3; ++axis)
        result[corner][axis] =
            blocks[place / triangles_together].corners[corner][axis][place % triangles_together];
  };
  if (is_in_binary32_) {
    copy(blocks<float>());
  } else {
    copy(blocks<double>());
  }
  return result;
}

std::span<const Repetition> RayTree::repetitions(std::uint32_t first) const {
  if (repeated_.empty()) return {};
  return {std::ranges::lower_bound(repeated_, first, {}, &Repetition::first),
          std::ranges::upper_bound(repeated_, first, {}, &Repetition::first)};
}

TreeNode::TreeNode() {
  for (auto& side : lower) side.fill(beyond_all);
  for (auto& side : upper) side.fill(-beyond_all);
}

RayTree::RayTree(const TriangleSource& source)
    : power_(power_of_unit(source)),
      corner_error_(
          std::ranges::all_of(source.objects(), &Object::placed_as_is) ? 0 : rays::placing_error) {
  const PlacedTriangles triangles(source, power_);
  std::vector<Element> elements = elements_of(source, triangles, corner_error_);
  if (elements.empty()) return;
  is_in_binary32_ = are_in_binary32(triangles);
  has_exact_corners_ = objects_with_exact_corners(source, power_);
  const auto build = [&]<class Stored>(std::vector<TriangleBlock<Stored>>& blocks) {
    Branch<Stored> all;
    Builder<Stored>(triangles, source).add_node(elements, 1, all);
    nodes_ = std::move(all.nodes);
    blocks = std::move(all.blocks);
    repeated_ = std::move(all.repeated);
    std::ranges::sort(repeated_);
    nodes_.shrink_to_fit();
    blocks.shrink_to_fit();
  };
  if (is_in_binary32_) {
    build(std::get<0>(blocks_));
  } else {
    build(std::get<1>(blocks_));
  }
}

}  // namespace fathom::rays
