#pragma once

#include <string_view>

/// The files of web/ by their names, compiled in by EmbedTexts.cmake.
namespace fathom::view::web {

/// To the beginning of the style sheet; the style sheet; from its end to the data.
extern const std::string_view head, style, body;

/// The modules, in an order in which each follows those that it imports.
extern const std::string_view numbers, planes, channels, colours, statistics, difference, state,
    painting, picture, reading, deep, probe, histogram, profile, comparison, controls, start;

}  // namespace fathom::view::web
