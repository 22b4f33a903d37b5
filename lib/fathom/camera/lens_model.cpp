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

constexpr std::array<LensModelEntry, 12> table{{
    {LensModel::simple_pinhole, "SIMPLE_PINHOLE", true, one_focal_length, {}, {}},
    {LensModel::pinhole, "PINHOLE", true, two_focal_lengths, {}, {}},
    {LensModel::simple_radial, "SIMPLE_RADIAL", true, one_focal_length, of_one_term, {}},
    {LensModel::radial, "RADIAL", true, one_focal_length, first(2), {}},
    {LensModel::opencv, "OPENCV", true, two_focal_lengths, first(4), {}},
    {LensModel::full_opencv, "FULL_OPENCV", true, two_focal_lengths, first(8), {}},
    {LensModel::opencv_14, "OPENCV_14", true, two_focal_lengths, of_opencv, shorter_than_14},
    {LensModel::brown, "BROWN", true, two_focal_lengths, of_brown, {}},
    {LensModel::simple_division, "SIMPLE_DIVISION", false, one_focal_length, of_one_term, {}},
    {LensModel::division, "DIVISION", false, two_focal_lengths, of_one_term, {}},
    {LensModel::fisheye_stereographic, "FISHEYE_STEREOGRAPHIC", false, two_focal_lengths, {}, {}},
    {LensModel::table, "TABLE", false, {}, {}, {}},
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
