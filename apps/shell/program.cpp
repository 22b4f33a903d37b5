#include "apps/shell/program.h"

#include <map>

namespace fathom::app {
namespace {

constexpr const char* version_line = "fathom " FATHOM_VERSION;

void add_common(CLI::App& command, Console& console, const std::string& examples) {
  command.set_help_flag("-h,--help", "Show this help with an example");
  command.set_version_flag("--version", version_line, "Show the version");
  command.add_flag("--quiet", console.quiet, "No warnings and no progress");
  command.footer("Examples:\n" + examples);
}

/// What options take, as the help shows it: "COMMAND OPTION" comes before "OPTION".
const std::map<std::string, std::string> value_names{{"--background", "R,G,B"},
                                                     {"--baseline", "B"},
                                                     {"--c", "C"},
                                                     {"--camera", "FILE"},
                                                     {"--centre", "X,Y,Z"},
                                                     {"--depth-range", "A,B"},
                                                     {"--distance", "D"},
                                                     {"--doffs", "D"},
                                                     {"--eye", "X,Y,Z"},
                                                     {"--far", "D"},
                                                     {"--focal", "PIXELS"},
                                                     {"--fov", "DEG"},
                                                     {"--heatmap", "PNG"},
                                                     {"--map", "MAP"},
                                                     {"--near", "D"},
                                                     {"--opacity", "ALPHA"},
                                                     {"--orthographic", "HEIGHT"},
                                                     {"--other-background", "D"},
                                                     {"--out", "DIR"},
                                                     {"--output", "FILE"},
                                                     {"--pixel", "X,Y"},
                                                     {"--png-scale", "N"},
                                                     {"--polygon-offset", "FACTOR,UNITS"},
                                                     {"--range", "LOW,HIGH"},
                                                     {"--repeat", "N"},
                                                     {"--samples", "N"},
                                                     {"--save-camera", "FILE"},
                                                     {"--scissor", "X,Y,W,H"},
                                                     {"--separation", "D"},
                                                     {"--size", "WxH"},
                                                     {"--stats", "FILE"},
                                                     {"--subpixel-bits", "N"},
                                                     {"--target", "X,Y,Z"},
                                                     {"--threads", "N"},
                                                     {"--time-limit", "SECONDS"},
                                                     {"--tolerance-ulp", "N"},
                                                     {"--triangle", "N"},
                                                     {"--truth-background", "D"},
                                                     {"--verify", "N"},
                                                     {"--view", "AZ,EL"},
                                                     {"--viewport", "X,Y,W,H"},
                                                     {"--views", "N"},
                                                     {"--within", "D"},
                                                     {"-o", "MAP"},
                                                     {"validate --baseline", "REPORT"}};

/// An empty value is mostly a variable of a script that is not set: it would pass for the default.
std::string complaint_of_nothing(const std::string& value) {
  return value.empty() ? "the value is empty" : "";
}

void name_values_of(CLI::App& command) {
  for (CLI::Option* option : command.get_options()) {
    if (option->get_expected_max() == 0) continue;
    option->check(complaint_of_nothing);
    auto name = value_names.find(command.get_name() + " " + option->get_name());
    if (name == value_names.end()) name = value_names.find(option->get_name());
    option->type_name(name != value_names.end()            ? name->second
                      : option->get_lnames().empty()       ? ""
                      : option->get_name() == "--channels" ? "LIST"
                                                           : "NAME");
  }
  for (CLI::App* child : command.get_subcommands({})) name_values_of(*child);
}

}  // namespace

Program::Program() : app("Exact depth maps of triangle meshes.", "fathom") {
  add_common(app, console,
             "  fathom render data/meshes/spot.obj -o spot.exr\n"
             "  fathom preview spot.exr -o spot.png\n"
             "  fathom probe data/meshes/spot.obj --pixel 640,360\n"
             "\nPrograms of their own, which 'scripts/fathom bench' and 'scripts/fathom validate' "
             "build: bench, times\nbeside VTK and Embree; validate, another renderer's maps held "
             "against the truth.\n"
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

void Program::name_values() {
  name_values_of(app);
}

}  // namespace fathom::app
