#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

/// The formats of map files: the only place that defines their names and contents. Help, messages
/// and tests of the pages take names and suffixes from this table; map_files.cpp has a codec for
/// each row.
namespace fathom {

enum class MapFormat { exr, pfm, png, npy, npz, colmap, tiff };

/// How many channels of a map a file holds.
enum class HeldChannels {
  one,    ///< one
  parts,  ///< one, which may have several parts: N.X, N.Y and N.Z
  all     ///< all, with all texts of the map
};

inline constexpr std::uint32_t any_side = 0xFFFFFFFF;
inline constexpr std::uint64_t any_pixels = 0xFFFFFFFFFFFFFFFF;

struct MapFormatDescription {
  MapFormat format;
  /// The name in messages.
  std::string_view name;
  /// Suffixes of file names, in small letters. The second may be empty.
  std::array<std::string_view, 2> suffixes;
  HeldChannels channels;
  /// Whether read_map() reads files of the format.
  bool is_read = true;
  /// Whether depths are floating-point numbers; else they are 16-bit codes.
  bool holds_floats = true;
  /// Whether depths are 0 where no surface is, and nothing else.
  bool zero_for_none = false;
  /// More pixels on a side do not fit.
  std::uint32_t greatest_side = any_side;
  /// As many pixels do not fit, of 4 bytes each at least.
  std::uint64_t pixels_beyond = any_pixels;
  /// The reason for refusing a larger image, for messages; empty: any image fits.
  std::string_view limit = {};
};

/// In the order of MapFormat.
inline constexpr auto map_format_table = std::to_array<MapFormatDescription>({
    {.format = MapFormat::exr,
     .name = "OpenEXR",
     .suffixes = {".exr"},
     .channels = HeldChannels::all,
     .greatest_side = 0x3FFFFFFF,
     .limit = "EXR holds fewer than 2^30 pixels a side"},
    {.format = MapFormat::pfm, .name = "PFM", .suffixes = {".pfm"}, .channels = HeldChannels::one},
    {.format = MapFormat::png,
     .name = "PNG",
     .suffixes = {".png"},
     .channels = HeldChannels::one,
     .holds_floats = false,
     .zero_for_none = true,
     .greatest_side = 0x7FFFFFFF,
     .limit = "PNG holds fewer than 2^31 pixels a side"},
    {.format = MapFormat::npy,
     .name = "NPY",
     .suffixes = {".npy"},
     .channels = HeldChannels::parts},
    {.format = MapFormat::npz,
     .name = "NPZ",
     .suffixes = {".npz"},
     .channels = HeldChannels::all,
     .pixels_beyond = std::uint64_t{1} << 30,
     .limit = "an NPZ holds less than 4 GiB; .exr holds more"},
    {.format = MapFormat::colmap,
     .name = "COLMAP",
     .suffixes = {".bin"},
     .channels = HeldChannels::parts,
     .zero_for_none = true},
    {.format = MapFormat::tiff,
     .name = "GeoTIFF",
     .suffixes = {".tif", ".tiff"},
     .channels = HeldChannels::all,
     .is_read = false,
     .pixels_beyond = std::uint64_t{1} << 30,
     .limit = "a GeoTIFF holds less than 4 GiB; .exr holds more"},
});

constexpr const MapFormatDescription& description_of(MapFormat format) {
  return map_format_table[static_cast<std::size_t>(format)];
}

/// Whether files of the format hold all channels and texts of a map; other formats hold one
/// channel.
constexpr bool holds_all_channels(MapFormat format) {
  return description_of(format).channels == HeldChannels::all;
}

/// Whether read_map() returns them under their names; it does not read GeoTIFF.
constexpr bool keeps_all_channels(MapFormat format) {
  return holds_all_channels(format) && description_of(format).is_read;
}

/// Whether the one channel may have several parts: N.X, N.Y and N.Z.
constexpr bool holds_parts(MapFormat format) {
  return description_of(format).channels == HeldChannels::parts;
}

/// Whether read_map() returns a channel of any type with all of its parts.
constexpr bool holds_any_channel(MapFormat format) {
  const MapFormatDescription& description = description_of(format);
  return description.is_read && description.channels != HeldChannels::one &&
         !description.zero_for_none;
}

/// Whether depths are 0 where no surface is, and nothing else.
constexpr bool has_zero_for_none(MapFormat format) {
  return description_of(format).zero_for_none;
}

/// The format that a path's suffix names (in any case); nullopt if none.
std::optional<MapFormat> map_format_of(const std::filesystem::path& path);

/// The same.
/// Fails    UsageError "PATH: expected a name that ends in .exr, …" if none.
MapFormat require_map_format(const std::filesystem::path& path);

/// ".exr, .pfm, .png, … or .tif"; `last` stands before the last one.
std::string suffixes_of_maps(std::string_view last = " or ");

/// The same, of the formats whose depths are floating-point numbers.
std::string suffixes_of_float_maps();

/// ".exr and .npz": the formats that keep all channels; `last` stands before the last suffix.
std::string suffixes_of_complete_maps(std::string_view last = " and ");

/// ".exr, .npy or .npz": the formats that hold a channel of any type with all of its parts.
std::string suffixes_for_any_channel();

/// "OpenEXR, PFM, … or COLMAP": the formats that read_map() reads.
std::string names_of_readable_maps();

/// Refuses images with more pixels than the format holds, before any work is done.
/// Fails    OutputError "NAME: EXR holds fewer than 2^30 pixels a side", "NAME: an NPZ holds less
///          than 4 GiB" or the like.
void require_size(MapFormat format, std::uint32_t width, std::uint32_t height,
                  const std::string& name);

}  // namespace fathom
