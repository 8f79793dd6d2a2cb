// Tests the Python package: its own tests with Debian's python3, and `pip install` from the tree.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/report/cli.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

constexpr auto python = "/usr/bin/python3";  // because another python3 may come first in PATH
constexpr auto package_folder = CROSSCHECK_SOURCE "/report/python";

bool imports(const std::string& module) {
  return fs::exists(python) && run_program({python, "-c", "import " + module}, "/").status == 0;
}

#define NEEDS_MODULE(module, package, not_tried) \
  if (!imports(module)) GTEST_SKIP() << "package " package " is not installed: " not_tried

class PythonPackage : public Cli {
 protected:
  std::vector<std::string> environment(const std::string& path) const {
    return {"CROSSCHECK=" CROSSCHECK_PROGRAM,
            std::string("CROSSCHECK_PYTHON=") + package_folder,
            "PYTHONPATH=" + path,
            "PYTHONDONTWRITEBYTECODE=1",
            "MPLBACKEND=Agg",
            "MPLCONFIGDIR=" + folder_.string(),
            "HOME=" + folder_.string(),
            "TMPDIR=" + folder_.string()};
  }
  /// Expects success of these test classes of python/test_package.py.
  void expect_good(std::vector<std::string> classes) const {
    for (std::string& name : classes) name = "test_package." + name;
    classes.insert(classes.begin(), {python, "-m", "unittest"});
    const ProgramResult tried =
        run_program(classes, CROSSCHECK_SOURCE "/tests/unit/report/python", environment(package_folder));
    EXPECT_EQ(tried.status, 0) << tried.out << tried.err;
    EXPECT_TRUE(contains(tried.err, "\nOK"));
  }
};

TEST_F(PythonPackage, ReadsTablesAndItsExamplesAreTrue) {
  NEEDS_MODULE("numpy", "python3-numpy", "the Python package crosscheck is not tested");
  expect_good({"Documentation", "Tables"});
}

TEST_F(PythonPackage, NamesNumPyWhereItIsMissing) {
  if (!fs::exists(python)) GTEST_SKIP() << "package python3 is not installed";
  const ProgramResult missing =
      run_program({python, "-c", "import sys\nsys.modules['numpy'] = None\nimport crosscheck"}, folder_,
                  environment(package_folder));
  EXPECT_EQ(missing.status, 1);
  EXPECT_TRUE(contains(missing.err, "\nImportError: crosscheck needs NumPy: install python3-numpy")) << missing.err;
  EXPECT_FALSE(contains(missing.err, "During handling")) << missing.err;
}

TEST_F(PythonPackage, RunsScenesAndSaysWhatTheProgramSays) {
  NEEDS_MODULE("numpy", "python3-numpy", "the Python package crosscheck is not tested");
  expect_good({"Runs", "Plots"});
}

TEST_F(PythonPackage, MakesAStepFunctionAnEngine) {
  NEEDS_MODULE("numpy", "python3-numpy", "the Python package crosscheck is not tested");
  expect_good({"Engines"});
}

TEST_F(PythonPackage, DrawsWhatWasRun) {
  NEEDS_MODULE("matplotlib", "python3-matplotlib", "plots and the notebook are not tested");
  expect_good({"Drawn"});
}

TEST_F(PythonPackage, IsInstalledFromTheTreeWithoutANetwork) {
  std::vector<std::string> missing;
  for (const char* module : {"numpy", "pip", "setuptools", "wheel"})
    if (!imports(module)) missing.push_back(std::string("python3-") + module);
  if (!missing.empty())
    GTEST_SKIP() << fmt::format("package {} is not installed: its installation into an environment is not tested",
                                fmt::join(missing, ","));
  // install from a copy, because setuptools builds next to its sources
  fs::copy(package_folder, folder_ / "python", fs::copy_options::recursive);
  const std::string own = (folder_ / "venv/bin/python").string();
  const ProgramResult made =
      run_program({python, "-m", "venv", "--system-site-packages", "--without-pip", "venv"}, folder_, environment(""));
  ASSERT_EQ(made.status, 0) << made.out << made.err;
  const ProgramResult installed = run_program({python, "-m", "pip", "--python", own, "install", "--no-build-isolation",
                                               "--no-index", "--disable-pip-version-check", "./python"},
                                              folder_, environment(""));
  ASSERT_EQ(installed.status, 0) << installed.out << installed.err;
  const std::string found = run_program({own, "-c", "import crosscheck; print(crosscheck.__file__)"}, folder_).out;
  EXPECT_TRUE(begins(found, (folder_ / "venv/lib").string()));
  if (!imports("matplotlib")) return;
  const std::string readme = read(fs::path(package_folder) / "README.md");
  const size_t start = readme.find("```python\n") + 10;
  std::string first = readme.substr(start, readme.find("```", start) - start);
  EXPECT_LE(std::count(first.begin(), first.end(), '\n'), 5);
  first += "import matplotlib.pyplot\nmatplotlib.pyplot.savefig('first.png')\n";
  const ProgramResult drawn = run_program({own, "-c", first}, folder_, environment(""));
  EXPECT_EQ(drawn.status, 0) << drawn.err;
  EXPECT_GT(fs::file_size(folder_ / "first.png"), 10000u);
}

}  // namespace
}  // namespace crosscheck
