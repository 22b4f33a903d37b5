#include <ImfChannelList.h>
#include <ImfDeepFrameBuffer.h>
#include <ImfDeepImageStateAttribute.h>
#include <ImfDeepScanLineOutputFile.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>

#include <cstddef>
#include <numeric>

#include "fathom/failures/errors.h"
#include "fathom/files/file_bytes.h"
#include "fathom/image/deep_map.h"
#include "fathom/image/files/deep_channels.h"
#include "fathom/image/files/exr_attributes.h"
#include "fathom/image/files/exr_streams.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/threads/threads.h"

namespace fathom {
using namespace image;
using namespace files;

namespace {

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

}  // namespace fathom
