#include "fathom/mesh_files/gltf/gltf_instances.h"

#include "fathom/text/counted.h"

namespace fathom::mesh_files {
using namespace text;
using gltf::GltfPlacement;

namespace {

void expect_floats(const GltfAccessor& accessor) {
  if (accessor.width() != 3 || accessor.component() != GltfComponent::float32)
    accessor.description().fail("expected translations and scales of instances in VEC3 of floats");
}

void expect_quaternions(const GltfAccessor& accessor) {
  const bool fractions = accessor.normalized() && (accessor.component() == GltfComponent::int8 ||
                                                   accessor.component() == GltfComponent::int16);
  if (accessor.width() != 4 || !(fractions || accessor.component() == GltfComponent::float32))
    accessor.description().fail(
        "expected rotations of instances in VEC4 of floats, or of normalized bytes or shorts");
}

template <std::size_t size>
void read_parts(const GltfAccessor* accessor, std::vector<GltfPlacement>& placements,
                std::array<double, size> GltfPlacement::*part) {
  if (accessor == nullptr) return;
  accessor->for_each_finite([&](std::uint64_t i, const GltfAccessor::Element& numbers) {
    std::copy_n(numbers.begin(), size, (placements[i].*part).begin());
  });
}

}  // namespace

std::optional<GltfInstances> GltfInstances::of(const JsonValue& node, GltfAccessors& accessors) {
  const auto extensions = node.find("extensions");
  if (!extensions) return std::nullopt;
  const auto extension = extensions->find("EXT_mesh_gpu_instancing");
  if (!extension) return std::nullopt;
  const JsonValue attributes = extension->at("attributes");
  GltfInstances result;
  const auto open = [&](const char* key, auto expect) -> std::shared_ptr<const GltfAccessor> {
    const auto reference = attributes.find(key);
    if (!reference) return nullptr;
    auto accessor = accessors.at(*reference);
    expect(*accessor);
    if ((result.translation_ || result.rotation_) && accessor->count() != result.count_)
      reference->fail("has " + text::counted(accessor->count(), "element") + ", expected " +
                      std::to_string(result.count_) + " as the others have");
    result.count_ = accessor->count();
    return accessor;
  };
  result.translation_ = open("TRANSLATION", expect_floats);
  result.rotation_ = open("ROTATION", expect_quaternions);
  result.scale_ = open("SCALE", expect_floats);
  if (!result.translation_ && !result.rotation_ && !result.scale_)
    attributes.fail("expected TRANSLATION, ROTATION or SCALE");
  return result;
}

std::vector<GltfPlacement> GltfInstances::placements() const {
  std::vector<GltfPlacement> result(count_);
  read_parts(translation_.get(), result, &GltfPlacement::translation);
  read_parts(rotation_.get(), result, &GltfPlacement::rotation);
  read_parts(scale_.get(), result, &GltfPlacement::scale);
  return result;
}

}  // namespace fathom::mesh_files
