#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "fathom/image/map_files.h"

namespace fathom {

/// A visible fragment in a pixel (docs/coverage.md), every number rounded once from the exact one.
struct DeepSample {
  /// Depth of the nearest and of the farthest point that is visible.
  float Z = 0, ZBack = 0;
  /// Number of the triangle.
  std::uint32_t id = no_surface;
  /// The part of the pixel where it is visible, in (0, 1] (0 where that underflows).
  float area = 0;
  /// area over what the samples before it leave of the pixel, so that "over" adds up the areas.
  float A = 0;
};

/// A deep image: at each pixel any number of samples, sorted by Z, then ZBack, then id.
struct DeepMap {
  /// Size, object names, texts and matrices; it has no channels.
  DepthMap description;
  /// Number of samples at each pixel, row by row.
  std::vector<std::uint32_t> counts;
  /// The samples of all pixels, one pixel after the other.
  std::vector<DeepSample> samples;
};

/// Throws UsageError for a compression that deep files do not have.
void check_deep_compression(Compression compression);

/// Writes a deep scan-line EXR with the channels A, Z, ZBack (FLOAT), area (FLOAT) and id (UINT)
/// and deepImageState SORTED; `none`, `rle` and `zips` are the compressions there are for it. Fails
/// OutputError: "PATH: why". UsageError: another compression.
void write_deep_map(const DeepMap& map, const std::filesystem::path& path,
                    Compression compression = Compression::zips, int threads = 0);

}  // namespace fathom
