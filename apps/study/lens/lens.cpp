#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "apps/study/cell.h"
#include "apps/study/lens/lens_maps.h"
#include "apps/study/page.h"
#include "apps/study/pipeline_scenes.h"
#include "apps/study/results.h"
#include "apps/study/study.h"
#include "apps/study/study_scene.h"
#include "fathom/camera/camera_files.h"
#include "fathom/failures/errors.h"
#include "fathom/image/map_files.h"

namespace fathom::studies {
namespace {

constexpr double strengths[] = {0.1, 0.2, 0.4, 0.6, 0.8, 1, 1.2};
/// Of the pictures, and of the tables of the page.
constexpr double shown_strength = 1;
/// Bent vertices are good enough if they are at most so many pixels off.
constexpr double good_enough = 0.01;
/// The parts of an edge that are tried at least, and the number of triangles that is never
/// exceeded for more.
constexpr int least_parts = 16;
constexpr std::uint64_t most_triangles = std::uint64_t{1} << 21;

/// A map by a method against the exact one.
struct MapRow {
  std::string lens;
  double strength;
  std::string method;
  LensErrors errors;
};

/// Bent vertices of a mesh whose edges were cut into parts.
struct MeshRow {
  std::string lens;
  double strength;
  int parts;
  std::uint64_t triangles;
  double longest_edge;
  LensErrors errors;

