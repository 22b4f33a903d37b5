#pragma once

#include <cstdint>
#include <optional>

#include "fathom/mesh_files/triangle_stream.h"

namespace fathom::bench {

/// Triangles that are made when they are asked for, each a function of its number: as many as a
/// benchmark wants, without a file and without memory. Coordinates are binary32 numbers, as most
/// files have them. Faces are triangles.
class GeneratedStream : public TriangleStream {
 public:
  /// `bounds` hold all corners; they need not be the closest.
  GeneratedStream(std::uint32_t count, const Bounds& bounds) : count_(count), bounds_(bounds) {}

  [[nodiscard]] std::uint32_t triangle_count() const override { return count_; }
  [[nodiscard]] std::uint64_t face_count() const override { return count_; }
  [[nodiscard]] std::optional<Bounds> bounds() const override;
  [[nodiscard]] TriangleChunk read(std::uint32_t first, std::uint32_t count) const override;
  [[nodiscard]] std::uint32_t face_of(std::uint32_t number) const override { return number; }

 private:
  /// Adds triangles first ≤ number < end, at least one, all of which there are. They have the
  /// corners that triangle() gives them, bit for bit.
  virtual void add_triangles(std::uint32_t first, std::uint32_t end, Mesh& mesh) const = 0;

  std::uint32_t count_;
  Bounds bounds_;
};

/// The nearest binary32 number.
inline double as_in_a_file(double value) {
  return static_cast<double>(static_cast<float>(value));
}

}  // namespace fathom::bench
