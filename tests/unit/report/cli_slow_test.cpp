// Tests the program on the command line: exit statuses, messages, run, engines, shards of sweeps, advise.

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <map>

#include "mysim/base/json.h"
#include "report/findings/report_data.h"
#include "tests/unit/experiments/advise_case.h"
#include "tests/unit/report/cli.h"
#include "tests/unit/report/readers.h"
#include "tests/unit/report/telling_apart.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

TEST_F(Cli, BadInputExitsWith2AndOneHelpfulLine) {
  const std::string good = own_scene;
  // writes a faulty copy of the scene, and returns the prefix with which a message must locate the fault: "FILE:LINE:"
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
    std::vector<std::string> expected;  // texts that the message must contain
  };
  const Row table[] = {
      {{"run", unknown_key}, {unknown_key_at, "gravity.strength", "unknown key", "acceleration"}},
      {{"run", ghost}, {ghost_at, "spring[1].ends[1]", "a particle from 0 to 2", "7"}},
      {{"run", negative}, {negative_at, "particle[1].mass", "above zero", "-0.5"}},
      {{"run", not_a_number}, {not_a_number_at, "particle[1].mass", "nan"}},
      {{"run", inside}, {inside_at, "sphere.radius", "no particle inside", "particle 2"}},
      {{"run", "missing.toml"}, {"missing.toml", "cannot be read"}},
      {{"run", "no-such-scene"}, {"no-such-scene", "list scenes"}},
      {{"run", "chain", "--method", "rk5"}, {"rk5", "did you mean 'rk4'?"}},
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
      {{"experiment", "no-such-experiment"}, {"no-such-experiment", "list experiments"}},
      {{"experiment", "order", "no-such-scene"}, {"no-such-scene"}},
      {{"report", "no-such-scene"}, {"no-such-scene"}},
      {{"report", "chain", "circle", "chain"}, {"chain", "different names"}},
      {{"report", "chain", "--quick", "--full"}, {"--full"}},
      {{"report", "chain", "--out", "a-file"}, {"--out a-file"}},
      {{"render", "chain", "-o", "picture.gif"}, {"picture.gif", ".png"}},
      {{"render", "chain", "-o", "p.png", "--quality", "best"}, {"--quality best", "fast or still"}},
      {{"render", "chain", "-o", "p.png", "--mode", "x-ray"}, {"x-ray", "stretch"}},
      {{"render", "chain", "-o", "p.png", "--size", "12"}, {"--size 12"}},
      {{"render", "chain", "-o", "p.png", "--size", "64x64", "--mode", "stretch"},
       {"64 x 64 pixels", "3 x 1 panels", "larger --size"}},
      {{"render", "chain", "-o", "p.png", "--at", "99"}, {"--at 99"}},
      {{"render", "chain", "-o", "a-file/p.png"}, {"a-file"}},
      {{"figures", "no-such-figure"}, {"no-such-figure", "SCENE-picture", "list experiments"}},
      {{"figures", "no-such-picture"}, {"no-such", "list scenes"}},
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
      {{"engine", "unreal", "--prefix", ".", "-o", "p"}, {"engine unreal", "expected one of bullet, mujoco"}},
      {{"engine", "jollt", "-o", "p"}, {"engine jollt", "did you mean 'jolt'?"}},
      {{"engine", "bullet", "-o", "p"}, {"engine bullet", "expected --prefix DIR"}},
      {{"engine", "mujoco", "--prefix", "."}, {"engine mujoco", "expected no --prefix", "libmujoco-dev"}},
      {{"report", "chain", "--engines", "some"}, {"--engines some", "expected all"}},
      {{"engine", "jolt", "--prefix", "/usr", "-o", "p"},
       {"--prefix /usr", "source tree of Jolt", "Build/CMakeLists.txt"}},
      {{"engine", "jolt", "-o", "."}, {"-o .", "folder"}},
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
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << "expected one line";
    for (const std::string& part : row.expected) EXPECT_NE(result.err.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(files(), before) << "bad input must leave no files";
}

TEST_F(Cli, RunWritesWhatPythonReads) {
  const ProgramResult result = call({"run", "chain", "--duration", "0.5", "--out", "out"});
  ASSERT_EQ(result.status, 0) << result.err;
  const std::string npy = read(folder_ / "out/trajectory.npy");
  ASSERT_GT(npy.size(), 128u);
  EXPECT_EQ(npy.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  EXPECT_NE(npy.find("'shape': (26, 4, 3)"), std::string::npos);  // 25 samples of 0.02 s and the initial state
  EXPECT_EQ(npy.size() % 64, (26 * 4 * 3 * sizeof(double)) % 64) << "data must start at a multiple of 64";
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
  const std::string page = with_folds_put_back(read(folder_ / "one/index.html"));
  EXPECT_NE(page.find("Does a scene that nobody shipped work everywhere?"), std::string::npos);
  std::string addresses = page;
  const std::string svg = "http://www.w3.org/2000/svg";  // only the name of a namespace, from which nothing is loaded
  for (size_t at; (at = addresses.find(svg)) != std::string::npos;) addresses.erase(at, svg.size());
  EXPECT_EQ(addresses.find("http://"), std::string::npos) << "the page must not need a network";
  EXPECT_EQ(page.find("https://"), std::string::npos);
  for (const char* figure : {"mine-error", "mine-agreement", "mine-energy", "mine-order"}) {
    for (const char* ending : {".gp", ".csv"})
      EXPECT_TRUE(fs::exists(folder_ / "one/figures" / (std::string(figure) + ending))) << figure << ending;
    EXPECT_NE(page.find(fmt::format("data-chart=\"{}\"", figure)), std::string::npos) << figure;
  }
  // figures that open a chapter are drawn for paper, in every format
  int drawn = 0;
  for (const auto& entry : fs::directory_iterator(folder_ / "one/figures")) {
    if (entry.path().extension() != ".svg") continue;
    ++drawn;
    for (const char* ending : {".gp", ".csv", ".pdf", ".png"})
      EXPECT_TRUE(fs::exists(fs::path(entry.path()).replace_extension(ending))) << entry.path() << ending;
  }
  EXPECT_GE(drawn, 3);
  EXPECT_LE(drawn, 5) << "one per chapter";
  int figures = 0;
  EXPECT_EQ(looking_alike_in(folder_ / "one/figures", figures), "");
  EXPECT_GE(figures, 15);
  EXPECT_TRUE(fs::exists(folder_ / "one/figures/circle-speed-accuracy-cost.svg"))
      << "the last scene represents the others";
  EXPECT_FALSE(fs::exists(folder_ / "one/figures/mine-agreement.svg"));
  EXPECT_TRUE(fs::exists(folder_ / "one/figures/mine-thumbnail.png"));
  EXPECT_TRUE(fs::exists(folder_ / "one/runs/mine-engines/mysim-symplectic-euler.u16.gz"));
  EXPECT_FALSE(fs::exists(folder_ / "one/runs/mine-engines/mysim-symplectic-euler.json"))
      << "its data are in report.json";
  EXPECT_NE(page.find("<motion-player data-scene=\"mine\""), std::string::npos);
  EXPECT_NE(page.find("class=\"motion\" data-scene=\"mine\""), std::string::npos);
  const JsonField report = JsonField::parse_file(folder_ / "one/report.json");
  EXPECT_EQ(report["extent"].text(), "named");
  int answers = 0;
  for (const JsonField& finding : report["findings"].elements()) {
    std::istringstream sentence(finding["sentence"].text());
    EXPECT_LE(std::distance(std::istream_iterator<std::string>(sentence), {}), 25) << sentence.str();
    answers += finding["topic"].text() == "answer";
  }
  EXPECT_GE(answers, 3);
  // certificates contain the values that were read back from the engines' memory
  EXPECT_NE(read(folder_ / "one/data/certificates.csv").find("mine,bullet/deformable-explicit,"), std::string::npos);
  EXPECT_NE(read(folder_ / "one/data/dictionary.csv").find("certificates,"), std::string::npos);
  EXPECT_EQ(call({"report", "--verify", "one"}).status, 0);

  // `--from` rebuilds the identical page without running anything, next to the original or in its place
  const std::string json = read(folder_ / "one/report.json");
  for (const char* out : {"from", "one"}) {
    const auto begin = std::chrono::steady_clock::now();
    const ProgramResult again = call({"report", "--from", "one", "--out", out});
    EXPECT_EQ(again.status, 0) << again.err;
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 30);
    EXPECT_TRUE(with_folds_put_back(read(folder_ / out / "index.html")) == page) << out;
    EXPECT_TRUE(read(folder_ / out / "report.json") == json) << out;
    EXPECT_EQ(call({"report", "--verify", out}).status, 0);
  }
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "one/data"))
    if (entry.is_regular_file()) {
      EXPECT_TRUE(read(entry) == read(folder_ / "from/data" / fs::relative(entry, folder_ / "one/data"))) << entry;
    }
  for (const char* bad : {"no-such-folder", "two/figures"}) {
    const ProgramResult refused = call({"report", "--from", bad, "--out", "never"});
    EXPECT_EQ(refused.status, 2) << bad << refused.out;
    EXPECT_FALSE(fs::exists(folder_ / "never"));
  }

  // except for costs, two runs write the same data and the same SVG, PNG and PDF files
  int compared = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "one")) {
    const fs::path file = entry.path(), other = folder_ / "two" / fs::relative(file, folder_ / "one");
    const std::string ending = file.extension();
    if (file.stem().string().ends_with("-cost")) continue;
    if (ending == ".csv") {
      EXPECT_EQ(rows(file), rows(other)) << file;
      ++compared;
    } else if (ending == ".svg" || ending == ".png" || ending == ".pdf" || ending == ".gp" || ending == ".gz") {
      EXPECT_TRUE(read(file) == read(other)) << file;
      ++compared;
    }
    EXPECT_NE(ending, ".part") << "no partial file may remain";
  }
  EXPECT_GT(compared, 30);
}

