#pragma once

#include <array>
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

namespace fathom::app {

/// A column of a table, or several columns that belong together. In NPZ it is an array of shape N
/// or N×parts.
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
/// Numbers are the shortest decimals that are read back as the same numbers, or "inf" and "nan".
std::string csv_of(const std::vector<Column>& columns);

/// Writes an NPZ with an array NAME.npy for each column, little-endian, to an empty ordinary file;
/// `target` is its name for messages.
/// Fails    OutputError "TARGET: why".
void write_npz(const std::vector<Column>& columns, int descriptor, const std::string& target);

/// The file to which a table is written, CSV or NPZ by its name.
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

/// The channels of a hit (specification, section 11).
enum class HitChannel { t, id, distance, P, bary, N, object, face };
inline constexpr std::array all_hit_channels{
    HitChannel::t,    HitChannel::id, HitChannel::distance, HitChannel::P,
    HitChannel::bary, HitChannel::N,  HitChannel::object,   HitChannel::face};
std::string_view name_of(HitChannel channel);

/// The values of the channels, in their order. Hit i belongs to the ray rays[ray_of_hit[i]].
/// distance, P, bary and N are computed with exact numbers, which takes about 10 µs for each hit.
std::vector<Column> columns_of(const TriangleSource& triangles, std::span<const Ray> rays,
                               std::span<const std::uint64_t> ray_of_hit,
                               std::span<const RayHit> hits,
                               const std::vector<HitChannel>& channels, int threads);

}  // namespace fathom::app
