// fathom view MAP [OTHER]… [-o PAGE]

#include "apps/view/view_command.h"

#include <fmt/core.h>

#include <filesystem>
#include <fstream>
#include <memory>

#include "apps/options/map_arguments.h"
#include "apps/shell/console.h"
#include "apps/shell/failures.h"
#include "apps/shell/output_file.h"
#include "apps/shell/output_place.h"
#include "apps/shell/standard_streams.h"
#include "apps/shell/values.h"
#include "apps/view/browser.h"
#include "apps/view/page.h"
#include "fathom/failures/errors.h"
#include "fathom/image/map_formats.h"

namespace fathom::app {
namespace {

using view::ViewedMap;

struct ViewArguments {
  std::vector<std::string> maps;
  std::string output;
  bool open = false;
};

std::string parse_page_name(const std::string& text) {
  const std::string suffix = std::filesystem::path(text).extension().string();
  if (suffix == ".html" || suffix == ".htm" || is_written_through(text)) return text;
  throw UsageError("'" + text + "' does not end in .html");
}

std::vector<ViewedMap> read_maps(const ViewArguments& arguments) {
  std::vector<ViewedMap> maps;
  for (const std::string& file : arguments.maps) {
    DepthMap map = read_map_argument(file);
    require_valid(map);
    std::optional<Camera> camera = camera_of(map, file);
    maps.push_back({file, std::move(map), std::move(camera)});
  }
  return maps;
}

void write_page_to(const std::filesystem::path& path, const std::vector<ViewedMap>& maps) {
  std::ofstream file(path, std::ios::binary);
  view::write_page(maps, [&](std::string_view part) { file << part; });
  file.close();
  if (!file) throw OutputError(path.string() + ": cannot be written");
}

int run_view(const ViewArguments& arguments) {
  const std::vector<ViewedMap> maps = read_maps(arguments);
  const bool is_temporary = arguments.output.empty();
  const std::filesystem::path page =
      is_temporary ? new_page_path() : std::filesystem::path(arguments.output);
  OutputFile output(page);
  output.write([&](const auto& path) { write_page_to(path, maps); });
  output.commit();
  if (is_temporary) print(page.string() + "\n");
  if (is_temporary || arguments.open) open_in_browser(std::filesystem::absolute(page).string());
  return done;
}

}  // namespace

void add_view(Command& program) {
  const auto arguments = std::make_shared<ViewArguments>();
  Command& command = program.command(
      "view", "Show maps in a browser, with pan, zoom, values, ranges and histograms",
      "  fathom view spot.exr\n"
      "  fathom view spot.exr -o spot.html\n"
      "  fathom view exact.exr other.exr");
  command
      .arguments("MAP", arguments->maps,
                 "Maps to look at (" + names_of_readable_maps() + "); - is standard input")
      .required();
  add_output_option(command, "FILE", into(arguments->output, parse_page_name),
                    "Write the page here, an HTML file that needs no other file, and open no "
                    "browser (default: a temporary file, which a browser opens)");
  command.flag("--open", arguments->open, "Open the page in the browser also where -o is given");
  command.runs([arguments](const Console&) { return run_view(*arguments); });
}

}  // namespace fathom::app
