#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "apps/bench/bench_command.h"
#include "apps/bench/machine.h"
#include "apps/bench/parts/ideas.h"
#include "apps/bench/parts/parts_report.h"
#include "apps/shell/console.h"
#include "apps/shell/failures.h"
#include "apps/shell/output_file.h"
#include "apps/shell/standard_streams.h"
#include "fathom/fast/render_fast.h"

namespace fathom::app {
namespace {

using bench::PartsOfScene;

/// Many small triangles, many large ones over each other, few that cover everything.
const std::vector<std::string> default_scenes{"sphere-20k", "soup", "few-large"};
constexpr Size default_size{640, 360};

/// 1, 2, 4, … and all processors.
std::vector<int> doubling_threads() {
  std::vector<int> counts;
  for (int count = 1; count < bench::processor_count(); count *= 2) counts.push_back(count);
  counts.push_back(bench::processor_count());
  return counts;
}

/// Those asked for, in the order of the program.
std::vector<std::string> ideas_to_time(const BenchArguments& arguments) {
  std::vector<std::string> names = bench::idea_names();
  if (!arguments.ideas.empty()) {
    std::erase_if(names, [&](const std::string& name) {
      return std::find(arguments.ideas.begin(), arguments.ideas.end(), name) ==
             arguments.ideas.end();
    });
  }
  return names;
}

/// Shows what it finds as it goes.
class PartsRun {
 public:
  PartsRun(const BenchArguments& arguments, bool shows_tables, const Console& console)
      : a_(arguments),
        console_(console),
        shows_tables_(shows_tables),
        threads_(arguments.threads.empty() ? doubling_threads() : arguments.threads) {}

  void run(const std::string& name, const Size& size) {
    const bench::PartsScene scene(bench::make_scene(name, size[0], size[1]));
    PartsOfScene parts{name, triangle_count(scene.bench.scene), size[0], size[1], {}, {}};
    show(bench::heading(parts) + "\n");
    for (const std::string& idea : ideas_to_time(a_)) time_ideas(idea, scene, parts);
    rules_.push_back(bench::closed_edges(name, scene.window));
    parts_.push_back(std::move(parts));
  }

  /// The demo's counts come first.
  std::string finish(const bench::Machine& machine) {
    std::vector<bench::RuleCounts> rules = bench::closed_edges_of_demo();
    rules.insert(rules.end(), rules_.begin(), rules_.end());
    show(bench::table(rules));
    return bench::to_json(machine, parts_, rules) + "\n";
  }

 private:
  void time_ideas(const std::string& name, const bench::PartsScene& scene, PartsOfScene& parts) {
    std::optional<Progress> progress(std::in_place, console_, parts.scene + ", " + name);
    const auto report = progress->reporter();
    if (report) report(0);
    const std::vector<bench::Idea> ideas = bench::ideas_named(name, scene, threads_);
    const std::size_t first = parts.ideas.size();
    for (const bench::Idea& idea : ideas) {
      parts.ideas.push_back(bench::time_idea(idea, a_.repeat));
      if (report) {
        report(static_cast<double>(parts.ideas.size() - first) / static_cast<double>(ideas.size()));
      }
    }
    progress.reset();
    for (std::size_t i = first; i < parts.ideas.size(); ++i) show(bench::table(parts.ideas[i]));
    if (ideas.empty()) {
      parts.left_out.push_back(name + ": changes the picture, as the mesh is not closed here");
      show(parts.left_out.back() + "\n\n");
    }
  }

  void show(const std::string& text) const {
    if (shows_tables_) print(text);
  }

  const BenchArguments& a_;
  const Console& console_;
  bool shows_tables_;
  std::vector<int> threads_;
  std::vector<PartsOfScene> parts_;
  std::vector<bench::RuleCounts> rules_;
};

}  // namespace

int run_parts(const BenchArguments& arguments, const Console& console) {
  TextOutput json(arguments.json);
  const bool shows_tables = arguments.json != "-";
  const bench::Machine machine = bench::this_machine();
  if (shows_tables) {
    print(bench::machine_line(machine));
    print(fmt::format("Vector instructions: {}\n\n", vector_instructions()));
  }
  PartsRun run(arguments, shows_tables, console);
  const auto& scenes = arguments.scenes.empty() ? default_scenes : arguments.scenes;
  const auto sizes = arguments.sizes.empty() ? std::vector<Size>{default_size} : arguments.sizes;
  for (const Size& size : sizes)
    for (const std::string& scene : scenes) run.run(scene, size);
  json.finish(run.finish(machine));
  return done;
}

}  // namespace fathom::app
