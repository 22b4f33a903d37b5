#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "fathom/pipeline/options.h"

namespace fathom::app {

/// The options of `--engine pipeline` and of looking into it.
class PipelineArguments {
 public:
  /// For a command that draws: `--image` and the options of the stages.
  void add_to(CLI::App& command);

  /// Adds `--depth-format --mapping --c` too where the command does not have them yet.
  void add_stages_to(CLI::App& command);

  /// The picture; empty where it is not asked for.
  std::string image;

  /// Fails    UsageError, naming the option.
  [[nodiscard]] pipeline::PipelineOptions get(const std::string& cull) const;

  /// Refuses them for other engines. Fails with UsageError, naming one.
  void expect_none() const;

 private:
  [[nodiscard]] DepthFormat depth_format() const;
  void add(CLI::App& command, const char* name, std::string& value, const char* description);

  std::string group_ = "Pipeline";
  std::string background_ = "0,0,0", shading_ = "flat", texture_, filter_ = "trilinear",
              interpolation_ = "perspective", line_ = "bresenham", scan_ = "edge-function",
              hidden_surface_ = "z-buffer", antialias_ = "none", subpixel_bits_ = "8",
              precision_ = "binary32", viewport_, depth_range_ = "0,1", scissor_,
              front_face_ = "ccw", polygon_offset_ = "0,0", opacity_ = "0.5";
  bool blend_ = false, no_blocks_ = false, no_early_depth_ = false;
  std::string own_format_, own_mapping_, own_c_;
  std::vector<CLI::Option*> options_;
  CLI::Option *format_ = nullptr, *mapping_ = nullptr, *c_ = nullptr;
};

}  // namespace fathom::app
