#include "apps/options/storage_options.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>

#include "apps/shell/failures.h"
#include "apps/shell/output_file.h"
#include "apps/shell/values.h"
#include "fathom/failures/errors.h"
#include "fathom/image/surface.h"
#include "fathom/rendering/options.h"
#include "fathom/text/counted.h"

namespace fathom::app {
namespace {

Compression parse_compression(const std::string& text) {
  if (text == "pxr24" || text == "b44" || text == "b44a" || text == "dwaa" || text == "dwab") {
    throw UsageError("'" + text + "' is lossy; lossless are " + joined(names_of(all_compressions)));
  }
  return parse_enumerator(text, all_compressions);
}

/// Whether it is `none`.
bool parse_beyond(const std::string& text) {
  return parse_word<bool>(text, {{"error", false}, {"none", true}});
}

StoredType parse_dtype(const std::string& text) {
  return parse_enumerator(text, std::array{StoredType::binary32, StoredType::binary64});
}

int parse_normal_bits(const std::string& text) {
  return parse_word<int>(text, {{"8", 8}, {"16", 16}});
}

NormalAxes parse_axes(const std::string& text) {
  return parse_enumerator(text, all_normal_axes);
}

/// "Z=Y,distance=D"
std::vector<ChannelName> parse_channel_names(const std::string& text) {
  std::vector<ChannelName> names;
  for (const std::string& part : parse_list(text)) {
    const std::size_t middle = part.find('=');
    if (middle == std::string::npos) {
      throw UsageError("'" + part + "' is not a channel and its name, as Z=Y is");
    }
    names.push_back({part.substr(0, middle), part.substr(middle + 1)});
  }
  return names;
}

constexpr const char* no_sidecar =
    "--png-sidecar is for depths and numbers, not for masks and normals";

/// Whether `name` is one of the parts of a channel: "N.X" of "N".
bool is_part(const std::string& name, const std::string& channel) {
  const auto whole = channel_named(channel);
  return whole && std::ranges::count(part_names(*whole), name) > 0;
}

}  // namespace

bool StoredContents::are_normals() const {
  if (is_mask || channels.size() != 1) return false;
  const auto channel = channel_named(channels.front());
  return channel && description_of(*channel).kind == ChannelKind::direction;
}

StoredContents contents_of(const std::vector<Channel>& channels, bool is_mask) {
  StoredContents contents{{}, is_mask};
  for (const Channel channel : channels)
    contents.channels.emplace_back(description_of(channel).name);
  return contents;
}

double parse_background(const std::string& text) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (text == "+inf") return infinity;
  return parse_number_or(
      text, {{"0", 0}, {"nan", std::numeric_limits<double>::quiet_NaN()}, {"inf", infinity}});
}

void StorageOptions::add_to(Command& command) {
  command.option("--compression", "NAME", into(compression, parse_compression),
                 "Compression of an EXR, lossless: zip (default), zips, rle, piz or none");
  command.option("--png-scale", "N", into(png_scale, parse_scale),
                 "Codes per unit of a PNG (default 1000)");
  add_beyond_to(command);
  command.flag("--png-sidecar", png_sidecar,
               "Write a JSON file next to a PNG that states the meaning of its codes");
  command.option("--normal-bits", "N", into(normal_bits, parse_normal_bits),
                 "Bits of each colour of a PNG of normals: 8 (default) or 16");
  command.option("--normal-axes", "NAME", into(normal_axes, parse_axes),
                 "Axes of channel Nc in a PNG: opencv (default; x right, y down, z forward) or "
                 "opengl (x right, y up, z backward)");
  command.option("--dtype", "NAME", into(dtype, parse_dtype),
                 "Number type of an NPY or NPZ: float32 (default) or float64");
  command.option(
      "--channel-name", "NAME=AS", into(channel_names, parse_channel_names),
      "Rename channels in an EXR or NPZ, e.g. Z=Y,distance=D. OpenCV shows zeros for Z: give it "
      "'--channels Z --channel-name Z=Y --background 0'");
}

