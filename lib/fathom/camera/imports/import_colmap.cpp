#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>

#include "fathom/camera/camera_import_internal.h"
#include "fathom/camera/imports/lines_and_poses.h"
#include "fathom/camera/pose.h"
#include "fathom/failures/errors.h"
#include "fathom/failures/unknown_name.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {
using namespace camera;

namespace {

static_assert(std::endian::native == std::endian::little, "COLMAP's files are little endian");

/// A camera model of COLMAP: `focals` focal lengths, the principal point, then distortion; or the
/// size of a panorama alone.
struct Model {
  std::string_view name;
  std::size_t parameters;
  std::size_t focals;
  LensModel lens;

  /// A fisheye or a panorama.
  [[nodiscard]] bool always_bends() const { return !has_pinhole_part(lens); }
};

/// In the order of COLMAP 4's model ids. COLMAP 3.8 had the first eleven models.
constexpr std::array<std::string_view, 18> model_names{"SIMPLE_PINHOLE",
                                                       "PINHOLE",
                                                       "SIMPLE_RADIAL",
                                                       "RADIAL",
                                                       "OPENCV",
                                                       "OPENCV_FISHEYE",
                                                       "FULL_OPENCV",
                                                       "FOV",
                                                       "SIMPLE_RADIAL_FISHEYE",
                                                       "RADIAL_FISHEYE",
                                                       "THIN_PRISM_FISHEYE",
                                                       "RAD_TAN_THIN_PRISM_FISHEYE",
                                                       "SIMPLE_DIVISION",
                                                       "DIVISION",
                                                       "SIMPLE_FISHEYE",
                                                       "FISHEYE",
                                                       "EUCM",
                                                       "EQUIRECTANGULAR"};

/// `name` is one of model_names.
Model colmap_model(std::string_view name) {
  const LensModelEntry& lens = lens_model_of(name);
  if (lens.model == LensModel::equirectangular)
    return {.name = name, .parameters = 2, .focals = 2, .lens = lens.model};
  return {.name = name,
          .parameters = lens.intrinsics.size() + lens.distortion.size(),
          .focals = lens.intrinsics.size() - 2,
          .lens = lens.model};
}

/// EUCM with alpha = 0 is a pinhole camera for every beta, so only alpha counts.
std::size_t distortion_parameters(const Model& model) {
  return model.name == "EUCM" ? 1 : model.parameters - model.focals - 2;
}

using Cameras = std::map<std::uint32_t, ImportedCamera>;

/// One camera of a file.
struct CameraRecord {
  std::uint32_t id = 0;
  std::uint64_t width = 0, height = 0;
  std::vector<double> parameters;
};

/// One image of a file.
struct ImageRecord {
  std::array<double, 4> quaternion{};  // w, x, y, z
  std::array<double, 3> translation{};
  std::uint32_t camera = 0;
  std::string name;
};

/// The camera of a record, still at the origin. Messages begin with `where`.
ImportedCamera make_camera(const CameraRecord& record, const Model& model,
                           const std::string& where) {
  const std::string about = where + ": camera " + std::to_string(record.id) + ": ";
  ImportedCamera result;
  constexpr std::uint64_t largest = std::numeric_limits<std::uint32_t>::max();
  if (record.width > largest || record.height > largest) {
    result.fault = about + "the image is too large";
    return result;
  }
  std::vector<double> numbers = record.parameters;
  if (model.lens == LensModel::equirectangular)
    numbers.insert(numbers.end(), {numbers[0] / 2, numbers[1] / 2});
  const auto distortion = numbers.begin() + static_cast<long>(model.focals) + 2;
  Camera& camera = result.camera;
  if (model.always_bends() ||
      std::any_of(distortion, distortion + static_cast<long>(distortion_parameters(model)),
                  [](double k) { return k != 0; })) {
    Lens lens{model.lens};
    std::copy(distortion, numbers.end(), lens.distortion.begin());
    if (const auto fault = find_fault(lens)) {
      result.distortion = about + *fault;
    } else {
      camera.projection.lens = lens;
    }
  }
  camera.width = static_cast<std::uint32_t>(record.width);
  camera.height = static_cast<std::uint32_t>(record.height);
  set_intrinsics(camera.projection, std::array{numbers[0], numbers[model.focals - 1],
                                               numbers[model.focals], numbers[model.focals + 1]});
  if (const auto fault = find_fault(camera)) result.fault = about + *fault;
  return result;
}

ImportedCamera place(const ImageRecord& image, const Cameras& cameras, const std::string& where) {
  const auto camera = cameras.find(image.camera);
  if (camera == cameras.end())
    throw InputError(where + ": the image refers to camera " + std::to_string(image.camera) +
                     ", which the model does not have");
  ImportedCamera result = camera->second;
  result.camera.name = image.name;
  if (!result.fault.empty()) return result;
  const auto finite = [](double x) { return std::isfinite(x); };
  if (!std::all_of(image.quaternion.begin(), image.quaternion.end(), finite) ||
      !std::all_of(image.translation.begin(), image.translation.end(), finite)) {
    result.fault = where + ": the pose has a number that is not finite";
  } else if (image.quaternion == std::array<double, 4>{}) {
    result.fault = where + ": the quaternion is zero";
  } else {
    const Matrix3 R = rotation_of(image.quaternion);
    for (int i = 0; i < 3; ++i)
      result.camera.world_to_camera[i] = {R[i][0], R[i][1], R[i][2], image.translation[i]};
    if (const auto fault = find_fault(result.camera)) result.fault = where + ": " + *fault;
  }
  return result;
}

void sort_by_name(std::vector<ImportedCamera>& images) {
  std::stable_sort(images.begin(), images.end(),
                   [](const auto& a, const auto& b) { return a.camera.name < b.camera.name; });
}

void add_camera(Cameras& cameras, const CameraRecord& record, const Model& model,
                const std::string& where) {
  if (!cameras.emplace(record.id, make_camera(record, model, where)).second)
    throw InputError(where + ": camera " + std::to_string(record.id) + " stands twice");
}

// Binary files

/// Reads numbers from a binary file; every failure names the byte.
class BinaryReader {
 public:
  explicit BinaryReader(NamedStream file) : file_(std::move(file)) {
    file_.stream.seekg(0, std::ios::end);
    size_ = static_cast<std::uint64_t>(std::max<std::streamoff>(0, file_.stream.tellg()));
    file_.stream.seekg(0);
  }

