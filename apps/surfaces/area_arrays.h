#pragma once

#include <string>
#include <vector>

#include "apps/surfaces/light_list.h"
#include "apps/surfaces/npz_rows.h"
#include "fathom/area/area_items.h"
#include "fathom/area/areas.h"

namespace fathom::app {

/// Areas as arrays of NPZ. With N lights and M items:
///
///   projected, visible, fraction, lit   N×M; NaN where a value is not defined
///   centroid                            N×M×3; NaN where nothing is visible
///   side                                N×M: 1 front, −1 back, 0 edge; of triangles only
///   names, number                       M, of the items; object and face of triangles and faces
///   lights                              N×3, the directions or points; none of cameras
///   other columns of the lights' file   N, texts
class AreaArrays {
 public:
  AreaArrays(AreaItemKind kind, const AreaItems& items, const LightList& list,
             std::size_t light_count);

  [[nodiscard]] const std::vector<NpzRows::Array>& arrays() const { return arrays_; }
  /// The bytes of a light for the arrays that have rows of lights, which come first.
  [[nodiscard]] std::vector<files::Bytes> rows(const std::vector<LitArea>& areas) const;
  /// Appends the arrays that do not depend on areas.
  void append_others(NpzRows& file) const;

 private:
  void add(const std::string& name, const std::string& type, std::size_t bytes,
           std::vector<std::uint64_t> shape);
  void add_other(const std::string& name, const std::string& type, std::size_t element_bytes,
                 std::vector<std::uint64_t> shape, files::Bytes bytes);
  void add_texts(const std::string& name, const std::vector<std::string>& texts);
  void add_items(const AreaItems& items);
  void add_lights(const LightList& list);

  bool has_sides_;
  std::vector<NpzRows::Array> arrays_;
  std::vector<files::Bytes> others_;
};

}  // namespace fathom::app
