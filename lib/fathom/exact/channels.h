#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fathom/exact/options.h"
#include "fathom/exact/projected_triangle.h"
#include "fathom/exact/triangle_source.h"
#include "fathom/image/depth_map.h"

namespace fathom {

/// A depth that the encoding cannot hold.
struct EncodingFault {
  std::size_t pixel = 0;  // row · width + column
  std::string why;
};

/// The map of a scene without a visible surface: every channel asked for, once, with its
/// background (specification, section 6), in the encoding asked for.
DepthMap make_background(const Camera& camera, const RenderOptions& options);

/// Writes the values of one visible surface: exact numbers, each rounded once, here and nowhere
/// else. Different pixels may be written at the same time.
class ChannelWriter {
 public:
  ChannelWriter(DepthMap& map, const TriangleSource& triangles, const Camera& camera,
                const RenderOptions& options);
  /// Returns what is wrong if the encoding cannot hold the depth.
  std::optional<EncodingFault> write(std::size_t pixel, const ProjectedTriangle& triangle,
                                     const ImagePoint& s);

  /// True where the channels are Z as binary32, id, face and object, or fewer: then a surface whose
  /// rounded depth is known can be written without exact numbers.
  [[nodiscard]] bool takes_rounded_depths() const;
  /// Writes a visible surface; `depth` is its exact depth rounded to binary32. Only if
  /// takes_rounded_depths().
  void write(std::size_t pixel, std::uint32_t triangle, float depth);

 private:
  std::optional<EncodingFault> write_depth(std::size_t pixel, const Ratio& depth);
  std::optional<EncodingFault> write_distance(std::size_t pixel, const ProjectedTriangle& triangle,
                                              const ImagePoint& s);
  void write_low_part(std::size_t pixel, const Ratio& depth);
  void write_origin(std::size_t pixel, std::uint32_t number);
  void write_normal(std::size_t pixel, const ProjectedTriangle& triangle);
  void write_position(std::size_t pixel, const ProjectedTriangle& triangle, const ImagePoint& s);
  void write_barycentric(std::size_t pixel, const ProjectedTriangle& triangle, const ImagePoint& s);

  ImageChannel* channel(const std::string& name);
  float* floats(const std::string& name);
  std::uint32_t* integers(const std::string& name);

  DepthMap& map_;
  TriangleSource triangles_;
  bool perspective_;
  DepthEncoding encoding_;
  /// sign(fx·fy·det R)
  Sign handedness_;
  ImageChannel* depth_ = nullptr;
  /// The values of `depth_` where they are binary32.
  float* depth32_ = nullptr;
  ImageChannel* distance_ = nullptr;
  float* low_ = nullptr;
  std::uint32_t *id_ = nullptr, *face_ = nullptr, *object_ = nullptr;
  std::array<float*, 3> normal_{};
  std::array<float*, 3> position_{};
  std::array<float*, 2> barycentric_{};
};

}  // namespace fathom
