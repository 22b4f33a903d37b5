#include "fathom/image/directions.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/files/sha256.h"
#include "fathom/image/files/map_codecs.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/counted.h"
#include "fathom/text/csv.h"
#include "fathom/text/decimal.h"
#include "fathom/text/printable.h"

namespace fathom::image {
using namespace text;

namespace {

bool is_nan(std::string_view field) {
  return field == "nan" || field == "NaN" || field == "NAN";
}

/// The line of a heading, as far as a file has one.
bool is_heading(const std::vector<std::string_view>& fields) {
  return std::ranges::all_of(fields, [](std::string_view field) {
    return !field.empty() && !is_nan(field) &&
           parse_decimal<double>(field.data(), field.data() + field.size()).fault ==
               DecimalFault::malformed;
  });
}

double number_of(std::string_view field, const CsvReader& csv) {
  if (is_nan(field)) return std::numeric_limits<double>::quiet_NaN();
  const char* const end = field.data() + field.size();
  const DecimalResult<double> result = parse_decimal<double>(field.data(), end);
  if (result.fault == DecimalFault::overflow || result.fault == DecimalFault::not_finite)
    csv.fail("'" + printable(std::string(field)) +
             "' is beyond the largest binary64 number, expected finite numbers");
  if (result.fault != DecimalFault::none || result.end != end)
    csv.fail("expected a number, found '" + printable(std::string(field)) + "'");
  return result.value;
}

/// The numbers of a CSV file with a line `x,y,z` for each of `pixels` pixels, the first of which
/// may be a heading. Numbers are decimals, rounded once, or "nan". `name` is the file's for
/// messages.
/// Fails    InputError "NAME: line N: …".
std::vector<double> numbers_of_csv(std::string_view text, std::uint64_t pixels,
                                   const std::string& name) {
  CsvReader csv(text, name);
  std::vector<double> numbers;
  // A line has at least 6 characters.
  numbers.reserve(3 * std::min<std::uint64_t>(pixels, text.size() / 5 + 1));
  bool may_be_heading = true;
  while (csv.next_line()) {
    const std::vector<std::string_view> fields = csv.fields();
    if (std::exchange(may_be_heading, false) && is_heading(fields)) continue;
    if (fields.size() != 3) csv.fail("expected x,y,z, found " + counted(fields.size(), "field"));
    if (numbers.size() == 3 * pixels)
      csv.fail("more than the " + std::to_string(pixels) +
               " directions of the image, expected one line for each pixel");
    for (const std::string_view field : fields) numbers.push_back(number_of(field, csv));
  }
  if (numbers.size() != 3 * pixels)
    throw InputError(name + ": has " + counted(numbers.size() / 3, "direction") +
                     ", expected one for each of the " + std::to_string(pixels) +
                     " pixels of the image");
  return numbers;
}

}  // namespace
}  // namespace fathom::image

