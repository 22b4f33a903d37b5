#pragma once

#include <array>
#include <optional>
#include <vector>

#include "fathom/pipeline/geometry/vertex_transform.h"
#include "fathom/pipeline/scan/pixels.h"

/// From clip coordinates to the window: clipping, perspective division, viewport, each by itself.
namespace fathom::pipeline {

/// Normalised device coordinates: −1 ≤ x, y ≤ 1, y up; z in [0, 1], or in [−1, 1] for OpenGL.
template <class Real>
struct NdcVertex {
  Real x, y, z;
  Real inverse_w;
  Attributes<Real> attributes;
};

/// Window coordinates in pixels from the top left corner of the image, y down; z in [0, 1].
template <class Real>
struct WindowVertex {
  Real x, y, z;
  Real inverse_w;
  Attributes<Real> attributes;
};

/// Clipping stage: the part of a triangle in the view volume, as a convex polygon with w > 0; empty
/// if nothing of it is inside. A triangle that is entirely inside remains unchanged.
template <class Real>
std::vector<ClipVertex<Real>> clip_triangle(const std::vector<ClipVertex<Real>>& triangle,
                                            clipping::Volume volume);

/// The part of a line in the view volume, as its two ends with w > 0: Liang and Barsky's parameters
/// over the six boundaries.
/// Source   [LB84]
template <class Real>
std::optional<std::array<ClipVertex<Real>, 2>> clip_line(const ClipVertex<Real>& a,
                                                         const ClipVertex<Real>& b,
                                                         clipping::Volume volume);

template <class Real>
bool is_inside(const ClipVertex<Real>& corner, clipping::Volume volume);

/// Division stage: x, y, z over w, which must not be 0.
template <class Real>
NdcVertex<Real> divide(const ClipVertex<Real>& vertex);

/// glViewport and glDepthRange: which rectangle of the window the square −1 ≤ x, y ≤ 1 fills.
struct Viewport {
  WindowRectangle rectangle;       ///< lower left origin
  std::int64_t window_height = 0;  ///< to convert to the top left origin of images
  std::array<double, 2> depth_range{0, 1};
  clipping::Volume volume = clipping::Volume::zero_one;

  /// Viewport stage.
  template <class Real>
  [[nodiscard]] WindowVertex<Real> operator()(const NdcVertex<Real>& vertex) const;
};

Viewport viewport_of(const Camera& camera, const PipelineOptions& options);

/// The pixels that can be drawn to: the pixels in the image, the viewport and the scissor box.
PixelWindow drawable_window(const Camera& camera, const PipelineOptions& options);

/// Whether the viewport's aspect ratio is not the camera's, so that the picture is stretched.
bool is_stretched(const Camera& camera, const PipelineOptions& options);

}  // namespace fathom::pipeline
