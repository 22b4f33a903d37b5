// Patterns of outputs: {index}, {name} and {stem}.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/options/output_arguments.h"
#include "fathom/failures/errors.h"
#include "tests/scratch_folder.h"

namespace fathom::app {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<Camera> named(const std::vector<std::string>& names) {
  std::vector<Camera> cameras(names.size());
  for (std::size_t i = 0; i < names.size(); ++i) cameras[i].name = names[i];
  return cameras;
}

std::vector<std::string> outputs(const std::string& pattern,
                                 const std::vector<std::string>& names) {
  return names_of_outputs("-o", pattern, named(names));
}

TEST(OutputNames, OfIndexNameAndStem) {
  EXPECT_THAT(outputs("map.exr", {""}), ElementsAre("map.exr"));
  EXPECT_THAT(outputs("{index}.exr", {"", ""}), ElementsAre("0.exr", "1.exr"));
  EXPECT_THAT(outputs("m/{index:04}.exr", {"", "b"}), ElementsAre("m/0000.exr", "m/0001.exr"));
  EXPECT_THAT(outputs("m/{name}.exr", {"images/a.jpg", "b"}),
              ElementsAre("m/images/a.jpg.exr", "m/b.exr"));
  EXPECT_THAT(outputs("m/{stem}.exr", {"./images/a.b.jpg", "b"}),
              ElementsAre("m/a.b.exr", "m/b.exr"));
  EXPECT_THAT(outputs("{stem}-{index}.exr", {"a.jpg", "b/a.jpg"}),
              ElementsAre("a-0.exr", "a-1.exr"));
  // A single camera, too, has its name.
  EXPECT_THAT(outputs("{stem}.exr", {"a.jpg"}), ElementsAre("a.exr"));
}

TEST(OutputNames, WhereTheImageLiesDoesNotMatterToItsStem) {
  EXPECT_THAT(outputs("m/{stem}.exr", {"/data/a.jpg", "../b.jpg"}),
              ElementsAre("m/a.exr", "m/b.exr"));
}

TEST(OutputNames, NamesThatLeaveTheFolderAreRefused) {
  const std::string nul("a\0b", 3);
  for (const std::string& name :
       {std::string("../a.jpg"), std::string("a/../../b.jpg"), std::string("/etc/a"),
        std::string("a/"), std::string(".."), std::string("a/."), nul})
    EXPECT_THAT(message_of<InputError>([&] { outputs("m/{name}.exr", {name}); }),
                AllOf(HasSubstr("camera 0: the name"), HasSubstr("no place below a folder")))
        << name;
  for (const char* name : {"..", "a/..", "a/", "."})
    EXPECT_THAT(message_of<InputError>([&] { outputs("m/{stem}.exr", {name}); }),
                HasSubstr("no place below a folder"))
        << name;
  // What could move a terminal's cursor is not shown.
  EXPECT_THAT(message_of<InputError>([&] { outputs("{name}.exr", {"/\x1b[2J\n"}); }),
              HasSubstr("'/?[2J?'"));
}

TEST(OutputNames, PatternsThatDoNotFitAreRefused) {
  const auto usage = [](const std::string& pattern, const std::vector<std::string>& names) {
    return message_of<UsageError>([&] { outputs(pattern, names); });
  };
  EXPECT_THAT(usage("map.exr", {"a", "b"}),
              HasSubstr("a path of 2 cameras: -o needs a pattern such as maps/{index:04}.exr"));
  EXPECT_EQ(usage("m/{stem}.exr", {"a.jpg", "c.jpg", "b/a.png"}),
            "-o: cameras 0 and 2 would both be written as m/a.exr");
  EXPECT_EQ(
      message_of<InputError>([&] {
        outputs("{stem}.exr", {"a", ""});
      }),
      "camera 1 has no name for '{stem}.exr': use {index:04}, or add \"name\" to the camera file");
}

TEST(OutputNames, UnknownFieldsAreRefusedWithThoseThereAre) {
  const std::string fields =
      "; the fields are {index}, {index:04} with leading zeros, {name} and {stem}, and {{ stands "
      "for a brace; -o mask= also has {object}";
  // Of a single camera as of a path.
  for (const std::vector<std::string>& cameras : {std::vector<std::string>{"a"}, {"a", "b"}}) {
    const auto usage = [&](const std::string& pattern) {
      return message_of<UsageError>([&] { outputs(pattern, cameras); });
    };
    EXPECT_EQ(usage("v/{stme}.exr"),
              "-o: there is no field '{stme}': did you mean '{stem}'?" + fields);
    for (const char* field : {"", "0", "stem:5", "name:9999999999", "index:", "index:x", "index:4",
                              "index:>4", "index:00", "index:04d", "index:010", "Stem!", "{x"}) {
      const std::string message = usage(std::string("{index}{") + field + "}.exr");
      EXPECT_THAT(message, ::testing::StartsWith("-o: ")) << field;
      EXPECT_THAT(message, ::testing::EndsWith(fields)) << field;
    }
    EXPECT_EQ(usage("{index}}.exr"), "-o: '{index}}.exr' has a single '}'" + fields);
    EXPECT_EQ(usage("a{index.exr"), "-o: 'a{index.exr' has a single '{'" + fields);
  }
}

TEST(OutputNames, DoubledBracesAreBraces) {
  EXPECT_THAT(outputs("{{a}}.exr", {""}), ElementsAre("{a}.exr"));
  EXPECT_THAT(outputs("{{{index}}}.exr", {"", ""}), ElementsAre("{0}.exr", "{1}.exr"));
}

}  // namespace
}  // namespace fathom::app
