#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/surfaces/light_list.h"
#include "apps/surfaces/npz_rows.h"
#include "fathom/area/areas.h"
#include "fathom/text/printable.h"

namespace fathom::app {

/// Names for the columns that are copied from a file of lights. A name that is `taken` gets
/// "light_" in front.
inline std::vector<std::string> free_names(const std::vector<std::string>& headings,
                                           const std::vector<std::string>& taken) {
  std::vector<std::string> names;
  names.reserve(headings.size());
  for (const std::string& heading : headings) names.push_back(text::printable(heading));
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto is_taken = [&](const std::string& name) {
      return std::ranges::find(taken, name) != taken.end() ||
             std::ranges::count(names, name) > (name == names[k] ? 1 : 0);
    };
    std::string name = names[k];
    while (is_taken(name)) name = "light_" + name;
    names[k] = name;
  }
  return names;
}

enum class TableFormat { csv, json, npz };

/// The format of a table by the suffix of its file: .csv, .npz and .json. Other names mean CSV, or
/// JSON if requested.
/// Fails    UsageError: another suffix, or .csv or .npz if JSON is requested.
TableFormat table_format_of(const std::string& file, bool wants_json);

/// A table of areas as text: a row for each light and each item. The rows of the lights follow one
/// another between a beginning and an end.
class AreaTable {
 public:
  struct Form {
    TableFormat format = TableFormat::csv;
    AreaItemKind kind = AreaItemKind::object;
    /// Leaves out items of which nothing is visible.
    bool nonzero = false;
  };
  /// `list` has no light if cameras are the lights.
  AreaTable(const Form& form, const AreaItems& items, const LightList& list);

  [[nodiscard]] std::string beginning() const;
  /// In JSON each row begins with a line feed, and each row except the first of the table with a
  /// comma.
  [[nodiscard]] std::string rows(std::size_t light, const std::vector<LitArea>& areas) const;
  /// `rows` in the form in which they follow the beginning, or other rows.
  [[nodiscard]] std::string_view after(std::string_view rows, bool is_first) const;
  [[nodiscard]] std::string end() const;

 private:
  [[nodiscard]] std::string as_csv(std::size_t light, const AreaItem& item,
                                   const LitArea& area) const;
  [[nodiscard]] std::string as_json(std::size_t light, const AreaItem& item,
                                    const LitArea& area) const;

  Form form_;
  const AreaItems& items_;
  const LightList& list_;
  /// The names in the table of the columns of the lights' file.
  std::vector<std::string> columns_;
};

/// Areas as arrays of NPZ. With N lights and M items:
///
///   projected, visible, fraction, lit   N×M; NaN where a value is not defined
///   centroid                            N×M×3; NaN where nothing is visible
///   side                                N×M: 1 front, −1 back, 0 edge; of triangles only
///   names, number                       M, of the items; object and face of triangles and faces
///   lights                              N×3, the directions or points; none of cameras
///   other columns of the lights' file   N, texts
class AreaArrays {
 public:
  AreaArrays(AreaItemKind kind, const AreaItems& items, const LightList& list,
             std::size_t light_count);

  [[nodiscard]] const std::vector<NpzRows::Array>& arrays() const { return arrays_; }
  /// The bytes of a light for the arrays that have a row for each light. These arrays come first.
  [[nodiscard]] std::vector<files::Bytes> rows(const std::vector<LitArea>& areas) const;
  /// Appends the arrays that do not depend on areas.
  void append_others(NpzRows& file) const;

 private:
  void add(const std::string& name, const std::string& type, std::size_t bytes,
           std::vector<std::uint64_t> shape);
  void add_other(const std::string& name, const std::string& type, std::size_t element_bytes,
                 std::vector<std::uint64_t> shape, files::Bytes bytes);
  void add_texts(const std::string& name, const std::vector<std::string>& texts);
  void add_items(const AreaItems& items);
  void add_lights(const LightList& list);

  bool has_sides_;
  std::vector<NpzRows::Array> arrays_;
  std::vector<files::Bytes> others_;
};

}  // namespace fathom::app
