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
  simple_fisheye,
  fisheye,
  simple_radial_fisheye,
  radial_fisheye,
  opencv_fisheye,
  thin_prism_fisheye,
  table,
};

/// What a model says of a ray (specification, section 2).
enum class RayFormula : std::uint8_t {
  /// The ray is (m, 1), where the stage takes m to the sample: every ray has z > 0.
  plane,
  /// The angle of the ray to the z axis is |m|, where the stage takes m to the sample.
  angle,
  /// The ray is given, by a formula or by a table.
  direct,
};

/// A row of the table.
struct LensModelEntry {
  LensModel model;
  std::string_view name;
  RayFormula formula;
  /// f cx cy or fx fy cx cy; none of a table.
  std::span<const std::string_view> intrinsics;
  /// The parameters after these, in order.
  std::span<const std::string_view> distortion;
  /// How many numbers of distortion a list may have that is shorter; the rest is 0.
  std::span<const std::size_t> shorter_lists;
};

/// All models, in the order of LensModel.
std::span<const LensModelEntry> lens_models();
const LensModelEntry& entry_of(LensModel model);
std::string_view name_of(LensModel model);
/// The model of this name; nullopt if there is none. Names are in capitals: "OPENCV".
std::optional<LensModel> lens_model_named(std::string_view name);
/// Whether every ray has z > 0, so that near and far bound Z.
bool is_plane(LensModel model);
/// Whether the model has a stage, and a point m before it.
bool has_stage(LensModel model);
/// Whether the model has f in the place of fx and fy, and no skew.
bool has_one_focal_length(const LensModelEntry& model);

}  // namespace fathom