TEST_F(Cli, ReportClaimsNoAgreementWhereTheMotionIsChaotic) {
  // four masses without drag for 20 s: any two engines diverge by more than round-off
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
  EXPECT_NE(read(folder_ / "out/report.json").find("\"rule\": \"answer-chaotic\""), std::string::npos) << result.out;
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
  int figures = 0;
  EXPECT_EQ(looking_alike_in(folder_ / "out/figures", figures), "");
  const std::string page = read(folder_ / "out/index.html");
  for (const char* number : {"nan ", "-nan", ">nan", "inf "})  // impossible in base64
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

namespace crosscheck::testing_tools {
namespace {

class CliRun : public Cli {};

TEST_F(CliRun, KilledLeavesNoHalfFile) {
  // two thousand million steps take minutes, during which frames are written continually
  const ProgramResult result = run_program({"timeout", "-s", "KILL", "1", CROSSCHECK_PROGRAM, "run", "chain",
                                            "--duration", "19000", "--step", "1e-5", "--out", "out"},
                                           folder_);
  EXPECT_EQ(result.status, 128 + 9) << result.err;
  ASSERT_TRUE(fs::exists(folder_ / ".out.crosscheck/new")) << "the run must have started";
  EXPECT_FALSE(fs::exists(folder_ / "out"));
  EXPECT_EQ(call({"run", "chain", "--out", "out"}).status, 0);
  EXPECT_EQ(files(), 6) << "expected the folder and its five files only";
}

TEST_F(CliRun, MoreFramesTakeNoMoreMemory) {
  constexpr int side = 200, many = 60;
  const auto with_samples = [&](int samples) {
    write(fmt::format("{}.toml", samples),
          fmt::format("question = \"q\"\nparameters = \"p\"\n[time]\nduration = 0.006\nsamples = {}\nstep = 1e-4\n"
                      "window = 0.006\ntolerance = 1e-3\nmethod = \"leapfrog\"\n[grid]\nsize = [{}, {}]\n"
                      "origin = [0, 0, 0]\nu = [1, 0, 0]\nv = [0, 0, 1]\nmass = 0.25\n[grid.stiffness]\n"
                      "structural = 20\nshear = 20\nbend = 20\n[pins]\nparticles = [0]\n",
                      samples, side, side));
    const ProgramResult result = call({"run", fmt::format("{}.toml", samples), "--out", "out"});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_NE(read(folder_ / "out/trajectory.npy").substr(0, 128).find(fmt::format("({}, ", samples + 1)),
              std::string::npos);
    rusage used{};
    getrusage(RUSAGE_CHILDREN, &used);
    return used.ru_maxrss / 1024.;  // MiB, maximum over all child processes so far
  };
  constexpr double frame = 2. * 3 * side * side * sizeof(double) / (1 << 20);  // MiB
  const double few = with_samples(2);
  // allows a tenth of the frames' size for variations of the allocator
  EXPECT_LT(with_samples(many) - few, 0.1 * many * frame);
}

}  // namespace
}  // namespace crosscheck::testing_tools

namespace crosscheck {
namespace {

using namespace testing_tools;

TEST_F(Cli, CompareStopsAtAMismatch) {
  const ProgramResult result =
      call({"compare", "spring", "--methods", "leapfrog,bullet/deformable-explicit+default-rest", "--out", "out"});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.out.find("mismatch       springs: rest lengths"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("MISMATCH: bullet/deformable-explicit+default-rest was given another scene"),
            std::string::npos)
      << result.out;
  // without the mismatch
  EXPECT_EQ(call({"compare", "spring", "--methods", "leapfrog,bullet/deformable-explicit", "--out", "out"}).status, 0);
}

TEST_F(Cli, CompareShowsParityAndThatEqualRulesAgree) {
  const ProgramResult result = call({"compare", "chain", "--out", "out"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("parity of bullet/deformable-explicit"), std::string::npos);
  EXPECT_NE(result.out.find("same rule"), std::string::npos);
  EXPECT_EQ(result.out.find("NOT THE SAME"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder_ / "out/certificate-bullet-pbd.json"));
}

TEST_F(Cli, CompareTakesATrajectoryFromAFile) {
  ASSERT_EQ(call({"run", "chain", "--method", "symplectic-euler", "--out", "theirs"}).status, 0);
  const ProgramResult result = call({"compare", "chain", "--methods", "symplectic-euler,leapfrog", "--trajectory",
                                     "theirs/trajectory.npy", "--out", "out"});
  EXPECT_EQ(result.status, 0) << result.err;
  const size_t at = result.out.find("\nfile:trajectory.npy");
  ASSERT_NE(at, std::string::npos) << result.out;
  std::istringstream row(result.out.substr(at));
  std::string name, verdict, error, difference;
  row >> name >> verdict >> error >> difference;
  EXPECT_EQ(verdict, "ok");
  EXPECT_EQ(difference, "0") << "expected identical runs";
  EXPECT_NE(result.out.find("parity of file:trajectory.npy"), std::string::npos);
  ASSERT_EQ(call({"run", "chain", "--duration", "1", "--out", "short"}).status, 0);
  const ProgramResult refused = call({"compare", "chain", "--trajectory", "short/trajectory.npy"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("expected shape (151, 4, 3)"), std::string::npos) << refused.err;
}

TEST_F(Cli, AnEngineThatDoesNotBuildSaysWhatTheCompilerSaid) {
  fs::create_directories(folder_ / "tree/include/bullet/BulletSoftBody");
  write("tree/include/bullet/btBulletDynamicsCommon.h", "");
  const ProgramResult result = call({"engine", "bullet", "--prefix", "tree", "-o", "engine"});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("libBulletSoftBody"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("tree/lib*"), std::string::npos) << result.err;
  EXPECT_FALSE(fs::exists(folder_ / "engine"));
}

}  // namespace
}  // namespace crosscheck

namespace crosscheck::testing_tools {
namespace {

class CliSweep : public Cli {
 protected:
  /// Tables by name, without their provenance lines, and without tables of costs.
  std::map<std::string, std::string> tables(const std::string& out) const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::directory_iterator(folder_ / out))
      if (entry.path().extension() == ".csv" && !entry.path().stem().string().ends_with("-cost"))
        all[entry.path().filename()] = rows(entry.path());
    return all;
  }
};

TEST_F(CliSweep, MergedShardsAreTheWhole) {
  for (const char* part : {"1/2", "2/2"}) {
    const ProgramResult result = call({"experiment", "order", "engines", "spring", "circle", "--shard", part, "--out",
                                       std::string("part") + part[0]});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_TRUE(tables(std::string("part") + part[0]).empty()) << "a shard must not write tables";
  }
  ASSERT_EQ(call({"experiment", "order", "engines", "spring", "circle", "--out", "whole"}).status, 0);
  ASSERT_EQ(call({"merge", "part2", "part1", "--out", "merged"}).status, 0);
  EXPECT_EQ(tables("merged"), tables("whole"));
  EXPECT_GE(tables("whole").size(), 5u);

  const ProgramResult lacking = call({"merge", "part1", "--out", "lacking"});
  EXPECT_EQ(lacking.status, 1);
  EXPECT_NE(lacking.err.find("missing: order: circle"), std::string::npos) << lacking.err;
  EXPECT_FALSE(fs::exists(folder_ / "lacking"));
}

TEST_F(CliSweep, ResumeKeepsWhatIsFinishedAndOthersAreNotJoined) {
  ASSERT_EQ(call({"experiment", "order", "spring", "circle", "--out", "out"}).status, 0);
  const auto finished = [&] {
    std::map<std::string, fs::file_time_type> times;
    for (const auto& entry : fs::directory_iterator(folder_ / "out/points"))
      times[entry.path().filename()] = entry.last_write_time();
    return times;
  };
  const auto before = finished();
  ASSERT_EQ(before.size(), 2u);
  fs::remove(folder_ / "out/points" / before.begin()->first);
  const ProgramResult again = call({"experiment", "order", "spring", "circle", "--resume", "--out", "out"});
  ASSERT_EQ(again.status, 0) << again.err;
  const auto after = finished();
  EXPECT_EQ(after.size(), 2u);
  EXPECT_EQ(after.rbegin()->second, before.rbegin()->second) << "the finished point must be kept";

  ASSERT_EQ(call({"experiment", "order", "spring", "--out", "other"}).status, 0);
  const ProgramResult mixed = call({"merge", "out", "other", "--out", "mixed"});
  EXPECT_EQ(mixed.status, 2);
  EXPECT_NE(mixed.err.find("expected the points of out: the same command, scenes and program"), std::string::npos)
      << mixed.err;
}

/// Runs array.sbatch like Slurm, with a program that prints its arguments.
class CliArray : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    fs::create_directories(folder_ / "build/release");
    fs::permissions(write("build/release/crosscheck", "#!/bin/sh\necho \"$@\"\n"), fs::perms::owner_all);
  }
  ProgramResult task(int id, int least, int most, int count, const std::string& parts = "") const {
    const auto variable = [](const char* name, const auto& value) { return fmt::format("{}={}", name, value); };
    return run_program({"bash", CROSSCHECK_SOURCE "/experiments/sweep/array.sbatch", "out", "order", "spring"}, folder_,
                       {variable("SLURM_ARRAY_TASK_ID", id), variable("SLURM_ARRAY_TASK_MIN", least),
                        variable("SLURM_ARRAY_TASK_MAX", most), variable("SLURM_ARRAY_TASK_COUNT", count),
                        variable("SLURM_CPUS_PER_TASK", 2), variable("CROSSCHECK_PARTS", parts)});
  }
};

TEST_F(CliArray, ATasksNumberIsItsPart) {
  const std::string third = "experiment order spring --shard 3/16 --resume --jobs 2 --out out/part-3\n";
  EXPECT_EQ(task(3, 1, 16, 16).out, third);      // --array=1-16
  EXPECT_EQ(task(3, 3, 7, 2, "16").out, third);  // --array=3,7, submitted again
  for (const int count : {1, 2}) {               // --array=3; --array=1,3
    const ProgramResult lost = task(3, count == 1 ? 3 : 1, 3, count);
    EXPECT_EQ(lost.status, 2);
    EXPECT_NE(lost.err.find("expected CROSSCHECK_PARTS=N"), std::string::npos) << lost.err;
  }
  EXPECT_EQ(task(15, 1, 15, 8).status, 2);  // --array=1-16:2
}

TEST_F(CliSweep, BadPartsAreRefused) {
  const ProgramResult shard = call({"experiment", "order", "spring", "--shard", "3/2", "--out", "out"});
  EXPECT_EQ(shard.status, 2);
  EXPECT_NE(shard.err.find("expected I/N"), std::string::npos) << shard.err;
  const ProgramResult none = call({"merge", "nowhere", "--out", "out"});
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.err.find("nowhere/plan.json: expected the plan of a sweep"), std::string::npos) << none.err;
}

}  // namespace
}  // namespace crosscheck::testing_tools