  [[nodiscard]] bool is_good() const { return errors.greatest && *errors.greatest <= good_enough; }
  [[nodiscard]] double greatest() const { return errors.greatest.value_or(0); }
};

/// The methods without those of bent vertices, in the order of the tables.
struct Method {
  const char* name;
  ShownMap (*map)(const LensView& view);
};

ShownMap by_fixed_point(const LensView& view, int steps) {
  return map_by_inverse(view, [steps](const auto& stage, const PlanePoint& y) {
    return std::optional(lens::invert_by_fixed_point(stage, y, steps));
  });
}

constexpr Method methods[] = {
    {"opencv-5", [](const LensView& view) { return by_fixed_point(view, lens::steps_of_opencv); }},
    {"opencv-20", [](const LensView& view) { return by_fixed_point(view, 20); }},
    {"colmap", [](const LensView& view) { return map_by_inverse(view, lens::invert_as_colmap); }},
    {"nearest", [](const LensView& view) { return map_by_lookup(view, Lookup::nearest); }},
    {"bilinear", [](const LensView& view) { return map_by_lookup(view, Lookup::bilinear); }}};

/// Of the bent vertices, the parts that the tables of maps show.
constexpr int shown_parts[] = {1, 4, 16};

std::string name_of_parts(int parts) {
  return "vertices-" + std::to_string(parts);
}

/// Finer and finer meshes, until one is good enough, or too large.
std::vector<MeshRow> refine(const LensView& view, const std::string& lens, double strength) {
  std::vector<MeshRow> rows;
  const std::uint64_t triangles = view.scene().surfaces.size();
  for (int parts = 1;; parts *= 2) {
    const std::uint64_t pieces = triangles * static_cast<std::uint64_t>(parts * parts);
    if (!rows.empty() && pieces > most_triangles) return rows;
    const BentMap map = map_by_vertices(view, bend_vertices(view, parts));
    rows.push_back({lens, strength, parts, pieces, map.longest_edge, errors_of(map.shown, view)});
    if (parts >= least_parts && rows.back().is_good()) return rows;
  }
}

struct Measured {
  std::vector<MapRow> maps;
  std::vector<MeshRow> meshes;
};

void measure(Measured& measured, const LensView& view, const std::string& lens, double strength) {
  for (const Method& method : methods)
    measured.maps.push_back({lens, strength, method.name, errors_of(method.map(view), view)});
  for (const MeshRow& row : refine(view, lens, strength)) {
    measured.meshes.push_back(row);
    if (std::ranges::find(shown_parts, row.parts) != std::end(shown_parts))
      measured.maps.push_back({lens, strength, name_of_parts(row.parts), row.errors});
  }
}

Table maps_table(const std::vector<MapRow>& rows) {
  using Row = MapRow;
  return {rows,
          {{Column("lens").page("lens"), &Row::lens},
           {Column("strength").page("strength", "g"), &Row::strength},
           {Column("method").page("method"), &Row::method},
           {"rays", [](const Row& r) { return r.errors.rays; }},
           {"surface_pixels", [](const Row& r) { return r.errors.surface_pixels; }},
           {Column("greatest_pixels", ".6g").page("greatest, pixels", ".3g"),
            [](const Row& r) { return r.errors.greatest; }},
           {Column("mean_pixels", ".6g").page("mean, pixels", ".3g"),
            [](const Row& r) { return r.errors.mean; }},
           {Column("beyond").page("beyond the lens"), [](const Row& r) { return r.errors.beyond; }},
           {Column("invented_rays").page("ray where there is none"),
            [](const Row& r) { return r.errors.invented_rays; }},
           {Column("wrong_surface").page("wrong surface"),
            [](const Row& r) { return r.errors.wrong_surface(); }},
           {"missing_surface", [](const Row& r) { return r.errors.missing; }},
           {"invented_surface", [](const Row& r) { return r.errors.invented; }},
           {Column("greatest_relative_depth_error", ".6g").page("greatest depth error", ".3g"),
            [](const Row& r) { return r.errors.greatest_depth; }}}};
}

Table meshes_table(const std::vector<MeshRow>& rows) {
  using Row = MeshRow;
  return {rows,
          {{Column("lens").page("lens"), &Row::lens},
           {Column("strength").page("strength", "g"), &Row::strength},
           {Column("parts").page("parts of an edge"), &Row::parts},
           {Column("triangles").page("triangles"), &Row::triangles},
           {Column("longest_edge", ".6g").page("longest edge, pixels", ".3g"), &Row::longest_edge},
           {Column("greatest_pixels", ".6g").page("greatest, pixels", ".2g"),
            [](const Row& r) { return r.errors.greatest; }},
           {Column("mean_pixels", ".6g"), [](const Row& r) { return r.errors.mean; }},
           {Column("wrong_surface").page("wrong surface"),
            [](const Row& r) { return r.errors.wrong_surface(); }}}};
}

/// The coarsest mesh of each lens that is good enough.
std::vector<MeshRow> coarsest_good(const std::vector<MeshRow>& rows) {
  std::vector<MeshRow> good;
  for (const MeshRow& row : rows) {
    const bool is_same =
        !good.empty() && good.back().lens == row.lens && good.back().strength == row.strength;
    if (row.is_good() && !is_same) good.push_back(row);
  }
  return good;
}

Plot errors_plot(const std::string& lens, const std::vector<MapRow>& rows) {
  Plot plot{.name = "errors-" + lens,
            .title = "The greatest error of a map through the lens " + lens + ", by strength",
            .x_label = "strength",
            .y_label = "pixels",
            .logarithmic_y = true};
  std::vector<std::string> names;
  for (const Method& method : methods) names.emplace_back(method.name);
  for (const int parts : shown_parts) names.push_back(name_of_parts(parts));
  for (const std::string& name : names) {
    const auto is_shown = [&](const MapRow& r) { return r.lens == lens && r.method == name; };
    plot.series.push_back(series_of(name, rows_where(rows, is_shown), &MapRow::strength,
                                    [](const MapRow& r) { return r.errors.greatest.value_or(0); }));
  }
  return plot;
}

Plot meshes_plot(const std::vector<MeshRow>& rows) {
  Plot plot{.name = "meshes",
            .title = "The greatest error of bent vertices, by the length of the longest edge",
            .x_label = "longest edge, pixels",
            .y_label = "greatest error, pixels",
            .logarithmic_x = true,
            .logarithmic_y = true};
  for (const char* lens : lens_names) {
    const auto is_shown = [&](const MeshRow& r) {
      return r.lens == lens && r.strength == shown_strength;
    };
    plot.series.push_back(
        series_of(lens, rows_where(rows, is_shown), &MeshRow::longest_edge, &MeshRow::greatest));
  }
  return plot;
}

/// NAME.exr, a file next to the page.
StudyFile map_file(const std::string& name, const DepthMap& map) {
  const std::vector<std::byte> bytes = encode_map(map, name + ".exr", MapFormat::exr);
  return {name + ".exr", std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size())};
}

/// NAME-CHANNEL.png, a channel of the errors of a map.
void picture_errors(Results& results, const std::string& name, const DepthMap& map,
                    const std::string& channel) {
  const std::string picture_name = name + "-" + channel;
  results.picture(picture(picture_name, map, {.channel = channel, .colours = ColourMap::magma}),
                  "fathom preview " + name + ".exr --channel " + channel + " --colormap magma -o " +
                      picture_name + ".png");
}

void add_pictures(Results& results, const LensView& view) {
  results.file({"scene.obj", obj_of(view.scene().scene)});
  results.file({"lens.json", to_json(view.camera()) + "\n"});
  const SceneView exact{view.scene().name, view.scene().scene, view.camera()};
  results.picture(picture("exact", visible_map(exact), {}),
                  "fathom render scene.obj --camera lens.json --quiet -o exact.exr && fathom "
                  "preview exact.exr -o exact.png");
  const auto add = [&](const std::string& name, const ShownMap& shown, const char* channel) {
    DepthMap map = error_map(shown, view);
    results.file(map_file(name, map));
    picture_errors(results, name, map, channel);
    return map;
  };
  const DepthMap bent =
      add(name_of_parts(1), map_by_vertices(view, bend_vertices(view, 1)).shown, "pixels");
  results.picture(picture("vertices-1", bent, {.channel = "Z"}),
                  "fathom preview vertices-1.exr --channel Z -o vertices-1.png");
  for (const Method& method : methods) {
    const std::string name = method.name;
    if (name == "opencv-5" || name == "nearest") add(name, method.map(view), "pixels");
    if (name == "bilinear") add(name, method.map(view), "depth");
  }
}

/// Figures of the page's first paragraph: of the first lens.
void quote_answers(Results& results, const Measured& measured) {
  const std::string& lens = measured.maps.front().lens;
  results.quote("lens", lens);
  for (const MapRow& row : measured.maps) {
    if (row.lens != lens || row.strength != shown_strength) continue;
    if (row.errors.greatest) results.quote("greatest " + row.method, *row.errors.greatest, ".2g");
    results.quote("wrong " + row.method, row.errors.wrong_surface());
  }
  const auto is_shown = [&](const MeshRow& r) {
    return r.lens == lens && r.strength == shown_strength;
  };
  const MeshRow last = rows_where(measured.meshes, is_shown).back();
  const auto good = rows_where(coarsest_good(measured.meshes), is_shown);
  results.quote("parts", good.empty() ? "more than " + std::to_string(last.parts)
                                      : std::to_string(good.front().parts));
}

}  // namespace

