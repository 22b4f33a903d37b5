#pragma once

#include <cstdint>
#include <string>

/// How many triangles, vertices and faces can be numbered, in a mesh and in a scene.
namespace fathom::mesh {

/// The most triangles, vertices or faces that are allowed: the next number means "none".
inline constexpr std::uint64_t most_elements = 0xFFFFFFFE;

/// Throws InputError "FILE: N WHAT are more than …" where `count` is above most_elements.
void expect_countable(std::uint64_t count, const char* what, const std::string& file);

/// Throws the InputError of a file with more than most_elements triangles or faces.
[[noreturn]] void fail_too_many_triangles(const std::string& file);

}  // namespace fathom::mesh
