#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "apps/shell/output_file.h"
#include "fathom/rays/cast.h"
#include "fathom/rays/hit_channels.h"

namespace fathom::app {

/// A column of a table, or several columns that belong together. In NPZ it is an array of shape N
/// or N×parts.
struct Column {
  std::string name;
  /// A letter for each part, as X, Y and Z of P; empty for a single number in each row.
  std::string_view parts;
  /// Row by row.
  std::variant<std::vector<double>, std::vector<std::uint32_t>, std::vector<std::uint64_t>> values;

  [[nodiscard]] std::size_t width() const { return parts.empty() ? 1 : parts.size(); }
  [[nodiscard]] std::size_t rows() const;
};

/// The file to which a table is written, CSV or NPZ by its name. All columns have the same number
/// of rows.
///   CSV    with a heading, in which parts are named as P.X. Numbers are the shortest decimals that
///          are read back as the same numbers, or "inf" and "nan"
///   NPZ    an array for each column, little-endian
class ColumnOutput {
 public:
  /// Whether a table can have this name: it ends in .csv or .npz, or is "-".
  static bool is_for(const std::string& name);
  /// Fails    UsageError if !is_for(name), before any work.
  explicit ColumnOutput(const std::string& name);

  [[nodiscard]] bool is_archive() const { return archive_.has_value(); }
  /// Fails    OutputError "NAME: why".
  void finish(const std::vector<Column>& columns);

 private:
  std::string name_;
  std::optional<OutputFile> archive_;
  std::optional<TextOutput> text_;
};

/// 0, 1, …, count − 1
std::vector<std::uint64_t> numbers_up_to(std::size_t count);

/// The values of the channels, in their order. Hit i belongs to the ray rays[ray_of_hit[i]].
/// distance, P, bary and N are computed with exact numbers, which takes about 10 µs for each hit.
std::vector<Column> columns_of(const TriangleSource& triangles, std::span<const Ray> rays,
                               std::span<const std::uint64_t> ray_of_hit,
                               std::span<const RayHit> hits,
                               const std::vector<HitChannel>& channels, int threads);

}  // namespace fathom::app
