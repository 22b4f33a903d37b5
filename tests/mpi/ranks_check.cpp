// What ranks tell each other arrives, in however many rounds: started by mpirun, exit status 0 where it does.
#include <cstdio>
#include <random>

#include "apps/mpi/ranks.h"

namespace fathom::app {
namespace {

/// What one rank sends to another, which both know: of any length, often nothing.
text::Bytes message_of(int from, int to) {
  std::mt19937 random(static_cast<unsigned>(1000 * from + to));
  text::Bytes bytes(random() % 3 == 0 ? 0 : random() % 1000);
  for (std::byte& byte : bytes) byte = static_cast<std::byte>(random() % 256);
  return bytes;
}

bool messages_arrive(const Ranks& ranks, std::size_t most_at_once) {
  std::vector<text::Bytes> messages;
  for (int to = 0; to < ranks.count(); ++to) messages.push_back(message_of(ranks.self(), to));
  messages = ranks.exchange(std::move(messages), most_at_once);
  for (int from = 0; from < ranks.count(); ++from)
    if (messages[static_cast<std::size_t>(from)] != message_of(from, ranks.self())) return false;
  return true;
}

bool numbers_are_reduced(const Ranks& ranks) {
  const auto self = static_cast<std::uint64_t>(ranks.self());
  const auto last = static_cast<std::uint64_t>(ranks.count() - 1);
  std::vector<std::uint64_t> sums{self, 1};
  ranks.add_up(sums);
  std::vector<double> least{-static_cast<double>(self), 2};
  ranks.take_least(least);
  return ranks.least(self) == 0 && ranks.sum(self) == last * (last + 1) / 2 &&
         sums == std::vector<std::uint64_t>{last * (last + 1) / 2, last + 1} &&
         least == std::vector<double>{-static_cast<double>(last), 2} &&
         ranks.broadcast(std::to_string(self), ranks.count() - 1) == std::to_string(last);
}

bool all_is_well() {
  const Ranks ranks;
  bool well = numbers_are_reduced(ranks);
  // The last is what a rank of much memory may send at once, and more than MPI counts.
  for (const std::size_t most : {std::size_t{1}, std::size_t{7}, std::size_t{100},
                                 std::size_t{1000}, std::size_t{100000}, ~std::size_t{0}})
    well = messages_arrive(ranks, most) && well;
  if (!well) std::fprintf(stderr, "rank %d has got something else\n", ranks.self());
  return ranks.least(well ? 1 : 0) == 1;
}

}  // namespace
}  // namespace fathom::app

int main(int argc, char** argv) {
  const fathom::app::MpiSession session(argc, argv);
  return fathom::app::all_is_well() ? 0 : 1;
}
