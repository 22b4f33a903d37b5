#pragma once

#include <optional>
#include <string>

#include "apps/shell/command.h"
#include "fathom/image/map_files.h"
#include "fathom/triangle/options.h"

namespace fathom::app {

/// How a map is stored: `--compression --png-scale --dtype`, each only where the format has it.
struct StorageOptions {
  enum class Float { binary32, binary64 };

  std::optional<Compression> compression;  ///< of an EXR
  std::optional<double> png_scale;         ///< codes per unit of a PNG
  std::optional<Float> dtype;              ///< of an NPY

  void add_to(Command& command);
  /// The format that the suffix of `target` names; that of a device or a pipe is EXR. Fails with
  /// UsageError where there is none, or an option does not belong to it.
  [[nodiscard]] MapFormat format_of(const std::string& target) const;
  [[nodiscard]] DepthEncoding encoding_for(MapFormat format) const;
  [[nodiscard]] WriteOptions write_options(int threads) const;
};

}  // namespace fathom::app