void StorageOptions::add_beyond_to(Command& command) {
  command.option("--png-beyond", "NAME", into(png_beyond_is_none, parse_beyond),
                 "What to do with depths that exceed a 16-bit PNG: error (default), or none (store "
                 "0, like background, and report how many)");
}

MapFormat StorageOptions::format_of(const std::string& target) const {
  std::optional<MapFormat> format = map_format_of(target);
  if (!format && is_written_through(target)) format = MapFormat::exr;
  if (!format) {
    throw UsageError(target + ": the suffix of a map is one of " + suffixes_of_maps(" and "));
  }
  if (compression && *format != MapFormat::exr) {
    throw UsageError("--compression is for .exr, not for " + target);
  }
  check_png_options(target, *format);
  if (dtype && *format != MapFormat::npy && *format != MapFormat::npz) {
    throw UsageError("--dtype is for .npy and .npz, not for " + target);
  }
  if (!channel_names.empty() && !keeps_all_channels(*format)) {
    throw UsageError("--channel-name is for " + suffixes_of_complete_maps() +
                     ": no channel has a name in " + target);
  }
  if (background && *background != 0 && has_zero_for_none(*format)) {
    throw UsageError("--background: it is always 0 in a " +
                     std::string(description_of(*format).suffixes[0]) + ", which " + target +
                     " is");
  }
  return *format;
}

void StorageOptions::check_png_options(const std::string& target, MapFormat format) const {
  if (format == MapFormat::png) return;
  const char* given = png_scale            ? "--png-scale"
                      : png_beyond_is_none ? "--png-beyond"
                      : png_sidecar        ? "--png-sidecar"
                      : normal_bits        ? "--normal-bits"
                      : normal_axes        ? "--normal-axes"
                                           : nullptr;
  if (given != nullptr) throw UsageError(std::string(given) + " is for .png, not for " + target);
}

void StorageOptions::check_pictures(const std::string& target, MapFormat format,
                                    const StoredContents& contents) const {
  if (contents.is_mask && format != MapFormat::png) {
    throw UsageError(target + ": a mask is an 8-bit PNG, 255 where a surface is; expected .png");
  }
  if (png_sidecar && (contents.is_mask || contents.are_normals())) {
    throw UsageError(no_sidecar);
  }
  if (!contents.are_normals() && (normal_bits || normal_axes)) {
    throw UsageError("--normal-bits and --normal-axes are for a PNG of N, Nc or Ns");
  }
  if (normal_axes == NormalAxes::opengl && contents.channels.front() != "Nc") {
    throw UsageError("--normal-axes opengl is for Nc, normals in the camera's frame, not for " +
                     contents.channels.front());
  }
}

StorageOptions StorageOptions::fitting(const std::string& target,
                                       const StoredContents& contents) const {
  StorageOptions fit = *this;
  if (contents.is_mask || contents.are_normals()) fit.png_sidecar = false;
  if (!contents.are_normals()) fit.normal_bits.reset();
  if (!contents.are_normals() || contents.channels.front() != "Nc") fit.normal_axes.reset();
  std::erase_if(fit.channel_names, [&](const ChannelName& name) {
    return std::ranges::none_of(contents.channels, [&](const std::string& channel) {
      return name.channel == channel || is_part(name.channel, channel);
    });
  });
  const std::optional<MapFormat> format = map_format_of(target);
  if (!format) return fit;
  if (*format != MapFormat::exr) fit.compression.reset();
  if (*format != MapFormat::png) {
    fit.png_scale.reset();
    fit.png_beyond_is_none.reset();
    fit.png_sidecar = false;
    fit.normal_bits.reset();
    fit.normal_axes.reset();
  }
  if (*format != MapFormat::npy && *format != MapFormat::npz) fit.dtype.reset();
  if (!keeps_all_channels(*format)) fit.channel_names.clear();
  if (has_zero_for_none(*format)) fit.background.reset();
  return fit;
}

