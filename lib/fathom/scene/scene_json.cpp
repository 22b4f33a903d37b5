#include "fathom/scene/scene_json.h"

#include <span>
#include <string_view>
#include <utility>

#include "fathom/files/input_file.h"
#include "fathom/scene/scene.h"
#include "fathom/text/json_value.h"

namespace fathom::scene {
using namespace files;
using namespace text;

namespace {

template <class Value>
using Word = std::pair<std::string_view, Value>;

constexpr Word<Comparison> comparisons[] = {
    {"never", Comparison::never},          {"less", Comparison::less},
    {"equal", Comparison::equal},          {"lequal", Comparison::less_equal},
    {"greater", Comparison::greater},      {"notequal", Comparison::not_equal},
    {"gequal", Comparison::greater_equal}, {"always", Comparison::always}};

constexpr Word<StencilAction> actions[] = {{"keep", StencilAction::keep},
                                           {"zero", StencilAction::zero},
                                           {"replace", StencilAction::replace},
                                           {"incr", StencilAction::increment},
                                           {"incr_wrap", StencilAction::increment_wrap},
                                           {"decr", StencilAction::decrement},
                                           {"decr_wrap", StencilAction::decrement_wrap},
                                           {"invert", StencilAction::invert}};

template <class Value>
Value word_of(const JsonValue& value, std::span<const Word<Value>> words, std::string known = "") {
  const std::string& text = value.string();
  for (const auto& [word, meaning] : words) {
    if (text == word) return meaning;
    known += (known.empty() ? "" : ", ") + std::string(word);
  }
  value.fail("expected one of " + known);
}

/// Calls `take` with the member of that name, if there is one.
template <class Take>
void with(const JsonValue& object, const char* key, const Take& take) {
  if (const auto found = object.find(key)) take(*found);
}

StencilState read_stencil(const JsonValue& value) {
  value.expect_only({"test", "reference", "mask", "write_mask", "fail", "depth_fail", "pass"});
  StencilState s;
  with(value, "test", [&](const JsonValue& v) { s.test = word_of<Comparison>(v, comparisons); });
  const auto byte = [&](const char* key, std::uint8_t& into) {
    with(value, key,
         [&](const JsonValue& v) { into = static_cast<std::uint8_t>(v.integer(0, 255)); });
  };
  byte("reference", s.reference);
  byte("mask", s.mask);
  byte("write_mask", s.write_mask);
  const auto action = [&](const char* key, StencilAction& into) {
    with(value, key, [&](const JsonValue& v) { into = word_of<StencilAction>(v, actions); });
  };
  action("fail", s.fail);
  action("depth_fail", s.depth_fail);
  action("pass", s.pass);
  return s;
}

/// Reads "draw" of a scene file: {"depth_test", "depth_write", "colour_write", "polygon_offset":
/// [factor, units], "alpha", "stencil": {"test", "reference", "mask", "write_mask", "fail",
/// "depth_fail", "pass"}}, all of them optional. Comparisons and actions have OpenGL's names in
/// lower case; the depth test can also be "nearer", the default.
/// Fails    InputError, naming the key; unknown keys and words are errors.
DrawState read_draw_state(const JsonValue& value) {
  value.expect_only(
      {"depth_test", "depth_write", "colour_write", "polygon_offset", "alpha", "stencil"});
  DrawState s;
  with(value, "depth_test", [&](const JsonValue& v) {
    if (v.string() != "nearer") s.depth_test = word_of<Comparison>(v, comparisons, "nearer");
  });
  with(value, "depth_write", [&](const JsonValue& v) { s.depth_write = v.boolean(); });
  with(value, "colour_write", [&](const JsonValue& v) { s.colour_write = v.boolean(); });
  with(value, "polygon_offset", [&](const JsonValue& v) {
    const std::vector<double> numbers = v.numbers(2);
    s.polygon_offset = PolygonOffset{numbers[0], numbers[1]};
  });
  with(value, "alpha", [&](const JsonValue& v) {
    s.alpha = v.number();
    if (!(*s.alpha >= 0 && *s.alpha <= 1)) v.fail("expected an opacity from 0 to 1");
  });
  with(value, "stencil", [&](const JsonValue& v) { s.stencil = read_stencil(v); });
  return s;
}

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
    const std::string file = mesh.at("file").string();
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
