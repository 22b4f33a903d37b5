#include "apps/bench/masked_occlusion_culling/masked_buffer.h"

#include <MaskedOcclusionCulling.h>

#include <algorithm>
#include <limits>

#include "fathom/attribution/model/renderer_input.h"

namespace fathom::bench {
namespace {

using attribution::Matrix4;
using attribution::WorldMesh;

constexpr std::uint32_t rounded_up(std::uint32_t size, std::uint32_t step) {
  return (size + step - 1) / step * step;
}

/// The camera of an image that is made of whole blocks of 8×4 pixels, with more on its right and
/// below.
Camera in_blocks(Camera camera) {
  camera.width = rounded_up(camera.width, 8);
  camera.height = rounded_up(camera.height, 4);
  return camera;
}

/// clip_from_eye · eye_from_world, column by column, rounded to binary32.
std::array<float, 16> clip_from_world(const Camera& camera, const attribution::ClipRange& range) {
  const Matrix4 clip = attribution::clip_from_eye(camera, range);
  const Matrix4 eye = attribution::eye_from_world(camera);
  std::array<float, 16> product{};
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      double sum = 0;
      for (int k = 0; k < 4; ++k) sum += clip[4 * row + k] * eye[4 * k + column];
      product[4 * column + row] = static_cast<float>(sum);
    }
  }
  return product;
}

const char* name_of(MaskedOcclusionCulling::Implementation vectors) {
  switch (vectors) {
    case MaskedOcclusionCulling::AVX512:
      return "AVX-512";
    case MaskedOcclusionCulling::AVX2:
      return "AVX2";
    case MaskedOcclusionCulling::SSE41:
      return "SSE4.1";
    default:
      return "SSE2";
  }
}

}  // namespace

MaskedBuffer::MaskedBuffer(const WorldMesh& mesh, const Camera& camera, const MaskedWay& way)
    : moc_(MaskedOcclusionCulling::Create(way.widest ? MaskedOcclusionCulling::AVX512
                                                     : MaskedOcclusionCulling::AVX2),
           &MaskedOcclusionCulling::Destroy),
      width_(camera.width),
      height_(camera.height),
      triangles_(mesh.triangles.begin(), mesh.triangles.end()),
      vertices_first_(way.vertices_first) {
  const Camera padded = in_blocks(camera);
  const attribution::ClipRange range = attribution::clip_range(mesh, camera);
  clip_from_world_ = clip_from_world(padded, range);
  for (const auto& [x, y, z] : mesh.points) {
    world_.push_back({static_cast<float>(x), static_cast<float>(y), 0, static_cast<float>(z)});
  }
  if (vertices_first_) clip_.resize(world_.size());
  moc_->SetResolution(padded.width, padded.height);
  moc_->SetNearClipPlane(static_cast<float>(range.near));
  clear();
}

void MaskedBuffer::clear() {
  moc_->ClearBuffer();
}

void MaskedBuffer::draw() {
  if (triangles_.empty()) return;
  const MaskedOcclusionCulling::VertexLayout layout(16, 4, 12);
  const Vertex* vertices = world_.data();
  const float* matrix = clip_from_world_.data();
  if (vertices_first_) {
    MaskedOcclusionCulling::TransformVertices(matrix, world_.data()->data(), clip_.data()->data(),
                                              static_cast<unsigned>(world_.size()), layout);
    vertices = clip_.data();
    matrix = nullptr;
  }
  moc_->RenderTriangles(
      vertices->data(), triangles_.data()->data(), static_cast<int>(triangles_.size()), matrix,
      MaskedOcclusionCulling::BACKFACE_NONE, MaskedOcclusionCulling::CLIP_PLANE_ALL, layout);
}

std::vector<float> MaskedBuffer::depths() const {
  std::uint32_t width = 0, height = 0;
  moc_->GetResolution(width, height);
  std::vector<float> inverse(std::size_t{width} * height);
  moc_->ComputePixelDepthBuffer(inverse.data(), false);
  std::vector<float> depths;
  for (std::size_t row = 0; row < height_; ++row) {
    for (std::size_t column = 0; column < width_; ++column) {
      const float w = inverse[row * width + column];
      depths.push_back(w > 0 ? 1 / w : std::numeric_limits<float>::infinity());
    }
  }
  return depths;
}

std::string MaskedBuffer::description() const {
  return std::string("Masked Occlusion Culling, ") + name_of(moc_->GetImplementation()) +
         (vertices_first_ ? ", vertices first" : ", vertices as they are drawn");
}

}  // namespace fathom::bench
