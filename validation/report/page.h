#pragma once

#include <string_view>

/// The parts of report.html and comparison.html that are the same in every report: the files of page/
/// by their names, compiled in by EmbedTexts.cmake.
namespace fathom::validation::page {

/// To the beginning of the style sheet; the style sheet; from its end to the data.
extern const std::string_view head, style, body, comparison_body;

/// One script, in this order: names and small functions; the data; reading the maps; colours and
/// drawing; showing a result; its plots; the tables of all results, and what is shown first.
extern const std::string_view elements, data, maps, colours, result, plots, start;

/// The script of comparison.html, after `elements`.
extern const std::string_view comparison;

}  // namespace fathom::validation::page
