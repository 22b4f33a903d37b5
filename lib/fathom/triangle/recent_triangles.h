#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fathom {

/// What was found out about the triangles that were asked about last, by their numbers: one for
/// each number modulo `most`, so that neighbours in number, which often are neighbours in the
/// image, do not drive each other out.
template <class Facts, std::size_t most>
class RecentTriangles {
 public:
  /// The facts about a triangle. Where it is not remembered, make(facts) is called first, on what
  /// was known of another triangle or on Facts{}. A reference is valid until another number is
  /// asked for.
  template <class Make>
  Facts& get(std::uint32_t number, const Make& make) {
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
    std::uint32_t number = 0;
    bool known = false;
    Facts facts;
  };
  std::vector<Slot> slots_;
};

}  // namespace fathom
