#include "fathom/mesh_files/gltf_primitives.h"

#include <algorithm>

#include "fathom/mesh_files/gltf_references.h"

namespace fathom::mesh_files {
using namespace text;

namespace {

enum class Mode { triangles = 4, strip = 5, fan = 6 };

std::size_t triangles_in(Mode mode, std::size_t corners) {
  if (mode == Mode::triangles) return corners / 3;
  return corners < 3 ? 0 : corners - 2;
}

/// Triangle `i` of a primitive, as in [GLTF20] 3.7.2.1.
std::array<std::size_t, 3> corners_of(Mode mode, std::size_t i) {
  switch (mode) {
    case Mode::strip:
      return {i, i + 1 + i % 2, i + 2 - i % 2};
    case Mode::fan:
      return {i + 1, i + 2, 0};
    default:
      return {3 * i, 3 * i + 1, 3 * i + 2};
  }
}

void expect_count(const GltfAccessor& accessor, std::uint64_t count) {
  if (accessor.count() != count)
    accessor.description().fail("has " + std::to_string(accessor.count()) + " elements, expected " +
                                std::to_string(count) + " as the positions have");
}

/// Expects binary32 numbers, or integers that mean fractions.
void expect_fractions(const GltfAccessor& accessor) {
  const bool integers =
      accessor.component() == GltfComponent::uint8 || accessor.component() == GltfComponent::uint16;
  if (accessor.component() != GltfComponent::float32 && !(integers && accessor.normalized()))
    accessor.description().fail("expected floats or normalized unsigned integers");
}

bool is_of_bytes_or_shorts(const GltfAccessor& accessor) {
  return accessor.component() != GltfComponent::float32 &&
         accessor.component() != GltfComponent::uint32;
}

void expect_positions(const GltfAccessor& accessor) {
  if (accessor.width() != 3 ||
      !(accessor.component() == GltfComponent::float32 || is_of_bytes_or_shorts(accessor)))
    accessor.description().fail("expected positions to be VEC3 of floats, bytes or shorts");
}

void expect_texture_coordinates(const GltfAccessor& accessor) {
  if (accessor.width() != 2) accessor.description().fail("expected texture coordinates in VEC2");
  if (accessor.component() == GltfComponent::uint32)
    accessor.description().fail("expected texture coordinates to be floats, bytes or shorts");
}

void expect_normals(const GltfAccessor& accessor) {
  const bool fractions = accessor.normalized() && (accessor.component() == GltfComponent::int8 ||
                                                   accessor.component() == GltfComponent::int16);
  if (accessor.width() != 3 || !(accessor.component() == GltfComponent::float32 || fractions))
    accessor.description().fail(
        "expected normals to be VEC3 of floats, or of normalized bytes or shorts");
}

void expect_colours(const GltfAccessor& accessor) {
  if (accessor.width() != 3 && accessor.width() != 4)
    accessor.description().fail("expected colours in VEC3 or VEC4");
  expect_fractions(accessor);
}

void expect_indices(const GltfAccessor& accessor) {
  if (accessor.width() != 1 || accessor.normalized() ||
      (accessor.component() != GltfComponent::uint8 &&
       accessor.component() != GltfComponent::uint16 &&
       accessor.component() != GltfComponent::uint32))
    accessor.description().fail("expected indices to be SCALAR unsigned integers");
}

/// The indices of the corners that have an attribute, if not all have it.
template <class HasIt>
std::vector<CornerIndices> only_where(const std::vector<CornerIndices>& triangles,
                                      const HasIt& has_it) {
  std::vector<CornerIndices> result(triangles);
  for (std::size_t i = 0; i < result.size(); ++i)
    if (!has_it(i)) result[i] = {no_index, no_index, no_index};
  return result;
}

}  // namespace

Mesh GltfPrimitives::read(const JsonValue& description) {
  Mesh mesh;
  vertices_.clear();
  runs_.clear();
  for_each_entry(description.at("primitives"),
                 [&](const JsonValue& primitive) { read_primitive(primitive, mesh); });
  mesh.face_count = mesh.triangles.size();
  settle_attributes(mesh);
  return mesh;
}

template <class T>
void GltfPrimitives::make_room(std::vector<T>& list, std::uint64_t more) {
  accessors_.budget().take(more, sizeof(T));
  const std::size_t needed = list.size() + more;
  if (needed > list.capacity()) list.reserve(std::max(needed, 2 * list.capacity()));
}

/// An attribute is per vertex if all triangles have it, per corner if only some do, and nothing if
/// none do.
void GltfPrimitives::settle_attributes(Mesh& mesh) {
  const auto settle = [&](auto has_it, auto& values, std::vector<CornerIndices>& corners) {
    if (std::all_of(runs_.begin(), runs_.end(), has_it)) return;
    if (std::none_of(runs_.begin(), runs_.end(), has_it)) {
      values.clear();
      return;
    }
    accessors_.budget().take(mesh.triangles.size(), sizeof(CornerIndices));
    auto run = runs_.begin();
    corners = only_where(mesh.triangles, [&](std::size_t triangle) {
      while (triangle >= run->end) ++run;
      return has_it(*run);
    });
  };
  settle([](const Run& run) { return run.has_texture; }, mesh.texture_coordinates,
         mesh.texture_triangles);
  settle([](const Run& run) { return run.has_normals; }, mesh.normals, mesh.normal_triangles);
}

void GltfPrimitives::read_primitive(const JsonValue& primitive, Mesh& mesh) {
  const auto mode_value = primitive.find("mode");
  const std::uint64_t code = mode_value ? mode_value->integer(0, 6) : 4;
  if (code < 4) {
    ++not_triangles_;
    return;
  }
  const auto mode = static_cast<Mode>(code);
  const GltfPrimitiveAccessors accessors = open_primitive(primitive, accessors_, attributes_);
  if (!accessors.positions) {
    ++without_positions_;
    return;
  }
  const Vertices vertices = vertices_of(accessors, mesh);
  const bool indexed = accessors.indices != nullptr;
  if (indexed) read_indices(primitive, *accessors.indices, vertices);
  const std::size_t corners = indexed ? corners_.size() : vertices.count;
  const std::size_t count = triangles_in(mode, corners);
  if (mode == Mode::triangles) leftover_corners_ += corners % 3;
  if (count > no_index - 1 - mesh.triangles.size())
    primitive.fail("the mesh has more than 4294967294 triangles");
  make_room(mesh.triangles, count);
  const auto vertex = [&](std::size_t corner) {
    return vertices.first + (indexed ? corners_[corner] : static_cast<std::uint32_t>(corner));
  };
  for (std::size_t i = 0; i < count; ++i) {
    const auto [a, b, c] = corners_of(mode, i);
    mesh.triangles.push_back({vertex(a), vertex(b), vertex(c)});
  }
  if (count > 0)
    runs_.push_back({mesh.triangles.size(), vertices.has_texture, vertices.has_normals});
}

const GltfPrimitives::Vertices& GltfPrimitives::vertices_of(const GltfPrimitiveAccessors& accessors,
                                                            Mesh& mesh) {
  const auto [known, is_new] = vertices_.try_emplace(
      {accessors.positions, accessors.texture_coordinates, accessors.normals, accessors.colours});
  Vertices& vertices = known->second;
  if (!is_new) return vertices;
  const GltfAccessor& positions = *accessors.positions;
  if (positions.count() > no_index - mesh.vertices.size())
    positions.description().fail("the mesh has more than 4294967295 vertices");
  vertices.first = static_cast<std::uint32_t>(mesh.vertices.size());
  vertices.count = static_cast<std::uint32_t>(positions.count());
  read_positions(positions, mesh);
  if (attributes_) read_attributes(accessors, vertices, mesh);
  return vertices;
}

void GltfPrimitives::read_positions(const GltfAccessor& positions, Mesh& mesh) {
  expect_positions(positions);
  quantized_positions_ |= is_of_bytes_or_shorts(positions);
  make_room(mesh.vertices, positions.count());
  positions.for_each_finite([&](std::uint64_t, const GltfAccessor::Element& p) {
    mesh.vertices.push_back({p[0], p[1], p[2]});
  });
}

/// The lists of attributes stay as long as the list of vertices: what a primitive lacks is filled
/// in, texture coordinates and normals with zeros to which no corner refers, colours with white,
/// which is what glTF means by none.
void GltfPrimitives::read_attributes(const GltfPrimitiveAccessors& accessors, Vertices& vertices,
                                     Mesh& mesh) {
  using Element = GltfAccessor::Element;
  const auto size = mesh.vertices.size();
  const auto first = vertices.first;
  make_room(mesh.texture_coordinates, vertices.count);
  mesh.texture_coordinates.resize(size);
  if (const GltfAccessor* texture = accessors.texture_coordinates.get()) {
    expect_texture_coordinates(*texture);
    expect_count(*texture, vertices.count);
    texture->for_each_finite([&](std::uint64_t i, const Element& t) {
      mesh.texture_coordinates[first + i] = {t[0], t[1]};
    });
    vertices.has_texture = true;
  }
  make_room(mesh.normals, vertices.count);
  mesh.normals.resize(size);
  if (const GltfAccessor* normals = accessors.normals.get()) {
    expect_normals(*normals);
    expect_count(*normals, vertices.count);
    normals->for_each_finite([&](std::uint64_t i, const Element& n) {
      mesh.normals[first + i] = {n[0], n[1], n[2]};
    });
    vertices.has_normals = true;
  }
  const GltfAccessor* colours = accessors.colours.get();
  if (!colours && mesh.colours.empty()) return;
  make_room(mesh.colours, size - mesh.colours.size());
  mesh.colours.resize(size, {1, 1, 1, 1});
  if (!colours) return;
  expect_colours(*colours);
  expect_count(*colours, vertices.count);
  colours->for_each_finite([&](std::uint64_t i, const Element& colour) {
    for (unsigned k = 0; k < colours->width(); ++k)
      mesh.colours[first + i][k] = static_cast<float>(std::clamp(colour[k], 0.0, 1.0));
  });
}

void GltfPrimitives::read_indices(const JsonValue& primitive, const GltfAccessor& indices,
                                  const Vertices& vertices) {
  expect_indices(indices);
  corners_.clear();
  make_room(corners_, indices.count());
  indices.for_each_index([&](std::uint64_t i, std::uint32_t index) {
    if (index >= vertices.count)
      primitive.fail("index " + std::to_string(index) + " at place " + std::to_string(i) +
                     " is out of range, the primitive has " + std::to_string(vertices.count) +
                     " vertices");
    corners_.push_back(index);
  });
}

void GltfPrimitives::report(const std::string& file, Warnings& warnings) const {
  const auto warn = [&](std::uint64_t count, const std::string& what) {
    if (count > 0) warnings.push_back(file + ": " + std::to_string(count) + what);
  };
  warn(not_triangles_, " primitives are points or lines; they are skipped");
  warn(without_positions_, " primitives have no positions; they are skipped");
  warn(leftover_corners_, " indices are left over after the last whole triangle");
}

}  // namespace fathom::mesh_files
