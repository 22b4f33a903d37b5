#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "fathom/pipeline/options.h"

/// The pipeline's options as words on the command line. All fail with UsageError, naming the words
/// that exist.
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
/// "random:7", the seed being 0 where it is not said
std::pair<pipeline::DrawOrder, std::uint64_t> parse_draw_order(const std::string& text);
/// "X,Y,W,H"
std::optional<pipeline::WindowRectangle> parse_rectangle(const std::string& text);
/// "R,G,B" from 0 to 1
pipeline::Colour parse_colour(const std::string& text);

}  // namespace fathom::app
