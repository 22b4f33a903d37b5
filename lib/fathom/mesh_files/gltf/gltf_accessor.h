#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <unordered_map>

#include "fathom/mesh_files/expansion_budget.h"
#include "fathom/mesh_files/gltf/gltf_buffers.h"
#include "fathom/mesh_files/gltf/gltf_decoders.h"
#include "fathom/text/json_value.h"

/// The parts of buffers that accessors look at. Only for .cpp files of this module.
/// Source   [GLTF20] 3.6.1.2 (buffer views)
namespace fathom::mesh_files {

/// A part of a buffer, and how far apart its elements are.
struct GltfBufferView {
  Bytes bytes;
  /// The key "byteStride" if it is there; the elements follow each other closely if not.
  std::optional<text::JsonValue> stride;
};

class GltfBufferViews {
 public:
  /// `root`, `buffers` and `decoders` must outlive this.
  GltfBufferViews(const text::JsonValue& root, GltfBuffers& buffers, GltfDecoders& decoders)
      : root_(root), buffers_(buffers), decoders_(decoders) {}

  /// The view that `reference` names by its number. All reads of accessors use this function. A
  /// compressed view is decoded, once, unless the asset also has its uncompressed bytes.
  /// Fails    InputError if there is no such view, it reaches beyond its buffer, or it cannot be
  ///          decoded.
  GltfBufferView at(const text::JsonValue& reference);
  [[nodiscard]] GltfDecoders& decoders() const { return decoders_; }

 private:
  Bytes bytes_in_buffer(const text::JsonValue& place);
  Bytes decoded(const text::JsonValue& view, const text::JsonValue& extension);
  [[nodiscard]] bool has_plain_bytes(const text::JsonValue& view, const char* compression) const;

  text::JsonValue root_;
  GltfBuffers& buffers_;
  GltfDecoders& decoders_;
  std::map<std::uint64_t, Bytes> decoded_;
};

// The numbers of a glTF asset. Only for .cpp files of this module.
// Source   [GLTF20] 3.6.2 (accessors), 3.6.2.3 (sparse)

/// The numeric types of accessors, with glTF's codes.
enum class GltfComponent {
  int8 = 5120,
  uint8 = 5121,
  int16 = 5122,
  uint16 = 5123,
  uint32 = 5125,
  float32 = 5126
};

/// Elements in a buffer view, `stride` bytes apart.
struct GltfLayout {
  Bytes bytes;
  std::uint64_t stride = 0;

  [[nodiscard]] const std::byte* at(std::uint64_t i) const { return bytes.data() + i * stride; }
};

/// An accessor's elements. That each of them lies inside its buffer is checked when the accessor is
/// opened; nothing is copied.
class GltfAccessor {
 public:
  /// Fails    InputError if it is malformed or reaches beyond its buffer view.
  GltfAccessor(const text::JsonValue& description, GltfBufferViews& views, ExpansionBudget& budget);
  /// An accessor of elements that are packed in `bytes`, whatever bufferView the description names:
  /// for the output of decoders. `bytes` must outlive this.
  /// Fails    InputError if it is malformed, or there are too few bytes.
  GltfAccessor(const text::JsonValue& description, Bytes bytes);

  /// May be large at no cost: without a bufferView all elements are zeros.
  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] GltfComponent component() const { return component_; }
  [[nodiscard]] bool normalized() const { return normalized_; }
  /// Numbers per element. Matrices, which nothing that is read here has, are refused.
  [[nodiscard]] unsigned width() const { return width_; }
  [[nodiscard]] const text::JsonValue& description() const { return description_; }

  /// The first width() numbers are the element, the rest is 0.
  using Element = std::array<double, 4>;
  /// Calls visit(i, element) for each element in order. Numbers are exact, except normalized
  /// integers, which are divided by the largest and rounded once.
  template <class Visit>
  void for_each(const Visit& visit) const;
  /// The same. Fails    InputError if a number is not finite.
  template <class Visit>
  void for_each_finite(const Visit& visit) const;
  /// The same of unsigned integers that are not normalized: visit(i, number).
  template <class Visit>
  void for_each_index(const Visit& visit) const;

 private:
  explicit GltfAccessor(const text::JsonValue& description);
  [[nodiscard]] std::uint64_t element_size() const;
  void open_sparse(GltfBufferViews& views, const text::JsonValue& sparse, ExpansionBudget& budget);
  /// Calls visit(i, bytes) for each element in order, with null for zero elements.
  template <class Visit>
  void for_each_place(const Visit& visit) const;
  template <class T, class Visit>
  void for_each_of(const Visit& visit) const;
  [[nodiscard]] std::uint64_t replaced(std::uint64_t place) const;

