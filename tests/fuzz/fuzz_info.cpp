// `fathom info` of any file: its kind is told, and it is described, in text and in JSON, or there
// is an Error of one line. Files that it names are looked for in an empty folder only.
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/maps/info.h"
#include "fathom/camera/camera_files.h"
#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/image/map_files.h"
#include "fathom/scene/read_scene.h"
#include "tests/fuzz/file_in_memory.h"
#include "tests/fuzz/one_line.h"

namespace {

using namespace fathom;
using namespace fathom::app;

/// An empty folder of this process.
const std::filesystem::path& empty_folder() {
  static const std::filesystem::path folder = [] {
    std::string pattern = (std::filesystem::temp_directory_path() / "fathom-fuzz-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) std::abort();
    std::atexit([] { std::filesystem::remove(empty_folder()); });
    return std::filesystem::path(pattern);
  }();
  return folder;
}

std::string describe(const std::string& file, AnswerForm form) {
  const files::InputFile input(file);
  const FileKind kind = kind_of(input.text());
  if (kind == FileKind::camera)
    return info_of_cameras(read_cameras(input.text(), file), file, form);
  if (kind == FileKind::map) return info_of_map(read_map(input.bytes(), file), file, form);
  Warnings warnings;
  const Scene scene = read_scene(
      input.bytes(), file, {.threads = 1, .hash = false, .confine = empty_folder()}, warnings);
  for (const std::string& warning : warnings) fuzz::expect_one_line(warning);
  return info_of_scene(scene, kind, file, form);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::FileInMemory file(data, size);
  for (const AnswerForm form : {AnswerForm::text, AnswerForm::json}) {
    try {
      const std::string text = describe(file.path(), form);
      if (text.empty() || text.back() != '\n') std::abort();
      if (form == AnswerForm::json && !nlohmann::json::accept(text)) std::abort();
    } catch (const Error& error) {
      fuzz::expect_one_line(error.what());
    }
  }
  return 0;
}
