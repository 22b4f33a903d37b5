#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/files/input_file.h"
#include "fathom/mesh_files/expansion_budget.h"
#include "fathom/mesh_files/read_options.h"
#include "fathom/text/json_value.h"

/// The sources of the bytes of a glTF asset. Only for .cpp files of this module.
/// Source   [GLTF20] 3.6.1 (buffers), 4 (GLB)
namespace fathom::mesh_files {

/// The file that a relative URI names, looked for from the folder of an asset. Percent signs are
/// decoded. A backslash, which some exporters write for a slash, counts as a slash unless a file
/// has it in its name.
///
/// Unless `outside_files`, the path must stay in the folder: "../x", "%2e%2e/x" and "/etc/passwd"
/// are refused without looking at the file system. Symbolic links are not followed here; see
/// files::Boundary.
/// Fails    InputError: no relative URI, or one that leaves the folder.
/// Source   [GLTF20] 2.8 (URIs)
std::filesystem::path file_of_uri(const text::JsonValue& uri, const std::filesystem::path& folder,
                                  bool outside_files);

using Bytes = std::span<const std::byte>;

/// The two parts of an asset's file: a .gltf is all JSON, a .glb has chunks.
struct GltfContainer {
  std::string_view json;
  /// The BIN chunk.
  std::optional<Bytes> binary;
};

/// Splits a file. Bytes after the last chunk and chunks of other kinds are ignored.
/// Fails    InputError "FILE: byte N: …".
GltfContainer split_gltf(Bytes file, const std::string& name);

/// The decoded bytes of a "data:…;base64,…" URI, or nullopt if it is not one or is damaged.
std::optional<std::vector<std::byte>> decode_data_uri(std::string_view uri);

/// The buffers of an asset, each loaded at its first use.
class GltfBuffers {
 public:
  /// `container`, `root` and `budget` must outlive this. Relative URIs start from the folder of
  /// `path`, and must keep within it unless `options` say otherwise.
  GltfBuffers(const GltfContainer& container, const text::JsonValue& root,
              const std::filesystem::path& path, const ReadOptions& options,
              ExpansionBudget& budget);

  /// Buffer `index`, with exactly the length in the asset; memory is allocated only for existing
  /// bytes. Failures name `reference` if there is no such buffer.
  Bytes at(std::uint64_t index, const text::JsonValue& reference);

  struct ExternalFile {
    std::filesystem::path path;
    Bytes contents;
  };
  /// External files that have been loaded, in the order of loading, each once.
  [[nodiscard]] const std::vector<ExternalFile>& external_files() const { return external_files_; }
  /// For what has been made of their bytes. Fails    as files::InputFile::expect_unchanged().
  void expect_unchanged() const;

 private:
  Bytes load(const text::JsonValue& buffer, bool may_be_binary_chunk);
  Bytes load_file(const text::JsonValue& uri);

  std::optional<Bytes> binary_;
  std::optional<text::JsonValue> descriptions_;
  std::filesystem::path folder_;
  bool outside_files_;
  std::vector<files::Boundary> boundaries_;
  files::InputFile::Reading reading_;
  ExpansionBudget& budget_;
  std::map<std::uint64_t, Bytes> loaded_;
  /// Loaded files by their paths: many buffers may name the same file.
  std::map<std::filesystem::path, Bytes> loaded_files_;
  std::vector<std::vector<std::byte>> storage_;
  std::vector<std::unique_ptr<files::InputFile>> files_;
  std::vector<ExternalFile> external_files_;
};

}  // namespace fathom::mesh_files
