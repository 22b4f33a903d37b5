#include <cstddef>
#include <cstdint>
#include <span>

#include "fathom/failures/errors.h"
#include "fathom/mesh_files/read_mesh.h"
#include "fathom/scene/motion.h"
#include "fathom/scene/scene_json.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fathom::mesh_files::recognise_format(std::as_bytes(std::span(data, size)), "input");
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    fathom::scene::read_scene_json(text, "input");
  } catch (const fathom::InputError&) {
  }
  try {
    fathom::read_motion(text, "input");
  } catch (const fathom::InputError&) {
  }
  return 0;
}