  template <class T>
  T read() {
    expect_left(sizeof(T));
    std::array<char, sizeof(T)> bytes;
    file_.stream.read(bytes.data(), sizeof(T));
    at_ += sizeof(T);
    return std::bit_cast<T>(bytes);
  }

  std::string read_text() {
    std::string text;
    for (char c = read<char>(); c != '\0'; c = read<char>()) text.push_back(c);
    return text;
  }

  /// Skips `count` records of `size` bytes.
  void skip(std::uint64_t count, std::uint64_t size) {
    if (count > (size_ - at_) / size) expect_left(size_ - at_ + 1);
    at_ += count * size;
    file_.stream.seekg(static_cast<std::streamoff>(at_));
  }

  void expect_end() const {
    if (at_ != size_) throw InputError(where() + ": data follow that were not announced");
  }

  [[nodiscard]] std::string where() const { return file_.name + ": byte " + std::to_string(at_); }

 private:
  void expect_left(std::uint64_t bytes) const {
    if (bytes > size_ - at_) throw InputError(where() + ": the file ends too early");
  }

  NamedStream file_;
  std::uint64_t size_ = 0;
  std::uint64_t at_ = 0;
};

Cameras read_binary_cameras(BinaryReader file) {
  Cameras cameras;
  const auto count = file.read<std::uint64_t>();
  for (std::uint64_t i = 0; i < count; ++i) {
    CameraRecord record;
    const std::string where = file.where();
    record.id = file.read<std::uint32_t>();
    const auto id = file.read<std::uint32_t>();
    if (id >= model_names.size())
      throw InputError(where + ": unknown camera model " + std::to_string(id) +
                       "; convert the model to text or undistort it (colmap image_undistorter)");
    record.width = file.read<std::uint64_t>();
    record.height = file.read<std::uint64_t>();
    const Model model = colmap_model(model_names[id]);
    for (std::size_t k = 0; k < model.parameters; ++k)
      record.parameters.push_back(file.read<double>());
    add_camera(cameras, record, model, where);
  }
  file.expect_end();
  return cameras;
}

std::vector<ImportedCamera> read_binary_images(BinaryReader file, const Cameras& cameras) {
  std::vector<ImportedCamera> images;
  const auto count = file.read<std::uint64_t>();
  for (std::uint64_t i = 0; i < count; ++i) {
    ImageRecord image;
    const std::string where = file.where();
    file.read<std::uint32_t>();  // the image's id
    for (double& q : image.quaternion) q = file.read<double>();
    for (double& t : image.translation) t = file.read<double>();
    image.camera = file.read<std::uint32_t>();
    image.name = file.read_text();
    file.skip(file.read<std::uint64_t>(), 24);  // points: x, y, id
    images.push_back(place(image, cameras, where));
  }
  file.expect_end();
  return images;
}

// Text files

Cameras read_text_cameras(NamedStream file) {
  Cameras cameras;
  Line line;
  for (std::size_t number = 0; next_line(file, number, line);) {
    CameraRecord record;
    record.id = read_integer<std::uint32_t>(line, "a camera id");
    std::string name;
    line.words >> name;
    if (std::ranges::find(model_names, name) == model_names.end())
      throw InputError(line.where + ": unknown camera model '" + name + "'");
    const Model model = colmap_model(name);
    record.width = read_integer<std::uint64_t>(line, "a width");
    record.height = read_integer<std::uint64_t>(line, "a height");
    for (std::size_t k = 0; k < model.parameters; ++k)
      record.parameters.push_back(read_number(line, "a camera parameter"));
    if (std::string rest; line.words >> rest)
      throw InputError(line.where + ": the model " + name + " has " +
                       std::to_string(model.parameters) + " parameters, found more");
    add_camera(cameras, record, model, line.where);
  }
  return cameras;
}

std::vector<ImportedCamera> read_text_images(NamedStream file, const Cameras& cameras) {
  std::vector<ImportedCamera> images;
  Line line;
  for (std::size_t number = 0; next_line(file, number, line);) {
    ImageRecord image;
    read_integer<std::uint32_t>(line, "an image id");
    for (double& q : image.quaternion) q = read_number(line, "a quaternion's number");
    for (double& t : image.translation) t = read_number(line, "a translation's number");
    image.camera = read_integer<std::uint32_t>(line, "a camera id");
    std::getline(line.words >> std::ws, image.name);
    if (image.name.empty()) throw InputError(line.where + ": the image's name is missing");
    images.push_back(place(image, cameras, line.where));
    // The line of the points, which may be empty, and missing at the end of the file.
    file.stream.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    ++number;
  }
  return images;
}

std::vector<ImportedCamera> finished(std::vector<ImportedCamera> images, const std::string& name) {
  if (images.empty()) throw InputError(name + ": the model has no image");
  sort_by_name(images);
  return images;
}

/// The folders in a folder, in the order of their names; none if it cannot be read.
std::vector<std::filesystem::path> folders_in(const std::filesystem::path& folder) {
  constexpr std::size_t most = 1000;
  std::vector<std::filesystem::path> found;
  std::error_code error;
  std::filesystem::directory_iterator entry(folder, error);
  for (; !error && entry != std::filesystem::directory_iterator() && found.size() < most;
       entry.increment(error)) {
    std::error_code unreadable;
    if (entry->is_directory(unreadable)) found.push_back(entry->path());
  }
  std::ranges::sort(found);
  return found;
}

/// "; did you mean 'sparse/0'?", of the models one or two folders below, at most three.
std::string models_in(const std::filesystem::path& folder) {
  std::vector<std::string> found;
  const auto note = [&](const std::filesystem::path& place) {
    if (found.size() < 3 && is_colmap_model(place)) found.push_back(place.string());
  };
  for (const std::filesystem::path& below : folders_in(folder)) {
    note(below);
    for (const std::filesystem::path& next : folders_in(below)) note(next);
  }
  const std::string question = did_you_mean(found);
  return question.empty() ? question : "; " + question;
}

}  // namespace

