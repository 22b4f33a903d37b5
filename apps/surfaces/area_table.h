#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/surfaces/light_list.h"
#include "fathom/area/area_items.h"
#include "fathom/area/areas.h"

namespace fathom::app {

enum class TableFormat { csv, json, npz };

/// The format of a table by the suffix of its file: .csv, .npz and .json. Other names are names of
/// CSV, or of JSON if that is asked for.
/// Fails    UsageError: another suffix, or .csv or .npz where JSON is asked for.
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
  /// `list` has no light where cameras are the lights.
  AreaTable(const Form& form, const AreaItems& items, const LightList& list);

  [[nodiscard]] std::string beginning() const;
  /// Each row begins with a line feed in JSON, and all but the first of the table with a comma.
  [[nodiscard]] std::string rows(std::size_t light, const std::vector<LitArea>& areas) const;
  /// `rows` as it follows the beginning, or other rows.
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
  /// The names that the columns of the lights' file have in the table.
  std::vector<std::string> columns_;
};

}  // namespace fathom::app
