#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fathom::triangle {

/// What was found out about the triangles (or vertices) that were asked about last, by number: one
/// for each number modulo `most`, so that triangles with neighbouring numbers, which are often
/// neighbours in the image, do not displace each other.
template <class Facts, std::size_t most>
class RecentTriangles {
 public:
  /// The facts about a triangle. If they are not remembered, make(facts) is called first, on the
  /// facts about another triangle or on Facts{}. The reference is valid until another number is
  /// asked for.
  template <class Make>
  Facts& get(std::uint64_t number, const Make& make) {
    if (slots_.empty()) slots_.resize(most);
    Slot& slot = slots_[number % most];
    if (!slot.known || slot.number != number) {
      slot.known = true;
      slot.number = number;
      make(slot.facts);
    }
    return slot.facts;
  }

 private:
  struct Slot {
    std::uint64_t number = 0;
    bool known = false;
    Facts facts;
  };
  std::vector<Slot> slots_;
};

}  // namespace fathom::triangle
