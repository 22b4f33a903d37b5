// The programs are compiled and linked with the protections of cmake/FathomOptions.cmake.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run_program.h"

namespace fathom::test {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(Hardening, OfTheProgram) {
#if defined(FATHOM_SANITIZED)
  GTEST_SKIP() << "sanitizers take the place of what is looked for";
#endif
  const Outcome elf = run({"readelf", "--wide", "--file-header", "--segments", "--dynamic",
                           "--dyn-syms", program_path()});
  ASSERT_EQ(elf.status, 0) << elf.err;
  EXPECT_THAT(elf.out, HasSubstr("(Position-Independent Executable file)"));
  EXPECT_THAT(elf.out, HasSubstr("GNU_RELRO"));
  EXPECT_THAT(elf.out, HasSubstr("BIND_NOW"));
  EXPECT_THAT(elf.out, HasSubstr("__stack_chk_fail"));
  EXPECT_THAT(elf.out, ContainsRegex("__(snprintf|longjmp|memcpy|read)_chk"));  // fortified
  EXPECT_THAT(elf.out, HasSubstr("__glibcxx_assert_fail"));
  EXPECT_THAT(elf.out, Not(HasSubstr("RWE")));  // nothing is both written and run
}

}  // namespace
}  // namespace fathom::test
