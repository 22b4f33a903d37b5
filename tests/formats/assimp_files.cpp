#include "assimp_files.h"

#include <assimp/material.h>
#include <assimp/mesh.h>
#include <assimp/scene.h>

#include <assimp/Exporter.hpp>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "binary_fbx.h"
#include "tests/apps/test_folder.h"

namespace fathom::test {
namespace {

aiMesh* to_assimp(const Polygons& polygons) {
  auto* mesh = new aiMesh;
  mesh->mNumVertices = static_cast<unsigned>(polygons.vertices.size());
  mesh->mVertices = new aiVector3D[mesh->mNumVertices];
  mesh->mNormals = new aiVector3D[mesh->mNumVertices];
  for (unsigned i = 0; i < mesh->mNumVertices; ++i) {
    const MeshPoint& p = polygons.vertices[i];
    mesh->mVertices[i] = {static_cast<float>(p.x), static_cast<float>(p.y),
                          static_cast<float>(p.z)};
    mesh->mNormals[i] = {0, 0, 1};
  }
  mesh->mNumFaces = static_cast<unsigned>(polygons.faces.size());
  mesh->mFaces = new aiFace[mesh->mNumFaces];
  for (unsigned i = 0; i < mesh->mNumFaces; ++i) {
    const std::vector<std::uint32_t>& corners = polygons.faces[i];
    mesh->mFaces[i].mNumIndices = static_cast<unsigned>(corners.size());
    mesh->mFaces[i].mIndices = new unsigned[corners.size()];
    std::copy(corners.begin(), corners.end(), mesh->mFaces[i].mIndices);
    mesh->mPrimitiveTypes |=
        corners.size() == 3 ? aiPrimitiveType_TRIANGLE : aiPrimitiveType_POLYGON;
  }
  return mesh;
}

}  // namespace

Polygons read_polygons(const std::string& obj_file) {
  Polygons polygons;
  std::ifstream file(obj_file);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string keyword;
    words >> keyword;
    if (keyword == "v") {
      float x = 0, y = 0, z = 0;
      words >> x >> y >> z;
      polygons.vertices.push_back({x, y, z});
    } else if (keyword == "f") {
      polygons.faces.emplace_back();
      for (std::string corner; words >> corner;)
        polygons.faces.back().push_back(static_cast<std::uint32_t>(std::stoul(corner)) - 1);
    }
  }
  return polygons;
}

std::string exported(const Polygons& polygons, const std::string& format) {
  if (format == "fbx") return binary_fbx(polygons);
  aiScene scene;  // which deletes what it holds
  scene.mNumMaterials = 1;
  scene.mMaterials = new aiMaterial* [1] { new aiMaterial };
  scene.mNumMeshes = 1;
  scene.mMeshes = new aiMesh* [1] { to_assimp(polygons) };
  scene.mRootNode = new aiNode("root");
  auto* node = new aiNode("thing");
  node->mNumMeshes = 1;
  node->mMeshes = new unsigned[1]{0};
  scene.mRootNode->addChildren(1, &node);
  Assimp::Exporter exporter;
  // Some exporters cannot write to memory.
  const TestFolder folder;
  if (exporter.Export(&scene, format, folder / "file") != aiReturn_SUCCESS)
    throw std::runtime_error(exporter.GetErrorString());
  return folder.read("file");
}

}  // namespace fathom::test
