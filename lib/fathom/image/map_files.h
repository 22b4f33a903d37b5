#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/image/depth_map.h"
#include "fathom/image/map_formats.h"
#include "fathom/image/png_files.h"
#include "fathom/memory/available_memory.h"

namespace fathom {

/// Whether a file begins as COLMAP's dense maps do, with a number that is ended by "&".
bool is_colmap_map(std::span<const std::byte> bytes);

/// Refuses to write the map of a camera as a GeoTIFF, before any work is done, unless its pixels
/// have a place in the world whatever their depth: it is orthographic and looks straight along the
/// world's z.
/// Fails    OutputError "NAME: a GeoTIFF needs an orthographic camera that …".
void require_place_in_world(const Camera& camera, const std::string& name);

/// Lossless EXR compressions.
enum class Compression { none, rle, zips, zip, piz };
inline constexpr std::array all_compressions{Compression::none, Compression::rle, Compression::zips,
                                             Compression::zip, Compression::piz};
/// "none", "rle", "zips", "zip" or "piz".
std::string_view name_of(Compression compression);

struct WriteOptions {
  Compression compression = Compression::zip;
  /// Threads to compress with; 0: all.
  int threads = 0;
  /// The channel to write as PFM, PNG, NPY or for COLMAP; if empty, the map's only channel. As NPY
  /// also a channel of several parts, "N" for N.X, N.Y and N.Z; as PNG also one of normals, N, Nc
  /// or Ns; for COLMAP "Nc".
  std::string channel;
  /// The camera that places a GeoTIFF in the world; nullopt: the map's camera.
  std::optional<Camera> camera;
  /// How a PNG stores normals.
  NormalCoding normals;
};

/// Least number of bytes that encode_map() takes in addition to a map of so many bytes: for a
/// compressed EXR the memory of a chunk of rows, which is the whole map if it has few rows; for PNG
/// and GeoTIFF, whose rows are compressed a few at a time, 0; for other formats a file as large as
/// the map.
double memory_to_encode(MapFormat format, Compression compression, std::uint32_t height,
                        double bytes_of_map);

/// Writes a map directly to `path`. The caller may write to another path first and rename the file.
///   EXR   every channel, all attributes (docs/reading-maps.md).
///   PFM   one binary32 channel, bottom row first, little endian, scale −1.
///   PNG   one channel of 16-bit codes, big endian as always in PNG, with the scale as text chunk
///         `fathom:scale`, attributes as text chunks; or identifiers up to 65534; or normals as
///         RGB (png_files.h).
///   NPY   one channel, C order, shape (height, width), version 1.0; one of several parts, of one
///         type, has shape (height, width, parts).
///   NPZ   every channel as such an array, in a ZIP archive without compression, of less than 4
///         GiB; the texts and the names of objects as a JSON object in an array `fathom` that is a
///         text.
///   COLMAP  a dense map: Z, 0 where no surface is; or Nc; both binary32 (files/colmap_file.cpp).
///   TIFF  a GeoTIFF of less than 4 GiB, for other programs: a band of binary32 for every channel,
///         with DEFLATE, and its place in the world, by a camera that require_place_in_world()
///         takes (files/geotiff.cpp).
/// Fails    OutputError: "PATH: why" (disk full, not writable), or if the format cannot hold the
///          map; InputError if the map has a fault (find_fault); UsageError if the channel is
///          missing or ambiguous, or the number of threads is out of range.
void write_map(const DepthMap& map, const std::filesystem::path& path, MapFormat format,
               const WriteOptions& options = {});
/// The bytes of such a file; `name` is its name for messages.
/// Fails    as write_map(), except for the disk.
std::vector<std::byte> encode_map(const DepthMap& map, const std::string& name, MapFormat format,
                                  const WriteOptions& options = {});

/// Memory limit for reading a map. A constant image is compressed a thousandfold, so a small file
/// may legitimately unpack to far more memory than its reader expects.
struct MapMemory {
  MemoryAllowance allowance = available_memory();
  /// A file counts as small if it unpacks to more than this many times its size.
  static constexpr double usual_ratio = 100;
  /// The limit of small files; nullopt: only `allowance`. Two channels of 8192×8192 binary32
  /// values.
  std::optional<MemoryAllowance> of_small_file =
      MemoryAllowance{std::uint64_t{1} << 29, "such a small file may unpack to", ""};
};

/// Reads a map and recognizes its format by content. Channels get their own names back if
/// with_channel_names() renamed them. The parts of an array with several values per pixel are named
/// like the parts of the channel of that name, or NAME.0, NAME.1, …. An NPY has no names: its
/// channel is "Z", "id" (32-bit integers) or "vector". A COLMAP map has "Z", with +∞ for 0, or
/// "Nc". EXR files of other programs are read too: HALF channels are widened to binary32; a layered
/// name is kept in full. Sizes that the file cannot fill or that exceed `memory` are refused before
/// allocation. "-" is standard input.
/// Fails    InputError: "PATH: the fault and the expectation".
DepthMap read_map(const std::filesystem::path& path, const MapMemory& memory = {});
/// The same of a file that has been read already; `name` is its name for messages.
DepthMap read_map(std::span<const std::byte> bytes, const std::string& name,
                  const MapMemory& memory = {});

/// One array of an NPZ, as read_map() reads an NPY, regardless of the other arrays. `array` is its
/// name; it may be empty if the file has only one array.
/// Fails    InputError as read_map(), and if the array does not exist or, without a name, if the
///          file has several arrays.
DepthMap read_npz_array(const std::filesystem::path& path, const std::string& array,
                        const MapMemory& memory = {});

/// Whether a file begins like a map: a format that read_map() reads, or TIFF, which read_map()
/// refuses by name.
bool is_map(std::span<const std::byte> bytes);

}  // namespace fathom