namespace fathom {
using namespace files;
using namespace image;

namespace {

constexpr std::array exr_names{"d.X", "d.Y", "d.Z"};
constexpr const char* array_name = "directions";

/// The numbers of three channels of one size, pixel by pixel.
std::vector<double> interleaved(const std::array<const ImageChannel*, 3>& channels,
                                const std::string& name) {
  std::vector<double> numbers;
  for (std::size_t k = 0; k < 3; ++k) {
    std::visit(
        [&](const auto& values) {
          using Value = typename std::decay_t<decltype(values)>::value_type;
          if constexpr (!std::is_floating_point_v<Value>) {
            throw InputError(name + ": has integers, expected directions of binary32 or binary64");
          } else {
            numbers.resize(3 * values.size());
            for (std::size_t i = 0; i < values.size(); ++i) numbers[3 * i + k] = values[i];
          }
        },
        channels[k]->values);
  }
  return numbers;
}

std::vector<double> numbers_of_exr(const DepthMap& map, const std::string& name) {
  std::array<const ImageChannel*, 3> channels{};
  for (std::size_t k = 0; k < 3; ++k) {
    channels[k] = map.find(exr_names[k]);
    if (!channels[k])
      throw InputError(name + ": has no channel " + exr_names[k] +
                       ", expected directions in d.X, d.Y and d.Z");
  }
  return interleaved(channels, name);
}

std::vector<double> numbers_of_array(const DepthMap& map, const std::string& name) {
  if (map.channels.size() != 3)
    throw InputError(name + ": has " + text::counted(map.channels.size(), "number") +
                     " for each pixel, expected directions, 3 numbers");
  return interleaved({&map.channels[0], &map.channels[1], &map.channels[2]}, name);
}

void require_image_size(const DepthMap& map, std::uint32_t width, std::uint32_t height,
                        const std::string& name) {
  if (map.width == width && map.height == height) return;
  throw InputError(name + ": directions of " + std::to_string(map.width) + "x" +
                   std::to_string(map.height) + " pixels, expected the size of the image, " +
                   std::to_string(width) + "x" + std::to_string(height));
}

std::vector<double> read_numbers(const InputFile& file, std::uint32_t width, std::uint32_t height,
                                 const std::string& name) {
  const ByteView bytes = file.bytes();
  const std::string_view text = file.text();
  if (text.starts_with("\x76\x2f\x31\x01")) {
    const DepthMap map = decode_exr(bytes, name);
    require_image_size(map, width, height, name);
    return numbers_of_exr(map, name);
  }
  const bool is_npz = text.starts_with("PK");
  if (is_npz || text.starts_with("\x93NUMPY")) {
    const DepthMap map =
        is_npz ? decode_npz_array(bytes, array_name, name, {}) : decode_npy(bytes, name);
    require_image_size(map, width, height, name);
    return numbers_of_array(map, name);
  }
  return numbers_of_csv(text, std::uint64_t{width} * height, name);
}

}  // namespace

DirectionTable read_directions(const std::filesystem::path& path, std::uint32_t width,
                               std::uint32_t height, const std::string& name,
                               const std::filesystem::path& confine) {
  const StandardArithmetic standard;
  const InputFile file(path, boundaries_of(confine));
  std::vector<double> numbers = read_numbers(file, width, height, path.string());
  file.expect_unchanged();
  return {width, height, std::move(numbers), {name, sha256(file.bytes()), ""}};
}

DirectionReader directions_beside(const std::filesystem::path& camera_file,
                                  const std::filesystem::path& confine) {
  using Key = std::tuple<std::string, std::uint32_t, std::uint32_t>;
  using Tables = std::map<Key, std::shared_ptr<const DirectionTable>>;
  const auto tables = std::make_shared<Tables>();
  const std::filesystem::path folder = folder_of_input(camera_file);
  return [=](const std::string& file, std::uint32_t width, std::uint32_t height) {
    std::shared_ptr<const DirectionTable>& table = (*tables)[{file, width, height}];
    if (!table) {
      table = std::make_shared<const DirectionTable>(
          read_directions(folder / file, width, height, file, confine));
    }
    return table;
  };
}

DepthMap map_of_directions(const DirectionTable& table, DirectionChannels channels) {
  DepthMap map;
  map.width = table.width();
  map.height = table.height();
  const auto component = [&]<class Value>(std::size_t k, Value) {
    Samples<Value> values(table.numbers().size() / 3);
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = static_cast<Value>(table.numbers()[3 * i + k]);
    return values;
  };
  for (std::size_t k = 0; k < 3; ++k) {
    if (channels == DirectionChannels::exr) {
      map.channels.push_back({exr_names[k], component(k, float{})});
    } else {
      map.channels.push_back(
          {std::string(array_name) + "." + std::to_string(k), component(k, double{})});
    }
  }
  return map;
}

std::string csv_of_directions(const DirectionTable& table) {
  const StandardArithmetic standard;
  std::string text = "x,y,z\n";
  const auto numbers = table.numbers();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    text += text::shortest_decimal(numbers[i]);
    text += i % 3 == 2 ? '\n' : ',';
  }
  return text;
}

}  // namespace fathom
