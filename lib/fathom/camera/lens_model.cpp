#include "fathom/camera/lens_model.h"

#include <algorithm>
#include <array>

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

// OpenCV's functions take as many.
constexpr std::array<std::size_t, 4> shorter_than_14{4, 5, 8, 12};

constexpr std::span<const Name> first(std::size_t count) {
  return std::span(of_opencv).first(count);
}

constexpr std::array<Name, 8> of_thin_prism{"k1", "k2", "p1", "p2", "k3", "k4", "sx1", "sy1"};

constexpr auto plane = RayFormula::plane, angle = RayFormula::angle, direct = RayFormula::direct;

constexpr std::array<LensModelEntry, 18> table{{
    {LensModel::simple_pinhole, "SIMPLE_PINHOLE", plane, one_focal_length, {}, {}},
    {LensModel::pinhole, "PINHOLE", plane, two_focal_lengths, {}, {}},
    {LensModel::simple_radial, "SIMPLE_RADIAL", plane, one_focal_length, of_one_term, {}},
    {LensModel::radial, "RADIAL", plane, one_focal_length, first(2), {}},
    {LensModel::opencv, "OPENCV", plane, two_focal_lengths, first(4), {}},
    {LensModel::full_opencv, "FULL_OPENCV", plane, two_focal_lengths, first(8), {}},
    {LensModel::opencv_14, "OPENCV_14", plane, two_focal_lengths, of_opencv, shorter_than_14},
    {LensModel::brown, "BROWN", plane, two_focal_lengths, of_brown, {}},
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
  return entry_of(model).formula == RayFormula::plane;
}

bool has_stage(LensModel model) {
  return entry_of(model).formula != RayFormula::direct;
}

bool has_one_focal_length(const LensModelEntry& model) {
  return !model.intrinsics.empty() && model.intrinsics.front() == "f";
}

std::string_view name_of(LensModel model) {
  return entry_of(model).name;
}

std::optional<LensModel> lens_model_named(std::string_view name) {
  const auto* const found = std::ranges::find(table, name, &LensModelEntry::name);
  return found == table.end() ? std::nullopt : std::optional(found->model);
}

}  // namespace fathom
