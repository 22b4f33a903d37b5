#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/textbook/cases/case_reading.h"
#include "fathom/camera/camera.h"
#include "fathom/pipeline/geometry/vertex_transform.h"
#include "fathom/pipeline/options.h"

/// The records that stages of the pipeline take and return (`fathom pipeline run`).
/// Fails    All functions: InputError if a member is missing or cannot be used.
namespace fathom::app::stages {

/// The most numbers in a list of a record.
inline constexpr std::size_t unlimited = std::size_t{1} << 20;

/// Accepts the keys of all stages, because the answer of a stage is the record of the next stage.
void expect_known_keys(const cases::Json& record);

double number(const cases::Json& record, const std::string& key, double otherwise);
std::int64_t whole(const cases::Json& record, const std::string& key, std::int64_t otherwise,
                   double least, double most);

/// "camera"; nullopt if it is missing.
std::optional<Camera> camera_of(const cases::Json& record);

/// The record's camera with the size of the image: its own, or "width" and "height".
Camera image_of(const cases::Json& record);

pipeline::PipelineOptions options_of(const cases::Json& record, pipeline::Precision precision);

/// A member with a list for each corner; it must have as many lists as there are corners.
std::vector<std::vector<double>> beside(const cases::Json& record, const std::string& key,
                                        std::size_t corners, std::size_t each);

/// A member with a number for each corner.
std::vector<double> numbers_beside(const cases::Json& record, const std::string& key,
                                   std::size_t corners);

/// The attributes of each corner: depth along the view and colour, white where there is none.
template <class Real>
std::vector<std::vector<Real>> attributes_of(const cases::Json& record, std::size_t corners) {
  namespace attribute = pipeline::attribute;
  std::vector<std::vector<Real>> result(corners, std::vector<Real>(attribute::count));
  for (auto& a : result) std::fill_n(a.begin() + attribute::colour, 3, Real(1));
  if (record.contains("colours")) {
    const auto colours = beside(record, "colours", corners, 3);
    for (std::size_t k = 0; k < corners; ++k)
      for (std::size_t i = 0; i < 3; ++i)
        result[k][attribute::colour + i] = static_cast<Real>(colours[k][i]);
  }
  if (record.contains("depths")) {
    const auto depths = numbers_beside(record, "depths", corners);
    for (std::size_t k = 0; k < corners; ++k)
      result[k][attribute::depth] = static_cast<Real>(depths[k]);
  }
  return result;
}

/// The corners in the space that `key` names, with 1/w (1 where it is missing) and attributes.
template <class Vertex, class Real>
std::vector<Vertex> corners_of(const cases::Json& record, const std::string& key) {
  const auto positions = cases::points(record, key, 3, 3);
  const auto attributes = attributes_of<Real>(record, positions.size());
  std::vector<double> inverse_w(positions.size(), 1);
  if (record.contains("inverse_w"))
    inverse_w = numbers_beside(record, "inverse_w", positions.size());
  std::vector<Vertex> corners;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    const auto& p = positions[k];
    Vertex vertex{static_cast<Real>(p[0]),
                  static_cast<Real>(p[1]),
                  static_cast<Real>(p[2]),
                  static_cast<Real>(inverse_w[k]),
                  {}};
    std::copy(attributes[k].begin(), attributes[k].end(), vertex.attributes.begin());
    if (!record.contains("depths") && inverse_w[k] != 0)
      vertex.attributes[pipeline::attribute::depth] = Real(1) / vertex.inverse_w;
    corners.push_back(vertex);
  }
  return corners;
}

/// Numbers, as binary64.
template <class... Reals>
cases::Json list_of(Reals... values) {
  return cases::Json::array({static_cast<double>(values)...});
}

}  // namespace fathom::app::stages
