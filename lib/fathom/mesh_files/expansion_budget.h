#pragma once

#include <cstdint>
#include <string>

/// How much memory the reading of a mesh may take, by how large its files are.
namespace fathom::mesh_files {

/// Some formats can say the same bytes many times over: a glTF accessor may be part of every
/// primitive, a mesh of every node, a mesh file of every entry of a scene file, a list of indices
/// may have a length that costs nothing to write. What is read then has no bound in the size of its
/// file. A budget is one: free_bytes, and `factor` times the bytes of the files. It is asked before
/// memory is taken, so that a file that exceeds it costs no more than its budget.
///
/// The least factor that every file can do with whose bytes are used once is near 37: an instance
/// of EXT_mesh_gpu_instancing is 12 bytes, and an Object with a transform and a name of its own.
/// (A glTF vertex of 4 bytes becomes 24, the index of a strip of one byte a triangle of 12.) The
/// default is nearly twice that, and free_bytes are enough for 2,800,000 vertices or 150,000
/// objects, whatever the file.
class ExpansionBudget {
 public:
  static constexpr std::uint64_t free_bytes = std::uint64_t{64} << 20;
  /// What a triangle counts for each time that its mesh is placed. It takes no memory then, but
  /// 35 bytes and a microsecond when it is rendered: the smallest file may place 33 million.
  static constexpr std::uint64_t bytes_of_placed_triangle = 2;

  /// `file` is the name for messages.
  ExpansionBudget(std::string file, std::uint64_t factor)
      : file_(std::move(file)), factor_(factor) {}

  /// Bytes of the mesh's files: of the first, and of those that it names.
  void add_input(std::uint64_t bytes);

  /// Takes `count` times `size` bytes.
  /// Fails    InputError "FILE: …" if that is more than there is left.
  void take(std::uint64_t count, std::uint64_t size);
  /// Takes an object of so many bytes that places so many triangles.
  void take_object(std::uint64_t bytes, std::uint64_t triangles);

 private:
  [[nodiscard]] std::uint64_t allowed() const;

  std::string file_;
  std::uint64_t factor_;
  std::uint64_t input_ = 0, taken_ = 0;
};

}  // namespace fathom::mesh_files
