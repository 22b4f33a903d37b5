#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/fast/vertices/vertex.h"
#include "fathom/scene/scene.h"

namespace fathom::fast {

/// Memory for vertices in the image, which objects take and give back.
class VertexMemory {
 public:
  using Vertices = std::unique_ptr<ImageVertex[]>;
  /// Room for `count` vertices, whatever it holds.
  Vertices take(std::size_t count);
  /// Where there is no memory for the list, they go back to the system.
  void give_back(Vertices vertices, std::size_t count) noexcept;
  /// Gives what nobody has taken back to the system.
  void forget() { blocks_.clear(); }

 private:
  struct Block {
    Vertices vertices;
    std::size_t count;
  };
  std::vector<Block> blocks_;
};

/// One object with its vertices in the image.
struct ImageObject {
  /// For an object or a part of one; its first triangle is number `first_triangle` of the objects
  /// that are drawn together. That is its number in the scene, too, or else `scene_numbers` has
  /// those of all its triangles, and outlives it.
  ImageObject(const Object& object, const Mesh& its_mesh, const Camera& camera,
              std::uint32_t first_triangle, VertexMemory* kept = nullptr,
              std::span<const std::uint32_t> scene_numbers = {});
  ~ImageObject();
  ImageObject(const ImageObject&) = delete;
  ImageObject& operator=(const ImageObject&) = delete;

  const Mesh& mesh;
  /// Number of its first triangle.
  std::uint32_t first_number;
  VertexTransform transform;
  /// One for each vertex of the mesh.
  std::unique_ptr<ImageVertex[]> vertices;
  /// Where the vertices are given back to; may be null.
  VertexMemory* kept;
  /// The numbers of its triangles in the scene; null where they have the same ones here.
  const std::uint32_t* scene_numbers;

  [[nodiscard]] std::uint32_t end_number() const {
    return first_number + static_cast<std::uint32_t>(mesh.triangles.size());
  }
  /// What the scene calls one of its triangles, and so tiles and the referee do.
  [[nodiscard]] std::uint32_t number_in_scene(std::uint32_t number) const {
    return scene_numbers ? scene_numbers[number - first_number] : number;
  }
};
/// The numbers of their triangles are consecutive.
using ImageObjects = std::deque<ImageObject>;

/// The object that a triangle belongs to.
const ImageObject& object_of(const ImageObjects& objects, std::uint32_t number);

}  // namespace fathom::fast
