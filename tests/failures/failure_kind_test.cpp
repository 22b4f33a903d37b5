#include "fathom/failures/failure_kind.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <new>
#include <stdexcept>
#include <system_error>

#include "fathom/failures/errors.h"
#include "fathom/failures/unknown_name.h"

namespace fathom {
namespace {

FailureKind kind_of_code(std::errc code) {
  return kind_of(std::system_error(std::make_error_code(code)));
}

TEST(FailureKind, ErrorsOfFathomHaveTheirOwn) {
  EXPECT_EQ(kind_of(UsageError("")), FailureKind::usage);
  EXPECT_EQ(kind_of(UnknownName("", "a", {"b"})), FailureKind::usage);
  EXPECT_EQ(kind_of(InputError("")), FailureKind::input);
  EXPECT_EQ(kind_of(OutputError("")), FailureKind::output);
}

TEST(FailureKind, MemoryThatIsMissingOrCannotExist) {
  EXPECT_EQ(kind_of(std::bad_alloc()), FailureKind::memory);
  EXPECT_EQ(kind_of(std::bad_array_new_length()), FailureKind::memory);
  EXPECT_EQ(kind_of(std::length_error("vector")), FailureKind::memory);
  EXPECT_EQ(kind_of_code(std::errc::not_enough_memory), FailureKind::memory);
}

TEST(FailureKind, RefusalsOfTheSystemConcernOutputsIfOnlyTheyMeetThem) {
  for (const std::errc code : {std::errc::no_space_on_device, std::errc::read_only_file_system,
                               std::errc::file_too_large, std::errc::broken_pipe})
    EXPECT_EQ(kind_of_code(code), FailureKind::output);
  for (const std::errc code : {std::errc::permission_denied, std::errc::no_such_file_or_directory,
                               std::errc::too_many_files_open, std::errc::io_error})
    EXPECT_EQ(kind_of_code(code), FailureKind::input);
  const std::filesystem::filesystem_error full("", "a.exr",
                                               std::make_error_code(std::errc::no_space_on_device));
  EXPECT_EQ(kind_of(full), FailureKind::output);
}

TEST(FailureKind, LackOfThreadsOfTheStandardLibraryAndOfTbb) {
  EXPECT_EQ(kind_of_code(std::errc::resource_unavailable_try_again), FailureKind::threads);
  EXPECT_EQ(kind_of(std::runtime_error("pthread_create has failed: Resource")),
            FailureKind::threads);
}

TEST(FailureKind, OtherExceptionsAreErrorsInFathom) {
  EXPECT_EQ(kind_of(std::runtime_error("")), FailureKind::internal);
  EXPECT_EQ(kind_of(std::out_of_range("")), FailureKind::internal);
  EXPECT_EQ(kind_of(std::exception()), FailureKind::internal);
}

}  // namespace
}  // namespace fathom
