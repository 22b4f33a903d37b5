#include "apps/options/pipeline_options.h"

#include <fmt/core.h>

#include <algorithm>
#include <initializer_list>
#include <string_view>

#include "apps/shell/values.h"
#include "fathom/failures/errors.h"
#include "fathom/rendering/options.h"

namespace fathom::app {

using namespace pipeline;

Shading parse_shading(const std::string& text) {
  return parse_word<Shading>(text, {{"none", Shading::none},
                                    {"points", Shading::points},
                                    {"wireframe", Shading::wireframe},
                                    {"flat", Shading::flat},
                                    {"gouraud", Shading::gouraud},
                                    {"phong", Shading::phong}});
}

TextureFilter parse_filter(const std::string& text) {
  return parse_word<TextureFilter>(text, {{"nearest", TextureFilter::nearest},
                                          {"bilinear", TextureFilter::bilinear},
                                          {"trilinear", TextureFilter::trilinear},
                                          {"anisotropic", TextureFilter::anisotropic}});
}

Interpolation parse_interpolation(const std::string& text) {
  return parse_word<Interpolation>(
      text, {{"affine", Interpolation::affine}, {"perspective", Interpolation::perspective}});
}

WireLine parse_line(const std::string& text) {
  return parse_word<WireLine>(text, {{"explicit", WireLine::explicit_equation},
                                     {"dda", WireLine::dda},
                                     {"bresenham", WireLine::bresenham},
                                     {"midpoint", WireLine::midpoint},
                                     {"diamond-exit", WireLine::diamond_exit}});
}

ScanConversion parse_scan(const std::string& text) {
  return parse_word<ScanConversion>(text, {{"edge-function", ScanConversion::edge_function},
                                           {"scan-line", ScanConversion::scan_line}});
}

HiddenSurface parse_hidden_surface(const std::string& text) {
  return parse_word<HiddenSurface>(
      text, {{"z-buffer", HiddenSurface::z_buffer}, {"painter", HiddenSurface::painter}});
}

Precision parse_precision(const std::string& text) {
  return parse_word<Precision>(
      text, {{"binary32", Precision::binary32}, {"binary64", Precision::binary64}});
}

FrontFace parse_front_face(const std::string& text) {
  return parse_word<FrontFace>(
      text, {{"ccw", FrontFace::counter_clockwise}, {"cw", FrontFace::clockwise}});
}

SurfaceColours parse_surface_colours(const std::string& text) {
  return parse_word<SurfaceColours>(text, {{"file", SurfaceColours::file},
                                           {"object", SurfaceColours::object},
                                           {"triangle", SurfaceColours::triangle}});
}

NormalSource parse_normal_source(const std::string& text) {
  return parse_enumerator(text, all_normal_sources);
}

BlendDepth parse_blend_depth(const std::string& text) {
  return parse_word<BlendDepth>(
      text,
      {{"off", BlendDepth::off}, {"on", BlendDepth::on}, {"read-only", BlendDepth::read_only}});
}

std::pair<DrawOrder, std::uint64_t> parse_draw_order(const std::string& text) {
  if (text.starts_with("random:")) return {DrawOrder::random, parse_count(text.substr(7))};
  return {parse_word<DrawOrder>(text, {{"file", DrawOrder::file},
                                       {"front-to-back", DrawOrder::front_to_back},
                                       {"back-to-front", DrawOrder::back_to_front},
                                       {"random", DrawOrder::random}}),
          0};
}

SpecularModel parse_specular_model(const std::string& text) {
  return parse_word<SpecularModel>(
      text, {{"blinn", SpecularModel::blinn}, {"phong", SpecularModel::phong}});
}

LightSource parse_light(const std::string& text) {
  if (text.find(',') != std::string::npos) return {.towards = parse_vector(text), .in_world = true};
  return parse_word<LightSource>(text, {{"shoulder", {}}, {"headlight", {.towards = {0, 0, -1}}}},
                                 "a direction X,Y,Z");
}

Material parse_material(const std::string& text) {
  const std::vector<std::string> parts = parse_list(text);
  if (parts.size() != 4) {
    throw UsageError(fmt::format(
        "'{}' is not AMBIENT,DIFFUSE,SPECULAR,SHININESS, as in 0.15,0.75,0.25,40", text));
  }
  return {.ambient = parse_number(parts[0]),
          .diffuse = parse_number(parts[1]),
          .specular = parse_number(parts[2]),
          .shininess = parse_number(parts[3])};
}

namespace {

/// "THRESHOLD", "THRESHOLD,LEAST" or "THRESHOLD,LEAST,SUBPIXEL"; the pipeline checks their range.
FxaaSettings parse_fxaa(const std::string& text) {
  const std::vector<std::string> parts = parse_list(text);
  if (parts.empty() || parts.size() > 3) {
    throw UsageError(fmt::format(
        "'fxaa:{}' is not fxaa:THRESHOLD,LEAST,SUBPIXEL, as in fxaa:0.125,0.0625,0.75", text));
  }
  FxaaSettings settings;
  double* const values[] = {&settings.threshold, &settings.least_threshold, &settings.subpixel};
  for (std::size_t i = 0; i < parts.size(); ++i) *values[i] = parse_number(parts[i]);
  return settings;
}

/// N of "msaa:N".
int parse_number_of(const std::string& text, const std::string& number) {
  if (number.empty() || number.find_first_not_of("0123456789") != std::string::npos)
    throw UsageError(fmt::format("'{}' needs a whole number, as in msaa:4", text));
  return static_cast<int>(
      std::min<std::size_t>(1000, number.size() > 4 ? 1000 : std::stoul(number)));
}

}  // namespace

Antialias parse_antialias(const std::string& text) {
  const auto colon = text.find(':');
  Antialias antialias;
  antialias.method = parse_word<AntialiasMethod>(
      text.substr(0, colon), {{"none", AntialiasMethod::none},
                              {"ssaa", AntialiasMethod::ssaa},
                              {"msaa", AntialiasMethod::msaa},
                              {"jitter", AntialiasMethod::jitter},
                              {"area", AntialiasMethod::area},
                              {"fxaa", AntialiasMethod::fxaa},
                              {"taa", AntialiasMethod::taa},
                              {"temporal", AntialiasMethod::temporal},
                              {"temporal-area", AntialiasMethod::temporal_area}});
  if (antialias.method == AntialiasMethod::fxaa && colon != std::string::npos) {
    antialias.fxaa = parse_fxaa(text.substr(colon + 1));
    return antialias;
  }
  const bool counts =
      antialias.method == AntialiasMethod::ssaa || antialias.method == AntialiasMethod::msaa ||
      antialias.method == AntialiasMethod::jitter || antialias.method == AntialiasMethod::taa ||
      antialias.method == AntialiasMethod::temporal ||
      antialias.method == AntialiasMethod::temporal_area;
  if (counts != (colon != std::string::npos)) {
    throw UsageError(
        fmt::format("'{}' {}", text, counts ? "needs a number, as in msaa:4" : "takes no number"));
  }
  if (text == "msaa:rotated-grid") {
    antialias.count = 4;
    antialias.rotated_grid = true;
  } else if (counts) {
    antialias.count = parse_number_of(text, text.substr(colon + 1));
  }
  return antialias;
}

std::optional<WindowRectangle> parse_rectangle(const std::string& text) {
  const std::vector<std::string> parts = parse_list(text);
  if (parts.size() != 4) {
    throw UsageError(
        fmt::format("'{}' is not X,Y,W,H in whole pixels from the lower left corner", text));
  }
  return WindowRectangle{parse_whole(parts[0]), parse_whole(parts[1]), parse_whole(parts[2]),
                         parse_whole(parts[3])};
}

Colour parse_colour(const std::string& text) {
  const Colour colour = parse_vector(text);
  for (const double c : colour) {
    if (!(c >= 0 && c <= 1)) throw UsageError("expected R,G,B from 0 to 1, as in 0.2,0.3,0.5");
  }
  return colour;
}

namespace {

pipeline::Culling culling_of(Cull cull) {
  return cull == Cull::none   ? pipeline::Culling::none
         : cull == Cull::back ? pipeline::Culling::back
                              : pipeline::Culling::front;
}

/// The pipeline refuses numbers that are too large for an int anyway.
int parse_bits(const std::string& text) {
  return static_cast<int>(std::min(99U, parse_count(text)));
}

DepthBias parse_offset(const std::string& text) {
  const auto [factor, units] = parse_pair(text);
  return {factor, units, 0};
}

}  // namespace

void PipelineArguments::add_to(Command& command, const std::string& heading) {
  const std::size_t before = declared_.size();
  add_triangle_options(command);
  add_window_options(command);
  add_line_option(command);
  add_scan_option(command);
  add_hidden_surface_option(command);
  add_antialias_option(command);
  add_merging_options(command);
  add_shortcut_options(command);
  for (std::size_t i = before; i < declared_.size(); ++i) declared_[i].below(heading);
}

void PipelineArguments::add_to_trace(Command& command, const std::string& heading) {
  const std::size_t before = declared_.size();
  add_triangle_options(command);
  add_window_options(command);
  add_line_option(command);
  add_hidden_surface_option(command);
  add_merging_options(command);
  for (std::size_t i = before; i < declared_.size(); ++i) declared_[i].below(heading);
}

void PipelineArguments::add_triangle_options(Command& command) {
  declared_.push_back(
      command.option("--shading", "NAME", into(stages_.shading, parse_shading),
                     "Shading: none, points, wireframe (lines in the colours of the vertices, else "
                     "white), flat (default), gouraud or phong"));
  declared_.push_back(
      command.option("--normals", "NAME", into(stages_.normals_from, parse_normal_source),
                     "Normals, also of channel Ns: file (default; vertex if the file has none), "
                     "vertex (summed over the triangles at each vertex) or place (summed where "
                     "vertices coincide, so that no seam shows)"));
  declared_.push_back(
      command.option("--colours", "NAME", into(stages_.colours, parse_surface_colours),
                     "Colours of triangles: file (default; colours of the vertices, else white), "
                     "object or triangle (a colour for each number)"));
  declared_.push_back(
      command.option("--light", "WHERE", into(stages_.light, parse_light),
                     "Direction of the light: X,Y,Z in the world; headlight, from the camera; or "
                     "shoulder (default), from above the camera's left shoulder"));
  declared_.push_back(command.option(
      "--material", "A,D,S,N", into(stages_.material, parse_material),
      "Ambient, diffuse and specular reflection, and shininess (default 0.15,0.75,0.25,40)"));
  declared_.push_back(
      command.option("--specular-model", "NAME", into(highlight_, parse_specular_model),
                     "Highlights: blinn (default; halfway vector) or phong (mirrored light)"));
  declared_.push_back(
      command.option("--texture", "PNG", stages_.texture, "Texture: checker, or a PNG file"));
  command.offer(declared_.back(), {"checker"});
  declared_.push_back(command.option(
      "--filter", "NAME", into(filter_, parse_filter),
      "Filter of the texture: nearest, bilinear, trilinear (default) or anisotropic"));
  declared_.push_back(command.option("--interpolation", "NAME",
                                     into(stages_.interpolation, parse_interpolation),
                                     "Interpolation: perspective (default) or affine"));
  declared_.push_back(
      command.option("--subpixel-bits", "N", into(stages_.subpixel_bits, parse_bits),
                     "Snap corners to 2^N positions per pixel, 0 to 16 (default 8)"));
  declared_.push_back(command.option("--precision", "NAME",
                                     into(stages_.precision, parse_precision),
                                     "Arithmetic: binary32 (default) or binary64"));
}

void PipelineArguments::add_line_option(Command& command) {
  declared_.push_back(command.option("--line", "NAME", into(stages_.wire_line, parse_line),
                                     "Line algorithm for wireframes and lines in files: explicit, "
                                     "dda, bresenham (default), midpoint or diamond-exit"));
}

void PipelineArguments::add_scan_option(Command& command) {
  declared_.push_back(command.option("--scan", "NAME", into(stages_.scan, parse_scan),
                                     "Fill algorithm: edge-function (default) or scan-line"));
}

void PipelineArguments::add_hidden_surface_option(Command& command) {
  declared_.push_back(command.option("--hidden-surface", "NAME",
                                     into(stages_.hidden_surface, parse_hidden_surface),
                                     "Visibility algorithm: z-buffer (default) or painter"));
}

void PipelineArguments::add_antialias_option(Command& command) {
  declared_.push_back(
      command.option("--antialias", "NAME", into(stages_.antialias, parse_antialias),
                     "Antialiasing: none (default), ssaa:N (N times N), msaa:N, msaa:rotated-grid, "
                     "jitter:N, area, fxaa, fxaa:THRESHOLD[,LEAST[,SUBPIXEL]], taa:N; for moving "
                     "scenes temporal:N or temporal-area:N"));
}

void PipelineArguments::add_window_options(Command& command) {
  declared_.push_back(command.option(
      "--viewport", "X,Y,W,H", into(stages_.viewport, parse_rectangle),
      "Viewport X,Y,W,H in pixels, from the lower left corner (default: the image)"));
  declared_.push_back(command.option("--depth-range", "A,B", into(stages_.depth_range, parse_pair),
                                     "Window depths A,B of near and far (default 0,1)"));
  declared_.push_back(
      command.option("--scissor", "X,Y,W,H", into(stages_.scissor, parse_rectangle),
                     "Scissor rectangle X,Y,W,H in pixels, from the lower left corner"));
  declared_.push_back(command.option("--front-face", "NAME",
                                     into(stages_.front_face, parse_front_face),
                                     "Winding of front faces: ccw (default) or cw"));
  declared_.push_back(command.option("--polygon-offset", "FACTOR,UNITS",
                                     into(stages_.polygon_offset, parse_offset),
                                     "Depth offset FACTOR,UNITS (default 0,0)"));
}

void PipelineArguments::add_merging_options(Command& command) {
  declared_.push_back(command.option("--opacity", "ALPHA", into(opacity_, parse_number),
                                     "Opacity with --blend, 0 to 1 (default 0.5)"));
  declared_.push_back(command.flag(
      "--blend", blend_, "Blend every fragment over the picture, in the order of the triangles"));
  declared_.push_back(command.option(
      "--blend-depth", "NAME", into(stages_.blend_depth, parse_blend_depth),
      "Depth test of --blend: off (default), on, or read-only (blended fragments write no depth)"));
  declared_.push_back(command.option("--draw-order", "NAME", into(order_, parse_draw_order),
                                     "Order of the triangles: file (default), front-to-back, "
                                     "back-to-front, random or random:SEED"));
}

void PipelineArguments::add_shortcut_options(Command& command) {
  declared_.push_back(
      command.flag("--no-blocks", no_blocks_, "Test every sample; the picture does not change"));
  declared_.push_back(command.flag("--no-early-depth", no_early_depth_,
                                   "Shade before the depth test; the picture does not change"));
}

void PipelineArguments::require_effect(pipeline::Shading shading) const {
  using pipeline::Shading;
  const bool smooth = shading == Shading::gouraud || shading == Shading::phong;
  const bool lit = smooth || shading == Shading::flat;
  const bool has_areas = lit || shading == Shading::none;
  const auto require = [&](bool has_effect, std::initializer_list<std::string_view> names,
                           const char* what_for) {
    for (const Option& option : declared_) {
      if (!has_effect && option.is_given() && std::ranges::count(names, option.name()) > 0)
        throw UsageError(option.name() + " is for --shading " + what_for);
    }
  };
  require(smooth, {"--normals"}, "gouraud and phong");
  require(lit, {"--light", "--material", "--specular-model"}, "flat, gouraud and phong");
  require(has_areas, {"--texture", "--scan"}, "none, flat, gouraud and phong");
}

pipeline::PipelineOptions PipelineArguments::options(Cull cull) const {
  require_effect(stages_.shading);
  pipeline::PipelineOptions options = stages_;
  options.culling = culling_of(cull);
  options.material.highlight = highlight_;
  options.blocks = !no_blocks_;
  options.early_depth = !no_early_depth_;
  options.draw_order = order_.first;
  options.draw_seed = order_.second;
  if (filter_ && options.texture.empty()) throw UsageError("--filter is for a --texture");
  options.filter = filter_.value_or(options.filter);
  if (!blend_ && options.blend_depth != pipeline::BlendDepth::off)
    throw UsageError("--blend-depth belongs to --blend");
  if (!blend_ && opacity_)
    throw UsageError(
        "--opacity belongs to --blend; a scene file's \"draw\" makes single objects "
        "transparent");
  if (!blend_) return options;
  options.blend_alpha = opacity_.value_or(0.5);
  if (!(*options.blend_alpha >= 0 && *options.blend_alpha <= 1))
    throw UsageError("--opacity: expected 0 to 1");
  return options;
}

}  // namespace fathom::app
