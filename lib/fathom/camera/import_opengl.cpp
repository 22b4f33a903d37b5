#include <charconv>
#include <limits>
#include <string>

#include "fathom/camera/camera_import_internal.h"
#include "fathom/camera/pose.h"
#include "fathom/numeric/errors.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/input_file.h"
#include "fathom/text/json_value.h"

namespace fathom {
using namespace camera;
using namespace text;

namespace {

using Matrix4 = std::array<std::array<double, 4>, 4>;

/// Four rows, or OpenGL's flat list of 16, column by column.
Matrix4 read_matrix(const JsonValue& value) {
  Matrix4 matrix{};
  if (value.is_list() && value.size() == 16) {
    const auto flat = value.numbers(16);
    for (std::size_t i = 0; i < 16; ++i) matrix[i % 4][i / 4] = flat[i];
    return matrix;
  }
  if (!value.is_list() || value.size() != 4)
    value.fail("expected 4 rows of 4 numbers, or 16 numbers column by column");
  const auto rows = value.elements();
  for (std::size_t i = 0; i < 4; ++i) {
    const auto row = rows[i].numbers(4);
    std::copy(row.begin(), row.end(), matrix[i].begin());
  }
  return matrix;
}

void read_viewport(const JsonValue& viewport, Camera& camera) {
  if (!viewport.is_list() || (viewport.size() != 2 && viewport.size() != 4))
    viewport.fail("expected [width, height] or [x, y, width, height]");
  const auto entries = viewport.elements();
  const auto size = [&](std::size_t i) {
    return static_cast<std::uint32_t>(
        entries[i].integer(1, std::numeric_limits<std::uint32_t>::max()));
  };
  camera.width = size(entries.size() - 2);
  camera.height = size(entries.size() - 1);
}

/// OpenGL's eye space looks along −z with y up; ours looks along z with y down. Exact.
void read_view(const JsonValue& entry, Camera& camera) {
  auto value = entry.find("modelview");
  const auto view = entry.find("view");
  if (value && view) view->fail("expected either \"modelview\" or \"view\"");
  if (!value) value = view;
  Matrix4 M{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
  if (value) M = read_matrix(*value);
  if (M[3] != std::array<double, 4>{0, 0, 0, 1}) value->fail("expected the last row to be 0 0 0 1");
  camera.world_to_camera[0] = M[0];
  for (std::size_t i : {1, 2})
    for (std::size_t k = 0; k < 4; ++k) camera.world_to_camera[i][k] = 0.0 - M[i][k];
}

double rounded(const Dyadic& numerator, const Dyadic& denominator) {
  return round_to_binary64(Ratio(numerator, denominator));
}

/// Window coordinates are u = (1 + X/W)·width/2 and, y down, v = (1 − Y/W)·height/2. With
/// X = P₀·(x, −y, −z, 1) and so on, and W = k·z (perspective) or k (orthographic), comparing
/// coefficients with U and V of the specification gives the intrinsics.
void read_intrinsics(const JsonValue& value, const Matrix4& P, Camera& camera) {
  const bool perspective = P[3][2] != 0;
  const Dyadic k = perspective ? -Dyadic(P[3][2]) : Dyadic(P[3][3]);
  if (P[3][0] != 0 || P[3][1] != 0 || (perspective && P[3][3] != 0) || k.sign() != Sign::positive)
    value.fail("expected the last row to be 0 0 -1 0 (perspective) or 0 0 0 1 (orthographic)");
  if (P[1][0] != 0) value.fail("expected 0 in the second row's first place");
  if (perspective && (P[0][3] != 0 || P[1][3] != 0))
    value.fail("expected a perspective projection without translation of x and y");
  if (!perspective && (P[0][2] != 0 || P[1][2] != 0))
    value.fail("an oblique orthographic projection cannot be expressed");
  camera.projection = perspective ? Projection::perspective : Projection::orthographic;
  const Dyadic w = camera.width, h = camera.height, twice_k = k + k;
  camera.fx = rounded(w * P[0][0], twice_k);
  camera.skew = rounded(-(w * P[0][1]), twice_k);
  camera.fy = rounded(h * P[1][1], twice_k);
  camera.cx = rounded(w * (perspective ? k - P[0][2] : k + P[0][3]), twice_k);
  camera.cy = rounded(h * (perspective ? k + P[1][2] : k - P[1][3]), twice_k);
}

/// Depth of the plane where z_ndc = (P₂₃ − P₂₂·z)/W is `ndc`; infinite if there is none.
double depth_of_plane(const Matrix4& P, Projection projection, double ndc) {
  const Dyadic a = P[2][2], b = P[2][3];
  const bool perspective = projection == Projection::perspective;
  const Dyadic k = perspective ? -Dyadic(P[3][2]) : Dyadic(P[3][3]);
  const Dyadic numerator = perspective ? b : b - k * ndc;
  const Dyadic denominator = perspective ? a + k * ndc : a;
  if (denominator.is_zero()) return std::numeric_limits<double>::infinity();
  return rounded(numerator, denominator);
}

void read_near_and_far(const JsonValue& entry, const JsonValue& projection, const Matrix4& P,
                       Camera& camera) {
  double nearest = -1;
  if (const auto clip_depth = entry.find("clip_depth")) {
    const std::string& range = clip_depth->string();
    if (range == "none") return;
    if (range == "zero-one")
      nearest = 0;
    else if (range != "minus-one-one")
      clip_depth->fail("expected \"minus-one-one\", \"zero-one\" or \"none\"");
  }
  const double one = depth_of_plane(P, camera.projection, nearest);
  const double other = depth_of_plane(P, camera.projection, 1);
  camera.near = std::min(one, other);
  camera.far = std::max(one, other);
  if (!(camera.near >= 0 && camera.near < camera.far))
    projection.fail("its near and far planes lie at " + std::to_string(one) + " and " +
                    std::to_string(other) +
                    ", expected 0 <= near < far (\"clip_depth\": \"none\" leaves them out)");
}

/// A list of JSON, each number such that reading it gives the same one.
std::string list_of(const std::array<double, 4>& row) {
  std::string list = "[";
  for (const double number : row) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, number);
    list.append(list.size() == 1 ? "" : ", ").append(text, end.ptr);
  }
  return list + "]";
}

std::string list_of(const std::array<double, 16>& matrix) {
  std::string list;
  for (std::size_t r = 0; r < 4; ++r) {
    const double* const row = matrix.data() + 4 * r;
    list += (r == 0 ? "[" : ", ") + list_of(std::array{row[0], row[1], row[2], row[3]});
  }
  return list + "]";
}

ImportedCamera read_camera(const JsonValue& entry, std::size_t index) {
  entry.expect_only({"name", "projection", "modelview", "view", "viewport", "clip_depth"});
  const JsonValue projection = entry.at("projection");
  ImportedCamera result;
  const auto name = entry.find("name");
  result.name = name ? name->string() : std::to_string(index);
  const Matrix4 P = read_matrix(projection);
  read_viewport(entry.at("viewport"), result.camera);
  read_view(entry, result.camera);
  read_intrinsics(projection, P, result.camera);
  read_near_and_far(entry, projection, P, result.camera);
  if (const auto fault = find_fault(result.camera)) entry.fail(*fault);
  return result;
}

}  // namespace

std::vector<ImportedCamera> camera::parse_opengl(std::string_view text, const std::string& name) {
  const JsonDocument document(text, name);
  const JsonValue root = document.root();
  if (!root.is_list()) return {read_camera(root, 0)};
  std::vector<ImportedCamera> cameras;
  for (const JsonValue& entry : root.elements())
    cameras.push_back(read_camera(entry, cameras.size()));
  if (cameras.empty()) root.fail("the list of cameras is empty");
  return cameras;
}

std::vector<ImportedCamera> import_opengl(const std::filesystem::path& file) {
  const StandardArithmetic standard;
  return parse_opengl(InputFile(file).text(), file.string());
}

Camera camera_from_opengl(const std::array<double, 16>& projection,
                          const std::array<double, 16>& modelview, std::uint32_t width,
                          std::uint32_t height) {
  const StandardArithmetic standard;
  const std::string text = "{\"projection\": " + list_of(projection) +
                           ", \"modelview\": " + list_of(modelview) + ", \"viewport\": [" +
                           std::to_string(width) + ", " + std::to_string(height) + "]}";
  return parse_opengl(text, "camera").front().camera;
}

}  // namespace fathom
