#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fathom/failures/errors.h"
#include "fathom/files/file_bytes.h"
#include "fathom/image/depth_map.h"
#include "fathom/image/map_files.h"
#include "fathom/text/counted.h"

/// The formats as pure functions between maps and bytes, for map_files.cpp, tests and fuzzers.
/// `name` is the file's name for messages. Decoded PFM, NPY and COLMAP files take as much memory as
/// the files; other formats may take many times that, within `memory`. Decoders throw InputError,
/// encoders OutputError.
namespace fathom::image {

files::Bytes encode_exr(const DepthMap& map, Compression compression, int threads,
                        const std::string& name);
/// As memory_to_encode().
double memory_to_encode_exr(Compression compression, std::uint32_t height, double bytes_of_map);
DepthMap decode_exr(files::ByteView bytes, const std::string& name, const MapMemory& memory = {});

files::Bytes encode_pfm(const DepthMap& map, const ImageChannel& channel, const std::string& name);
DepthMap decode_pfm(files::ByteView bytes, const std::string& name);

files::Bytes encode_png(const DepthMap& map, const ImageChannel& channel, const std::string& name);
/// The three parts of a channel of normals as the colours of a picture (png_files.h).
/// Fails    UsageError for other bits than 8 and 16, or axes of OpenGL for another channel than Nc.
files::Bytes encode_normals(const DepthMap& map, const std::vector<const ImageChannel*>& parts,
                            const NormalCoding& coding, const std::string& name);
/// The parts of a channel from rows of such a picture; `flips` for the axes of OpenGL.
std::vector<ImageChannel> normals_from(files::ByteView pixels, std::size_t count, int bits,
                                       bool flips, const std::string& channel);
DepthMap decode_png(files::ByteView bytes, const std::string& name, const MapMemory& memory = {});

/// One channel, or several of one type as the parts of a pixel.
files::Bytes encode_npy(const DepthMap& map, const std::vector<const ImageChannel*>& channels,
                        const std::string& name);
DepthMap decode_npy(files::ByteView bytes, const std::string& name);

files::Bytes encode_npz(const DepthMap& map, const std::string& name);
DepthMap decode_npz(files::ByteView bytes, const std::string& name, const MapMemory& memory = {});
/// What decode_npy() makes of one of its arrays; without a name, of the only one.
DepthMap decode_npz_array(files::ByteView bytes, const std::string& array, const std::string& name,
                          const MapMemory& memory);

/// One channel, Z, or the three of Nc.
files::Bytes encode_colmap(const DepthMap& map, const std::vector<const ImageChannel*>& channels,
                           const std::string& name);
DepthMap decode_colmap(files::ByteView bytes, const std::string& name);

/// `camera` places the map in the world; nullopt: the map's own camera.
/// Fails    OutputError if the camera has no world_from_image(), or a channel does not fit.
files::Bytes encode_geotiff(const DepthMap& map, const std::optional<Camera>& camera, int threads,
                            const std::string& name);

/// Recognises the format by the first bytes and decodes.
DepthMap decode_map(files::ByteView bytes, const std::string& name, const MapMemory& memory = {});

/// Whether the version word of an OpenEXR file, with its flags, means a single, deep part. In a
/// file of several parts the flag for deep data only means that at least one part is deep.
bool is_deep_of_one_part(std::uint32_t version);

/// Fails    InputError if an OpenEXR file's header (its first part) claims more than the file can
///          hold, does not describe a plain image, or cannot be parsed. See exr_claims.cpp.
/// Returns the positions of attribute types that OpenEXR must not interpret (see ByteInput).
std::vector<std::size_t> check_exr_claims(files::ByteView bytes, const std::string& name);

/// The claims in the header and the rows of a deep image.
struct DeepClaims {
  /// As check_exr_claims() returns them.
  std::vector<std::size_t> defused;
  /// The unpacked size of the samples of all rows.
  std::uint64_t sample_bytes = 0;
};
/// The same for deep scan lines in one part.
DeepClaims check_deep_exr_claims(files::ByteView bytes, const std::string& name);

/// Greatest ratio of image bytes to file bytes that DEFLATE reaches (1032:1, [zlib]), doubled so as
/// not to depend on the last detail.
inline constexpr std::uint64_t greatest_deflate_ratio = 2064;

/// Refuses a map of this size before anything is allocated for it. `bytes_per_pixel` counts the
/// bytes of the map and the working memory of its decoder.
/// Fails    InputError "NAME: an image of 20000×20000 pixels needs 1.6 GB; …".
void require_map_memory(std::uint32_t width, std::uint32_t height, std::uint64_t bytes_per_pixel,
                        std::uint64_t file_bytes, const MapMemory& memory, const std::string& name);

/// Refuses what follows the header of a file, a "PFM file", unless it is as long as its pixels.
/// Fails    InputError.
inline void require_raw_pixels(files::ByteView data, std::uint32_t width, std::uint32_t height,
                               std::size_t pixel_bytes, const std::string& file,
                               const std::string& name) {
  const std::uint64_t pixels = std::uint64_t{width} * height;
  if (data.size() / pixel_bytes == pixels && data.size() % pixel_bytes == 0) return;
  throw InputError(name + ": truncated or overlong " + file + ": expected " +
                   std::to_string(width) + "×" + std::to_string(height) + " pixels of " +
                   text::counted(pixel_bytes, "byte") + ", found " +
                   text::counted(data.size(), "byte"));
}

}  // namespace fathom::image
