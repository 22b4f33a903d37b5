#include "validation/studies/antialiasing/coverage_by_samples.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "fathom/area/sampled_coverage.h"
#include "fathom/numeric/errors.h"
#include "fathom/render.h"
#include "validation/studies/plot.h"

namespace fathom::studies {
namespace {

constexpr const char* patterns[] = {
    "1",  "2",         "4",          "rotated-grid", "regular:2",  "jittered:2", "8",
    "16", "regular:4", "jittered:4", "regular:8",    "jittered:8", "regular:16", "jittered:16"};

PatternError measure(const SceneView& view, const DepthMap& exact, const std::string& name) {
  const SamplePattern pattern = sample_pattern(name);
  DepthMap map = exact;
  add_sampled_coverage(map, view.scene, view.camera, pattern, {});
  const auto& A = *map.values<float>("A");
  const auto& shares = *map.values<float>("Asampled");
  PatternError row{name, pattern.count()};
  for (std::size_t i = 0; i < A.size(); ++i) {
    if (!(A[i] > 0 && A[i] < 1)) continue;
    const double error = static_cast<double>(shares[i]) - static_cast<double>(A[i]);
    ++row.partial;
    row.seen_partial += shares[i] > 0 && shares[i] < 1 ? 1 : 0;
    row.mean += std::abs(error);
    row.root_mean_square += error * error;
    row.greatest = std::max(row.greatest, std::abs(error));
    row.bias += error;
  }
  if (row.partial > 0) {
    row.mean /= static_cast<double>(row.partial);
    row.root_mean_square = std::sqrt(row.root_mean_square / static_cast<double>(row.partial));
  }
  return row;
}

/// A half-plane over 64×64 pixels whose edge rises by `slope` over one pixel.
SceneView edge_of(double slope) {
  SceneView view{fmt::format("edge of slope {:g}", slope), {}, {}};
  Mesh mesh;
  mesh.vertices = {
      {-32, 200, 1}, {96, 200, 1}, {96, 32.3 - 64 * slope, 1}, {-32, 32.3 + 64 * slope, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.face_count = 2;
  view.scene.meshes = {std::move(mesh)};
  view.scene.objects = {{.name = "edge"}};
  view.camera.width = view.camera.height = 64;
  view.camera.projection = Projection::orthographic;
  return view;
}

std::vector<EdgeSeen> measure_edges() {
  std::vector<EdgeSeen> edges;
  for (const double slope : {0.0, 0.03, 0.07, 0.13, 0.29, 0.53, 0.71, 1.0}) {
    const SceneView view = edge_of(slope);
    const DepthMap exact = exact_coverage(view);
    EdgeSeen edge{slope, 0, {}, {}};
    for (const char* pattern : {"1", "2", "4", "8"}) {
      const PatternError row = measure(view, exact, pattern);
      edge.partial = row.partial;
      edge.seen.push_back(row.seen_partial);
    }
    for (const char* pattern : edge_patterns) {
      edge.root_mean_square.push_back(measure(view, exact, pattern).root_mean_square);
    }
    edges.push_back(edge);
  }
  return edges;
}

std::string csv_of(const std::vector<PatternError>& rows) {
  std::string text =
      "pattern,samples,partial_pixels,seen_partial,mean_error,rms_error,greatest_error,bias_"
      "pixels\n";
  for (const PatternError& r : rows) {
    text += fmt::format("{},{},{},{},{:.6g},{:.6g},{:.6g},{:.6g}\n", r.pattern, r.samples,
                        r.partial, r.seen_partial, r.mean, r.root_mean_square, r.greatest, r.bias);
  }
  return text;
}

std::string csv_of(const std::vector<EdgeSeen>& edges) {
  std::string text = "slope,exact,seen_by_1,seen_by_2,seen_by_4,seen_by_8";
  for (const char* pattern : edge_patterns) text += fmt::format(",rms_{}", pattern);
  text += "\n";
  for (const EdgeSeen& e : edges) {
    text += fmt::format("{:g},{},{},{:.6g}\n", e.slope, e.partial, fmt::join(e.seen, ","),
                        fmt::join(e.root_mean_square, ","));
  }
  return text;
}

Plot error_plot(const std::vector<PatternError>& rows) {
  Plot plot{"error",
            "Coverage by samples against the exact area, pixels that are partly covered",
            "samples a pixel",
            "root mean square error of the coverage",
            true,
            true,
            {{"standard", {}}, {"regular", {}}, {"jittered", {}}, {"rotated grid", {}}}};
  for (const PatternError& r : rows) {
    const std::size_t series = r.pattern.starts_with("regular")    ? 1
                               : r.pattern.starts_with("jittered") ? 2
                               : r.pattern.starts_with("rotated")  ? 3
                                                                   : 0;
    plot.series[series].points.emplace_back(r.samples, r.root_mean_square);
  }
  return plot;
}

Plot edge_plot(const std::vector<EdgeSeen>& edges) {
  Plot plot{"edge",
            "Pixels of an edge that are partly covered, exactly and as samples see them",
            "slope of the edge",
            "pixels",
            false,
            false,
            {{"exact area", {}}}};
  for (const EdgeSeen& e : edges) plot.series[0].points.emplace_back(e.slope, e.partial);
  const char* names[] = {"1 sample", "2 samples", "4 samples", "8 samples"};
  for (std::size_t k = 0; k < 4; ++k) {
    Series series{names[k], {}};
    for (const EdgeSeen& e : edges) series.points.emplace_back(e.slope, e.seen[k]);
    plot.series.push_back(series);
  }
  return plot;
}

}  // namespace

DepthMap exact_coverage(const SceneView& view) {
  return render(view.scene, view.camera, {.channels = {Channel::A}});
}

CoverageBySamples measure_coverage_by_samples(const SceneView& view, const DepthMap& exact,
                                              const std::function<void(double)>& tick) {
  CoverageBySamples measured;
  for (const char* pattern : patterns) {
    measured.patterns.push_back(measure(view, exact, pattern));
    if (measured.patterns[0].partial == 0) throw UsageError("no pixel is partly covered");
    tick(static_cast<double>(measured.patterns.size()) / static_cast<double>(std::size(patterns)));
  }
  measured.edges = measure_edges();
  return measured;
}

std::vector<StudyFile> files_of(const CoverageBySamples& measured) {
  std::vector<StudyFile> files{{"patterns.csv", csv_of(measured.patterns)},
                               {"edges.csv", csv_of(measured.edges)}};
  for (const Plot& plot : {error_plot(measured.patterns), edge_plot(measured.edges)}) {
    auto drawn = draw(plot);
    std::move(drawn.begin(), drawn.end(), std::back_inserter(files));
  }
  return files;
}

void add_to_summary(const CoverageBySamples& measured, nlohmann::ordered_json& summary) {
  for (const PatternError& r : measured.patterns) {
    summary["patterns"].push_back({{"pattern", r.pattern},
                                   {"samples", r.samples},
                                   {"partial_pixels", r.partial},
                                   {"seen_partial", r.seen_partial},
                                   {"mean_error", r.mean},
                                   {"rms_error", r.root_mean_square},
                                   {"greatest_error", r.greatest},
                                   {"bias_pixels", r.bias}});
  }
  for (const EdgeSeen& e : measured.edges) {
    nlohmann::ordered_json errors;
    for (std::size_t k = 0; k < std::size(edge_patterns); ++k) {
      errors[edge_patterns[k]] = e.root_mean_square[k];
    }
    summary["edges"].push_back(
        {{"slope", e.slope}, {"exact", e.partial}, {"seen", e.seen}, {"rms_error", errors}});
  }
}

void add_to_page(const CoverageBySamples& measured, Page& page) {
  page.paragraph(
      "The exact coverage A of a pixel is the area of it that surfaces cover. Samples see a share "
      "of themselves covered. The table holds the difference over all pixels that are partly "
      "covered.");
  std::vector<std::vector<std::string>> cells;
  for (const PatternError& r : measured.patterns) {
    cells.push_back({r.pattern, fmt::format("{}", r.samples), fmt::format("{:.4f}", r.mean),
                     fmt::format("{:.4f}", r.root_mean_square), fmt::format("{:.4f}", r.greatest),
                     fmt::format("{:+.2f}", r.bias),
                     fmt::format("{:.1f} %", 100.0 * static_cast<double>(r.seen_partial) /
                                                 static_cast<double>(r.partial))});
  }
  page.table({"pattern", "samples", "mean error", "rms", "greatest", "area gained (pixels)",
              "seen as partial"},
             cells);
  page.plot("error", "Error of the coverage against the number of samples");
  page.paragraph(
      "Over edges of all directions a regular grid is as good as any pattern of as many samples, "
      "or better: its samples are spread most evenly over the pixel. Jitter makes errors no "
      "smaller: it turns their pattern into noise.");
  page.heading("One edge");
  page.paragraph(
      "An edge across 64 pixels. One sample a pixel sees no pixel as partly covered; more samples "
      "see more of those that are.");
  cells.clear();
  for (const EdgeSeen& e : measured.edges) {
    std::vector<std::string> row{fmt::format("{:g}", e.slope), fmt::format("{}", e.partial)};
    for (const std::uint64_t seen : e.seen) row.push_back(fmt::format("{}", seen));
    cells.push_back(row);
  }
  page.table({"slope", "exact", "1 sample", "2 samples", "4 samples", "8 samples"}, cells);
  page.plot("edge", "Pixels seen as partly covered");
  page.paragraph(
      "Root mean square error along these edges. Where the edge is nearly level (or upright), "
      "samples that share no row and no column (the standard patterns, the rotated grid) see as "
      "many steps of it as they are; a regular grid of as many sees only the root of that. At "
      "steeper ones a pattern of few samples depends on the side to which the edge leans: the "
      "rotated grid is the standard pattern of four in the mirror.");
  cells.clear();
  for (const EdgeSeen& e : measured.edges) {
    std::vector<std::string> row{fmt::format("{:g}", e.slope)};
    for (const double error : e.root_mean_square) row.push_back(fmt::format("{:.4f}", error));
    cells.push_back(row);
  }
  std::vector<std::string> head{"slope"};
  head.insert(head.end(), std::begin(edge_patterns), std::end(edge_patterns));
  page.table(head, cells);
}

}  // namespace fathom::studies