std::vector<ImportedCamera> camera::parse_colmap_binary(NamedStream cameras, NamedStream images) {
  const std::string name = images.name;
  return finished(read_binary_images(BinaryReader(std::move(images)),
                                     read_binary_cameras(BinaryReader(std::move(cameras)))),
                  name);
}

std::vector<ImportedCamera> camera::parse_colmap_text(NamedStream cameras, NamedStream images) {
  const std::string name = images.name;
  return finished(read_text_images(std::move(images), read_text_cameras(std::move(cameras))), name);
}

std::vector<ImportedCamera> import_colmap(const std::filesystem::path& folder) {
  const StandardArithmetic standard;
  using Parse = std::vector<ImportedCamera> (*)(NamedStream, NamedStream);
  const std::pair<const char*, Parse> forms[] = {{".bin", parse_colmap_binary},
                                                 {".txt", parse_colmap_text}};
  for (const auto& [suffix, parse] : forms) {
    const auto cameras_file = folder / (std::string("cameras") + suffix);
    const auto images_file = folder / (std::string("images") + suffix);
    std::ifstream cameras(cameras_file, std::ios::binary), images(images_file, std::ios::binary);
    if (cameras.is_open() && images.is_open())
      return parse({cameras, cameras_file.string()}, {images, images_file.string()});
  }
  throw InputError(folder.string() +
                   ": expected a COLMAP model, a folder with cameras.bin and images.bin or "
                   "cameras.txt and images.txt" +
                   models_in(folder));
}

bool is_colmap_model(const std::filesystem::path& folder) {
  const auto has = [&](const char* name) {
    std::error_code error;
    return std::filesystem::is_regular_file(folder / name, error);
  };
  return (has("cameras.bin") && has("images.bin")) || (has("cameras.txt") && has("images.txt"));
}

}  // namespace fathom
