// Messages between ranks arrive in any number of rounds, and so does the news that a rank gives up.
// Started by mpirun; exit status 0 if everything arrives.
#include <cstdio>
#include <random>
#include <stdexcept>

#include "apps/mpi/ranks.h"

namespace fathom::app {
namespace {

/// What one rank sends to another, which both know: of any length, often nothing.
files::Bytes message_of(int from, int to) {
  std::mt19937 random(static_cast<unsigned>(1000 * from + to));
  files::Bytes bytes(random() % 3 == 0 ? 0 : random() % 1000);
  for (std::byte& byte : bytes) byte = static_cast<std::byte>(random() % 256);
  return bytes;
}

bool messages_arrive(const Ranks& ranks, std::size_t most_at_once) {
  std::vector<files::Bytes> messages;
  for (int to = 0; to < ranks.count(); ++to) messages.push_back(message_of(ranks.self(), to));
  messages = ranks.exchange(std::move(messages), most_at_once);
  for (int from = 0; from < ranks.count(); ++from)
    if (messages[static_cast<std::size_t>(from)] != message_of(from, ranks.self())) return false;
  return true;
}

/// What one rank sends to another, message after message, as each is at another pace.
bool sparse_messages_arrive(const Ranks& ranks, std::size_t most_on_the_way) {
  constexpr int rounds = 20;
  const auto count = static_cast<std::size_t>(ranks.count());
  std::vector<files::Bytes> received(count);
  SparseExchange exchange(ranks, most_on_the_way, [&](int from, const files::Bytes& message) {
    files::append(received[static_cast<std::size_t>(from)], message);
  });
  for (int round = 0; round < rounds * (ranks.self() + 1); ++round) {
    for (int to = 0; to < ranks.count(); ++to)
      if (to != ranks.self()) exchange.send(to, message_of(ranks.self(), to + round));
    if (round % 3 == 0) exchange.receive();
  }
  exchange.end();
  bool well = !exchange.is_given_up();
  for (int from = 0; from < ranks.count(); ++from) {
    files::Bytes expected;
    for (int round = 0; from != ranks.self() && round < rounds * (from + 1); ++round)
      files::append(expected, message_of(from, ranks.self() + round));
    well = well && received[static_cast<std::size_t>(from)] == expected;
  }
  return ranks.least(well ? 1 : 0) == 1;
}

/// One rank fails while it works or while it receives messages: all other ranks end, too, and get
/// the reason if they need it.
bool sparse_failures_end(const Ranks& ranks, int failing, bool while_taking) {
  const bool is_failing = ranks.self() == failing;
  bool told = false, thrown = false;
  try {
    SparseExchange exchange(ranks, 1000, [&](int, const files::Bytes&) {
      if (is_failing && while_taking) throw std::runtime_error("a message cannot be taken");
    });
    if (is_failing && !while_taking) throw std::runtime_error("the work cannot be done");
    for (int round = 0; round < 1000 && !exchange.is_given_up(); ++round) {
      for (int to = 0; to < ranks.count(); ++to)
        if (to != ranks.self()) exchange.send(to, files::Bytes(100));
      exchange.receive();
    }
    exchange.end();
    told = exchange.is_given_up();
  } catch (const std::runtime_error&) {
    thrown = true;
  }
  const bool alone = ranks.count() == 1;
  const bool well = thrown == (is_failing && !(alone && while_taking)) && (is_failing || told);
  return ranks.least(well ? 1 : 0) == 1;
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
  // The last size is as much as a rank with much memory may send at once; MPI cannot count it.
  for (const std::size_t most : {std::size_t{1}, std::size_t{7}, std::size_t{100},
                                 std::size_t{1000}, std::size_t{100000}, ~std::size_t{0}})
    well = messages_arrive(ranks, most) && sparse_messages_arrive(ranks, most) && well;
  for (int failing = 0; failing < ranks.count(); ++failing)
    for (const bool while_taking : {false, true})
      well = sparse_failures_end(ranks, failing, while_taking) && well;
  if (!well) std::fprintf(stderr, "rank %d has got something else\n", ranks.self());
  return ranks.least(well ? 1 : 0) == 1;
}

}  // namespace
}  // namespace fathom::app

int main(int argc, char** argv) {
  const fathom::app::MpiSession session(argc, argv);
  return fathom::app::all_is_well() ? 0 : 1;
}
