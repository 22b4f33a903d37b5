#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fathom/pipeline/scan/arithmetic.h"
#include "fathom/pipeline/scan/pixels.h"

/// Scan-line fill with active edges.
///
/// A pixel is filled if its centre is inside, by a rule that is half-open both ways: an edge
/// crosses a scan line if y_min ≤ y < y_max, so that of two edges that meet in a corner exactly one
/// does unless the corner is a local extremum (two at the top of the polygon, none at its bottom; y
/// grows down), and horizontal edges never do; a span takes the centres with x_left ≤ x < x_right.
/// So polygons that share an edge share no pixel and leave none out.
/// Source   [FvDFH90] 3.6
namespace fathom::pipeline {

/// A corner with its attributes, which are linear along edges and spans.
template <class Number>
struct FillCorner {
  Number x, y;
  std::vector<Number> attributes;
};

/// Outlines and holes; the first corner is not repeated.
template <class Number>
using FillPolygon = std::vector<std::vector<FillCorner<Number>>>;

enum class FillRule {
  even_odd,  ///< inside if a ray meets the outline an odd number of times
  non_zero,  ///< inside if the outline winds around
};

/// Where an edge crosses a scan line.
template <class Number>
struct Crossing {
  Number x;
  /// +1 if the edge runs down, −1 if it runs up: added up from the left they are the winding
  /// number, counter-clockwise as seen.
  int winding;
  std::vector<Number> attributes;
  /// The edge's change from one scan line to the next: Δx/Δy and ΔR/Δy.
  Number dx_dy;
  std::vector<Number> dr_dy;
};

/// A span of a scan line, and the crossings at its ends as indices.
template <class Number>
struct FilledSpan {
  Span pixels;
  std::size_t left = 0, right = 0;
  /// The change from one pixel to the next, ΔR/Δx, and the attributes at the first centre.
  std::vector<Number> dr_dx, first;
};

template <class Number>
struct ScanLine {
  std::int64_t y = 0;
  std::vector<Crossing<Number>> crossings;  ///< by x
  std::vector<FilledSpan<Number>> spans;    ///< some may be empty
};

/// Fills a polygon, scan line by scan line from the top, without scan lines that have no crossing.
/// Attributes change along edges by ΔR/Δy, then along spans by ΔR/Δx.
/// Exact    over Exact; in floating point the increments' errors add up.
template <class Number>
void fill_polygon(const FillPolygon<Number>& polygon, FillRule rule, const PixelWindow& window,
                  const std::function<void(const ScanLine<Number>&)>& visit);

/// The attributes at each pixel of a span, in order: the first, then + ΔR/Δx.
template <class Number>
std::vector<std::vector<Number>> values_along(const FilledSpan<Number>& span);

/// A picture of characters, one per pixel, a string per row; all rows have the same length.
using CharacterGrid = std::vector<std::string>;

enum class Connectivity { four = 4, eight = 8 };

/// The pixels that are connected with the seed through pixels of its own character, in row order;
/// empty if the seed is outside. Works on spans with an explicit stack: its memory grows with the
/// outline, and no picture is too large for the call stack.
/// Source   [Smi79]
std::vector<Pixel> flood_fill(const CharacterGrid& grid, const Pixel& seed,
                              Connectivity connectivity);

}  // namespace fathom::pipeline
