#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "fathom/files/file_bytes.h"

namespace fathom::app {

/// A column of a table, or several that belong together: an array of NPZ, of shape N or N×parts.
struct Column {
  std::string name;
  /// Names of the parts, as X, Y and Z of P; empty for a single number in each row.
  std::vector<std::string_view> parts;
  /// Row by row.
  std::variant<std::vector<double>, std::vector<std::uint32_t>, std::vector<std::uint64_t>> values;

  [[nodiscard]] std::size_t width() const { return parts.empty() ? 1 : parts.size(); }
  [[nodiscard]] std::size_t rows() const;
};

/// CSV with a heading, in which parts are named as P.X. All columns have the same number of rows.
/// Numbers are the shortest decimals that are read back as the same numbers; "inf" and "nan".
std::string csv_of(const std::vector<Column>& columns);

/// An NPZ with an array NAME.npy for each column, little-endian; `name` is the file's, for
/// messages.
/// Fails    OutputError beyond 4 GiB.
files::Bytes npz_of(const std::vector<Column>& columns, const std::string& name);

}  // namespace fathom::app
