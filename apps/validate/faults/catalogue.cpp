#include <cmath>
#include <limits>

#include "apps/validate/faults/changes.h"
#include "apps/validate/faults/fault.h"
#include "fathom/attribution/model/window_depth.h"

namespace fathom::validation {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double greatest_float = std::numeric_limits<float>::max();

using Faults = std::vector<Fault>;

Fault changed(const char* group, const char* name, std::vector<std::string> kinds,
              MapChange change) {
  return {.group = group, .name = name, .kinds = std::move(kinds), .changed = std::move(change)};
}

Fault sized(const char* group, const char* name, std::vector<std::string> kinds, double probe,
            const char* unit, MapChange change) {
  Fault fault = changed(group, name, std::move(kinds), std::move(change));
  fault.probe = probe;
  fault.unit = unit;
  return fault;
}

Fault drawn(const char* name, std::vector<std::string> kinds, double probe, const char* unit,
            CameraChange change) {
  return {.group = "camera",
          .name = name,
          .kinds = std::move(kinds),
          .drawn = with_camera(std::move(change)),
          .probe = probe,
          .unit = unit};
}

void add_backgrounds(Faults& faults) {
  const auto add = [&](const char* name, MapChange change) {
    faults.push_back(changed("background", name, {"background"}, std::move(change)));
  };
  add("the far plane's depth", background_of([](const Camera& c) { return c.far; }));
  add("0", background_as(0));
  add("−1", background_as(-1));
  add("NaN", background_as(nan));
  add("65504", background_as(65504));
  add("65535", background_as(65535));
  add("1e10", background_as(1e10));
  add("the greatest binary32", background_as(greatest_float));
}

MapChange multiples(double step, bool down) {
  return each_depth([step, down](double d, double, const Camera&) {
    return step * (down ? std::floor(d / step) : std::nearbyint(d / step));
  });
}

MapChange window_codes(int bits) {
  return each_depth([bits](double d, double, const Camera& c) {
    const double codes = std::ldexp(1.0, bits) - 1;
    return from_window(std::nearbyint(to_window(d, c.near, c.far) * codes) / codes, c.near, c.far);
  });
}

MapChange linear_codes(int bits) {
  return each_depth([bits](double d, double, const Camera& c) {
    const double codes = std::ldexp(1.0, bits) - 1, range = c.far - c.near;
    return c.near + range * std::nearbyint((d - c.near) / range * codes) / codes;
  });
}

void add_storages(Faults& faults) {
  const auto add = [&](const char* name, MapChange change) {
    faults.push_back(changed("storage", name, {"storage"}, std::move(change)));
  };
  add("half floats", each_depth([](double d, double, const Camera&) {
        return attribution::round_to_binary16(d);
      }));
  add("thousandths", multiples(1e-3, false));
  add("thousandths, rounded down", multiples(1e-3, true));
  add("hundredths", multiples(1e-2, false));
  add("1/256", multiples(1.0 / 256, false));
  add("1/5000", multiples(1.0 / 5000, false));
  add("window depths in 16 bits", window_codes(16));
  add("window depths in 12 bits", window_codes(12));
  add("window depths in 8 bits", window_codes(8));
  add("16 bits from near to far", linear_codes(16));
  add("8 bits from near to far", linear_codes(8));
  faults.push_back(sized("storage", "multiples of a step", {"storage"}, 1e-4, "scene units",
                         each_depth([](double d, double size, const Camera&) {
                           return size * std::nearbyint(d / size);
                         })));
}

MapChange times(double factor) {
  return each_depth([factor](double d, double, const Camera&) { return factor * d; });
}

void add_units(Faults& faults) {
  const auto add = [&](const char* name, MapChange change) {
    faults.push_back(changed("units", name, {"scale"}, std::move(change)));
  };
  add("millimetres for metres", times(1000));
  add("centimetres for metres", times(100));
  add("metres for millimetres", times(0.001));
  add("inches for metres", times(1 / 0.0254));
  add("negative", times(-1));
  add("whole millimetres",
      both(each_depth([](double d, double, const Camera&) { return std::nearbyint(1000 * d); }),
           background_as(0)));
  faults.push_back(
      sized("units", "scale", {"scale"}, 1e-4, "of the depth",
            each_depth([](double d, double size, const Camera&) { return d * (1 + size); })));
  faults.push_back(
      sized("units", "offset", {"scale"}, 1e-4, "scene units",
            each_depth([](double d, double size, const Camera&) { return d + size; })));
}

void add_decodings(Faults& faults) {
  const auto add = [&](const char* name, std::function<double(double, const Camera&)> f) {
    faults.push_back(changed(
        "decoding", name, {"decoding"},
        each_depth([f = std::move(f)](double d, double, const Camera& c) { return f(d, c); })));
  };
  add("near and far of others", [](double d, const Camera& c) {
    return from_window(to_window(d, c.near, c.far), 0.8 * c.near, 1.5 * c.far);
  });
  add("window depths, not decoded",
      [](double d, const Camera& c) { return to_window(d, c.near, c.far); });
  add("z of −1 to 1, not decoded",
      [](double d, const Camera& c) { return 2 * to_window(d, c.near, c.far) - 1; });
  add("reversed window depths, not decoded",
      [](double d, const Camera& c) { return 1 - to_window(d, c.near, c.far); });
  add("codes of 8 bits, not decoded", [](double d, const Camera& c) {
    return std::nearbyint(255 * to_window(d, c.near, c.far)) / 255;
  });
  add("codes of 16 bits, not decoded", [](double d, const Camera& c) {
    return std::nearbyint(65535 * to_window(d, c.near, c.far)) / 65535;
  });
  add("disparities", [](double d, const Camera&) { return 1 / d; });
  add("logarithmic, not decoded",
      [](double d, const Camera& c) { return std::log(d / c.near) / std::log(c.far / c.near); });
  faults.push_back(changed("decoding", "0 at near to 1 at far", {"decoding", "scale"},
                           each_depth([](double d, double, const Camera& c) {
                             return (d - c.near) / (c.far - c.near);
                           })));
  faults.push_back(
      changed("decoding", "as parts of far", {"scale", "decoding"},
              each_depth([](double d, double, const Camera& c) { return d / c.far; })));
  faults.push_back(
      changed("decoding", "distances along the rays", {"ray-distance"}, ray_distances()));
  const auto add_plane = [&](const char* name, bool is_near) {
    Fault fault = sized("decoding", name, {"decoding"}, 1e-4, "relative",
                        each_depth([is_near](double d, double size, const Camera& c) {
                          return from_window(to_window(d, c.near, c.far),
                                             is_near ? c.near * (1 + size) : c.near,
                                             is_near ? c.far : c.far * (1 + size));
                        }));
    fault.raster_only = true;
    faults.push_back(fault);
  };
  add_plane("near of another", true);
  add_plane("far of another", false);
  Fault bias = sized("decoding", "bias of window depths", {"bias"}, 1e-6, "of the window depth",
                     each_depth([](double d, double size, const Camera& c) {
                       return from_window(to_window(d, c.near, c.far) + size, c.near, c.far);
                     }));
  bias.raster_only = true;
  faults.push_back(bias);
}

void add_cameras(Faults& faults) {
  using V = std::array<double, 3>;
  faults.push_back(
      drawn("focal length", {"focal-length"}, 1e-4, "relative",
            [](Camera& c, double s) { c.projection.fx *= 1 + s, c.projection.fy *= 1 + s; }));
  faults.push_back(drawn("horizontal focal length", {"aspect"}, 1e-4, "relative",
                         [](Camera& c, double s) { c.projection.fx *= 1 + s; }));
  faults.push_back(drawn("vertical focal length", {"aspect"}, 1e-4, "relative",
                         [](Camera& c, double s) { c.projection.fy *= 1 + s; }));
  const auto add_pose = [&](const char* name, const char* kind, const char* unit, V turn, V move) {
    faults.push_back(drawn(name, {kind}, 1e-4, unit, [turn, move](Camera& c, double s) {
      turn_and_move(c, {s * turn[0], s * turn[1], s * turn[2]},
                    {s * move[0], s * move[1], s * move[2]});
    }));
  };
  add_pose("pitch", "rotation", "rad", {1, 0, 0}, {});
  add_pose("yaw", "rotation", "rad", {0, 1, 0}, {});
  add_pose("roll", "rotation", "rad", {0, 0, 1}, {});
  add_pose("rotation", "rotation", "rad", {0.5, -0.7, 0.4}, {});
  add_pose("position to the right", "translation", "scene units", {}, {1, 0, 0});
  add_pose("position downwards", "translation", "scene units", {}, {0, 1, 0});
  add_pose("position forwards", "translation", "scene units", {}, {0, 0, 1});
  add_pose("position", "translation", "scene units", {}, {0.5, -0.7, 0.4});
  add_pose("pose", "pose", "rad and scene units", {0.5, -0.7, 0.8}, {-0.6, 0.5, 0.7});
  faults.push_back(drawn("principal point, horizontally", {"shift"}, 0.01, "pixels",
                         [](Camera& c, double s) { c.projection.cx += s; }));
  faults.push_back(drawn("principal point, vertically", {"shift"}, 0.01, "pixels",
                         [](Camera& c, double s) { c.projection.cy += s; }));
  faults.push_back(drawn("principal point", {"shift"}, 0.01, "pixels", [](Camera& c, double s) {
    c.projection.cx += s, c.projection.cy -= 0.7 * s;
  }));
  faults.push_back(
      drawn("skew", {"skew"}, 0.01, "pixels", [](Camera& c, double s) { c.projection.skew += s; }));
}

void add_images(Faults& faults) {
  const auto add = [&](const char* name, const char* kind, MapChange change) {
    faults.push_back(changed("image", name, {kind}, std::move(change)));
  };
  add("half a pixel off", "shift", nullptr);
  faults.back().changed = nullptr;
  faults.back().drawn =
      with_camera([](Camera& c, double) { c.projection.cx += 0.5, c.projection.cy += 0.5; });
  add("one column off", "shift", moved_by(1, 0));
  add("one row off", "shift", moved_by(0, -1));
  add("three columns and two rows off", "shift", moved_by(-3, 2));
  add("columns in reverse", "mirrored", mirrored(true, false));
  add("rows in reverse", "mirrored", mirrored(false, true));
  add("turned by half", "mirrored", mirrored(true, true));
  add("means of 3 × 3 pixels", "mixed", averaged(3));
  add("means of 2 × 2 pixels", "mixed", averaged(2));
  add("lower half lost", "lost-rows", lines_as(true, 0.5, 1, infinity));
  add("one row of other values", "lost-rows", line_as(true, 0.5, 7));
  add("one column of other values", "lost-columns", line_as(false, 0.5, 7));
}

void add_surfaces(Faults& faults) {
  const auto add = [&](const char* name, const char* kind,
                       std::function<ValidationScene(const ValidationScene&, double)> drawn) {
    faults.push_back(
        {.group = "surfaces", .name = name, .kinds = {kind}, .drawn = std::move(drawn)});
  };
  add("one triangle missing", "missing-triangle", without_triangles(1));
  add("ten triangles missing", "missing-triangle", without_triangles(10));
  add("triangles that face the camera culled", "culling", without_facing_triangles());
  faults.push_back(
      changed("surfaces", "near plane too far away", {"clipped"}, clipped_at(true, 0.3)));
  faults.push_back(changed("surfaces", "far plane too near", {"clipped"}, clipped_at(false, 0.7)));
  faults.push_back(changed("surfaces", "depth linear in the image", {"affine"}, affine_depths()));
  faults.back().raster_only = true;
}

void add_pixels(Faults& faults) {
  const auto add = [&](const char* name, MapChange change) {
    faults.push_back(changed("pixels", name, {"isolated-pixels"}, std::move(change)));
  };
  add("one hole", some_pixels(1, [](double) { return infinity; }));
  add("one pixel 1 % farther", some_pixels(1, [](double d) { return 1.01 * d; }));
  add("one pixel of 0", some_pixels(1, [](double) { return 0.0; }));
  add("one pixel of NaN", some_pixels(1, [](double) { return nan; }));
  add("five pixels 10 % nearer", some_pixels(5, [](double d) { return 0.9 * d; }));
  add("0.2 % of the pixels 10 % farther", share_of_pixels(0.002, [](double d) { return 1.1 * d; }));
}

}  // namespace

std::vector<Fault> fault_catalogue() {
  Faults faults;
  add_backgrounds(faults);
  add_storages(faults);
  add_units(faults);
  add_decodings(faults);
  add_cameras(faults);
  add_images(faults);
  add_surfaces(faults);
  add_pixels(faults);
  return faults;
}

}  // namespace fathom::validation
