#include "program.h"

namespace fathom::app {
namespace {

constexpr const char* version_line = "fathom " FATHOM_VERSION;

void add_common(CLI::App& command, Console& console, const std::string& examples) {
  command.set_help_flag("-h,--help", "Show this help with an example");
  command.set_version_flag("--version", version_line, "Show the version");
  command.add_flag("--quiet", console.quiet, "No warnings and no progress");
  command.footer("Examples:\n" + examples);
}

}  // namespace

Program::Program() : app("Exact depth maps of triangle meshes.", "fathom") {
  add_common(app, console,
             "  fathom render data/meshes/spot.obj -o spot.exr\n"
             "  fathom preview spot.exr -o spot.png\n"
             "  fathom probe data/meshes/spot.obj --pixel 640,360\n"
             "\n'fathom COMMAND --help' explains a command.");
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);
}

CLI::App* Program::add_command(const std::string& name, const std::string& description,
                               const std::string& examples, CLI::App* parent) {
  CLI::App* command = (parent != nullptr ? parent : &app)->add_subcommand(name, description);
  add_common(*command, console, examples);
  return command;
}

}  // namespace fathom::app
