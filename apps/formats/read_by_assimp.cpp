#include <assimp/config.h>
#include <assimp/scene.h>
#include <assimp/version.h>

#include <assimp/Importer.hpp>
#include <new>
#include <stdexcept>
#include <string>

#include "apps/formats/one_file.h"
#include "apps/formats/tasks.h"

namespace fathom::app {
namespace {

using namespace mesh_files::formats_program;

/// Geometry as the file has it, and nothing else.
void ask_for_geometry(Assimp::Importer& importer) {
  for (const char* const unwanted :
       {AI_CONFIG_IMPORT_FBX_READ_TEXTURES, AI_CONFIG_IMPORT_FBX_READ_CAMERAS,
        AI_CONFIG_IMPORT_FBX_READ_LIGHTS, AI_CONFIG_IMPORT_FBX_READ_ANIMATIONS,
        AI_CONFIG_IMPORT_FBX_READ_WEIGHTS, AI_CONFIG_IMPORT_MDL_HL1_READ_ANIMATIONS,
        AI_CONFIG_IMPORT_MDL_HL1_READ_ANIMATION_EVENTS, AI_CONFIG_IMPORT_SMD_LOAD_ANIMATION_LIST,
        AI_CONFIG_IMPORT_MD3_LOAD_SHADERS,
        // Other files.
        AI_CONFIG_IMPORT_MD3_HANDLE_MULTIPART,
        // It would split meshes by their materials, and number their faces in another order.
        AI_CONFIG_IMPORT_FBX_READ_MATERIALS, AI_CONFIG_IMPORT_AC_SEPARATE_BFCULL,
        // It would move vertices.
        AI_CONFIG_IMPORT_AC_EVAL_SUBDIVISION})
    importer.SetPropertyBool(unwanted, false);
  for (const char* const wanted :
       {AI_CONFIG_IMPORT_MD5_NO_ANIM_AUTOLOAD, AI_CONFIG_IMPORT_NO_SKELETON_MESHES,
        AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES})
    importer.SetPropertyBool(wanted, true);
}

template <class T, class Numbers>
void put_numbers(const T* values, std::size_t count, const Numbers& numbers_of,
                 MessageWriter& message) {
  std::vector<float> numbers;
  for (std::size_t i = 0; values != nullptr && i < count; ++i) {
    for (const float number : numbers_of(values[i])) numbers.push_back(number);
  }
  message.put_list<float>(numbers);
}

void put_mesh(const aiMesh& mesh, MessageWriter& message) {
  const auto xyz = [](const aiVector3D& v) { return std::array{v.x, v.y, v.z}; };
  const auto xy = [](const aiVector3D& v) { return std::array{v.x, v.y}; };
  const auto rgba = [](const aiColor4D& c) { return std::array{c.r, c.g, c.b, c.a}; };
  const std::size_t count = mesh.mNumVertices;
  put_numbers(mesh.mVertices, count, xyz, message);
  put_numbers(mesh.mTextureCoords[0], count, xy, message);
  put_numbers(mesh.mNormals, count, xyz, message);
  put_numbers(mesh.mColors[0], count, rgba, message);
  std::vector<std::uint32_t> sizes, corners;
  for (const aiFace& face : std::span(mesh.mFaces, mesh.mNumFaces)) {
    sizes.push_back(face.mNumIndices);
    corners.insert(corners.end(), face.mIndices, face.mIndices + face.mNumIndices);
  }
  message.put_list<std::uint32_t>(sizes);
  message.put_list<std::uint32_t>(corners);
}

/// assimp catches what is thrown in it, and keeps the text.
[[noreturn]] void fail(const std::string& why) {
  if (why.find("bad_alloc") != std::string::npos) throw std::bad_alloc();
  throw std::runtime_error(why);
}

/// A node whose turn has not come.
struct Waiting {
  const aiNode* node;
  std::uint32_t depth;
};

void put_node(const Waiting& waiting, const aiScene& scene, MessageWriter& message) {
  const aiNode& node = *waiting.node;
  const std::span<const unsigned> meshes(node.mMeshes, node.mNumMeshes);
  std::string name = node.mName.C_Str();
  if (name.empty() && !meshes.empty()) name = scene.mMeshes[meshes[0]]->mName.C_Str();
  message.put(waiting.depth);
  message.put_text(name);
  const aiMatrix4x4& m = node.mTransformation;
  message.put(std::array{m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4,  //
                         m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4});
  message.put_list<std::uint32_t>(meshes);
}

/// Depth first.
void put_nodes(const aiScene& scene, MessageWriter& message) {
  std::vector<Waiting> nodes{{scene.mRootNode, 0}};
  MessageWriter list;
  std::uint64_t count = 0;
  while (!nodes.empty()) {
    const Waiting next = nodes.back();
    nodes.pop_back();
    put_node(next, scene, list);
    ++count;
    for (unsigned i = next.node->mNumChildren; i-- > 0;)
      nodes.push_back({next.node->mChildren[i], next.depth + 1});
  }
  message.put(count);
  message.append(list);
}

}  // namespace

std::string assimp_version() {
  return "assimp " + std::to_string(aiGetVersionMajor()) + "." +
         std::to_string(aiGetVersionMinor()) + "." + std::to_string(aiGetVersionPatch());
}

std::vector<std::byte> read_by_assimp(std::span<const std::byte> parameters,
                                      std::span<const std::byte> bytes) {
  const std::string name = MessageReader(parameters).get_text();
  Assimp::Importer importer;
  ask_for_geometry(importer);
  importer.SetIOHandler(new OneFile(name, bytes));  // which the importer deletes
  const aiScene* scene = importer.ReadFile(name, 0);
  if (scene == nullptr) fail(importer.GetErrorString());
  if (scene->mRootNode == nullptr) throw std::runtime_error("there is no node");
  MessageWriter message;
  message.put_text(assimp_version());
  message.put(std::uint64_t{scene->mNumMeshes});
  for (const aiMesh* mesh : std::span(scene->mMeshes, scene->mNumMeshes)) put_mesh(*mesh, message);
  put_nodes(*scene, message);
  return message.bytes();
}

}  // namespace fathom::app
