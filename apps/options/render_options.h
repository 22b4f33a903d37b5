#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "fathom/image/map_files.h"
#include "fathom/triangle/options.h"

namespace fathom::app {

/// "back", "front" or "none".
Cull cull_named(const std::string& name);
void add_cull_option(CLI::App& command, std::string& cull);

/// How a map is stored: `--compression --png-scale --dtype`, each only where the format has it.
struct StorageOptions {
  std::string compression, png_scale, dtype;

  void add_to(CLI::App& command);
  /// The format that the suffix of `target` names. Fails with UsageError where there is none, or an
  /// option does not belong to it.
  [[nodiscard]] MapFormat format_of(const std::string& target) const;
  [[nodiscard]] DepthEncoding encoding_for(MapFormat format) const;
  [[nodiscard]] WriteOptions write_options(int threads) const;
};

/// "Z,id,N" as channels. Fails with UsageError where one does not exist or stands twice.
std::vector<Channel> parse_channels(const std::string& list);
/// "1000" or "all" (the greatest number) as a number of pixels; 0 for "", nothing asked for.
std::uint64_t pixels_to_verify(const std::string& text);
/// How many channels of the file a channel of the list becomes: N and P three, bary two.
std::size_t parts_of(Channel channel);

}  // namespace fathom::app
