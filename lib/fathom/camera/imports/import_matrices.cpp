#include <algorithm>
#include <system_error>

#include "fathom/camera/imports/lines_and_poses.h"
#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {
using namespace camera;

namespace fs = std::filesystem;

namespace {

/// Commas are as good as blanks: arrays are written either way.
std::string without_commas(std::string_view text) {
  std::string result(text);
  std::ranges::replace(result, ',', ' ');
  return result;
}

}  // namespace

std::vector<NamedPose> camera::parse_poses(std::string_view text, const std::string& name,
                                           const std::string& stem) {
  const std::string blanks = without_commas(text);
  std::vector<Line> lines = lines_of(blanks, name);
  if (lines.empty()) throw InputError(name + ": holds no matrix");
  std::vector<double> numbers = rest_of(lines[0]);
  if (numbers.size() == 4) return {{stem, parse_pose(blanks, name)}};
  std::vector<NamedPose> poses;
  for (Line& line : lines) {
    if (!poses.empty()) numbers = rest_of(line);
    poses.push_back({std::to_string(poses.size()), pose_of_numbers(numbers, line.where)});
  }
  return poses;
}

std::vector<IntrinsicMatrix> camera::parse_intrinsic_matrices(std::string_view text,
                                                              const std::string& name) {
  std::vector<double> numbers;
  std::vector<Line> lines = lines_of(without_commas(text), name);
  std::size_t row = 0;
  for (Line& line : lines) {
    const std::vector<double> found = rest_of(line);
    if (numbers.empty()) row = found.size();
    if (found.size() != row || (row != 3 && row != 9))
      throw InputError(line.where + ": expected a row of 3 numbers, or a matrix of 9, found " +
                       std::to_string(found.size()));
    numbers.insert(numbers.end(), found.begin(), found.end());
  }
  if (numbers.empty() || (row == 3 && numbers.size() != 9))
    throw InputError(name + ": expected 3 rows of 3 numbers, or lines of 9");
  std::vector<IntrinsicMatrix> matrices(numbers.size() / 9);
  for (std::size_t i = 0; i < numbers.size(); ++i) matrices[i / 9][i % 9] = numbers[i];
  return matrices;
}

std::vector<ImportedCamera> import_matrices(const std::vector<NamedPose>& poses,
                                            const std::vector<IntrinsicMatrix>& K,
                                            const MatrixConvention& convention, std::uint32_t width,
                                            std::uint32_t height, const std::string& input) {
  const StandardArithmetic standard;
  if (K.size() != 1 && K.size() != poses.size())
    throw InputError(input + ": there are " + std::to_string(K.size()) + " matrices K and " +
                     std::to_string(poses.size()) + " poses; expected one K, or one for each pose");
  std::vector<ImportedCamera> cameras;
  cameras.reserve(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::string where = input + ": pose " + poses[i].name;
    const ImportedCamera lens = imported_camera("", where, [&](ImportedCamera& one) {
      one.camera.width = width;
      one.camera.height = height;
      one.camera.projection.pixel_centre = convention.pixel_centre;
      set_intrinsics(one.camera.projection, K[K.size() == 1 ? 0 : i], where + ": K");
    });
    cameras.push_back(placed(lens, poses[i], convention.direction, convention.axes, where));
  }
  if (cameras.empty()) throw InputError(input + ": holds no pose");
  require_different_names(cameras, input);
  return cameras;
}

std::vector<NamedPose> read_poses(const fs::path& file_or_folder) {
  const StandardArithmetic standard;
  const auto read = [](const fs::path& file) {
    return parse_poses(files::InputFile(file).text(), file.string(), file.stem().string());
  };
  std::error_code ignored;
  if (!fs::is_directory(file_or_folder, ignored)) return read(file_or_folder);
  std::vector<NamedPose> poses;
  for (const fs::path& file : files_of(file_or_folder, ".txt")) {
    const std::vector<NamedPose> own = read(file);
    if (own.size() != 1) throw InputError(file.string() + ": expected one matrix in each file");
    poses.push_back({file.stem().string(), own[0].pose});
  }
  return poses;
}

std::vector<IntrinsicMatrix> read_intrinsic_matrices(const fs::path& file) {
  const StandardArithmetic standard;
  return parse_intrinsic_matrices(files::InputFile(file).text(), file.string());
}

}  // namespace fathom
