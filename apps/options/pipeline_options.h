#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/shell/command.h"
#include "fathom/pipeline/options.h"
#include "fathom/rendering/options.h"

namespace fathom::app {

/// The options of the pipeline's stages, for `render --engine pipeline` and `pipeline trace`,
/// except options that other commands have too (culling, the depth format). Needs only the option
/// types of the pipeline.
class PipelineArguments {
 public:
  /// Declares the options below a heading of the help.
  void add_to(Command& command, const std::string& heading);
  /// Options that affect a single primitive and the pixels that it is drawn into.
  void add_to_trace(Command& command, const std::string& heading);

  /// Of the picture; the command has an option for it.
  void set_background(const pipeline::Colour& colour) { stages_.background = colour; }

  /// The stages as they were asked for; the depth format is still the default.
  [[nodiscard]] pipeline::PipelineOptions options(Cull cull) const;

  /// Value of --normals, which also applies to channel Ns of the exact engines.
  [[nodiscard]] NormalSource normals() const { return stages_.normals_from; }

  /// All that add_to() declared.
  [[nodiscard]] const std::vector<Option>& declared() const { return declared_; }

 private:
  void add_triangle_options(Command& command);
  void add_window_options(Command& command);
  void add_line_option(Command& command);
  void add_scan_option(Command& command);
  void add_hidden_surface_option(Command& command);
  void add_antialias_option(Command& command);
  void add_merging_options(Command& command);
  void add_shortcut_options(Command& command);
  /// Refuses what would change nothing in this shading.
  void require_effect(pipeline::Shading shading) const;

  pipeline::PipelineOptions stages_;
  pipeline::SpecularModel highlight_ = pipeline::SpecularModel::blinn;
  std::optional<double> opacity_;
  std::optional<pipeline::TextureFilter> filter_;
  std::pair<pipeline::DrawOrder, std::uint64_t> order_{};
  bool blend_ = false, no_blocks_ = false, no_early_depth_ = false;
  std::vector<Option> declared_;
};

}  // namespace fathom::app
