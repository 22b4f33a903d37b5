#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace fathom {

/// The vertices or triangles of a mesh: a vector, or elements in borrowed memory (of_lent). It is
/// used like a vector. Changing borrowed elements first copies them into a vector. Copies of
/// borrowed elements borrow the same memory.
template <class T>
class MeshArray {
 public:
  using value_type = T;
  using iterator = T*;
  using const_iterator = const T*;

  MeshArray() = default;
  MeshArray(std::vector<T> elements) : own_(std::move(elements)) {}  // implicit: it reads as one
  MeshArray(std::initializer_list<T> elements) : own_(elements) {}

  /// Reads the elements where they are: they stay there unchanged while `keeper` is held.
  static MeshArray of_lent(std::span<const T> elements, const std::shared_ptr<const void>& keeper) {
    MeshArray array;
    array.lent_ = elements;
    array.keeper_ = keeper;
    array.is_lent_ = true;
    return array;
  }

  [[nodiscard]] std::size_t size() const { return is_lent_ ? lent_.size() : own_.size(); }
  [[nodiscard]] bool empty() const { return size() == 0; }
  [[nodiscard]] const T* data() const { return is_lent_ ? lent_.data() : own_.data(); }
  [[nodiscard]] const T* begin() const { return data(); }
  [[nodiscard]] const T* end() const { return data() + size(); }
  const T& operator[](std::size_t i) const { return data()[i]; }
  [[nodiscard]] const T& front() const { return *begin(); }
  [[nodiscard]] const T& back() const { return *(end() - 1); }
  /// Fails    std::out_of_range.
  [[nodiscard]] const T& at(std::size_t i) const {
    if (i >= size()) throw std::out_of_range("fathom::MeshArray::at");
    return data()[i];
  }

  /// The vector, with a copy of what was lent.
  std::vector<T>& own() {
    if (is_lent_) {
      own_.assign(lent_.begin(), lent_.end());
      lent_ = {};
      keeper_.reset();
      is_lent_ = false;
    }
    return own_;
  }
  T* data() { return own().data(); }
  T* begin() { return own().data(); }
  T* end() { return begin() + size(); }
  T& operator[](std::size_t i) { return own()[i]; }
  T& at(std::size_t i) { return own().at(i); }
  T& front() { return own().front(); }
  T& back() { return own().back(); }
  void push_back(const T& element) { own().push_back(element); }
  template <class... Parts>
  T& emplace_back(Parts&&... parts) {
    return own().emplace_back(std::forward<Parts>(parts)...);
  }
  void pop_back() { own().pop_back(); }
  [[nodiscard]] std::size_t capacity() const { return is_lent_ ? lent_.size() : own_.capacity(); }
  void reserve(std::size_t count) { own().reserve(count); }
  void resize(std::size_t count) { own().resize(count); }
  void resize(std::size_t count, const T& element) { own().resize(count, element); }
  void shrink_to_fit() { own().shrink_to_fit(); }
  void assign(std::size_t count, const T& element) { own().assign(count, element); }
  template <class Iterator>
  void assign(Iterator first, Iterator last) {
    own().assign(first, last);
  }
  void clear() { *this = {}; }
  /// Only at the end.
  template <class Iterator>
  void append(Iterator first, Iterator last) {
    own().insert(own().end(), first, last);
  }

  friend bool operator==(const MeshArray& a, const MeshArray& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  }

 private:
  std::vector<T> own_;
  std::span<const T> lent_;
  std::shared_ptr<const void> keeper_;
  bool is_lent_ = false;
};

}  // namespace fathom
