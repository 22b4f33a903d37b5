#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "apps/shell/command.h"
#include "fathom/depth_format/depth_format.h"

namespace fathom::app {

/// For help texts: the names in the order of the tables, with a remark behind the default:
/// "standard (default), reversed, … or log-ulrich".
std::string list_of_mappings();
std::string list_of_storages();

/// The options that describe a depth format: `--mapping --storage --near --far --c`.
struct DepthFormatOptions {
  Mapping mapping = Mapping::standard;
  Storage storage = Storage::float32;
  double near = 0;
  std::optional<double> far, c;

  void add_to(Command& command);
  /// Fails    UsageError, naming what exists.
  [[nodiscard]] DepthFormat format() const;
};

/// `--mapping` and `--c` for commands with other options for the rest. Fails with UsageError if the
/// mapping has no constant C.
void require_constant_of(Mapping mapping, const std::optional<double>& c);

/// Description of the depth format for a map's `fathom.depth_format` and for `render --stats`.
nlohmann::ordered_json json_of(const DepthFormat& format);

}  // namespace fathom::app
