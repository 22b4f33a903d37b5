#include "validation/studies/course/course.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <tuple>

#include "fathom/numeric/errors.h"
#include "validation/studies/course/course_meshes.h"
#include "validation/studies/course/course_pictures.h"
#include "validation/studies/page.h"
#include "validation/studies/picture.h"

namespace fathom::studies {
namespace {

using Json = nlohmann::ordered_json;

struct Course {
  Page page{"A course in rasterization"};
  std::vector<StudyFile> files;
  Json summary{{"study", "course"}};

  void show(const std::string& name, const RgbImage& image, std::uint32_t scale,
            const std::string& caption) {
    files.push_back(picture_file(name, image, scale));
    page.picture(name, caption);
  }
};

void exercise_1_and_2(Course& c) {
  c.page.heading("Exercise 1: lines in all octants");
  c.page.paragraph(
      "One algorithm draws all eight: it steps along the longer axis and carries the error along "
      "in "
      "integers. At multiples of 45 degrees there is nothing to decide, so every algorithm agrees; "
      "fathom scan draws any other line, and --trace shows each decision.");
  c.show("exercise-1", eight_lines(), 6, "Bresenham's lines at 0, 45, … 315 degrees");
  c.page.heading("Exercise 2: three edge functions");
  c.page.paragraph(
      "Each edge function is positive on one side of its edge. Red, green and blue are bright "
      "where "
      "the function opposite the first, second and third corner is positive; where all three are, "
      "the picture is nearly white, and that is the triangle. It winds clockwise as seen, so a "
      "test "
      "for 'all positive' without a look at the winding finds no pixel at all.");
  c.show("exercise-2", edge_function_signs(), 2, "(50,20), (200,150), (30,180)");
}

void exercise_3(Course& c) {
  c.page.heading("Exercise 3: two surfaces 0.0001 apart");
  c.page.paragraph(
      "The surfaces lie 0.0001 apart along the view, tilted, near 0.1 and far 1000, everything "
      "computed in binary32. Red is where the farther one wins. (A separation of 0.0001 in window "
      "depth would be 6.55 steps of unorm16: no fight at all.)");
  std::vector<std::vector<std::string>> rows;
  for (const double distance : {0.5, 2.0, 10.0, 50.0}) {
    std::vector<std::string> row{fmt::format("{}", distance)};
    for (const Storage storage : {Storage::unorm16, Storage::unorm32, Storage::float32}) {
      const Fight f = fight(distance, storage);
      row.push_back(fmt::format("{:.1f} %", 100 * f.wrong_share));
      const std::string name = fmt::format("exercise-3-{}-{}", distance, name_of(storage));
      if (distance == 2.0 || distance == 10.0)
        c.show(name, f.picture, 2, fmt::format("distance {}, {}", distance, name_of(storage)));
      c.summary["exercise_3"].push_back(
          {{"distance", distance}, {"storage", name_of(storage)}, {"wrong_share", f.wrong_share}});
    }
    rows.push_back(row);
  }
  c.page.table({"distance", "unorm16", "unorm32", "float32"}, rows);
}

void exercise_4(Course& c) {
  c.page.heading("Exercise 4: perspective-correct interpolation");
  std::vector<std::vector<std::string>> rows;
  for (const auto& [name, interpolation] :
       {std::pair("affine", pipeline::Interpolation::affine),
        std::pair("perspective", pipeline::Interpolation::perspective)}) {
    const Checkerboard board = checkerboard(interpolation);
    c.show(std::string("exercise-4-") + name, board.picture, 2, name);
    rows.push_back({name, fmt::format("{:.3g}", board.mean_error),
                    fmt::format("{:.3g}", board.greatest_error)});
    c.summary["exercise_4"].push_back({{"interpolation", name},
                                       {"mean_error", board.mean_error},
                                       {"greatest_error", board.greatest_error}});
  }
  c.page.paragraph(
      "Linear in the window is not linear on the surface: the affine picture bends at the diagonal "
      "that joins the two triangles. The error is that of the texture coordinates against the "
      "exact ones, over all pixels.");
  c.page.table({"interpolation", "mean error", "greatest error"}, rows);
}

void exercise_5_and_6(Course& c) {
  c.page.heading("Exercise 5: wireframe and flat shading");
  c.show("exercise-5-wireframe", cube(pipeline::Shading::wireframe), 2, "only the edges");
  c.show("exercise-5-flat", cube(pipeline::Shading::flat), 2, "each face by its own normal");
  c.page.heading("Exercise 6: partially covered pixels of an edge");
  const PartialPixels partial = partial_pixels();
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < 4; ++i) {
    rows.push_back({fmt::format("{}", 1 << i), fmt::format("{}", partial.counted[i]),
                    fmt::format("{:.4f}", partial.mean_error[i])});
    c.summary["exercise_6"].push_back({{"samples", 1 << i},
                                       {"partial", partial.counted[i]},
                                       {"mean_error", partial.mean_error[i]}});
  }
  c.summary["exercise_6_exact"] = partial.exact;
  rows.push_back({"exact area", fmt::format("{}", partial.exact), "0"});
  c.page.paragraph(
      "With one sample no pixel is partial. More samples find more of the pixels that the edge "
      "really cuts, and are nearer to their covered area.");
  c.page.table({"samples", "partial pixels", "mean error of coverage"}, rows);
}

void demo_of_section_6(Course& c) {
  c.page.heading("The demo: two overlapping triangles");
  const Demo d = demo();
  c.show("demo", d.picture, 2, "near (red, green, blue) over far (yellow, cyan, magenta)");
  const std::pair<const char*, std::uint64_t> figures[] = {
      {"fragments of the near triangle", d.near_fragments},
      {"fragments of the far triangle", d.far_fragments},
      {"fragments together: what is shaded without a depth test",
       d.near_fragments + d.far_fragments},
      {"pixels covered: the union", d.union_of_both},
      {"pixels in both: the overlap", d.overlap},
      {"fragments that pass the depth test, far drawn first", d.passed_far_first},
      {"fragments that pass the depth test, near drawn first", d.passed_near_first}};
  std::vector<std::vector<std::string>> rows;
  for (const auto& [what, count] : figures) {
    rows.push_back({what, fmt::format("{}", count)});
    c.summary["demo"][what] = count;
  }
  c.page.table({"", "count"}, rows);
}

/// Rows of words, the words of a column below each other.
std::string aligned(const std::vector<std::string>& rows) {
  std::string text;
  for (const std::string& row : rows) {
    std::istringstream words(row);
    for (std::string word; words >> word;)
      text += word >= "A" ? word + " " : fmt::format("{:<5}", word);
    text += "\n";
  }
  return text;
}

void tables(Course& c) {
  c.page.heading("The z-buffer, in numbers");
  c.page.paragraph(
      "A black triangle at depth 0.5, then a grey one that recedes from 0.25 to 0.95 to the right. "
      "Depth buffer and colours (white, black, grey) before and after the grey triangle.");
  const Tables t = z_buffer_tables();
  c.page.preformatted(aligned(t.depth_before), "depths before")
      .preformatted(aligned(t.colour_before), "colours before")
      .preformatted(aligned(t.depth_after), "depths after")
      .preformatted(aligned(t.colour_after), "colours after");
}

void curves_and_time(Course& c) {
  c.page.heading("Curves, and time");
  const auto [enlarged, anew] = curve_twice();
  c.show("curve-enlarged", enlarged, 8, "a curve filled at 48 by 48 pixels, enlarged eight times");
  c.show("curve-anew", anew, 1, "the same curve evaluated at that size");
  c.show("wheel", turning_wheel(false), 1,
         "twelve spokes turn by 27 degrees a frame to the right: they seem to turn 3 to the left");
  c.show("wheel-supersampled", turning_wheel(true), 1,
         "the mean of 16 instants a frame: the motion blurs, and nothing turns backwards");
}

void back_faces(Course& c) {
  c.page.heading("Back faces");
  c.page.paragraph(
      "A closed ball of 32040 triangles. Three tests say which side of a triangle is seen: N·V in "
      "the world, the normal's z after the division, the determinant in the window. Culling is "
      "said to remove half of the faces: that is right from far away only. A ball of radius 1 "
      "shows (1 − 1/d)/2 of itself to an eye at distance d. The tests can disagree only about a "
      "triangle seen so nearly edge on that rounding decides.");
  std::vector<std::vector<std::string>> rows;
  for (const FacingCount& f : count_facings()) {
    const bool narrow = f.precision == pipeline::Precision::binary32;
    const double culled =
        1 - static_cast<double>(f.front_in_window) / static_cast<double>(f.triangles);
    rows.push_back({narrow ? "binary32" : "binary64", fmt::format("{}", f.distance),
                    fmt::format("{:.2f} %", 100 * culled),
                    fmt::format("{:.2f} %", 100 * (1 - f.seen_share)),
                    fmt::format("{}", f.front_in_world), fmt::format("{}", f.front_in_ndc),
                    fmt::format("{}", f.front_in_window), fmt::format("{}", f.disagreeing)});
    c.summary["facings"].push_back({{"precision", narrow ? "binary32" : "binary64"},
                                    {"distance", f.distance},
                                    {"triangles", f.triangles},
                                    {"front_in_world", f.front_in_world},
                                    {"front_in_ndc", f.front_in_ndc},
                                    {"front_in_window", f.front_in_window},
                                    {"disagreeing", f.disagreeing}});
  }
  c.page.table({"arithmetic", "distance", "culled", "unseen surface", "front: world", "front: NDC",
                "front: window", "the tests disagree"},
               rows);
  for (const auto& [name, front_face, culling, caption] :
       {std::tuple("box-ccw-back", pipeline::FrontFace::counter_clockwise, pipeline::Culling::back,
                   "back culled: outer walls"),
        std::tuple("box-ccw-front", pipeline::FrontFace::counter_clockwise,
                   pipeline::Culling::front, "front culled: the inner walls appear"),
        std::tuple("box-cw-back", pipeline::FrontFace::clockwise, pipeline::Culling::back,
                   "front is clockwise, back culled: inner"),
        std::tuple("box-none", pipeline::FrontFace::counter_clockwise, pipeline::Culling::none,
                   "nothing culled")})
    c.show(name, open_box(front_face, culling), 1, caption);
}

void shared_edges(Course& c) {
  c.page.heading("Shared edges");
  c.page.paragraph(
      "A mesh of narrow triangles, 12 by 12 pixels, its corners snapped to 2^N positions a pixel, "
      "sampled 16 by 16 times in every pixel. Counted by orientation, every sample is covered "
      "exactly once: there are no cracks. Snapping can turn a thin triangle over; there, and only "
      "there, three triangles meet at a sample, one of them negative (red).");
  std::vector<std::vector<std::string>> rows;
  for (const int bits : {0, 1, 2, 3, 4, 6, 8, 16}) {
    const SharedEdges e = count_shared_edges(bits);
    rows.push_back({fmt::format("{}", e.bits), fmt::format("{}", e.turned_over),
                    fmt::format("{}", e.without_area), fmt::format("{}", e.signed_not_one),
                    fmt::format("{}", e.unsigned_not_one), fmt::format("{}", e.unexplained)});
    c.summary["shared_edges"].push_back({{"subpixel_bits", e.bits},
                                         {"triangles", e.triangles},
                                         {"turned_over", e.turned_over},
                                         {"without_area", e.without_area},
                                         {"samples", e.samples},
                                         {"signed_not_one", e.signed_not_one},
                                         {"unsigned_not_one", e.unsigned_not_one},
                                         {"unexplained", e.unexplained}});
    if (bits == 0 || bits == 2 || bits == 8)
      c.show(fmt::format("shared-edges-{}", bits), e.picture, 2,
             fmt::format("{} subpixel bits", bits));
  }
  c.page.table({"bits", "turned over", "without area", "samples not covered once, signed",
                "not once, unsigned", "of these unexplained"},
               rows);
}

}  // namespace

std::vector<StudyFile> study_course(const StudyOptions& options,
                                    const std::function<void(double)>& tick) {
  if (options.near || options.far || options.separation || options.samples)
    throw UsageError("the study course takes no options");
  Course course;
  course.page.paragraph(
      "What textbooks on rasterization ask their readers to try, tried: every picture and every "
      "figure below was computed by Fathom's pipeline, and held against exact arithmetic where "
      "there is a truth to hold it against.");
  exercise_1_and_2(course);
  tick(0.1);
  exercise_3(course);
  tick(0.4);
  exercise_4(course);
  tick(0.6);
  exercise_5_and_6(course);
  tick(0.8);
  back_faces(course);
  shared_edges(course);
  tick(0.9);
  demo_of_section_6(course);
  tables(course);
  curves_and_time(course);
  course.files.push_back({"summary.json", course.summary.dump(2) + "\n"});
  course.files.push_back(course.page.file());
  tick(1);
  return course.files;
}

}  // namespace fathom::studies
