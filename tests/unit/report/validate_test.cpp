// Tests `validate`, refusals of excessive sizes, and messages for unknown names.

#include <fmt/format.h>

#include <algorithm>

#include "mysim/base/json.h"
#include "tests/unit/report/cli.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

class CliValidate : public Cli {
 protected:
  void expect_refusal(const std::vector<std::string>& words, const std::vector<std::string>& parts) {
    const ProgramResult result = call(words);
    SCOPED_TRACE(result.err);
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << "expected one line";
    for (const std::string& part : parts) EXPECT_NE(result.err.find(part), std::string::npos) << part;
  }
};

TEST_F(CliValidate, SaysWhatASceneIs) {
  // a mass m on a spring of stiffness k: omega = sqrt(k / m) = 20 rad/s
  write("one.toml",
        "question = \"q\"\nparameters = \"p\"\n[time]\nduration = 1\nsamples = 10\nstep = 1e-2\nwindow = 1\ntolerance "
        "= 1e-3\n"
        "method = \"leapfrog\"\n[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [0, -1, 0]\n"
        "mass = 0.25\n[[spring]]\nends = [0, 1]\nstiffness = 100\n[pins]\nparticles = [0]\n");
  const ProgramResult result = call({"validate", "one.toml"});
  EXPECT_EQ(result.status, 0) << result.err;
  for (const char* part : {"2, 1 of them pinned", "1 (1 single)", "20 rad/s", "memory", "time"})
    EXPECT_NE(result.out.find(part), std::string::npos) << part << " in " << result.out;
  const ProgramResult json = call({"validate", "one.toml", "--json"});
  const auto told = JsonField::parse(json.out, "validate");
  EXPECT_EQ(told["format"].whole(), 1);
  const JsonField scene = told["scenes"][0];
  EXPECT_EQ(scene["springs"]["single"].whole(), 1);
  EXPECT_NEAR(scene["largest_omega"].number(), 20, 20 * 1e-3);  // power iteration, to 1e-4
  // leapfrog is stable up to 2 / omega, RK4 up to 2 sqrt(2) / omega
  EXPECT_NEAR(scene["critical_steps"]["rk4"].number(), 2 * std::sqrt(2.) / 20, 1e-3);
  EXPECT_NEAR(scene["critical_steps"]["leapfrog"].number(), 0.1, 1e-4);
  EXPECT_EQ(scene["critical_steps"]["explicit-euler"].number(), 0);
  EXPECT_EQ(scene["steps"].whole(), 100);
}

TEST_F(CliValidate, SaysHowAClothBends) {
  // For a sheet of rho = 0.2 kg/m^2 and B = 5e-5 N m, the bending length is (5e-5 / (0.2 x 9.81))^(1/3) = 0.0294 m.
  // Bending limits the step more than springs: its omega is 8 / d^2 sqrt(B / rho) = 1265 rad/s at a spacing d = 1 cm.
  const std::string text =
      "question = \"q\"\nparameters = \"p\"\n[time]\nduration = 1\nsamples = 10\nstep = 2e-3\nwindow = 1\n"
      "tolerance = 1e-3\nmethod = \"leapfrog\"\n[grid]\nsize = [21, 21]\norigin = [0, 0, 0]\nu = [0.2, 0, 0]\n"
      "v = [0, 0, 0.2]\nmass = 0.008\nbending = 5e-5\n[grid.stiffness]\nstructural = 1\n[pins]\nparticles = [0]\n"
      "[gravity]\nacceleration = [0, -9.81, 0]\n";
  write("bends.toml", text);
  const ProgramResult result = call({"validate", "bends.toml"});
  EXPECT_EQ(result.status, 0) << result.err;
  for (const char* part :
       {"B = 5e-05 N m, Poisson's ratio 0", "0.0294 m, 2.94 spacings of the grid", "is above leapfrog's critical step"})
    EXPECT_NE(result.out.find(part), std::string::npos) << part << " in " << result.out;
  const ProgramResult json = call({"validate", "bends.toml", "--json"});
  const auto told = JsonField::parse(json.out, "validate");
  EXPECT_NEAR(told["scenes"][0]["bending"]["spacings"].number(), 2.943, 1e-3);
}

