#include "fathom/pipeline/window_transform.h"

#include <algorithm>

namespace fathom::pipeline {

template <class Real>
std::vector<ClipVertex<Real>> clip_triangle(const std::vector<ClipVertex<Real>>& triangle,
                                            clipping::Volume volume) {
  const bool inside = std::all_of(triangle.begin(), triangle.end(), [&](const auto& corner) {
    for (int k = 0; k < clipping::boundary_count; ++k)
      if (!(clipping::boundary_value(k, corner.position, volume) >= 0)) return false;
    return corner.position.w > 0;
  });
  if (inside) return triangle;
  const auto is_nowhere = [](const ClipVertex<Real>& c) {
    return c.position.x == 0 && c.position.y == 0 && c.position.z == 0 && c.position.w == 0;
  };
  if (std::any_of(triangle.begin(), triangle.end(), is_nowhere)) return {};
  auto polygon = clipping::clip_homogeneous(triangle, volume);
  if (std::any_of(polygon.begin(), polygon.end(),
                  [](const auto& corner) { return !(corner.position.w > 0); }))
    polygon.clear();
  return polygon;
}

template <class Real>
NdcVertex<Real> divide(const ClipVertex<Real>& vertex) {
  const auto& [x, y, z, w] = vertex.position;
  NdcVertex<Real> ndc{x / w, y / w, z / w, Real(1) / w, {}};
  std::copy(vertex.attributes.begin(), vertex.attributes.end(), ndc.attributes.begin());
  return ndc;
}

template <class Real>
WindowVertex<Real> Viewport::operator()(const NdcVertex<Real>& v) const {
  const auto half = static_cast<Real>(0.5);
  const auto width = static_cast<Real>(rectangle.width),
             height = static_cast<Real>(rectangle.height);
  const auto left = static_cast<Real>(rectangle.x);
  // The upper edge of the viewport, from the upper edge of the window.
  const auto top = static_cast<Real>(window_height - rectangle.y - rectangle.height);
  const auto near = static_cast<Real>(depth_range[0]), far = static_cast<Real>(depth_range[1]);
  const Real z = volume == clipping::Volume::opengl ? v.z * half + half : v.z;
  return {left + (v.x + Real(1)) * half * width, top + (Real(1) - v.y) * half * height,
          near + z * (far - near), v.inverse_w, v.attributes};
}

Viewport viewport_of(const Camera& camera, const PipelineOptions& options) {
  const WindowRectangle window{0, 0, camera.width, camera.height};
  return {options.viewport.value_or(window), camera.height, options.depth_range,
          volume_of(options.depth_format.mapping)};
}

bool is_stretched(const Camera& camera, const PipelineOptions& options) {
  return options.viewport && options.viewport->width * std::int64_t{camera.height} !=
                                 options.viewport->height * std::int64_t{camera.width};
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs none
#define FATHOM_INSTANTIATE(Real)                                                             \
  template std::vector<ClipVertex<Real>> clip_triangle(const std::vector<ClipVertex<Real>>&, \
                                                       clipping::Volume);                    \
  template NdcVertex<Real> divide(const ClipVertex<Real>&);                                  \
  template WindowVertex<Real> Viewport::operator()(const NdcVertex<Real>&) const;
FATHOM_INSTANTIATE(float)
FATHOM_INSTANTIATE(double)
#undef FATHOM_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fathom::pipeline
