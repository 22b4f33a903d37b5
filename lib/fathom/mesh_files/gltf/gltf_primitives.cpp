#include "fathom/mesh_files/gltf/gltf_primitives.h"

#include <algorithm>
#include <cmath>

#include "fathom/memory/huge_pages.h"
#include "fathom/mesh_files/gltf/gltf_asset.h"
#include "fathom/text/counted.h"

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

bool is_of_bytes_or_shorts(const GltfAccessor& accessor) {
  return accessor.component() != GltfComponent::float32 &&
         accessor.component() != GltfComponent::uint32;
}

void expect_positions(const GltfAccessor& accessor) {
  if (accessor.width() != 3 ||
      !(accessor.component() == GltfComponent::float32 || is_of_bytes_or_shorts(accessor)))
    accessor.description().fail("expected positions to be VEC3 of floats, bytes or shorts");
}

bool are_texture_coordinates(const GltfAccessor& accessor) {
  return accessor.width() == 2 && accessor.component() != GltfComponent::uint32;
}

bool are_normals(const GltfAccessor& accessor) {
  const bool fractions = accessor.normalized() && (accessor.component() == GltfComponent::int8 ||
                                                   accessor.component() == GltfComponent::int16);
  return accessor.width() == 3 && (accessor.component() == GltfComponent::float32 || fractions);
}

bool are_colours(const GltfAccessor& accessor) {
  const bool fractions = accessor.normalized() && (accessor.component() == GltfComponent::uint8 ||
                                                   accessor.component() == GltfComponent::uint16);
  return (accessor.width() == 3 || accessor.width() == 4) &&
         (accessor.component() == GltfComponent::float32 || fractions);
}

