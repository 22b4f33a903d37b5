#pragma once

#include <functional>

#include "fathom/pipeline/scan/arithmetic.h"
#include "fathom/pipeline/scan/pixels.h"

namespace fathom::pipeline {

/// A segment in window coordinates, in pixels, y down.
template <class Number>
struct WindowSegment {
  Number x0, y0, x1, y1;
};

/// A pixel whose diamond a segment leaves, and the parameters, 0 at its first end and 1 at its
/// second, at which it enters and leaves it (without the parts of ε). A segment that begins inside
/// enters at 0.
template <class Number>
struct DiamondPassage {
  Pixel pixel;
  Number enters, leaves;
};

/// The diamond-exit rule of graphics processors: a pixel is drawn if the segment leaves its diamond
/// |x − x_c| + |y − y_c| < ½, so that segments joined end to end draw no pixel twice. The segment
/// is regarded as moved by (−ε, −ε²) with ε infinitely small, which decides every tie; the ε is
/// carried along symbolically. Pixels come in drawing order.
///
/// Exact    over Exact.
/// Source   [GL46] 14.5.1, in window coordinates with y down.
template <class Number>
void diamond_exit_line(const WindowSegment<Number>& segment, const PixelWindow& window,
                       const std::function<void(const Pixel&)>& visit);
template <class Number>
void diamond_exit_passages(const WindowSegment<Number>& segment, const PixelWindow& window,
                           const std::function<void(const DiamondPassage<Number>&)>& visit);

}  // namespace fathom::pipeline
