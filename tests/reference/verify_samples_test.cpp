#include "fathom/reference/verify_samples.h"

#include <gtest/gtest.h>

namespace fathom::reference {
namespace {

/// More pixels than are taken at once: rows are cut where enough are there.
TEST(ChosenRows, TakesWholeRowsUntilEnough) {
  const PixelChoice chosen = choose_pixels(10, 7, 35);
  std::size_t seen = 0;
  for (std::uint32_t row = 0; row < 7;) {
    const ChosenRows rows(chosen, 10, 7, row, 8);
    EXPECT_EQ(rows.first_row(), row);
    EXPECT_EQ(rows.start(row), 0U);
    EXPECT_EQ(rows.start(rows.end_row()), rows.size());
    for (; row < rows.end_row(); ++row) {
      for (std::size_t k = rows.start(row); k < rows.start(row + 1); ++k, ++seen) {
        EXPECT_TRUE(chosen[row * 10 + rows.column(k)]);
        EXPECT_TRUE(rows.meet({rows.column(k), rows.column(k), row, row}));
      }
      const bool last_taken = row + 1 == rows.end_row();
      EXPECT_TRUE(last_taken || rows.start(row + 1) < 8);
    }
  }
  EXPECT_EQ(seen, 35U);
}

}  // namespace
}  // namespace fathom::reference
