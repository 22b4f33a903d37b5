#include "compressed_assets.h"

#include <draco/compression/decode.h>
#include <draco/compression/expert_encode.h>
#include <meshoptimizer.h>

#include <stdexcept>

#include "assimp_files.h"

namespace fathom::test {
namespace {

using nlohmann::json;

constexpr int float32 = 5126, uint32 = 5125;

template <class T>
std::string bytes_of(const std::vector<T>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T)};
}

json one_primitive(json primitive) {
  return {{"asset", {{"version", "2.0"}}},
          {"meshes", {{{"primitives", {std::move(primitive)}}}}},
          {"nodes", {{{"mesh", 0}}}},
          {"scenes", {{{"nodes", {0}}}}}};
}

json data_buffer(const std::string& bytes) {
  return {{"byteLength", bytes.size()},
          {"uri", "data:application/octet-stream;base64," + checks::base64(bytes)}};
}

json accessor(std::size_t count, const char* type, int component) {
  return {{"count", count}, {"type", type}, {"componentType", component}};
}

}  // namespace

Triangulated read_triangulated(const std::string& obj_file) {
  Triangulated mesh;
  const Polygons polygons = read_polygons(obj_file);
  for (const MeshPoint& p : polygons.vertices)
    for (const double x : {p.x, p.y, p.z}) mesh.positions.push_back(static_cast<float>(x));
  for (const auto& face : polygons.faces)
    mesh.indices.insert(mesh.indices.end(), face.begin(), face.end());
  return mesh;
}

json plain_asset(const Triangulated& mesh) {
  checks::Asset asset;
  asset.positions(mesh.positions);
  asset.add(mesh.indices, "SCALAR", uint32);
  json result = asset.done();
  result.update(one_primitive({{"attributes", {{"POSITION", 0}}}, {"indices", 1}}));
  return result;
}

std::string by_draco(const Triangulated& mesh, const DracoOptions& options) {
  draco::Mesh source;
  const auto count = static_cast<std::uint32_t>(mesh.positions.size() / 3);
  source.set_num_points(count);
  draco::GeometryAttribute description;
  description.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false, 12, 0);
  const int number = source.AddAttribute(description, true, count);
  for (std::uint32_t i = 0; i < count; ++i) {
    source.attribute(number)->SetAttributeValue(draco::AttributeValueIndex(i),
                                                &mesh.positions[std::size_t{3} * i]);
  }
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    source.AddFace({draco::PointIndex(mesh.indices[i]), draco::PointIndex(mesh.indices[i + 1]),
                    draco::PointIndex(mesh.indices[i + 2])});
  }
  draco::ExpertEncoder encoder(source);
  encoder.SetEncodingMethod(options.sequential ? draco::MESH_SEQUENTIAL_ENCODING
                                               : draco::MESH_EDGEBREAKER_ENCODING);
  if (options.bits > 0) encoder.SetAttributeQuantization(number, options.bits);
  draco::EncoderBuffer buffer;
  const draco::Status status = encoder.EncodeToBuffer(&buffer);
  if (!status.ok()) throw std::runtime_error(status.error_msg_string());
  return {buffer.data(), buffer.size()};
}

Triangulated decoded_by_draco(const std::string& bytes) {
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  const std::unique_ptr<draco::Mesh> mesh = draco::Decoder().DecodeMeshFromBuffer(&buffer).value();
  const draco::PointAttribute* positions =
      mesh->GetNamedAttribute(draco::GeometryAttribute::POSITION);
  Triangulated result;
  for (draco::PointIndex i(0); i < mesh->num_points(); ++i) {
    std::array<float, 3> p{};
    positions->GetMappedValue(i, p.data());
    result.positions.insert(result.positions.end(), p.begin(), p.end());
  }
  for (draco::FaceIndex i(0); i < mesh->num_faces(); ++i)
    for (const draco::PointIndex& corner : mesh->face(i)) result.indices.push_back(corner.value());
  return result;
}

json draco_asset(const Triangulated& mesh, const std::string& compressed) {
  json asset = one_primitive(
      {{"attributes", {{"POSITION", 0}}},
       {"indices", 1},
       {"extensions",
        {{"KHR_draco_mesh_compression", {{"bufferView", 0}, {"attributes", {{"POSITION", 0}}}}}}}});
  asset["accessors"] = {accessor(mesh.positions.size() / 3, "VEC3", float32),
                        accessor(mesh.indices.size(), "SCALAR", uint32)};
  asset["bufferViews"] = json::array({{{"buffer", 0}, {"byteLength", compressed.size()}}});
  asset["buffers"] = json::array({data_buffer(compressed)});
  asset["extensionsUsed"] = {"KHR_draco_mesh_compression"};
  asset["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  return asset;
}

CompressedView attributes_by_meshopt(const std::string& elements, std::size_t stride,
                                     const std::string& filter) {
  const std::size_t count = elements.size() / stride;
  CompressedView view;
  view.bytes.resize(meshopt_encodeVertexBufferBound(count, stride));
  view.bytes.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(view.bytes.data()),
                                               view.bytes.size(), elements.data(), count, stride));
  view.extension = {{"mode", "ATTRIBUTES"}, {"count", count}, {"byteStride", stride}};
  if (!filter.empty()) view.extension["filter"] = filter;
  return view;
}

