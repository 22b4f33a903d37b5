#include "tests/inputs/mesh_variants.h"

#include <cctype>
#include <cstdint>
#include <functional>

#include "fathom/failures/errors.h"
#include "fathom/mesh_files/read_mesh.h"
#include "tests/inputs/mesh_habits.h"
#include "tests/inputs/mesh_text.h"

namespace fathom::test {
namespace {

using namespace mesh_files;

using CornerText = std::function<std::string(std::uint32_t)>;

std::string obj(const Mesh& mesh, const CornerText& corner, const char* format = "%.9g") {
  std::string text;
  for (const MeshPoint& p : mesh.vertices) text += "v " + point(p, format) + "\n";
  for (const MeshPoint& p : mesh.vertices) text += "vt " + decimal(p.x) + " " + decimal(p.y) + "\n";
  for (const MeshPoint& p : mesh.vertices) text += "vn " + point(p) + "\n";
  for (const CornerIndices& t : mesh.triangles)
    text += "f " + corner(t[0]) + " " + corner(t[1]) + " " + corner(t[2]) + "\n";
  return text;
}

void add_obj(const Mesh& mesh, std::vector<MeshFile>& files) {
  const auto n = static_cast<long>(mesh.vertices.size());
  const auto one = [](std::uint32_t i) { return std::to_string(i + 1); };
  const auto negative = [n](std::uint32_t i) { return std::to_string(static_cast<long>(i) - n); };
  const std::string plain = obj(mesh, one);
  files.push_back({"plain.obj", plain});
  files.push_back({"a/b.obj", obj(mesh, [&](auto i) { return one(i) + "/" + one(i); })});
  files.push_back({"a//c.obj", obj(mesh, [&](auto i) { return one(i) + "//" + one(i); })});
  files.push_back(
      {"a/b/c.obj", obj(mesh, [&](auto i) { return one(i) + "/" + one(i) + "/" + one(i); })});
  files.push_back({"a/.obj", obj(mesh, [&](auto i) { return one(i) + "/"; })});
  files.push_back({"negative.obj", obj(mesh, negative)});
  files.push_back({"negative, a/b/c.obj", obj(mesh, [&](auto i) {
                     return negative(i) + "/" + negative(i) + "/" + one(i);
                   })});
  files.push_back({"exponents.obj", obj(mesh, one, "%+.9E")});
  files.push_back({"many digits.obj", obj(mesh, one, "%.60f")});
  files.push_back({"CR LF.obj", replaced(plain, "\n", "\r\n")});
  files.push_back({"CR.obj", replaced(plain, "\n", "\r")});
  files.push_back({"no final newline.obj", plain.substr(0, plain.size() - 1)});
  files.push_back({"byte order mark.obj", "\xEF\xBB\xBF" + plain});
  files.push_back(
      {"tabs and blanks.obj", replaced(replaced(plain, " ", " \t "), "\n", "  \n\n \n")});
  files.push_back({"comments.obj", "# v 9 9 9 \\\n" + replaced(plain, "\n", " # c\n#f 1 1 1\n")});
  files.push_back({"continued.obj", replaced(plain, " ", " \\\n")});
  files.push_back({"continued, CR LF.obj", replaced(plain, " ", "\\\r\n ")});
  files.push_back({"groups.obj", "mtllib a.mtl\no thing\n" +
                                     replaced(plain, "\nf ", "\ns off\ng a b\nusemtl m\nf ")});
  std::string faces_first, vertices;
  for (const CornerIndices& t : mesh.triangles)
    faces_first += "f " + one(t[0]) + " " + one(t[1]) + " " + one(t[2]) + "\n";
  std::string coloured;
  for (const MeshPoint& p : mesh.vertices) {
    vertices += "v " + point(p) + "\n";
    coloured += "v " + point(p) + " 0.5 0.25 1\n";
  }
  files.push_back({"forward references.obj", faces_first + vertices});
  files.push_back({"colours.obj", coloured + faces_first});
  files.push_back({"weight 1.obj", replaced(vertices, "\n", " 1.0\n") + faces_first});
}

/// How a PLY variant writes its body.
struct PlyStyle {
  std::string name, format, coordinate, index, count, list;
  bool extras = false;
};

std::string ply_header(const Mesh& mesh, const PlyStyle& style) {
  const std::string& type = style.coordinate;
  std::string text = "ply\nformat " + style.format + " 1.0\ncomment made by hand\nobj_info none\n";
  if (style.extras)
    text += "element thing 2\nproperty list uchar short numbers\nproperty uchar a\n";
  text += "element vertex " + std::to_string(mesh.vertices.size()) + "\n";
  if (style.extras)  // in another order, with others between them
    return text + "property " + type +
           " z\nproperty uchar red\nproperty list uchar int more\nproperty " + type +
           " x\nproperty double quality\nproperty " + type + " y\nelement face " +
           std::to_string(mesh.triangles.size()) + "\nproperty uchar flags\nproperty list " +
           style.count + " " + style.index + " " + style.list +
           "\nproperty list uchar float texcoord\nelement edge 1\nproperty int vertex1\nproperty "
           "int "
           "vertex2\nend_header\n";
  return text + "property " + type + " x\nproperty " + type + " y\nproperty " + type +
         " z\nelement face " + std::to_string(mesh.triangles.size()) + "\nproperty list " +
         style.count + " " + style.index + " " + style.list + "\nend_header\n";
}

std::string ply_ascii(const Mesh& mesh, const PlyStyle& style) {
  std::string text = ply_header(mesh, style);
  const bool integers = style.coordinate[0] == 's';
  const auto number = [&](double x) {
    return integers ? std::to_string(static_cast<int>(x)) : decimal(x);
  };
  if (style.extras) text += "2 -5 6 7\n0 9\n";
  for (const MeshPoint& p : mesh.vertices) {
    if (style.extras) {
      text += number(p.z) + " 255 3 1 2 3 " + number(p.x) + " nan " + number(p.y) + "\n";
    } else {
      text += number(p.x) + " " + number(p.y) + " " + number(p.z) + "\n";
    }
  }
  for (const CornerIndices& t : mesh.triangles) {
    const std::string ring =
        "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]);
    text += style.extras ? "1 " + ring + " 2 0.5 0.5\n" : ring + "\n";
  }
  return style.extras ? text + "0 1\n" : text;
}

std::string number_of_type(const std::string& type, double x, bool big) {
  if (type == "char" || type == "int8") return raw(static_cast<std::int8_t>(x), big);
  if (type == "uchar" || type == "uint8") return raw(static_cast<std::uint8_t>(x), big);
  if (type == "short" || type == "int16") return raw(static_cast<std::int16_t>(x), big);
  if (type == "ushort" || type == "uint16") return raw(static_cast<std::uint16_t>(x), big);
  if (type == "int" || type == "int32") return raw(static_cast<std::int32_t>(x), big);
  if (type == "uint" || type == "uint32") return raw(static_cast<std::uint32_t>(x), big);
  if (type == "float" || type == "float32") return raw(static_cast<float>(x), big);
  return raw(x, big);
}

std::string ply_binary(const Mesh& mesh, const PlyStyle& style) {
  const bool big = style.format == "binary_big_endian";
  std::string text = ply_header(mesh, style);
  const auto number = [&](double x) { return number_of_type(style.coordinate, x, big); };
  const auto byte = [](int x) { return std::string(1, static_cast<char>(x)); };
  if (style.extras)
    text += byte(2) + raw(std::int16_t{-5}, big) + raw(std::int16_t{6}, big) + byte(7) + byte(0) +
            byte(9);
  for (const MeshPoint& p : mesh.vertices) {
    if (style.extras) {
      text += number(p.z) + byte(255) + byte(1) + raw(std::int32_t{4}, big) + number(p.x) +
              raw(0.5, big) + number(p.y);
    } else {
      text += number(p.x) + number(p.y) + number(p.z);
    }
  }
  for (const CornerIndices& t : mesh.triangles) {
    if (style.extras) text += byte(1);
    text += number_of_type(style.count, 3, big);
    for (const std::uint32_t i : t) text += number_of_type(style.index, i, big);
    if (style.extras) text += byte(1) + raw(0.5F, big);
  }
  if (style.extras) text += raw(std::int32_t{0}, big) + raw(std::int32_t{1}, big);
  return text;
}

void add_ply(const Mesh& mesh, std::vector<MeshFile>& files) {
  for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    for (const PlyStyle& style :
         {PlyStyle{"float", format, "float", "int", "uchar", "vertex_indices"},
          PlyStyle{"double", format, "double", "uint", "uint8", "vertex_index"},
          PlyStyle{"float32", format, "float32", "int32", "int", "vertex_indices"},
          PlyStyle{"float64", format, "float64", "uint16", "ushort", "vertex_index"},
          PlyStyle{"short", format, "short", "uchar", "char", "vertex_indices"},
          PlyStyle{"int16", format, "int16", "int8", "uint32", "vertex_indices"},
          PlyStyle{"extras", format, "float", "int", "uchar", "vertex_indices", true},
          PlyStyle{"extras double", format, "double", "float", "short", "vertex_index", true}}) {
      const std::string bytes =
          format == "ascii" ? ply_ascii(mesh, style) : ply_binary(mesh, style);
      files.push_back({format + " " + style.name + ".ply", bytes});
      if (format == "ascii") {
        files.push_back({"CR LF " + style.name + ".ply", replaced(bytes, "\n", "\r\n")});
        files.push_back({"CR " + style.name + ".ply", replaced(bytes, "\n", "\r")});
        files.push_back(
            {"no final newline " + style.name + ".ply", bytes.substr(0, bytes.size() - 1)});
      } else {
        const std::size_t end = bytes.find("end_header\n") + 11;
        files.push_back({format + " CR LF header " + style.name + ".ply",
                         replaced(bytes.substr(0, end), "\n", "\r\n") + bytes.substr(end)});
      }
    }
  }
}

std::string stl_ascii(const Mesh& mesh, const std::string& indent) {
  std::string text = "solid a name\n";
  for (const auto& [a, b, c] : soup_of(mesh))
    text += indent + "facet normal 0 0 -1e-3\n" + indent + "outer loop\n" + indent + "vertex " +
            point(a) + "\n" + indent + "vertex " + point(b, "%+.9e") + "\n" + indent + "vertex " +
            point(c) + "\n" + indent + "endloop\n" + indent + "endfacet\n";
  return text + "endsolid a name\n";
}

std::string stl_binary(const Mesh& mesh, std::string header) {
  header.resize(80, header.empty() ? '\0' : ' ');
  std::string bytes = header + raw(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& triangle : soup_of(mesh)) {
    for (int i = 0; i < 3; ++i) bytes += raw(0.25F);
    for (const MeshPoint& p : triangle)
      for (const double x : {p.x, p.y, p.z}) bytes += raw(static_cast<float>(x));
    bytes += raw(std::uint16_t{7});
  }
  return bytes;
}

void add_stl(const Mesh& mesh, std::vector<MeshFile>& files) {
  const std::string plain = stl_ascii(mesh, "  ");
  files.push_back({"ascii.stl", plain});
  files.push_back({"no indent.stl", stl_ascii(mesh, "")});
  files.push_back({"CR LF.stl", replaced(plain, "\n", "\r\n")});
  files.push_back({"no final newline.stl", plain.substr(0, plain.size() - 1)});
  files.push_back({"nan normals.stl", replaced(plain, "normal 0 0 -1e-3", "normal nan -nan inf")});
  files.push_back({"two solids.stl", "solid\nendsolid\n\n" + plain});
  std::string capitals = plain;
  for (char& c : capitals) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  files.push_back({"capitals.stl", capitals});
  files.push_back({"binary.stl", stl_binary(mesh, "")});
  files.push_back({"binary, solid.stl", stl_binary(mesh, "solid facet normal 0 0 0")});
  files.push_back({"binary without suffix", stl_binary(mesh, "anything")});
}

void add_off(const Mesh& mesh, std::vector<MeshFile>& files) {
  const std::string counts =
      std::to_string(mesh.vertices.size()) + " " + std::to_string(mesh.triangles.size());
  const auto body = [&](const std::string& after_point, const std::string& after_face) {
    std::string text;
    for (const MeshPoint& p : mesh.vertices) text += point(p) + after_point + "\n";
    for (const CornerIndices& t : mesh.triangles)
      text += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " +
              std::to_string(t[2]) + after_face + "\n";
    return text;
  };
  const std::string plain = "OFF\n" + counts + " 0\n" + body("", "");
  files.push_back({"plain.off", plain});
  files.push_back({"counts behind OFF.off", "OFF " + counts + " 12\n" + body("", "")});
  files.push_back({"no edges.off", "OFF\n" + counts + "\n" + body("", "")});
  files.push_back({"no keyword.off", counts + " 0\n" + body("", "")});
  files.push_back({"comments.off", "# first\n" + replaced(plain, "\n", " # c\n#\n\n")});
  files.push_back({"CR LF.off", replaced(plain, "\n", "\r\n")});
  files.push_back({"no final newline.off", plain.substr(0, plain.size() - 1)});
  files.push_back({"face colours.off", "OFF\n" + counts + " 0\n" + body("", " 0.5 0.5 1.0 1.0")});
  files.push_back({"COFF.off", "COFF\n" + counts + " 0\n" + body(" 255 0 127 255", " 255 0 0")});
  files.push_back({"COFF, three.off", "COFF\n" + counts + " 0\n" + body(" 0.5 0.25 1.0", "")});
  files.push_back({"NOFF.off", "NOFF\n" + counts + " 0\n" + body(" 0 0 1", "")});
  files.push_back({"CNOFF.off", "CNOFF\n" + counts + " 0\n" + body(" 0 0 1 255 255 0 255", "")});
  files.push_back({"STOFF.off", "STOFF\n" + counts + " 0\n" + body(" 0.5 0.75", "")});
  files.push_back({"STCNOFF without suffix",
                   "STCNOFF\n" + counts + " 0\n" + body(" 0 0 1 9 9 9 0.5 0.75", "")});
}

}  // namespace

