#include "apps/camera/number_arrays.h"

#include <filesystem>
#include <optional>
#include <type_traits>
#include <variant>

#include "fathom/failures/errors.h"
#include "fathom/image/map_files.h"

namespace fathom::app {
namespace {

/// An array of two dimensions is an image of one part, one of three an image of as many parts as
/// columns: what holds for the NPY of maps holds for it.
struct NumberArray {
  std::size_t count = 1, rows = 0, columns = 0;
  /// Row by row, one matrix after the other.
  std::vector<double> numbers;
};

double number_at(const ImageChannel& channel, std::size_t i) {
  return std::visit([&](const auto& values) { return static_cast<double>(values[i]); },
                    channel.values);
}

constexpr std::string_view archive_suffix = ".npz";

/// An array in an archive.
struct ArchivedArray {
  std::string file, name;
};

/// Nothing where the text names no archive.
std::optional<ArchivedArray> archived_array(const std::string& text) {
  if (text.ends_with(archive_suffix)) return ArchivedArray{text, ""};
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || !text.substr(0, colon).ends_with(archive_suffix))
    return std::nullopt;
  return ArchivedArray{text.substr(0, colon), text.substr(colon + 1)};
}

NumberArray read_array(const std::string& file) {
  const auto archived = archived_array(file);
  const DepthMap map = archived ? read_npz_array(archived->file, archived->name) : read_map(file);
  NumberArray array;
  if (map.channels.size() == 1) {
    array.rows = map.height;
    array.columns = map.width;
  } else {
    array.count = map.height;
    array.rows = map.width;
    array.columns = map.channels.size();
  }
  for (std::size_t i = 0; i < std::size_t{map.width} * map.height; ++i)
    for (const ImageChannel& channel : map.channels) array.numbers.push_back(number_at(channel, i));
  return array;
}

}  // namespace

bool names_array(const std::string& file) {
  return std::filesystem::path(file).extension() == ".npy" || archived_array(file);
}

std::vector<NamedPose> poses_of_array(const std::string& file) {
  const NumberArray array = read_array(file);
  if (array.columns != 4 || (array.rows != 3 && array.rows != 4))
    throw InputError(file + ": expected an array of the shape (N, 4, 4) or (N, 3, 4)");
  std::vector<NamedPose> poses(array.count);
  for (std::size_t n = 0; n < array.count; ++n) {
    const double* const matrix = &array.numbers[n * array.rows * 4];
    poses[n].name = std::to_string(n);
    for (std::size_t i = 0; i < 12; ++i) poses[n].pose[i / 4][i % 4] = matrix[i];
    for (std::size_t i = 12; i < array.rows * 4; ++i)
      if (matrix[i] != (i == 15 ? 1 : 0))
        throw InputError(file + ": matrix " + poses[n].name +
                         ": expected the last row to be 0 0 0 1");
  }
  return poses;
}

std::vector<IntrinsicMatrix> intrinsics_of_array(const std::string& file) {
  const NumberArray array = read_array(file);
  if (array.columns != 3 || array.rows != 3)
    throw InputError(file + ": expected an array of the shape (3, 3) or (N, 3, 3)");
  std::vector<IntrinsicMatrix> matrices(array.count);
  for (std::size_t i = 0; i < array.numbers.size(); ++i) matrices[i / 9][i % 9] = array.numbers[i];
  return matrices;
}

}  // namespace fathom::app
