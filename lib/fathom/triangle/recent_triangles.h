#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fathom::triangle {

/// A cache of facts about the last used triangles (or vertices), by number: one slot for each
/// number modulo `most`, so that triangles with neighbouring numbers, which are often neighbours in
/// the image, do not displace each other.
template <class Facts, std::size_t most>
class RecentTriangles {
 public:
  /// The facts about a triangle. If they are not cached, make(facts) is called first, on the facts
  /// about another triangle or on Facts{}. The reference is valid until get() is called with
  /// another number.
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
