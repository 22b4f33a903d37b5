#include "apps/options/storage_options.h"

#include "apps/shell/output_place.h"
#include "apps/shell/values.h"
#include "fathom/numeric/errors.h"

namespace fathom::app {
namespace {

Compression parse_compression(const std::string& text) {
  if (text == "pxr24" || text == "b44" || text == "b44a" || text == "dwaa" || text == "dwab") {
    throw UsageError("'" + text +
                     "' loses bits of the depth; there are none, rle, zips, zip and piz");
  }
  return parse_word<Compression>(text, {{"none", Compression::none},
                                        {"rle", Compression::rle},
                                        {"zips", Compression::zips},
                                        {"zip", Compression::zip},
                                        {"piz", Compression::piz}});
}

StorageOptions::Float parse_dtype(const std::string& text) {
  return parse_word<StorageOptions::Float>(text, {{"float32", StorageOptions::Float::binary32},
                                                  {"float64", StorageOptions::Float::binary64}});
}

}  // namespace

void StorageOptions::add_to(Command& command) {
  command.option("--compression", "NAME", into(compression, parse_compression),
                 "Compression of an EXR, always lossless: zip (default), zips, rle, piz or none");
  command.option("--png-scale", "N", into(png_scale, parse_scale),
                 "Codes per unit of a PNG (default 1000)");
  command.option("--dtype", "NAME", into(dtype, parse_dtype),
                 "Of an NPY: float32 (default) or float64");
}

MapFormat StorageOptions::format_of(const std::string& target) const {
  std::optional<MapFormat> format = map_format_of(target);
  if (!format && is_written_through(target)) format = MapFormat::exr;
  if (!format) {
    throw UsageError(target + ": the suffix of a map is one of .exr, .pfm, .png and .npy");
  }
  if (compression && *format != MapFormat::exr) {
    throw UsageError("--compression is for .exr, not for " + target);
  }
  if (png_scale && *format != MapFormat::png) {
    throw UsageError("--png-scale is for .png, not for " + target);
  }
  if (dtype && *format != MapFormat::npy) {
    throw UsageError("--dtype is for .npy, not for " + target);
  }
  return *format;
}

DepthEncoding StorageOptions::encoding_for(MapFormat format) const {
  DepthEncoding encoding;
  if (format == MapFormat::png) {
    encoding.type = DepthEncoding::Type::scaled_unorm16;
    encoding.scale = png_scale.value_or(encoding.scale);
  }
  if (dtype == Float::binary64) encoding.type = DepthEncoding::Type::binary64;
  return encoding;
}

WriteOptions StorageOptions::write_options(int threads) const {
  WriteOptions options;
  options.threads = threads;
  options.compression = compression.value_or(options.compression);
  return options;
}

}  // namespace fathom::app
