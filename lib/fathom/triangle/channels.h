#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "fathom/image/depth_map.h"
#include "fathom/rendering/channel_values.h"
#include "fathom/rendering/options.h"
#include "fathom/scene/scene_segments.h"
#include "fathom/scene/triangle_source.h"
#include "fathom/threads/per_thread.h"
#include "fathom/triangle/corner_normals.h"
#include "fathom/triangle/projected_triangle.h"
#include "fathom/triangle/stored_quantity.h"

namespace fathom::triangle {

/// A depth that the encoding cannot hold.
struct EncodingFault {
  std::size_t pixel = 0;  // row · width + column
  std::string why;
};

/// Throws the OutputError of a depth that the encoding cannot hold; it names the pixel.
[[noreturn]] void fail(const EncodingFault& fault, const DepthMap& map);

/// Writes the values of one visible surface: exact numbers, each rounded once, here and nowhere
/// else. Several threads may write different pixels at the same time.
class ChannelWriter {
 public:
  /// Fails    UsageError if Ns is requested for a scene that stays in its files.
  ChannelWriter(DepthMap& map, const TriangleSource& triangles, const Camera& camera,
                const RenderOptions& options);
  /// Writes every channel. Returns a fault if the encoding cannot hold the depth.
  std::optional<EncodingFault> write(std::size_t pixel, const ProjectedTriangle& triangle,
                                     const ImagePoint& s);
  /// The same at the ray of a sample, where the camera bends rays.
  std::optional<EncodingFault> write(std::size_t pixel, const ProjectedTriangle& triangle,
                                     const lens::ExactDirection& d);

  /// The normals of channel Ns; null if it was not requested.
  [[nodiscard]] const std::shared_ptr<const CornerNormals>& corner_normals() const {
    return corner_normals_;
  }

  /// For writing one channel, or one component, which must have been requested.
  [[nodiscard]] const rendering::ChannelValues& values() const { return values_; }
  [[nodiscard]] const CodeFactor& code_factor() const { return code_factor_; }
  [[nodiscard]] rendering::OriginNumbers numbers_of(std::uint32_t triangle) const;
  /// Writes the number of the triangle and the numbers of its origin.
  void write_origin(std::size_t pixel, std::uint32_t triangle);
  std::optional<EncodingFault> write_depth(std::size_t pixel, const ProjectedTriangle& triangle,
                                           const ImagePoint& s);
  std::optional<EncodingFault> write_distance(std::size_t pixel, const ProjectedTriangle& triangle,
                                              const ImagePoint& s);
  void write_low_part(std::size_t pixel, const ProjectedTriangle& triangle, const ImagePoint& s);
  void write_normal(std::size_t pixel, const ProjectedTriangle& triangle);
  void write_camera_normal(std::size_t pixel, const ProjectedTriangle& triangle);
  void write_shading_normal(std::size_t pixel, const ProjectedTriangle& triangle,
                            const ImagePoint& s);
  void write_position(std::size_t pixel, std::size_t component, const ProjectedTriangle& triangle,
                      const ImagePoint& s);
  void write_barycentric(std::size_t pixel, std::size_t component,
                         const ProjectedTriangle& triangle, const ImagePoint& s);

 private:
  std::optional<EncodingFault> write_depth(std::size_t pixel, const Ratio& depth);
  void write_low_part(std::size_t pixel, const Ratio& depth);
  std::optional<EncodingFault> write_depth(std::size_t pixel, const ProjectedTriangle& t,
                                           const lens::ExactDirection& d);
  std::optional<EncodingFault> write_distance(std::size_t pixel, const ProjectedTriangle& t,
                                              const lens::ExactDirection& d);
  void write_low_part(std::size_t pixel, const ProjectedTriangle& t, const lens::ExactDirection& d);
  void write_shading_normal(std::size_t pixel, const ProjectedTriangle& t,
                            const lens::ExactDirection& d);
  void write_position(std::size_t pixel, const ProjectedTriangle& t, const lens::ExactDirection& d);
  void write_barycentric(std::size_t pixel, const ProjectedTriangle& t,
                         const lens::ExactDirection& d);

  TriangleSource triangles_;
  /// Null where no channel shows segments.
  std::shared_ptr<const SceneSegments> segments_;
  bool perspective_;
  DepthEncoding encoding_;
  CodeFactor code_factor_;
  /// sign(fx·fy), sign(fx·fy·det R)
  Sign image_handedness_, handedness_;
  rendering::ChannelValues values_;
  std::shared_ptr<const CornerNormals> corner_normals_;
  PerThread<ExactCornerNormals> exact_corner_normals_;
};

}  // namespace fathom::triangle
