// The file of blessed speeds: it comes back as it was, and each damage is named.
#include <gtest/gtest.h>

#include "experiments/regress/speed_file.h"
#include "experiments/scenes.h"
#include "mysim/errors.h"
#include "mysim/files.h"
#include "mysim/temporary_folder.h"

namespace crosscheck {
namespace {

const Machine here{"a CPU", "a compiler -O3", "a loop"};

SpeedQuestion question(const std::string& scene, const std::string& method) {
  return {load_scene(scene), find_method(method)};
}

BlessedSpeed speed_of(const SpeedQuestion& q, double ratio, double spread = 0.01) {
  return {q.scene.name, q.scene.hash, q.method.name, ratio, spread, here};
}

SpeedFile small_file() {
  SpeedFile file;
  file.blessings = {{"2026-01-02", "abc", "g++ -O3", "first"}, {"2026-01-03", "abd", "g++", "new"}};
  file.speeds = {speed_of(question("spring", "leapfrog"), 5.125), speed_of(question("chain", "rk4"), 0.5, 0.2)};
  file.speeds.push_back(file.speeds[0]);
  file.speeds[2].machine.cpu = "another, older CPU", file.speeds[2].blessing = 2;
  return file;
}

TEST(SpeedFiles, ComeBackAsTheyWere) {
  const TemporaryFolder folder("speeds");
  write_file(speed_file_in(folder.path), text_of(small_file()));
  const auto read = read_speed_file(folder.path);
  ASSERT_TRUE(read);
  EXPECT_EQ(text_of(*read), text_of(small_file()));
  EXPECT_EQ(read->speeds[0].ratio, 5.125);
  EXPECT_EQ(read->speeds[1].spread, 0.2);
  EXPECT_EQ(read->speeds[2].machine.cpu, "another, older CPU");
  EXPECT_EQ(read->blessings[1].reason, "new");
  EXPECT_EQ(find_speed(*read, question("spring", "leapfrog"), here), &read->speeds[0]);
  EXPECT_EQ(find_speed(*read, question("spring", "rk4"), here), nullptr);
  EXPECT_FALSE(read_speed_file(folder.path / "no-such"));
}

TEST(SpeedFiles, EachDamageIsNamedWithItsLine) {
  const TemporaryFolder folder("speeds");
  const std::string good = text_of(small_file());
  const struct {
    const char *right, *wrong, *says;
  } damages[] = {
      {"# blessing 2: ", "# blessing 3: ", ":3: expected a line '# blessing 2: ...'"},
      {" | first", " | ", ":2: expected DATE | COMMIT | BUILD | REASON, none of them empty"},
      {"# machine 2: ", "# machine 1: ", ":5: expected a line '# machine 2: ...'"},
      {" | a loop", " | ", ":4: expected CPU | COMPILER AND FLAGS | YARDSTICK, none of them empty"},
      {"# rows: 3", "# rows: 4", "expected 4 rows, got 3"},
      {"# rows: 3", "# rose: 3", ":6: expected a line '# rows: ...'"},
      {"scene,hash", "scenes,hash", "expected the header"},
      {",5.125,", ",nan,", "expected a finite number for the ratio, got 'nan'"},
      {",5.125,", ",-5,", "expected a ratio above zero"},
      {",5.125,0.01,", ",5.125,-0.01,", "expected a spread that is not negative"},
      {",5.125,0.01,1,", ",5.125,0.01,3,", "expected the number of a machine from 1 to 2, got 3"},
      {",5.125,0.01,1,1", ",5.125,0.01,1,0", "expected the number of a blessing from 1 to 2, got 0"},
      {",5.125,", ",5,125,", "expected 7 fields, got 8"},
      {"mysim/rk4", "", "expected a scene and a method"},
  };
  for (const auto& [right, wrong, says] : damages) {
    SCOPED_TRACE(wrong);
    std::string text = good;
    ASSERT_NE(text.find(right), std::string::npos);
    text.replace(text.find(right), std::string(right).size(), wrong);
    write_file(speed_file_in(folder.path), text);
    try {
      read_speed_file(folder.path);
      ADD_FAILURE() << "it was read";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("speed-cost.csv:"), std::string::npos) << error.what();
    }
  }
  write_file(speed_file_in(folder.path), good.substr(0, good.find("spring,")));
  EXPECT_THROW(read_speed_file(folder.path), InputError);  // no rows
  write_file(speed_file_in(folder.path), "");
  EXPECT_THROW(read_speed_file(folder.path), InputError);
}

}  // namespace
}  // namespace crosscheck
