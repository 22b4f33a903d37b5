#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "apps/camera/import_sources.h"
#include "apps/shell/known_files.h"
#include "fathom/camera/data_set_cameras.h"
#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/text/decimal.h"
#include "fathom/text/json_text.h"

namespace fathom::app {
namespace {

/// A calibration has some kilobytes.
constexpr std::size_t largest_yaml = std::size_t{16} << 20;

/// The tag that yaml-cpp gives a scalar without quotes and without a tag.
constexpr std::string_view plain_scalar = "?";

/// Writes the events of a document as JSON.
class JsonWriter : public YAML::EventHandler {
 public:
  explicit JsonWriter(std::string file) : file_(std::move(file)) {}

  [[nodiscard]] std::string take() { return std::move(json_); }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { write_scalar(mark, "null"); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    fail(mark, "aliases are not supported");
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t,
                const std::string& value) override {
    const bool is_key = !open_.empty() && open_.back().wants_key();
    write_scalar(mark, tag == plain_scalar && !is_key ? json_of_plain(mark, value)
                                                      : text::json_string(value));
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    open(mark, '[');
  }
  void OnSequenceEnd() override { close(']'); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    open(mark, '{');
  }
  void OnMapEnd() override { close('}'); }

 private:
  /// A list or an object that is not closed yet.
  struct Open {
    bool is_object = false;
    /// The scalars, lists and objects in it so far; of an object, keys and values.
    std::size_t count = 0;

    [[nodiscard]] bool wants_key() const { return is_object && count % 2 == 0; }
  };

  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& message) const {
    throw InputError(fmt::format("{}: line {}: {}", file_, mark.line + 1, message));
  }

  [[nodiscard]] std::string json_of_plain(const YAML::Mark& mark, const std::string& value) const {
    if (value == "true" || value == "false" || value == "null") return value;
    if (value == "~") return "null";
    const char* const last = value.data() + value.size();
    const auto number = text::parse_decimal<double>(value.data(), last);
    if (number.fault == text::DecimalFault::overflow && number.end == last)
      fail(mark, "the number is beyond the largest binary64 number");
    return number.fault == text::DecimalFault::none && number.end == last
               ? text::shortest_decimal(number.value)
               : text::json_string(value);
  }

  /// The comma or the colon before the next scalar, list or object.
  void separate() {
    if (open_.empty()) return;
    Open& in = open_.back();
    if (in.count != 0) json_ += in.is_object && !in.wants_key() ? ':' : ',';
    ++in.count;
  }

  void write_scalar(const YAML::Mark& mark, const std::string& json) {
    if (!open_.empty() && open_.back().wants_key() && json.front() != '"')
      fail(mark, "expected a key");
    separate();
    json_ += json;
  }

  void open(const YAML::Mark& mark, char bracket) {
    if (!open_.empty() && open_.back().wants_key()) fail(mark, "expected a key");
    separate();
    json_ += bracket;
    open_.push_back({.is_object = bracket == '{'});
  }

  void close(char bracket) {
    json_ += bracket;
    open_.pop_back();
  }

  std::string file_;
  std::string json_;
  std::vector<Open> open_;
};

/// The text without OpenCV's "%YAML:1.0", which is not a directive of YAML: it becomes a comment.
std::string without_header(std::string_view yaml) {
  std::string text(yaml);
  if (text.starts_with("%YAML:")) text.front() = '#';
  return text;
}

/// The first document of a YAML text as JSON, for readers of JSON. JSON is YAML, too, and so is
/// what OpenCV's FileStorage writes, with its first line "%YAML:1.0". Tags are left out.
///
/// Exact    numbers are rounded once to binary64, as readers of JSON round them; "320." is one.
///          "true", "false", "null" and "~" mean what they mean in JSON, and all other scalars are
///          strings.
/// Fails    InputError "FILE: line N: …": syntax, an alias, a key that is a list or an object, a
///          number beyond binary64; and for a text above 16 MiB or without a document.
std::string json_of_yaml(std::string_view yaml, const std::string& file) {
  if (yaml.size() > largest_yaml)
    throw InputError(fmt::format("{}: has {} bytes, expected a calibration of at most 16 MiB", file,
                                 yaml.size()));
  std::istringstream stream(without_header(yaml));
  JsonWriter writer(file);
  try {
    YAML::Parser parser(stream);
    if (!parser.HandleNextDocument(writer)) throw InputError(file + ": is empty");
  } catch (const YAML::Exception& error) {
    throw InputError(fmt::format("{}: line {}: {}", file, error.mark.line + 1, error.msg));
  }
  return writer.take();
}

// fathom camera import opencv | ros | kalibr | aria | kitti360

using Cameras = std::vector<ImportedCamera>;

void declare_calibration(Command& command, ImportArguments& a) {
  add_size_option(command, a);
  add_pixel_centre(command, a, " (default 0)");
  command.option("--poses", "FILE", a.poses,
                 "World-to-camera matrices (x right, y down, z forward) as .txt, .npy or .npz: a "
                 "camera for each, or a rig, whose first camera stands there "
                 "(default: the identity; a calibration has no pose)");
  command.flag("--camera-to-world", a.camera_to_world,
               "The matrices of --poses are camera to world");
}

CalibrationPoses poses_of(const ImportArguments& a) {
  CalibrationPoses given;
  if (a.poses.empty()) {
    if (a.camera_to_world) throw UsageError("--camera-to-world goes with --poses");
    return given;
  }
  given.poses = read_poses_argument(a.poses);
  if (a.camera_to_world) given.direction = PoseDirection::camera_to_world;
  return given;
}

/// Why XML is none of the formats: OpenCV's FileStorage has it, too.
void refuse_xml(std::string_view text, const std::string& file) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != std::string_view::npos && text[first] == '<')
    throw InputError(file + ": is XML, expected YAML or JSON; write it with FileStorage as .yml");
}

