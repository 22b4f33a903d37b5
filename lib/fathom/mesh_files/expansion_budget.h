#pragma once

#include <cstdint>
#include <string>

/// How much memory the reading of a mesh may take, by how large its files are.
namespace fathom::mesh_files {

/// Some formats can use the same bytes many times: every primitive may use the same glTF accessor,
/// every node the same mesh, every entry of a scene file the same mesh file, and a list of indices
/// may claim any length. The size of a file then does not limit the memory for reading it. A budget
/// limits it: free_bytes plus `factor` times the bytes of the files. It is checked before memory is
/// allocated, so that a file that exceeds its budget costs no more than the budget.
///
/// If bytes are used once, the greatest factor that a file needs is near 37: an instance of
/// EXT_mesh_gpu_instancing is 12 bytes and becomes an Object with its own transform and name. (A
/// glTF vertex of 4 bytes becomes 24, the index of a strip of one byte a triangle of 12.) The
/// default is nearly twice that, and free_bytes are enough for 2,800,000 vertices or 150,000
/// objects of any file.
class ExpansionBudget {
 public:
  static constexpr std::uint64_t free_bytes = std::uint64_t{64} << 20;
  /// The cost of a triangle for each time that its mesh is placed. Placing takes no memory, but
  /// rendering takes 35 bytes and a microsecond for each: the smallest file may place 33 million.
  static constexpr std::uint64_t bytes_of_placed_triangle = 2;

  /// `file` is the name for messages.
  ExpansionBudget(std::string file, std::uint64_t factor)
      : file_(std::move(file)), factor_(factor) {}

  /// Adds bytes of the mesh's files: of the first file, and of the files that it names.
  void add_input(std::uint64_t bytes);

  /// Takes `count` times `size` bytes.
  /// Fails    InputError "FILE: …" if that is more than there is left.
  void take(std::uint64_t count, std::uint64_t size);
  /// Takes an object of `bytes` bytes that places `triangles` triangles.
  void take_object(std::uint64_t bytes, std::uint64_t triangles);

 private:
  [[nodiscard]] std::uint64_t allowed() const;

  std::string file_;
  std::uint64_t factor_;
  std::uint64_t input_ = 0, taken_ = 0;
};

}  // namespace fathom::mesh_files
