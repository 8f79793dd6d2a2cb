// Scene files: every error is one line with file, line, key and the expected value; grids expand as computed by hand.

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <span>
#include <sstream>

#include "mysim/base/errors.h"
#include "mysim/scene/grid.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

// a scene with every available key; the expectations below contain its line numbers
constexpr auto whole = R"(question = "q"
parameters = "p"
[time]
duration = 1
samples = 10
step = 0.01
window = 1
tolerance = 1e-3
method = "leapfrog"
[grid]
size = [3, 4]
origin = [0, 0, 0]
u = [1, 0, 0]
v = [0, 0, 2]
mass = 1.2
[grid.stiffness]
structural = 30
shear = 20
bend = 10
[[particle]]
position = [0, 1, 0]
mass = 0.5
[[particle]]
position = [0, 2, 0]
mass = 0.5
velocity = [1, 0, 0]
[[spring]]
ends = [12, 13]
stiffness = 7
rest = 0.5
[pins]
particles = [0, 2]
[pins.motion]
amplitude = [0, 0, 0.1]
frequency = 0.5
ramp = 0.5
[gravity]
acceleration = [0, -9.81, 0]
[drag]
gamma = 1
[wind]
acceleration = [0, 0, 5]
[wind.gusts]
variation = 1
side = [1.5, 0, 0]
seed = 1
[sphere]
centre = [0, -3, 0]
radius = 1
margin = 0.02
friction = 0.5
restitution = 0.5
[camera]
eye = [0, 0, 9]
target = [0, 0, 0]
)";

/// The whole scene with one line replaced. If `text` is empty, an empty line remains, which keeps the line numbers.
std::string with_line(int number, const std::string& text) {
  std::istringstream in(whole);
  std::string out, line;
  for (int i = 1; std::getline(in, line); ++i) out += (i == number ? text : line) + "\n";
  return out;
}

TEST(SceneFile, WholeSceneIsRead) {
  const Scene s = parse_scene(whole, "whole");
  EXPECT_EQ(s.model.particles.size(), 14);
  EXPECT_EQ(s.model.terms.size(), 5u);  // springs, gravity, drag, wind, sphere
  ASSERT_TRUE(s.model.particles.move && s.camera);
  EXPECT_EQ(s.model.particles.move->amplitude, Vec3(0, 0, 0.1));
  EXPECT_EQ(s.model.find<Spheres>()->list.at(0).contact_radius(), 1.02);
  EXPECT_EQ(s.start.v.col(13), Vec3(1, 0, 0));
  EXPECT_EQ(s.model.find<Springs>()->list.back().rest, 0.5);
}

struct Fault {
  int line;                 // line of the whole scene to replace
  const char* text;         // its replacement
  const char* starts_with;  // beginning of the message
  const char* expected;     // substring of the message
};

