#include "fathom/mesh_files/gltf/gltf_buffers.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <system_error>

#include "fathom/failures/errors.h"
#include "fathom/mesh_files/read_mesh.h"
#include "fathom/text/base64.h"
#include "fathom/text/counted.h"
#include "fathom/text/text_ends.h"

namespace fathom::mesh_files {
using namespace files;
using namespace text;

namespace {

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

/// %XX stands for a byte.
std::optional<std::string> percent_decoded(const std::string& uri) {
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      path.push_back(uri[i]);
      continue;
    }
    if (i + 2 >= uri.size() || hex_digit(uri[i + 1]) < 0 || hex_digit(uri[i + 2]) < 0)
      return std::nullopt;
    path.push_back(static_cast<char>(hex_digit(uri[i + 1]) * 16 + hex_digit(uri[i + 2])));
    i += 2;
  }
  if (path.empty() || path.find('\0') != std::string::npos) return std::nullopt;
  return path;
}

/// Whether a path stays in the folder, as both are written.
bool stays_in(const std::filesystem::path& path, const std::filesystem::path& folder) {
  std::error_code error;  // no working folder: an empty path, which lies in none
  const auto written = [&](const std::filesystem::path& p) {
    return std::filesystem::absolute(p, error).lexically_normal();
  };
  const auto way = written(path).lexically_relative(written(folder / "."));
  return !way.empty() && *way.begin() != "..";
}

}  // namespace

std::filesystem::path file_of_uri(const JsonValue& uri, const std::filesystem::path& folder,
                                  bool outside_files) {
  auto name = percent_decoded(uri.string());
  if (!name || uri.string().find("://") != std::string::npos)
    uri.fail("expected a file's relative URI or a data URI");
  const auto checked = [&](const std::filesystem::path& file) {
    if (!outside_files && !stays_in(file, folder))
      uri.fail("leads out of the folder of the asset, which --outside-files allows");
    return file;
  };
  std::filesystem::path file = checked(folder / *name);
  std::error_code error;
  if (name->find('\\') == std::string::npos || std::filesystem::exists(file, error)) return file;
  std::replace(name->begin(), name->end(), '\\', '/');
  return checked(folder / *name);
}

namespace {

constexpr std::uint32_t glb_magic = 0x46546C67;   // "glTF"
constexpr std::uint32_t json_chunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t binary_chunk = 0x004E4942;

std::uint32_t word_at(Bytes file, std::size_t at) {
  std::array<unsigned char, 4> b;
  std::memcpy(b.data(), file.data() + at, 4);
  return b[0] | b[1] << 8U | b[2] << 16U | static_cast<std::uint32_t>(b[3]) << 24U;
}

std::string_view as_text(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

GltfContainer split_gltf(Bytes file, const std::string& name) {
  if (file.size() < 4 || word_at(file, 0) != glb_magic) return {as_text(file), std::nullopt};
  const auto fail = [&](std::size_t at, const std::string& what) {
    throw InputError(name + ": byte " + std::to_string(at) + ": " + what);
  };
  if (file.size() < 20) fail(file.size(), "the file ends within its header");
  if (word_at(file, 4) != 2)
    fail(4, "expected version 2 of GLB, found " + std::to_string(word_at(file, 4)));
  const std::size_t length = word_at(file, 8);
  if (length > file.size())
    fail(8, "the file is said to be " + text::counted(length, "byte") + " long, found " +
                std::to_string(file.size()));
  GltfContainer container;
  bool first = true;
  for (std::size_t at = 12; at + 8 <= length; first = false) {
    const std::size_t size = word_at(file, at);
    const std::uint32_t type = word_at(file, at + 4);
    if (size > file.size() - at - 8) fail(at, "a chunk reaches beyond the end of the file");
    const Bytes chunk = file.subspan(at + 8, size);
    if (first && type != json_chunk) fail(at + 4, "expected the first chunk to be JSON");
    if (first) container.json = text::without_zeros(as_text(chunk));
    if (type == binary_chunk && !container.binary) container.binary = chunk;
    at += 8 + size;
  }
  if (first) fail(12, "expected a JSON chunk");
  return container;
}

std::optional<std::vector<std::byte>> decode_data_uri(std::string_view uri) {
  const auto comma = uri.find(',');
  if (!uri.starts_with("data:") || comma == std::string_view::npos) return std::nullopt;
  if (!uri.substr(0, comma).ends_with(";base64")) return std::nullopt;
  return decode_base64(uri.substr(comma + 1));
}

GltfBuffers::GltfBuffers(const GltfContainer& container, const JsonValue& root,
                         const std::filesystem::path& path, const ReadOptions& options,
                         ExpansionBudget& budget)
    : binary_(container.binary),
      descriptions_(root.find("buffers")),
      folder_(folder_of_input(path)),
      outside_files_(options.outside_files),
      boundaries_(files::boundaries_of(options.confine)),
      reading_(reading_of(options)),
      budget_(budget) {
  if (!outside_files_)
    boundaries_.push_back({folder_, "the folder of the asset, which --outside-files allows"});
}

Bytes GltfBuffers::at(std::uint64_t index, const JsonValue& reference) {
  if (!descriptions_ || index >= descriptions_->size())
    reference.fail("there is no buffer " + std::to_string(index));
  const auto known = loaded_.find(index);
  if (known != loaded_.end()) return known->second;
  const Bytes bytes = load(descriptions_->element(index), index == 0);
  loaded_.emplace(index, bytes);
  return bytes;
}

Bytes GltfBuffers::load(const JsonValue& buffer, bool may_be_binary_chunk) {
  const std::uint64_t length =
      buffer.at("byteLength").integer(0, std::numeric_limits<std::uint64_t>::max());
  const auto cut = [&](Bytes bytes) {
    if (bytes.size() < length)
      buffer.fail("is said to have " + text::counted(length, "byte") + ", found " +
                  std::to_string(bytes.size()));
    return bytes.first(length);
  };
  const auto uri = buffer.find("uri");
  if (!uri) {
    if (!may_be_binary_chunk || !binary_)
      buffer.fail("the key \"uri\" is missing, and there is no binary chunk for this buffer");
    return cut(*binary_);
  }
  if (!uri->string().starts_with("data:")) return cut(load_file(*uri));
  auto decoded = decode_data_uri(uri->string());
  if (!decoded) uri->fail("expected a data URI in base64");
  storage_.push_back(*std::move(decoded));
  return cut(storage_.back());
}

Bytes GltfBuffers::load_file(const JsonValue& uri) {
  const std::filesystem::path file = file_of_uri(uri, folder_, outside_files_);
  // What went into a scene is recorded with its hash, so it must be there to be read again.
  std::error_code error;
  if (!std::filesystem::exists(file, error)) uri.fail("there is no file " + file.string());
  auto place = std::filesystem::canonical(file, error);
  if (error) place = file;
  const auto known = loaded_files_.find(place);
  if (known != loaded_files_.end()) return known->second;
  files_.push_back(std::make_unique<InputFile>(file, boundaries_, reading_));
  const Bytes bytes = files_.back()->bytes();
  external_files_.push_back({file, bytes});
  loaded_files_.emplace(place, bytes);
  budget_.add_input(bytes.size());
  return bytes;
}

void GltfBuffers::expect_unchanged() const {
  for (const auto& file : files_) file->expect_unchanged();
}

}  // namespace fathom::mesh_files
