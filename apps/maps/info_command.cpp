// fathom info FILE

#include <memory>

#include "apps/commands.h"
#include "apps/maps/info.h"
#include "apps/options/map_arguments.h"
#include "apps/options/scene_options.h"
#include "apps/shell/failures.h"
#include "apps/shell/output_file.h"
#include "apps/shell/standard_streams.h"
#include "fathom/camera/camera_files.h"
#include "fathom/failures/unknown_name.h"
#include "fathom/files/input_file.h"
#include "fathom/image/deep_map.h"
#include "fathom/mesh_files/mesh_formats.h"
#include "fathom/scene/read_scene.h"

namespace fathom::app {
namespace {

struct InfoArguments {
  std::string file;
  /// Without its list of files.
  SceneOptions scene;
  bool json = false;
};

std::string info_of_meshes(const InfoArguments& arguments, const files::InputFile& input,
                           FileKind kind, AnswerForm form, const Console& console) {
  ReadOptions options = arguments.scene.read_options();
  options.hash = true;
  options.segments = true;
  options.clouds = kind == FileKind::mesh;  // the answer says that it is a point cloud
  Warnings warnings;
  Scene scene = read_scene(input.bytes(), arguments.file, options, warnings);
  input.expect_unchanged();
  console.warn(warnings);
  return info_of_scene(std::move(scene), kind, arguments.file, form);
}

/// The file is read once, so that it can be a pipe.
int run_info(const InfoArguments& arguments, const Console& console) {
  const std::string& file = arguments.file;
  const files::InputFile input(file, files::InputFile::Reading::mapped_where_large);
  const FileKind kind = arguments.scene.mesh_format ? FileKind::mesh : kind_of(input.text());
  const AnswerForm form = arguments.json ? AnswerForm::json : AnswerForm::text;
  if (kind == FileKind::camera) {
    Warnings warnings;
    const std::vector<Camera> cameras =
        read_cameras(input.text(), file, warnings, arguments.scene.limits.directions_beside(file));
    input.expect_unchanged();
    console.warn(warnings);
    print(info_of_cameras(cameras, file, form));
    return done;
  }
  if (kind == FileKind::map && is_deep_map(input.bytes())) {
    print(info_of_deep_map(read_deep_map_argument(input.bytes(), file), file, form));
    return done;
  }
  print(kind == FileKind::map ? info_of_map(read_map_argument(input.bytes(), file), file, form)
                              : info_of_meshes(arguments, input, kind, form, console));
  return done;
}

}  // namespace

void add_info(Command& program) {
  const auto arguments = std::make_shared<InfoArguments>();
  Command& command = program.command("info", "Print the contents of a mesh, scene, camera or map",
                                     "  fathom info spot.obj\n"
                                     "  fathom info spot.exr --json");
  command
      .argument("FILE", arguments->file,
                "Mesh, scene, camera, map or deep EXR; - is standard input")
      .required();
  command.option(
      "--mesh-format", "NAME", into(arguments->scene.mesh_format, parse_mesh_format),
      "Read FILE as a mesh of this format: " + joined(mesh_files::words_of_mesh_formats(), " or "));
  arguments->scene.limits.add_to(command);
  command.flag("--json", arguments->json, "Print JSON");
  command.answers_on_standard_output();
  command.runs([arguments](const Console& console) { return run_info(*arguments, console); });
}

}  // namespace fathom::app
