#include "fathom/scene/motion.h"

#include <algorithm>
#include <cmath>

#include "fathom/failures/errors.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/scene/scene_json.h"
#include "fathom/text/json_value.h"
#include "fathom/text/printable.h"

namespace fathom {
using namespace text;

namespace {

constexpr const char* increasing = "the times of keyframes have to increase";

ObjectMotion read_object(const JsonValue& object) {
  object.expect_only({"name", "keyframes"});
  ObjectMotion motion{object.at("name").string(), {}};
  const std::vector<JsonValue> keyframes = object.at("keyframes").elements();
  if (keyframes.empty()) object.at("keyframes").fail("is empty, expected at least one keyframe");
  for (const JsonValue& value : keyframes) {
    value.expect_only({"time", "transform"});
    const double time = value.at("time").number();
    if (!motion.keyframes.empty() && !(time > motion.keyframes.back().time)) {
      value.at("time").fail(increasing);
    }
    motion.keyframes.push_back({time, scene::read_transform(value.at("transform"))});
  }
  return motion;
}

/// The beginning of messages about one of its objects.
std::string start_of(const Motion& motion, const std::string& object) {
  return motion.file + ": object " + printable(object) + ": ";
}

/// Checks a motion that a caller filled in.
void require_meaningful(const Motion& motion) {
  for (const ObjectMotion& m : motion.objects) {
    const std::string name = start_of(motion, m.object);
    if (m.keyframes.empty()) throw InputError(name + "expected at least one keyframe");
    for (std::size_t i = 0; i < m.keyframes.size(); ++i) {
      if (!std::isfinite(m.keyframes[i].time)) throw InputError(name + "a time is not finite");
      if (i > 0 && !(m.keyframes[i].time > m.keyframes[i - 1].time)) {
        throw InputError(name + increasing);
      }
    }
  }
}

}  // namespace

Motion read_motion(std::string_view text, const std::filesystem::path& path) {
  const StandardArithmetic standard;
  const JsonDocument document(text, path.string());
  const JsonValue root = document.root();
  if (!root.is_object()) root.fail("is no object, expected a motion: {\"objects\": […]}");
  root.expect_only({"objects"});
  Motion motion{.objects = {}, .file = path.string()};
  for (const JsonValue& object : root.at("objects").elements()) {
    ObjectMotion next = read_object(object);
    for (const ObjectMotion& other : motion.objects) {
      if (other.object == next.object)
        object.at("name").fail("moves twice, expected each name once");
    }
    motion.objects.push_back(std::move(next));
  }
  return motion;
}

WorldFromMesh transform_at(const ObjectMotion& motion, double time) {
  const StandardArithmetic standard;
  const std::vector<Keyframe>& frames = motion.keyframes;
  const auto next = std::upper_bound(frames.begin(), frames.end(), time,
                                     [](double t, const Keyframe& k) { return t < k.time; });
  if (next == frames.begin()) return frames.front().world_from_placed;
  const Keyframe& before = *(next - 1);
  if (next == frames.end() || time == before.time) return before.world_from_placed;
  // Halves, so that no difference of finite times overflows.
  const Dyadic share((time / 2 - before.time / 2) / (next->time / 2 - before.time / 2));
  WorldFromMesh result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      const Dyadic& a = before.world_from_placed.rows[i][k];
      result.rows[i][k] = a + share * (next->world_from_placed.rows[i][k] - a);
    }
  }
  return result;
}

namespace {

/// "; its objects are a, b, c", the first few.
std::string names_of(const Scene& scene) {
  constexpr std::size_t most = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, scene.objects.size()); ++i)
    text += (i == 0 ? "; its objects are " : ", ") + printable(scene.objects[i].name);
  return text + (scene.objects.size() > most ? ", …" : "");
}

}  // namespace

MovingScene::MovingScene(Scene scene, Motion motion)
    : scene_(std::move(scene)), motion_(std::move(motion)) {
  require_meaningful(motion_);
  for (std::size_t m = 0; m < motion_.objects.size(); ++m) {
    const std::size_t before = moved_.size();
    for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
      if (scene_.objects[i].name != motion_.objects[m].object) continue;
      moved_.push_back({i, m, scene_.objects[i].world_from_mesh});
    }
    if (moved_.size() == before) {
      throw InputError(start_of(motion_, motion_.objects[m].object) +
                       "the scene has no object of this name" + names_of(scene_));
    }
  }
}

const Scene& MovingScene::at(double time) {
  const StandardArithmetic standard;
  if (!std::isfinite(time)) throw UsageError(Setting{"time"}, "expected a finite number");
  for (const Moved& moved : moved_) {
    Object& object = scene_.objects[moved.object];
    object.world_from_mesh =
        compose(transform_at(motion_.objects[moved.motion], time), moved.placed);
    object.placed_as_is = object.world_from_mesh.rows == WorldFromMesh().rows;
    if (const auto fault = find_fault(object.world_from_mesh))
      throw InputError(start_of(motion_, object.name) + *fault);
  }
  return scene_;
}

Scene MovingScene::take(double time) && {
  at(time);
  return std::move(scene_);
}

}  // namespace fathom
