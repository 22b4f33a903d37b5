#include <gtest/gtest.h>

#include <atomic>
#include <random>
#include <stdexcept>
#include <string>

#include "fathom/text/text_ends.h"

namespace fathom {
namespace {

using namespace text;

using Pieces = std::vector<std::string_view>;

TEST(TextChunks, CutsBehindLineEnds) {
  EXPECT_EQ(cut_into_chunks("", '\n', 4), Pieces{});
  EXPECT_EQ(cut_into_chunks("ab", '\n', 4), Pieces{"ab"});
  EXPECT_EQ(cut_into_chunks("ab\ncd\nef\ngh", '\n', 4), (Pieces{"ab\ncd\n", "ef\ngh"}));
  EXPECT_EQ(cut_into_chunks("ab\rcd\ref\rgh\r", '\r', 4), (Pieces{"ab\rcd\r", "ef\rgh\r"}));
}

TEST(TextChunks, LeavesJoinedLinesTogether) {
  EXPECT_EQ(cut_into_chunks("ab\ncd\\\nef\ngh", '\n', 4), (Pieces{"ab\ncd\\\nef\n", "gh"}));
  EXPECT_EQ(cut_into_chunks("ab\ncd\\\r\nef\ngh", '\n', 4), (Pieces{"ab\ncd\\\r\nef\n", "gh"}));
}

TEST(TextChunks, TogetherAreTheText) {
  std::mt19937 random(3);
  for (int i = 0; i < 2000; ++i) {
    std::string text;
    for (std::size_t n = random() % 60; n > 0; --n) text += "ab\n\\"[random() % 4];
    const std::size_t size = 1 + random() % 20;
    std::string joined;
    const Pieces pieces = cut_into_chunks(text, '\n', size);
    for (const std::string_view piece : pieces) {
      ASSERT_FALSE(piece.empty());
      if (!joined.empty()) {
        ASSERT_EQ(joined.back(), '\n');
        ASSERT_FALSE(joined.ends_with("\\\n"));
      }
      joined += piece;
    }
    ASSERT_EQ(joined, text);
  }
}

TEST(TextChunks, EachIsVisitedOnceAndTheFirstErrorIsHeard) {
  for (const int threads : {0, 1, 3}) {
    std::vector<std::atomic<int>> visits(50);
    const auto body = [&](std::size_t i) {
      ++visits[i];
      if (i % 10 == 7) throw std::runtime_error(std::to_string(i));
    };
    try {
      for_each_chunk(visits.size(), threads, body);
      ADD_FAILURE() << "no error";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "7");
    }
    for (const auto& count : visits) EXPECT_EQ(count, 1);
  }
  for_each_chunk(0, 1, [](std::size_t) { FAIL(); });
}

}  // namespace
}  // namespace fathom
