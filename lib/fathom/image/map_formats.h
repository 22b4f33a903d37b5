#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

/// The formats of map files: the only place that states what each is called and what it holds.
/// Help, messages and tests of the pages take names and suffixes from this table; map_files.cpp has
/// a codec for each row.
namespace fathom {

enum class MapFormat { exr, pfm, png, npy, npz, colmap, tiff };

/// How many channels of a map a file holds.
enum class HeldChannels {
  one,    ///< one
  parts,  ///< one, which may have several parts: N.X, N.Y and N.Z
  all     ///< all, with all texts of the map
};

struct MapFormatDescription {
  MapFormat format;
  /// In messages.
  std::string_view name;
  /// Of files' names, in small letters. The second may be empty.
  std::array<std::string_view, 2> suffixes;
  HeldChannels channels;
  /// Whether read_map() reads files of the format.
  bool is_read;
  /// Whether depths are floating-point numbers; else they are 16-bit codes.
  bool holds_floats;
  /// Whether depths are 0 where no surface is, and nothing else.
  bool zero_for_none;
  /// More pixels on a side do not fit.
  std::uint32_t greatest_side;
  /// As many pixels do not fit, of 4 bytes each at least.
  std::uint64_t pixels_beyond;
  /// What is wrong with a larger image, for messages; empty: any image fits.
  std::string_view limit;
};

inline constexpr std::uint32_t any_side = 0xFFFFFFFF;
inline constexpr std::uint64_t any_pixels = 0xFFFFFFFFFFFFFFFF;

/// In the order of MapFormat.
inline constexpr auto map_format_table = std::to_array<MapFormatDescription>({
    {MapFormat::exr,
     "OpenEXR",
     {".exr"},
     HeldChannels::all,
     true,
     true,
     false,
     0x3FFFFFFF,
     any_pixels,
     "EXR holds fewer than 2^30 pixels a side"},
    {MapFormat::pfm,
     "PFM",
     {".pfm"},
     HeldChannels::one,
     true,
     true,
     false,
     any_side,
     any_pixels,
     ""},
    {MapFormat::png,
     "PNG",
     {".png"},
     HeldChannels::one,
     true,
     false,
     true,
     0x7FFFFFFF,
     any_pixels,
     "PNG holds fewer than 2^31 pixels a side"},
    {MapFormat::npy,
     "NPY",
     {".npy"},
     HeldChannels::parts,
     true,
     true,
     false,
     any_side,
     any_pixels,
     ""},
    {MapFormat::npz,
     "NPZ",
     {".npz"},
     HeldChannels::all,
     true,
     true,
     false,
     any_side,
     std::uint64_t{1} << 30,
     "an NPZ holds less than 4 GiB; .exr holds more"},
    {MapFormat::colmap,
     "COLMAP",
     {".bin"},
     HeldChannels::parts,
     true,
     true,
     true,
     any_side,
     any_pixels,
     ""},
    {MapFormat::tiff,
     "GeoTIFF",
     {".tif", ".tiff"},
     HeldChannels::all,
     false,
     true,
     false,
     any_side,
     std::uint64_t{1} << 30,
     "a GeoTIFF holds less than 4 GiB; .exr holds more"},
});

constexpr const MapFormatDescription& description_of(MapFormat format) {
  return map_format_table[static_cast<std::size_t>(format)];
}

/// Whether files of the format hold all channels of a map and all of its texts; the others hold one
/// channel.
constexpr bool holds_all_channels(MapFormat format) {
  return description_of(format).channels == HeldChannels::all;
}

/// Whether read_map() gives them back under their names; a GeoTIFF is for other programs alone.
constexpr bool keeps_all_channels(MapFormat format) {
  return holds_all_channels(format) && description_of(format).is_read;
}

/// Whether the one channel may have several parts: N.X, N.Y and N.Z.
constexpr bool holds_parts(MapFormat format) {
  return description_of(format).channels == HeldChannels::parts;
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

/// "OpenEXR, PFM, … or COLMAP": the formats that read_map() reads.
std::string names_of_readable_maps();

/// Refuses images with more pixels than the format holds, before any work is done.
/// Fails    OutputError "NAME: EXR holds fewer than 2^30 pixels a side", "NAME: an NPZ holds less
///          than 4 GiB" or the like.
void require_size(MapFormat format, std::uint32_t width, std::uint32_t height,
                  const std::string& name);

}  // namespace fathom