  text::JsonValue description_;
  std::uint64_t count_ = 0;
  GltfComponent component_ = GltfComponent::float32;
  unsigned width_ = 1;
  bool normalized_ = false;
  std::optional<GltfLayout> elements_;
  /// Sparse elements: their count, their increasing indices, and their values.
  std::uint64_t replaced_count_ = 0;
  GltfComponent replaced_type_ = GltfComponent::uint32;
  GltfLayout replaced_, replacements_;
};

/// The accessors of an asset, each opened at its first use.
class GltfAccessors {
 public:
  /// `root`, `views` and `budget` must outlive this.
  GltfAccessors(const text::JsonValue& root, GltfBufferViews& views, ExpansionBudget& budget)
      : root_(root), views_(views), budget_(budget) {}

  /// The accessor that `reference` names by its number.
  std::shared_ptr<const GltfAccessor> at(const text::JsonValue& reference);
  /// Only an accessor's JSON: accessors of compressed data may have no bytes.
  [[nodiscard]] text::JsonValue description(const text::JsonValue& reference) const;
  [[nodiscard]] const text::JsonValue& root() const { return root_; }
  [[nodiscard]] GltfBufferViews& views() const { return views_; }
  /// Must be called before elements are copied.
  [[nodiscard]] ExpansionBudget& budget() const { return budget_; }

 private:
  text::JsonValue root_;
  GltfBufferViews& views_;
  ExpansionBudget& budget_;
  std::unordered_map<std::uint64_t, std::shared_ptr<const GltfAccessor>> opened_;
};

template <class Visit>
void GltfAccessor::for_each_place(const Visit& visit) const {
  std::uint64_t next = 0;
  for (std::uint64_t i = 0; i < count_; ++i) {
    if (next < replaced_count_ && replaced(next) == i)
      visit(i, replacements_.at(next++));
    else
      visit(i, elements_ ? elements_->at(i) : nullptr);
  }
}

template <class T, class Visit>
void GltfAccessor::for_each_of(const Visit& visit) const {
  constexpr bool is_integer = std::numeric_limits<T>::is_integer;
  const bool fractions = is_integer && normalized_;
  for_each_place([&](std::uint64_t i, const std::byte* place) {
    Element element{};
    for (unsigned k = 0; place != nullptr && k < width_; ++k) {
      T stored;
      std::memcpy(&stored, place + k * sizeof(T), sizeof(T));
      element[k] = static_cast<double>(stored);
      // Of the two least integers both mean −1.
      if (fractions)
        element[k] =
            std::max(element[k] / static_cast<double>(std::numeric_limits<T>::max()), -1.0);
    }
    visit(i, element);
  });
}

template <class Visit>
void GltfAccessor::for_each(const Visit& visit) const {
  switch (component_) {
    case GltfComponent::int8:
      return for_each_of<std::int8_t>(visit);
    case GltfComponent::uint8:
      return for_each_of<std::uint8_t>(visit);
    case GltfComponent::int16:
      return for_each_of<std::int16_t>(visit);
    case GltfComponent::uint16:
      return for_each_of<std::uint16_t>(visit);
    case GltfComponent::uint32:
      return for_each_of<std::uint32_t>(visit);
    case GltfComponent::float32:
      return for_each_of<float>(visit);
  }
}

template <class Visit>
void GltfAccessor::for_each_finite(const Visit& visit) const {
  for_each([&](std::uint64_t i, const Element& element) {
    for (const double number : element)
      if (!std::isfinite(number))
        description_.fail("element " + std::to_string(i) + " is not finite");
    visit(i, element);
  });
}

template <class Visit>
void GltfAccessor::for_each_index(const Visit& visit) const {
  const auto as_stored = [&]<class T>(T) {
    for_each_place([&](std::uint64_t i, const std::byte* place) {
      T stored = 0;
      if (place != nullptr) std::memcpy(&stored, place, sizeof stored);
      visit(i, std::uint32_t{stored});
    });
  };
  switch (component_) {
    case GltfComponent::uint8:
      return as_stored(std::uint8_t{});
    case GltfComponent::uint16:
      return as_stored(std::uint16_t{});
    default:
      return as_stored(std::uint32_t{});
  }
}

}  // namespace fathom::mesh_files
