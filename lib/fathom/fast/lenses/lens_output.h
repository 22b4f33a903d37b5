#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "fathom/fast/channels/map_rows.h"
#include "fathom/fast/channels/resolve.h"
#include "fathom/fast/lenses/lens_tile.h"
#include "fathom/fast/lenses/stage_starts.h"
#include "fathom/fast/lenses/wide_values.h"
#include "fathom/lens/preimages.h"
#include "fathom/lens/word_formulas.h"
#include "fathom/rendering/rendered.h"
#include "fathom/scene/triangle_source.h"
#include "fathom/triangle/channels.h"
#include "fathom/triangle/ray_values.h"

namespace fathom::fast {

/// Writes tiles of a lens to a map that has its background. One for each thread.
class LensOutput {
 public:
  LensOutput(triangle::ChannelWriter& writer, const MapLayout& layout);

  /// Writes all that the tile shows but `valid`. Returns the fault of the first pixel in row order
  /// that has one.
  std::optional<triangle::EncodingFault> write(const LensTile& tile, const LensContext& context);

 private:
  /// Writes the depths that are settled, and +∞ where there is no surface.
  void write_depths(const PixelBox& area) const;
  /// Writes a depth that is settled.
  void write_depth(std::size_t i, std::size_t pixel) const;
  std::optional<triangle::EncodingFault> write_along_ray(const LensTile& tile, std::size_t i,
                                                         const LensContext& context) const;
  /// The pixel of the map that shows a sample of the tile.
  [[nodiscard]] std::size_t pixel_of(const LensTile& tile, std::size_t i) const;
  /// How the depths of a tile are written.
  enum class Depths : std::uint8_t {
    none,
    in_rows,    // rounded from q, with the background: of a tile that one view holds
    by_sample,  // rounded from q, where there is a surface; always of codes
    along_rays  // with the other channels along rays: q is of another axis than Z
  };
  [[nodiscard]] Depths depths_of(const LensTile& tile, const LensContext& context) const;
  /// The samples of a word of bits for which there is more to do than to write rows of depths.
  std::uint64_t work_at(std::size_t word, Depths depths, RenderStatistics& statistics) const;
  /// Channels along rays; false if one of them is not settled.
  bool write_in_binary64(const LensTile& tile, std::size_t i, std::size_t pixel,
                         const triangle::RaySurface::Wanted& wanted, const LensContext& context);
  /// The direction that a sample sees; nullopt where double-words do not find it.
  std::optional<lens::DirectionWords> direction_at(const LensTile& tile, std::size_t i,
                                                   const LensContext& context);
  void prepare_double_words(const LensTile& tile, const LensContext& context);
  /// Channels for which binary64 has too few bits; false if one of them is not settled.
  bool write_in_double_words(const LensTile& tile, std::size_t i, std::size_t pixel,
                             const LensContext& context);
  /// The channels that are the same wherever a surface is seen.
  void write_others(const LensTile& tile, std::size_t i, std::size_t pixel,
                    const LensContext& context);
  /// The channels that do not depend on where a surface is seen.
  void write_triangle_channels(std::size_t pixel, std::uint32_t number,
                               const LensContext& context) const;
  void copy_triangle_channels(std::size_t from, std::size_t to) const;

  triangle::ChannelWriter& writer_;
  MapLayout layout_;
  bool needs_exact_rays_, needs_double_words_;
  triangle::RaySurface::Wanted along_rays_;
  /// Whether a channel is asked for that is the same wherever a surface is seen.
  bool others_;
  LensDepths rounded_;
  /// By the places of surfaces in the tile: the first pixel at which one was written.
  std::vector<std::size_t> first_pixel_;
  /// By the same places; made where they are needed.
  std::vector<std::optional<triangle::RaySurface>> surfaces_;
  /// Of the camera; made where double-words are needed.
  std::optional<lens::WordFormulas> formulas_;
  std::optional<StageStarts> starts_;
  /// Of the tile's window.
  std::optional<WideValues> wide_values_;
};

/// An image that no window holds, because its rays are too far from the axis for binary64 numbers.
/// Its pixels are written from exact numbers, looking at every triangle for each.
class RayByRay {
 public:
  /// All arguments outlive it.
  RayByRay(const TriangleSource& triangles, const Camera& camera, Cull cull,
           const lens::Preimages& preimages);

  /// Counts those of some triangles that no pixel shows, whatever its ray.
  void count(std::span<const std::uint32_t> numbers, RenderStatistics& statistics) const;
  /// Writes the pixels of an area.
  void write(const PixelBox& area, const MapLayout& layout, triangle::ChannelWriter& writer,
             RenderStatistics& statistics, FirstFault& fault) const;

 private:
  const TriangleSource& triangles_;
  const Camera& camera_;
  const lens::Preimages& preimages_;
  /// The triangles that pixels may show.
  std::vector<std::uint32_t> kept_;
};

}  // namespace fathom::fast
