#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "fathom/failures/errors.h"
#include "fathom/mesh/mesh.h"

/// Binary STL: a header of 84 bytes, which ends with the number of triangles, then 50 bytes each.
namespace fathom::mesh_files {

inline constexpr std::size_t stl_header_size = 84, stl_triangle_size = 50;

/// The number of triangles of a binary STL of `size` bytes, of which `head` has the first 84 or
/// all; warns of bytes after the last triangle.
/// Fails    InputError if the file is too short for the triangles that it claims.
std::uint64_t count_binary_stl(std::span<const std::byte> head, std::uint64_t size,
                               const std::string& file, Warnings& warnings);

/// Normal and corners of triangle `number`, whose bytes begin at `record`.
/// Fails    InputError if a coordinate of a corner is not finite.
std::array<float, 12> read_stl_triangle(const std::byte* record, std::uint64_t number,
                                        const std::string& file);

/// Whether a file has the size of a binary STL with the number of triangles in its header. `head`
/// has the first 84 bytes or all.
bool is_binary_stl_by_size(std::span<const std::byte> head, std::uint64_t size);

/// Whether STL is binary: its size matches its count of triangles, or it does not begin, after
/// comments, with "solid" followed by text. `head` has the first 512 bytes or all.
bool is_binary_stl(std::span<const std::byte> head, std::uint64_t size);

}  // namespace fathom::mesh_files
