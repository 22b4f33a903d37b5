#pragma once

#include <functional>
#include <string>

#include "apps/mpi/ranks.h"

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

}  // namespace fathom::app
