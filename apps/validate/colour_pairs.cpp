#include "apps/validate/colour_pairs.h"

#include "fathom/pipeline/render_pipeline.h"

namespace fathom::app {

using pipeline::Material;
using pipeline::SpecularModel;
using validation::GreyPicture;

Material material_of(const ColourPair& pair) {
  if (pair.glossy)
    return {.ambient = 0.15,
            .diffuse = 0.6,
            .specular = 0.25,
            .shininess = 40,
            .highlight = SpecularModel::phong};
  return {.ambient = 0.15,
          .diffuse = 0.75,
          .specular = 0,
          .shininess = 1,
          .highlight = SpecularModel::phong};
}

GreyPicture drawn_by_pipeline(const validation::LitScene& scene, pipeline::Shading shading) {
  pipeline::PipelineOptions options;
  options.precision = pipeline::Precision::binary64;
  options.shading = shading;
  options.material = scene.material;
  options.light = {.towards = scene.towards_light, .in_world = true};
  const auto frame = render_frame(as_scene(scene), scene.camera, options, true);
  GreyPicture picture{scene.camera.width, scene.camera.height, {}, "pipeline"};
  for (const Rgb& c : to_rgb(frame.picture).pixels) picture.codes.push_back(c[0]);
  return picture;
}

}  // namespace fathom::app
