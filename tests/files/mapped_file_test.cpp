#include "fathom/files/mapped_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstring>

#include "fathom/files/input_file.h"
#include "tests/scratch_folder.h"

namespace fathom::files {
namespace {

namespace fs = std::filesystem;

int opened(const fs::path& path) {
  return ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
}

TEST(MappedFile, HoldsTheBytesFromAnyOffset) {
  const ScratchFolder folder;
  std::string text(100000, 'x');
  text.replace(70001, 3, "abc");
  const int file = opened(folder.write("file", text));
  const MappedFile mapped(file, 70001, 3, "file");
  ::close(file);
  ASSERT_TRUE(mapped.is_mapped());
  EXPECT_EQ(std::memcmp(mapped.data(), "abc", 3), 0);
  EXPECT_STREQ(mapped_file_at(mapped.data() + 2), "file");
}

TEST(MappedFile, IsFoundByItsAddressesAsLongAsItLives) {
  const ScratchFolder folder;
  const int file = opened(folder.write("file", std::string(10000, 'x')));
  const std::byte* begin = nullptr;
  {
    MappedFile first(file, 0, 10000, "a\x1b name"), second(file, 0, 10000, "another");
    begin = first.data();
    EXPECT_STREQ(mapped_file_at(begin), "a? name");
    EXPECT_STREQ(mapped_file_at(begin + 9999), "a? name");
    EXPECT_STREQ(mapped_file_at(second.data() + 5000), "another");
    EXPECT_EQ(mapped_file_at(begin + 10000), nullptr);
    EXPECT_EQ(mapped_file_at(begin + (1U << 20U)), nullptr);
    EXPECT_EQ(mapped_file_at(nullptr), nullptr);
    const MappedFile moved = std::move(first);
    EXPECT_STREQ(mapped_file_at(begin), "a? name");
  }
  EXPECT_EQ(mapped_file_at(begin), nullptr);
  ::close(file);
}

/// Whether something is mapped in the page of this address.
bool is_memory(const std::byte* address) {
  const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  const auto begin = reinterpret_cast<std::uintptr_t>(address) / page * page;
  return ::msync(reinterpret_cast<void*>(begin), 1, MS_ASYNC) == 0;
}

TEST(MappedFile, BelongsToTheOneItWasMovedTo) {
  const ScratchFolder folder;
  const int file = opened(folder.write("file", "abc"));
  const std::byte* begin = nullptr;
  {
    MappedFile last;
    {
      MappedFile first(file, 0, 3, "file");
      begin = first.data();
      MappedFile second = std::move(first);
      last = std::move(second);
    }
    EXPECT_EQ(last.data(), begin);
    EXPECT_STREQ(mapped_file_at(begin), "file");
    EXPECT_TRUE(is_memory(begin));
  }
  EXPECT_FALSE(is_memory(begin));
  ::close(file);
}

TEST(MappedFile, LongNamesAreCut) {
  const ScratchFolder folder;
  const int file = opened(folder.write("file", "abc"));
  const MappedFile mapped(file, 0, 3, std::string(5000, 'n'));
  EXPECT_EQ(mapped_file_at(mapped.data()), std::string(4095, 'n'));
  ::close(file);
}

// Names are never freed, so their places are used again.
TEST(MappedFile, NamesTakeNoMoreMemoryWithTime) {
  const ScratchFolder folder;
  const int file = opened(folder.write("file", "abc"));
  const void* place = nullptr;
  for (int i = 0; i < 3; ++i) {
    const MappedFile mapped(file, 0, 3, "file");
    const void* const name = mapped_file_at(mapped.data());
    if (place == nullptr) place = name;
    EXPECT_EQ(name, place);
  }
  ::close(file);
}

TEST(MappedFile, WhatCannotBeMappedIsNot) {
  const MappedFile mapped(-1, 0, 10, "none");
  EXPECT_FALSE(mapped.is_mapped());
  EXPECT_EQ(mapped_file_at(nullptr), nullptr);
}

/// A file of more than 64 MiB, which an InputFile maps where it is told to. The library itself
/// installs no handler: what is read is safe from others, what is mapped is told by the signal.
TEST(MappedFile, OnlyWhatIsMappedCanBeTakenAway) {
  const ScratchFolder folder;
  for (const auto reading : {InputFile::Reading::copied, InputFile::Reading::mapped_where_large}) {
    const fs::path path = folder.write("large", "begin");
    fs::resize_file(path, (std::uintmax_t{64} << 20) + 4096);
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      static InputFile* input = nullptr;
      // A sanitizer has its own handler; this one comes first.
      struct sigaction action {};
      action.sa_flags = SA_SIGINFO;
      action.sa_sigaction = [](int, siginfo_t* info, void*) {
        ::_exit(mapped_file_at(info->si_addr) != nullptr ? 2 : 3);
      };
      ::sigaction(SIGBUS, &action, nullptr);
      InputFile file(path, reading);
      input = &file;
      fs::resize_file(path, 0);
      ::_exit(input->bytes()[std::size_t{32} << 20] == std::byte{0} ? 0 : 1);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), reading == InputFile::Reading::copied ? 0 : 2);
  }
}

}  // namespace
}  // namespace fathom::files
