#pragma once

#include <string_view>

/// The pages' Markdown, from the .md files beside the studies (CMakeLists.txt).
namespace fathom::studies::page_texts {

extern const std::string_view antialiasing, blending, clipping, course, depth_resolution,
    hidden_surface, indistinguishable, lines, mitigation, scene_fights, scene_hidden_surface,
    subpixel, z_fighting;

}  // namespace fathom::studies::page_texts
