#pragma once

#include <string_view>

/// The parts of report.html and comparison.html that are the same in every report: the files of
/// page/ by their names, compiled in by EmbedTexts.cmake.
namespace fathom::validation::page {

/// To the beginning of the style sheet; the style sheet; from its end to the data.
extern const std::string_view head, style, body, comparison_body;

/// What the scripts of both pages begin with, in this order: names and small functions; what words
/// mean; the table of scenes and renderers with its sums, and its filter.
extern const std::string_view elements, words, overview;

/// The rest of the script of report.html, in this order: the data; reading the maps; colours and
/// drawing; showing a result; its plots; the tables of all results, and what is shown first.
extern const std::string_view data, maps, colours, result, plots, start;

/// The rest of the script of comparison.html.
extern const std::string_view comparison;

}  // namespace fathom::validation::page
