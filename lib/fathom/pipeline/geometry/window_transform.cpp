#include "fathom/pipeline/geometry/window_transform.h"

#include <algorithm>

namespace fathom::pipeline {
namespace {

template <class Real>
ClipVertex<Real> between(const ClipVertex<Real>& a, const ClipVertex<Real>& b, Real t) {
  if (t == 0) return a;
  if (t == 1) return b;
  const auto mix = [&](Real p, Real q) { return p + t * (q - p); };
  ClipVertex<Real> v{{mix(a.position.x, b.position.x), mix(a.position.y, b.position.y),
                      mix(a.position.z, b.position.z), mix(a.position.w, b.position.w)},
                     a.attributes};
  for (std::size_t i = 0; i < v.attributes.size(); ++i)
    v.attributes[i] = mix(a.attributes[i], b.attributes[i]);
  return v;
}

/// A rectangle with its origin at the lower left corner, as pixels of the image.
PixelWindow in_image(const WindowRectangle& r, const Camera& camera) {
  return {r.x, camera.height - r.y - r.height, r.x + r.width, camera.height - r.y};
}

}  // namespace

template <class Real>
bool is_inside(const ClipVertex<Real>& corner, clipping::Volume volume) {
  for (int k = 0; k < clipping::boundary_count; ++k)
    if (!(clipping::boundary_value(k, corner.position, volume) >= 0)) return false;
  return corner.position.w > 0;
}

template <class Real>
std::optional<std::array<ClipVertex<Real>, 2>> clip_line(const ClipVertex<Real>& a,
                                                         const ClipVertex<Real>& b,
                                                         clipping::Volume volume) {
  Real entering = 0, leaving = 1;
  for (int k = 0; k < clipping::boundary_count; ++k) {
    const Real va = clipping::boundary_value(k, a.position, volume);
    const Real vb = clipping::boundary_value(k, b.position, volume);
    if (va < 0 && vb < 0) return std::nullopt;
    if (va < 0) entering = std::max(entering, va / (va - vb));
    if (vb < 0) leaving = std::min(leaving, va / (va - vb));
  }
  if (entering > leaving) return std::nullopt;
  const std::array<ClipVertex<Real>, 2> part{between(a, b, entering), between(a, b, leaving)};
  if (!(part[0].position.w > 0 && part[1].position.w > 0)) return std::nullopt;
  return part;
}

template <class Real>
std::vector<ClipVertex<Real>> clip_triangle(const std::vector<ClipVertex<Real>>& triangle,
                                            clipping::Volume volume) {
  if (std::all_of(triangle.begin(), triangle.end(),
                  [&](const auto& corner) { return is_inside(corner, volume); }))
    return triangle;
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
  // The upper edge of the viewport, measured from the upper edge of the window.
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

PixelWindow drawable_window(const Camera& camera, const PipelineOptions& options) {
  PixelWindow w{0, 0, camera.width, camera.height};
  for (const auto& rectangle : {options.viewport, options.scissor}) {
    if (!rectangle) continue;
    const PixelWindow r = in_image(*rectangle, camera);
    w = {std::max(w.x_begin, r.x_begin), std::max(w.y_begin, r.y_begin), std::min(w.x_end, r.x_end),
         std::min(w.y_end, r.y_end)};
  }
  return w;
}

bool is_stretched(const Camera& camera, const PipelineOptions& options) {
  return options.viewport && options.viewport->width * std::int64_t{camera.height} !=
                                 options.viewport->height * std::int64_t{camera.width};
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs no parentheses
#define FATHOM_INSTANTIATE(Real)                                                             \
  template std::vector<ClipVertex<Real>> clip_triangle(const std::vector<ClipVertex<Real>>&, \
                                                       clipping::Volume);                    \
  template std::optional<std::array<ClipVertex<Real>, 2>> clip_line(                         \
      const ClipVertex<Real>&, const ClipVertex<Real>&, clipping::Volume);                   \
  template bool is_inside(const ClipVertex<Real>&, clipping::Volume);                        \
  template NdcVertex<Real> divide(const ClipVertex<Real>&);                                  \
  template WindowVertex<Real> Viewport::operator()(const NdcVertex<Real>&) const;
FATHOM_INSTANTIATE(float)
FATHOM_INSTANTIATE(double)
#undef FATHOM_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fathom::pipeline
