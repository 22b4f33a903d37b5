#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "fathom/files/source.h"
#include "fathom/mesh/mesh.h"
#include "fathom/mesh_files/read_options.h"

namespace fathom {

/// Consecutive triangles of a file as a mesh of their own. Its face_of_triangle has numbers of
/// faces of the file; it is empty if in the whole file triangle t is face t.
struct TriangleChunk {
  /// The number of the chunk's first triangle in the file.
  std::uint32_t first = 0;
  Mesh mesh;
};

/// The triangles of a binary STL or PLY file that need not fit into memory, in the order and with
/// the numbers and corners that read_scene() gives them, bit for bit.
///
/// The file has been read through once and checked, with the messages of the ordinary readers,
/// unless ReadOptions::check_when_opened is false. It must not change while the stream exists;
/// reading fails if a change is noticed. Memory: for an STL none that grows with the file; for a
/// PLY 4 MiB of its vertices, or all of them mapped (ReadOptions::map_large_files), and if not all
/// faces have three corners, they take 24 bytes for every 256 of the file's faces; strips take 48
/// for every 1024 corners. (If vertices have list properties: 24 bytes per vertex instead.)
///
/// Several threads may read at the same time.
class TriangleStream {
 public:
  TriangleStream() = default;
  TriangleStream(const TriangleStream&) = delete;
  TriangleStream& operator=(const TriangleStream&) = delete;
  virtual ~TriangleStream() = default;

  [[nodiscard]] virtual std::uint32_t triangle_count() const = 0;
  /// The number of faces, including skipped ones.
  [[nodiscard]] virtual std::uint64_t face_count() const = 0;

  /// Least and greatest coordinates of all corners, in the file's own frame and unit; nullopt if
  /// there is no triangle, or they are not known (ReadOptions::check_when_opened).
  struct Bounds {
    MeshPoint lower, upper;
  };
  [[nodiscard]] virtual std::optional<Bounds> bounds() const = 0;

  /// For a file that was opened without reading it (ReadOptions::check_when_opened): checks one of
  /// `parts` equal parts of the data that reading triangles does not check. False: the file does
  /// not have the layout that its size suggested, and must be opened again and read completely.
  /// Fails    InputError, as when the whole file is read.
  [[nodiscard]] virtual bool check_part(std::uint64_t /*part*/, std::uint64_t /*parts*/) const {
    return true;
  }

  /// `count` triangles from `first` on, or as many as there are.
  [[nodiscard]] virtual TriangleChunk read(std::uint32_t first, std::uint32_t count) const = 0;

  struct Triangle {
    std::array<MeshPoint, 3> corners;
    std::uint32_t face = 0;
  };
  /// One triangle, in time that does not depend on the size of the file.
  [[nodiscard]] virtual Triangle triangle(std::uint32_t number) const = 0;

  /// Only the face that a triangle comes from.
  [[nodiscard]] virtual std::uint32_t face_of(std::uint32_t number) const = 0;

  /// The label that a triangle carries (Segmentation::label), or `unsegmented`; in such time, too.
  [[nodiscard]] virtual std::uint32_t label_of(std::uint32_t /*number*/) const {
    return unsegmented;
  }

  /// The file and, if requested, its hash.
  Source source;
};

/// Opens and checks a binary STL or PLY file. Of the options, only `format`, `hash`, `segments`,
/// `check_when_opened` and `map_large_files` matter.
/// Fails    InputError, as read_scene() does, and if the file is of another format or a pipe.
std::unique_ptr<TriangleStream> open_triangle_stream(const std::filesystem::path& path,
                                                     const ReadOptions& options,
                                                     Warnings& warnings);

/// Whether a file is regular and, judged by its beginning, of a format that can be streamed; false
/// also if it cannot be read.
bool is_streamable(const std::filesystem::path& path, const ReadOptions& options);

}  // namespace fathom
