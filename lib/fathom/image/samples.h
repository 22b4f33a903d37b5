#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <new>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

namespace fathom {

/// Zeroed memory for a map's channel; nullptr for no bytes. The system provides large blocks page
/// by page when they are first written, so that the threads that fill a map share that work too,
/// and in huge pages where it has them.
/// Fails    std::bad_alloc.
void* allocate_zeros(std::size_t bytes);
void free_zeros(void* memory, std::size_t bytes) noexcept;

/// A fixed number of values, 0 until written. It cannot grow or shrink. They are its own, or lie in
/// memory of someone else, who lends it (lent) and does not free it before; copies are their own.
template <class T>
class Samples {
  static_assert(std::is_arithmetic_v<T>);

 public:
  using value_type = T;
  using iterator = T*;
  using const_iterator = const T*;

  Samples() = default;
  /// Fails    std::bad_alloc, also if the bytes are too many to count.
  explicit Samples(std::size_t count)
      : data_(static_cast<T*>(allocate_zeros(bytes_of(count)))), size_(count) {}
  Samples(std::size_t count, T value) : Samples(count) { std::fill(begin(), end(), value); }
  /// Holds the current values of the memory.
  static Samples lent(T* memory, std::size_t count) {
    Samples samples;
    samples.data_ = memory;
    samples.size_ = count;
    samples.is_lent_ = true;
    return samples;
  }
  template <std::forward_iterator Iterator>
  Samples(Iterator first, Iterator last)
      : Samples(static_cast<std::size_t>(std::distance(first, last))) {
    std::copy(first, last, begin());
  }
  Samples(std::initializer_list<T> values) : Samples(values.begin(), values.end()) {}
  // NOLINTNEXTLINE(google-explicit-constructor): a copy, as a vector would be
  Samples(const std::vector<T>& values) : Samples(values.begin(), values.end()) {}

  Samples(const Samples& other) : Samples(other.begin(), other.end()) {}
  Samples(Samples&& other) noexcept
      : data_(std::exchange(other.data_, nullptr)),
        size_(std::exchange(other.size_, 0)),
        is_lent_(std::exchange(other.is_lent_, false)) {}
  Samples& operator=(Samples other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(is_lent_, other.is_lent_);
    return *this;
  }
  ~Samples() {
    if (!is_lent_) free_zeros(data_, size_ * sizeof(T));
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  T* data() { return data_; }
  [[nodiscard]] const T* data() const { return data_; }
  T* begin() { return data_; }
  T* end() { return data_ + size_; }
  [[nodiscard]] const T* begin() const { return data_; }
  [[nodiscard]] const T* end() const { return data_ + size_; }
  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }

  /// Fails    std::out_of_range.
  [[nodiscard]] const T& at(std::size_t i) const {
    if (i >= size_) throw std::out_of_range("fathom::Samples::at");
    return data_[i];
  }

  friend bool operator==(const Samples& a, const Samples& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  }

 private:
  static std::size_t bytes_of(std::size_t count) {
    if (count > SIZE_MAX / sizeof(T)) throw std::bad_alloc();
    return count * sizeof(T);
  }

  T* data_ = nullptr;
  std::size_t size_ = 0;
  bool is_lent_ = false;
};

}  // namespace fathom
