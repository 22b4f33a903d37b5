#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/shell/command.h"
#include "fathom/pipeline/options.h"
#include "fathom/rendering/options.h"

/// The pipeline's options on the command line. Parsers of words fail with UsageError, naming the
/// accepted words.
namespace fathom::app {

pipeline::Shading parse_shading(const std::string& text);
pipeline::TextureFilter parse_filter(const std::string& text);
pipeline::Interpolation parse_interpolation(const std::string& text);
pipeline::WireLine parse_line(const std::string& text);
pipeline::ScanConversion parse_scan(const std::string& text);
pipeline::HiddenSurface parse_hidden_surface(const std::string& text);
pipeline::Precision parse_precision(const std::string& text);
pipeline::FrontFace parse_front_face(const std::string& text);
pipeline::SurfaceColours parse_surface_colours(const std::string& text);
pipeline::NormalSource parse_normal_source(const std::string& text);

pipeline::SpecularModel parse_specular_model(const std::string& text);
/// "X,Y,Z" in the world, "headlight" or "shoulder"
pipeline::LightSource parse_light(const std::string& text);
/// "AMBIENT,DIFFUSE,SPECULAR,SHININESS"; the model of highlights is still the default.
pipeline::Material parse_material(const std::string& text);

/// "msaa:4"
pipeline::Antialias parse_antialias(const std::string& text);
pipeline::BlendDepth parse_blend_depth(const std::string& text);
/// "random:7"; without a number the seed is 0
std::pair<pipeline::DrawOrder, std::uint64_t> parse_draw_order(const std::string& text);
/// "X,Y,W,H"
std::optional<pipeline::WindowRectangle> parse_rectangle(const std::string& text);
/// "R,G,B" from 0 to 1
pipeline::Colour parse_colour(const std::string& text);

/// The options of the pipeline's stages, for `render --engine pipeline` and `pipeline trace`,
/// except options that other commands have too (culling, the depth format). Needs only the option
/// types of the pipeline.
class PipelineArguments {
 public:
  /// Declares the options below a heading of the help.
  void add_to(Command& command, const std::string& heading);
  /// Options that affect a single primitive and the pixels that it is drawn into.
  void add_to_trace(Command& command, const std::string& heading);

  /// Sets the background of the picture; the command has an option for it.
  void set_background(const pipeline::Colour& colour) { stages_.background = colour; }

  /// The requested stages, with the default depth format.
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
  /// Refuses options without effect in this shading.
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
