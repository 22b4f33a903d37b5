#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/options/scene_options.h"
#include "apps/shell/command.h"
#include "apps/shell/console.h"
#include "fathom/camera/camera.h"
#include "fathom/camera/camera_making.h"
#include "fathom/scene/scene.h"

namespace fathom::app {

/// `--view --up`: direction of a camera, seen from the point that it looks at.
std::array<Option, 2> add_view_options(Command& command, View& view);

/// `--up`: a word for an axis of the world, or a vector.
Option add_up_option(Command& command, Vector3& up);

/// `--size --fov --focal --orthographic`: the lens of a camera that is made; `--fov` is the
/// vertical angle.
std::vector<Option> add_lens_options(Command& command, LensChoice& lens);

/// `--model --distortion`: how the lens of a camera that is made bends rays.
class DistortionOptions {
 public:
  void add_to(Command& command);
  /// The lens with this distortion. Fails with UsageError.
  [[nodiscard]] LensChoice applied(LensChoice lens) const;

 private:
  std::string model_;
  std::optional<std::vector<double>> numbers_;
};

/// `--near --far`: the depth range of a camera that is made.
void add_range_options(Command& command, LensChoice& lens);

/// `--near --far --scale`: changes of cameras from a file.
class CameraChanges {
 public:
  std::vector<Option> add_to(Command& command);
  /// Fails    UsageError where a camera would have no depth range; as scaled().
  [[nodiscard]] std::vector<Camera> applied(std::vector<Camera> cameras) const;
  /// The lens of a camera that is made, with this depth range.
  [[nodiscard]] LensChoice applied(LensChoice lens) const;

 private:
  std::optional<double> near_, far_, scale_;
};

/// `--camera FILE`, or the camera that frames the scene with
/// `--view --up --size --fov --focal --orthographic`; both with `--near --far --scale`.
class CameraOptions {
 public:
  void add_to(Command& command);
  /// Whether the cameras come from a file.
  [[nodiscard]] bool from_file() const { return !file_.empty(); }
  /// The name of one of these options that is given, for a command that may take no camera.
  [[nodiscard]] std::optional<std::string> given() const;
  /// `limits` bound the files that the camera file may name. Warnings of the file go to the
  /// console.
  /// Fails with InputError where the file holds no camera, or the scene no triangle to frame.
  [[nodiscard]] std::vector<Camera> get(const Scene& scene, const ReadLimits& limits,
                                        const Console& console) const;
  /// For a command that takes a single camera. Fails with UsageError for a path of cameras.
  [[nodiscard]] Camera get_one(const Scene& scene, const ReadLimits& limits, const char* command,
                               const Console& console) const;

 private:
  std::string file_;
  View view_;
  LensChoice lens_;
  CameraChanges changes_;
  std::optional<Option> size_;
  std::vector<Option> options_;
};

inline constexpr std::string_view takes_no_lens =
    "this command takes no lens; 'fathom render' and 'fathom probe' do, and so do info, preview "
    "and view of maps";

/// The cameras of a camera file, or the camera that a map carries, each without fault; warnings go
/// to the console. Fails with InputError, and with UsageError, which says `why`, for a lens that
/// bends rays; opens no table of directions.
std::vector<Camera> read_cameras_without_lens(const std::string& file, const Console& console,
                                              std::string_view why = takes_no_lens);
/// The same for a command that takes lenses, or calls functions that refuse them.
std::vector<Camera> read_cameras_with_lenses(const std::string& file, const ReadLimits& limits,
                                             const Console& console);

/// The single camera of a file.
/// Fails    InputError also for a path of several cameras.
Camera read_camera_with_lens(const std::string& file, const ReadLimits& limits,
                             const Console& console);

/// The camera of a path whose name is the file name of a map: images/a.jpg for views/a.npy and for
/// a.jpg.geometric.bin.
/// Fails    UsageError unless there is exactly one.
Camera camera_called_as(const std::string& map, const std::vector<Camera>& cameras);

/// One of the cameras for each map: in order if there are as many, or else the camera that is
/// called as the map.
/// Fails    UsageError of camera_called_as().
std::vector<Camera> cameras_of_maps(const std::vector<std::string>& maps,
                                    const std::vector<Camera>& cameras);

/// Refuses a camera of another size than the map. `file` is the camera's file for messages.
/// Fails    InputError.
void require_size_of(const DepthMap& map, const Camera& camera, const std::string& file);

}  // namespace fathom::app
