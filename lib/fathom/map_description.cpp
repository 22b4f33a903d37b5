#include "fathom/map_description.h"

#include "fathom/image/depth_map.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/rendering/segment_channels.h"
#include "fathom/scene/scene_segments.h"
#include "fathom/text/json_text.h"

namespace fathom {
using namespace text;

namespace {

std::string sources_as_json(const std::vector<Source>& sources) {
  std::vector<std::string> list;
  for (const Source& source : sources) {
    std::vector<std::string> members{"\"file\":" + json_string(source.path)};
    if (!source.reader.empty()) members.push_back("\"reader\":" + json_string(source.reader));
    members.push_back("\"sha256\":" + json_string(source.sha256));
    list.push_back(joined_in('{', members, '}'));
  }
  return joined_in('[', list, ']');
}

/// The names that the numbers of its channels stand for.
void add_tables(const Scene& scene, DepthMap& map) {
  std::vector<Segmentation> wanted;
  for (const Segmentation by : all_segmentations)
    if (map.find(std::string(description_of(channel_of(by)).name))) wanted.push_back(by);
  if (wanted.empty()) return;
  const SceneSegments segments(scene, wanted);
  for (const Segmentation by : wanted)
    if (!segments.names(by).empty())
      map.tables[std::string(description_of(channel_of(by)).name)] = segments.names(by);
}

}  // namespace

void describe_map(const Scene& scene, const Camera& camera, std::string_view engine,
                  DepthMap& map) {
  const StandardArithmetic standard;
  map.camera = camera;
  for (const Object& object : scene.objects) map.object_names.push_back(object.name);
  add_tables(scene, map);
  map.texts[sources_text] = sources_as_json(scene.sources);
  map.texts[engine_text] = engine;
}

}  // namespace fathom
