#include "fathom/mesh_files/mesh_formats.h"

#include <algorithm>

#include "fathom/failures/unknown_name.h"

namespace fathom::mesh_files {
namespace {

/// The format with this text among its words or suffixes. Unused places of a row are empty.
template <class Texts>
std::optional<FileFormat> format_with(std::string_view text, Texts MeshFormatDescription::*texts) {
  if (text.empty()) return std::nullopt;
  for (const MeshFormatDescription& format : mesh_format_table)
    if (std::ranges::count(format.*texts, text) > 0) return format.format;
  return std::nullopt;
}

}  // namespace

std::optional<FileFormat> mesh_format_named(std::string_view word) {
  return format_with(word, &MeshFormatDescription::words);
}

std::optional<FileFormat> mesh_format_of_suffix(std::string_view suffix) {
  return format_with(suffix, &MeshFormatDescription::suffixes);
}

bool can_be_streamed(FileFormat format) {
  return std::ranges::any_of(mesh_format_table, [&](const MeshFormatDescription& each) {
    return each.format == format && each.can_be_streamed;
  });
}

std::vector<std::string> words_of_mesh_formats() {
  std::vector<std::string> words;
  for (const MeshFormatDescription& format : mesh_format_table)
    for (const std::string_view word : format.words)
      if (!word.empty()) words.emplace_back(word);
  return words;
}

std::string names_of_mesh_formats() {
  std::vector<std::string> names;
  for (const MeshFormatDescription& format : mesh_format_table) names.emplace_back(format.name);
  return joined(names, ", ");
}

}  // namespace fathom::mesh_files
