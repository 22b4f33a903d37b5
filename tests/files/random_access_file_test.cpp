#include "fathom/files/random_access_file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "fathom/failures/errors.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;
using namespace files;
using ::testing::HasSubstr;

std::string read(const RandomAccessFile& file, std::uint64_t offset, std::size_t size) {
  std::string bytes(size, '?');
  file.read(offset, std::as_writable_bytes(std::span(bytes)));
  return bytes;
}

TEST(RandomAccessFile, ReadsHereAndThere) {
  const ScratchFolder folder;
  const RandomAccessFile file(folder.write("ten", "0123456789"));
  EXPECT_EQ(file.size(), 10U);
  EXPECT_EQ(file.name(), folder.path() / "ten");
  EXPECT_EQ(read(file, 7, 3), "789");
  EXPECT_EQ(read(file, 0, 10), "0123456789");
  EXPECT_EQ(read(file, 4, 1), "4");
  EXPECT_EQ(read(file, 10, 0), "");
}

TEST(RandomAccessFile, NamesTheByteAtWhichAFileEndsMeanwhile) {
  const ScratchFolder folder;
  const RandomAccessFile file(folder.write("ten", "0123456789"));
  fs::resize_file(folder.path() / "ten", 6);
  EXPECT_EQ(file.size(), 10U);
  EXPECT_EQ(read(file, 2, 4), "2345");
  EXPECT_THAT(message_of<InputError>([&] { read(file, 4, 5); }),
              AllOf(HasSubstr("ten: byte 6: the file ends"), HasSubstr("10 bytes")));
}

TEST(RandomAccessFile, TellsThatOthersWriteToIt) {
  const ScratchFolder folder;
  const auto path = folder.write("ten", "0123456789");
  const auto now = std::chrono::floor<std::chrono::seconds>(fs::file_time_type::clock::now());
  fs::last_write_time(path, now);
  const RandomAccessFile file(path);
  EXPECT_NO_THROW(file.expect_unchanged());
  const auto expect_told = [&] {
    EXPECT_THAT(message_of<InputError>([&] { file.expect_unchanged(); }),
                HasSubstr("ten: has been written to since it was opened"));
  };
  fs::last_write_time(path, now + std::chrono::hours(1));
  expect_told();
  fs::last_write_time(path, now + std::chrono::microseconds(1));
  expect_told();
  // Cut short by who also turns the clock back.
  fs::resize_file(path, 9);
  fs::last_write_time(path, now);
  EXPECT_THAT(message_of<InputError>([&] { file.expect_unchanged(); }),
              HasSubstr("ten: has been cut short while it was read"));
  folder.write("ten", "0123456789");
  fs::last_write_time(path, now);
  EXPECT_NO_THROW(file.expect_unchanged());
}

TEST(RandomAccessFile, IsClosedAtItsEnd) {
  const ScratchFolder folder;
  std::optional<RandomAccessFile> file(folder.write("ten", "0123456789"));
  const int descriptor = file->descriptor();
  EXPECT_NE(::fcntl(descriptor, F_GETFD), -1);
  file.reset();
  EXPECT_EQ(::fcntl(descriptor, F_GETFD), -1);
}

TEST(RandomAccessFile, RefusesWhatCannotBeReadInParts) {
  const ScratchFolder folder;
  const auto fault = [&](const std::string& name) {
    return message_of<InputError>([&] { RandomAccessFile file(folder.path() / name); });
  };
  EXPECT_THAT(fault("none"), HasSubstr("none: cannot be opened: No such file"));
  fs::create_directory(folder.path() / "folder");
  EXPECT_THAT(fault("folder"), HasSubstr("is a directory"));
  ASSERT_EQ(::mkfifo((folder.path() / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(fault("pipe"), HasSubstr("not a regular file"));
}

}  // namespace
}  // namespace fathom
