#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

/// The lens models: names, parameters in order, and properties (specification, section 2).
namespace fathom {

enum class LensModel : std::uint8_t {
  simple_pinhole,
  pinhole,
  simple_radial,
  radial,
  opencv,
  full_opencv,
  opencv_14,
  brown,
  simple_division,
  division,
  fisheye_stereographic,
};

/// The numbers of which the directions of a model are made. It decides how the sign of a form at a
/// direction is found (README.md).
enum class DirectionClass : std::uint8_t {
  rational,    ///< rational numbers
  polynomial,  ///< rational functions of the root of a polynomial
};

/// A row of the table.
struct LensModelEntry {
  LensModel model;
  std::string_view name;
  /// The number of the model in COLMAP's binary files.
  std::optional<int> colmap_id;
  DirectionClass direction_class;
  /// Whether every ray has z > 0, so that near and far bound Z.
  bool is_plane;
  /// f cx cy or fx fy cx cy.
  std::span<const std::string_view> intrinsics;
  /// The parameters after these, in order.
  std::span<const std::string_view> distortion;
  /// How many numbers of distortion may be given; the rest is 0.
  std::span<const std::size_t> distortion_counts;
};

/// All models, in the order of LensModel.
std::span<const LensModelEntry> lens_models();
const LensModelEntry& entry_of(LensModel model);
std::string_view name_of(LensModel model);
/// The model of this name; nullopt if there is none. Names are in capitals: "OPENCV".
std::optional<LensModel> lens_model_named(std::string_view name);
/// The model with this number in COLMAP's files; nullopt if there is none.
std::optional<LensModel> lens_model_of_colmap(int id);

}  // namespace fathom
