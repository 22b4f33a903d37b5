#include <array>
#include <span>

#include "fathom/camera/camera_import_internal.h"
#include "fathom/camera/imports/calibrated_lens.h"
#include "fathom/camera/imports/lines_and_poses.h"
#include "fathom/files/input_file.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/numeric/transcendental.h"
#include "fathom/text/json_value.h"
#include "fathom/text/printable.h"

namespace fathom {
using namespace camera;
using text::JsonValue;

namespace {

Ratio exact_number(const JsonValue& number) {
  return Ratio(Dyadic(number.number()));
}

Ratio ratio(long n) {
  return Ratio(Dyadic(static_cast<double>(n)));
}

Ratio positive(const JsonValue& number) {
  if (!(number.number() > 0)) number.fail("expected a number greater than 0");
  return exact_number(number);
}

/// What all kinds of cameras share, as in Cycles (blender_camera_viewplane()).
struct RenderedImage {
  Ratio width, height;
  /// The width of a pixel over its height, inverted: aspect_y / aspect_x.
  Ratio aspect;
  Ratio shift_x, shift_y;
  /// Pixels along the side of the image to which the sensor is fitted, and the sensor's length.
  Ratio view, sensor;
};

bool fits_width(const JsonValue& fit, const RenderedImage& image) {
  if (fit.string() == "HORIZONTAL") return true;
  if (fit.string() == "VERTICAL") return false;
  if (fit.string() != "AUTO")
    fit.fail("found " + text::printable(fit.string()) + ", expected AUTO, HORIZONTAL or VERTICAL");
  return !(image.width < image.aspect * image.height);
}

RenderedImage read_render(const JsonValue& camera) {
  RenderedImage image;
  image.width = ratio(pixels_of(camera.at("width")));
  image.height = ratio(pixels_of(camera.at("height")));
  const auto aspect = camera.at("pixel_aspect").elements(2);
  image.aspect = quotient(positive(aspect[1]), positive(aspect[0]));
  image.shift_x = exact_number(camera.at("shift_x"));
  image.shift_y = exact_number(camera.at("shift_y"));
  const JsonValue fit = camera.at("sensor_fit");
  image.view = fits_width(fit, image) ? image.width : image.aspect * image.height;
  image.sensor = positive(camera.at(fit.string() == "VERTICAL" ? "sensor_height" : "sensor_width"));
  return image;
}

/// fx is so many pixels, and fy fits the aspect of the pixels.
void set_focal_length(const Ratio& fx, const RenderedImage& image, Projection& projection) {
  projection.fx = round_to_binary64(fx);
  projection.fy = round_to_binary64(quotient(fx, image.aspect));
}

void set_principal_point(const Ratio& x, const Ratio& y, Projection& projection) {
  projection.cx = round_to_binary64(x);
  projection.cy = round_to_binary64(y);
}

Ratio half() {
  return Ratio(Dyadic(0.5));
}

/// The middle of the image of a camera without a panorama.
void shift_sensor(const RenderedImage& image, Projection& projection) {
  set_principal_point(image.width * half() - image.shift_x * image.view,
                      image.height * half() + quotient(image.shift_y * image.view, image.aspect),
                      projection);
}

void read_perspective(const JsonValue& camera, const RenderedImage& image, ImportedCamera& one) {
  set_focal_length(quotient(positive(camera.at("lens")) * image.view, image.sensor), image,
                   one.camera.projection);
  shift_sensor(image, one.camera.projection);
}

void read_orthographic(const JsonValue& camera, const RenderedImage& image, ImportedCamera& one) {
  one.camera.projection.model = ProjectionModel::orthographic;
  set_focal_length(quotient(image.view, positive(camera.at("ortho_scale"))), image,
                   one.camera.projection);
  shift_sensor(image, one.camera.projection);
}

// Panoramas, as Cycles' functions …_to_direction() have them. Their shift counts in widths and
// heights of the image.

/// The place of 0 on a side of the image that spans the values from `first` to `last`.
Ratio place_of_zero(const Ratio& first, const Ratio& last, const Ratio& size) {
  return quotient((ratio(0) - first) * size, last - first);
}

/// The values that a side of the image spans, in degrees or in radii of a cylinder.
struct ShownRange {
  Ratio least, greatest;

