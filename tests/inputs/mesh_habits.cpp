#include "tests/inputs/mesh_habits.h"

#include <cctype>

#include "tests/inputs/mesh_text.h"

namespace fathom::test {
namespace {

std::string words_of(const CornerIndices& t, std::uint32_t first = 0) {
  return std::to_string(t[0] + first) + " " + std::to_string(t[1] + first) + " " +
         std::to_string(t[2] + first);
}

/// A line for each vertex, between `before` and `after`.
std::string vertex_lines(const Mesh& mesh, const std::string& before, const std::string& after) {
  std::string text;
  for (const MeshPoint& p : mesh.vertices) text += before + point(p) + after + "\n";
  return text;
}

std::string obj_faces(const Mesh& mesh) {
  std::string text;
  for (const CornerIndices& t : mesh.triangles) text += "f " + words_of(t, 1) + "\n";
  return text;
}

/// Faces with something behind the number of each corner.
std::string obj_corners(const Mesh& mesh, const std::string& behind) {
  std::string text;
  for (const CornerIndices& t : mesh.triangles) {
    text += "f";
    for (const std::uint32_t i : t) text += " " + std::to_string(i + 1) + behind;
    text += "\n";
  }
  return text;
}

void add_obj_habits(const Mesh& mesh, std::vector<MeshFile>& files) {
  const std::string vertices = vertex_lines(mesh, "v ", ""), plain = vertices + obj_faces(mesh);
  files.push_back({"zero byte at the end.obj", plain + std::string(1, '\0')});
  files.push_back({"zero bytes at the end.obj", plain + std::string(100, '\0')});
  files.push_back({"zero byte behind the last word.obj",
                   plain.substr(0, plain.size() - 1) + std::string(1, '\0')});
  files.push_back({"Control-Z at the end.obj", plain + "\x1A"});
  files.push_back({"form feeds.obj", replaced(plain, "\n", "\f\n\f")});
  files.push_back({"slashes without anything.obj", vertices + obj_corners(mesh, "//")});
  files.push_back({"usemtl without a name.obj",
                   "mtllib\n" + vertices + "usemtl\ng\no a name of words\ns\n" + obj_faces(mesh)});
  files.push_back({"groups of parts.obj", "g one two three\n" + vertices + "o (part / 2)\n" +
                                              replaced(obj_faces(mesh), "f ", "g\nf ")});
  files.push_back({"exponents of Fortran.obj", vertex_lines(mesh, "v ", "D+00") + obj_faces(mesh)});
}

std::string ply_head(const Mesh& mesh, const std::string& format, const std::string& faces) {
  return "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(mesh.vertices.size()) +
         "\nproperty float x\nproperty float y\nproperty float z\n" + faces + "end_header\n";
}

/// Each triangle as a strip of its own, in two rows: −1 begins another strip.
void add_ply_strips(const Mesh& mesh, const std::string& format, std::vector<MeshFile>& files) {
  const std::string head = ply_head(
      mesh, format,
      "element tristrips 2\nproperty uchar flags\nproperty list int int vertex_indices\nproperty "
      "short more\n");
  const bool ascii = format == "ascii", big = format == "binary_big_endian";
  std::string text = head;
  for (const MeshPoint& p : mesh.vertices) {
    if (ascii) text += point(p) + "\n";
    for (const double x : {p.x, p.y, p.z})
      if (!ascii) text += raw(static_cast<float>(x), big);
  }
  const auto row = [&](std::size_t first, std::size_t end) {
    std::vector<std::int32_t> list;
    for (std::size_t t = first; t < end; ++t) {
      if (t > first) list.push_back(-1);
      for (const std::uint32_t i : mesh.triangles[t]) list.push_back(static_cast<int>(i));
    }
    const auto count = static_cast<std::int32_t>(list.size());
    text += ascii ? "9 " + std::to_string(count) : "\t" + raw(count, big);
    for (const std::int32_t i : list) text += ascii ? " " + std::to_string(i) : raw(i, big);
    text += ascii ? " -7\n" : raw(std::int16_t{-7}, big);
  };
  row(0, 3);
  row(3, mesh.triangles.size());
  files.push_back({format + " strips.ply", text});
}

void add_ply_habits(const Mesh& mesh, std::vector<MeshFile>& files) {
  const std::string head = ply_head(
      mesh, "ascii",
      "element face " + std::to_string(mesh.triangles.size()) +
          "\nproperty uchar flags\nproperty list uchar int vertex_indices\nproperty uchar more\n");
  std::string body = vertex_lines(mesh, "", "");
  for (const CornerIndices& t : mesh.triangles) body += "1 3 " + words_of(t) + " 2\n";
  files.push_back({"all words on one line.ply", head + replaced(body, "\n", " ")});
  files.push_back({"a line for every word.ply", head + replaced(body, " ", "\n")});
  files.push_back({"rows broken after the list.ply", head + replaced(body, " 2\n", "\n\n2\n")});
  std::string uneven;
  int words = 0;
  for (const char c : replaced(body, "\n", " ")) uneven += c == ' ' && ++words % 7 == 0 ? '\n' : c;
  files.push_back({"seven words a line.ply", head + uneven});
  files.push_back({"zero byte at the end.ply", head + body + std::string(1, '\0')});
  files.push_back(
      {"comments everywhere.ply",
       replaced(head, "\nelement", "\ncomment a\nobj_info b\ncomment\nelement") + body});
  files.push_back({"byte order mark.ply", "\xEF\xBB\xBF" + head + body});
  for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"})
    add_ply_strips(mesh, format, files);
}

std::string stl_text(const Mesh& mesh) {
  std::string text = "solid\n";
  for (const auto& [a, b, c] : soup_of(mesh))
    text += "facet normal 0 0 1\nouter loop\nvertex " + point(a) + "\nvertex " + point(b) +
            "\nvertex " + point(c) + "\nendloop\nendfacet\n";
  return text + "endsolid\n";
}

void add_stl_habits(const Mesh& mesh, std::vector<MeshFile>& files) {
  const std::string plain = stl_text(mesh);
  files.push_back({"loop without outer.stl", replaced(plain, "outer loop", "loop")});
  files.push_back({"outerloop.stl", replaced(plain, "outer loop", "outerloop")});
  files.push_back({"end of two words.stl",
                   replaced(replaced(plain, "endloop", "end loop"), "endfacet", "END FACET")});
  files.push_back({"comments.stl", "# first\n; second\n// third\n" +
                                       replaced(replaced(plain, "loop\n", "loop # a loop\n"),
                                                "facet\n", "facet ; done\n// next\n")});
  files.push_back({"numbers of Windows.stl",
                   replaced(plain, "normal 0 0 1", "normal -1.#IND 1.#QNAN00 1.#INF")});
  std::string exponents = "solid\n";
  for (const auto& triangle : soup_of(mesh)) {
    exponents += "facet normal 0.0D+00 0.0d+00 1.0D+000\nouter loop\n";
    for (const MeshPoint& p : triangle)
      exponents += "vertex " + replaced(point(p, "%.6e"), "e", "D") + "\n";
    exponents += "endloop\nendfacet\n";
  }
  files.push_back({"exponents of Fortran.stl", exponents + "endsolid\n"});
  files.push_back({"exponents of three digits.stl",
                   replaced(replaced(exponents, "D+0", "e+00"), "0d", "0e") + "endsolid"});
  files.push_back({"solid without endsolid.stl",
                   "solid a\n" + replaced(plain, "endfacet\nfacet", "endfacet\nsolid b\nfacet")});
  files.push_back({"facets behind endsolid.stl",
                   replaced(plain, "endfacet\nfacet", "endfacet\nendsolid b\nfacet")});
  files.push_back({"zero byte at the end.stl", plain + std::string(1, '\0')});
}

std::string off_faces(const Mesh& mesh, const std::string& after) {
  std::string text;
  for (const CornerIndices& t : mesh.triangles) text += "3 " + words_of(t) + after + "\n";
  return text;
}

void add_off_habits(const Mesh& mesh, std::vector<MeshFile>& files) {
  const std::string vertex_count = std::to_string(mesh.vertices.size()),
                    face_count = std::to_string(mesh.triangles.size()),
                    counts = vertex_count + " " + face_count + " 0\n", head = "OFF\n" + counts;
  const std::string vertices = vertex_lines(mesh, "", ""), faces = off_faces(mesh, "");
  for (const std::string colour : {" 255 0 127", " 255 0 127 255", " 0.5 0.25 1", " 1 0 0.5 1e0"})
    files.push_back({"colours" + replaced(colour, " ", "_") + ".off",
                     head + vertex_lines(mesh, "", colour) + off_faces(mesh, colour)});
  files.push_back({"a colour number for faces.off", head + vertices + off_faces(mesh, " 7")});
  files.push_back({"faces over lines.off", head + vertices + replaced(faces, " ", "\n")});
  files.push_back({"colours, and faces over lines.off",
                   head + vertex_lines(mesh, "", " 9 9 9") + replaced(faces, "3 ", "3\n")});
  files.push_back({"vertices over lines.off", head + replaced(vertices, " ", "\n") + faces});
  files.push_back({"vertices over lines, coloured faces.off",
                   head + replaced(vertices, " ", "\n") + off_faces(mesh, " 1 0 0")});
  files.push_back({"two vertices a line.off", [&] {
                     std::string text = head;
                     bool second = false;
                     for (const char c : vertices)
                       text += c == '\n' && (second = !second) ? ' ' : c;
                     return text + faces;
                   }()});
  files.push_back(
      {"all words on one line.off", "OFF " + replaced(counts + vertices + faces, "\n", " ")});
  files.push_back({"NOFF over lines.off",
                   "N" + head + replaced(vertex_lines(mesh, "", " 0 0 1"), " ", "\n") + faces});
  files.push_back({"counts joined to OFF.off", "OFF" + counts + vertices + faces});
  files.push_back({"counts on lines of their own.off",
                   "OFF\n" + replaced(counts, " ", "\n") + vertices + faces});
  files.push_back({"small letters.off", "off\n" + counts + vertices + faces});
  files.push_back({"NCOFF.off", "NC" + head + vertex_lines(mesh, "", " 0 0 1 1 0.5 0 1") + faces});
  files.push_back({"zero byte at the end.off", head + vertices + faces + std::string(1, '\0')});
}

}  // namespace

void add_habits(const Mesh& mesh, std::vector<MeshFile>& files) {
  add_obj_habits(mesh, files);
  add_ply_habits(mesh, files);
  add_stl_habits(mesh, files);
  add_off_habits(mesh, files);
}

std::vector<WarnedMeshFile> warned_variants_of(const Mesh& mesh) {
  const std::string vertices = vertex_lines(mesh, "v ", ""), faces = obj_faces(mesh);
  const std::string normals = "vn 0 0 1\n", textures = "vt 0 1\n";
  std::vector<WarnedMeshFile> files{
      {{"no normals.obj", vertices + obj_corners(mesh, "//1")},
       "15 corners name a normal that is not in the file, the first on line 7"},
      {{"no texture coordinates.obj", vertices + obj_corners(mesh, "/3")},
       "15 corners name a texture coordinate that is not in the file, the first on line 7"},
      {{"normal 0.obj", vertices + normals + obj_corners(mesh, "//0")}, "15 corners name a normal"},
      {{"normal out of range.obj", vertices + obj_corners(mesh, "//2") + normals},
       "15 corners name a normal"},
      {{"normal below range.obj", normals + vertices + obj_corners(mesh, "//-2")},
       "15 corners name a normal"},
      {{"huge normal.obj", normals + vertices + obj_corners(mesh, "//99999999999999999999")},
       "15 corners name a normal"},
      {{"one texture coordinate out of range.obj", textures + vertices + faces + "f 1 1/2/ 1\n"},
       "1 corner names a texture coordinate that is not in the file, on line 13"},
      {{"colours of nan.obj", vertex_lines(mesh, "v ", " nan 0 1") + faces},
       "6 vertices have numbers behind x, y, z"},
      {{"colours of infinity.obj", vertex_lines(mesh, "v ", " 1 -inf 1 0.5") + faces},
       "6 vertices have numbers behind x, y, z"},
      {{"half a colour.obj", vertex_lines(mesh, "v ", " 1 0.5") + faces},
       "6 vertices have numbers behind x, y, z"},
      {{"eight numbers.obj", vertex_lines(mesh, "v ", " 0 0 1 0.5 0.25") + faces},
       "6 vertices have numbers behind x, y, z"},
      {{"endsolid missing.stl", replaced(stl_text(mesh), "endsolid\n", "")},
       "the file ends without endsolid"},
      {{"no normals.stl", replaced(stl_text(mesh), "facet normal 0 0 1", "facet")},
       "5 facets have no normal of three numbers, the first on line 2"},
      {{"half a normal.stl", replaced(stl_text(mesh), "normal 0 0 1", "normal 0 0")},
       "5 facets have no normal of three numbers"},
      {{"normals of words.stl", replaced(stl_text(mesh), "normal 0 0 1", "normal up 0 0")},
       "5 facets have no normal of three numbers"},
      {{"numbers behind points.off",
        "OFF\n6 5 0\n" + vertex_lines(mesh, "", " 1 2 3 4 5") + off_faces(mesh, "")},
       "6 vertices have numbers behind x, y, z that are no colour, the first on line 3"},
      {{"COFF without colours.off",
        "COFF\n6 5 0\n" + vertex_lines(mesh, "", "") + off_faces(mesh, "")},
       "6 vertices have numbers behind x, y, z that are no colour"},
      {{"colours of nan.off",
        "COFF\n6 5 0\n" + vertex_lines(mesh, "", " nan 0 0 1") + off_faces(mesh, "")},
       "6 vertices have numbers behind x, y, z that are no colour"},
  };
  Mesh doubled = mesh, turned = mesh;
  for (MeshPoint& p : doubled.vertices) p = {2 * p.x, 2 * p.y, 2 * p.z};
  for (MeshPoint& p : turned.vertices) p = {p.x / -4, p.y / -4, p.z / -4};
  files.push_back({{"weight 2.obj", vertex_lines(doubled, "v ", " 2") + faces},
                   "6 vertices have a weight w other than 1, the first on line 1"});
  files.push_back({{"weight -0.25.obj", vertex_lines(turned, "v ", " -0.25") + faces},
                   "6 vertices have a weight w other than 1"});
  return files;
}

}  // namespace fathom::test