TEST_F(CliValidate, TellsPiecesParticlesAtOnePlaceAndMasses) {
  // two bars with a common point that are not connected; the second bar has no pins
  const std::string head =
      "question = \"q\"\nparameters = \"p\"\n[time]\nduration = 1\nsamples = 10\nstep = 1e-3\nwindow = 1\ntolerance = "
      "1e-3\n"
      "method = \"leapfrog\"\n";
  std::string seam = head;
  for (const char* particle :
       {"[0, 0, 0]\nmass = 0.1", "[0.1, 0, 0]\nmass = 0.2", "[0.1, 0, 0]\nmass = 0.3", "[0.2, 0, 0]\nmass = 0.5"})
    seam += std::string("[[particle]]\nposition = ") + particle + "\n";
  for (const char* ends : {"[0, 1]", "[2, 3]"})
    seam += std::string("[[spring]]\nends = ") + ends + "\nstiffness = 50\n";
  write("seam.toml", seam + "[pins]\nparticles = [0]\n");
  const ProgramResult text = call({"validate", "seam.toml"});
  EXPECT_EQ(text.status, 0) << text.err;
  for (const char* part : {"2, 1 of them without a pin", "the first 1 and 2", "0.1 to 0.5 kg each, 1.1 kg in total",
                           "particles 1 and 2 start at the same place, but no spring joins their pieces"})
    EXPECT_NE(text.out.find(part), std::string::npos) << part << " in " << text.out;
  // the sheet has 0.06 kg on 0.2 m^2; the surface of a block is unrelated to the block's mass
  write("sheet.toml", head +
                          "[grid]\nsize = [3, 3]\norigin = [0, 0, 0]\nu = [0.5, 0, 0]\nv = [0, 0, 0.4]\nmass = 0.06\n"
                          "stiffness = { structural = 10 }\n");
  write("block.toml", head +
                          "[grid]\nsize = [2, 2, 3]\norigin = [0, 0, 0]\nu = [0.5, 0, 0]\nv = [0, 0.5, 0]\n"
                          "w = [0, 0, 0.4]\nmass = 0.06\nstiffness = { structural = 10 }\n");
  const auto told =
      JsonField::parse(call({"validate", "seam.toml", "sheet.toml", "block.toml", "circle", "--json"}).out, "validate");
  const JsonField one = told["scenes"][0], sheet = told["scenes"][1], block = told["scenes"][2];
  EXPECT_EQ(one["pieces"].whole(), 2);
  EXPECT_EQ(one["free_pieces"].whole(), 1);
  EXPECT_EQ(one["coincident"].size(), 1u);
  EXPECT_EQ(one["coincident"][0][1].whole(), 2);
  EXPECT_EQ(one["masses"]["least"].number(), 0.1);
  EXPECT_EQ(one["masses"]["largest"].number(), 0.5);
  EXPECT_NEAR(one["masses"]["total"].number(), 1.1, 1e-15);
  EXPECT_FALSE(one["masses"]["per_area"].is_number());
  EXPECT_NEAR(sheet["masses"]["per_area"].number(), 0.3, 1e-15);  // rounding
  EXPECT_EQ(sheet["pieces"].whole(), 1);
  EXPECT_FALSE(block["masses"]["per_area"].is_number());
}

TEST_F(CliValidate, LooksAtAllScenesAndTellsEveryFault) {
  write("good.toml", own_scene);
  std::string text = own_scene;
  write("bad.toml", text.replace(text.find("mass = 0.5"), 10, "mass = 0.x"));
  const ProgramResult result = call({"validate", "bad.toml", "good.toml", "chian", "no/such.toml"});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 3) << result.err;
  for (const char* part : {"bad.toml:16: ", "did you mean 'chain'?", "no/such.toml: cannot be read"})
    EXPECT_NE(result.err.find(part), std::string::npos) << part << " in " << result.err;
  EXPECT_NE(result.out.find("good.toml: a valid scene"), std::string::npos) << result.out;
}

