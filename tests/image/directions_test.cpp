// Tables of directions in files.
#include "fathom/image/directions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "fathom/failures/errors.h"
#include "fathom/files/file_bytes.h"
#include "fathom/files/input_file.h"
#include "fathom/files/sha256.h"
#include "fathom/image/map_files.h"
#include "tests/image/run_program.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using checks::run;
using ::testing::HasSubstr;

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

/// 3×2 directions, two of which are no rays.
DirectionTable table() {
  return {3, 2, {0.1, -0.0, 1, 1e-300, 5e-324, 1, 0, 0, 0, NaN, 1, 1, -1, 1e300, 2, 3, -4, 0.5}};
}

/// The same of binary32 numbers.
DirectionTable binary32_table() {
  return {3, 2, {0.5, -0.0, 1, 0.25, 3, 1, 0, 0, 0, NaN, 1, 1, -1, 1e30F, 2, 3, -4, 0.5}};
}

class DirectionFiles : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path path(const std::string& name) const {
    return folder_.path() / name;
  }
  [[nodiscard]] DirectionTable read(const std::string& name) const {
    return read_directions(path(name), 3, 2, name);
  }
  [[nodiscard]] std::string fault(const std::string& name, std::uint32_t width = 3) const {
    return message_of<InputError>([&] { read_directions(path(name), width, 2, name); });
  }
  void write(const std::string& name, const std::string& text) const { folder_.write(name, text); }
  void write_table(const std::string& name, const DirectionTable& directions,
                   DirectionChannels channels = DirectionChannels::array) const {
    WriteOptions options;
    if (channels == DirectionChannels::array) options.channel = "directions";
    write_map(map_of_directions(directions, channels), path(name), *map_format_of(name), options);
  }
  /// What numpy makes of a script, in the folder.
  void run_numpy(const std::string& script) const {
    write("script.py", "import numpy as np\n" + script);
    const auto outcome = run("cd '" + folder_.path().string() + "' && /usr/bin/python3 script.py");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
  }

 private:
  ScratchFolder folder_;
};

TEST_F(DirectionFiles, KeepEveryBit) {
  write_table("a.npy", table());
  write_table("a.npz", table());
  write("a.csv", csv_of_directions(table()));
  for (const char* name : {"a.npy", "a.npz", "a.csv"}) {
    const DirectionTable again = read(name);
    EXPECT_EQ(again, table()) << name;
    EXPECT_EQ(again.source().path, name);
    EXPECT_EQ(again.sha256(), files::sha256(files::InputFile(path(name)).bytes()));
  }
  write_table("a.exr", binary32_table(), DirectionChannels::exr);
  EXPECT_EQ(read("a.exr"), binary32_table());
}

TEST_F(DirectionFiles, AreThoseOfNumpy) {
  run_numpy(
      "d = np.array([0.5,-0.0,1, 0.25,3,1, 0,0,0, np.nan,1,1, -1,np.float32(1e30),2, 3,-4,0.5])"
      ".reshape(2, 3, 3)\n"
      "np.save('c8.npy', d)\n"
      "np.save('f8.npy', np.asfortranarray(d))\n"
      "np.save('big.npy', d.astype('>f8'))\n"
      "np.save('c4.npy', d.astype(np.float32))\n"
      "np.savez('plain.npz', directions=d, origins=np.zeros(3))\n"
      "np.savez_compressed('packed.npz', directions=d.astype(np.float32))\n"
      "np.savetxt('plain.csv', d.reshape(-1, 3), delimiter=',')\n"
      "np.savetxt('named.csv', d.reshape(-1, 3), delimiter=', ', header='x,y,z', comments='',"
      " newline='\\r\\n')\n");
  for (const char* name : {"c8.npy", "f8.npy", "big.npy", "c4.npy", "plain.npz", "packed.npz",
                           "plain.csv", "named.csv"}) {
    EXPECT_EQ(read(name), binary32_table()) << name;
  }
}

