#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "fathom/mesh_files/gltf_buffer_views.h"
#include "fathom/text/json_value.h"

/// The numbers of a glTF asset. For this room's .cpp files only.
/// Source   [GLTF20] 3.6.2 (accessors), 3.6.2.3 (sparse)
namespace fathom::mesh_files {

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
};

/// An accessor's elements. That each of them lies inside its buffer is checked when the accessor is
/// opened, before anything is allocated.
class GltfAccessor {
 public:
  /// Fails with InputError if it is malformed or reaches beyond its buffer view. An accessor without
  /// a bufferView is all zeros; it may have at most `most_zeros` elements.
  GltfAccessor(const text::JsonValue& description, GltfBufferViews& views,
               std::uint64_t most_zeros);
  /// Of elements that follow each other closely in `bytes`, whatever bufferView the description
  /// names: for what a decoder has made. `bytes` must outlive this.
  /// Fails with InputError if it is malformed, or there are too few bytes.
  GltfAccessor(const text::JsonValue& description, Bytes bytes);

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
  explicit GltfAccessor(const text::JsonValue& description);
  [[nodiscard]] std::uint64_t element_size() const;
  void read_sparse(GltfBufferViews& views, const text::JsonValue& sparse);
  [[nodiscard]] const std::byte* find(std::uint64_t i) const;

  text::JsonValue description_;
  std::uint64_t count_ = 0;
  GltfComponent component_ = GltfComponent::float32;
  unsigned width_ = 1;
  bool normalized_ = false;
  std::optional<GltfLayout> elements_;
  /// Elements that are given separately, in increasing order.
  std::vector<std::uint32_t> replaced_;
  GltfLayout replacements_;
};

/// The accessors of an asset, each opened when it is first asked for.
class GltfAccessors {
 public:
  /// `root` and `views` must outlive this.
  GltfAccessors(const text::JsonValue& root, GltfBufferViews& views, std::uint64_t most_zeros)
      : root_(root), views_(views), most_zeros_(most_zeros) {}

  /// The accessor that `reference` names by its number.
  std::shared_ptr<const GltfAccessor> at(const text::JsonValue& reference);
  /// An accessor's JSON alone: of what is compressed, the accessor may have no bytes.
  [[nodiscard]] text::JsonValue description(const text::JsonValue& reference) const;
  [[nodiscard]] GltfBufferViews& views() const { return views_; }

 private:
  text::JsonValue root_;
  GltfBufferViews& views_;
  std::uint64_t most_zeros_;
  std::unordered_map<std::uint64_t, std::shared_ptr<const GltfAccessor>> opened_;
};

}  // namespace fathom::mesh_files