void StorageOptions::require_effect(const std::vector<std::string>& targets,
                                    const std::vector<StorageOptions>& fitted) const {
  require_formats(targets);
  const auto none = [&](const auto& has) { return std::ranges::none_of(fitted, has); };
  if (png_sidecar && none(&StorageOptions::png_sidecar)) throw UsageError(no_sidecar);
  if (normal_bits && none([](const StorageOptions& fit) { return fit.normal_bits.has_value(); })) {
    throw UsageError("--normal-bits is for a PNG of N, Nc or Ns, and no output is one");
  }
  if (normal_axes && none([](const StorageOptions& fit) { return fit.normal_axes.has_value(); })) {
    throw UsageError("--normal-axes is for a PNG of Nc, and no output is one");
  }
  for (const ChannelName& name : channel_names) {
    const auto renames = [&](const StorageOptions& fit) {
      return std::ranges::find(fit.channel_names, name.channel, &ChannelName::channel) !=
             fit.channel_names.end();
    };
    if (!none(renames)) continue;
    throw UsageError(fmt::format("--channel-name: no {} of the outputs has a channel '{}'",
                                 suffixes_of_complete_maps(" or "), name.channel));
  }
}

/// For each option, some output has a format that has it.
void StorageOptions::require_formats(const std::vector<std::string>& targets) const {
  std::array<StorageOptions, 9> alone;
  alone[0].compression = compression;
  alone[1].png_scale = png_scale;
  alone[2].png_beyond_is_none = png_beyond_is_none;
  alone[3].png_sidecar = png_sidecar;
  alone[4].dtype = dtype;
  alone[5].channel_names = channel_names;
  alone[6].normal_bits = normal_bits;
  alone[7].normal_axes = normal_axes;
  alone[8].background = background;
  for (const StorageOptions& option : alone) {
    const auto takes = [&](const std::string& target) {
      try {
        (void)option.format_of(target);
        return true;
      } catch (const UsageError&) {
        return false;
      }
    };
    // The error of the first is that of a single output.
    if (std::ranges::none_of(targets, takes)) (void)option.format_of(targets.front());
  }
}

DepthEncoding StorageOptions::encoding_for(MapFormat format) const {
  DepthEncoding encoding;
  if (format == MapFormat::png) {
    encoding.type = DepthEncoding::Type::scaled_unorm16;
    encoding.scale = png_scale.value_or(encoding.scale);
    encoding.beyond_is_none = png_beyond_is_none.value_or(false);
  }
  if (dtype == StoredType::binary64) encoding.type = DepthEncoding::Type::binary64;
  return encoding;
}

DepthMap StorageOptions::dressed(DepthMap map, const std::string& target,
                                 std::optional<double> now) const {
  if (background && !map.png_scale) {
    map = about_output(target, [&] {
      return about_option("--background",
                          [&] { return with_background(std::move(map), *background, now); });
    });
  }
  if (channel_names.empty()) return map;
  return about_option("--channel-name",
                      [&] { return with_channel_names(std::move(map), channel_names); });
}

std::string StorageOptions::sidecar_of(const std::string& target) const {
  if (!png_sidecar) return "";
  return std::filesystem::path(target).replace_extension(".json");
}

void warn_of_codes_beyond(const DepthMap& map, const std::string& target, const Console& console) {
  if (map.codes_beyond.value_or(0) == 0) return;
  const std::size_t pixels = std::size_t{map.width} * map.height;
  console.warn(fmt::format("{}: {} of {} {} deeper than {} and {} stored as 0", target,
                           *map.codes_beyond, text::counted(pixels, "pixel"),
                           *map.codes_beyond == 1 ? "lies" : "lie", 65535 / *map.png_scale,
                           *map.codes_beyond == 1 ? "is" : "are"));
}

WriteOptions StorageOptions::write_options(int threads) const {
  WriteOptions options;
  options.threads = threads;
  options.compression = compression.value_or(options.compression);
  options.normals.bits = normal_bits.value_or(options.normals.bits);
  options.normals.axes = normal_axes.value_or(options.normals.axes);
  return options;
}

}  // namespace fathom::app
