#include "fathom/mesh_files/read_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/mesh_files/foreign_formats.h"
#include "fathom/mesh_files/mesh_formats.h"
#include "fathom/mesh_files/off/off_keyword.h"
#include "fathom/mesh_files/stl/stl_binary.h"
#include "fathom/text/ascii.h"
#include "fathom/text/text_cursor.h"

namespace fathom::mesh_files {
using namespace text;
namespace {

template <class Value>
bool is_finite(const Value& value) {
  return std::all_of(value.begin(), value.end(), [](auto x) { return std::isfinite(x); });
}

bool is_zero(const std::array<double, 3>& value) {
  return std::all_of(value.begin(), value.end(), [](double x) { return x == 0; });
}

/// Returns how many elements are not finite. References to them, and to elements without a meaning,
/// become no_index in `corners`, which begins as a copy of `triangles` if it is empty.
template <class Value, class MeansNothing>
std::size_t leave_out(std::vector<Value>& values, MeshArray<CornerIndices>& corners,
                      const MeshArray<CornerIndices>& triangles, MeansNothing means_nothing) {
  std::vector<bool> odd(values.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool finite = is_finite(values[i]);
    if (finite && !means_nothing(values[i])) continue;
    odd[i] = true;
    values[i] = {};
    count += !finite;
  }
  if (std::find(odd.begin(), odd.end(), true) == odd.end()) return 0;
  if (corners.empty()) corners = triangles;
  for (CornerIndices& corner : corners)
    for (std::uint32_t& index : corner)
      if (index < odd.size() && odd[index]) index = no_index;
  return count;
}

}  // namespace

Mesh read_mesh(FileFormat format, const files::InputFile& input, const std::string& file,
               const ReadOptions& options, Warnings& warnings) {
  switch (format) {
    case FileFormat::obj:
      return read_obj(input.text(), file, options, warnings);
    case FileFormat::ply:
      return read_ply(input.bytes(), file, options, warnings);
    case FileFormat::stl:
      return read_stl(input.bytes(), file, options, warnings);
    default:
      return read_off(input.text(), file, options, warnings);
  }
}

void leave_out_odd_attributes(Mesh& mesh, const std::string& file, Warnings& warnings) {
  std::size_t count = leave_out(mesh.normals, mesh.normal_triangles, mesh.triangles, is_zero) +
                      leave_out(mesh.texture_coordinates, mesh.texture_triangles, mesh.triangles,
                                [](const auto&) { return false; });
  for (auto& colour : mesh.colours) {
    if (is_finite(colour)) continue;
    colour = {1, 1, 1, 1};
    ++count;
  }
  if (count > 0)
    warnings.push_back(file + ": " + std::to_string(count) +
                       " normals, texture coordinates or colours are not finite numbers; they are "
                       "left out");
}

namespace {

std::optional<FileFormat> format_by_suffix(const std::filesystem::path& path) {
  const std::string suffix = in_small_letters(path.extension().string());
  if (const auto format = mesh_format_of_suffix(suffix)) return format;
  if (suffix == ".json") return FileFormat::scene_json;
  if (!suffix.empty() && is_foreign_suffix(suffix.substr(1))) return FileFormat::foreign;
  return std::nullopt;
}

bool is_obj_keyword(std::string_view word) {
  static constexpr std::string_view known[] = {"v", "vt", "vn", "vp",     "f",
                                               "o", "g",  "s",  "usemtl", "mtllib"};
  return std::find(std::begin(known), std::end(known), word) != std::end(known);
}

/// An asset has the key "asset", which a scene file must not have. (A mesh may have that name, but
/// no colon follows a name.)
bool has_asset_key(std::string_view text) {
  constexpr std::string_view key = "\"asset\"";
  for (std::size_t at = text.find(key); at != text.npos; at = text.find(key, at + 1)) {
    const std::size_t next = text.find_first_not_of(" \t\r\n", at + key.size());
    if (next != text.npos && text[next] == ':') return true;
  }
  return false;
}

}  // namespace

std::optional<FileFormat> recognise_format(std::span<const std::byte> bytes, std::uint64_t size,
                                           const std::filesystem::path& path) {
  const std::string_view text =
      TextCursor::without_mark({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  if (text.starts_with("glTF")) return FileFormat::gltf;
  if (text.starts_with("ply\n") || text.starts_with("ply\r")) return FileFormat::ply;
  if (is_binary_stl_by_size(bytes, size)) return FileFormat::stl;

  const std::string no_name;
  TextCursor cursor(text, no_name, {.comments = true, .continuation = false});
  if (!cursor.next_line_with_words()) return format_by_suffix(path);
  const char first = *cursor.position();
  if (first == '{' || first == '[') {
    const std::optional<FileFormat> by_suffix = format_by_suffix(path);
    if (by_suffix == FileFormat::gltf) return by_suffix;
    return has_asset_key(text) ? FileFormat::gltf : FileFormat::scene_json;
  }
  const std::string_view word = cursor.word();
  if (read_off_keyword(word)) return FileFormat::off;
  if (in_small_letters(word.substr(0, 6)) == "solid") return FileFormat::stl;
  if (is_obj_keyword(word)) return FileFormat::obj;
  return format_by_suffix(path);
}

}  // namespace fathom::mesh_files
