#pragma once

#include <optional>
#include <vector>

#include "fathom/pipeline/output/output_merger.h"

/// Temporal antialiasing: what earlier pictures of a moving scene add to the present one.
namespace fathom::pipeline {

/// What history is taken with; the parts can be left out to see what each is for.
struct HistorySettings {
  /// History is looked up where the surface of a pixel was in the picture before, not at the pixel.
  bool reprojected = true;
  /// History is limited, in each component, to the range of the 3 × 3 pixels around in the present
  /// picture: what was uncovered or has changed does not leave a ghost.
  bool clamped = true;
  /// The least share of the present picture in the new history; the first pictures have equal ones.
  double weight = 0.1;
};

/// For each pixel, row by row, where what is seen there was one picture before, minus where it is,
/// in pixels; nothing where it was not in front of the eye.
struct PixelMove {
  double x = 0, y = 0;
};
using PixelMoves = std::vector<std::optional<PixelMove>>;

/// An exponential mean of pictures.
/// Source   [Kar14], without its colour space and its filters.
class TemporalHistory {
 public:
  explicit TemporalHistory(const HistorySettings& settings) : settings_(settings) {}

  /// Takes in the next picture. The moves may be empty for the first one, and where history is not
  /// reprojected.
  void add(const ColourImage& present, const PixelMoves& moves);
  [[nodiscard]] const ColourImage& picture() const { return history_; }

 private:
  [[nodiscard]] Colour earlier(const ColourImage& present, const PixelMoves& moves, std::uint32_t x,
                               std::uint32_t y) const;

  HistorySettings settings_;
  ColourImage history_;
  int pictures_ = 0;
};

}  // namespace fathom::pipeline
