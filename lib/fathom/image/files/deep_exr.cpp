#include <ImfChannelList.h>
#include <ImfDeepFrameBuffer.h>
#include <ImfDeepImageStateAttribute.h>
#include <ImfDeepScanLineInputPart.h>
#include <ImfDeepScanLineOutputFile.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <ImfPixelType.h>
#include <ImfStandardAttributes.h>

#include <array>
#include <cstddef>
#include <numeric>

#include "fathom/failures/errors.h"
#include "fathom/files/byte_order.h"
#include "fathom/files/file_bytes.h"
#include "fathom/files/input_file.h"
#include "fathom/image/deep_map.h"
#include "fathom/image/files/map_codecs.h"
#include "fathom/image/files/openexr.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/threads/threads.h"

namespace fathom {
using namespace image;
using namespace files;

namespace {

struct DeepChannel {
  const char* name;
  Imf::PixelType type;
  /// The offset of the value within a sample, in bytes.
  std::size_t offset;
};

/// The channels of a deep file.
constexpr std::array<DeepChannel, 5> deep_channels{
    {{"A", Imf::FLOAT, offsetof(DeepSample, A)},
     {"Z", Imf::FLOAT, offsetof(DeepSample, Z)},
     {"ZBack", Imf::FLOAT, offsetof(DeepSample, ZBack)},
     {"area", Imf::FLOAT, offsetof(DeepSample, area)},
     {"id", Imf::UINT, offsetof(DeepSample, id)}}};

/// For each pixel, where the values of a channel begin.
std::vector<const char*> beginnings(const DeepMap& map, std::size_t offset) {
  // Nothing may be added to the pointer to no samples at all.
  if (map.samples.empty()) return std::vector<const char*>(map.counts.size());
  std::vector<const char*> result;
  result.reserve(map.counts.size());
  const char* next = reinterpret_cast<const char*>(map.samples.data()) + offset;
  for (const std::uint32_t count : map.counts) {
    result.push_back(next);
    next += count * sizeof(DeepSample);
  }
  return result;
}

Bytes encode(const DeepMap& map, Compression compression, int threads, const std::string& name) {
  const DepthMap& description = map.description;
  require_size(MapFormat::exr, description.width, description.height, name);
  Imf::Header header(static_cast<int>(description.width), static_cast<int>(description.height));
  check_deep_compression(compression);
  header.compression() = compression_of(compression);
  header.setType(Imf::DEEPSCANLINE);
  set_attributes(header, description);
  Imf::addDeepImageState(header, Imf::DIS_SORTED);

  const std::size_t width = description.width;
  Imf::DeepFrameBuffer pixels;
  // OpenEXR takes non-const pointers but does not write through them.
  auto* counts = reinterpret_cast<char*>(const_cast<std::uint32_t*>(map.counts.data()));
  pixels.insertSampleCountSlice(Imf::Slice(Imf::UINT, counts, 4, 4 * width));
  std::vector<std::vector<const char*>> pointers;
  for (const DeepChannel& channel : deep_channels) {
    header.channels().insert(channel.name, Imf::Channel(channel.type));
    auto& at = pointers.emplace_back(beginnings(map, channel.offset));
    pixels.insert(
        channel.name,
        Imf::DeepSlice(channel.type, const_cast<char*>(reinterpret_cast<const char*>(at.data())),
                       sizeof(char*), sizeof(char*) * width, sizeof(DeepSample)));
  }
  ByteOutput stream(name);
  {
    Imf::DeepScanLineOutputFile file(stream, header, reserve_exr_threads(threads));
    stream.table_of_chunks_ends_here();
    file.setFrameBuffer(pixels);
    file.writePixels(static_cast<int>(description.height));
  }
  stream.require_chunks(description.height);  // of one row each
  return stream.take();
}

}  // namespace

void check_deep_compression(Compression compression) {
  if (compression == Compression::zip || compression == Compression::piz)
    throw UsageError("deep EXR files are compressed by zips, rle or none");
}

void write_deep_map(const DeepMap& map, const std::filesystem::path& path, Compression compression,
                    int threads) {
  const StandardArithmetic standard;
  const std::size_t pixels = std::size_t{map.description.width} * map.description.height;
  if (pixels == 0 || map.counts.size() != pixels ||
      std::accumulate(map.counts.begin(), map.counts.end(), std::size_t{0}) != map.samples.size()) {
    throw InputError("deep map: expected a count for each pixel, and as many samples as they say");
  }
  require_thread_count(threads);
  Bytes bytes;
  try {
    bytes = encode(map, compression, threads, path.string());
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& failure) {
    throw OutputError(path.string() + ": cannot be written as EXR: " + exr_reason(failure));
  }
  write_file(path, bytes);
}

namespace {

void require_channels(const Imf::ChannelList& channels, const std::string& name) {
  for (const DeepChannel& each : deep_channels) {
    const Imf::Channel* const found = channels.findChannel(each.name);
    if (!found || found->type != each.type || found->xSampling != 1 || found->ySampling != 1)
      throw InputError(name +
                       ": expected the channels A, Z, ZBack, area (FLOAT) and id (UINT) of a " +
                       "deep map, found none such as " + each.name);
  }
}

/// Reads the counts, and then the samples that they count.
void read_samples(Imf::DeepScanLineInputPart& part, DeepMap& map, std::uint64_t most_samples,
                  const std::string& name) {
  const Imath::Box2i window = part.header().dataWindow();
  const std::size_t width = map.description.width, pixels = width * map.description.height;
  map.counts.resize(pixels);
  // OpenEXR addresses pixels by their coordinates, which may begin anywhere.
  const auto first =
      -(static_cast<std::ptrdiff_t>(window.min.y) * static_cast<std::ptrdiff_t>(width) +
        window.min.x);
  Imf::DeepFrameBuffer target;
  target.insertSampleCountSlice(
      Imf::Slice(Imf::UINT, reinterpret_cast<char*>(map.counts.data() + first), 4, 4 * width));
  std::vector<std::vector<char*>> pointers(deep_channels.size(), std::vector<char*>(pixels));
  for (std::size_t c = 0; c < deep_channels.size(); ++c)
    target.insert(
        deep_channels[c].name,
        Imf::DeepSlice(deep_channels[c].type, reinterpret_cast<char*>(pointers[c].data() + first),
                       sizeof(char*), sizeof(char*) * width, sizeof(DeepSample)));
  part.setFrameBuffer(target);
  part.readPixelSampleCounts(window.min.y, window.max.y);
  const std::uint64_t samples =
      std::accumulate(map.counts.begin(), map.counts.end(), std::uint64_t{0});
  if (samples > most_samples)
    throw InputError(name + ": corrupt: its rows hold fewer samples than its pixels have");
  if (samples == 0) return;
  map.samples.resize(samples);
  for (std::size_t c = 0; c < deep_channels.size(); ++c) {
    char* next = reinterpret_cast<char*>(map.samples.data()) + deep_channels[c].offset;
    for (std::size_t k = 0; k < pixels; ++k) {
      pointers[c][k] = next;
      next += map.counts[k] * sizeof(DeepSample);
    }
  }
  part.readPixels(window.min.y, window.max.y);
}

bool is_exr(ByteView bytes) {
  constexpr std::uint32_t magic = 20000630;
  return bytes.size() >= 4 && load<std::uint32_t>(bytes.data(), std::endian::little) == magic;
}

DeepMap decode(ByteView bytes, const std::string& name, const MapMemory& memory) {
  DeepClaims claims = check_deep_exr_claims(bytes, name);
  ByteInput stream(bytes, name, std::move(claims.defused));
  // Starting threads costs more than a small file does.
  const int threads = bytes.size() < (std::size_t{1} << 18) ? 0 : reserve_exr_threads(0);
  Imf::MultiPartInputFile file(stream, threads, false);
  Imf::DeepScanLineInputPart part(file, 0);
  const Imf::Header& header = part.header();
  require_channels(header.channels(), name);
  const Imath::Box2i window = header.dataWindow();
  if (window != header.displayWindow())
    throw InputError(name + ": cropped and overscanned deep maps are not read");
  DeepMap map;
  map.description.width = static_cast<std::uint32_t>(window.max.x - window.min.x + 1);
  map.description.height = static_cast<std::uint32_t>(window.max.y - window.min.y + 1);
  const std::uint64_t pixels = std::uint64_t{map.description.width} * map.description.height;
  // A count and five pointers for each pixel; the samples, and their columns, that the rows claim.
  const std::uint64_t bytes_per_pixel = 44 + 2 * claims.sample_bytes / pixels;
  require_map_memory(map.description.width, map.description.height, bytes_per_pixel, bytes.size(),
                     memory, name);
  read_samples(part, map, claims.sample_bytes / sizeof(DeepSample), name);
  get_attributes(header, map.description);
  return map;
}

}  // namespace

bool is_deep_map(ByteView bytes) {
  return is_exr(bytes) && bytes.size() >= 8 &&
         is_deep_of_one_part(load<std::uint32_t>(&bytes[4], std::endian::little));
}

DeepMap read_deep_map(const std::filesystem::path& path, const MapMemory& memory) {
  const StandardArithmetic standard;
  const InputFile input(path);
  return read_deep_map(input.bytes(), path.string(), memory);
}

DeepMap read_deep_map(ByteView bytes, const std::string& name, const MapMemory& memory) {
  const StandardArithmetic standard;
  if (!is_exr(bytes)) throw InputError(name + ": expected a deep map (EXR)");
  try {
    return decode(bytes, name, memory);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& failure) {
    throw InputError(name + ": corrupt or truncated EXR file: " + exr_reason(failure));
  }
}

}  // namespace fathom