namespace crosscheck {
namespace {

using namespace testing_tools;

TEST(Advise, FiveCasesMeetTheirTolerance) {
  const std::pair<Scene, double> cases[] = {{load_scene("pendulum"), 0.01},
                                            {load_scene("chain"), 0.001},
                                            {load_scene("circle"), 0.001},
                                            {random_contact_free_scene(3), 0.01},
                                            {random_contact_free_scene(8), 0.001}};
  for (const auto& [scene, part] : cases) {
    const AdviseCase c = advise_case(scene, part);
    EXPECT_TRUE(c.promised) << scene.name << ": " << c.why;
    EXPECT_TRUE(c.met) << scene.name;
    EXPECT_FALSE(c.cheaper) << scene.name;
  }
}

TEST_F(Cli, AdviseWritesAFileThatRuns) {
  const ProgramResult advised = call({"advise", "pendulum", "--tolerance", "1e-3", "--out", "a"});
  ASSERT_EQ(advised.status, 0) << advised.err;
  for (const auto part : {"method", "margin", "cost", "next best"}) EXPECT_TRUE(contains(advised.out, part));
  for (const auto file : {"advice.toml", "advice.json", "advice.csv", "advice-cost.csv", "pendulum-advice.svg"})
    EXPECT_TRUE(fs::exists(folder_ / "a" / file)) << file;
  const ProgramResult run = call({"run", "a/advice.toml", "--out", "r"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(contains(run.out, "ok"));
}

TEST_F(Cli, AdviseTakesAPartOfTheMotion) {
  const Scene scene = load_scene("spring");
  Recorder exact;
  ASSERT_EQ(run_method(find_method("truth/exact"), scene, default_run(scene), {&exact}).verdict, Verdict::ok);
  double motion = 0;
  for (std::size_t i = 0; i < exact.trajectory.t.size() && exact.trajectory.t[i] <= scene.window; ++i)
    motion = std::max(motion, rms_distance(exact.trajectory.x[i], exact.trajectory.x[0]));
  const ProgramResult advised = call({"advise", "spring", "--tolerance", "0.5%"});
  ASSERT_EQ(advised.status, 0) << advised.err;
  EXPECT_TRUE(contains(
      advised.out, fmt::format("0.5 % of the motion, {}, is {}\n", nice_length(motion), nice_length(0.005 * motion))))
      << advised.out << motion;
  for (const char* wrong : {"0%", "-1%", "%", "1m%", "nan", "inf%"}) {
    const ProgramResult refused = call({"advise", "spring", "--tolerance=" + std::string(wrong)});
    EXPECT_EQ(refused.status, 2);
    EXPECT_TRUE(contains(refused.err, fmt::format("such as 1%, got '{}'", wrong))) << refused.err;
  }
  // this scene has no truth, because its step is too long
  std::string fails = load_scene("jelly").source;
  fails.replace(fails.find("step = 1e-3"), 11, "step = 2e-2");
  write("fails.toml", fails);
  const ProgramResult unknown = call({"advise", "fails.toml", "--tolerance", "1%"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_TRUE(contains(unknown.err, "the motion of fails is not known, as its own method fails")) << unknown.err;
}

TEST_F(Cli, AdviseFitsAndRefuses) {
  std::string text = own_scene;
  for (const auto k : {"stiffness = 150", "stiffness = 90"})
    text.replace(text.find(k), std::string(k).size(), "stiffness = \"fit\"");
  write("wish.toml", text + "[wish]\nperiod = 1.5\n");
  const ProgramResult fitted = call({"advise", "wish.toml", "--out", "f"});
  ASSERT_EQ(fitted.status, 0) << fitted.err;
  EXPECT_TRUE(contains(fitted.out, "stiffness = "));
  EXPECT_TRUE(contains(fitted.out, "period: wished 1.5 s"));
  EXPECT_EQ(call({"run", "f/advice.toml", "--out", "r"}).status, 0);
  const ProgramResult refused = call({"run", "wish.toml"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_TRUE(contains(refused.err, "crosscheck advise"));
  const ProgramResult none = call({"advise", "pendulum"});
  EXPECT_EQ(none.status, 2);
  EXPECT_TRUE(contains(none.err, "--tolerance: expected a length above zero"));
  const ProgramResult never = call({"advise", "pendulum", "--tolerance", "1e-18"});
  EXPECT_EQ(never.status, 1);
  EXPECT_TRUE(contains(never.err, "no guaranteed advice for pendulum"));
}

}  // namespace
}  // namespace crosscheck
