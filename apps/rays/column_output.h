#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/rays/columns.h"
#include "apps/shell/output_file.h"

namespace fathom::app {

/// The file, CSV or NPZ by its name, that a table is written to.
class ColumnOutput {
 public:
  /// Fails    UsageError for a name that ends in neither .csv nor .npz, before any work.
  explicit ColumnOutput(const std::string& name);

  [[nodiscard]] bool is_archive() const { return archive_.has_value(); }
  void finish(const std::vector<Column>& columns);

 private:
  std::string name_;
  std::optional<OutputFile> archive_;
  std::optional<TextOutput> text_;
};

/// 0, 1, …, count − 1
std::vector<std::uint64_t> numbers_up_to(std::size_t count);

}  // namespace fathom::app
