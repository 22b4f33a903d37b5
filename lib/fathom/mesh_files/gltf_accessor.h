#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "fathom/mesh_files/gltf_buffers.h"
#include "fathom/text/json_value.h"

/// The numbers of a glTF asset. For this room's .cpp files only.
/// Source   [GLTF20] 3.6.2 (accessors), 3.6.2.3 (sparse)
namespace fathom::mesh_files {

/// Of the integers of a glTF file, if nothing else limits one.
inline constexpr std::uint64_t largest_integer = std::numeric_limits<std::uint64_t>::max();

/// The numeric types of accessors, with glTF's codes.
enum class GltfComponent {
  int8 = 5120,
  uint8 = 5121,
  int16 = 5122,
  uint16 = 5123,
  uint32 = 5125,
  float32 = 5126
};

/// An accessor's elements. That each of them lies inside its buffer is checked when the accessor is
/// opened, before anything is allocated.
class GltfAccessor {
 public:
  /// Fails with InputError if it is malformed or reaches beyond its buffer. An accessor without a
  /// bufferView is all zeros; it may have at most `most_zeros` elements.
  GltfAccessor(const text::JsonValue& root, GltfBuffers& buffers, const text::JsonValue& reference,
               std::uint64_t most_zeros);

  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] GltfComponent component() const { return component_; }
  [[nodiscard]] bool normalized() const { return normalized_; }
  /// Numbers per element. Matrices, which nothing that is read here has, are refused.
  [[nodiscard]] unsigned width() const { return width_; }
  [[nodiscard]] const text::JsonValue& description() const { return description_; }

  /// Number `k` of element `i` as it is stored; exact.
  [[nodiscard]] double stored(std::uint64_t i, unsigned k) const;
  /// stored(), with normalized integers divided by the largest; rounded once.
  [[nodiscard]] double value(std::uint64_t i, unsigned k) const;
  [[nodiscard]] std::uint32_t index(std::uint64_t i) const {
    return static_cast<std::uint32_t>(stored(i, 0));
  }

 private:
  /// Elements in a buffer, `stride` bytes apart.
  struct Layout {
    Bytes bytes;
    std::uint64_t stride = 0;
  };
  Layout lay_out(const text::JsonValue& root, GltfBuffers& buffers, const text::JsonValue& holder,
                 std::uint64_t count, std::uint64_t element_size, bool strided) const;
  void read_sparse(const text::JsonValue& root, GltfBuffers& buffers,
                   const text::JsonValue& sparse);
  [[nodiscard]] const std::byte* find(std::uint64_t i) const;

  text::JsonValue description_;
  std::uint64_t count_ = 0;
  GltfComponent component_ = GltfComponent::float32;
  unsigned width_ = 1;
  bool normalized_ = false;
  std::optional<Layout> elements_;
  /// Elements that are given separately, in increasing order.
  std::vector<std::uint32_t> replaced_;
  Layout replacements_;
};

}  // namespace fathom::mesh_files
