#include <fathom/failures/errors.h>
#include <fathom/mesh_files/triangle_stream.h>

bool use_mesh_files() {
  fathom::Warnings warnings;
  try {
    fathom::open_triangle_stream("no such file.ply", {}, warnings);
  } catch (const fathom::InputError&) {
    return true;
  }
  return false;
}
