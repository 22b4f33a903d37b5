#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "fathom/camera/direction_table.h"

/// Lenses: the table of their models, their numbers, and lenses made from lists of numbers.
namespace fathom {

/// The lens models (specification, section 2).
enum class LensModel : std::uint8_t {
  simple_pinhole,
  pinhole,
  simple_radial,
  radial,
  opencv,
  full_opencv,
  opencv_14,
  brown,
  fov,
  simple_division,
  division,
  fisheye_stereographic,
  simple_fisheye,
  fisheye,
  simple_radial_fisheye,
  radial_fisheye,
  opencv_fisheye,
  thin_prism_fisheye,
  rad_tan_thin_prism_fisheye,
  fisheye_orthographic,
  fisheye_equisolid,
  ucm,
  eucm,
  double_sphere,
  omni,
  ftheta,
  equirectangular,
  cylindrical,
  table,
};

/// How a model defines a ray (specification, section 2).
enum class RayFormula : std::uint8_t {
  /// The ray is (m, 1), where the stage takes m to the sample: every ray has z > 0.
  plane,
  /// The angle of the ray to the z axis is |m|, where the stage takes m to the sample.
  angle,
  /// The tangent of an angle in proportion to the distance from the axis gives the ray: every ray
  /// has z > 0.
  field_of_view,
  /// A formula with a square root gives the ray.
  root,
  /// A polynomial of the distance of the sample from the axis is the angle of the ray to the axis.
  angle_of_sample,
  /// A rational formula or a table gives the ray.
  direct,
  /// A panorama: the horizontal position of the sample is an angle, in parts of a turn.
  turn,
};

/// A row of the table.
struct LensModelEntry {
  LensModel model;
  std::string_view name;
  RayFormula formula;
  /// f cx cy, fx fy cx cy, or of a panorama w h cx cy or w fy cx cy; empty for TABLE.
  std::span<const std::string_view> intrinsics;
  /// The parameters after these, in order.
  std::span<const std::string_view> distortion;
  /// How many numbers of distortion a list may have that is shorter; the rest is 0.
  std::span<const std::size_t> shorter_lists;
};

struct Lens;

/// All models, in the order of LensModel.
std::span<const LensModelEntry> lens_models();
const LensModelEntry& entry_of(LensModel model);
std::string_view name_of(LensModel model);
/// The model of this name; nullopt if no model has it. Names are in capitals: "OPENCV".
std::optional<LensModel> lens_model_named(std::string_view name);
/// Whether every ray has z > 0, so that near and far bound Z.
bool is_plane(LensModel model);
/// Whether the model has a stage, and a point m before it.
bool has_stage(LensModel model);
/// Whether the lens has a stage before a formula with a root: OMNI with distortion.
bool has_stage_before_root(const Lens& lens);
/// Whether the model has f in the place of fx and fy, and no skew.
bool has_one_focal_length(const LensModelEntry& model);
/// Whether the model has fx and fy, and skew.
bool has_two_focal_lengths(const LensModelEntry& model);
/// Whether the model is a panorama. Projection::fx is then w, the pixels of a full turn; fy is h,
/// the pixels of half a turn, where the model has it.
bool is_panorama(LensModel model);
/// Whether a camera with the model is a pinhole if the numbers of distortion are all 0.
bool has_pinhole_part(LensModel model);

/// How a camera's lens bends rays (specification, section 2): everything except fx, fy, cx, cy and
/// skew. Every number is the real number that it denotes. Valid if find_fault() finds nothing.
struct Lens {
  LensModel model = LensModel::pinhole;
  /// The numbers of entry_of(model).distortion, in this order; the rest is 0.
  std::array<double, 14> distortion{};
  /// Rays end there: |m| of a model of the plane with a stage, else the angle to the z axis in
  /// radians.
  double max_radius = std::numeric_limits<double>::infinity();
  /// Of the model TABLE: the directions of the pixels. Copies of a lens share them.
  std::shared_ptr<const DirectionTable> directions;

  /// Tables of directions are equal if their numbers are.
  friend bool operator==(const Lens& a, const Lens& b);
};

/// The fault of a lens, in one line, or nothing if all numbers are finite (max_radius may be +∞),
/// the numbers that the model does not use are 0, each other number is in the range of its
/// parameter (specification, section 2), max_radius is positive, and there is a table of directions
/// if and only if the model is TABLE.
std::optional<std::string> find_fault(const Lens& lens);

/// The same lens by a model that has fx and fy, if its own has one focal length for both.
Lens with_two_focal_lengths(Lens lens);

/// Whether the lens bends nothing and ends nowhere: a pinhole.
bool is_pinhole(const Lens& lens);

// Lenses from the name of a model and a list of numbers, with the same checks for camera files,
// importers, the program and C.

/// "unknown lens model 'OPENC', expected …; did you mean 'OPENCV'?"
std::string unknown_lens_model(std::string_view name);

/// The fault of a list of `found` numbers, the first `before` of which are not numbers of
/// distortion: "found 3 numbers, OPENCV has 4". Nothing if the model has lists of this length.
std::optional<std::string> distortion_count_fault(const LensModelEntry& model, std::size_t found,
                                                  std::size_t before = 0);

/// The model of this name.
/// Fails    UsageError: unknown_lens_model().
const LensModelEntry& lens_model_of(std::string_view name);

/// The lens of a model with its numbers of distortion in order.
/// Fails    UsageError for another count of numbers, and as find_fault().
Lens lens_of_numbers(const LensModelEntry& model, std::span<const double> distortion,
                     double max_radius = std::numeric_limits<double>::infinity());

/// The same for the name of a model, as in lens_model_of().
Lens lens_of_numbers(std::string_view model, std::span<const double> distortion,
                     double max_radius = std::numeric_limits<double>::infinity());

}  // namespace fathom
