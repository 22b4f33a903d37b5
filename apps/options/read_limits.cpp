#include "apps/options/read_limits.h"

#include <string>
#include <system_error>

#include "apps/options/formats_program.h"
#include "apps/shell/values.h"
#include "fathom/failures/errors.h"

namespace fathom::app {
namespace {

std::filesystem::path parse_folder(const std::string& text) {
  std::error_code error;
  if (!std::filesystem::is_directory(text, error)) {
    throw UsageError("'" + text + "' is no folder");
  }
  return text;
}

}  // namespace

void ReadLimits::add_to(Command& command) {
  command.flag("--outside-files", outside_files,
               "Allow glTF assets to name files outside their folder");
  command.option(
      "--confine", "DIR", into(confine, parse_folder),
      "Allow scene files and glTF to open files only below this folder (default: anywhere)");
  command.option("--max-expansion", "N", into(max_expansion, parse_count),
                 "Limit a mesh in memory to 64 MiB plus N times the bytes of its files (default "
                 "64); raise it for glTF and scene files that reuse the same data many times");
}

ReadOptions ReadLimits::read_options() const {
  ReadOptions options;
  options.outside_files = outside_files;
  options.confine = confine;
  options.max_expansion = max_expansion;
  options.formats_program = formats_program;
  options.map_large_files = true;  // shell/signals.h handles SIGBUS
  return options;
}

}  // namespace fathom::app