void expect_messages(std::span<const Fault> faults) {
  for (const Fault& fault : faults) {
    SCOPED_TRACE(fmt::format("line {}: {}", fault.line, fault.text));
    const std::string message = message_of(with_line(fault.line, fault.text));
    EXPECT_TRUE(begins(message, fault.starts_with));
    EXPECT_TRUE(contains(message, fault.expected));
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(SceneFaults, UnknownKeys) {
  static constexpr Fault faults[] = {
      {1, "question = \"q\"\ncolour = 3", "bad.toml:2: colour: ", "unknown key; expected one of: "},
      {53, "[drags]\n[camera]", "bad.toml:53: drags: ", "unknown key"},
      {6, "step = 0.01\nstepp = 1", "bad.toml:7: time.stepp: ", "unknown key"},
      {15, "mass = 1.2\nmasss = 1", "bad.toml:16: grid.masss: ", "unknown key"},
      {19, "bend = 10\nbent = 1", "bad.toml:20: grid.stiffness.bent: ", "unknown key"},
      {22, "mass = 0.5\nweight = 1", "bad.toml:23: particle[0].weight: ", "unknown key"},
      {30, "rest = 0.5\nlength = 1", "bad.toml:31: spring[0].length: ", "unknown key"},
      {32, "particles = [0, 2]\nfixed = 1", "bad.toml:33: pins.fixed: ", "unknown key"},
      {36, "ramp = 0.5\nphase = 1", "bad.toml:37: pins.motion.phase: ", "unknown key"},
      {38, "acceleration = [0, 0, 0]\ng = 1", "bad.toml:39: gravity.g: ", "unknown key"},
      {40, "gamma = 1\nc = 1", "bad.toml:41: drag.c: ", "expected one of: coefficient, gamma"},
      {42, "acceleration = [0, 0, 5]\nx = 1", "bad.toml:43: wind.x: ", "unknown key"},
      {46, "seed = 1\nx = 1", "bad.toml:47: wind.gusts.x: ", "unknown key"},
      {51, "friction = 0.5\nmu = 1", "bad.toml:52: sphere.mu: ", "unknown key"},
      {55, "target = [0, 0, 0]\nzoom = 1", "bad.toml:56: camera.zoom: ", "unknown key"}};
  expect_messages(faults);
}

TEST(SceneFaults, MissingKeys) {
  static constexpr Fault faults[] = {
      {1, "", "bad.toml:1: question: ", "is missing; expected a text"},
      {2, "", "bad.toml:1: parameters: ", "is missing; expected a text"},
      {4, "", "bad.toml:3: time.duration: ", "is missing; expected a number above zero"},
      {5, "", "bad.toml:3: time.samples: ", "is missing; expected a whole number"},
      {6, "", "bad.toml:3: time.step: ", "is missing"},
      {7, "", "bad.toml:3: time.window: ", "is missing"},
      {9, "", "bad.toml:3: time.method: ", "is missing"},
      {11, "", "bad.toml:10: grid.size: ", "is missing"},
      {13, "", "bad.toml:10: grid.u: ", "is missing"},
      {17, "", "bad.toml:16: grid.stiffness.structural: ", "is missing"},
      {21, "", "bad.toml:20: particle[0].position: ", "is missing; expected three finite numbers"},
      {25, "", "bad.toml:23: particle[1].mass: ", "is missing"},
      {28, "", "bad.toml:27: spring[0].ends: ", "is missing"},
      {29, "", "bad.toml:27: spring[0].stiffness: ", "is missing"},
      {32, "", "bad.toml:31: pins.particles: ", "is missing"},
      {36, "", "bad.toml:33: pins.motion.ramp: ", "is missing"},
      {38, "", "bad.toml:37: gravity.acceleration: ", "is missing"},
      {40, "", "bad.toml:39: drag.coefficient: ", "is missing"},
      {42, "", "bad.toml:41: wind.acceleration: ", "is missing"},
      {46, "", "bad.toml:43: wind.gusts.seed: ", "is missing"},
      {49, "", "bad.toml:47: sphere.radius: ", "is missing"},
      {55, "", "bad.toml:53: camera.target: ", "is missing"}};
  expect_messages(faults);
}

TEST(SceneFaults, WrongTypes) {
  static constexpr Fault faults[] = {
      {1, "question = 3", "bad.toml:1: question: ", "expected a text in quotes, got 3"},
      {1, "question = \"\"", "bad.toml:1: question: ", "expected a text in quotes"},
      {4, "duration = \"1\"", "bad.toml:4: time.duration: ", "expected a number above zero"},
      {4, "duration = true", "bad.toml:4: time.duration: ", "expected a number above zero, got true"},
      {5, "samples = 10.5", "bad.toml:5: time.samples: ", "expected a whole number from 1"},
      {11, "size = 3", "bad.toml:11: grid.size: ", "expected a list of whole numbers"},
      {12, "origin = [0, 0]", "bad.toml:12: grid.origin: ", "expected three finite numbers [x, y, z], got [0, 0]"},
      {21, "position = [0, 1, 'x']", "bad.toml:21: particle[0].position[2]: ", "expected a finite number, got 'x'"},
      {28, "ends = [12.5, 13]", "bad.toml:28: spring[0].ends[0]: ", "expected a whole number from 0"},
      {39, "[drag.gamma]", "bad.toml:39: drag.gamma: ", "expected a number above zero"}};
  expect_messages(faults);
}

TEST(SceneFaults, NumbersOutOfRange) {
  static constexpr Fault faults[] = {
      {4, "duration = 0", "bad.toml:4: time.duration: ", "expected a number above zero, got 0"},
      {4, "duration = inf", "bad.toml:4: time.duration: ", "got inf"},
      {5, "samples = 0", "bad.toml:5: time.samples: ", "expected a whole number from 1"},
      {6, "step = nan", "bad.toml:6: time.step: ", "expected a number above zero, got nan"},
      {6, "step = 1.5", "bad.toml:6: time.step: ", "expected a step not longer than the duration"},
      {7, "window = 2", "bad.toml:7: time.window: ", "expected a window not longer than the duration"},
      {8, "tolerance = -1", "bad.toml:8: time.tolerance: ", "expected a number above zero, got -1"},
      {11, "size = [3, 1]", "bad.toml:11: grid.size: ", "expected two whole numbers from 2"},
      {11, "size = [3, 4, 5, 6]", "bad.toml:11: grid.size: ", "three (a block)"},
      {14, "v = [2, 0, 0]", "bad.toml:14: grid.v: ", "expected a side that is not parallel to u"},
      {15, "mass = 0", "bad.toml:15: grid.mass: ", "expected a number above zero, got 0"},
      {18, "shear = 0", "bad.toml:18: grid.stiffness.shear: ", "expected a number above zero"},
      {21, "position = [0, nan, 0]", "bad.toml:21: particle[0].position[1]: ", "expected a finite number, got nan"},
      {21, "position = [0, -inf, 0]", "bad.toml:21: particle[0].position[1]: ", "got -inf"},
      {22, "mass = -0.5", "bad.toml:22: particle[0].mass: ", "expected a number above zero, got -0.5"},
      {28, "ends = [12, 14]",
       "bad.toml:28: spring[0].ends[1]: ", "expected a particle from 0 to 13 (there are 14), got 14"},
      {28, "ends = [12, -1]",
       "bad.toml:28: spring[0].ends[1]: ", "expected a whole number from 0 to 100000000, got -1"},
      {28, "ends = [12, 12]", "bad.toml:28: spring[0].ends: ", "expected two different particles"},
      {29, "stiffness = 0", "bad.toml:29: spring[0].stiffness: ", "expected a number above zero"},
      {30, "rest = -1", "bad.toml:30: spring[0].rest: ", "expected a number not below zero, got -1"},
      {35, "frequency = 0", "bad.toml:35: pins.motion.frequency: ", "expected a number above zero"},
      {40, "gamma = -1", "bad.toml:40: drag.gamma: ", "expected a number above zero, got -1"},
      {46, "seed = 0", "bad.toml:46: wind.gusts.seed: ", "expected a whole number from 1"},
      {49, "radius = -1", "bad.toml:49: sphere.radius: ", "expected a number above zero"},
      {52, "restitution = 1.5", "bad.toml:52: sphere.restitution: ", "from 0 to 1"}};
  expect_messages(faults);
}

TEST(SceneFaults, Contradictions) {
  static constexpr Fault faults[] = {
      {24, "position = [0, 1, 0]", "bad.toml:28: spring[0].ends: ", "do not coincide at the start"},
      {40, "gamma = 1\ncoefficient = 2", "bad.toml:40: drag.gamma: ", "either coefficient (N s/m) or gamma (1/s)"},
      {32, "particles = [0, 14]",
       "bad.toml:32: pins.particles[1]: ", "expected a particle from 0 to 13 (there are 14), got 14"},
      {32, "particles = [2, 0, 2]", "bad.toml:32: pins.particles[2]: ", "expected each particle once, got 2 twice"},
      {32, "particles = []", "bad.toml:32: pins.particles: ", "expected at least one particle"},
      {32, "particles = [0, 13]", "bad.toml:32: pins.particles[1]: ", "particle 13 has a velocity"},
      {55, "target = [0, 0, 9]", "bad.toml:55: camera.target: ", "expected a point other than the eye"},
      {55, "target = [0, 0, 0]\nat = 1.5", "bad.toml:56: camera.at: ", "expected a time not after the end of the run"},
      {55, "target = [0, 0, 0]\nat = -1", "bad.toml:56: camera.at: ", "expected a number not below zero"},
      // 1e12 steps overflow the count, which must not wrap into a single step of a second.
      {6, "step = 1e-13", "bad.toml:6: time.step: ", "expected"}};
  expect_messages(faults);
}

TEST(SceneFaults, NotToml) {
  static constexpr Fault faults[] = {{5, "samples = = 10", "bad.toml:5: ", "not valid TOML"},
                                     {5, "samples 10", "bad.toml:5: ", "not valid TOML"}};
  expect_messages(faults);
}

TEST(SceneFaults, LinesOfBracketsAloneAreNamedLikeAnyOther) {
  EXPECT_TRUE(begins(message_of("a = 1\n[\n"), "bad.toml:2: not valid TOML: "));
  const auto repeated = [](const std::string& part) {
    std::string text;
    for (int i = 0; i < 200000; ++i) text += part;
    return text;
  };
  for (const auto& [before, part] : {std::pair("a", ".a"),
                                     {"[a", " . \"[\""},
                                     {"a = {a", ".a"},
                                     {"a = ", "{a = "},
                                     {"a = ", "["},
                                     {"a = 1", "e"},
                                     {"a = ", "_"}})
    EXPECT_TRUE(begins(message_of("b = 1\n" + (before + repeated(part)) + "\n"), "bad.toml:2: not valid TOML: "))
        << before << part;
  Random random(11);
  const std::string letters = "[]{}=\"'#.,a1 ";
  for (int trial = 0; trial < 100; ++trial) {
    std::string text;
    for (int i = 0; i < 12; ++i) {
      const auto letter = static_cast<size_t>(random.between(0, static_cast<double>(letters.size()) + 3));
      text += letter < letters.size() ? letters[letter] : '\n';
    }
    const std::string message = message_of(text);  // fails for any exception but InputError
    EXPECT_TRUE(begins(message, "bad.toml:")) << text;
    EXPECT_EQ(message.find('\n'), std::string::npos) << text;
  }
}

TEST(SceneFile, StartIsAListOfNumbersOrOfTriples) {
  const std::string scene = std::string(whole).substr(0, std::string(whole).find("[camera]"));
  std::string flat = "[start]\npositions = [", triples = flat;
  for (int i = 0; i < 14; ++i) {
    flat += fmt::format("{}, {}, 0.5, ", 0.1 * i, 3 + 0.2 * i);
    triples += fmt::format("[{}, {}, 0.5], ", 0.1 * i, 3 + 0.2 * i);
  }
  EXPECT_EQ(parse_scene(scene + flat + "]\n", "a").start.x, parse_scene(scene + triples + "]\n", "a").start.x);
  EXPECT_TRUE(contains(message_of(scene + triples.substr(0, triples.size() - 2) + ", [0, 0, 0]]\n"),
                       "start.positions: expected a list of 14 triples [x, y, z], got 15"));
  std::string bent = triples + "]\n";
  bent.replace(bent.find("0.5], "), 6, "0.5, 1], ");
  EXPECT_TRUE(contains(message_of(scene + bent), "start.positions[0]: expected three finite numbers"));
}

TEST(SceneFile, AMarginOfZeroIsNoMargin) {
  const Scene zero = parse_scene(with_line(50, "margin = 0"), "a"), none = parse_scene(with_line(50, ""), "a");
  EXPECT_EQ(zero.hash, none.hash);
  EXPECT_TRUE(contains(message_of(with_line(50, "margin = -1")), "expected a number not below zero"));
}

TEST(SceneFile, AllPinnedNothingToMoveNoParticles) {
  const std::string two =
      "[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [1, 0, 0]\nmass = 1\n";
  EXPECT_TRUE(contains(message_of(scene_text(two + "[pins]\nparticles = [0, 1]\n")),
                       "bad.toml:17: pins.particles: expected at least one particle left free"));
  EXPECT_TRUE(
      contains(message_of(scene_text("")), "particle: is missing; expected [[particle]] with position = three finite"));
  EXPECT_TRUE(contains(message_of(scene_text("particle = 3\n" + two)), "bad.toml:10: time.particle: unknown key"));
  EXPECT_TRUE(
      contains(message_of("particle = 3\n" + scene_text("")), "bad.toml:1: particle: expected tables [[particle]]"));
  EXPECT_TRUE(contains(message_of("wind = 3\n" + scene_text(two)),
                       "bad.toml:1: wind: expected a table [wind] with acceleration = three finite"));
}

TEST(SceneFile, FirstOrderScenesHaveNoMassNoForceNoGrid) {
  const std::string rotation = "[rotation]\nrate = 1\n", point = "[[particle]]\nposition = [1, 0, 0]\n";
  EXPECT_EQ(message_of(scene_text(point + rotation)), "");
  EXPECT_TRUE(contains(message_of(scene_text(point + "mass = 1\n" + rotation)),
                       "bad.toml:12: particle[0].mass: expected no mass"));
  EXPECT_TRUE(contains(message_of(scene_text(point + rotation + gravity_text)),
                       "bad.toml:14: gravity: expected no gravity with [rotation]"));
  const std::string grid =
      "[grid]\nsize = [2, 2]\norigin = [0, 0, 0]\nu = [1, 0, 0]\nv = [0, 1, 0]\nmass = 1\n"
      "stiffness = {structural = 1}\n";
  EXPECT_TRUE(contains(message_of(scene_text(grid + rotation)), "bad.toml:10: grid: expected only single particles"));
}

TEST(SceneFile, CoincidingEndsAreFineAtRestLengthZero) {
  std::string text = with_line(24, "position = [0, 1, 0]");
  text.replace(text.find("rest = 0.5"), 10, "rest = 0  ");
  EXPECT_EQ(message_of(text), "");
}

TEST(SceneFile, CannotNameAProgram) {
  std::string text = scene_text("[[particle]]\nposition = [0, 0, 0]\nmass = 1\n");
  text.replace(text.find("leapfrog"), 8, "exec:./x.sh");
  EXPECT_EQ(parse_scene(text, "s").method, "");
}

TEST(SceneFile, NameIsThatOfTheFileInAnyScript) {
  const std::string text = scene_text("[[particle]]\nposition = [0, 0, 0]\nmass = 1\n");
  const std::filesystem::path folder = testing::TempDir();
  for (const char* name : {"布料", "織物", "Größe-2", "it's"}) {
    const std::string file = folder / (std::string(name) + ".toml");
    std::ofstream(file) << text;
    EXPECT_EQ(read_scene(file).name, name == std::string("it's") ? "it-s" : name);
    std::filesystem::remove(file);
  }
  for (const char* name : {".hidden", "-x", "a\nb", "a\x1b[2J",
                           "\xe2\x80\xae"
                           "a",
                           "\xff"}) {
    const std::string file = folder / (std::string(name) + ".toml");
    std::ofstream(file) << text;
    EXPECT_THROW(read_scene(file), InputError) << name;
    std::filesystem::remove(file);
  }
}

TEST(SceneFile, MissingFilesAndFoldersAreNamed) {
  const auto folder = std::filesystem::temp_directory_path();
  for (const std::string& file : {std::string("/nowhere/at-all.toml"), folder.string()}) {
    try {
      read_scene(file);
      ADD_FAILURE() << file;
    } catch (const InputError& e) {
      EXPECT_TRUE(contains(e.what(), file + ": cannot be read; expected a scene file"));
    }
  }
}

TEST(SceneFile, ErrorsInFilesNameThePath) {
  const auto file = std::filesystem::temp_directory_path() / fmt::format("crosscheck-{}.toml", getpid());
  std::ofstream(file) << with_line(22, "mass = -0.5");
  try {
    read_scene(file);
    ADD_FAILURE();
  } catch (const InputError& e) {
    EXPECT_TRUE(contains(e.what(), file.string() + ":22: particle[0].mass: expected a number above zero"));
  }
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace crosscheck
