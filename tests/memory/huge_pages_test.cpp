#include "fathom/memory/huge_pages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <vector>

namespace fathom {
namespace {

TEST(HugePages, AreAHintThatChangesNothing) {
  for (const std::size_t size : {0U, 1U, 4096U, 3U << 20, 9U << 20}) {
    std::vector<char> memory(size + 1, 'a');
    errno = ERANGE;
    memory::prefer_huge_pages(memory.data() + 1, size);
    EXPECT_EQ(errno, ERANGE) << size;
    EXPECT_TRUE(std::all_of(memory.begin(), memory.end(), [](char c) { return c == 'a'; })) << size;
  }
}

TEST(HugePages, AreNoFailureWhereThereIsNoMemory) {
  errno = 0;
  memory::prefer_huge_pages(nullptr, std::size_t{1} << 30);
  EXPECT_EQ(errno, 0);
}

}  // namespace
}  // namespace fathom
