#pragma once

#include <string>

/// Texts of a file that describe its codes and identifiers. They are no texts of the map
/// (map_texts.h): read_map() makes members of a DepthMap of them.
namespace fathom::image {

/// DepthMap::png_scale, of a PNG or NPZ.
inline constexpr const char* scale_text = "fathom:scale";
/// DepthMap::codes_beyond, of a PNG.
inline constexpr const char* beyond_text = "fathom:beyond";
/// The name of a PNG's channel, and what it holds: "identifier", "normal", "mask", or no such text
/// for codes.
inline constexpr const char* channel_text = "fathom:channel";
inline constexpr const char* type_text = "fathom:type";
inline constexpr const char* normal_type = "normal";
inline constexpr const char* mask_type = "mask";
/// The axes of normals in the camera's frame: "opengl", or no such text for the channel's own.
inline constexpr const char* axes_text = "fathom:axes";

/// The value of scale_text in the file `name`.
/// Fails    InputError unless it is a positive number.
double read_scale(const std::string& text, const std::string& name);

}  // namespace fathom::image
