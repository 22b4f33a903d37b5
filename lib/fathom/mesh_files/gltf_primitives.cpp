#include "fathom/mesh_files/gltf_primitives.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fathom/numeric/errors.h"

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

double finite(const GltfAccessor& accessor, std::uint64_t i, unsigned k) {
  const double value = accessor.value(i, k);
  if (!std::isfinite(value))
    accessor.description().fail("element " + std::to_string(i) + " is not finite");
  return value;
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
  for (const JsonValue& primitive : description.at("primitives").elements())
    read_primitive(primitive, mesh);
  mesh.face_count = mesh.triangles.size();
  // Per vertex if all have an attribute, per corner if only some do, nothing if none do.
  const auto settle = [&](auto has_it, auto& values, std::vector<CornerIndices>& corners) {
    if (std::all_of(runs_.begin(), runs_.end(), has_it)) return;
    if (std::none_of(runs_.begin(), runs_.end(), has_it)) {
      values.clear();
      return;
    }
    auto run = runs_.begin();
    corners = only_where(mesh.triangles, [&](std::size_t triangle) {
      while (triangle >= run->end) ++run;
      return has_it(*run);
    });
  };
  settle([](const Run& run) { return run.has_texture; }, mesh.texture_coordinates,
         mesh.texture_triangles);
  settle([](const Run& run) { return run.has_normals; }, mesh.normals, mesh.normal_triangles);
  return mesh;
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
  const std::vector<std::uint32_t> corners =
      read_indices(primitive, accessors.indices.get(), vertices);
  const std::size_t count = triangles_in(mode, corners.size());
  if (mode == Mode::triangles) leftover_corners_ += corners.size() % 3;
  if (count > no_index - 1 - mesh.triangles.size())
    primitive.fail("the mesh has more than 4294967294 triangles");
  mesh.triangles.reserve(mesh.triangles.size() + count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto [a, b, c] = corners_of(mode, i);
    mesh.triangles.push_back(
        {vertices.first + corners[a], vertices.first + corners[b], vertices.first + corners[c]});
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

void GltfPrimitives::read_positions(const GltfAccessor& positions, Mesh& mesh) const {
  if (positions.width() != 3 || positions.component() != GltfComponent::float32)
    positions.description().fail("expected positions to be VEC3 of floats");
  mesh.vertices.reserve(mesh.vertices.size() + positions.count());
  for (std::uint64_t i = 0; i < positions.count(); ++i)
    mesh.vertices.push_back(
        {finite(positions, i, 0), finite(positions, i, 1), finite(positions, i, 2)});
}

/// The lists of attributes stay as long as the list of vertices: what a primitive lacks is filled
/// in, texture coordinates and normals with zeros to which no corner refers, colours with white,
/// which is what glTF means by none.
void GltfPrimitives::read_attributes(const GltfPrimitiveAccessors& accessors, Vertices& vertices,
                                     Mesh& mesh) const {
  const auto size = mesh.vertices.size();
  const auto first = vertices.first;
  mesh.texture_coordinates.resize(size);
  if (const GltfAccessor* texture = accessors.texture_coordinates.get()) {
    if (texture->width() != 2) texture->description().fail("expected texture coordinates in VEC2");
    expect_fractions(*texture);
    expect_count(*texture, vertices.count);
    for (std::uint64_t i = 0; i < texture->count(); ++i)
      mesh.texture_coordinates[first + i] = {finite(*texture, i, 0), finite(*texture, i, 1)};
    vertices.has_texture = true;
  }
  mesh.normals.resize(size);
  if (const GltfAccessor* normals = accessors.normals.get()) {
    if (normals->width() != 3 || normals->component() != GltfComponent::float32)
      normals->description().fail("expected normals to be VEC3 of floats");
    expect_count(*normals, vertices.count);
    for (std::uint64_t i = 0; i < normals->count(); ++i)
      mesh.normals[first + i] = {finite(*normals, i, 0), finite(*normals, i, 1),
                                 finite(*normals, i, 2)};
    vertices.has_normals = true;
  }
  const GltfAccessor* colours = accessors.colours.get();
  if (!colours && mesh.colours.empty()) return;
  mesh.colours.resize(size, {1, 1, 1, 1});
  if (!colours) return;
  if (colours->width() != 3 && colours->width() != 4)
    colours->description().fail("expected colours in VEC3 or VEC4");
  expect_fractions(*colours);
  expect_count(*colours, vertices.count);
  for (std::uint64_t i = 0; i < colours->count(); ++i)
    for (unsigned k = 0; k < colours->width(); ++k)
      mesh.colours[first + i][k] = static_cast<float>(std::clamp(finite(*colours, i, k), 0.0, 1.0));
}

std::vector<std::uint32_t> GltfPrimitives::read_indices(const JsonValue& primitive,
                                                        const GltfAccessor* indices,
                                                        const Vertices& vertices) const {
  if (!indices) {
    std::vector<std::uint32_t> all(vertices.count);
    std::iota(all.begin(), all.end(), 0U);
    return all;
  }
  if (indices->width() != 1 || indices->normalized() ||
      (indices->component() != GltfComponent::uint8 &&
       indices->component() != GltfComponent::uint16 &&
       indices->component() != GltfComponent::uint32))
    indices->description().fail("expected indices to be SCALAR unsigned integers");
  std::vector<std::uint32_t> result;
  result.reserve(indices->count());
  for (std::uint64_t i = 0; i < indices->count(); ++i) {
    const std::uint32_t index = indices->index(i);
    if (index >= vertices.count)
      primitive.fail("index " + std::to_string(index) + " at place " + std::to_string(i) +
                     " is out of range, the primitive has " + std::to_string(vertices.count) +
                     " vertices");
    result.push_back(index);
  }
  return result;
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
