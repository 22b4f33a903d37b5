#pragma once

#include <functional>
#include <string>

#include "apps/mpi/ranks.h"

namespace fathom::app {

/// Runs a part of the work of which nothing is said to other ranks, and ends it with them: if it
/// fails in one of them, all of them fail here, as the first of those does, whose message all have.
/// It alone says it; where others went on, it is told which rank it was. Called by all ranks.
/// Fails    as `work` does in any rank.
void together(const Ranks& ranks, const std::function<void()>& work);

/// Whether the failure with which this rank ends is that of all ranks.
bool failed_together() noexcept;

/// The first rank that has another text than rank 0; the number of ranks where all have the same. A
/// rank that is told of one fails with the others.
int first_that_differs(const Ranks& ranks, const std::string& text);

/// Refuses what is not the same text in all ranks, in all of them.
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
