// The program as people and scripts call it: exit statuses, messages of one line, files, and the same bytes twice.
#include <algorithm>

#include "tests/unit/cli.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

TEST_F(Cli, BadInputExitsWith2AndOneHelpfulLine) {
  const std::string good = own_scene;
  // a faulty copy of the scene, and the place of its fault as a message names it: "FILE:LINE:"
  auto with = [&](const std::string& name, const std::string& from, const std::string& to, const std::string& fault) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(text.find(fault)), '\n');
    return std::pair{write(name, text).string(), name + ":" + std::to_string(line) + ":"};
  };
  const auto [unknown_key, unknown_key_at] =
      with("unknown-key.toml", "[gravity]", "[gravity]\nstrength = 3", "strength");
  const auto [ghost, ghost_at] = with("ghost.toml", "ends = [1, 2]", "ends = [1, 7]", "ends = [1, 7]");
  const auto [negative, negative_at] = with("negative.toml", "mass = 0.5", "mass = -0.5", "mass = -0.5");
  const auto [not_a_number, not_a_number_at] = with("nan.toml", "mass = 0.5", "mass = nan", "mass = nan");
  const auto [inside, inside_at] =
      with("inside.toml", "[gravity]", "[sphere]\ncentre = [0.3, -0.9, 0]\nradius = 0.2\n[gravity]", "radius = 0.2");
  write("a-file", "");
  struct Row {
    std::vector<std::string> words;
    std::vector<std::string> expected;  // parts of the message
  };
  const Row table[] = {
      {{"run", unknown_key}, {unknown_key_at, "gravity.strength", "unknown key", "acceleration"}},
      {{"run", ghost}, {ghost_at, "spring[1].ends[1]", "a particle from 0 to 2", "7"}},
      {{"run", negative}, {negative_at, "particle[1].mass", "above zero", "-0.5"}},
      {{"run", not_a_number}, {not_a_number_at, "particle[1].mass", "nan"}},
      {{"run", inside}, {inside_at, "sphere.radius", "no particle inside", "particle 2"}},
      {{"run", "missing.toml"}, {"missing.toml", "cannot be read"}},
      {{"run", "no-such-scene"}, {"no-such-scene", "cloth-hang"}},
      {{"run", "chain", "--method", "rk5"}, {"rk5", "mysim/rk4"}},
      {{"run", "chain", "--method", "bullet/pbd+n=0"}, {"+n=0", "+n=1"}},
      {{"run", "chain", "--tol", "1e-6"}, {"--tol", "fixed-step"}},
      {{"run", "chain", "--method", "dopri5", "--step", "1e-3"}, {"--step", "mysim/dopri5", "--tol"}},
      {{"run", "chain", "--step", "-1"}, {"--step", "above zero", "-1"}},
      {{"run", "chain", "--step", "nan"}, {"--step", "finite", "nan"}},
      {{"run", "chain", "--duration", "inf"}, {"--duration", "finite", "inf"}},
      {{"render", "chain", "-o", "p.png", "--mode", "difference", "--methods", "rk4"}, {"difference", "two methods"}},
      {{"run", "chain", "--step", "9"}, {"--step", "duration"}},
      {{"run", "chain", "--out", "a-file/below"}, {"--out a-file/below", "folder"}},
      {{"run"}, {"SCENE"}},
      {{"compare", "chain", "--methods", "rk4,nothing"}, {"nothing"}},
      {{"compare", "chain", "--out", "a-file"}, {"--out a-file"}},
      {{"experiment", "no-such-experiment"}, {"no-such-experiment", "order"}},
      {{"experiment", "order", "no-such-scene"}, {"no-such-scene"}},
      {{"report", "no-such-scene"}, {"no-such-scene"}},
      {{"report", "chain", "circle", "chain"}, {"chain", "twice"}},
      {{"report", "chain", "--quick", "--full"}, {"--full"}},
      {{"report", "chain", "--out", "a-file"}, {"--out a-file"}},
      {{"render", "chain", "-o", "picture.gif"}, {"picture.gif", ".png or .mp4"}},
      {{"render", "chain", "-o", "c.mp4", "--at", "1"}, {"--at 1", "none for a clip"}},
      {{"render", "chain", "-o", "c.mp4", "--mode", "strip"}, {"--mode strip", "shaded, stretch", "clip"}},
      {{"render", "chain", "-o", "c.mp4", "--size", "321x180"}, {"--size 321x180", "even"}},
      {{"render", "chain", "-o", "c.mp4", "--quality", "best"}, {"--quality best", "fast or still"}},
      {{"render", "chain", "-o", "p.png", "--mode", "x-ray"}, {"x-ray", "stretch"}},
      {{"render", "chain", "-o", "p.png", "--size", "12"}, {"--size 12"}},
      {{"render", "chain", "-o", "p.png", "--size", "64x64", "--mode", "stretch"},
       {"64 x 64 pixels", "3 x 1 panels", "larger --size"}},
      {{"render", "chain", "-o", "p.png", "--at", "99"}, {"--at 99"}},
      {{"render", "chain", "-o", "a-file/p.png"}, {"a-file"}},
      {{"figures", "no-such-figure"}, {"no-such-figure", "SCENE-picture", "order"}},
      {{"figures", "no-such-picture"}, {"no-such", "cloth-hang"}},
      {{"figures", "chain-picture", "--scene", "circle"}, {"chain-picture", "--scene", "circle-picture"}},
      {{"figures", "order", "order"}, {"order", "once"}},
      {{"figures", "order", "--width", "3cm"}, {"--width 3cm", "4cm to 100cm"}},
      {{"figures", "order", "--set", "poster"}, {"--set poster", "paper or lecture"}},
      {{"figures", "order", "--scene", "no-such-scene"}, {"no-such-scene"}},
      {{"figures", "order", "--out", "a-file"}, {"--out a-file"}},
      {{"list", "colours"}, {"colours", "methods"}},
      {{"run", "chain", "--method", "exec:./no-engine"}, {"exec:./no-engine", "no such file"}},
      {{"compare", "chain", "--trajectory", "none.npy"}, {"none.npy", "cannot be read"}},
      {{"compare", "chain", "--trajectory", "a-file"}, {"a-file", "expected a .npy file"}},
      {{"engine", "unreal", "--prefix", ".", "-o", "p"}, {"engine unreal", "expected bullet"}},
      {{"engine", "bullet", "--prefix", ".", "-o", "p"},
       {"--prefix .", "include/bullet/btBulletDynamicsCommon.h", "src/btBulletDynamicsCommon.h"}},
      {{"engine", "bullet", "--prefix", "/usr", "-o", "."}, {"-o .", "folder"}},
      {{"fly"}, {"fly"}},
      {{}, {"subcommand"}},
  };
  const int before = files();
  for (const Row& row : table) {
    const ProgramResult result = call(row.words);
    SCOPED_TRACE(result.err);
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << "one line";
    for (const std::string& part : row.expected) EXPECT_NE(result.err.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(files(), before) << "bad input leaves nothing behind";
}

TEST_F(Cli, RunWritesWhatPythonReads) {
  const ProgramResult result = call({"run", "chain", "--duration", "0.5", "--out", "out"});
  ASSERT_EQ(result.status, 0) << result.err;
  const std::string npy = read(folder_ / "out/trajectory.npy");
  ASSERT_GT(npy.size(), 128u);
  EXPECT_EQ(npy.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  EXPECT_NE(npy.find("'shape': (26, 4, 3)"), std::string::npos);  // 25 samples of 0.02 s and the start
  EXPECT_EQ(npy.size() % 64, (26 * 4 * 3 * sizeof(double)) % 64) << "data begin at a multiple of 64";
  EXPECT_EQ(read(folder_ / "out/velocities.npy").size(), npy.size());
  EXPECT_NE(read(folder_ / "out/run.json").find("\"verdict\": \"ok\""), std::string::npos);
  EXPECT_NE(read(folder_ / "out/energy.csv").find("method [1],t [s],kinetic [J]"), std::string::npos);
}

TEST_F(Cli, DivergingRunIsAnAnswer) {
  const ProgramResult result = call({"run", "chain", "--method", "explicit-euler", "--out", "out"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(read(folder_ / "out/run.json").find("\"verdict\": \"energy\""), std::string::npos);
}

TEST_F(Cli, UnsupportedMethodIsANoWithItsReason) {
  const ProgramResult result = call({"run", "circle", "--method", "bullet/pbd", "--out", "out"});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("first-order"), std::string::npos) << result.err;
  EXPECT_FALSE(fs::exists(folder_ / "out/run.json"));
}

TEST_F(Cli, ListsAreReadableByProgramsToo) {
  for (const char* what : {"scenes", "methods", "experiments", "assignments"}) {
    SCOPED_TRACE(what);
    EXPECT_EQ(call({"list", what}).status, 0);
    const ProgramResult json = call({"list", what, "--json"});
    EXPECT_EQ(json.status, 0);
    EXPECT_EQ(json.out.front(), '[');
  }
  EXPECT_EQ(call({"doctor"}).status, 0);
}

TEST_F(Cli, ReportOfOwnSceneIsWholeAndTheSameTwice) {
  write("mine.toml", own_scene);
  for (const char* out : {"one", "two"}) {
    const ProgramResult result = call({"report", "mine.toml", "circle", "--quick", "--out", out});
    ASSERT_EQ(result.status, 0) << result.err;
  }
  const std::string page = read(folder_ / "one/index.html");
  EXPECT_NE(page.find("Does a scene that nobody shipped work everywhere?"), std::string::npos);
  EXPECT_EQ(page.find("http://"), std::string::npos) << "the page needs no network";
  EXPECT_EQ(page.find("https://"), std::string::npos);
  for (const char* figure : {"mine-error", "mine-agreement", "mine-energy", "mine-order", "scoreboard"})
    for (const char* ending : {".gp", ".csv", ".svg", ".pdf", ".png"})
      EXPECT_TRUE(fs::exists(folder_ / "one/figures" / (std::string(figure) + ending))) << figure << ending;
  EXPECT_TRUE(fs::exists(folder_ / "one/figures/mine-picture.png"));
  EXPECT_TRUE(fs::exists(folder_ / "one/data/mine-motions.json"));
  EXPECT_NE(page.find("<motion-player>"), std::string::npos);

  // two runs: the same data rows, SVG, PNG and PDF; costs and what is drawn from them aside
  int compared = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "one")) {
    const fs::path file = entry.path(), other = folder_ / "two" / fs::relative(file, folder_ / "one");
    const std::string ending = file.extension();
    if (file.stem().string().ends_with("-cost")) continue;
    if (ending == ".csv") {
      EXPECT_EQ(rows(file), rows(other)) << file;
      ++compared;
    } else if (ending == ".svg" || ending == ".png" || ending == ".pdf" || ending == ".gp" ||
               file.stem().string().ends_with("-motions")) {
      EXPECT_TRUE(read(file) == read(other)) << file;
      ++compared;
    }
    EXPECT_NE(ending, ".part") << "no half file is left";
  }
  EXPECT_GT(compared, 30);
}

TEST_F(Cli, ReportClaimsNoAgreementWhereTheMotionIsChaotic) {
  // four masses flung about without drag for 20 s: any two engines part, and the page must not call that round-off
  std::string text = own_scene;
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("duration = 0.4", "duration = 20");
  replace("window = 0.4", "window = 20");
  replace("position = [0.3, -0.4, 0]", "position = [0.3, 0.4, 0]");
  replace("position = [0.3, -0.9, 0.1]", "position = [0.6, 0.9, 0.1]");
  write("flung.toml", text);
  const ProgramResult result = call(
      {"report", "flung.toml", "--quick", "--out", "out", "--methods", "symplectic-euler,bullet/deformable-explicit"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("chaotic"), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find("Bullet agree"), std::string::npos) << result.out;
}

TEST_F(Cli, ReportOfBodiesAtRestAndFreeFlightIsWhole) {
  const std::string head =
      "question = \"q\"\nparameters = \"p\"\n[time]\nduration = 1\nsamples = 10\nstep = 0.01\nwindow = 1\n"
      "tolerance = 1e-3\nmethod = \"rk4\"\n";
  write("rest.toml", head +
                         "[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [1, 0, 0]\nmass = 1\n"
                         "[[spring]]\nends = [0, 1]\nstiffness = 10\n");
  write("bounce.toml", head +
                           "[[particle]]\nposition = [0, 2, 0]\nmass = 1\n[gravity]\nacceleration = [0, -9.81, 0]\n"
                           "[sphere]\ncentre = [0, 0, 0]\nradius = 1\nrestitution = 0.5\n");
  const ProgramResult result = call({"report", "rest.toml", "bounce.toml", "--quick", "--out", "out"});
  EXPECT_EQ(result.status, 0) << result.err;
  const std::string page = read(folder_ / "out/index.html");
  for (const char* number : {"nan ", "-nan", ">nan", "inf "})  // none of these can stand in the images' base64
    EXPECT_EQ(page.find(number), std::string::npos) << number;
}

TEST_F(Cli, RenderDrawsEveryMode) {
  for (const char* mode : {"shaded", "stretch", "springs", "difference", "strip"}) {
    SCOPED_TRACE(mode);
    const std::string file = std::string(mode) + ".png";
    const ProgramResult result =
        call({"render", "chain", "--mode", mode, "--quality", "fast", "--size", "480x270", "--at", "0.3", "-o", file});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(read(folder_ / file).substr(0, 4), "\x89PNG");
  }
}

}  // namespace
}  // namespace crosscheck
