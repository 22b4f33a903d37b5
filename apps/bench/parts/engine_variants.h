#pragma once

#include "apps/bench/parts/ideas.h"
#include "fathom/pipeline/options.h"
#include "fathom/rendering/options.h"
#include "fathom/rendering/rendered.h"
#include "validation/scenes/scenes.h"

/// Variants that draw with the pipeline and the fast engine; the picture of the latter is channel
/// Z.
namespace fathom::bench {

/// The options of the pipeline's variants: without shading, so that no picture is made.
pipeline::PipelineOptions plain_pipeline();
/// The pipeline by `options`; counts: what it counted. The picture is what the depth buffer holds
/// in the end and, with shading, the colours. (Surfaces that are equally near to the depth buffer
/// need not be so to channel Z, and then their order shows in it.)
Variant pipeline_variant(std::string name, const BenchScene& bench,
                         const pipeline::PipelineOptions& options,
                         std::function<Counts(const pipeline::PipelineStatistics&)> counts);
/// The fast engine, channel Z.
Variant fast_variant(std::string name, const BenchScene& bench, const RenderOptions& options,
                     std::function<Counts(const RenderStatistics&)> counts);

/// Draws once; what a variant draws is what those compared with it have to draw.
std::shared_ptr<const Picture> picture_of(const Variant& variant);

/// Appends a plain variant and those that are compared with it, all of which have to draw the same.
void add_group(std::vector<Variant>& variants, std::vector<Variant> group);

}  // namespace fathom::bench
