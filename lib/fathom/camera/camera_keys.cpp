#include "fathom/camera/camera_keys.h"

#include <algorithm>
#include <string>

#include "fathom/camera/lens_numbers.h"

namespace fathom::camera {
using text::JsonValue;

void expect_either(const JsonValue& value, std::string_view one, std::string_view other) {
  const std::string first(one), second(other);
  if (value.find(first) && value.find(second))
    value.fail("has both \"" + first + "\" and \"" + second + "\", expected one of them");
}

void read_number(const JsonValue& value, std::string_view key, double& number) {
  if (const auto member = value.find(std::string(key))) number = member->number();
}

namespace {

void read_intrinsic_matrix(const JsonValue& value, Projection& projection) {
  const std::vector<JsonValue> rows = value.elements(3);
  const std::vector<double> u = rows[0].numbers(3), v = rows[1].numbers(3), w = rows[2].numbers(3);
  if (v[0] != 0) rows[1].fail("expected 0 in the first place of K's second row");
  if (w != std::vector<double>{0, 0, 1}) rows[2].fail("expected the last row of K to be 0 0 1");
  projection.fx = u[0], projection.skew = u[1], projection.cx = u[2];
  projection.fy = v[1], projection.cy = v[2];
}

const LensModelEntry& model_of(const JsonValue& value) {
  const JsonValue name = value.at("model");
  if (const auto model = lens_model_named(name.string())) return entry_of(*model);
  name.fail(unknown_lens_model(name.string()));
}

/// Sets fx, fy, cx and cy from the model's own numbers in their order.
void set_intrinsics(const LensModelEntry& model, std::vector<double>::const_iterator number,
                    Projection& projection) {
  projection.fx = *number++;
  projection.fy = has_one_focal_length(model) ? projection.fx : *number++;
  projection.cx = *number++;
  projection.cy = *number;
}

std::vector<double> numbers_of(const JsonValue& list) {
  std::vector<double> numbers;
  for (const JsonValue& element : list.elements()) numbers.push_back(element.number());
  return numbers;
}

/// Refuses a list that has not one of the model's counts of distortion behind `before` numbers.
void require_count(const JsonValue& list, const LensModelEntry& model, std::size_t found,
                   std::size_t before) {
  if (const auto fault = distortion_count_fault(model, found, before)) list.fail(*fault);
}

void read_parameters(const JsonValue& value, const LensModelEntry& model, Projection& projection) {
  const JsonValue list = value.at("params");
  const std::vector<double> numbers = numbers_of(list);
  const std::size_t before = model.intrinsics.size();
  require_count(list, model, numbers.size(), before);
  set_intrinsics(model, numbers.begin(), projection);
  std::copy(numbers.begin() + static_cast<std::ptrdiff_t>(before), numbers.end(),
            projection.lens->distortion.begin());
}

void read_intrinsics_of_lens(const JsonValue& value, const LensModelEntry& model,
                             Projection& projection) {
  if (!has_one_focal_length(model)) return read_intrinsics(value, projection);
  for (const std::string_view name : model.intrinsics) expect_either(value, "K", name);
  if (const auto K = value.find("K")) {
    return read_intrinsic_matrix(*K, projection);
  }
  std::vector<double> numbers;
  for (const std::string_view name : model.intrinsics)
    numbers.push_back(value.at(std::string(name)).number());
  set_intrinsics(model, numbers.begin(), projection);
}

}  // namespace

void read_intrinsics(const JsonValue& value, Projection& projection) {
  for (const char* number : {"fx", "fy", "cx", "cy", "skew"}) expect_either(value, "K", number);
  if (const auto K = value.find("K")) return read_intrinsic_matrix(*K, projection);
  projection.fx = value.at("fx").number();
  projection.fy = value.at("fy").number();
  projection.cx = value.at("cx").number();
  projection.cy = value.at("cy").number();
  read_number(value, "skew", projection.skew);
}

std::vector<std::string_view> keys_of_lens(const JsonValue& value) {
  const LensModelEntry& model = model_of(value);
  if (model.model == LensModel::table)
    return {"model", "directions", "directions_sha256", "max_radius", "origins", "row_poses"};
  std::vector<std::string_view> keys{"model", "params", "K", "distortion", "max_radius"};
  keys.insert(keys.end(), model.intrinsics.begin(), model.intrinsics.end());
  if (!has_one_focal_length(model)) keys.emplace_back("skew");
  keys.insert(keys.end(), model.distortion.begin(), model.distortion.end());
  return keys;
}

bool is_table(const JsonValue& value) {
  return value.find("model") && model_of(value).model == LensModel::table;
}

void read_table(const JsonValue& value, std::uint32_t width, std::uint32_t height,
                const DirectionReader& directions, Projection& projection) {
  for (const char* later : {"origins", "row_poses"}) {
    if (const auto key = value.find(later))
      key->fail("not supported yet: all rays of a table begin at the eye of the camera");
  }
  Lens& lens = projection.lens.emplace(Lens{LensModel::table});
  read_number(value, "max_radius", lens.max_radius);
  const JsonValue file = value.at("directions");
  const auto expected = value.find("directions_sha256");
  if (!directions || file.is_null()) {
    lens.directions = std::make_shared<const DirectionTable>(
        DirectionTable::unread({.path = file.is_null() ? "" : file.string(),
                                .sha256 = expected ? expected->string() : "",
                                .reader = ""}));
    return;
  }
  lens.directions = directions(file.string(), width, height);
  if (expected && expected->string() != lens.directions->sha256()) {
    expected->fail("the file '" + file.string() + "' has the SHA-256 " + lens.directions->sha256() +
                   ", expected " + expected->string());
  }
}

void read_lens(const JsonValue& value, Projection& projection) {
  const LensModelEntry& model = model_of(value);
  Lens& lens = projection.lens.emplace(Lens{model.model});
  if (const auto radius = value.find("max_radius")) lens.max_radius = radius->number();
  for (const char* one : {"params", "distortion"})
    for (const std::string_view name : model.distortion) expect_either(value, one, name);
  expect_either(value, "params", "distortion");
  if (value.find("params")) {
    for (const std::string_view name : model.intrinsics) expect_either(value, "params", name);
    expect_either(value, "params", "K");
    read_parameters(value, model, projection);
    if (!has_one_focal_length(model)) read_number(value, "skew", projection.skew);
    return;
  }
  read_intrinsics_of_lens(value, model, projection);
  if (const auto list = value.find("distortion")) {
    const std::vector<double> numbers = numbers_of(*list);
    require_count(*list, model, numbers.size(), 0);
    std::ranges::copy(numbers, lens.distortion.begin());
    return;
  }
  for (std::size_t i = 0; i < model.distortion.size(); ++i)
    read_number(value, model.distortion[i], lens.distortion[i]);
}

}  // namespace fathom::camera
