// list: names of scenes, methods and so on; doctor: what is installed and what is missing.

#include <cstdlib>

#include "experiments/disagreements/disagreements.h"
#include "experiments/experiment.h"
#include "mysim/base/installation.h"
#include "mysim/base/process.h"
#include "reference/engines/engines.h"
#include "reference/truth/independent/integrators.h"
#include "report/commands/command_line.h"
#include "report/page/lab_html.h"

namespace crosscheck {
namespace {

struct ListOptions {
  std::string what;
  bool json = false;
};

int list_command(const ListOptions& options) {
  const auto& [what, json] = options;
  std::vector<std::pair<std::string, std::string>> rows;
  if (what == "scenes") {
    for (const auto name : shipped_scenes()) rows.emplace_back(name, load_scene(std::string(name)).question);
    for (const Disagreement& d : disagreements()) rows.emplace_back(d.name, scene_of(d).question);
  } else if (what == "methods") {
    for (const Method& method : all_methods()) rows.emplace_back(method.name, method.what);
    if (!json)
      rows.emplace_back(std::string(program_prefix) + "PATH",
                        "any program that speaks the engine protocol (reference/protocol/PROTOCOL.md)");
  } else if (what == "experiments") {
    for (const Experiment& experiment : experiments()) rows.emplace_back(experiment.name, experiment.question);
  } else if (what == "engines") {
    for (const OutsideEngine& e : outside_engines())
      rows.emplace_back(e.name,
                        fmt::format("{} ({}, {}, {} precision): {}", e.title, e.built, e.licence, e.precision, e.rule));
  } else if (what == "assignments") {
    grader_command(json ? std::vector<std::string>{"list", "--json"} : std::vector<std::string>{"list"});
  } else {
    throw InputError(fmt::format("list {}: expected scenes, methods, engines, experiments or assignments{}", what,
                                 did_you_mean(what, {"scenes", "methods", "engines", "experiments", "assignments"})));
  }
  Json list = Json::array();
  for (const auto& [name, text] : rows)
    if (json)
      list.push_back({{"name", name}, {"what", text}});
    else
      fmt::print("{:<38} {}\n", name, text);
  if (json) fmt::print("{}\n", dump(list, 2));
  return 0;
}

struct Tool {
  const char* name;
  std::string_view package;
  const char* purpose;
  bool required;
};

int doctor_command() {
  fmt::print("built with: {}\n", CROSSCHECK_COMPILER);
  const auto line = [](std::string_view name, std::string_view state, std::string_view what, std::string_view install) {
    fmt::print("  {:<14} {:<10} {}{}\n", name, state, what, install);
  };
  line("Eigen", CROSSCHECK_EIGEN_VERSION, "vectors and matrices", "");
  line("Bullet", CROSSCHECK_BULLET_VERSION,
       "the engine that mysim is compared with (double precision; single precision in a separate program)", "");
  line("odeint", odeint_version(), "an independent integrator from Boost, which checks reference solutions", "");
  line("SUNDIALS", sundials_version().value_or("absent"), "optional: a better integrator, replaces odeint",
       sundials_version() ? "" : "; apt-get install libsundials-dev, then rebuild");
  line(CROSSCHECK_OFFSCREEN, "linked", "renders pictures without a display\n", "");

  // installations compile only coursework and adapters
  const bool in_source_tree = std::filesystem::exists(data_folder() / "CMakeLists.txt");
  const Tool tools[] = {
      {"gnuplot", "gnuplot-nox", "draws the figures", true},
      {"git", "git", "names the commit in tables and captions", false},
      {"g++", "g++", "compiles coursework, adapters and the source tree", in_source_tree},
      {"cmake", "cmake", "builds adapters, and builds and tests the source tree", in_source_tree},
      {"bwrap", "bubblewrap", "isolates a submission from your files: `grade`", false},
      {"python3", "python3-numpy",
       "runs engines in NumPy, the Python package, and coursework in Python; needed by the tests", false},
      {"clang++", "clang", "another compiler, for `tests/mutants/builds.sh`", false},
      {"wasm-ld", lab_packages, "compiles mysim to WebAssembly, with clang: the lab in the page", false},
      {"node", "nodejs", "runs engines in JavaScript and WebAssembly; the tests run the lab's module in it", false},
      {"npm", "npm", "fetches JavaScript engines: `engine NAME`", false},
      {"pdflatex", "texlive-latex-base", "the tests compile a paper with a set of figures", false},
      {"chromium", "chromium", "a browser: the tests try the page's player in it; prints the page as PDF", false},
  };
  bool complete = true;
  for (const Tool& tool : tools) {
    const bool found = on_path(tool.name);
    complete &= found || !tool.required;
    line(tool.name,
         found           ? "found"
         : tool.required ? "MISSING"
                         : "absent",
         tool.purpose, found ? "" : fmt::format("; apt-get install --no-install-recommends {}", tool.package));
  }
  fmt::print("\nother engines, for `report --engines all`:\n");
  for (const OutsideEngine& engine : outside_engines()) {
    const bool built = std::filesystem::exists(kept_program(engine.name));
    line(engine.name, built ? "built" : "absent",
         fmt::format("{}, {}, {}{}", engine.title, engine.built, engine.licence,
                     engine.package.empty() ? "" : ", package " + engine.package),
         built ? "" : "; " + command_to_build(engine));
  }
  fmt::print("\n{}\n", complete ? "all required programs are installed" : "something required is missing");
  return complete ? 0 : 1;
}

}  // namespace

void add_list(CLI::App& app, Invocation& call) {
  auto [list, options] =
      add_command(app, call, "list", "lists scenes, methods, engines, experiments or assignments", list_command);
  list.add_option("WHAT", options.what, "scenes, methods, engines, experiments or assignments")->required();
  list.add_flag("--json", options.json, "prints JSON");
}

void add_doctor(CLI::App& app, Invocation& call) {
  app.add_subcommand("doctor", "lists the programs and libraries that Crosscheck uses and reports missing ones")
      ->callback([&call] { call.status = doctor_command(); });
}

}  // namespace crosscheck
