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

constexpr std::array<std::size_t, 9> counts{0, 1, 2, 4, 5, 6, 8, 12, 14};
constexpr std::span<const std::size_t> no_number(counts.data(), 1), one(counts.data() + 1, 1),
    two(counts.data() + 2, 1), four(counts.data() + 3, 1), six(counts.data() + 5, 1),
    eight(counts.data() + 6, 1);
// OpenCV's functions take as many.
constexpr std::array<std::size_t, 5> of_opencv_14{4, 5, 8, 12, 14};

constexpr std::span<const Name> first(std::size_t count) {
  return std::span(of_opencv).first(count);
}

constexpr auto rational = DirectionClass::rational, polynomial = DirectionClass::polynomial;
constexpr std::nullopt_t none = std::nullopt;

constexpr std::array<LensModelEntry, 11> table{{
    {LensModel::simple_pinhole,
     "SIMPLE_PINHOLE",
     0,
     rational,
     true,
     one_focal_length,
     {},
     no_number},
    {LensModel::pinhole, "PINHOLE", 1, rational, true, two_focal_lengths, {}, no_number},
    {LensModel::simple_radial, "SIMPLE_RADIAL", 2, polynomial, true, one_focal_length, of_one_term,
     one},
    {LensModel::radial, "RADIAL", 3, polynomial, true, one_focal_length, first(2), two},
    {LensModel::opencv, "OPENCV", 4, polynomial, true, two_focal_lengths, first(4), four},
    {LensModel::full_opencv, "FULL_OPENCV", 6, polynomial, true, two_focal_lengths, first(8),
     eight},
    {LensModel::opencv_14, "OPENCV_14", none, polynomial, true, two_focal_lengths, of_opencv,
     of_opencv_14},
    {LensModel::brown, "BROWN", none, polynomial, true, two_focal_lengths, of_brown, six},
    {LensModel::simple_division, "SIMPLE_DIVISION", 12, rational, false, one_focal_length,
     of_one_term, one},
    {LensModel::division, "DIVISION", 13, rational, false, two_focal_lengths, of_one_term, one},
    {LensModel::fisheye_stereographic,
     "FISHEYE_STEREOGRAPHIC",
     none,
     rational,
     false,
     two_focal_lengths,
     {},
     no_number},
}};

constexpr bool is_in_order() {
  for (std::size_t i = 0; i < table.size(); ++i)
    if (table[i].model != static_cast<LensModel>(i)) return false;
  return true;
}
static_assert(is_in_order(), "entry_of() takes the number of a model for its place");

template <class Matches>
std::optional<LensModel> find(const Matches& matches) {
  const auto* const found = std::find_if(table.begin(), table.end(), matches);
  return found == table.end() ? std::nullopt : std::optional(found->model);
}

}  // namespace

std::span<const LensModelEntry> lens_models() {
  return table;
}

const LensModelEntry& entry_of(LensModel model) {
  return table[static_cast<std::size_t>(model)];
}

std::string_view name_of(LensModel model) {
  return entry_of(model).name;
}

std::optional<LensModel> lens_model_named(std::string_view name) {
  return find([name](const LensModelEntry& entry) { return entry.name == name; });
}

std::optional<LensModel> lens_model_of_colmap(int id) {
  return find([id](const LensModelEntry& entry) { return entry.colmap_id == id; });
}

}  // namespace fathom
