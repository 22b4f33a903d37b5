#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <limits>
#include <string>
#include <vector>

#include "validation/child/in_child.h"
#include "validation/peers/drawing_fields.h"

/// Work in a process of its own, and what comes back from it.
namespace fathom::validation {
namespace {

using attribution::RasterModel;
using attribution::RayModel;
using testing::HasSubstr;
using testing::StartsWith;

template <class Error, class Call>
std::string message_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Child, ReturnsWhatItsWorkDoes) {
  const std::string long_text(1'000'000, 'x');
  EXPECT_EQ(in_child([&] { return long_text; }), long_text);
  EXPECT_EQ(in_child([] { return std::string(); }), "");
  EXPECT_EQ(in_child([] { return std::uint64_t{1} << 63; }), std::uint64_t{1} << 63);
  EXPECT_EQ(in_child([] { return std::vector<int>{4, -1}; }), (std::vector<int>{4, -1}));
  EXPECT_EQ(in_child([] { return std::vector<int>{}; }), std::vector<int>{});
}

TEST(Child, FailsAsItsWorkDoes) {
  const auto throwing = [](auto error) {
    return [error] { return in_child([&]() -> int { throw error; }); };
  };
  EXPECT_EQ(message_of<UsageError>(throwing(UsageError("such usage"))), "such usage");
  EXPECT_EQ(message_of<InputError>(throwing(InputError("such input"))), "such input");
  EXPECT_EQ(message_of<InputError>(throwing(std::bad_alloc())), "out of memory");
}

TEST(Child, ASignalAndATimeLimitAreFailures) {
  const auto killed = [] {
    return in_child([] { return ::raise(SIGKILL); }, {.name = "renderer"});
  };
  EXPECT_THAT(message_of<ChildFailure>(killed), StartsWith("renderer: ended by signal 9 ("));
  const auto slow = [] {
    return in_child([] { return ::pause(); }, {.name = "renderer", .seconds = 1});
  };
  EXPECT_EQ(message_of<ChildFailure>(slow), "renderer: did not end within 1 seconds");
}

/// What the parent says of an answer that is `bytes`.
std::string complaint(const std::string& bytes) {
  const std::string message =
      message_of<ChildFailure>([&] { result_from<Drawing>(bytes, "opengl"); });
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  return message;
}

Drawing some_drawing() {
  RasterModel raster{.matrix = std::array<float, 16>{1, 2, 3}, .storage = Storage::unorm16};
  raster.written = attribution::WrittenDepth{.mapping = Mapping::log_ulrich, .factor = 0.1F};
  raster.border = RasterModel::Cut::never;
  raster.bias = 1.0 / 3;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return {DrawnMap{.map = {2, 1, {0.1, infinity}, {0.25, 1}, {7, no_surface}},
                   .model = {.name = "OpenGL", .sample = {0.1, 0.9, 1e-5}, .kind = raster},
                   .version = "some driver"},
          ""};
}

TEST(Answers, AreCompleteAndExact) {
  const Drawing given = some_drawing();
  const auto drawing = result_from<Drawing>(to_bytes(answer_of([&] { return given; })), "opengl");
  ASSERT_TRUE(drawing.drawn);
  const DrawnMap& drawn = *drawing.drawn;
  EXPECT_EQ(drawn.map.width, 2U);
  EXPECT_EQ(drawn.map.depths, given.drawn->map.depths);
  EXPECT_EQ(drawn.map.windows, given.drawn->map.windows);
  EXPECT_EQ(drawn.map.triangles, given.drawn->map.triangles);
  EXPECT_EQ(drawn.version, "some driver");
  EXPECT_EQ(drawn.model.name, "OpenGL");
  EXPECT_EQ(drawn.model.sample.y, 0.9);
  const auto& raster = std::get<RasterModel>(drawn.model.kind);
  EXPECT_EQ(raster.matrix, std::get<RasterModel>(given.drawn->model.kind).matrix);
  EXPECT_EQ(raster.storage, Storage::unorm16);
  EXPECT_EQ(raster.border, RasterModel::Cut::never);
  EXPECT_EQ(raster.bias, 1.0 / 3);
  ASSERT_TRUE(raster.written);
  EXPECT_EQ(raster.written->mapping, Mapping::log_ulrich);
  EXPECT_EQ(raster.written->factor, 0.1F);
}

TEST(Answers, AreRaysToo) {
  Drawing given = some_drawing();
  given.drawn->model.kind = RayModel{.rotation_error = 0x1p-20};
  const auto drawing = from_bytes<Drawing>(to_bytes(given));
  EXPECT_EQ(std::get<RayModel>(drawing.drawn->model.kind).rotation_error, 0x1p-20);
}

TEST(Answers, NumbersAreExact) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double x : {0.0, -0.0, 0.1, 5e-324, 0x1.fffffffffffffp1023, infinity, -infinity}) {
    const auto read = from_bytes<double>(to_bytes(x));
    EXPECT_EQ(read, x);
    EXPECT_EQ(std::signbit(read), std::signbit(x));
  }
  EXPECT_TRUE(std::isnan(from_bytes<double>(to_bytes(double{NAN}))));
  for (const float x : {0.1F, 0x1p-149F, 0x1.fffffep127F}) {
    EXPECT_EQ(from_bytes<float>(to_bytes(x)), x);
  }
}

