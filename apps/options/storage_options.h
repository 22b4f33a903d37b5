#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/shell/command.h"
#include "apps/shell/console.h"
#include "fathom/image/channel_table.h"
#include "fathom/image/files/renamed_channels.h"
#include "fathom/image/map_files.h"
#include "fathom/rendering/options.h"

namespace fathom::app {

/// The contents of a file, for options that suit some contents only.
struct StoredContents {
  /// As users name them: "Z", "N".
  std::vector<std::string> channels;
  /// Whether the file is the mask of a map.
  bool is_mask = false;

  /// Whether a PNG has them as its colours.
  [[nodiscard]] bool are_normals() const;
};

StoredContents contents_of(const std::vector<Channel>& channels, bool is_mask);

/// How a map is stored: `--compression --png-scale --png-beyond --png-sidecar --normal-bits
/// --normal-axes --dtype --channel-name`, each only where the format has it, and `--background`,
/// which the command declares.
struct StorageOptions {
  std::optional<Compression> compression;  ///< of an EXR
  std::optional<double> png_scale;         ///< codes per unit of a PNG
  std::optional<bool> png_beyond_is_none;  ///< whether depths beyond a PNG's codes become 0
  bool png_sidecar = false;                ///< whether a JSON file describes the codes of a PNG
  std::optional<StoredType> dtype;         ///< of an NPY or NPZ: binary32 or binary64
  std::optional<double> background;        ///< of depth channels
  std::vector<ChannelName> channel_names;  ///< of an EXR or NPZ
  std::optional<int> normal_bits;          ///< of a PNG of normals
  std::optional<NormalAxes> normal_axes;   ///< of a PNG of channel Nc

  void add_to(Command& command);
  /// Only `--png-beyond`, for commands whose layout fixes the rest.
  void add_beyond_to(Command& command);
  /// The format of the suffix of `target`; EXR for a device or a pipe. Fails with UsageError if no
  /// format has this suffix, or an option does not apply to the format.
  [[nodiscard]] MapFormat format_of(const std::string& target) const;
  /// Refuses a mask that is no PNG, and options that do not suit the contents of `target`, a file
  /// of this format that format_of() accepts. Fails with UsageError.
  void check_pictures(const std::string& target, MapFormat format,
                      const StoredContents& contents) const;
  /// The options that suit the format and the contents of `target`, for one of several outputs.
  [[nodiscard]] StorageOptions fitting(const std::string& target,
                                       const StoredContents& contents) const;
  /// `fitted` are the options that suit each of several outputs, as fitting() returns them. Fails
  /// with UsageError where an option applies to no output.
  void require_effect(const std::vector<std::string>& targets,
                      const std::vector<StorageOptions>& fitted) const;
  [[nodiscard]] DepthEncoding encoding_for(MapFormat format) const;
  [[nodiscard]] WriteOptions write_options(int threads) const;
  /// Applies --background and --channel-name to a map that will be written as `target`; `now` is
  /// its current background, if known. Fails with OutputError, naming the target, or UsageError,
  /// naming the option.
  [[nodiscard]] DepthMap dressed(DepthMap map, const std::string& target,
                                 std::optional<double> now = std::nullopt) const;
  [[nodiscard]] bool has_png_options() const {
    return png_scale || png_beyond_is_none || png_sidecar || normal_bits || normal_axes;
  }
  /// Path of the JSON file of a PNG: map.json next to map.png; empty if it is not requested.
  [[nodiscard]] std::string sidecar_of(const std::string& target) const;

 private:
  void check_png_options(const std::string& target, MapFormat format) const;
  void require_formats(const std::vector<std::string>& targets) const;
};

/// Reports the number of surfaces of a map, written as `target`, that lie beyond its codes, unless
/// it is 0.
void warn_of_codes_beyond(const DepthMap& map, const std::string& target, const Console& console);

/// "0", "nan", "inf" or a number. Fails with UsageError.
double parse_background(const std::string& text);

}  // namespace fathom::app
