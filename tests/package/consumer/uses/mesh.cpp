#include <fathom/mesh/mesh.h>

bool use_mesh() {
  fathom::Mesh mesh;
  mesh.face_of_triangle = {7};
  return mesh.face_of(0) == 7;
}
