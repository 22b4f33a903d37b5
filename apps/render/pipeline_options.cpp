#include "apps/render/pipeline_options.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "apps/shell/numbers.h"
#include "fathom/numeric/errors.h"

namespace fathom::app {
namespace {

using namespace pipeline;

template <class Value>
using Names = std::initializer_list<std::pair<const char*, Value>>;

template <class Value>
Value named(const char* option, const std::string& text, Names<Value> names) {
  std::string all;
  for (const auto& [name, value] : names) {
    if (text == name) return value;
    all += (all.empty() ? "" : ", ") + std::string(name);
  }
  throw UsageError(fmt::format("{}: '{}' is unknown; there are {}", option, text, all));
}

std::int64_t parse_whole(const std::string& option, const std::string& text) {
  const double x = parse_number(option, text);
  if (x != std::floor(x) || std::abs(x) > 1e9)
    throw UsageError(fmt::format("{}: '{}' is no whole number", option, text));
  return static_cast<std::int64_t>(x);
}

std::optional<WindowRectangle> parse_rectangle(const std::string& option, const std::string& text) {
  if (text.empty()) return std::nullopt;
  const std::vector<std::string> parts = split_list(text);
  if (parts.size() != 4)
    throw UsageError(fmt::format(
        "{}: '{}' is not X,Y,W,H in whole pixels from the lower left corner", option, text));
  return WindowRectangle{parse_whole(option, parts[0]), parse_whole(option, parts[1]),
                         parse_whole(option, parts[2]), parse_whole(option, parts[3])};
}

Colour parse_colour(const std::string& text) {
  const std::array<double, 3> colour = parse_vector("--background", text);
  for (const double c : colour)
    if (!(c >= 0 && c <= 1))
      throw UsageError("--background: expected R,G,B from 0 to 1, as in 0.2,0.3,0.5");
  return colour;
}

Antialias parse_antialias(const std::string& text) {
  const auto colon = text.find(':');
  Antialias antialias;
  antialias.method = named<AntialiasMethod>("--antialias", text.substr(0, colon),
                                            {{"none", AntialiasMethod::none},
                                             {"ssaa", AntialiasMethod::ssaa},
                                             {"msaa", AntialiasMethod::msaa},
                                             {"jitter", AntialiasMethod::jitter},
                                             {"area", AntialiasMethod::area},
                                             {"fxaa", AntialiasMethod::fxaa},
                                             {"taa", AntialiasMethod::taa}});
  const bool counts =
      antialias.method == AntialiasMethod::ssaa || antialias.method == AntialiasMethod::msaa ||
      antialias.method == AntialiasMethod::jitter || antialias.method == AntialiasMethod::taa;
  if (counts != (colon != std::string::npos))
    throw UsageError(fmt::format("--antialias: '{}' {}", text,
                                 counts ? "needs a number, as in msaa:4" : "takes no number"));
  if (text == "msaa:rotated-grid") {
    antialias.count = 4;
    antialias.rotated_grid = true;
  } else if (counts) {
    antialias.count = static_cast<int>(
        std::min<std::uint32_t>(1000, parse_count("--antialias", text.substr(colon + 1))));
  }
  return antialias;
}

std::string value_of(const CLI::Option* option) {
  return option->count() == 0 ? "" : option->as<std::string>();
}

}  // namespace

void PipelineArguments::add(CLI::App& command, const char* name, std::string& value,
                            const char* description) {
  options_.push_back(command.add_option(name, value, description)->group(group_));
}

void PipelineArguments::add_to(CLI::App& command) {
  group_ = "With --engine pipeline";
  add(command, "--image", image, "Write the colour picture to this PNG");
  add_stages_to(command);
}

void PipelineArguments::add_stages_to(CLI::App& command) {
  add(command, "--background", background_, "R,G,B from 0 to 1 (default 0,0,0)");
  add(command, "--shading", shading_, "none, points, wireframe, flat (default), gouraud or phong");
  add(command, "--texture", texture_, "checker, or a PNG file");
  add(command, "--filter", filter_,
      "Of the texture: nearest, bilinear, trilinear (default) or anisotropic");
  add(command, "--interpolation", interpolation_, "perspective (default) or affine");
  add(command, "--line", line_,
      "Of a wireframe: explicit, dda, bresenham (default), midpoint or diamond-exit");
  add(command, "--scan", scan_, "edge-function (default) or scan-line");
  add(command, "--hidden-surface", hidden_surface_, "z-buffer (default) or painter");
  add(command, "--antialias", antialias_,
      "none (default), ssaa:N (N times N), msaa:N, msaa:rotated-grid, jitter:N, area, fxaa or "
      "taa:N");
  add(command, "--subpixel-bits", subpixel_bits_,
      "Corners are snapped to 2^N positions a pixel, 0 to 16 (default 8)");
  add(command, "--precision", precision_, "binary32 (default) or binary64");
  add(command, "--viewport", viewport_,
      "X,Y,W,H in pixels, from the lower left corner (default: the image)");
  add(command, "--depth-range", depth_range_, "A,B: window depths of near and far (default 0,1)");
  add(command, "--scissor", scissor_, "X,Y,W,H in pixels, from the lower left corner");
  add(command, "--front-face", front_face_, "ccw (default) or cw");
  add(command, "--polygon-offset", polygon_offset_, "FACTOR,UNITS (default 0,0)");
  add(command, "--opacity", opacity_, "Of --blend: 0 to 1 (default 0.5)");
  const auto flag = [&](const char* name, bool& value, const char* description) {
    options_.push_back(command.add_flag(name, value, description)->group(group_));
  };
  flag("--blend", blend_, "Blend every fragment over the picture, in the order of the triangles");
  flag("--no-blocks", no_blocks_, "Test every sample; the picture does not change");
  flag("--no-early-depth", no_early_depth_,
       "Shade before the depth test; the picture does not change");

  const auto find_or_add = [&](const char* name, std::string& value, const char* description) {
    CLI::Option* option = command.get_option_no_throw(name);
    if (option != nullptr) return option;
    add(command, name, value, description);
    return options_.back();
  };
  format_ = find_or_add("--depth-format", own_format_,
                        "Of the z-buffer: unorm16, unorm24, unorm32, float16, float32 (default) or "
                        "float64");
  mapping_ = find_or_add("--mapping", own_mapping_,
                         "Of the z-buffer: standard (default), reversed, infinite, "
                         "reversed-infinite, opengl, linear, w, log or log-ulrich");
  c_ = find_or_add("--c", own_c_, "Of --mapping log: the constant C (default 1)");
}

DepthFormat PipelineArguments::depth_format() const {
  DepthFormat format{Mapping::standard, Storage::float32, 0, 0, 1};
  if (const std::string text = value_of(format_); !text.empty())
    format.storage = storage_named(text);
  if (const std::string text = value_of(mapping_); !text.empty())
    format.mapping = mapping_named(text);
  if (const std::string text = value_of(c_); !text.empty()) format.c = parse_number("--c", text);
  return format;
}

PipelineOptions PipelineArguments::get(const std::string& cull) const {
  PipelineOptions o;
  o.precision =
      named<Precision>("--precision", precision_,
                       {{"binary32", Precision::binary32}, {"binary64", Precision::binary64}});
  o.depth_format = depth_format();
  o.viewport = parse_rectangle("--viewport", viewport_);
  o.scissor = parse_rectangle("--scissor", scissor_);
  o.depth_range = parse_pair("--depth-range", depth_range_);
  o.culling =
      named<Culling>("--cull", cull,
                     {{"none", Culling::none}, {"back", Culling::back}, {"front", Culling::front}});
  o.front_face =
      named<FrontFace>("--front-face", front_face_,
                       {{"ccw", FrontFace::counter_clockwise}, {"cw", FrontFace::clockwise}});
  o.subpixel_bits =
      static_cast<int>(std::min<std::uint32_t>(99, parse_count("--subpixel-bits", subpixel_bits_)));
  o.scan = named<ScanConversion>(
      "--scan", scan_,
      {{"edge-function", ScanConversion::edge_function}, {"scan-line", ScanConversion::scan_line}});
  o.blocks = !no_blocks_;
  o.early_depth = !no_early_depth_;
  o.interpolation = named<Interpolation>(
      "--interpolation", interpolation_,
      {{"affine", Interpolation::affine}, {"perspective", Interpolation::perspective}});
  o.shading = named<Shading>("--shading", shading_,
                             {{"none", Shading::none},
                              {"points", Shading::points},
                              {"wireframe", Shading::wireframe},
                              {"flat", Shading::flat},
                              {"gouraud", Shading::gouraud},
                              {"phong", Shading::phong}});
  o.wire_line = named<WireLine>("--line", line_,
                                {{"explicit", WireLine::explicit_equation},
                                 {"dda", WireLine::dda},
                                 {"bresenham", WireLine::bresenham},
                                 {"midpoint", WireLine::midpoint},
                                 {"diamond-exit", WireLine::diamond_exit}});
  o.texture = texture_;
  o.filter = named<TextureFilter>("--filter", filter_,
                                  {{"nearest", TextureFilter::nearest},
                                   {"bilinear", TextureFilter::bilinear},
                                   {"trilinear", TextureFilter::trilinear},
                                   {"anisotropic", TextureFilter::anisotropic}});
  o.hidden_surface = named<HiddenSurface>(
      "--hidden-surface", hidden_surface_,
      {{"z-buffer", HiddenSurface::z_buffer}, {"painter", HiddenSurface::painter}});
  const auto [factor, units] = parse_pair("--polygon-offset", polygon_offset_);
  o.polygon_offset = {factor, units, 0};
  if (blend_) o.blend_alpha = parse_number("--opacity", opacity_);
  o.antialias = parse_antialias(antialias_);
  o.background = parse_colour(background_);
  require_meaningful(o);
  return o;
}

void PipelineArguments::expect_none() const {
  for (const CLI::Option* option : options_)
    if (option->count() > 0) throw UsageError(option->get_name() + " is for --engine pipeline");
}

}  // namespace fathom::app
