#include "apps/options/pipeline_words.h"

#include <fmt/core.h>

#include <algorithm>

#include "apps/shell/values.h"
#include "fathom/failures/errors.h"
#include "fathom/rendering/option_names.h"

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

}  // namespace fathom::app
