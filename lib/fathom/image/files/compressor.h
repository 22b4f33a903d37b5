#pragma once

#include <libdeflate.h>

#include <memory>
#include <new>

/// What EXR and GeoTIFF are compressed with. Only for .cpp files.
namespace fathom::image {

/// Of libdeflate: files are 0.7 to 1.2 % smaller than with zlib at OpenEXR's level 4, in half the
/// time. Lower levels are hardly faster, higher ones hardly smaller (docs/performance.md).
inline constexpr int compression_level = 6;

struct FreeCompressor {
  void operator()(libdeflate_compressor* compressor) const {
    libdeflate_free_compressor(compressor);
  }
};
using Compressor = std::unique_ptr<libdeflate_compressor, FreeCompressor>;

inline Compressor new_compressor() {
  Compressor compressor(libdeflate_alloc_compressor(compression_level));
  if (!compressor) throw std::bad_alloc();
  return compressor;
}

}  // namespace fathom::image
