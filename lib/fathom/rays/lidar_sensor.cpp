#include "fathom/rays/lidar_sensor.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/json_value.h"
#include "fathom/text/printable.h"

namespace fathom {
namespace {

/// Far above the 2048 columns and 128 rows of today's sensors.
constexpr std::uint32_t most_columns = 65536, most_rows = 4096;

/// The values of a document, whose keys are in groups or, in old files, at the top.
class Metadata {
 public:
  explicit Metadata(const text::JsonValue& root) : root_(root) {}

  [[nodiscard]] std::optional<text::JsonValue> find(const std::string& group,
                                                    const std::string& key) const {
    const std::optional<text::JsonValue> own = root_.find(group);
    return own && own->is_object() ? own->find(key) : root_.find(key);
  }

  [[nodiscard]] text::JsonValue at(const std::string& group, const std::string& key) const {
    if (const auto value = find(group, key)) return *value;
    root_.fail("'" + key + "' is missing; expected the metadata of an Ouster sensor");
  }

 private:
  text::JsonValue root_;
};

/// A 4×4 matrix as a list of 16 numbers, row by row.
Pose matrix_of(const text::JsonValue& list) {
  const std::vector<double> numbers = list.numbers(16);
  constexpr std::array<double, 4> last{0, 0, 0, 1};
  if (!std::equal(last.begin(), last.end(), numbers.begin() + 12))
    list.fail("expected the last row to be 0 0 0 1");
  Pose pose;
  for (std::size_t i = 0; i < 12; ++i) pose[i / 4][i % 4] = numbers[i];
  return pose;
}

/// Whether the matrix is a rotation and a translation. Its entries may be rounded to four decimals,
/// which changes an entry of R·Rᵀ by at most 2·√3·0.00005 + 3·0.00005².
bool is_rigid(const Pose& pose) {
  const Dyadic most(0.0002);
  const auto row = [&](int i) { return ExactVector3{pose[i][0], pose[i][1], pose[i][2]}; };
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k <= i; ++k) {
      const Dyadic excess = dot(row(i), row(k)) - Dyadic(i == k ? 1.0 : 0.0);
      if (excess < -most || most < excess) return false;
    }
  return determinant_of_rotation(pose).sign() == Sign::positive;
}

Pose rigid_matrix_of(const text::JsonValue& list) {
  const Pose pose = matrix_of(list);
  if (!is_rigid(pose))
    list.fail("expected a rotation and a translation in millimetres, row by row");
  return pose;
}

/// Where beams begin. The transform has only a translation, in the plane of x and z.
void read_beam_origin(const Metadata& metadata, LidarSensor& sensor) {
  const auto transform = metadata.find("beam_intrinsics", "beam_to_lidar_transform");
  if (!transform) {
    sensor.beam_radius = metadata.at("beam_intrinsics", "lidar_origin_to_beam_origin_mm").number();
    return;
  }
  Pose translation = matrix_of(*transform);
  sensor.beam_radius = std::exchange(translation[0][3], 0.0);
  sensor.beam_height = std::exchange(translation[2][3], 0.0);
  if (translation != Pose{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}})
    transform->fail("expected a translation along x and z");
}

void read_shifts(const text::JsonValue& list, LidarSensor& sensor) {
  for (const double shift : list.numbers(sensor.rows)) {
    if (shift != std::trunc(shift) || std::abs(shift) > most_columns)
      list.fail("expected whole numbers of columns");
    sensor.shifts.push_back(static_cast<std::int32_t>(shift));
  }
}

/// The turns in a second of a mode "1024x10".
void read_mode(const text::JsonValue& mode, LidarSensor& sensor) {
  const std::string& text = mode.string();
  const std::size_t cross = text.find('x');
  const std::string columns = std::to_string(sensor.columns);
  std::uint32_t turns = 0;
  const char* const end = text.data() + text.size();
  if (cross == text.npos || text.substr(0, cross) != columns ||
      std::from_chars(text.data() + cross + 1, end, turns).ptr != end || turns == 0)
    mode.fail("expected " + columns + "xN for N turns in a second, found '" +
              text::printable(text) + "'");
  sensor.turns_per_second = turns;
}

}  // namespace

LidarSensor read_ouster_sensor(const std::filesystem::path& file) {
  const StandardArithmetic standard;
  const files::InputFile input(file);
  LidarSensor sensor;
  sensor.name = text::printable(file.string());
  const text::JsonDocument document(input.text(), sensor.name);
  const Metadata metadata(document.root());
  const std::string format =
      document.root().find("data_format") ? "data_format" : "lidar_data_format";
  const auto count = [&](const char* key, std::uint32_t most) {
    return static_cast<std::uint32_t>(metadata.at(format, key).integer(1, most));
  };
  sensor.rows = count("pixels_per_column", most_rows);
  sensor.columns = count("columns_per_frame", most_columns);
  sensor.altitudes = metadata.at("beam_intrinsics", "beam_altitude_angles").numbers(sensor.rows);
  sensor.azimuths = metadata.at("beam_intrinsics", "beam_azimuth_angles").numbers(sensor.rows);
  read_beam_origin(metadata, sensor);
  sensor.lidar_to_sensor =
      rigid_matrix_of(metadata.at("lidar_intrinsics", "lidar_to_sensor_transform"));
  if (const auto shifts = metadata.find(format, "pixel_shift_by_row")) read_shifts(*shifts, sensor);
  if (const auto mode = metadata.find("config_params", "lidar_mode")) read_mode(*mode, sensor);
  return sensor;
}

}  // namespace fathom