TEST(Answers, CutShortAreRefused) {
  const std::string bytes = to_bytes(answer_of([] { return some_drawing(); }));
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    ASSERT_EQ(complaint(bytes.substr(0, length)),
              "opengl: its answer is not understood: it is cut short or in another format")
        << length;
  }
}

TEST(Answers, OfOthersAreRefused) {
  const std::string understood = "opengl: its answer is not understood: ";
  EXPECT_EQ(complaint("depths: 1 2 3\n"), understood + "it is cut short or in another format");
  EXPECT_EQ(complaint(std::string(1'000'000, '\x81')),
            understood + "it is cut short or in another format");
  EXPECT_EQ(complaint(to_bytes(some_drawing())), understood + "ending is missing");
  EXPECT_EQ(complaint(to_bytes(answer_of([] { return 1; }))),
            understood + "result is not an object");
  EXPECT_EQ(complaint(to_bytes(Answer<Drawing>{})), understood + "it has no result");

  /// An answer with one thing in it exchanged.
  const auto with = [](const std::string& pointer, const nlohmann::json& value) {
    auto json = nlohmann::json::from_cbor(to_bytes(answer_of([] { return some_drawing(); })));
    json[nlohmann::json::json_pointer(pointer)] = value;
    std::string bytes;
    nlohmann::json::to_cbor(json, bytes);
    return bytes;
  };
  EXPECT_EQ(complaint(with("/result/drawn/map/width", -2)),
            understood + "result.drawn.map.width is not a whole number of its type");
  EXPECT_EQ(complaint(with("/result/drawn/map/width", 1LL << 40)),
            understood + "result.drawn.map.width is not a whole number of its type");
  EXPECT_EQ(complaint(with("/result/drawn/map/depths", nlohmann::json::binary({1, 2, 3}))),
            understood + "result.drawn.map.depths is cut short");
  EXPECT_EQ(complaint(with("/result/drawn/map/depths", {1, 2})),
            understood + "result.drawn.map.depths is not an array of numbers");
  EXPECT_EQ(complaint(with("/result/drawn/model/kind", {{"voxel", 1}})),
            understood + "result.drawn.model.kind is not one of its alternatives");
  EXPECT_EQ(complaint(with("/result/drawn/model/kind/raster/storage", "unorm8")),
            understood +
                "result.drawn.model.kind.raster.storage has none of the values that it "
                "may have");
  EXPECT_EQ(complaint(with("/result/drawn/model/kind/raster/shift", {1, 2})),
            understood + "result.drawn.model.kind.raster.shift is not a list of 3");
  EXPECT_EQ(complaint(with("/result/drawn/model/watertight", 1)),
            understood + "result.drawn.model.watertight is not true or false");
  EXPECT_EQ(complaint(with("/result/drawn/version", 3)),
            understood + "result.drawn.version is not a text");
  EXPECT_EQ(complaint(with("/result/drawn/colour", "red")),
            understood + "result.drawn has fields that are not known");
}

}  // namespace
}  // namespace fathom::validation
