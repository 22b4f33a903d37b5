#include "fathom/failures/errors.h"
#include "fathom/memory/huge_pages.h"
#include "fathom/mesh/mesh_faces.h"
#include "fathom/mesh_files/obj/obj_counts.h"
#include "fathom/mesh_files/obj/obj_piece.h"
#include "fathom/mesh_files/obj/obj_segments.h"
#include "fathom/mesh_files/read_mesh.h"
#include "fathom/text/counted.h"
#include "fathom/text/text_cursor.h"
#include "fathom/text/text_ends.h"

/// Read in two passes over pieces of the file, each in parallel: first count what each piece has,
/// so that the place of everything is known; then read every piece into its place.
namespace fathom::mesh_files {
using namespace mesh;
using namespace text;

namespace {

constexpr std::size_t chunk_size = std::size_t{1} << 20;

void make_room(const ObjCounts& total, const ReadOptions& options, const std::string& file,
               Mesh& mesh) {
  expect_countable(total.vertices, "vertices", file);
  expect_countable(total.textures, "texture coordinates", file);
  expect_countable(total.normals, "normals", file);
  expect_countable(total.triangles, "triangles", file);
  expect_countable(total.faces, "faces", file);
  mesh.face_count = total.faces;
  memory::resize_large(mesh.vertices, total.vertices);
  memory::resize_large(mesh.triangles, total.triangles);
  if (total.polygons) memory::resize_large(mesh.face_of_triangle, total.triangles);
  if (options.primitives) {
    expect_countable(total.segments, "segments of lines", file);
    expect_countable(total.points, "points", file);
    mesh.lines.resize(total.segments);
    mesh.points.resize(total.points);
  }
  if (!options.attributes) return;
  if (total.colours) mesh.colours.assign(total.vertices, {1, 1, 1, 1});
  memory::resize_large(mesh.texture_coordinates, total.textures);
  memory::resize_large(mesh.normals, total.normals);
  if (total.face_textures && total.textures > 0)
    memory::resize_large(mesh.texture_triangles, total.triangles);
  if (total.face_normals && total.normals > 0)
    memory::resize_large(mesh.normal_triangles, total.triangles);
  // Attributes to which no face refers are removed: without indices of their own, the indices of
  // the vertices would apply to them.
  if (!total.face_textures) mesh.texture_coordinates.clear();
  if (!total.face_normals) mesh.normals.clear();
}

/// By materials, groups and parts, where the file has any.
std::vector<TriangleSegments> segments_of(const std::vector<ObjSegmentLines>& pieces,
                                          const std::vector<ObjCounts>& before) {
  std::vector<TriangleSegments> result;
  for (const Segmentation by : {Segmentation::material, Segmentation::group, Segmentation::part}) {
    ObjSegments segments(by);
    for (std::size_t i = 0; i < pieces.size(); ++i)
      segments.add(pieces[i].lines(), before[i].triangles);
    TriangleSegments all = segments.finish(before.back().triangles);
    if (!all.names.empty()) result.push_back(std::move(all));
  }
  return result;
}

void warn(const ObjCounts& total, const ObjOddities& odd, const ReadOptions& options,
          const std::string& file, Warnings& warnings) {
  if (total.in_the_plane())
    warnings.push_back(file + ": its " +
                       text::counted(total.vertices, "vertex has two coordinates",
                                     "vertices have two coordinates") +
                       ": read with z = 0");
  odd.weights.warn(file, "vertex has a weight w other than 1",
                   "vertices have a weight w other than 1", "read as x/w, y/w, z/w", warnings);
  odd.colours.warn(file,
                   "vertex has numbers behind x, y, z that are neither a weight nor a colour of 3 "
                   "or 4 finite components",
                   "vertices have numbers behind x, y, z that are neither a weight nor a colour of "
                   "3 or 4 finite components",
                   "ignored", warnings);
  odd.textures.warn(file, "corner names a texture coordinate that is not in the file",
                    "corners name a texture coordinate that is not in the file", "they have none",
                    warnings);
  odd.normals.warn(file, "corner names a normal that is not in the file",
                   "corners name a normal that is not in the file", "they have none", warnings);
  if (options.primitives && total.skipped_lines > 0)
    warnings.push_back(file + ": " + std::to_string(total.skipped_lines) +
                       (total.skipped_lines == 1 ? " line of fewer than two corners is skipped"
                                                 : " lines of fewer than two corners are skipped"));
  if (!options.primitives && total.not_faces > 0)
    warnings.push_back(file + ": " + std::to_string(total.not_faces) +
                       " lines and points (l, p) are ignored");
  for (const auto& [keyword, count] : total.unknown)
    warnings.push_back(file + ": unknown keyword '" + keyword + "' on " + std::to_string(count) +
                       (count == 1 ? " line: ignored" : " lines: ignored"));
}

}  // namespace

Mesh read_obj(std::string_view bytes, const std::string& file, const ReadOptions& options,
              Warnings& warnings) {
  expect_no_utf16(bytes, file);
  const std::string_view text = without_padding(bytes);
  const char line_end = TextCursor::line_end_of(text);
  const std::vector<std::string_view> chunks =
      cut_into_chunks(TextCursor::without_mark(text), line_end, chunk_size);

  // before[i] counts what comes before piece i.
  std::vector<ObjCounts> before(chunks.size() + 1);
  std::vector<ObjSegmentLines> segments(options.segments ? chunks.size() : 0);
  for_each_chunk(chunks.size(), options.threads, [&](std::size_t i) {
    before[i + 1] =
        count_statements(chunks[i], file, line_end, options.segments ? &segments[i] : nullptr);
  });
  for (std::size_t i = 1; i < before.size(); ++i) {
    ObjCounts sum = before[i - 1];
    sum.add(before[i]);
    before[i] = std::move(sum);
  }
  const ObjCounts& total = before.back();

  if (total.vertices + total.faces == 0 && !total.unknown.empty())
    throw InputError(file + ": holds neither vertices nor faces, expected an OBJ file");
  Mesh mesh;
  make_room(total, options, file, mesh);
  mesh.segments = segments_of(segments, before);
  std::vector<ObjOddities> odd(chunks.size());
  for_each_chunk(chunks.size(), options.threads, [&](std::size_t i) {
    odd[i] = read_obj_piece(chunks[i], file, line_end, before[i], total, mesh);
  });
  ObjOddities all;
  for (const ObjOddities& of_piece : odd) all.add(of_piece);
  warn(total, all, options, file, warnings);
  cut_polygons(mesh, total.skipped_faces, file, warnings);
  return mesh;
}

}  // namespace fathom::mesh_files
