#pragma once

namespace fathom::clipping {

/// A clip rectangle [xmin, xmax] × [ymin, ymax], including its border; xmin ≤ xmax, ymin ≤ ymax.
template <class Number>
struct Window {
  Number xmin, ymin, xmax, ymax;
};

/// Throws InputError unless xmin ≤ xmax and ymin ≤ ymax.
template <class Number>
void check_window(const Window<Number>& window);

}  // namespace fathom::clipping
