#pragma once

#include <charconv>
#include <cstddef>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "fathom/camera/camera_import_internal.h"
#include "fathom/camera/pose.h"

/// From the lines of numbers in a file to poses and cameras: shared by the importers. Only for .cpp
/// files of this module.
/// Fails    all of them: InputError, "FILE: line N: …" or beginning with `where`.
namespace fathom::camera {

/// A line of a text file and where it is.
struct Line {
  std::istringstream words;
  std::string where;
};

/// The next line that is neither empty nor a comment (#). `number` counts all lines.
bool next_line(NamedStream& file, std::size_t& number, Line& line);

/// All such lines of a text. `name` is the file's.
std::vector<Line> lines_of(std::string_view text, const std::string& name);

/// The next word; `what` it is, for messages.
std::string read_word(Line& line, const char* what);

[[noreturn]] void refuse(const Line& line, const char* what, const std::string& word);

template <class Integer>
Integer read_integer(Line& line, const char* what) {
  const std::string word = read_word(line, what);
  Integer value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) refuse(line, what, word);
  return value;
}

/// A finite number, its decimal text rounded once.
double read_number(Line& line, const char* what);

/// The same of a single word; NaN if the word means a number that is not finite ("nan", "-inf").
/// `where` begins the message.
double number_of(const std::string& word, const std::string& where);

/// The numbers that are left on a line, as number_of().
std::vector<double> rest_of(Line& line);

/// A word that is a time in seconds; `text` is the word.
double read_time(Line& line, std::string& text);

/// A line of a trajectory of TUM: time tx ty tz qx qy qz qw.
struct TumPose {
  double time = 0;
  std::string time_text;
  std::array<double, 3> position{};
  /// w, x, y, z
  std::array<double, 4> quaternion{};
  /// Why the numbers are not a pose: "FILE: line N: …"; empty if they are.
  std::string fault;
};
TumPose read_tum_pose(Line& line);

/// Fails    InputError, beginning with `where`.

/// fx s cx, 0 fy cy, 0 0 1.
void set_intrinsics(Projection& projection, const IntrinsicMatrix& K, const std::string& where);

/// fx fy cx cy.
void set_intrinsics(Projection& projection, std::span<const double, 4> numbers);

/// The intrinsic matrix of four numbers.
IntrinsicMatrix intrinsic_matrix(double fx, double fy, double cx, double cy);

/// A camera at the world's origin from the caller's values and, for the rest, the data set's
/// values. An unknown size is 0.
Camera lens_of(const GivenLens& given, const GivenLens& data_set, const std::string& where);

/// A pose and the inverse of a pose, exactly. Fail where an entry is not finite, and
/// exact_inverse() where the matrix is singular.
ExactPose exact_pose(const Pose& pose, const std::string& where);
ExactPose exact_inverse(const Pose& pose, const std::string& where);

/// World to camera, in our axes, of a pose [A | b]: exact, or each entry of the inverse rounded
/// once. Fails where an entry is not finite, and where a pose that has to be inverted is singular.
Pose camera_from_world(const Pose& pose, PoseDirection direction, CameraAxes axes,
                       const std::string& where);

/// A lens with a pose; a fault of either is the camera's fault.
ImportedCamera placed(const ImportedCamera& lens, const NamedPose& pose, PoseDirection direction,
                      CameraAxes axes, const std::string& where);

/// Refuses two images of one name.
void require_different_names(const std::vector<ImportedCamera>& cameras, const std::string& input);

/// A matrix of 3 or 4 rows by 4, in order; the last of four has to be 0 0 0 1. Entries that are not
/// finite are let through.
Pose pose_of_numbers(const std::vector<double>& numbers, const std::string& where);

/// The same of a list of 3 or 4 rows of 4 numbers.
Pose parse_matrix(const text::JsonValue& matrix);

/// A text with one matrix of 3 or 4 lines of 4 numbers. `name` is the file's.
Pose parse_pose(std::string_view text, const std::string& name);

/// The files of a folder whose names end with `suffix`, by name. Fails if there is no such file.
std::vector<std::filesystem::path> files_of(const std::filesystem::path& folder,
                                            const std::string& suffix);

}  // namespace fathom::camera
