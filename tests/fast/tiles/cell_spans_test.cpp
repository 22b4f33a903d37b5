// The cells that are left out of a thin triangle's box, for the vector instructions that every
// processor has: none of them has a sample at which no edge function is certainly negative.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "fathom/fast/tiles/cell_spans-inl.h"
#include "tests/effort.h"
#include "tests/numeric/random_numbers.h"

namespace fathom {
namespace {

using namespace fast;
using checks::Numbers;
namespace lanes = fast::HWY_NAMESPACE;

constexpr int cell = 4, cells = 16;

/// Whole multiples of 2⁻¹²: with places in a tile, all products and sums are exact in binary32.
constexpr float step = 0x1p-12F;

/// Functions of one triangle in every lane, whose samples are often just at the bound.
lanes::LaneBatch random_batch(Numbers& n) {
  lanes::LaneBatch batch{};
  for (std::size_t i = 0; i < 3; ++i) {
    const int steepness = 1 << n.below(6);
    const int a = n.below(2 * steepness + 1) - steepness;
    const int b = n.below(2 * steepness + 1) - steepness;
    batch.edge_a[i].fill(static_cast<float>(a) * step);
    batch.edge_b[i].fill(static_cast<float>(b) * step);
    batch.edge_c[i].fill(static_cast<float>(n.below(64 * steepness) - 20 * steepness) * step);
  }
  batch.edge_error.fill(static_cast<float>(n.below(3)) * step);
  const auto place = [&](lanes::LaneBatch::Places& first, lanes::LaneBatch::Places& last) {
    const int begin = n.below(64), end = n.below(64);
    first.fill(std::min(begin, end));
    last.fill(std::max(begin, end));
  };
  place(batch.first_column, batch.last_column);
  place(batch.first_row, batch.last_row);
  return batch;
}

/// Whether no edge function is certainly negative at a sample of the tile.
bool may_be_covered(const lanes::LaneBatch& f, int column, int row) {
  for (std::size_t i = 0; i < 3; ++i) {
    const auto x = static_cast<float>(column - f.first_column[0]);
    const auto y = static_cast<float>(row - f.first_row[0]);
    if (f.edge_a[i][0] * x + f.edge_b[i][0] * y + f.edge_c[i][0] < -f.edge_error[0]) return false;
  }
  return true;
}

/// The numbers of the cells with a sample of the box that may be covered.
std::set<std::uint32_t> required_cells(const lanes::LaneBatch& f) {
  std::set<std::uint32_t> numbers;
  for (int row = f.first_row[0]; row <= f.last_row[0]; ++row) {
    for (int column = f.first_column[0]; column <= f.last_column[0]; ++column) {
      if (may_be_covered(f, column, row)) {
        numbers.insert(static_cast<std::uint32_t>(row / cell * cells + column / cell));
      }
    }
  }
  return numbers;
}

TEST(CellSpans, HaveEveryCellThatATriangleMayMeet) {
  Numbers n(71);
  std::size_t few = 0, required_in_all = 0, listed_in_all = 0, box_cells = 0;
  for (int i = 0; i < 20000 / checks::effort; ++i) {
    const lanes::LaneBatch f = random_batch(n);
    lanes::SpanGuesses guesses;
    lanes::make_span_guesses(f, guesses);
    lanes::CellSpans spans;
    lanes::make_cell_spans(f, guesses, 0, spans);
    const auto required = required_cells(f);
    ASSERT_GE(spans.count, static_cast<int>(required.size()));
    if (spans.count > static_cast<int>(lanes::CellList::most)) continue;
    ++few;
    alignas(64) lanes::OfRows open;
    for (std::size_t row = 0; row < open.size(); row += 2) {
      open[row] = open[row + 1] = n.below(2) == 0 ? 0xFF : static_cast<unsigned>(n.below(256));
    }
    lanes::CellList list;
    lanes::list_cells(spans, open, list);
    const std::set<std::uint32_t> listed(list.numbers.begin(), list.numbers.begin() + list.count);
    ASSERT_EQ(listed.size(), list.count);
    const auto is_open = [&](std::uint32_t number) {
      return (open[number / cells] >> number % cells / 2 & 1) != 0;
    };
    for (const std::uint32_t number : listed) {
      ASSERT_TRUE(is_open(number));
      const int column = static_cast<int>(number) % cells, row = static_cast<int>(number) / cells;
      ASSERT_GE(column, f.first_column[0] / cell);
      ASSERT_LE(column, f.last_column[0] / cell);
      ASSERT_GE(row, f.first_row[0] / cell);
      ASSERT_LE(row, f.last_row[0] / cell);
    }
    for (const std::uint32_t number : required) {
      if (!is_open(number)) continue;
      ASSERT_EQ(listed.count(number), 1U) << "cell " << number;
      ++required_in_all;
    }
    listed_in_all += listed.size();
    box_cells += static_cast<std::size_t>(f.last_column[0] / cell - f.first_column[0] / cell + 1) *
                 static_cast<std::size_t>(f.last_row[0] / cell - f.first_row[0] / cell + 1);
  }
  // It would not be worth the while to leave out little.
  EXPECT_GT(few, 10000U / checks::effort);
  EXPECT_GT(required_in_all, 30000U / checks::effort);
  EXPECT_LT(listed_in_all, box_cells / 2);
  EXPECT_LT(listed_in_all, 2 * required_in_all);
}

}  // namespace
}  // namespace fathom
