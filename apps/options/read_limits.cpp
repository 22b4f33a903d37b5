#include "apps/options/read_limits.h"

#include <string>
#include <system_error>

#include "apps/options/formats_program.h"
#include "apps/shell/values.h"
#include "fathom/numeric/errors.h"

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
  command.flag("--outside-files", outside_files, "A glTF asset may name files outside its folder");
  command.option("--confine", "DIR", into(confine, parse_folder),
                 "Open only files in this folder or below for scene files and glTF (default: any "
                 "that they name)");
  command.option(
      "--max-expansion", "N", into(max_expansion, parse_count),
      "A mesh may take 64 MiB and N times the bytes of its files in memory (default 64); "
      "glTF and scene files that show the same data many times may need more");
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
