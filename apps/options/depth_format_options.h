#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "fathom/depth_format/depth_format.h"

namespace fathom::app {

/// The options that describe a depth format: --mapping, --storage, --near, --far, --c.
struct DepthFormatOptions {
  std::string mapping = "standard", storage = "float32", near, far, c;

  void add_to(CLI::App& command);
  /// Fails    UsageError, naming what exists.
  [[nodiscard]] DepthFormat format() const;
};

/// A number or "inf".
double parse_far(const std::string& option, const std::string& text);

}  // namespace fathom::app
