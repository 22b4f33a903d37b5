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
  /// Those options that the format of `target` has, for one of several outputs.
  [[nodiscard]] StorageOptions fitting(const std::string& target) const;
  /// Fails with UsageError where an option applies to none of several outputs.
  void require_effect(const std::vector<std::string>& targets) const;
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
};

/// Reports the number of surfaces of a map, written as `target`, that lie beyond its codes, unless
/// it is 0.
void warn_of_codes_beyond(const DepthMap& map, const std::string& target, const Console& console);

/// "0", "nan", "inf" or a number. Fails with UsageError.
double parse_background(const std::string& text);

}  // namespace fathom::app
