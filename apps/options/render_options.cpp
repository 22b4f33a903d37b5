#include "apps/options/render_options.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>

#include "apps/shell/numbers.h"
#include "fathom/numeric/errors.h"

namespace fathom::app {
namespace {

Compression compression_named(const std::string& name) {
  static const std::map<std::string, Compression> compressions{{"none", Compression::none},
                                                               {"rle", Compression::rle},
                                                               {"zips", Compression::zips},
                                                               {"zip", Compression::zip},
                                                               {"piz", Compression::piz}};
  const auto found = compressions.find(name);
  if (found != compressions.end()) return found->second;
  const bool lossy =
      name == "pxr24" || name == "b44" || name == "b44a" || name == "dwaa" || name == "dwab";
  throw UsageError("--compression: '" + name + "' " +
                   (lossy ? "loses bits of the depth" : "does not exist") +
                   "; there are none, rle, zips, zip and piz");
}

}  // namespace

Cull cull_named(const std::string& name) {
  if (name == "none") return Cull::none;
  if (name == "back") return Cull::back;
  if (name == "front") return Cull::front;
  throw UsageError("--cull: '" + name + "' is none of back, front and none");
}

void add_cull_option(CLI::App& command, std::string& cull) {
  command.add_option("--cull", cull, "Triangles to leave out: back, front or none (default none)");
}

void StorageOptions::add_to(CLI::App& command) {
  command.add_option("--compression", compression,
                     "Of an EXR, all without loss: zip (default), zips, rle, piz or none");
  command.add_option("--png-scale", png_scale, "Steps per unit of a PNG (default 1000)");
  command.add_option("--dtype", dtype, "Of an NPY: float32 (default) or float64");
}

namespace {

/// A device or a pipe, which is written through and need not have a suffix.
bool is_written_through(const std::string& target) {
  std::error_code error;
  const auto status = std::filesystem::status(target, error);
  return std::filesystem::is_other(status);
}

}  // namespace

MapFormat StorageOptions::format_of(const std::string& target) const {
  std::optional<MapFormat> format = map_format_of(target);
  if (!format && is_written_through(target)) format = MapFormat::exr;
  if (!format) {
    throw UsageError(target + ": the suffix of a map is one of .exr, .pfm, .png and .npy");
  }
  if (!compression.empty() && *format != MapFormat::exr) {
    throw UsageError("--compression is for .exr, not for " + target);
  }
  if (!png_scale.empty() && *format != MapFormat::png) {
    throw UsageError("--png-scale is for .png, not for " + target);
  }
  if (!dtype.empty() && *format != MapFormat::npy) {
    throw UsageError("--dtype is for .npy, not for " + target);
  }
  return *format;
}

DepthEncoding StorageOptions::encoding_for(MapFormat format) const {
  DepthEncoding encoding;
  if (format == MapFormat::png) {
    encoding.type = DepthEncoding::Type::scaled_unorm16;
    if (!png_scale.empty()) encoding.scale = parse_number("--png-scale", png_scale);
    if (!(encoding.scale > 0)) throw UsageError("--png-scale: '" + png_scale + "' is not positive");
  }
  if (dtype == "float64") {
    encoding.type = DepthEncoding::Type::binary64;
  } else if (!dtype.empty() && dtype != "float32") {
    throw UsageError("--dtype: '" + dtype + "' is neither float32 nor float64");
  }
  return encoding;
}

WriteOptions StorageOptions::write_options(int threads) const {
  WriteOptions options;
  options.threads = threads;
  if (!compression.empty()) options.compression = compression_named(compression);
  return options;
}

std::vector<Channel> parse_channels(const std::string& list) {
  std::vector<Channel> channels;
  for (const std::string& name : split_list(list)) {
    const std::optional<Channel> channel = channel_named(name);
    if (!channel) {
      throw UsageError(
          "--channels: '" + name +
          "' is no channel; there are Z, A, Zlow, distance, id, face, object, N, P and bary");
    }
    if (std::find(channels.begin(), channels.end(), *channel) != channels.end()) {
      throw UsageError("--channels: '" + name + "' stands twice");
    }
    channels.push_back(*channel);
  }
  return channels;
}

std::uint64_t pixels_to_verify(const std::string& text) {
  if (text.empty()) return 0;
  if (text == "all") return std::numeric_limits<std::uint64_t>::max();
  return parse_count("--verify", text, 1);
}

std::size_t parts_of(Channel channel) {
  switch (channel) {
    case Channel::N:
    case Channel::P:
      return 3;
    case Channel::bary:
      return 2;
    default:
      return 1;
  }
}

}  // namespace fathom::app
