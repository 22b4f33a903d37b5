#include "fathom/mesh_files/gltf/gltf_decoders.h"

#include <limits>

#include "fathom/mesh_files/formats_program/process.h"
#include "fathom/mesh_files/gltf/gltf_asset.h"
#include "fathom/text/counted.h"

namespace fathom::mesh_files {
using namespace formats_program;
using namespace files;
using namespace text;

namespace {

MeshoptMode read_mode(const JsonValue& mode) {
  if (mode.string() == "ATTRIBUTES") return MeshoptMode::attributes;
  if (mode.string() == "TRIANGLES") return MeshoptMode::triangles;
  if (mode.string() == "INDICES") return MeshoptMode::indices;
  mode.fail("expected ATTRIBUTES, TRIANGLES or INDICES");
}

MeshoptFilter read_filter(const JsonValue& extension) {
  const auto filter = extension.find("filter");
  if (!filter || filter->string() == "NONE") return MeshoptFilter::none;
  if (filter->string() == "OCTAHEDRAL") return MeshoptFilter::octahedral;
  if (filter->string() == "QUATERNION") return MeshoptFilter::quaternion;
  if (filter->string() == "EXPONENTIAL") return MeshoptFilter::exponential;
  filter->fail("expected NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL");
}

/// An accessor's component type and the numbers of an element, to which Draco converts. Invalid
/// accessors are refused later, when they are opened.
DracoAttribute as_described(std::uint32_t number, const JsonValue& accessor) {
  const std::string type = accessor.at("type").string();
  const std::uint32_t width = type == "SCALAR" ? 1
                              : type.size() == 4 && type[0] == 'V'
                                  ? static_cast<std::uint32_t>(type[3] - '0')
                                  : 0;
  return {number, static_cast<std::uint32_t>(accessor.at("componentType").integer(0, 0xFFFFFFFF)),
          width};
}

void expect_count(const JsonValue& accessor, std::uint64_t decoded) {
  const std::uint64_t count = accessor.at("count").integer(0, largest_integer);
  if (count != decoded)
    accessor.fail("has " + text::counted(count, "element") + ", but Draco decoded " +
                  std::to_string(decoded));
}

}  // namespace

GltfDecoders::GltfDecoders(const ReadOptions& options, std::string file, ExpansionBudget& budget)
    : options_(options), file_(std::move(file)), budget_(budget) {}

GltfDecoders::~GltfDecoders() = default;

Bytes GltfDecoders::decode_view(const JsonValue& extension, std::uint64_t length,
                                Bytes compressed) {
  const MeshoptView view{read_mode(extension.at("mode")), read_filter(extension),
                         extension.at("count").integer(0, largest_integer),
                         extension.at("byteStride").integer(1, 256)};
  if (length % view.stride != 0 || view.count != length / view.stride)
    extension.fail("is of " + std::to_string(view.count) + " times " +
                   text::counted(view.stride, "byte") + ", expected the " + std::to_string(length) +
                   " of its bufferView");
  MessageWriter parameters;
  parameters.put(view);
  const Bytes answer =
      ask(Task::meshopt, "meshoptimizer", extension, parameters.bytes(), compressed);
  try {
    MessageReader message(answer);
    note_reader(message.get_text());
    const Bytes bytes = message.get_list<std::byte>().bytes();
    if (bytes.size() == length) return bytes;
  } catch (const BadMessage&) {
  }
  extension.fail(BadMessage().what());
}

GltfDecoders::Primitive GltfDecoders::decode_primitive(const JsonValue& extension,
                                                       const JsonValue& indices,
                                                       const std::vector<Wanted>& attributes,
                                                       Bytes compressed) {
  std::vector<DracoAttribute> wanted{as_described(0, indices)};
  for (const Wanted& attribute : attributes)
    wanted.push_back(as_described(attribute.number, attribute.accessor));
  MessageWriter parameters;
  parameters.put_list<DracoAttribute>(wanted);
  const Bytes answer = ask(Task::draco, "Draco", extension, parameters.bytes(), compressed);
  try {
    MessageReader message(answer);
    note_reader(message.get_text());
    const auto corners = message.get<std::uint64_t>(), vertices = message.get<std::uint64_t>();
    expect_count(indices, corners);
    Primitive primitive;
    primitive.corners = message.get_list<std::byte>().bytes();
    for (const Wanted& attribute : attributes) {
      expect_count(attribute.accessor, vertices);
      primitive.attributes.push_back(message.get_list<std::byte>().bytes());
    }
    return primitive;
  } catch (const BadMessage& message) {
    extension.fail(message.what());
  }
}

Bytes GltfDecoders::ask(Task task, const char* library, const JsonValue& extension,
                        const std::vector<std::byte>& parameters, Bytes compressed) {
  if (!process_) process_ = std::make_unique<Process>(options_, file_);
  try {
    answers_.push_back(process_->ask(task, parameters, compressed, budget_));
  } catch (const Refusal& refusal) {
    extension.fail(std::string(library) + " could not decode it: " + as_reason(refusal.what()));
  }
  return answers_.back();
}

void GltfDecoders::note_reader(const std::string& reader) {
  if (readers_.find(reader) != std::string::npos) return;
  readers_ += (readers_.empty() ? "" : ", ") + reader;
}

}  // namespace fathom::mesh_files
