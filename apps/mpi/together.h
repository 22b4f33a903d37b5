#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "apps/mpi/ranks.h"
#include "apps/shell/last_resort.h"

/// Makes ranks fail together, with one rank that reports the reason.
namespace fathom::app {

/// Runs a part of the work without communication, and ends it together with the other ranks. If the
/// part fails in some ranks, all ranks fail here with the message of the first of them. Only that
/// rank prints the message, with its number if other ranks succeeded. Called by all ranks.
/// Fails    as `work` does in any rank.
void together(const Ranks& ranks, const std::function<void()>& work);

/// Whether all ranks share the failure with which this rank ends.
bool failed_together() noexcept;

/// The first rank whose text differs from rank 0's; the number of ranks if all texts are equal. A
/// rank that gets a smaller number fails with the others.
int first_that_differs(const Ranks& ranks, const std::string& text);

/// Fails in all ranks unless all have the same text.
/// Fails    with a `Failure` of this message and the rank.
template <class Failure>
void require_same(const Ranks& ranks, const std::string& text, const std::string& message) {
  const int rank = first_that_differs(ranks, text);
  if (rank < ranks.count()) {
    throw Failure(message + " (rank " + std::to_string(rank) + " of " +
                  std::to_string(ranks.count()) + " has others than rank 0)");
  }
}

/// Processes that work together end together, and only one of them reports the reason. By default
/// this process reports everything.
enum class Reports { nothing, interruptions, everything };
void report_only(Reports reports) noexcept;

/// The processes of a run on one machine share the name of a file. The first process that reports
/// creates the file; then the other processes report nothing. A name that is too long is not
/// shared.
void share_last_word(const std::string& path);
/// Used if there is no such name or the file cannot be created: a number in shared memory, which is
/// 0 and becomes 1. nullptr ends the sharing.
void share_last_word(std::atomic<int>* said) noexcept;

}  // namespace fathom::app
