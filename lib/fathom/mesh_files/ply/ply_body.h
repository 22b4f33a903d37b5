#pragma once

#include <array>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/failures/errors.h"
#include "fathom/mesh/mesh_faces.h"
#include "fathom/mesh_files/ply/ply_rows.h"
#include "fathom/text/counted.h"

namespace fathom::mesh_files {

/// The meanings of a vertex's properties.
enum PlySlot : int {
  slot_x = 0,
  slot_normal = 3,
  slot_texture = 6,
  slot_colour = 8,
  slot_label = 12,
  slot_count = 13
};

/// The requested values of a vertex, each in the slot of its kind.
using PlyVertex = std::array<double, slot_count>;

/// Walks over the rows of all elements in the order of the file, checks everything, and passes
/// vertices and faces to a sink:
///   begin_vertices(element, has, rows)      has(slot): whether the element has that value
///   vertex(values)
///   begin_faces(element, columns, most, rows)   `most` faces of three corners fit into the file
///   face(face, rows)                        after its row
///   triangle(corners)                       instead of it, if the sink has this function: of a
///                                           face of three corners that has no label
///   begin_strips(element, indices)
///   strip_corner(strip, row, rows)          before a corner of a strip is read
///   strip_triangle(triangle)                a face of its own
/// and, if it has these functions and wants them, edges:
///   wants_edges(), edge(ends)
template <class Rows, class Sink>
class PlyBody {
 public:
  PlyBody(Rows rows, const PlyHeader& header, const std::string& file, bool attributes,
          const PlyLabels& labels, Sink& sink)
      : header_(header),
        file_(file),
        attributes_(attributes),
        labels_(labels),
        sink_(sink),
        reader_(std::move(rows), vertices_of(header, file)) {}

  void read(Warnings& warnings) {
    try {
      read_elements(warnings);
    } catch (const InputError& failure) {
      throw InputError(rows().explained(failure.what()));
    }
  }