CompressedView indices_by_meshopt(const std::vector<std::uint32_t>& indices,
                                  const std::string& mode) {
  CompressedView view;
  auto* bytes = [&](std::size_t size) {
    view.bytes.resize(size);
    return reinterpret_cast<unsigned char*>(view.bytes.data());
  }(64 + 8 * indices.size());
  view.bytes.resize(
      mode == "TRIANGLES"
          ? meshopt_encodeIndexBuffer(bytes, view.bytes.size(), indices.data(), indices.size())
          : meshopt_encodeIndexSequence(bytes, view.bytes.size(), indices.data(), indices.size()));
  view.extension = {{"mode", mode}, {"count", indices.size()}, {"byteStride", 4}};
  return view;
}

std::vector<std::uint32_t> decoded_by_meshopt(const CompressedView& indices) {
  std::vector<std::uint32_t> result(indices.extension["count"].get<std::size_t>());
  const auto* bytes = reinterpret_cast<const unsigned char*>(indices.bytes.data());
  const int status =
      indices.extension["mode"] == "TRIANGLES"
          ? meshopt_decodeIndexBuffer(result.data(), result.size(), 4, bytes, indices.bytes.size())
          : meshopt_decodeIndexSequence(result.data(), result.size(), 4, bytes,
                                        indices.bytes.size());
  if (status != 0) throw std::runtime_error("meshoptimizer does not read what it wrote");
  return result;
}

FilteredElements by_filter(const std::string& filter, std::size_t stride, int bits,
                           const std::vector<float>& numbers) {
  const std::size_t width = filter == "EXPONENTIAL" ? stride / 4 : 4;
  const std::size_t count = numbers.size() / width;
  FilteredElements elements;
  elements.encoded.resize(count * stride);
  const auto apply = [&](auto encode, auto decode) {
    encode(elements.encoded.data(), count, stride, bits, numbers.data());
    elements.decoded = elements.encoded;
    decode(elements.decoded.data(), count, stride);
  };
  if (filter == "OCTAHEDRAL") apply(meshopt_encodeFilterOct, meshopt_decodeFilterOct);
  if (filter == "QUATERNION") apply(meshopt_encodeFilterQuat, meshopt_decodeFilterQuat);
  if (filter == "EXPONENTIAL") apply(meshopt_encodeFilterExp, meshopt_decodeFilterExp);
  return elements;
}

void compress_view(json& asset, std::size_t number, const CompressedView& compressed) {
  const char* const extension = "EXT_meshopt_compression";
  json& view = asset["bufferViews"][number];
  const std::size_t buffer = asset["buffers"].size();
  json described = compressed.extension;
  described.update({{"buffer", buffer}, {"byteLength", compressed.bytes.size()}});
  view.update(
      {{"buffer", buffer + 1}, {"byteOffset", 0}, {"extensions", {{extension, described}}}});
  asset["buffers"].push_back(data_buffer(compressed.bytes));
  asset["buffers"].push_back(
      {{"byteLength", view["byteLength"]}, {"extensions", {{extension, {{"fallback", true}}}}}});
  asset["extensionsUsed"].push_back(extension);
  asset["extensionsRequired"].push_back(extension);
}

json meshopt_asset(const CompressedView& positions, const CompressedView& indices,
                   const std::string& extension) {
  json asset = one_primitive({{"attributes", {{"POSITION", 0}}}, {"indices", 1}});
  asset["accessors"] = {accessor(positions.extension["count"], "VEC3", float32),
                        accessor(indices.extension["count"], "SCALAR", uint32)};
  asset["bufferViews"] = json::array();
  std::string bytes;
  std::size_t plain = 0;
  for (const CompressedView* view : {&positions, &indices}) {
    const std::size_t length = view->extension["count"].get<std::size_t>() *
                               view->extension["byteStride"].get<std::size_t>();
    json described = view->extension;
    described.update(
        {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", view->bytes.size()}});
    asset["bufferViews"].push_back({{"buffer", 1},
                                    {"byteOffset", plain},
                                    {"byteLength", length},
                                    {"extensions", {{extension, described}}}});
    asset["accessors"][asset["bufferViews"].size() - 1]["bufferView"] =
        asset["bufferViews"].size() - 1;
    bytes += view->bytes;
    plain += length;
  }
  asset["bufferViews"][0]["byteStride"] = positions.extension["byteStride"];
  asset["buffers"] = {data_buffer(bytes),
                      {{"byteLength", plain}, {"extensions", {{extension, {{"fallback", true}}}}}}};
  asset["extensionsUsed"] = {extension};
  asset["extensionsRequired"] = {extension};
  return asset;
}

}  // namespace fathom::test
