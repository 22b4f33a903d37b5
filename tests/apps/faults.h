#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "test_folder.h"

/// Systems that refuse what the tests' own grants, and looks into a running program.
namespace fathom::test {

/// A call to the system that fails: the one of this number where one of the bits `mask` is set in
/// argument `argument` (mask 0: always).
struct Refusal {
  int call;
  int error;
  unsigned argument = 0;
  std::uint32_t mask = 0;
};

/// In the process that it is called in, and in what that becomes, these calls fail. False where the
/// system has no such filters.
bool refuse(const std::vector<Refusal>& refusals);

/// For RunOptions::prepare: no thread can be started; every file has a name.
std::function<void()> without_threads();
std::function<void()> without_nameless_files();
/// Files without a name cannot be given one.
std::function<void()> without_links();
/// No file takes another one's name; two can change places.
std::function<void()> without_renames();
/// Nothing reaches the disk.
std::function<void()> without_sync();

/// For RunOptions::prepare: these standard streams are closed.
std::function<void()> without_streams(std::vector<int> streams);

/// What the system says where an output waits that a process has staged in a folder: the path of
/// its open file in /proc; empty where there is none (yet).
std::string staged_by(pid_t process, const TestFolder& folder);

/// Waits until a process has staged an output in a folder; false where it ended first.
bool wait_until_staged(pid_t process, const TestFolder& folder);

/// A mesh that takes minutes to render at some 4000x3000 pixels.
std::string long_work();

/// The number of lines of a text.
long lines_of(const std::string& text);

}  // namespace fathom::test
