#include "apps/bench/parts/engine_variants.h"

#include <utility>

#include "fathom/pipeline/render_pipeline.h"
#include "fathom/render.h"

namespace fathom::bench {

using pipeline::PipelineFrame;
using pipeline::PipelineOptions;
using pipeline::PipelineStatistics;

PipelineOptions plain_pipeline() {
  PipelineOptions options;
  options.shading = pipeline::Shading::none;
  return options;
}

Variant pipeline_variant(std::string name, const BenchScene& bench, const PipelineOptions& options,
                         std::function<Counts(const PipelineStatistics&)> counts) {
  const auto frame = std::make_shared<PipelineFrame>();
  const bool with_picture = options.shading != pipeline::Shading::none;
  Variant variant{.name = std::move(name)};
  variant.prepare = [frame] { *frame = {}; };
  variant.draw = [frame, &bench, options, with_picture] {
    *frame = pipeline::render_frame(bench.scene, bench.camera, options, with_picture);
  };
  variant.picture = [frame] {
    Picture picture;
    for (const StoredDepth stored : frame->stored)
      picture.push_back(static_cast<double>(stored.bits));
    for (const auto& colour : frame->picture.pixels)
      picture.insert(picture.end(), colour.begin(), colour.end());
    return picture;
  };
  variant.counts = [frame, counts = std::move(counts)] { return counts(frame->statistics); };
  return variant;
}

Variant fast_variant(std::string name, const BenchScene& bench, const RenderOptions& options,
                     std::function<Counts(const RenderStatistics&)> counts) {
  const auto drawn = std::make_shared<Rendered>();
  Variant variant{.name = std::move(name)};
  variant.prepare = [drawn] { *drawn = {}; };
  variant.draw = [drawn, &bench, options] { *drawn = render(bench.scene, bench.camera, options); };
  variant.picture = [drawn] {
    const Samples<float>& Z = *drawn->map.values<float>("Z");
    return Picture(Z.begin(), Z.end());
  };
  variant.counts = [drawn, counts = std::move(counts)] { return counts(drawn->statistics); };
  return variant;
}

std::shared_ptr<const Picture> picture_of(const Variant& variant) {
  variant.prepare();
  variant.draw();
  return std::make_shared<const Picture>(variant.picture());
}

void add_group(std::vector<Variant>& variants, std::vector<Variant> group) {
  const std::size_t plain = variants.size();
  const auto expected = picture_of(group.front());
  for (Variant& variant : group) {
    variant.plain = plain;
    variant.expected = expected;
    variants.push_back(std::move(variant));
  }
}

}  // namespace fathom::bench
