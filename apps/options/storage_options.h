#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/shell/command.h"
#include "apps/shell/console.h"
#include "fathom/image/channel_names.h"
#include "fathom/image/map_files.h"
#include "fathom/rendering/options.h"

namespace fathom::app {

/// How a map is stored: `--compression --png-scale --png-beyond --png-sidecar --dtype
/// --channel-name`, each only where the format has it, and `--background`, which the command
/// declares.
struct StorageOptions {
  std::optional<Compression> compression;  ///< of an EXR
  std::optional<double> png_scale;         ///< codes per unit of a PNG
  std::optional<bool> png_beyond_is_none;  ///< whether what is too deep for a PNG's codes gets 0
  bool png_sidecar = false;          ///< whether a JSON file beside a PNG says what codes mean
  std::optional<StoredType> dtype;   ///< of an NPY or NPZ: binary32 or binary64
  std::optional<double> background;  ///< of depth channels
  std::vector<ChannelName> channel_names;  ///< of an EXR or NPZ

  void add_to(Command& command);
  /// `--png-beyond` alone, for commands that know all else.
  void add_beyond_to(Command& command);
  /// The format that the suffix of `target` names; that of a device or a pipe is EXR. Fails with
  /// UsageError where there is none, or an option does not belong to it.
  [[nodiscard]] MapFormat format_of(const std::string& target) const;
  [[nodiscard]] DepthEncoding encoding_for(MapFormat format) const;
  [[nodiscard]] WriteOptions write_options(int threads) const;
  /// Applies --background and --channel-name to a map that will be written as `target`; `now` is
  /// its current background, if known. Fails with OutputError, naming the target, or UsageError,
  /// naming the option.
  [[nodiscard]] DepthMap dressed(DepthMap map, const std::string& target,
                                 std::optional<double> now = std::nullopt) const;
  [[nodiscard]] bool has_png_options() const {
    return png_scale || png_beyond_is_none || png_sidecar;
  }
  /// Where the JSON file of a PNG goes: map.json beside map.png; empty where none was asked for.
  [[nodiscard]] std::string sidecar_of(const std::string& target) const;

 private:
  void check_png_options(const std::string& target, MapFormat format) const;
};

/// Says how many surfaces of a map, written as `target`, lie beyond its codes, where there are
/// some.
void warn_of_codes_beyond(const DepthMap& map, const std::string& target, const Console& console);

/// "0", "nan", "inf" or a number. Fails with UsageError.
double parse_background(const std::string& text);

}  // namespace fathom::app
