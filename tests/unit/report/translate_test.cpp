// Tests `translate` on the command line: conversion to an engine, conversion back, and refusals.

#include <algorithm>

#include "mysim/base/json.h"
#include "tests/unit/helpers.h"
#include "tests/unit/report/cli.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

class CliTranslate : public Cli {
 protected:
  void expect(const std::vector<std::string>& words, int status, const std::vector<std::string>& parts) {
    const ProgramResult result = call(words);
    const std::string& text = status == 0 ? result.out : result.err;
    EXPECT_EQ(result.status, status) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), status == 0 ? 0 : 1) << result.err;
    for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
  }
};

TEST_F(CliTranslate, ThereAndBackIsTheSameScene) {
  write("own.toml", own_scene);
  expect({"translate", "own.toml", "--to", "bullet/pbd", "--iterations", "4", "--step", "2e-3", "--out", "there.toml"},
         0,
         {"own in the parameters of bullet/pbd+n=4", "spring stiffness k: 90 to 150 N/m", "one for each spring",
          "kLST = 1 - (1 + k h^2 / mu)^(-1/n)", "holds", "converted back (within", "measured by bullet/pbd+n=4: error",
          "% of the motion", "error bar", "different law", "there.toml"});
  expect({"translate", "own.toml", "--from", "bullet/pbd", "there.toml", "--out", "back.toml"}, 0,
         {"spring stiffness k = 90 to 150 N/m; the scene had 90 to 150 N/m", "step h = 0.002 s, n = 4"});
  // equal hashes mean that engines receive the same scene
  const auto hash = [&](const std::string& scene) {
    EXPECT_EQ(call({"run", scene, "--duration", "0.02", "--out", "out-" + scene}).status, 0);
    return JsonField::parse_file((folder_ / ("out-" + scene) / "run.json").string())["scene_hash"].text();
  };
  EXPECT_EQ(hash("back.toml"), hash("own.toml"));
}

TEST_F(CliTranslate, AnEnginesNumbersBecomeStiffness) {
  write("own.toml", own_scene);
  // mu is 0.5 kg for the link to the pin, and 1 / 6 kg for the other link: k = mu / h^2 ((1 - 0.5)^-1 - 1)
  write("numbers.toml", "step = 0.01\nkLST = 0.5\n");
  expect({"translate", "own.toml", "--from", "bullet/pbd", "numbers.toml", "--out", "back.toml"}, 0,
         {"spring stiffness k = 1666.67 to 5000 N/m; the scene had 90 to 150 N/m"});
  const ProgramResult json = call({"translate", "own.toml", "--from", "bullet/pbd", "numbers.toml", "--json"});
  const JsonField told = JsonField::parse(json.out, "translate");
  EXPECT_EQ(told["format"].whole(), 1);
  EXPECT_NEAR(told["numbers"][0]["scene"][0].number(), 5000, 1e-9 * 5000);
  const std::string back = read(folder_ / "back.toml");
  EXPECT_NE(back.find("5000"), std::string::npos) << back;
}

TEST_F(CliTranslate, AStepThatDoesNotFitTheSamplesIsNamedBesideTheOneTaken) {
  write("own.toml", own_scene);
  expect({"translate", "own.toml", "--to", "jolt", "--step", "0.0167"}, 0,
         {"step h = 0.01 s",
          "the requested step is 0.0167 s, the step used is 0.01 s: it must divide the 0.02 s between samples"});
  const JsonField json =
      JsonField::parse(call({"translate", "own.toml", "--to", "jolt", "--step", "0.0167", "--json"}).out, "translate");
  EXPECT_EQ(json["step"].number(), 0.01);
  EXPECT_EQ(json["step_asked"].number(), 0.0167);
  EXPECT_FALSE(contains(call({"translate", "own.toml", "--to", "jolt", "--step", "0.005"}).out, "the requested step"));
}

TEST_F(CliTranslate, WhatIsNotRunHereSaysSo) {
  write("own.toml", own_scene);
  expect({"translate", "own.toml", "--to", "jolt"}, 0,
         {"mCompliance", "n = 5 (mNumIterations)", "not measured here: this build does not run Jolt's soft bodies",
          "--run exec:PROGRAM"});
  expect({"translate", "own.toml", "--to", "godot"}, 0,
         {"linear_stiffness = ", ", one for all", "measured by bullet/pbd+n=5", "itself was not run"});
  expect({"translate", "own.toml", "--to", "jolt", "--run", std::string("exec:") + CROSSCHECK_EXAMPLE}, 0,
         {"measured by exec:"});
  const JsonField json = JsonField::parse(call({"translate", "own.toml", "--to", "jolt", "--json"}).out, "translate");
  EXPECT_TRUE(json["measured"].is_null());
  EXPECT_EQ(json["iterations"].whole(), 5);
}

TEST_F(CliTranslate, RefusalsNameWhatWasExpected) {
  write("own.toml", own_scene);
  write("bad.toml", "step = 0.01\nkLST = 1.5\n");
  expect({"translate", "own.toml"}, 2, {"translate: expected either --to METHOD or --from METHOD FILE"});
  expect({"translate", "own.toml", "--to", "jolt", "--from", "jolt", "bad.toml"}, 2, {"expected either --to"});
  expect({"translate", "own.toml", "--from", "bullet/pbd", "bad.toml", "--run", "rk4"}, 2,
         {"--run: expected with --to only"});
  expect({"translate", "own.toml", "--from", "bullet/pbd", "bad.toml"}, 2, {"bad.toml:2: kLST: expected", "got 1.5"});
  expect({"translate", "own.toml", "--from", "bullet/pbd", "none.toml"}, 2, {"none.toml", "an engine's numbers"});
  expect({"translate", "own.toml", "--to", "odeint/rk4"}, 2,
         {"no known parameters", "jolt, rapier, box3d, mujoco, godot"});
  expect({"translate", "own.toml", "--to", "rk4", "--iterations", "3"}, 2, {"mysim/rk4 always takes one pass"});
  expect({"translate", "chian", "--to", "jolt"}, 2, {"did you mean 'chain'?"});
  // a scene that has nothing to translate, and a world that does not support the scene
  expect({"translate", "circle", "--to", "bullet/pbd"}, 1, {"has no parameters for circle", "first-order"});
  EXPECT_EQ(call({"translate", "rod", "--to", "bullet/deformable-implicit"}).status, 1);
}

}  // namespace
}  // namespace crosscheck
