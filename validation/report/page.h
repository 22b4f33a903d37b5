#pragma once

#include <string_view>

/// The parts of report.html that are the same in every report: the files of page/ by their names,
/// compiled in by EmbedTexts.cmake.
namespace fathom::validation::page {

/// To the beginning of the style sheet; the style sheet; from its end to the data.
extern const std::string_view head, style, body;

/// One script, in this order: names and small functions; reading the data; colours and drawing;
/// showing a result; its plots; the tables of all results, and what is shown first.
extern const std::string_view names, maps, colours, result, plots, start;

}  // namespace fathom::validation::page
