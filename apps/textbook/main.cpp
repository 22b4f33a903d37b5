// fathom-textbook: what `fathom` needs for clip, scan, pipeline and render --engine pipeline.

#include "apps/commands.h"
#include "apps/render/render_command.h"
#include "apps/shell/program.h"
#include "fathom/failures/errors.h"

namespace fathom::app {
namespace {

int refuse_exact_engines(const RenderArguments&, const Console&) {
  throw UsageError(
      "fathom-textbook only renders with --engine pipeline; use fathom for other engines");
}

std::vector<AddCommand> commands(const std::vector<std::string>&) {
  const auto add_render_by_pipeline = [](Command& program) {
    add_render(program, refuse_exact_engines, render_by_pipeline);
  };
  return {add_render_by_pipeline, add_clip, add_scan, add_pipeline};
}

}  // namespace
}  // namespace fathom::app

int main(int argc, char** argv) {
  return fathom::app::program_main(argc, argv, fathom::app::commands);
}
