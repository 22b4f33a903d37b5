#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "fathom/camera/camera_import_internal.h"
#include "fathom/camera/pose.h"
#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/json_value.h"

namespace fathom {
using namespace camera;
using namespace files;
using namespace text;

namespace {

using Matrix4 = std::array<std::array<double, 4>, 4>;

constexpr Matrix4 identity{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};

/// The numbers of a camera in OpenGL.
struct OpenGlView {
  Matrix4 projection = identity, modelview = identity;
  std::uint32_t width = 0, height = 0;
  /// The clip depth of the near plane; nullopt if near and far are not imported.
  std::optional<double> nearest = -1;
};

enum class Part { projection, modelview, whole };

/// The fault of a view, and the part that has it; the caller knows the names of the numbers.
class ViewFault : public InputError {
 public:
  ViewFault(Part part, const std::string& message) : InputError(message), part_(part) {}
  [[nodiscard]] Part part() const { return part_; }

 private:
  Part part_;
};

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

void read_viewport(const JsonValue& viewport, OpenGlView& view) {
  if (!viewport.is_list() || (viewport.size() != 2 && viewport.size() != 4))
    viewport.fail("expected [width, height] or [x, y, width, height]");
  const auto entries = viewport.elements();
  const auto size = [&](std::size_t i) {
    return static_cast<std::uint32_t>(
        entries[i].integer(1, std::numeric_limits<std::uint32_t>::max()));
  };
  view.width = size(entries.size() - 2);
  view.height = size(entries.size() - 1);
}

void read_clip_depth(const JsonValue& clip_depth, OpenGlView& view) {
  const std::string& range = clip_depth.string();
  if (range == "none")
    view.nearest = std::nullopt;
  else if (range == "zero-one")
    view.nearest = 0;
  else if (range != "minus-one-one")
    clip_depth.fail("expected \"minus-one-one\", \"zero-one\" or \"none\"");
}

double rounded(const Dyadic& numerator, const Dyadic& denominator) {
  return round_to_binary64(Ratio(numerator, denominator));
}

/// OpenGL's eye space looks along −z with y up; ours looks along z with y down. Exact.
void set_pose(const Matrix4& M, Camera& camera) {
  if (M[3] != identity[3]) throw ViewFault(Part::modelview, "expected the last row to be 0 0 0 1");
  camera.world_to_camera[0] = M[0];
  for (std::size_t i : {1, 2})
    for (std::size_t k = 0; k < 4; ++k) camera.world_to_camera[i][k] = 0.0 - M[i][k];
}

/// Window coordinates are u = (1 + X/W)·width/2 and, y down, v = (1 − Y/W)·height/2. With
/// X = P₀·(x, −y, −z, 1) and so on, and W = k·z (perspective) or k (orthographic), comparing
/// coefficients with U and V of the specification gives the intrinsics.
void set_intrinsics(const Matrix4& P, Camera& camera) {
  const auto refuse = [](const char* message) { throw ViewFault(Part::projection, message); };
  const bool perspective = P[3][2] != 0;
  const Dyadic k = perspective ? -Dyadic(P[3][2]) : Dyadic(P[3][3]);
  if (P[3][0] != 0 || P[3][1] != 0 || (perspective && P[3][3] != 0) || k.sign() != Sign::positive)
    refuse("expected the last row to be 0 0 -1 0 (perspective) or 0 0 0 1 (orthographic)");
  if (P[1][0] != 0) refuse("expected 0 in the second row's first place");
  if (perspective && (P[0][3] != 0 || P[1][3] != 0))
    refuse("expected a perspective projection without translation of x and y");
  if (!perspective && (P[0][2] != 0 || P[1][2] != 0))
    refuse("an oblique orthographic projection cannot be expressed");
  camera.projection.model =
      perspective ? ProjectionModel::perspective : ProjectionModel::orthographic;
  const Dyadic w = camera.width, h = camera.height, twice_k = k + k;
  camera.projection.fx = rounded(w * P[0][0], twice_k);
  camera.projection.skew = rounded(-(w * P[0][1]), twice_k);
  camera.projection.fy = rounded(h * P[1][1], twice_k);
  camera.projection.cx = rounded(w * (perspective ? k - P[0][2] : k + P[0][3]), twice_k);
  camera.projection.cy = rounded(h * (perspective ? k + P[1][2] : k - P[1][3]), twice_k);
}

/// Depth of the plane where z_ndc = (P₂₃ − P₂₂·z)/W is `ndc`; infinite if no such plane exists.
double depth_of_plane(const Matrix4& P, bool perspective, double ndc) {
  const Dyadic a = P[2][2], b = P[2][3];
  const Dyadic k = perspective ? -Dyadic(P[3][2]) : Dyadic(P[3][3]);
  const Dyadic numerator = perspective ? b : b - k * ndc;
  const Dyadic denominator = perspective ? a + k * ndc : a;
  if (denominator.is_zero()) return std::numeric_limits<double>::infinity();
  return rounded(numerator, denominator);
}

void set_near_and_far(const Matrix4& P, double nearest, Camera& camera) {
  const bool perspective = is_perspective(camera.projection);
  const double one = depth_of_plane(P, perspective, nearest);
  const double other = depth_of_plane(P, perspective, 1);
  camera.near = std::min(one, other);
  camera.far = std::max(one, other);
  if (!(camera.near >= 0 && camera.near < camera.far)) {
    throw ViewFault(Part::projection,
                    "its near and far planes lie at " + std::to_string(one) + " and " +
                        std::to_string(other) +
                        ", expected 0 <= near < far (\"clip_depth\": \"none\" leaves them out)");
  }
}

void require_finite(const Matrix4& matrix, Part part) {
  for (const auto& row : matrix)
    for (const double number : row)
      if (!std::isfinite(number)) throw ViewFault(part, "has a number that is not finite");
}

/// Fails    ViewFault.
Camera camera_of(const OpenGlView& view) {
  require_finite(view.projection, Part::projection);
  require_finite(view.modelview, Part::modelview);
  Camera camera;
  camera.width = view.width;
  camera.height = view.height;
  set_pose(view.modelview, camera);
  set_intrinsics(view.projection, camera);
  if (view.nearest) set_near_and_far(view.projection, *view.nearest, camera);
  if (const auto fault = find_fault(camera)) throw ViewFault(Part::whole, *fault);
  return camera;
}

Camera read_camera(const JsonValue& entry) {
  entry.expect_only({"name", "projection", "modelview", "view", "viewport", "clip_depth"});
  const JsonValue projection = entry.at("projection");
  auto modelview = entry.find("modelview");
  const auto other = entry.find("view");
  OpenGlView view;
  view.projection = read_matrix(projection);
  read_viewport(entry.at("viewport"), view);
  if (modelview && other) other->fail("expected either \"modelview\" or \"view\"");
  if (!modelview) modelview = other;
  if (modelview) view.modelview = read_matrix(*modelview);
  if (const auto clip_depth = entry.find("clip_depth")) read_clip_depth(*clip_depth, view);
  try {
    return camera_of(view);
  } catch (const ViewFault& fault) {
    const JsonValue& part = fault.part() == Part::projection               ? projection
                            : fault.part() == Part::modelview && modelview ? *modelview
                                                                           : entry;
    part.fail(fault.what());
  }
}

ImportedCamera read_named(const JsonValue& entry, std::size_t index) {
  const auto name = entry.find("name");
  return imported_camera(name ? name->string() : std::to_string(index), entry.where(),
                         [&](ImportedCamera& one) { one.camera = read_camera(entry); });
}

Matrix4 rows_of(const std::array<double, 16>& list) {
  Matrix4 matrix;
  for (std::size_t i = 0; i < 16; ++i) matrix[i / 4][i % 4] = list[i];
  return matrix;
}

}  // namespace

std::vector<ImportedCamera> camera::parse_opengl(std::string_view text, const std::string& name) {
  const JsonDocument document(text, name);
  const JsonValue root = document.root();
  if (!root.is_list()) return {read_named(root, 0)};
  std::vector<ImportedCamera> cameras;
  for (const JsonValue& entry : root.elements())
    cameras.push_back(read_named(entry, cameras.size()));
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
  try {
    return camera_of({rows_of(projection), rows_of(modelview), width, height});
  } catch (const ViewFault& fault) {
    const char* const part = fault.part() == Part::projection  ? "projection: "
                             : fault.part() == Part::modelview ? "modelview: "
                                                               : "";
    throw InputError(std::string("camera: ") + part + fault.what());
  }
}

}  // namespace fathom
