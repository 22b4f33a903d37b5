// fathom sees SCENE… --pairs FILE

#include <memory>

#include "apps/commands.h"
#include "apps/companions.h"
#include "apps/options/scene_options.h"
#include "apps/rays/columns.h"
#include "apps/rays/ray_file.h"
#include "apps/shell/console.h"
#include "apps/shell/failures.h"
#include "apps/shell/values.h"
#include "fathom/rays/sight.h"

namespace fathom::app {
namespace {

struct SeesArguments {
  SceneOptions scene;
  std::string pairs;
  EdgeRule edges = EdgeRule::closed;
  std::string output = "-";
};

EdgeRule parse_edges(const std::string& text) {
  return parse_enumerator(text, all_edge_rules);
}

int run_sees(const SeesArguments& a, const Console& console) {
  ColumnOutput output(a.output);
  const SightPairs pairs = read_pairs(a.pairs);
  const Scene scene = a.scene.read(console);
  const RayScene prepared(scene, a.scene.threads);
  const std::vector<bool> seen =
      sees(prepared, pairs.eyes, pairs.points, {a.edges, a.scene.threads});
  output.append({{"pair", {}, numbers_from(0, seen.size())},
                 {"seen", {}, std::vector<std::uint32_t>(seen.begin(), seen.end())}});
  output.finish();
  return done;
}

}  // namespace

void add_sees(Command& program) {
  const auto arguments = std::make_shared<SeesArguments>();
  Command& command =
      program.command("sees", description_of_companion("sees"),
                      "  fathom sees room.json --pairs pairs.csv -o seen.csv\n"
                      "  fathom sees room.json --pairs pairs.npy --edges generic -o seen.npz");
  arguments->scene.add_to(command);
  command
      .option(
          "--pairs", "FILE", arguments->pairs,
          "CSV file with the columns x, y and z (eye) and px, py and pz (point), or triangle, v "
          "and w (point of a triangle with the weights v and w of its second and third "
          "corner); or NPY file with an array of shape N×6")
      .required();
  command.option("--edges", "RULE", into(arguments->edges, parse_edges),
                 "How an edge hides: closed (default; every edge hides the points behind it) or "
                 "generic (each edge belongs to one triangle, as in 'fathom cast')");
  add_output_option(command, "FILE", arguments->output,
                    "Write the table to this file, .csv or .npz (default -, standard output)");
  command.runs([arguments](const Console& console) { return run_sees(*arguments, console); });
}

}  // namespace fathom::app
