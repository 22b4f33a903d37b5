// A window of a few bytes over a file shows what a window over the same bytes in memory does.
#include <gtest/gtest.h>

#include <random>

#include "fathom/files/random_access_file.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using namespace files;

class RandomBytes {
 public:
  RandomBytes() {
    std::mt19937 random(5);
    for (int i = 0; i < 1000; ++i) text_ += static_cast<char>(random());
    file_.emplace(folder_.write("bytes", text_));
  }
  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] const RandomAccessFile& file() const { return *file_; }

 private:
  ScratchFolder folder_;
  std::string text_;
  std::optional<RandomAccessFile> file_;
};

TEST(ByteWindow, AnyWalkSeesWhatLiesInMemory) {
  const RandomBytes bytes;
  std::mt19937 random(6);
  for (int walk = 0; walk < 200; ++walk) {
    const std::uint64_t first = random() % 100, end = 900 + random() % 100;
    ByteWindow in_memory(std::string_view(bytes.text()).substr(first, end - first), first);
    ByteWindow in_file(bytes.file(), first, end, 8 + random() % 60);
    while (in_memory.rest() > 0) {
      ASSERT_EQ(in_file.rest(), in_memory.rest());
      ASSERT_EQ(in_file.position(), in_memory.position());
      const std::size_t count = 1 + random() % 8;
      ASSERT_EQ(in_file.has(count), in_memory.has(count));
      if (!in_memory.has(count)) {
        in_memory.skip(in_memory.rest());
        in_file.skip(in_file.rest());
        break;
      }
      ASSERT_EQ(std::string_view(in_file.at(), count), std::string_view(in_memory.at(), count));
      for (ByteWindow* window : {&in_memory, &in_file}) window->advance(count);
      if (random() % 4 == 0) {
        for (ByteWindow* window : {&in_memory, &in_file}) window->back(count / 2);
      }
      if (random() % 16 == 0) {
        const std::uint64_t skipped = random() % (in_memory.rest() + 1);
        for (ByteWindow* window : {&in_memory, &in_file}) window->skip(skipped);
      }
    }
    ASSERT_EQ(in_file.rest(), 0U);
    ASSERT_EQ(in_file.position(), end);
    ASSERT_FALSE(in_file.has(1));
  }
}

}  // namespace
}  // namespace fathom