bool is_finite(const GltfAccessor::Element& element) {
  return std::all_of(element.begin(), element.end(), [](double x) { return std::isfinite(x); });
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
std::vector<CornerIndices> only_where(std::span<const CornerIndices> triangles,
                                      const HasIt& has_it) {
  std::vector<CornerIndices> result(triangles.begin(), triangles.end());
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
  if (materials_) settle_materials(mesh);
  return mesh;
}

template <class List>
void GltfPrimitives::make_room(List& list, std::uint64_t more) {
  accessors_.budget().take(more, sizeof(typename List::value_type));
  const std::size_t needed = list.size() + more;
  if (needed > list.capacity()) memory::reserve_large(list, std::max(needed, 2 * list.capacity()));
}

/// An attribute is per vertex if all triangles have it, per corner if only some do, and nothing if
/// none do.
void GltfPrimitives::settle_attributes(Mesh& mesh) {
  const auto settle = [&](auto has_it, auto& values, MeshArray<CornerIndices>& corners) {
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

/// Materials are numbered by name: two of one name are one.
void GltfPrimitives::settle_materials(Mesh& mesh) {
  TriangleSegments segments{Segmentation::material, {}, {}};
  std::map<std::string, std::uint32_t> numbers;
  std::vector<std::uint32_t> of_runs;
  for (const Run& run : runs_) {
    std::uint32_t number = unsegmented;
    if (run.material) {
      const std::string name = materials_->name(*run.material);
      const auto [known, is_new] =
          numbers.try_emplace(name, static_cast<std::uint32_t>(numbers.size()));
      number = known->second;
      if (is_new) {
        accessors_.budget().take(2, sizeof(std::string) + name.size());
        segments.names.push_back(name);
      }
    }
    of_runs.push_back(number);
  }
  if (segments.names.empty()) return;
  segments.numbers = compact_segments(of_runs);
  if (segments.numbers.size() > 1) {
    segments.numbers.clear();
    make_room(segments.numbers, mesh.triangles.size());
    for (std::size_t i = 0; i < runs_.size(); ++i)
      segments.numbers.resize(runs_[i].end, of_runs[i]);
  }
  mesh.segments.push_back(std::move(segments));
}

void GltfPrimitives::read_primitive(const JsonValue& primitive, Mesh& mesh) {
  const auto mode_value = primitive.find("mode");
  const std::uint64_t code = mode_value ? mode_value->integer(0, 6) : 4;
  if (code < 4 && !lines_and_points_) {
    ++not_triangles_;
    return;
  }
  const GltfPrimitiveAccessors accessors = open_primitive(primitive, accessors_, attributes_);
  if (!accessors.positions) {
    ++without_positions_;
    return;
  }
  const Vertices vertices = vertices_of(accessors, mesh);
  const bool indexed = accessors.indices != nullptr;
  if (indexed) read_indices(primitive, *accessors.indices, vertices);
  const std::size_t corners = indexed ? corners_.size() : vertices.count;
  if (code < 4) {
    add_lines_or_points(code, corners, vertices, indexed, mesh);
  } else {
    add_triangles(code, corners, vertices, primitive, indexed, mesh);
  }
}

/// [GLTF20] 3.7.2.1: 0 points, 1 lines, 2 a loop of lines, 3 a strip of lines.
void GltfPrimitives::add_lines_or_points(std::uint64_t mode, std::size_t corners,
                                         const Vertices& vertices, bool indexed, Mesh& mesh) {
  const auto vertex = [&](std::size_t corner) { return vertex_of(corner, vertices, indexed); };
  if (mode == 0) {
    make_room(mesh.points, corners);
    for (std::size_t i = 0; i < corners; ++i) mesh.points.push_back(vertex(i));
    return;
  }
  const std::size_t step = mode == 1 ? 2 : 1;
  make_room(mesh.lines, corners);
  for (std::size_t i = 0; i + 1 < corners; i += step)
    mesh.lines.push_back({vertex(i), vertex(i + 1)});
  if (mode == 1) leftover_corners_ += corners % 2;
  if (mode == 2 && corners > 1) mesh.lines.push_back({vertex(corners - 1), vertex(0)});
}

void GltfPrimitives::add_triangles(std::uint64_t code, std::size_t corners,
                                   const Vertices& vertices, const JsonValue& primitive,
                                   bool indexed, Mesh& mesh) {
  const auto mode = static_cast<Mode>(code);
  const std::size_t count = triangles_in(mode, corners);
  if (mode == Mode::triangles) leftover_corners_ += corners % 3;
  if (count > no_index - 1 - mesh.triangles.size())
    primitive.fail("the mesh has more than 4294967294 triangles");
  make_room(mesh.triangles, count);
  const auto vertex = [&](std::size_t corner) { return vertex_of(corner, vertices, indexed); };
  for (std::size_t i = 0; i < count; ++i) {
    const auto [a, b, c] = corners_of(mode, i);
    mesh.triangles.push_back({vertex(a), vertex(b), vertex(c)});
  }
  if (count > 0) {
    runs_.push_back({mesh.triangles.size(), vertices.has_texture, vertices.has_normals, {}});
    if (materials_) {
      runs_.back().material = materials_->of(primitive);
      if (!runs_.back().material && primitive.find("material")) ++missing_materials_;
    }
  }
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

/// Keeps the lists of attributes as long as the list of vertices. Attributes that a primitive lacks
/// are filled in: texture coordinates and normals with zeros to which no corner refers, colours
/// with white, which glTF prescribes.
void GltfPrimitives::read_attributes(const GltfPrimitiveAccessors& accessors, Vertices& vertices,
                                     Mesh& mesh) {
  using Element = GltfAccessor::Element;
  vertices.has_texture =
      read_attribute(accessors.texture_coordinates.get(), are_texture_coordinates, vertices, {},
                     mesh.texture_coordinates, [](const Element& t) {
                       return std::array{t[0], t[1]};
                     });
  vertices.has_normals = read_attribute(accessors.normals.get(), are_normals, vertices, {},
                                        mesh.normals, [](const Element& n) {
                                          return std::array{n[0], n[1], n[2]};
                                        });
  const GltfAccessor* colours = accessors.colours.get();
  const bool had_colours = !mesh.colours.empty();
  if (!colours && !had_colours) return;
  const bool has_alpha = colours && colours->width() == 4;
  const bool has_colours = read_attribute(
      colours, are_colours, vertices, {1, 1, 1, 1}, mesh.colours, [&](const Element& c) {
        const auto part = [&](std::size_t k) {
          return static_cast<float>(std::clamp(c[k], 0.0, 1.0));
        };
        return std::array{part(0), part(1), part(2), has_alpha ? part(3) : 1};
      });
  if (!has_colours && !had_colours) mesh.colours.clear();
}

template <class Value, class Convert>
bool GltfPrimitives::read_attribute(const GltfAccessor* accessor,
                                    bool (*is_of_type)(const GltfAccessor&),
                                    const Vertices& vertices, const Value& missing,
                                    std::vector<Value>& values, const Convert& convert) {
  const std::size_t size = std::size_t{vertices.first} + vertices.count;
  make_room(values, size - values.size());
  values.resize(size, missing);
  if (!accessor) return false;
  bool is_usable = accessor->count() == vertices.count && is_of_type(*accessor);
  if (is_usable) {
    accessor->for_each([&](std::uint64_t i, const GltfAccessor::Element& element) {
      is_usable = is_usable && is_finite(element);
      if (is_usable) values[vertices.first + i] = convert(element);
    });
  }
  if (is_usable) return true;
  ++unusable_attributes_;
  const auto first = values.begin() + static_cast<std::ptrdiff_t>(vertices.first);
  std::fill(first, values.end(), missing);
  return false;
}

void GltfPrimitives::read_indices(const JsonValue& primitive, const GltfAccessor& indices,
                                  const Vertices& vertices) {
  expect_indices(indices);
  corners_.clear();
  make_room(corners_, indices.count());
  corners_.resize(indices.count());
  indices.for_each_index([&](std::uint64_t i, std::uint32_t index) {
    if (index >= vertices.count)
      primitive.fail("index " + std::to_string(index) + " at place " + std::to_string(i) +
                     " is out of range, the primitive has " +
                     text::counted(vertices.count, "vertex", "vertices"));
    corners_[i] = index;
  });
}

void GltfPrimitives::report(const std::string& file, Warnings& warnings) const {
  const auto warn = [&](std::uint64_t count, std::string_view one, std::string_view many) {
    if (count > 0) warnings.push_back(file + ": " + text::counted(count, one, many));
  };
  warn(not_triangles_, "primitive is of points or lines; it is skipped",
       "primitives are of points or lines; they are skipped");
  warn(without_positions_, "primitive has no positions; it is skipped",
       "primitives have no positions; they are skipped");
  warn(leftover_corners_, "index is left over after the last whole primitive",
       "indices are left over after the last whole primitive");
  warn(missing_materials_,
       "primitive has a material that is not in the file; it counts as having none",
       "primitives have materials that are not in the file; they count as having none");
  warn(unusable_attributes_,
       "list of normals, texture coordinates or colours is of the wrong type or length, or not "
       "finite; it is left out",
       "lists of normals, texture coordinates or colours are of the wrong type or length, or not "
       "finite; they are left out");
}

}  // namespace fathom::mesh_files