Mesh sample_mesh() {
  Mesh mesh;
  // Whole numbers, so that integer PLY properties hold them too.
  mesh.vertices = {{0, 0, 0}, {3, 0, -1}, {3, 2, 0}, {0, 2, 5}, {-7, 11, 13}, {100, -127, 120}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 3, 2}, {5, 5, 0}, {1, 5, 4}};
  mesh.face_count = mesh.triangles.size();
  return mesh;
}

std::vector<MeshFile> variants_of(const Mesh& mesh) {
  std::vector<MeshFile> files;
  add_obj(mesh, files);
  add_ply(mesh, files);
  add_stl(mesh, files);
  add_off(mesh, files);
  add_habits(mesh, files);
  return files;
}

Soup soup_of(const Mesh& mesh) {
  Soup soup;
  for (const CornerIndices& t : mesh.triangles)
    soup.push_back({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
  return soup;
}

Mesh read_variant(const MeshFile& file, Warnings& warnings, bool attributes) {
  const auto bytes = std::as_bytes(std::span(file.bytes));
  const auto kind = recognise_format(bytes, file.name);
  if (!kind) throw InputError(file.name + ": not recognised");
  const ReadOptions options{.format = {}, .threads = 2, .attributes = attributes, .hash = false};
  switch (*kind) {
    case FileFormat::obj:
      return read_obj(file.bytes, file.name, options, warnings);
    case FileFormat::ply:
      return read_ply(bytes, file.name, options, warnings);
    case FileFormat::stl:
      return read_stl(bytes, file.name, options, warnings);
    case FileFormat::off:
      return read_off(file.bytes, file.name, options, warnings);
    default:
      throw InputError(file.name + ": taken for another format");
  }
}

}  // namespace fathom::test
