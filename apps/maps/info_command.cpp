// fathom info FILE

#include <memory>

#include "apps/maps/info.h"
#include "apps/maps/map_commands.h"
#include "apps/options/map_argument.h"
#include "apps/options/scene_options.h"
#include "apps/shell/exit_status.h"
#include "apps/shell/output_file.h"

namespace fathom::app {
namespace {

struct InfoArguments {
  std::string file;
  /// Without its list of files.
  SceneOptions scene;
  bool json = false;
};

std::string info_of_meshes(const InfoArguments& arguments, FileKind kind, AnswerForm form,
                           const Console& console) {
  SceneOptions options = arguments.scene;
  options.files = {arguments.file};
  const Scene scene = options.read(console, {.hash = true});
  return info_of_scene(scene, kind, arguments.file, form);
}

int run_info(const InfoArguments& arguments, const Console& console) {
  const FileKind kind = arguments.scene.mesh_format ? FileKind::mesh : kind_of(arguments.file);
  const AnswerForm form = arguments.json ? AnswerForm::json : AnswerForm::text;
  print(kind == FileKind::camera ? info_of_cameras(arguments.file, form)
        : kind == FileKind::map
            ? info_of_map(read_map_argument(arguments.file), arguments.file, form)
            : info_of_meshes(arguments, kind, form, console));
  return done;
}

}  // namespace

void add_info(Command& program) {
  const auto arguments = std::make_shared<InfoArguments>();
  Command& command = program.command("info", "Describe a mesh, scene, camera or map",
                                     "  fathom info data/meshes/spot.obj\n"
                                     "  fathom info spot.exr --json");
  command.argument("FILE", arguments->file, "A mesh, scene, camera or map").required();
  command.option("--mesh-format", "NAME", into(arguments->scene.mesh_format, parse_mesh_format),
                 "Take FILE for a mesh: obj, ply, stl, off, gltf or glb");
  arguments->scene.limits.add_to(command);
  command.flag("--json", arguments->json, "Answer in JSON");
  command.runs([arguments](const Console& console) { return run_info(*arguments, console); });
}

}  // namespace fathom::app
