#include "fathom/scene/scene_json.h"

#include "fathom/files/input_file.h"
#include "fathom/scene/draw_state_json.h"
#include "fathom/text/json_value.h"

namespace fathom::scene {
using namespace files;
using namespace text;

namespace {

/// Whether this is a camera, or a list of cameras (camera_files.h).
bool looks_like_cameras(const JsonValue& root) {
  if (root.is_list()) return root.size() > 0 && looks_like_cameras(root.elements().front());
  return root.is_object() && !root.find("meshes") && root.find("width") && root.find("height");
}

}  // namespace

WorldFromMesh read_transform(const JsonValue& value) {
  WorldFromMesh result;
  const bool square = value.is_list() && value.size() == 4;
  const std::vector<JsonValue> rows = value.elements(square ? 4 : 3);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::vector<double> row = rows[i].numbers(4);
    for (std::size_t k = 0; k < 4; ++k) {
      if (i < 3) {
        result.rows[i][k] = row[k];
      } else if (row[k] != (k == 3 ? 1 : 0)) {
        rows[i].fail("expected 0 0 0 1, the last row of an affine transform");
      }
    }
  }
  return result;
}

std::vector<PlacedFile> read_scene_json(std::string_view text, const std::filesystem::path& path) {
  const JsonDocument document(text, path.string());
  const JsonValue root = document.root();
  if (looks_like_cameras(root)) {
    root.fail(
        "is a camera file, expected a mesh or a scene file; give it as the camera (--camera)");
  }
  if (!root.is_object()) root.fail("is no object, expected a scene file: {\"meshes\": […]}");
  root.expect_only({"meshes"});
  const std::filesystem::path folder = folder_of_input(path);
  std::vector<PlacedFile> result;
  for (const JsonValue& mesh : root.at("meshes").elements()) {
    mesh.expect_only({"file", "transform", "name", "draw", "material", "label"});
    PlacedFile placed;
    const std::string& file = mesh.at("file").string();
    if (file.empty() || file == "-") mesh.at("file").fail("expected the path of a mesh file");
    if (file.find('\0') != file.npos) mesh.at("file").fail("holds a NUL, expected a path");
    placed.file = folder / file;
    if (const auto name = mesh.find("name")) placed.name = name->string();
    if (const auto transform = mesh.find("transform"))
      placed.transform = read_transform(*transform);
    if (const auto draw = mesh.find("draw")) placed.draw = read_draw_state(*draw);
    if (const auto material = mesh.find("material")) placed.material = material->string();
    if (const auto label = mesh.find("label"))
      placed.label = static_cast<std::uint32_t>(label->integer(0, unsegmented - 1));
    result.push_back(std::move(placed));
  }
  return result;
}

}  // namespace fathom::scene
