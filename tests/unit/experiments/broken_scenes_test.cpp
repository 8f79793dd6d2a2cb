// Common mistakes in scene files. A user who sees only the file and the message must be able to correct the mistake
// with a single edit. Therefore, each message names the line to change, the key, the value found and the value
// expected.

#include <fstream>

#include "experiments/scenes/scenes.h"
#include "mysim/base/files.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

// a valid scene; the test cases below refer to its line numbers
constexpr std::string_view net = R"(# A net that hangs, with a weight.
question = "How far does a net hang?"
parameters = "Picked by hand."

[time]
duration = 2.0
samples = 40
step = 1e-3
window = 1.5
tolerance = 1e-4
method = "leapfrog"

[grid]
size = [5, 4]
origin = [0, 1, 0]
u = [1, 0, 0]
v = [0, 0, 1]
mass = 0.5
[grid.stiffness]
structural = 300
shear = 150

[[particle]]
position = [0.5, 0.2, 0]
mass = 0.1
[[particle]]
position = [0.5, -0.3, 0]
mass = 0.2

[[spring]]
ends = [2, 20]
stiffness = 80
[[spring]]
ends = [20, 21]
stiffness = 60
rest = 0.4

[pins]
particles = [0, 4]

[gravity]
acceleration = [0, -9.8100, 0]

[drag]
gamma = 2

[sphere]
centre = [0.5, -2, 0]
radius = 0.5
friction = 0.4
)";

struct Breakage {
  const char* name;
  std::string_view good, broken;    // text in the valid file, and its replacement in the broken one
  int line;                         // line in the message; 0: the message is about the whole file
  std::vector<const char*> expect;  // substrings of the message
};

std::string net_with(std::string_view good, std::string_view broken) {
  std::string text(net);
  const std::size_t at = text.find(good);
  EXPECT_NE(at, std::string::npos) << good;
  return text.replace(at, good.size(), broken);
}

