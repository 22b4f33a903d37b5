#pragma once

#include <span>
#include <vector>

#include "fathom/rays/ray_tree.h"
#include "fathom/rays/tree_elements.h"

namespace fathom::rays {

using Elements = std::span<Element>;

/// Some elements, the box around them, and the box around their centres.
struct Part {
  Elements elements;
  FloatBox box, centres;

  explicit Part(Elements some) : elements(some) {
    for (const Element& e : elements) {
      box.add(e.box);
      const std::array<float, 3> centre{e.centre(0), e.centre(1), e.centre(2)};
      centres.add({centre, centre});
    }
  }
};

/// Whether no plane separates the elements: their centres are equal, as those of equal triangles.
bool is_crowd(Elements elements);

/// Two to eight parts of more than triangles_together elements, or one part of fewer. The part with
/// the largest box is split again and again: where the surface-area heuristic says or, if
/// `by_number`, into halves. A crowd is split only if it is all that there is. Elements are sorted
/// by part.
/// Source   [WBB08]
std::vector<Part> split_into_children(Elements elements, bool by_number);

}  // namespace fathom::rays
