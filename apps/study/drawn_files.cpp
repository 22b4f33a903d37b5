#include "apps/study/drawn_files.h"

#include <sys/mman.h>

#include <span>
#include <string>

#include "apps/study/plot.h"
#include "fathom/failures/errors.h"
#include "fathom/files/descriptor.h"
#include "fathom/files/file_bytes.h"
#include "fathom/files/input_file.h"
#include "validation/child/child_process.h"

namespace fathom::studies {
namespace {

/// A file in memory that programs started from here can open by its path. It has no name in any
/// folder, so that nothing is left behind, however this program ends.
class MemoryFile {
 public:
  MemoryFile() : file_(::memfd_create("fathom-plot", 0)) {
    if (!file_.is_open()) throw OutputError("plots: cannot make a file in memory");
  }

  [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(file_.get()); }
  [[nodiscard]] std::string content() const {
    return std::string(files::InputFile(path(), files::InputFile::Reading::copied).text());
  }

 private:
  files::Descriptor file_;
};

/// Runs gnuplot on an argument.
validation::Said run(const std::string& argument) {
  validation::Said said = validation::run_command({"gnuplot", argument});
  if (said.status == 127)
    throw OutputError("gnuplot, which draws the plots, is not there: install gnuplot-nox");
  return said;
}

std::string first_line(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \n");
  return begin == std::string::npos ? "" : text.substr(begin, text.find('\n', begin) - begin);
}

RgbImage enlarged(const RgbImage& image, std::uint32_t scale) {
  RgbImage large(image.width * scale, image.height * scale);
  for (std::uint32_t y = 0; y < large.height; ++y)
    for (std::uint32_t x = 0; x < large.width; ++x) large.at(x, y) = image.at(x / scale, y / scale);
  return large;
}

}  // namespace

void require_gnuplot(const StudyOptions& options) {
  if (options.plots) run("--version");
}

std::string png_bytes(const RgbImage& image) {
  const MemoryFile file;
  write_png(image, file.path());
  return file.content();
}

std::vector<StudyFile> run_gnuplot(const std::string& name, const std::string& script, int height) {
  const auto terminal = [&](const char* kind, const std::string& place) {
    return std::string("set terminal ") + kind + " font \"DejaVu Sans,11\" size 1100," +
           std::to_string(height) + "\nset output \"" + place + "\"\n";
  };
  const auto twice = [&](const std::string& png, const std::string& svg) {
    return terminal("pngcairo", png) + script + terminal("svg", svg) + "replot\nset output\n";
  };
  const MemoryFile input, png, svg;
  const std::string commands = twice(png.path(), svg.path());
  files::write_file(input.path(), std::as_bytes(std::span(commands)));
  const validation::Said said = run(input.path());
  std::vector<StudyFile> files{{name + ".gp", twice(name + ".png", name + ".svg")},
                               {name + ".png", png.content()},
                               {name + ".svg", svg.content()}};
  if (said.status != 0 || files[1].content.empty() || files[2].content.empty())
    throw OutputError("gnuplot cannot draw " + name + ": " + first_line(said.text));
  return files;
}

StudyFile picture_file(const std::string& name, const RgbImage& image, std::uint32_t scale) {
  return {name + ".png", png_bytes(enlarged(image, scale))};
}

}  // namespace fathom::studies
