#include "fathom/memory/available_memory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "fathom/failures/errors.h"

namespace fathom {
namespace {

/// Lowers a limit of this process while it is there.
class Lowered {
 public:
  Lowered(int resource, rlim_t bytes) : resource_(resource) {
    getrlimit(resource_, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    setrlimit(resource_, &limit);
  }
  Lowered(const Lowered&) = delete;
  Lowered& operator=(const Lowered&) = delete;
  ~Lowered() { setrlimit(resource_, &before_); }

 private:
  int resource_;
  rlimit before_{};
};

TEST(AvailableMemory, NoMoreThanTheMachineHas) {
  const MemoryAllowance allowance = available_memory();
  EXPECT_GT(allowance.bytes, std::uint64_t{1} << 20);
  EXPECT_LE(allowance.bytes, static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
                                 static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)));
}

#ifndef FATHOM_SANITIZED  // their shadow memory takes terabytes of addresses
TEST(AvailableMemory, LimitsOfTheProcess) {
  constexpr rlim_t little = rlim_t{64} << 20;
  if (available_memory().bytes <= little) GTEST_SKIP() << "less is allowed anyhow";
  {
    const Lowered data(RLIMIT_DATA, little);
    EXPECT_EQ(available_memory().bytes, little);
    EXPECT_EQ(available_memory().set_by, "ulimit -d allows");
  }
  const Lowered addresses(RLIMIT_AS, little);
  EXPECT_EQ(available_memory().bytes, little);
  EXPECT_EQ(available_memory().set_by, "ulimit -v allows");
}
#endif

TEST(AvailableMemory, SizesInWords) {
  EXPECT_EQ(size_in_words(34'520'000), "34.5 MB");
  EXPECT_EQ(size_in_words(999'000'000), "999.0 MB");
  EXPECT_EQ(size_in_words(2'147'483'648), "2.1 GB");
}

TEST(AvailableMemory, WhatNeedsMoreIsRefused) {
  const MemoryAllowance allowance{1'000'000'000, "this test allows", ""};
  EXPECT_NO_THROW(require_memory("a map", 1e9, allowance));
  try {
    require_memory("a map", 1e9 + 1e8, allowance);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "a map needs 1.1 GB; this test allows 1.0 GB");
  }
  try {
    require_memory("a map", 2e9, {500'000'000, "this test allows", "ask it for more"});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "a map needs 2.0 GB; this test allows 500.0 MB; ask it for more");
  }
}

}  // namespace
}  // namespace fathom
