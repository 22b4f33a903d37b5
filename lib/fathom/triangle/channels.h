#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "fathom/image/depth_map.h"
#include "fathom/scene/scene_segments.h"
#include "fathom/scene/triangle_source.h"
#include "fathom/threads/per_thread.h"
#include "fathom/triangle/code_factor.h"
#include "fathom/triangle/corner_normals.h"
#include "fathom/triangle/options.h"
#include "fathom/triangle/projected_triangle.h"

namespace fathom::triangle {

/// A depth that the encoding cannot hold.
struct EncodingFault {
  std::size_t pixel = 0;  // row · width + column
  std::string why;
};

/// Throws the OutputError of a depth that the encoding cannot hold; it names the pixel.
[[noreturn]] void fail(const EncodingFault& fault, const DepthMap& map);

/// The map of a scene without a visible surface: every channel asked for, once, with its
/// background (specification, section 6), in the encoding asked for. Channels of `before` that have
/// the same name, type and size lend their memory for good.
DepthMap make_background(const Camera& camera, const RenderOptions& options, DepthMap before = {});

/// What channels of a map have where no surface is seen, for filling a map part by part.
class MapBackground {
 public:
  /// `count` pixels from this one on (row · width + column). Several threads may fill different
  /// ones at the same time.
  void fill(std::size_t first_pixel, std::size_t count) const;
  /// Calls visit(values of the channel, its background) for each.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const Filled& channel : channels_) {
      std::visit([&](const auto& values) { visit(values.first, values.background); },
                 channel.values);
    }
  }

  template <class T>
  void add(const std::string& channel, T* values, T background) {
    channels_.push_back({channel, Values<T>{values, background}});
  }
  void leave_out(std::string_view channel) {
    std::erase_if(channels_, [&](const Filled& filled) { return filled.name == channel; });
  }

 private:
  template <class T>
  struct Values {
    T* first;
    T background;
  };
  struct Filled {
    std::string name;
    std::variant<Values<float>, Values<double>, Values<std::uint16_t>, Values<std::uint32_t>>
        values;
  };
  std::vector<Filled> channels_;
};

struct UnfilledMap {
  DepthMap map;
  /// Of the channels that do not have it yet.
  MapBackground background;
};
/// make_background(), but filling it is left to the caller.
UnfilledMap make_unfilled_map(const Camera& camera, const RenderOptions& options,
                              DepthMap before = {});

/// What binary32 and binary64 channels have where no surface is seen.
struct Backgrounds {
  static constexpr float depth = std::numeric_limits<float>::infinity();
  static constexpr float position = std::numeric_limits<float>::quiet_NaN();
  static constexpr float other = 0;
};

/// Where the values of a channel that is stored as DepthEncoding says are kept: one pointer is not
/// null, or none if the channel was not asked for.
struct EncodedValues {
  float* binary32 = nullptr;
  double* binary64 = nullptr;
  std::uint16_t* codes = nullptr;

  [[nodiscard]] bool wanted() const { return binary32 || binary64 || codes; }
};

/// What the channels that tell where a triangle comes from have of it, where they were asked for.
struct OriginNumbers {
  std::uint32_t face = 0, object = 0;
  /// In the order of Segmentation.
  std::array<std::uint32_t, all_segmentations.size()> segments{};

  static constexpr std::size_t count = 2 + all_segmentations.size();
  /// In this order.
  [[nodiscard]] std::array<std::uint32_t, count> all() const {
    std::array<std::uint32_t, count> numbers{face, object};
    std::copy(segments.begin(), segments.end(), numbers.begin() + 2);
    return numbers;
  }
};

/// Where the values of a map's channels are kept; null where a channel was not asked for.
struct ChannelValues {
  explicit ChannelValues(DepthMap& map);

  /// Whether a channel of OriginNumbers was asked for.
  [[nodiscard]] bool wants_origins() const;
  void write(std::size_t pixel, const OriginNumbers& numbers) const;
  /// In the order of OriginNumbers::all(); null where it was not asked for.
  [[nodiscard]] std::array<std::uint32_t*, OriginNumbers::count> origins() const {
    std::array<std::uint32_t*, OriginNumbers::count> values{face, object};
    std::copy(segments.begin(), segments.end(), values.begin() + 2);
    return values;
  }

  EncodedValues depth, distance;
  /// Not filled by ChannelWriter: A is not a value of a single surface.
  float* coverage = nullptr;
  float* low = nullptr;
  std::uint32_t *id = nullptr, *face = nullptr, *object = nullptr;
  std::array<std::uint32_t*, all_segmentations.size()> segments{};
  std::array<float*, 3> normal{}, camera_normal{}, shading_normal{};
  std::array<float*, 3> position{};
  std::array<float*, 2> barycentric{};
};

/// Writes the values of one visible surface: exact numbers, each rounded once, here and nowhere
/// else. Several threads may write different pixels at the same time.
class ChannelWriter {
 public:
  /// Fails    UsageError where Ns is asked for of a scene that stays in its files.
  ChannelWriter(DepthMap& map, const TriangleSource& triangles, const Camera& camera,
                const RenderOptions& options);
  /// Writes every channel. Returns what is wrong if the encoding cannot hold the depth.
  std::optional<EncodingFault> write(std::size_t pixel, const ProjectedTriangle& triangle,
                                     const ImagePoint& s);

  /// Of channel Ns; null if it was not asked for.
  [[nodiscard]] const std::shared_ptr<const CornerNormals>& corner_normals() const {
    return corner_normals_;
  }

  /// For writing one channel, or one component: it must have been asked for.
  [[nodiscard]] const ChannelValues& values() const { return values_; }
  [[nodiscard]] const CodeFactor& code_factor() const { return code_factor_; }
  [[nodiscard]] OriginNumbers numbers_of(std::uint32_t triangle) const;
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
  void write_origin(std::size_t pixel, std::uint32_t number);

  TriangleSource triangles_;
  /// Null where no channel shows segments.
  std::shared_ptr<const SceneSegments> segments_;
  bool perspective_;
  DepthEncoding encoding_;
  CodeFactor code_factor_;
  /// sign(fx·fy), sign(fx·fy·det R)
  Sign image_handedness_, handedness_;
  ChannelValues values_;
  std::shared_ptr<const CornerNormals> corner_normals_;
  PerThread<ExactCornerNormals> exact_corner_normals_;
};

}  // namespace fathom::triangle