  [[nodiscard]] Ratio size() const { return greatest - least; }
};

ShownRange read_range(const JsonValue& camera, const char* least, const char* greatest) {
  ShownRange span{exact_number(camera.at(least)), exact_number(camera.at(greatest))};
  if (!(span.least < span.greatest))
    camera.at(greatest).fail(std::string("expected more than ") + least);
  return span;
}

/// The horizontal span grows to the right, the vertical one upwards.
void shift_panorama(const RenderedImage& image, const ShownRange& across, const ShownRange& up,
                    Projection& projection) {
  set_principal_point(
      place_of_zero(across.least, across.greatest, image.width) - image.shift_x * image.width,
      place_of_zero(up.greatest, up.least, image.height) + image.shift_y * image.height,
      projection);
}

void read_equirectangular(const JsonValue& camera, const RenderedImage& image,
                          ImportedCamera& one) {
  const ShownRange longitude = read_range(camera, "longitude_min", "longitude_max"),
                   latitude = read_range(camera, "latitude_min", "latitude_max");
  Projection& projection = one.camera.projection;
  projection.fx = round_to_binary64(quotient(image.width * ratio(360), longitude.size()));
  projection.fy = round_to_binary64(quotient(image.height * ratio(180), latitude.size()));
  shift_panorama(image, longitude, latitude, projection);
  set_lens(one, "EQUIRECTANGULAR", {}, camera.where());
}

void read_cylinder(const JsonValue& camera, const RenderedImage& image, ImportedCamera& one) {
  const ShownRange turn = read_range(camera, "central_cylindrical_range_u_min",
                                     "central_cylindrical_range_u_max"),
                   height = read_range(camera, "central_cylindrical_range_v_min",
                                       "central_cylindrical_range_v_max");
  Projection& projection = one.camera.projection;
  projection.fx = round_to_binary64(quotient(image.width * ratio(360), turn.size()));
  projection.fy = round_to_binary64(
      quotient(image.height * positive(camera.at("central_cylindrical_radius")), height.size()));
  shift_panorama(image, turn, height, projection);
  set_lens(one, "CYLINDRICAL", {}, camera.where());
}

/// The middle of the image of a fisheye or a mirror ball.
void shift_fisheye(const RenderedImage& image, Projection& projection) {
  set_principal_point(image.width * (half() - image.shift_x),
                      image.height * (half() + image.shift_y), projection);
}

/// Rays end at half the field of view.
void end_fisheye(const JsonValue& camera, ImportedCamera& one) {
  const JsonValue angle = camera.at("fisheye_fov");
  const Ratio degrees = positive(angle);
  if (ratio(360) < degrees) angle.fail("expected an angle of at most 360 degrees");
  if (one.camera.projection.lens)
    one.camera.projection.lens->max_radius =
        round_to_binary64(affine(pi(), quotient(degrees, ratio(360)), Ratio()));
}

void read_equidistant(const JsonValue& camera, const RenderedImage& image, ImportedCamera& one) {
  const Ratio degrees = positive(camera.at("fisheye_fov"));
  const auto pixels_per_radian = [&](const Ratio& size) {
    return round_to_binary64(
        affine(reciprocal_of_pi(), quotient(size * ratio(180), degrees), Ratio()));
  };
  one.camera.projection.fx = pixels_per_radian(image.width);
  one.camera.projection.fy = pixels_per_radian(image.height);
  set_lens(one, "FISHEYE", {}, camera.where());
  shift_fisheye(image, one.camera.projection);
  end_fisheye(camera, one);
}

void read_equisolid(const JsonValue& camera, const RenderedImage& image, ImportedCamera& one) {
  set_focal_length(quotient(positive(camera.at("fisheye_lens")) * image.view, image.sensor), image,
                   one.camera.projection);
  set_lens(one, "FISHEYE_EQUISOLID", {}, camera.where());
  shift_fisheye(image, one.camera.projection);
  end_fisheye(camera, one);
}

/// θ = −(k0 + k1·r + … + k4·r⁴), r in millimetres on the sensor.
void read_polynomial(const JsonValue& camera, const RenderedImage& image, ImportedCamera& one) {
  set_focal_length(quotient(image.view, image.sensor), image, one.camera.projection);
  constexpr std::array<std::string_view, 5> parameters{"p0", "p1", "p2", "p3", "p4"};
  std::vector<LensNumber> numbers;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const std::string key = "fisheye_polynomial_k" + std::to_string(i);
    numbers.push_back({parameters[i], 0.0 - camera.at(key).number()});
  }
  set_lens(one, "FTHETA", numbers, camera.where());
  shift_fisheye(image, one.camera.projection);
  end_fisheye(camera, one);
}

void read_mirror_ball(const JsonValue& camera, const RenderedImage& image, ImportedCamera& one) {
  const Ratio quarter = half() * half();
  one.camera.projection.fx = round_to_binary64(image.width * quarter);
  one.camera.projection.fy = round_to_binary64(image.height * quarter);
  set_lens(one, "FISHEYE_EQUISOLID", {}, camera.where());
  shift_fisheye(image, one.camera.projection);
}

using ReadLens = void (*)(const JsonValue& camera, const RenderedImage& image, ImportedCamera& one);

/// A kind of camera, by its `type` or `panorama_type`.
struct BlenderKind {
  std::string_view name;
  ReadLens read;
};

constexpr std::array<BlenderKind, 2> types{
    {{"PERSP", read_perspective}, {"ORTHO", read_orthographic}}};
constexpr std::array<BlenderKind, 6> panorama_types{{{"EQUIRECTANGULAR", read_equirectangular},
                                                     {"CENTRAL_CYLINDRICAL", read_cylinder},
                                                     {"FISHEYE_EQUIDISTANT", read_equidistant},
                                                     {"FISHEYE_EQUISOLID", read_equisolid},
                                                     {"FISHEYE_LENS_POLYNOMIAL", read_polynomial},
                                                     {"MIRRORBALL", read_mirror_ball}}};

void read_blender_lens(const JsonValue& camera, ImportedCamera& one) {
  const bool is_panorama = camera.at("type").string() == "PANO";
  const JsonValue name = camera.at(is_panorama ? "panorama_type" : "type");
  const RenderedImage image = read_render(camera);
  for (const BlenderKind& kind : is_panorama ? std::span<const BlenderKind>(panorama_types) : types)
    if (kind.name == name.string()) return kind.read(camera, image, one);
  one.absence = name.where() + ": no lens model shows what a camera " +
                text::printable(name.string()) + " shows";
}

Pose read_object(const JsonValue& matrix) {
  const Pose pose = parse_matrix(matrix);
  const auto column = [&](std::size_t k) {
    return ExactVector3{pose[0][k], pose[1][k], pose[2][k]};
  };
  const auto view = view_along({column(0), column(1), column(2)}, column(3));
  if (!view) matrix.fail("the matrix is singular");
  return *view;
}

}  // namespace

std::vector<ImportedCamera> camera::parse_blender(std::string_view text, const std::string& name) {
  const text::JsonDocument document(text, name);
  std::vector<ImportedCamera> cameras;
  for (const JsonValue& camera : document.root().at("cameras").elements()) {
    cameras.push_back(
        imported_camera(camera.at("name").string(), camera.where(), [&](ImportedCamera& one) {
          one.camera.width = pixels_of(camera.at("width"));
          one.camera.height = pixels_of(camera.at("height"));
          one.camera.near = camera.at("clip_start").number();
          one.camera.far = camera.at("clip_end").number();
          one.camera.world_to_camera = read_object(camera.at("matrix_world"));
          read_blender_lens(camera, one);
        }));
  }
  if (cameras.empty()) document.root().at("cameras").fail("there is no camera");
  require_different_names(cameras, name);
  return cameras;
}

std::vector<ImportedCamera> import_blender(const std::filesystem::path& file) {
  const StandardArithmetic standard;
  return parse_blender(files::InputFile(file).text(), file.string());
}

}  // namespace fathom