const std::vector<Breakage>& breakages() {
  static const std::vector<Breakage> table = {
      // keys
      {"letters swapped", "duration = 2.0", "duratoin = 2.0", 6, {"time.duratoin: unknown key", "mean 'duration'?"}},
      {"a capital", "step = 1e-3", "Step = 1e-3", 8, {"time.Step: unknown key", "did you mean 'step'?"}},
      {"American", "centre =", "center =", 48, {"sphere.center: unknown key", "did you mean 'centre'?"}},
      {"an underscore too many", "friction =", "fric_tion =", 50, {"sphere.fric_tion", "did you mean 'friction'?"}},
      {"above its table",
       "[time]\nduration = 2.0",
       "duration = 2.0\n[time]",
       5,
       {"duration: unknown key", "it belongs to [time]"}},
      {"of another table", "gamma = 2", "gamma = 2\nmargin = 0.1", 46, {"drag.margin", "it belongs to [sphere]"}},
      {"a table misspelt", "[gravity]", "[gravitiy]", 41, {"gravitiy: unknown key", "did you mean 'gravity'?"}},
      {"a table in the plural", "[grid]", "[grids]", 13, {"grids: unknown key", "did you mean 'grid'?"}},
      {"two keys missing",
       "step = 1e-3\nwindow = 1.5\n",
       "",
       5,
       {"time.step, time.window: are missing", "step = a number above zero (s)", "window = a number above zero (s)"}},
      {"a whole table missing",
       "[time]\nduration = 2.0\nsamples = 40\nstep = 1e-3\nwindow = 1.5\ntolerance = 1e-4\nmethod = \"leapfrog\"\n",
       "",
       1,
       {"time: is missing", "[time] with duration = a number above zero (s)", "samples = a whole number",
        "method = the name of a method in quotes"}},
      {"one missing, one misspelt",
       "duration = 2.0\nsamples = 40",
       "duraton = 2.0",
       6,
       {"did you mean 'duration'?", "also missing: samples = a whole number"}},
      {"twice", "mass = 0.5", "mass = 0.5\nmass = 0.6", 19, {"mass is defined twice in this table, first in line 18"}},
      {"a table twice",
       "[drag]",
       "[gravity]\nacceleration = [0, 0, 0]\n[drag]",
       44,
       {"gravity is defined twice, first as [gravity] in line 41"}},
      // tables
      {"single brackets",
       "[[particle]]\nposition = [0.5, -0.3, 0]",
       "[particle]\nposition = [0.5, -0.3, 0]",
       26,
       {"particle is defined twice", "[[particle]] each time"}},
      {"single brackets, one alone",
       "[[spring]]\nends = [2, 20]\nstiffness = 80\n[[spring]]\nends = [20, 21]",
       "[spring]\nends = [20, 21]",
       30,
       {"spring: expected tables [[spring]]", "got [spring]", "double brackets"}},
      {"double brackets",
       "[pins]",
       "[[pins]]",
       38,
       {"pins: expected a table [pins]", "got [[pins]]", "single brackets"}},
      {"a number for a table",
       "[grid.stiffness]\nstructural = 300\nshear = 150",
       "stiffness = 300",
       19,
       {"grid.stiffness: expected a table [grid.stiffness]", "structural = a number above zero (N/m)", "got 300",
        "stiffness = { structural = 300 }"}},
      {"a header without its end", "[gravity]", "[gravity", 41, {"as many closing brackets", "[gravity]"}},
      {"brackets that do not match",
       "[[spring]]\nends = [20",
       "[[spring]\nends = [20",
       33,
       {"as many closing brackets", "[[spring]]"}},
      {"a table in braces over lines",
       "[grid.stiffness]\nstructural = 300\nshear = 150",
       "stiffness = {\n  structural = 300,\n  shear = 150\n}",
       19,
       {"braces", "same line"}},
      // numbers
      {"in quotes",
       "mass = 0.5",
       "mass = \"0.5\"",
       18,
       {"grid.mass: expected a number above zero, got \"0.5\"", "without quotes: 0.5"}},
      {"in quotes with a unit",
       "radius = 0.5",
       "radius = \"0.5 m\"",
       49,
       {"sphere.radius", "\"0.5 m\"", "without its unit"}},
      {"with a unit", "step = 1e-3", "step = 1e-3 s", 8, {"the number alone, without its unit", "step = 1e-3 s"}},
      {"a decimal comma", "tolerance = 1e-4", "tolerance = 0,0001", 10, {"decimal point, as in 0.5"}},
      {"no digit before the point", "friction = 0.4", "friction = .4", 50, {"digit before the decimal point: 0.4"}},
      {"no digit behind the point", "gamma = 2", "gamma = 2.", 45, {"digit after the decimal point"}},
      {"a fraction", "step = 1e-3", "step = 1/1000", 8, {"expressions are not evaluated"}},
      {"leading zeros", "samples = 40", "samples = 040", 7, {"without leading zeros"}},
      {"an exponent where a whole number stands",
       "samples = 40",
       "samples = 4e1",
       7,
       {"time.samples: expected a whole number", "got 4e1", "no exponent: 40"}},
      {"below zero", "mass = 0.2", "mass = -0.20", 28, {"particle[1].mass: expected a number above zero, got -0.20"}},
      {"yes", "friction = 0.4", "friction = yes", 50, {"unexpected word", "friction is a number not below zero"}},
      {"True", "friction = 0.4", "friction = True", 50, {"unexpected word", "friction is a number not below zero"}},
      // lists
      {"a vector of two",
       "origin = [0, 1, 0]",
       "origin = [0, 1]",
       15,
       {"grid.origin: expected three finite numbers [x, y, z], got [0, 1] (2 numbers)"}},
      {"a number for a vector",
       "acceleration = [0, -9.8100, 0]",
       "acceleration = -9.8100",
       42,
       {"gravity.acceleration: expected three finite numbers", "got -9.8100"}},
      {"parentheses", "u = [1, 0, 0]", "u = (1, 0, 0)", 16, {"list in square brackets"}},
      {"no brackets", "u = [1, 0, 0]", "u = 1, 0, 0", 16, {"list in square brackets"}},
      {"no commas", "v = [0, 0, 1]", "v = [0 0 1]", 17, {"expected commas between the entries"}},
      {"semicolons", "v = [0, 0, 1]", "v = [0; 0; 1]", 17, {"expected commas, no semicolons"}},
      {"not closed", "origin = [0, 1, 0]", "origin = [0, 1, 0", 15, {"the list that begins here has no closing ]"}},
      {"a text deep in a list",
       "particles = [0, 4]",
       "particles = [0, 1, 2,\n  3, \"4\"]",
       40,
       {"pins.particles[4]: expected a whole number", "got \"4\""}},
      {"a particle that is not there",
       "particles = [0, 4]",
       "particles = [0, 4, 22]",
       39,
       {"pins.particles[2]: expected a particle from 0 to 21 (there are 22), got 22"}},
      {"a decimal in a list",
       "ends = [20, 21]",
       "ends = [20, 21.0]",
       34,
       {"spring[1].ends[1]: expected a whole number", "got 21.0", "no exponent: 21"}},
      // texts
      {"no quotes", "method = \"leapfrog\"", "method = leapfrog", 11, {"text in quotes: \"leapfrog\""}},
      {"no quotes, with an apostrophe",
       "parameters = \"Picked by hand.\"",
       "parameters = Don't ask.",
       3,
       {"whole text in quotes"}},
      {"typographic quotes",
       "\"How far does a net hang?\"",
       "\u201cHow far does a net hang?\u201d",
       2,
       {"typographic quotation mark", "the straight one, \""}},
      {"not closed", "\"Picked by hand.\"", "\"Picked by hand.", 3, {"no closing quote"}},
      {"no such method",
       "method = \"leapfrog\"",
       "method = \"leapfrg\"",
       11,
       {"time.method: expected an existing method", "'leapfrg'", "did you mean 'leapfrog'?"}},
      // signs and lines
      {"a typographic minus", "[0, -9.8100, 0]", "[0, \u22129.81, 0]", 42, {"typographic minus", "the plain one, -"}},
      {"an invisible blank", "gamma = 2", "gamma =\u00a02", 45, {"invisible character (U+00A0)", "plain space"}},
      {"a colon", "radius = 0.5", "radius: 0.5", 49, {"expected = in place of the colon: radius = "}},
      {"two equal signs", "gamma = 2", "gamma == 2", 45, {"a single ="}},
      {"nothing behind it", "rest = 0.4", "rest =", 36, {"there is nothing after the =", "expected a value"}},
      {"a comma at the end", "gamma = 2", "gamma = 2,", 45, {"nothing after the number: no comma"}},
      {"another language's comment",
       "# A net that hangs, with a weight.",
       "// A net that hangs.",
       1,
       {"comments to begin with #"}},
      {"a unit before the =", "mass = 0.5", "mass [kg] = 0.5", 18, {"name of a key alone before the =", "'mass [kg]'"}},
      {"left by a merge", "gamma = 2", "<<<<<<< mine\ngamma = 2", 45, {"left by a merge"}},
      {"Latin-1", "Picked by hand.", "Gew\xe4hlt.", 3, {"UTF-8"}},
      // the physics
      {"a spring to itself", "ends = [2, 20]", "ends = [20, 20]", 31, {"two different particles, got 20 twice"}},
      {"a ball around a particle",
       "radius = 0.5",
       "radius = 1.8",
       49,
       {"sphere.radius: expected no particle inside", "particle 21"}},
      {"a step beyond the end",
       "step = 1e-3",
       "step = 3",
       8,
       {"time.step", "not longer than the duration of 2 s, got 3 s"}},
      {"the whole file",
       net,
       "",
       0,
       {"the file is empty", "question = a text in quotes", "[time] with duration", "[grid]"}},
      {"all but a comment",
       net,
       "# to be written\n",
       0,
       {"the file is empty except for comments", "[time] with duration"}},
  };
  return table;
}

TEST(BrokenScenes, TheGoodOneIsGood) {
  const TemporaryFolder folder("broken");
  write_file(folder.path / "net.toml", net);
  EXPECT_EQ(load_scene((folder.path / "net.toml").string()).model.particles.size(), 22);
}

TEST(BrokenScenes, EachMessageNamesTheLineAndTheMend) {
  const TemporaryFolder folder("broken");
  const std::string file = (folder.path / "net.toml").string();
  EXPECT_GE(breakages().size(), 40u);
  for (const Breakage& b : breakages()) {
    SCOPED_TRACE(b.name);
    write_file(file, net_with(b.good, b.broken));
    const std::string message = refusal_of([&] { load_scene(file); });
    EXPECT_TRUE(begins(message, b.line > 0 ? fmt::format("{}:{}: ", file, b.line) : file + ": "));
    for (const char* part : b.expect) EXPECT_TRUE(contains(message, part));
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    if (std::getenv("CROSSCHECK_SHOW_MESSAGES"))  // prints the messages for readers who have not seen the table
      fmt::print("{}\n", message.substr(file.size() - 8));
  }
}

}  // namespace
}  // namespace crosscheck
