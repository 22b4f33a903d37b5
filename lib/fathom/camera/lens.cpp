#include "fathom/camera/lens.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "fathom/failures/errors.h"
#include "fathom/failures/unknown_name.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/counted.h"

namespace fathom {
namespace {

using Name = std::string_view;

constexpr std::array<Name, 3> one_focal_length{"f", "cx", "cy"};
constexpr std::array<Name, 4> two_focal_lengths{"fx", "fy", "cx", "cy"};

// FULL_OPENCV has the first eight.
constexpr std::array<Name, 14> of_opencv{"k1", "k2", "p1", "p2", "k3", "k4",   "k5",
                                         "k6", "s1", "s2", "s3", "s4", "tauX", "tauY"};
constexpr std::array<Name, 1> of_one_term{"k"};
constexpr std::array<Name, 6> of_brown{"k1", "k2", "k3", "k4", "p1", "p2"};
constexpr std::array<Name, 1> of_fov{"omega"};

// OpenCV's functions take as many.
constexpr std::array<std::size_t, 4> shorter_than_14{4, 5, 8, 12};

constexpr std::span<const Name> first(std::size_t count) {
  return std::span(of_opencv).first(count);
}

constexpr std::array<Name, 4> of_equirectangular{"w", "h", "cx", "cy"};
constexpr std::array<Name, 4> of_cylinder{"w", "fy", "cx", "cy"};

constexpr std::array<Name, 8> of_thin_prism{"k1", "k2", "p1", "p2", "k3", "k4", "sx1", "sy1"};
constexpr std::array<Name, 12> of_rad_tan{"k0", "k1", "k2", "k3", "k4", "k5",
                                          "p0", "p1", "s0", "s1", "s2", "s3"};
// UCM has the first.
constexpr std::array<Name, 2> of_eucm{"alpha", "beta"};
constexpr std::array<Name, 2> of_double_sphere{"xi", "alpha"};
constexpr std::array<Name, 5> of_omni{"xi", "k1", "k2", "p1", "p2"};
constexpr std::array<std::size_t, 1> without_distortion{1};
constexpr std::array<Name, 6> of_ftheta{"p0", "p1", "p2", "p3", "p4", "p5"};

constexpr auto plane = RayFormula::plane, angle = RayFormula::angle, with_root = RayFormula::root,
               turn = RayFormula::turn, direct = RayFormula::direct,
               field_of_view = RayFormula::field_of_view,
               angle_of_sample = RayFormula::angle_of_sample;

constexpr std::array<LensModelEntry, 29> table{{
    {LensModel::simple_pinhole, "SIMPLE_PINHOLE", plane, one_focal_length, {}, {}},
    {LensModel::pinhole, "PINHOLE", plane, two_focal_lengths, {}, {}},
    {LensModel::simple_radial, "SIMPLE_RADIAL", plane, one_focal_length, of_one_term, {}},
    {LensModel::radial, "RADIAL", plane, one_focal_length, first(2), {}},
    {LensModel::opencv, "OPENCV", plane, two_focal_lengths, first(4), {}},
    {LensModel::full_opencv, "FULL_OPENCV", plane, two_focal_lengths, first(8), {}},
    {LensModel::opencv_14, "OPENCV_14", plane, two_focal_lengths, of_opencv, shorter_than_14},
    {LensModel::brown, "BROWN", plane, two_focal_lengths, of_brown, {}},
    {LensModel::fov, "FOV", field_of_view, two_focal_lengths, of_fov, {}},
    {LensModel::simple_division, "SIMPLE_DIVISION", direct, one_focal_length, of_one_term, {}},
    {LensModel::division, "DIVISION", direct, two_focal_lengths, of_one_term, {}},
    {LensModel::fisheye_stereographic, "FISHEYE_STEREOGRAPHIC", direct, two_focal_lengths, {}, {}},
    {LensModel::simple_fisheye, "SIMPLE_FISHEYE", angle, one_focal_length, {}, {}},
    {LensModel::fisheye, "FISHEYE", angle, two_focal_lengths, {}, {}},
    {LensModel::simple_radial_fisheye,
     "SIMPLE_RADIAL_FISHEYE",
     angle,
     one_focal_length,
     of_one_term,
     {}},
    {LensModel::radial_fisheye, "RADIAL_FISHEYE", angle, one_focal_length, first(2), {}},
    {LensModel::opencv_fisheye,
     "OPENCV_FISHEYE",
     angle,
     two_focal_lengths,
     std::span(of_brown).first(4),
     {}},
    {LensModel::thin_prism_fisheye,
     "THIN_PRISM_FISHEYE",
     angle,
     two_focal_lengths,
     of_thin_prism,
     {}},
    {LensModel::rad_tan_thin_prism_fisheye,
     "RAD_TAN_THIN_PRISM_FISHEYE",
     angle,
     two_focal_lengths,
     of_rad_tan,
     {}},
    {LensModel::fisheye_orthographic, "FISHEYE_ORTHOGRAPHIC", with_root, two_focal_lengths, {}, {}},
    {LensModel::fisheye_equisolid, "FISHEYE_EQUISOLID", with_root, two_focal_lengths, {}, {}},
    {LensModel::ucm, "UCM", with_root, two_focal_lengths, std::span(of_eucm).first(1), {}},
    {LensModel::eucm, "EUCM", with_root, two_focal_lengths, of_eucm, {}},
    {LensModel::double_sphere, "DOUBLE_SPHERE", with_root, two_focal_lengths, of_double_sphere, {}},
    {LensModel::omni, "OMNI", with_root, two_focal_lengths, of_omni, without_distortion},
    {LensModel::ftheta, "FTHETA", angle_of_sample, two_focal_lengths, of_ftheta, {}},
    {LensModel::equirectangular, "EQUIRECTANGULAR", turn, of_equirectangular, {}, {}},
    {LensModel::cylindrical, "CYLINDRICAL", turn, of_cylinder, {}, {}},
    {LensModel::table, "TABLE", direct, {}, {}, {}},
}};

constexpr bool is_in_order() {
  for (std::size_t i = 0; i < table.size(); ++i)
    if (table[i].model != static_cast<LensModel>(i)) return false;
  return true;
}
static_assert(is_in_order(), "entry_of() takes the number of a model for its place");

}  // namespace

std::span<const LensModelEntry> lens_models() {
  return table;
}

const LensModelEntry& entry_of(LensModel model) {
  return table[static_cast<std::size_t>(model)];
}

bool is_plane(LensModel model) {
  const RayFormula formula = entry_of(model).formula;
  return formula == RayFormula::plane || formula == RayFormula::field_of_view;
}

bool has_stage(LensModel model) {
  const RayFormula formula = entry_of(model).formula;
  return formula == RayFormula::plane || formula == RayFormula::angle;
}

bool has_stage_before_root(const Lens& lens) {
  const auto is_not_zero = [](double value) { return value != 0; };
  return lens.model == LensModel::omni &&
         std::any_of(lens.distortion.begin() + 1, lens.distortion.end(), is_not_zero);
}

bool has_one_focal_length(const LensModelEntry& model) {
  return !model.intrinsics.empty() && model.intrinsics.front() == "f";
}

bool has_two_focal_lengths(const LensModelEntry& model) {
  return !model.intrinsics.empty() && model.intrinsics.front() == "fx";
}

bool is_panorama(LensModel model) {
  return entry_of(model).formula == RayFormula::turn;
}

bool has_pinhole_part(LensModel model) {
  const RayFormula formula = entry_of(model).formula;
  return formula != RayFormula::angle && formula != RayFormula::angle_of_sample &&
         formula != RayFormula::turn;
}

std::string_view name_of(LensModel model) {
  return entry_of(model).name;
}

std::optional<LensModel> lens_model_named(std::string_view name) {
  const auto* const found = std::ranges::find(table, name, &LensModelEntry::name);
  return found == table.end() ? std::nullopt : std::optional(found->model);
}

namespace {

/// The fault of the number of a parameter; nullopt if it is in range. The binary64 numbers nearest
/// to π/2 and π are less than these, so they are the greatest angles.
std::optional<std::string> range_fault(LensModel model, std::string_view parameter, double value) {
  const std::string name(parameter);
  if (!std::isfinite(value)) return name + " is not a finite number";
  const bool is_tilt = parameter == "tauX" || parameter == "tauY";
  if (is_tilt && std::abs(value) > std::numbers::pi / 2)
    return name + " is not between -pi/2 and pi/2";
  const bool is_angle = parameter == "omega" || (model == LensModel::ftheta && parameter == "p0");
  if (is_angle && std::abs(value) > std::numbers::pi) return name + " is not between -pi and pi";
  if (parameter == "alpha" && !(value >= 0 && value <= 1)) return name + " is not between 0 and 1";
  if (parameter == "beta" && !(value > 0)) return name + " is not greater than 0";
  if (parameter != "xi") return std::nullopt;
  if (model == LensModel::double_sphere && !(std::abs(value) < 1))
    return "xi is not between -1 and 1";
  if (model == LensModel::omni && !(value >= 0)) return "xi is less than 0";
  return std::nullopt;
}

/// Whether the first coefficient of FTHETA after p0 that is not 0 is positive.
bool grows(const Lens& lens) {
  const auto is_not_zero = [](double p) { return p != 0; };
  const auto* const first =
      std::find_if(lens.distortion.begin() + 1, lens.distortion.end(), is_not_zero);
  return first != lens.distortion.end() && *first > 0;
}

bool are_same(const std::shared_ptr<const DirectionTable>& a,
              const std::shared_ptr<const DirectionTable>& b) {
  return a == b || (a && b && *a == *b);
}

}  // namespace

bool operator==(const Lens& a, const Lens& b) {
  const StandardArithmetic standard;
  return a.model == b.model && a.distortion == b.distortion && a.max_radius == b.max_radius &&
         are_same(a.directions, b.directions);
}

std::optional<std::string> find_fault(const Lens& lens) {
  const StandardArithmetic standard;
  const auto names = entry_of(lens.model).distortion;
  for (std::size_t i = 0; i < lens.distortion.size(); ++i) {
    const double value = lens.distortion[i];
    if (i >= names.size()) {
      if (value != 0) return "more numbers of distortion than the lens model has parameters";
      continue;
    }
    if (auto fault = range_fault(lens.model, names[i], value)) return fault;
  }
  if (lens.model == LensModel::ftheta && !grows(lens))
    return "the angle does not grow with the distance from the axis";
  if (!(lens.max_radius > 0)) return "max_radius is not greater than 0";
  if (lens.model == LensModel::table && !lens.directions) return "TABLE has no table of directions";
  if (lens.model != LensModel::table && lens.directions)
    return std::string(name_of(lens.model)) + " has a table of directions, which only TABLE has";
  return std::nullopt;
}

// The other model has the numbers of the first, followed by its own, which are 0.
Lens with_two_focal_lengths(Lens lens) {
  switch (lens.model) {
    case LensModel::simple_pinhole:
      lens.model = LensModel::pinhole;
      break;
    case LensModel::simple_radial:
    case LensModel::radial:
      lens.model = LensModel::opencv;
      break;
    case LensModel::simple_division:
      lens.model = LensModel::division;
      break;
    case LensModel::simple_fisheye:
      lens.model = LensModel::fisheye;
      break;
    case LensModel::simple_radial_fisheye:
    case LensModel::radial_fisheye:
      lens.model = LensModel::opencv_fisheye;
      break;
    default:
      break;
  }
  return lens;
}

bool is_pinhole(const Lens& lens) {
  const StandardArithmetic standard;
  return is_plane(lens.model) && std::isinf(lens.max_radius) &&
         std::all_of(lens.distortion.begin(), lens.distortion.end(),
                     [](double value) { return value == 0; });
}

std::string unknown_lens_model(std::string_view name) {
  std::vector<std::string> names;
  for (const LensModelEntry& entry : lens_models()) names.emplace_back(entry.name);
  return "unknown lens model '" + std::string(name) + "', expected " + joined(names, " or ") +
         suggestion(name, names);
}

std::optional<std::string> distortion_count_fault(const LensModelEntry& model, std::size_t found,
                                                  std::size_t before) {
  std::vector<std::size_t> counts(model.shorter_lists.begin(), model.shorter_lists.end());
  counts.push_back(model.distortion.size());
  std::vector<std::string> expected;
  for (const std::size_t count : counts) {
    if (found == before + count) return std::nullopt;
    expected.push_back(std::to_string(before + count));
  }
  return "found " + text::counted(found, "number") + ", " + std::string(model.name) + " has " +
         joined(expected, " or ");
}

const LensModelEntry& lens_model_of(std::string_view name) {
  const auto found = lens_model_named(name);
  if (!found) throw UsageError(unknown_lens_model(name));
  return entry_of(*found);
}

Lens lens_of_numbers(const LensModelEntry& model, std::span<const double> distortion,
                     double max_radius) {
  const StandardArithmetic standard;
  if (const auto fault = distortion_count_fault(model, distortion.size())) {
    const std::vector<std::string> names(model.distortion.begin(), model.distortion.end());
    throw UsageError(*fault + ": " + joined(names, ", "));
  }
  Lens lens{model.model};
  std::ranges::copy(distortion, lens.distortion.begin());
  lens.max_radius = max_radius;
  if (const auto fault = find_fault(lens)) throw UsageError(*fault);
  return lens;
}

Lens lens_of_numbers(std::string_view model, std::span<const double> distortion,
                     double max_radius) {
  const StandardArithmetic standard;
  return lens_of_numbers(lens_model_of(model), distortion, max_radius);
}

}  // namespace fathom