 private:
  void read_elements(Warnings& warnings) {
    for (const PlyElement& element : header_.elements) {
      if (element.properties.empty()) continue;
      expect_room(element);
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element);
      } else if (element.name == "tristrips") {
        read_strips(element);
      } else if (element.name == "edge" && wants_edges()) {
        read_edges(element, warnings);
      } else {
        skip_rows(element);
      }
    }
    if (rows().has_more())
      warnings.push_back(file_ + ": " + rows().place() + ": what follows the last row is ignored");
    if (short_strips_ > 0)
      warnings.push_back(file_ + ": " + std::to_string(short_strips_) +
                         (short_strips_ == 1
                              ? " triangle strip of fewer than three corners is skipped"
                              : " triangle strips of fewer than three corners are skipped"));
    if (unusable_labels_ > 0)
      warnings.push_back(
          file_ + ": " +
          text::counted(unusable_labels_, "label is no number", "labels are no numbers") +
          " from 0 to 4294967293: what has " + (unusable_labels_ == 1 ? "it" : "them") +
          " counts as not labelled");
  }

  static constexpr int skipped = -1;

  Rows& rows() { return reader_.rows(); }

  static std::uint64_t vertices_of(const PlyHeader& header, const std::string& file) {
    const PlyElement* vertices = header.find("vertex");
    if (!vertices) throw InputError(file + ": has no element vertex, expected one");
    if (vertices->properties.empty() && vertices->count > 0) fail_lacks_coordinates(file);
    return vertices->count;
  }

  [[noreturn]] static void fail_lacks_coordinates(const std::string& file) {
    throw InputError(file + ": element vertex lacks x, y or z, expected all three");
  }

  /// The rest of the file must have room for the rows that the header claims.
  void expect_room(const PlyElement& element) {
    mesh::expect_countable(element.count, ("rows of element " + element.name).c_str(), file_);
    const std::uint64_t size = Rows::least_row_size(element);
    if (element.count > rows().rest() / size)
      throw InputError(file_ + ": " + text::counted(element.count, "row") + " of element " +
                       element.name + (element.count == 1 ? " is" : " are") +
                       " claimed, expected a file long enough for them");
  }

  std::vector<int> plan_vertex(const PlyElement& element) const {
    std::vector<int> plan(element.properties.size(), skipped);
    const auto assign = [&](int slot, std::initializer_list<std::string_view> names) {
      const auto at = element.find(names);
      if (!at || element.properties[*at].count_type) return false;
      plan[*at] = slot;
      return true;
    };
    if (!assign(slot_x, {"x"}) || !assign(slot_x + 1, {"y"}) || !assign(slot_x + 2, {"z"}))
      fail_lacks_coordinates(file_);
    if (labels_.in_vertex) plan[*labels_.in_vertex] = slot_label;
    if (!attributes_) return plan;
    assign(slot_normal, {"nx"}), assign(slot_normal + 1, {"ny"}), assign(slot_normal + 2, {"nz"});
    assign(slot_texture, {"s", "u", "texture_u"}),
        assign(slot_texture + 1, {"t", "v", "texture_v"});
    assign(slot_colour, {"red"}), assign(slot_colour + 1, {"green"});
    assign(slot_colour + 2, {"blue"}), assign(slot_colour + 3, {"alpha"});
    return plan;
  }

  void read_vertices(const PlyElement& element) {
    const std::vector<int> plan = plan_vertex(element);
    sink_.begin_vertices(
        element, [&](int slot) { return std::find(plan.begin(), plan.end(), slot) != plan.end(); },
        rows());
    PlyVertex row{};
    row[slot_colour + 3] = 1;
    const std::optional<PlyPointLayout> layout = point_layout(element, plan);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      if (layout && take_point(*layout, row)) {
        sink_.vertex(row);
        continue;
      }
      rows().begin_row(element, i);
      for (std::size_t k = 0; k < plan.size(); ++k) read_value(element.properties[k], plan[k], row);
      rows().end_row();
      sink_.vertex(row);
    }
  }

  static constexpr bool takes_points =
      requires(Rows & rows, const PlyPointLayout& layout, std::array<double, 3>& point) {
    rows.take_point(layout, point);
  };

  /// Where the coordinates lie if they are floats of one type and no other property is read of a
  /// vertex.
  static std::optional<PlyPointLayout> point_layout(const PlyElement& element,
                                                    const std::vector<int>& plan) {
    PlyPointLayout layout;
    std::optional<PlyType> type;
    for (std::size_t k = 0; k < plan.size(); ++k) {
      const PlyProperty& property = element.properties[k];
      if (property.count_type || plan[k] >= slot_normal) return std::nullopt;
      if (plan[k] != skipped) {
        if (is_integer(property.type) || (type && *type != property.type)) return std::nullopt;
        type = property.type;
        layout.offsets[static_cast<std::size_t>(plan[k])] = layout.row_size;
      }
      layout.row_size += size_of(property.type);
    }
    layout.type = *type;  // a vertex has coordinates
    return layout;
  }

  bool take_point(const PlyPointLayout& layout, PlyVertex& row) {
    if constexpr (takes_points) {
      std::array<double, 3> point;
      if (!rows().take_point(layout, point)) return false;
      std::copy(point.begin(), point.end(), row.begin());
      return true;
    } else {
      return false;
    }
  }

  void read_value(const PlyProperty& property, int slot, PlyVertex& row) {
    if (slot == skipped) return reader_.skip(property);
    if (slot == slot_label) {
      row[slot] = usable(rows().label(property.type));
      return;
    }
    if (slot < slot_normal) {
      static constexpr const char* names[] = {"coordinate x", "coordinate y", "coordinate z"};
      row[slot] = rows().finite(property.type, names[slot]);
      return;
    }
    row[slot] = rows().attribute(property.type);
    if (slot >= slot_colour) row[slot] = colour_component(row[slot], property.type);
  }

  /// A number in [0, 1]: integers are fractions of the greatest number of their type.
  static double colour_component(double value, PlyType type) {
    if (type == PlyType::uint8) value /= 255;
    if (type == PlyType::uint16) value /= 65535;
    return value > 0 ? std::min(value, 1.0) : 0;
  }

  void read_faces(const PlyElement& element) {
    const PlyFaceColumns columns{indices_of(element), labels_.in_face};
    const std::uint64_t least =
        Rows::least_triangle_size(element, element.properties[columns.indices]);
    sink_.begin_faces(element, columns, std::min(element.count, rows().rest() / least), rows());
    const bool only_corners = element.properties.size() == 1;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      if (only_corners && take_triangle(element.properties[0])) continue;
      rows().begin_row(element, i);
      reader_.read_face(element, columns, face_);
      rows().expect_face(face_.ring.size());
      rows().end_row();
      if (columns.label) usable(face_.label);
      sink_.face(face_, rows());
    }
  }

  static constexpr bool takes_triangles =
      requires(Rows & rows, Sink& sink, CornerIndices& triangle) {
    rows.take_triangle(PlyProperty(), 0, triangle);
    sink.triangle(triangle);
  };

  /// A face that is a triangle, at once.
  bool take_triangle(const PlyProperty& indices) {
    if constexpr (takes_triangles) {
      CornerIndices triangle;
      if (!rows().take_triangle(indices, reader_.vertex_count(), triangle)) return false;
      sink_.triangle(triangle);
      return true;
    } else {
      return false;
    }
  }

  /// A label, unchanged; numbers that are not labels are counted.
  std::uint32_t usable(std::uint32_t label) {
    if (label == unsegmented) ++unusable_labels_;
    return label;
  }

  /// The place of the list of corners among the properties.
  std::size_t indices_of(const PlyElement& element) const {
    const auto indices = element.find({"vertex_indices", "vertex_index"});
    if (!indices || !element.properties[*indices].count_type)
      throw InputError(file_ + ": element " + element.name +
                       " lacks the list vertex_indices, expected it");
    return *indices;
  }

  void read_strips(const PlyElement& element) {
    const std::size_t indices = indices_of(element);
    if (!is_integer(element.properties[indices].type))
      throw InputError(file_ + ": element " + element.name +
                       " lacks the list vertex_indices of integers, expected it");
    sink_.begin_strips(element, indices);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      rows().begin_row(element, i);
      for (std::size_t k = 0; k < element.properties.size(); ++k) {
        if (k == indices) {
          read_strip(element.properties[k], i);
        } else {
          reader_.skip(element.properties[k]);
        }
      }
      rows().end_row();
    }
  }

  void read_strip(const PlyProperty& indices, std::uint64_t row) {
    PlyStrip strip = reader_.begin_strip(indices);
    while (strip.left > 0) {
      const std::uint64_t corners = strip.corners;
      sink_.strip_corner(strip, row, rows());
      if (const auto triangle = reader_.next_corner(indices, strip))
        sink_.strip_triangle(*triangle);
      if (strip.corners == 0) note_end_of_strip(corners);
    }
    note_end_of_strip(strip.corners);
  }

  void note_end_of_strip(std::uint64_t corners) {
    if (corners == 1 || corners == 2) ++short_strips_;
  }

  static constexpr bool takes_edges = requires(Sink & sink) { sink.wants_edges(); };

  [[nodiscard]] bool wants_edges() const {
    if constexpr (takes_edges) {
      return sink_.wants_edges();
    } else {
      return false;
    }
  }

  void read_edges(const PlyElement& element, Warnings& warnings) {
    const auto first = element.find({"vertex1"}), second = element.find({"vertex2"});
    if (!first || !second || element.properties[*first].count_type ||
        element.properties[*second].count_type) {
      warnings.push_back(file_ + ": element edge lacks vertex1 or vertex2; its " +
                         std::to_string(element.count) + " rows are skipped");
      return skip_rows(element);
    }
    for (std::uint64_t i = 0; i < element.count; ++i) {
      rows().begin_row(element, i);
      std::array<std::uint32_t, 2> ends{};
      for (std::size_t k = 0; k < element.properties.size(); ++k) {
        const PlyProperty& property = element.properties[k];
        if (k == *first || k == *second) {
          ends[k == *first ? 0 : 1] = reader_.read_index(property);
        } else {
          reader_.skip(property);
        }
      }
      rows().end_row();
      if constexpr (takes_edges) sink_.edge(ends);
    }
  }

  void skip_rows(const PlyElement& element) {
    for (std::uint64_t i = 0; i < element.count; ++i) {
      rows().begin_row(element, i);
      for (const PlyProperty& property : element.properties) reader_.skip(property);
      rows().end_row();
    }
  }

  const PlyHeader& header_;
  const std::string& file_;
  bool attributes_;
  PlyLabels labels_;
  Sink& sink_;
  PlyRowReader<Rows> reader_;
  PlyFace face_;
  std::uint64_t short_strips_ = 0, unusable_labels_ = 0;
};

}  // namespace fathom::mesh_files
