#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "fathom/image/map_files.h"

/// Deep maps: all visible fragments of each pixel; their files, and a map to look at.
namespace fathom {

/// A fragment that is visible in a pixel (docs/coverage.md); every number is rounded once.
struct DeepSample {
  /// Planar depth of its nearest and of its farthest visible point, in scene units.
  float Z = 0, ZBack = 0;
  /// Number of the triangle.
  std::uint32_t id = no_surface;
  /// The fraction of the pixel where it is visible, in (0, 1] (0 where that underflows).
  float area = 0;
  /// `area` over what earlier samples leave of the pixel, so that "over" adds up the areas.
  float A = 0;
};

/// A deep image: at each pixel any number of samples, sorted by Z, then ZBack, then id.
struct DeepMap {
  /// Size, object names, texts and matrices; it has no channels.
  DepthMap description;
  /// Number of samples at each pixel, row by row from the top left.
  std::vector<std::uint32_t> counts;
  /// The samples of all pixels, one pixel after another.
  std::vector<DeepSample> samples;
};

/// Fails    UsageError for a compression that deep files do not have.
void check_deep_compression(Compression compression);

/// Writes a deep scan-line EXR with the channels A, Z, ZBack (FLOAT), area (FLOAT) and id (UINT)
/// and deepImageState SORTED; such files can have the compressions `none`, `rle` and `zips`.
/// `threads` compress; 0: all of the machine.
/// Fails    OutputError: "PATH: why"; InputError if there is not a count for each pixel and a
///          sample for each that is counted; UsageError for another compression or number of
///          threads.
void write_deep_map(const DeepMap& map, const std::filesystem::path& path,
                    Compression compression = Compression::zips, int threads = 0);

/// Reads a deep map back that write_deep_map() has written, bit for bit; also a file of another
/// program that has the same channels. Nothing is allocated for more samples than the file can
/// hold, or than `memory` allows.
/// Fails    InputError: "PATH: what is wrong and what was expected".
DeepMap read_deep_map(const std::filesystem::path& path, const MapMemory& memory = {});
/// The same of a file that has been read already; `name` is its name for messages.
DeepMap read_deep_map(std::span<const std::byte> bytes, const std::string& name,
                      const MapMemory& memory = {});

/// Whether a file begins as a deep EXR of one part does.
bool is_deep_map(std::span<const std::byte> bytes);

/// The channel of flat_map() with the number of samples at each pixel.
inline constexpr const char* samples_channel = "samples";

/// A deep map as a map for pictures, with its names and texts: `samples`, the number of samples at
/// each pixel; `Z`, `ZBack` and `id` of the first, the nearest; and `A`, the sum of their areas.
/// Background as of rendered maps.
/// Needs    as many counts as pixels, and as many samples as they say.
DepthMap flat_map(const DeepMap& deep);

}  // namespace fathom
