#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "apps/rays/waiting_bytes.h"
#include "apps/shell/output_file.h"
#include "apps/surfaces/npz_rows.h"
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

/// The file to which a table is written, CSV or NPZ by its name. Its rows come in blocks, which do
/// not stay in memory: the columns of an NPZ, and text for standard output, wait in the folder that
/// TMPDIR names.
///   CSV    with a heading, in which parts are named as P.X. Numbers are the shortest decimals that
///          are read back as the same numbers, or "inf" and "nan"
///   NPZ    an array for each column, little-endian
class ColumnOutput {
 public:
  /// Whether a table can have this name: it ends in .csv or .npz, or is "-".
  static bool is_for(const std::string& name);
  /// Fails    UsageError if !is_for(name), before any work.
  explicit ColumnOutput(const std::string& name);

  [[nodiscard]] bool is_archive() const { return file_ && !is_text_; }
  /// Appends a block of rows. All blocks have the same columns. In a CSV, all columns of a block
  /// have the same number of rows.
  /// Fails    OutputError "NAME: why".
  void append(const std::vector<Column>& columns);
  /// Puts the table in its place. Fails as append().
  void finish();

 private:
  void append_text(const std::string& text);
  void append_arrays(const std::vector<Column>& columns);
  void write_archive();

  std::string name_;
  bool is_text_;
  /// nullopt for standard output.
  std::optional<OutputFile> file_;
  /// The open file, until it is in its place.
  int descriptor_ = -1;
  bool has_rows_ = false;
  /// The arrays of an NPZ, and their numbers; or the text for standard output.
  std::vector<NpzRows::Array> arrays_;
  std::vector<WaitingBytes> waiting_;
};

/// first, first + 1, …
std::vector<std::uint64_t> numbers_from(std::uint64_t first, std::size_t count);

/// The values of the channels, in their order. Hit i belongs to the ray rays[ray_of_hit[i]].
/// distance, P, bary and N are computed with exact numbers, which takes about 10 µs for each hit.
std::vector<Column> columns_of(const TriangleSource& triangles, std::span<const Ray> rays,
                               std::span<const std::uint64_t> ray_of_hit,
                               std::span<const RayHit> hits,
                               const std::vector<HitChannel>& channels, int threads);

}  // namespace fathom::app
