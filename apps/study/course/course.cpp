#include <algorithm>
#include <sstream>

#include "apps/study/antialiasing/sampling.h"
#include "apps/study/course/demo.h"
#include "apps/study/course/demonstrations.h"
#include "apps/study/course/exercises.h"
#include "apps/study/course/gallery.h"
#include "apps/study/course/orientation.h"
#include "apps/study/course/shared_edges.h"
#include "apps/study/page.h"
#include "apps/study/plot.h"
#include "apps/study/results.h"
#include "apps/study/study.h"
#include "fathom/failures/errors.h"

namespace fathom::studies {
namespace {

/// NAME.png, each of its pixels `scale` wide in the page.
void show(Results& results, const std::string& name, const RgbImage& image, std::uint32_t scale) {
  results.picture(picture_file(name, image), image.width * scale);
}

/// What the commands under the pictures read.
void add(Results& results, const SceneFiles& files) {
  for (const StudyFile& file : files.files) results.file(file);
}

/// An edge function of exercise 2, with numbers at 4 × 4 pixels.
HeatMap edge_values_plot(const std::string& edge, const std::vector<double>& values) {
  HeatMap map{.name = "exercise-2-" + edge,
              .title = "e_" + edge + " at the centres of the pixels",
              .x_label = "x (pixels)",
              .y_label = "y (pixels)",
              .value_label = "e_" + edge + ", positive inside",
              .x = {},
              .y = {},
              .values = values,
              .by_sign = true,
              .as_image = true,
              .cells_per_number = 64};
  for (int i = 0; i < 256; ++i) map.x.push_back(i);
  map.y = map.x;
  return map;
}

void exercises_1_and_2(Results& results) {
  add(results, eight_lines_files());
  show(results, "exercise-1", eight_lines(pipeline::WireLine::bresenham), 6);
  show(results, "exercise-2", edge_function_signs(), 2);
  constexpr const char* edges[] = {"BC", "CA", "AB"};
  const auto values = edge_function_values();
  for (std::size_t k = 0; k < 3; ++k) results.plot(edge_values_plot(edges[k], values[k]));
}

void quadrangles(Results& results) {
  using Row = TurnedSquare;
  const std::vector<Row> rows = turned_squares();
  for (const StudyFile& file : square_files()) results.file(file);
  for (const Row& row : rows) {
    show(results, "square-" + std::to_string(row.degrees), row.square_picture, 4);
    show(results, "triangles-" + std::to_string(row.degrees), row.triangles_picture, 4);
  }
  results.table(
      {rows,
       {{Column("degrees").page("turned by (degrees)"), &Row::degrees},
        {Column("square").page("square, by scan lines"), &Row::square},
        {Column("triangles_by_scan_lines").page("triangles, by scan lines"), &Row::by_scan_lines},
        {Column("triangles_by_weights").page("triangles, barycentric"), &Row::by_weights}}},
      {.json = "quadrangles", .page = "quadrangles"});
}

const char* name_of(pipeline::Precision precision) {
  return precision == pipeline::Precision::binary32 ? "binary32" : "binary64";
}

void exercise_3(Results& results) {
  using pipeline::Precision;
  struct Row {
    double distance;
    Storage storage;
    Precision precision;
    double wrong_share;
  };
  struct PageRow {
    double distance;
    std::vector<double> wrong_shares;
  };
  struct Buffer {
    Storage storage;
    Precision precision;
  };
  constexpr Buffer buffers[] = {{Storage::unorm16, Precision::binary32},
                                {Storage::unorm32, Precision::binary32},
                                {Storage::float32, Precision::binary32},
                                {Storage::unorm32, Precision::binary64},
                                {Storage::float32, Precision::binary64}};
  std::vector<Row> rows;
  std::vector<PageRow> page_rows;
  for (const double distance : {0.5, 2.0, 10.0, 50.0}) {
    page_rows.push_back({distance, {}});
    for (const auto& [storage, precision] : buffers) {
      const Fight f = fight(distance, storage, precision);
      rows.push_back({distance, storage, precision, f.wrong_share});
      page_rows.back().wrong_shares.push_back(f.wrong_share);
      if (distance == 10 && storage == Storage::unorm32)
        results.quote(std::string("wrong ") + name_of(precision), 100 * f.wrong_share, ".1f");
      if ((distance != 2.0 && distance != 10.0) || precision != Precision::binary32) continue;
      if (storage == Storage::unorm16) add(results, fight_files(distance));
      show(results, "exercise-3-" + text_of(distance) + "-" + std::string(name_of(storage)),
           f.picture, 2);
    }
  }
  results.quote("tilt", tilt_of_fight(), ".1f");
  results.quote("window_steps", steps_of_unorm16(), ".2f");
  results.table({rows,
                 {{"distance", &Row::distance},
                  {"storage", [](const Row& r) { return name_of(r.storage); }},
                  {"precision", [](const Row& r) { return name_of(r.precision); }},
                  {"wrong_share", &Row::wrong_share}}},
                {.json = "exercise_3"});
  std::vector<ColumnOf<PageRow>> columns{{heading("distance"), &PageRow::distance}};
  for (std::size_t k = 0; k < std::size(buffers); ++k) {
    const auto& [storage, precision] = buffers[k];
    columns.push_back(
        {percent_heading(std::string(name_of(storage)) + ", " + name_of(precision), ".1f"),
         [k](const PageRow& r) { return r.wrong_shares[k]; }});
  }
  results.table({page_rows, columns}, {.page = "exercise_3"});
}

void exercise_4(Results& results) {
  struct Row {
    const char* interpolation;
    Checkerboard board;
  };
  add(results, checkerboard_files());
  const std::vector<Row> rows{{"affine", checkerboard(pipeline::Interpolation::affine)},
                              {"perspective", checkerboard(pipeline::Interpolation::perspective)}};
  for (const Row& row : rows) {
    show(results, std::string("exercise-4-") + row.interpolation, row.board.picture, 2);
  }
  results.table({rows,
                 {{Column("interpolation").page("interpolation"), &Row::interpolation},
                  {Column("mean_error").page("mean error", ".3g"),
                   [](const Row& r) { return r.board.mean_error; }},
                  {Column("greatest_error").page("greatest error", ".3g"),
                   [](const Row& r) { return r.board.greatest_error; }}}},
                {.json = "exercise_4", .page = "exercise_4"});
}

void exercise_5(Results& results) {
  using enum pipeline::Shading;
  for (const GalleryMesh& mesh : gallery_meshes()) {
    results.file(mesh.file);
    const std::string& name = mesh.view.name;
    const auto show_as = [&](const char* shading, const RgbImage& image) {
      show(results, name + "-" + shading, image, 1);
    };
    show_as("points", shaded(mesh, points));
    show_as("wireframe", shaded(mesh, wireframe));
    show_as("flat", shaded(mesh, flat));
    show_as("gouraud", shaded(mesh, gouraud));
    show_as("phong", shaded(mesh, phong));
    if (mesh.has_texture_coordinates) show_as("textured", shaded(mesh, phong, "checker"));
  }
}

void exercise_6(Results& results) {
  const PartialPixels partial = partial_pixels();
  add(results, half_plane_files());
  for (std::size_t i = 0; i < 4; ++i)
    show(results, "exercise-6-" + std::to_string(1 << i), partial.pictures[i], 3);
  show(results, "exercise-6-exact", partial.exact_picture, 3);
  Table table(std::vector<std::size_t>{0, 1, 2, 3},
              {{Column("samples").page("samples"), [](std::size_t i) { return 1 << i; }},
               {Column("partial").page("partly covered pixels"),
                [&](std::size_t i) { return partial.counted[i]; }},
               {Column("mean_error").page("mean error of coverage", ".4f"),
                [&](std::size_t i) { return partial.mean_error[i]; }}});
  results.table(table, {.json = "exercise_6"});
  results.figure("exercise_6_exact", partial.exact);
  table.add({"exact area", partial.exact, 0});
  results.table(table, {.page = "exercise_6"});
}

void edge_on(Results& results) {
  using Row = EdgeOnCount;
  add(results, edge_on_files());
  const std::vector<Row> rows = count_edge_on();
  results.quote("edge_on_triangles", rows.front().triangles);
  results.quote("edge_on_front", rows.front().front);
  results.table(
      {rows,
       {{Column("precision").page("arithmetic"), [](const Row& r) { return name_of(r.precision); }},
        {"triangles", &Row::triangles},
        {"front", &Row::front},
        {Column("front_in_world").page("front: world"), &Row::front_in_world},
        {Column("front_in_ndc").page("front: NDC"), &Row::front_in_ndc},
        {Column("front_in_window").page("front: window"), &Row::front_in_window},
        {Column("wrong_in_world").page("wrong: world"), &Row::wrong_in_world},
        {Column("wrong_in_ndc").page("wrong: NDC"), &Row::wrong_in_ndc},
        {Column("wrong_in_window").page("wrong: window"), &Row::wrong_in_window},
        {Column("disagreeing").page("the tests disagree"), &Row::disagreeing},
        {Column("turned_by_snapping").page("turned by snapping"), &Row::turned_by_snapping}}},
      {.json = "edge_on", .page = "edge_on"});
}

void back_faces(Results& results) {
  using Row = FacingCount;
  const auto culled_share = [](const Row& f) {
    return 1 - static_cast<double>(f.front_in_window) / static_cast<double>(f.triangles);
  };
  const std::vector<FacingCount> counts = count_facings();
  results.quote("ball_triangles", counts.front().triangles);
  results.table(
      {counts,
       {{Column("precision").page("arithmetic"), [](const Row& f) { return name_of(f.precision); }},
        {Column("distance").page("distance"), &Row::distance},
        {"triangles", &Row::triangles},
        {percent_heading("culled", ".2f"), culled_share},
        {percent_heading("unseen surface", ".2f"), [](const Row& f) { return 1 - f.seen_share; }},
        {Column("front_in_world").page("front: world"), &Row::front_in_world},
        {Column("front_in_ndc").page("front: NDC"), &Row::front_in_ndc},
        {Column("front_in_window").page("front: window"), &Row::front_in_window},
        {Column("disagreeing").page("the tests disagree"), &Row::disagreeing}}},
      {.json = "facings", .page = "facings"});
  edge_on(results);
  using enum pipeline::FrontFace;
  using pipeline::Culling;
  add(results, open_box_files());
  const auto show_box = [&](const char* name, pipeline::FrontFace front, Culling culling) {
    show(results, name, open_box(front, culling), 1);
  };
  show_box("box-ccw-back", counter_clockwise, Culling::back);
  show_box("box-ccw-front", counter_clockwise, Culling::front);
  show_box("box-cw-back", clockwise, Culling::back);
  show_box("box-cw-front", clockwise, Culling::front);
  show_box("box-none", counter_clockwise, Culling::none);
}

void shared_edges(Results& results) {
  using Row = SharedEdges;
  std::vector<Row> rows;
  for (const int bits : {0, 1, 2, 3, 4, 6, 8, 16}) {
    rows.push_back(count_shared_edges(bits));
    if (bits == 0 || bits == 2 || bits == 8) {
      add(results, shared_edges_files(bits));
      show(results, "shared-edges-" + std::to_string(bits), shared_edges_picture(bits), 2);
    }
  }
  results.table(
      {rows,
       {{Column("subpixel_bits").page("bits"), &Row::bits},
        {"triangles", &Row::triangles},
        {Column("turned_over").page("turned over"), &Row::turned_over},
        {Column("without_area").page("without area"), &Row::without_area},
        {"samples", &Row::samples},
        {Column("signed_not_one").page("samples not covered once, signed"), &Row::signed_not_one},
        {Column("unsigned_not_one").page("not once, unsigned"), &Row::unsigned_not_one},
        {Column("unexplained").page("of these unexplained"), &Row::unexplained}}},
      {.json = "shared_edges", .page = "shared_edges"});
}

void demo_of_section_6(Results& results) {
  struct Row {
    const char* what;
    std::uint64_t count;
  };
  const Demo d = demo();
  add(results, demo_files());
  show(results, "demo", d.picture, 2);
  results.quote("on_far_edges", d.far_closed - d.far_fragments);
  results.quote("on_near_edges", d.near_closed - d.near_fragments);
  const std::vector<Row> rows{
      {"fragments of the near triangle", d.near_fragments},
      {"fragments of the far triangle", d.far_fragments},
      {"centres in the near triangle or on its outline", d.near_closed},
      {"centres in the far triangle or on its outline", d.far_closed},
      {"fragments together: what is shaded without a depth test",
       d.near_fragments + d.far_fragments},
      {"fragments together with closed edges: the textbook's \"total pixels shaded\"",
       d.near_closed + d.far_closed},
      {"pixels covered: the union", d.union_of_both},
      {"the union with closed edges: the textbook's \"pixels that passed depth test\"",
       d.union_closed},
      {"pixels in both: the overlap", d.overlap},
      {"fragments that pass the depth test, far drawn first", d.passed_far_first},
      {"fragments that pass the depth test, near drawn first", d.passed_near_first}};
  for (const Row& row : rows) results.figure(std::string("demo.") + row.what, row.count);
  results.table({rows, {{heading(""), &Row::what}, {heading("count"), &Row::count}}},
                {.page = "demo"});
}

/// Rows of words, the words of a column below each other.
std::string aligned(const std::vector<std::string>& rows) {
  std::string text;
  for (const std::string& row : rows) {
    std::istringstream words(row);
    for (std::string word; words >> word;) {
      const bool is_colour = word >= "A";
      word.resize(std::max<std::size_t>(word.size(), is_colour ? 2 : 5), ' ');
      text += word;
    }
    text += "\n";
  }
  return text;
}

void tables(Results& results) {
  add(results, z_buffer_files());
  show(results, "z-buffer", z_buffer_picture(), 24);
  const Tables t = z_buffer_tables();
  results.text("depths_before", aligned(t.black.depths));
  results.text("colours_before", aligned(t.black.colours));
  results.text("depths_after", aligned(t.black_then_grey.depths));
  results.text("colours_after", aligned(t.black_then_grey.colours));
}

void curves_and_time(Results& results) {
  for (const std::uint32_t size : {48U, 384U}) {
    const DrawnCurve curve = curve_at(size);
    add(results, curve.files);
    show(results, "curve-" + std::to_string(size), curve.picture, 384 / size);
  }
  add(results, wheel_files());
  const auto show_all = [&](const std::string& name, const std::vector<RgbImage>& pictures) {
    for (std::size_t i = 0; i < pictures.size(); ++i)
      show(results, name + std::to_string(i), pictures[i], 1);
  };
  show_all("wheel-", wheel_at_instants());
  show_all("wheel-shutter-", wheel_with_open_shutter());
  const WheelSeen seen = wheel_seen(wheel_degrees);
  results.quote("wheel_degrees", wheel_degrees);
  results.quote("wheel_seen", -seen.apparent, ".0f");
  results.quote("wheel_contrast", 100 * seen.contrast, ".0f");
}

}  // namespace

std::vector<StudyFile> study_course(const StudyOptions& options,
                                    const std::function<void(double)>& tick) {
  if (options.near || options.far || options.separation || options.samples)
    throw UsageError("the study course takes no options");
  Results results("course", page_texts::course, options);
  exercises_1_and_2(results);
  quadrangles(results);
  tick(0.1);
  exercise_3(results);
  tick(0.4);
  exercise_4(results);
  tick(0.6);
  exercise_5(results);
  exercise_6(results);
  tick(0.8);
  back_faces(results);
  shared_edges(results);
  tick(0.9);
  demo_of_section_6(results);
  tables(results);
  curves_and_time(results);
  tick(1);
  return results.files();
}

}  // namespace fathom::studies
