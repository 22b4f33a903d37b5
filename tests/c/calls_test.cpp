#include "lib/c/calls.h"

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>
#include <string>
#include <system_error>

#include "apps/shell/failures.h"
#include "fathom/failures/errors.h"

namespace fathom::c {
namespace {

template <class Failure>
fathom_status status_after(const Failure& failure) {
  return status_of([&] { throw failure; });
}

std::system_error refusal(std::errc code) {
  return std::system_error(std::make_error_code(code));
}

TEST(CallsOfC, AnOutputThatTheSystemRefusesIsOne) {
  EXPECT_EQ(status_after(refusal(std::errc::no_space_on_device)), FATHOM_OUTPUT);
  EXPECT_EQ(error_of_thread(), refusal(std::errc::no_space_on_device).what());
  EXPECT_EQ(status_after(refusal(std::errc::read_only_file_system)), FATHOM_OUTPUT);
  EXPECT_EQ(status_after(refusal(std::errc::permission_denied)), FATHOM_INPUT);
  EXPECT_EQ(status_after(refusal(std::errc::resource_unavailable_try_again)), FATHOM_INPUT);
}

TEST(CallsOfC, MemoryIsMissingHoweverThatIsFound) {
  EXPECT_EQ(status_after(std::bad_alloc()), FATHOM_MEMORY);
  EXPECT_EQ(status_after(std::length_error("vector::reserve")), FATHOM_MEMORY);
  EXPECT_EQ(error_of_thread(), "there is not enough memory");
  EXPECT_EQ(status_after(refusal(std::errc::not_enough_memory)), FATHOM_MEMORY);
}

TEST(CallsOfC, AnUnknownExceptionIsNoFaultOfTheInput) {
  EXPECT_EQ(status_after(std::runtime_error("unheard of")), FATHOM_INTERNAL);
  EXPECT_EQ(error_of_thread(), "unheard of");
}

TEST(CallsOfC, StatusesAreTheExitStatusesOfPrograms) {
  EXPECT_EQ(int{status_after(UsageError(""))}, int{app::wrong_usage});
  EXPECT_EQ(int{status_after(InputError(""))}, int{app::unusable_input});
  EXPECT_EQ(int{status_after(OutputError(""))}, int{app::unwritable_output});
  EXPECT_EQ(int{status_after(std::runtime_error(""))}, int{app::internal_error});
  EXPECT_EQ(status_of([] {}), FATHOM_OK);
}

}  // namespace
}  // namespace fathom::c
