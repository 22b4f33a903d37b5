#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/scene/scene.h"

/// Objects that move: a scene at any time.
namespace fathom {

/// The displacement of an object at a time, applied after its placement in the scene.
struct Keyframe {
  double time = 0;
  WorldFromMesh world_from_placed;
};

/// All objects of a name. Between two keyframes the twelve numbers of the transform go linearly
/// from the one to the other, so a rotation that is to stay one needs keyframes that lie close;
/// before the first and after the last the object is at rest.
struct ObjectMotion {
  std::string object;
  std::vector<Keyframe> keyframes;
};

struct Motion {
  std::vector<ObjectMotion> objects;
  std::string file = "motion";  ///< for messages
};

/// Reads {"objects": [{"name", "keyframes": [{"time", "transform"}]}]}; transforms as in scene
/// files.
/// Fails    InputError naming the key: times that do not increase, no keyframes, a name twice,
///          unknown keys.
Motion read_motion(std::string_view text, const std::filesystem::path& path);

/// The transform of a motion at a time.
/// Exact    except for the share of the time between two keyframes, which is rounded to binary64;
///          at a keyframe it is the keyframe's transform.
WorldFromMesh transform_at(const ObjectMotion& motion, double time);

/// A scene whose objects are placed again for each requested time.
class MovingScene {
 public:
  /// Fails    InputError if the scene has no object with a name in the motion, keyframes are
  ///          missing or their times do not increase.
  MovingScene(Scene scene, Motion motion);

  /// The scene at a time; it lasts until the next call.
  const Scene& at(double time);
  /// Like at(), but moves the scene out.
  Scene take(double time) &&;

 private:
  struct Moved {
    std::size_t object;
    std::size_t motion;
    WorldFromMesh placed;  ///< where the scene places it
  };

  Scene scene_;
  Motion motion_;
  std::vector<Moved> moved_;
};

}  // namespace fathom
