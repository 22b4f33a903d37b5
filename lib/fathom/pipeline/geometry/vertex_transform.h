#pragma once

#include <array>
#include <cstddef>

#include "fathom/camera/camera.h"
#include "fathom/clipping/homogeneous.h"
#include "fathom/pipeline/geometry/primitive_assembly.h"
#include "fathom/pipeline/options.h"

namespace fathom::pipeline {

/// The attributes that vertices pass to fragments, by the index of the first component.
namespace attribute {
inline constexpr std::size_t depth = 0;  ///< along the view, scene units
inline constexpr std::size_t world = 1;  ///< position, three
/// In the world, three: of unit length at the corners of the mesh, on the side of the triangle
/// that is the front for an unmirrored camera.
inline constexpr std::size_t normal = 4;
inline constexpr std::size_t uv = 7;      ///< texture coordinates, two
inline constexpr std::size_t colour = 9;  ///< linear, three
/// How many of them fragments get.
inline constexpr std::size_t of_fragments = 12;
/// Gouraud's light at the corners, diffuse and specular, for either side of the surface.
inline constexpr std::size_t front_light = 12, back_light = 14;
inline constexpr std::size_t count = 16;
}  // namespace attribute

template <class Real>
using Attributes = std::array<Real, attribute::count>;

// Vertex stage: model, view and projection, in binary32 or binary64, each matrix rounded to it.
//
// Frames   world; eye: x right, y up, z backward, as in OpenGL; clip: (x, y, z, w) with
//          −w ≤ x, y ≤ w inside, y up, and z according to the depth format's volume.

template <class Real>
using Matrix = std::array<std::array<Real, 4>, 4>;

template <class Real>
struct WorldVertex {
  Real x, y, z;
};
template <class Real>
struct EyeVertex {
  Real x, y, z;
};
/// A vertex in clip coordinates with its attributes.
template <class Real>
using ClipVertex = clipping::Corner4<Real>;

/// The matrices of an object seen by a camera. `options.depth_format` has near and far.
template <class Real>
struct VertexTransform {
  VertexTransform(const Camera& camera, const Object& object, const PipelineOptions& options);

  Matrix<Real> world_from_mesh, eye_from_world, clip_from_eye;

  [[nodiscard]] WorldVertex<Real> to_world(const MeshPoint& p) const;
  [[nodiscard]] EyeVertex<Real> to_eye(const WorldVertex<Real>& p) const;
  [[nodiscard]] clipping::Point4<Real> to_clip(const EyeVertex<Real>& p) const;
  [[nodiscard]] ClipVertex<Real> operator()(const InputVertex& vertex) const;
};

/// The volume that the mapping's projection fills: z from −w for OpenGL, from 0 for the others.
clipping::Volume volume_of(Mapping mapping);

/// Whether the mapping is not a projection, so that fragments compute their stored depth themselves
/// from their depth along the view.
bool is_per_fragment(Mapping mapping);

/// Fills in the camera's near and far or, if it has none, values that contain the scene: near is
/// half the least vertex depth if every depth is positive, otherwise 10⁻⁴ of the greatest; far is
/// twice the greatest.
/// Fails    UsageError if the camera is orthographic and the mapping needs a perspective one.
void fill_in_range(const Scene& scene, const Camera& camera, DepthFormat& format);

}  // namespace fathom::pipeline