std::string read_yaml(const std::string& name) {
  note_input(name);
  const files::InputFile file(name);
  refuse_xml(file.text(), name);
  return json_of_yaml(file.text(), name);
}

template <class Parse>
Cameras read_calibration(const ImportArguments& a, const Parse& parse) {
  return parse(read_yaml(a.input), a.input, given_lens(a), poses_of(a));
}

Cameras read_opencv(const ImportArguments& a, Warnings&) {
  return read_calibration(a, cameras_of_opencv);
}

Cameras read_ros(const ImportArguments& a, Warnings&) {
  return read_calibration(a, cameras_of_ros);
}

void declare_kitti360(Command& command, ImportArguments& a) {
  add_size_option(command, a);
  add_pixel_centre(command, a, " (default 0)");
  command.option("--poses", "FILE", a.poses,
                 "Poses of the vehicle, one line per frame: poses.txt; needs --rig");
  command.option("--rig", "FILE", a.rig,
                 "Poses of the cameras on the vehicle: calib_cam_to_pose.txt");
}

Cameras read_kitti360(const ImportArguments& a, Warnings&) {
  if (a.poses.empty() != a.rig.empty()) throw UsageError("--poses and --rig go together");
  std::optional<Kitti360Poses> poses;
  if (!a.poses.empty()) poses = Kitti360Poses{a.poses, a.rig};
  return cameras_of_kitti360(read_yaml(a.input), a.input, given_lens(a), poses);
}

Cameras read_aria(const ImportArguments& a, Warnings&) {
  return read_calibration(a, cameras_of_aria);
}

Cameras read_kalibr(const ImportArguments& a, Warnings&) {
  return read_calibration(a, cameras_of_kalibr);
}

}  // namespace

std::vector<ImportSource> calibration_sources() {
  return {
      {"opencv", "Import a calibration of OpenCV: FileStorage as YAML or JSON",
       "The file of cv::FileStorage with camera_matrix and distortion_coefficients",
       "  fathom camera import opencv calibration.yml -o camera.json\n"
       "  fathom camera import opencv calibration.yml --poses poses.txt -o cameras.json",
       declare_calibration, read_opencv},
      {"ros", "Import a calibration of ROS: camera_info as YAML",
       "The file of camera_calibration, or a message",
       "  fathom camera import ros ost.yaml -o camera.json", declare_calibration, read_ros},
      {"kalibr", "Import the cameras of a calibration of Kalibr: camchain.yaml", "The camera chain",
       "  fathom camera import kalibr camchain.yaml -o cameras.json\n"
       "  fathom camera import kalibr camchain.yaml --image cam1 -o camera.json\n"
       "\nThe frame of cam0 is the world, or stands at each of --poses.",
       declare_calibration, read_kalibr},
      {"aria", "Import the cameras of a calibration of Project Aria: JSON",
       "The calibration of a device, or a line of online_calibration.jsonl",
       "  fathom camera import aria calibration.json -o cameras.json\n"
       "  fathom camera import aria calibration.json --image camera-rgb -o camera.json\n"
       "\nThe frame of the device is the world, or stands at each of --poses.",
       declare_calibration, read_aria, false},
      {"kitti360", "Import cameras of KITTI-360's fisheyes: image_02.yaml, image_03.yaml",
       "The calibration of a fisheye",
       "  fathom camera import kitti360 image_02.yaml -o camera.json\n"
       "  fathom camera import kitti360 image_02.yaml --poses poses.txt \\\n"
       "    --rig calib_cam_to_pose.txt -o cameras.json\n"
       "\nThe rectified cameras of perspective.txt are for `import kitti`.",
       declare_kitti360, read_kitti360}};
}

}  // namespace fathom::app
