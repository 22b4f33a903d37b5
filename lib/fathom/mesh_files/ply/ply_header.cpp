#include "fathom/mesh_files/ply/ply_header.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "fathom/text/text_cursor.h"

namespace fathom::mesh_files {
using namespace text;

namespace {

std::optional<PlyType> type_named(std::string_view name) {
  static constexpr std::pair<std::string_view, PlyType> names[] = {
      {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
      {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
      {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
      {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
      {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
      {"float64", PlyType::float64}};
  for (const auto& [known, type] : names)
    if (known == name) return type;
  return std::nullopt;
}

PlyType read_type(TextCursor& cursor) {
  TextCursor before = cursor;
  const std::optional<PlyType> type = type_named(cursor.word());
  if (!type) before.fail_here("expected a type such as float or uchar");
  return *type;
}

void read_format(TextCursor& cursor, PlyHeader& header) {
  TextCursor before = cursor;
  const std::string_view name = cursor.word();
  using Encoding = PlyHeader::Encoding;
  if (name == "ascii") {
    header.encoding = Encoding::ascii;
  } else if (name == "binary_little_endian") {
    header.encoding = Encoding::little_endian;
  } else if (name == "binary_big_endian") {
    header.encoding = Encoding::big_endian;
  } else {
    before.fail_here("expected ascii, binary_little_endian or binary_big_endian");
  }
  before = cursor;
  if (cursor.word() != "1.0") before.fail_here("expected version 1.0");
}

void read_element(TextCursor& cursor, PlyHeader& header) {
  PlyElement element;
  element.name = cursor.word();
  if (element.name.empty()) cursor.fail("expected the name of an element");
  if (header.find(element.name)) cursor.fail("element '" + element.name + "' stands twice");
  const std::int64_t count = cursor.integer("a number of elements");
  if (count < 0) cursor.fail("expected a number of elements, found a negative one");
  element.count = static_cast<std::uint64_t>(count);
  header.elements.push_back(std::move(element));
}

void read_property(TextCursor& cursor, PlyHeader& header) {
  if (header.elements.empty()) cursor.fail("expected an element before its properties");
  PlyProperty property;
  TextCursor before = cursor;
  if (cursor.word() == "list") {
    property.count_type = read_type(cursor);
    if (!is_integer(*property.count_type))
      cursor.fail("the count of a list is no integer, expected a type such as uchar");
  } else {
    cursor = before;
  }
  property.type = read_type(cursor);
  property.name = cursor.word();
  if (property.name.empty()) cursor.fail("expected the name of a property");
  PlyElement& element = header.elements.back();
  if (element.find({property.name})) cursor.fail("property '" + property.name + "' stands twice");
  element.properties.push_back(std::move(property));
}

/// The end of the first line shows how lines end: LF (with or without CR before it) or CR alone.
char line_end_of_first(std::string_view text) {
  const std::size_t at = text.find_first_of("\r\n");
  const bool carriage = at != text.npos && text[at] == '\r' && !text.substr(at).starts_with("\r\n");
  return carriage ? '\r' : '\n';
}

}  // namespace

std::size_t size_of(PlyType type) {
  constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

std::optional<std::size_t> PlyElement::find(std::initializer_list<std::string_view> names) const {
  for (std::size_t i = 0; i < properties.size(); ++i)
    if (std::find(names.begin(), names.end(), properties[i].name) != names.end()) return i;
  return std::nullopt;
}

std::size_t PlyElement::least_row_size() const {
  std::size_t size = 0;
  for (const PlyProperty& p : properties) size += size_of(p.count_type.value_or(p.type));
  return size;
}

bool PlyElement::has_lists() const {
  return std::any_of(properties.begin(), properties.end(),
                     [](const PlyProperty& p) { return p.count_type.has_value(); });
}

const PlyElement* PlyHeader::find(std::string_view name) const {
  for (const PlyElement& element : elements)
    if (element.name == name) return &element;
  return nullptr;
}

PlyHeader read_ply_header(std::string_view text, const std::string& file, Warnings& warnings) {
  PlyHeader header;
  TextCursor cursor(TextCursor::without_mark(text.substr(0, longest_ply_header)), file, {},
                    line_end_of_first(text));
  if (cursor.word() != "ply") cursor.fail("expected ply");
  bool has_format = false;
  std::uint64_t strays = 0, first_stray = 0;
  while (true) {
    cursor.skip_line();
    if (cursor.at_end()) cursor.fail("the header ends, expected end_header");
    TextCursor before = cursor;
    const std::string_view keyword = cursor.word();
    if (keyword == "end_header") break;
    if (keyword == "comment" || keyword == "obj_info" || keyword.empty()) continue;
    if (keyword == "format") {
      read_format(cursor, header);
      has_format = true;
    } else if (keyword == "element") {
      read_element(cursor, header);
    } else if (keyword == "property") {
      read_property(cursor, header);
    } else if (header.elements.empty()) {
      if (strays++ == 0) first_stray = cursor.line();
      continue;
    } else {
      before.fail_here("expected format, element, property, comment or end_header");
    }
    if (!cursor.at_line_end()) cursor.fail_here("expected the line to end");
  }
  if (!has_format)
    cursor.fail("the header has no format, expected a line such as 'format ascii 1.0'");
  if (!cursor.at_line_end()) cursor.fail_here("expected the line to end after end_header");
  if (strays > 0)
    warnings.push_back(file + ": " + std::to_string(strays) +
                       (strays == 1 ? " line of the header begins with no keyword and is"
                                    : " lines of the header begin with no keyword and are") +
                       " ignored, the first is line " + std::to_string(first_stray));
  cursor.skip_line();
  header.size = static_cast<std::size_t>(cursor.position() - text.data());
  header.lines = cursor.line() - 1;
  return header;
}

namespace {

constexpr std::array<std::string_view, 13> label_names{
    "label",      "category_id", "category",  "class_id", "class",       "semantic_id", "semantic",
    "segment_id", "segment",     "object_id", "object",   "instance_id", "instance"};

bool is_label(const PlyProperty& property) {
  return is_integer(property.type) && !property.count_type;
}

/// The first property by the order of names for which `suits` holds.
template <class Suits>
std::optional<std::size_t> find_label(const PlyElement* element, const Suits& suits) {
  if (!element) return std::nullopt;
  for (const std::string_view name : label_names) {
    const auto at = element->find({name});
    if (at && suits(element->properties[*at])) return at;
  }
  return std::nullopt;
}

}  // namespace

PlyLabels find_ply_labels(const PlyHeader& header, const std::string& file, Warnings& warnings) {
  PlyLabels labels;
  const PlyElement* const faces = header.find("face");
  const PlyElement* const vertices = header.find("vertex");
  labels.in_face = find_label(faces, is_label);
  if (!labels.in_face) labels.in_vertex = find_label(vertices, is_label);
  if (labels.in_face || labels.in_vertex) return labels;
  for (const PlyElement* const element : {faces, vertices}) {
    const auto at = find_label(element, [](const PlyProperty&) { return true; });
    if (!at) continue;
    const PlyProperty& property = element->properties[*at];
    warnings.push_back(file + ": property " + property.name + " of element " + element->name +
                       (property.count_type ? " is a list" : " is of floats") +
                       ": no labels are read from it, expected an integer");
  }
  return labels;
}

}  // namespace fathom::mesh_files