TEST_F(DirectionFiles, AreRefusedWhereTheyAreOfAnotherForm) {
  run_numpy(
      "np.save('flat.npy', np.ones((2, 3)))\n"
      "np.save('four.npy', np.ones((2, 3, 4)))\n"
      "np.save('whole.npy', np.ones((2, 3, 3), np.uint16))\n"
      "np.save('infinite.npy', np.full((2, 3, 3), np.inf))\n"
      "np.savez('other.npz', rays=np.ones((2, 3, 3)))\n");
  EXPECT_THAT(fault("flat.npy"), HasSubstr("flat.npy: has 1 number for each pixel, expected"));
  EXPECT_THAT(fault("four.npy"), HasSubstr("has 4 numbers for each pixel"));
  EXPECT_THAT(fault("whole.npy"), HasSubstr("has integers, expected directions of binary32 or"));
  EXPECT_THAT(fault("infinite.npy"), HasSubstr("column 0, row 0 has an infinite component"));
  EXPECT_THAT(fault("other.npz"), HasSubstr("has no array 'directions', but rays"));
  write_table("a.npy", table());
  EXPECT_THAT(fault("a.npy", 4),
              HasSubstr("directions of 3x2 pixels, expected the size of the image, 4x2"));
  const files::InputFile whole(path("a.npy"));
  write("cut.npy", std::string(whole.text().substr(0, whole.text().size() - 1)));
  EXPECT_THAT(fault("cut.npy"), HasSubstr("truncated or overlong NPY file"));
  DepthMap map = map_of_directions(binary32_table(), DirectionChannels::exr);
  map.channels.pop_back();
  write_map(map, path("xy.exr"), MapFormat::exr);
  EXPECT_THAT(fault("xy.exr"),
              HasSubstr("has no channel d.Z, expected directions in d.X, d.Y and"));
  EXPECT_THAT(fault("missing.npy"), HasSubstr("missing.npy"));
}

TEST_F(DirectionFiles, NameTheLineOfACsvThatIsWrong) {
  const std::string row = "0,0,1\n";
  const auto fault_of = [&](const std::string& text) {
    write("a.csv", text);
    return fault("a.csv");
  };
  EXPECT_THAT(fault_of("x,y,z\n" + row + "0,1\n"),
              HasSubstr("a.csv: line 3: expected x,y,z, found 2"));
  EXPECT_THAT(fault_of(row + "0,,1\n"), HasSubstr("line 2: expected a number, found ''"));
  EXPECT_THAT(fault_of(row + "0,a,1\n"), HasSubstr("line 2: expected a number, found 'a'"));
  EXPECT_THAT(fault_of(row + "0,1e999,1\n"), HasSubstr("line 2: '1e999' is beyond the largest"));
  EXPECT_THAT(fault_of(row + "0,inf,1\n"), HasSubstr("line 2: 'inf' is beyond the largest"));
  EXPECT_THAT(fault_of(row + row), HasSubstr("has 2 directions, expected one for each of the 6"));
  EXPECT_THAT(fault_of(row + row + row + row + row + row + row),
              HasSubstr("line 7: more than the 6"));
  EXPECT_THAT(fault_of(""), HasSubstr("has 0 directions"));
}

TEST_F(DirectionFiles, LieNextToTheCameraFileAndWithinTheBoundaries) {
  std::filesystem::create_directory(path("cameras"));
  write_table("cameras/a.npy", table());
  write_table("b.npy", table());
  const auto reader = directions_beside(path("cameras/camera.json"));
  EXPECT_EQ(*reader("a.npy", 3, 2), table());
  EXPECT_EQ(reader("a.npy", 3, 2), reader("a.npy", 3, 2));  // read once
  EXPECT_EQ(*reader("../b.npy", 3, 2), table());
  const auto confined = directions_beside(path("cameras/camera.json"), path("cameras"));
  EXPECT_EQ(*confined("a.npy", 3, 2), table());
  EXPECT_THAT(message_of<InputError>([&] { confined("../b.npy", 3, 2); }),
              HasSubstr("lies outside"));
}

}  // namespace
}  // namespace fathom
