#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

namespace fathom::fast {

/// The numbers of the bits that are 1, from the lowest on: for (const std::size_t k :
/// EachBit(bits)).
class EachBit {
 public:
  class Iterator {
   public:
    explicit Iterator(std::uint64_t bits) : bits_(bits) {}
    std::size_t operator*() const { return static_cast<std::size_t>(std::countr_zero(bits_)); }
    Iterator& operator++() {
      bits_ &= bits_ - 1;
      return *this;
    }
    bool operator==(const Iterator&) const = default;

   private:
    std::uint64_t bits_;
  };

  explicit EachBit(std::uint64_t bits) : bits_(bits) {}
  [[nodiscard]] Iterator begin() const { return Iterator(bits_); }
  // Iterators recognise their ends by the remaining bits, not by their container.
  [[nodiscard]] static Iterator end() { return Iterator(0); }

 private:
  std::uint64_t bits_;
};

}  // namespace fathom::fast
