#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/pipeline/output/output_merger.h"
#include "fathom/scene/scene.h"

/// Moving scenes: where points of triangles are in the image as objects move, and temporal
/// antialiasing.
namespace fathom::pipeline {

/// The corners of a triangle as homogeneous image points (U, V, W), in binary64: their places are
/// (U/W, V/W) in pixels where W > 0.
using ImageTriangle = std::array<std::array<double, 3>, 3>;

/// Triangles of one scene, by number, as a camera sees them.
class ImageTriangles {
 public:
  ImageTriangles(const Scene& scene, const Camera& camera);
  [[nodiscard]] ImageTriangle operator[](std::uint32_t number) const;

 private:
  /// Image from mesh, 3 × 4, for each object.
  std::vector<std::array<std::array<double, 4>, 3>> image_from_mesh_;
  std::vector<std::uint32_t> first_;  ///< number of each object's first triangle, and of all
  const Scene* scene_;
};

/// The point of a triangle that is seen at a place of the image, as weights of its corners that add
/// up to 1; nothing if the triangle is seen edge on.
std::optional<std::array<double, 3>> weights_at(const ImageTriangle& triangle, double u, double v);

/// The place of such a point; nothing if it is not in front of the eye.
std::optional<std::array<double, 2>> place_of(const ImageTriangle& triangle,
                                              const std::array<double, 3>& weights);

// Temporal antialiasing: earlier pictures of a moving scene contribute to the present picture.

/// How history is used; each part can be switched off to show its effect.
struct HistorySettings {
  /// Whether history is looked up where the surface of a pixel was in the previous picture, not at
  /// the pixel.
  bool reprojected = true;
  /// Whether each component of history is limited to the range of the 3 × 3 pixels around the pixel
  /// in the present picture, so that uncovered or changed surfaces leave no ghosts.
  bool clamped = true;
  /// The least share of the present picture in the new history; the first pictures have equal
  /// shares.
  double weight = 0.1;
};

/// For each pixel, row by row, the previous position of the surface seen there minus its present
/// position, in pixels; nullopt if it was not in front of the eye.
struct PixelMove {
  double x = 0, y = 0;
};
using PixelMoves = std::vector<std::optional<PixelMove>>;

/// An exponential mean of pictures.
/// Source   [Kar14], without its colour space and its filters.
class TemporalHistory {
 public:
  explicit TemporalHistory(const HistorySettings& settings) : settings_(settings) {}

  /// Adds the next picture. The moves may be empty for the first picture, or if history is not
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
