// fathom coplanar SCENE… --camera FILE [--within DISTANCE]

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "apps/commands.h"
#include "apps/companions.h"
#include "apps/options/camera_options.h"
#include "apps/options/scene_options.h"
#include "apps/shell/console.h"
#include "apps/shell/failures.h"
#include "apps/shell/standard_streams.h"
#include "apps/shell/values.h"
#include "fathom/area/coplanar.h"
#include "fathom/failures/errors.h"
#include "fathom/scene/bounds.h"
#include "fathom/text/counted.h"
#include "fathom/text/printable.h"

namespace fathom::app {
namespace {

using Json = nlohmann::ordered_json;

struct CoplanarArguments {
  SceneOptions scene;
  CameraOptions camera;
  double within = 0;
  Cull cull = Cull::none;
  bool json = false;
};

/// "triangle NUMBER (face FACE of OBJECT)"
std::string in_words(const Scene& scene, std::uint32_t number) {
  const TriangleOrigin origin = origin_of(scene, number);
  return fmt::format("triangle {} (face {} of {})", number, origin.face,
                     text::printable(scene.objects[origin.object].name));
}

std::string as_text(const Scene& scene, const std::vector<CoplanarPair>& pairs, double within) {
  std::string text;
  for (const CoplanarPair& pair : pairs) {
    text += fmt::format("{} before {}: least distance {}, {}", in_words(scene, pair.visible),
                        in_words(scene, pair.behind), pair.separation,
                        text::counted(pair.pixels, "pixel"));
    text += fmt::format(", columns {} to {}, rows {} to {}\n", pair.box.first_column,
                        pair.box.last_column, pair.box.first_row, pair.box.last_row);
  }
  return text + fmt::format("{} within {}\n", text::counted(pairs.size(), "coplanar pair"), within);
}

Json triangle_as_json(const Scene& scene, std::uint32_t number) {
  const TriangleOrigin origin = origin_of(scene, number);
  return {{"triangle", number},
          {"object", origin.object},
          {"name", scene.objects[origin.object].name},
          {"face", origin.face}};
}

std::string as_json(const Scene& scene, const std::vector<CoplanarPair>& pairs, double within) {
  Json list = Json::array();
  for (const CoplanarPair& pair : pairs) {
    const PixelBox& box = pair.box;
    list.push_back({{"visible", triangle_as_json(scene, pair.visible)},
                    {"behind", triangle_as_json(scene, pair.behind)},
                    {"separation", pair.separation},
                    {"pixels", pair.pixels},
                    {"columns", {box.first_column, box.last_column}},
                    {"rows", {box.first_row, box.last_row}}});
  }
  const Json answer{{"within", within}, {"pairs", list}};
  return json_answer(answer);
}

double parse_distance(const std::string& text) {
  const double distance = parse_number(text);
  if (distance < 0) throw UsageError("'" + text + "' is negative");
  return distance;
}

/// The pairs that cover most pixels first; among equals, the nearest ones.
void put_important_first(std::vector<CoplanarPair>& pairs) {
  std::ranges::stable_sort(pairs, [](const CoplanarPair& a, const CoplanarPair& b) {
    return std::pair(b.pixels, a.separation) < std::pair(a.pixels, b.separation);
  });
}

/// A distance beyond which surfaces are apart on purpose, rounded to a digit: rounding the
/// coordinates of a plane to 5 decimals moves it by less.
double distance_of_roundings(const Scene& scene) {
  const std::optional<WorldBounds> bounds = world_bounds(scene);
  if (!bounds) return 0;
  const auto &low = bounds->lower, &high = bounds->upper;
  const double diagonal = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
  if (!std::isfinite(diagonal)) return 0;
  return parse_number(fmt::format("{:.0e}", 1e-5 * diagonal));
}

/// If no pair is within the distance: the nearest pair among surfaces that lie in one plane except
/// for roundings, and the --within that finds it. Empty if there is none.
std::string nearest_pair(const Scene& scene, const Camera& camera,
                         const CoplanarArguments& arguments, const RenderOptions& options,
                         const Console& console) {
  // It takes as long as the first look.
  constexpr std::uint64_t most_triangles = 100'000;
  const double within = distance_of_roundings(scene);
  if (within <= arguments.within || triangle_count(scene) > most_triangles) return "";
  Progress progress(console, "looking farther");
  const std::vector<CoplanarPair> pairs =
      coplanar_pairs(scene, camera, within, options, progress.reporter());
  if (pairs.empty()) return "";
  const CoplanarPair& nearest = *std::ranges::min_element(pairs, {}, &CoplanarPair::separation);
  // Planes that are equal except for roundings may cross.
  const std::string distance =
      nearest.separation > 0 ? fmt::format(", least distance {}", nearest.separation) : "";
  return fmt::format("nearest pair: {} before {}{}; --within {} finds {}\n",
                     in_words(scene, nearest.visible), in_words(scene, nearest.behind), distance,
                     within, text::counted(pairs.size(), "pair"));
}

int run_coplanar(const CoplanarArguments& arguments, const Console& console) {
  RenderOptions options;
  options.cull = arguments.cull;
  options.threads = arguments.scene.threads;
  const Scene scene = arguments.scene.read(console);
  const Camera camera =
      arguments.camera.get_one(scene, arguments.scene.limits, "coplanar", console);
  std::vector<CoplanarPair> pairs;
  {
    Progress progress(console, "comparing");
    pairs = coplanar_pairs(scene, camera, arguments.within, options, progress.reporter());
  }
  put_important_first(pairs);
  if (arguments.json) {
    print(as_json(scene, pairs, arguments.within));
    return done;
  }
  const std::string nearest =
      pairs.empty() ? nearest_pair(scene, camera, arguments, options, console) : "";
  print(as_text(scene, pairs, arguments.within) + nearest);
  return done;
}

}  // namespace

void add_coplanar(Command& program) {
  const auto arguments = std::make_shared<CoplanarArguments>();
  Command& command =
      program.command("coplanar", description_of_companion("coplanar"),
                      "  fathom coplanar room.json\n"
                      "  fathom coplanar room.json --camera camera.json --within 0.001 --json");
  arguments->scene.add_to(command);
  arguments->camera.add_to(command);
  command.option("--within", "D", into(arguments->within, parse_distance),
                 "Greatest distance along the view between the two surfaces of a pair (default 0: "
                 "only coincident surfaces)");
  add_cull_option(command, arguments->cull);
  command.flag("--json", arguments->json, "Print JSON");
  command.answers_on_standard_output();
  command.runs([arguments](const Console& console) { return run_coplanar(*arguments, console); });
}

}  // namespace fathom::app