TEST_F(CliValidate, WhatIsTooLargeIsRefusedBeforeItStarts) {
  write("block.toml",
        "question = \"q\"\nparameters = \"p\"\n[time]\nduration = 1\nsamples = 1000000\nstep = 1e-6\nwindow = 1\n"
        "tolerance = 1e-3\nmethod = \"leapfrog\"\n[grid]\nsize = [60, 60, 60]\norigin = [0, 0, 0]\nu = [1, 0, 0]\n"
        "v = [0, 1, 0]\nw = [0, 0, 1]\nmass = 1\n[grid.stiffness]\nstructural = 1\nshear = 1\nbend = 1\n");
  // the maximum is 20 000 s at 50 samples per second
  expect_refusal({"run", "chain", "--duration", "1e10"},
                 {"--duration", "5e+11 samples", "steps", "days", "B of frames", "a million samples", "20000 s"});
  expect_refusal({"run", "chain", "--step", "1e-13"}, {"a step of 1e-13 s makes", "steps, about", "1e+12", "--step"});
  // 216000 particles and a million frames, with 48 bytes per particle and frame: 10 TB
  expect_refusal({"run", "block.toml"}, {"out/run: 1000001 frames", "10.4 TB", "1e+06 steps", "free on the disk"});
  expect_refusal({"compare", "block.toml", "--methods", "rk4,leapfrog"}, {"block", "TB of memory", "216000 particles"});
  EXPECT_EQ(files(), 1);
}

TEST_F(CliValidate, NearestNamesAreProposed) {
  expect_refusal({"rnu"}, {"unknown command 'rnu'", "did you mean 'run'?"});
  expect_refusal({"--bogus"}, {"unknown option '--bogus'", "(crosscheck --help shows all)"});
  expect_refusal({"--verison"}, {"unknown option '--verison'", "did you mean '--version'?"});
  expect_refusal({"run", "chain", "--stpe", "1e-3"}, {"run: unknown option '--stpe'", "did you mean '--step'?"});
  expect_refusal({"run", "--methd=rk4"}, {"unknown option '--methd'", "did you mean '--method'?"});
  expect_refusal({"run", "chain", "spring"}, {"unexpected argument 'spring'"});
  expect_refusal({"run", "chian"}, {"did you mean 'chain'?"});
  expect_refusal({"run", "chain", "--method", "leapfrg"}, {"did you mean 'leapfrog'?"});
  expect_refusal({"run", "chain", "--method", "bulet/pbd"}, {"did you mean 'bullet/pbd'?"});
  expect_refusal({"run", "chain", "--method", "leapfrog+stcky"}, {"'+stcky'", "did you mean 'sticky'?"});
  expect_refusal({"experiment", "oder"}, {"did you mean 'order'?"});
  expect_refusal({"figures", "stabilty"}, {"did you mean 'stability'?"});
  expect_refusal({"list", "method"}, {"did you mean 'methods'?"});
  expect_refusal({"render", "chain", "--mode", "shadd", "-o", "p.png"}, {"did you mean 'shaded'?"});
  expect_refusal({"assignment", "a3-clot", "--out", "x"}, {"did you mean 'a3-cloth'?"});
  expect_refusal({"grade", "a3-cloth", ".", "--lane", "bogus"}, {"--lane bogus", "bwrap, uid, bare"});
}

TEST_F(CliValidate, PathsThatCannotBeAreBadInput) {
  fs::create_directories(folder_ / "folder.png");
  fs::create_directories(folder_ / "folder.toml");
  expect_refusal({"render", "chain", "-o", "folder.png"}, {"-o folder.png", "got a folder"});
  expect_refusal({"run", "folder.toml"}, {"folder.toml: cannot be read", "got a folder"});
  expect_refusal({"run", "chain", "--method", "exec:./folder.png"}, {"is a folder", "expected a program"});
  expect_refusal({"compare", "chain", "--trajectory", "folder.png"}, {"folder.png", "got a folder"});
  expect_refusal({"run", "chain", "--out", std::string(5000, 'x')}, {"--out", "expected a folder"});
  expect_refusal({"run", std::string(5000, 'x')}, {"xxx"});
  const ProgramResult nowhere =
      run_program({CROSSCHECK_PROGRAM, "check", "--protocol", CROSSCHECK_EXAMPLE}, folder_, {"TMPDIR=/nowhere/at/all"});
  EXPECT_EQ(nowhere.status, 2) << nowhere.err;
  EXPECT_NE(nowhere.err.find("/nowhere/at/all"), std::string::npos) << nowhere.err;
  EXPECT_EQ(nowhere.err.find("filesystem error"), std::string::npos) << nowhere.err;
}

TEST_F(CliValidate, TheVersionIsTold) {
  const ProgramResult result = call({"--version"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out.substr(0, 11), "crosscheck ");
}

TEST_F(CliValidate, ShortWorkTellsNoProgress) {
  const ProgramResult result = call({"run", "chain", "--duration", "0.02", "--out", "out"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.err, "");
}

}  // namespace
}  // namespace crosscheck