std::vector<StudyFile> study_lens(const StudyOptions& options,
                                  const std::function<void(double)>& tick) {
  if (options.near || options.far || options.separation || options.samples) {
    throw UsageError("the study lens has no --near, --far, --separation and --samples");
  }
  const SceneView view = options.scene ? *options.scene : corridor();
  const std::vector<StudiedLens> lenses = lenses_for(view.camera);
  require_gnuplot(options);
  const LensScene scene = in_camera_frame(view);
  Measured measured;
  std::size_t done = 0;
  for (const StudiedLens& lens : lenses) {
    for (const double strength : strengths) {
      measure(measured, {scene, at_strength(lens.lens, strength)}, lens.name, strength);
      if (measured.maps.front().errors.surface_pixels == 0)
        throw UsageError("the camera sees nothing of the scene");
      tick(0.95 * static_cast<double>(++done) /
           static_cast<double>(lenses.size() * std::size(strengths)));
    }
  }

  Results results("lens", page_texts::lens, options);
  results.figure("scene", view.name);
  quote_answers(results, measured);
  results.table(maps_table(measured.maps), {.csv = "maps", .json = "maps"});
  results.table(maps_table(rows_where(
                    measured.maps, [](const MapRow& r) { return r.strength == shown_strength; })),
                {.page = "maps"});
  results.table(meshes_table(measured.meshes), {.csv = "meshes", .json = "meshes"});
  results.table(meshes_table(coarsest_good(measured.meshes)), {.page = "meshes"});
  for (const char* lens : lens_names) results.plot(errors_plot(lens, measured.maps));
  results.plot(meshes_plot(measured.meshes));
  add_pictures(results, {scene, at_strength(lenses.front().lens, shown_strength)});
  tick(1);
  return results.files();
}

}  // namespace fathom::studies
