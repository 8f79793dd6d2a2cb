// Child processes run with a fixed locale and time zone, and leave complete files.

#include <sys/wait.h>

#include <cstdlib>

#include "mysim/base/process.h"
#include "report/base/gnuplot.h"
#include "tests/unit/helpers.h"
#include "tests/unit/temporary.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

class StartedPrograms : public InFolder {
 protected:
  SetVariable all_{"LC_ALL", "de_DE.UTF-8"}, numbers_{"LC_NUMERIC", "fr_FR.UTF-8"}, lang_{"LANG", "tr_TR.UTF-8"},
      words_{"LANGUAGE", "de:fr"}, zone_{"TZ", "Asia/Kathmandu"}, own_{"CROSSCHECK_OWN", "kept"};
};

constexpr auto tell = "echo $LC_ALL-$LC_NUMERIC-$LANG-$LANGUAGE-$TZ-$CROSSCHECK_OWN";
constexpr auto told = "C.UTF-8----UTC-kept\n";

TEST_F(StartedPrograms, HaveTheSameLocaleAndTimeZoneWhoeverStartsThem) {
  EXPECT_EQ(run_program({"sh", "-c", tell}, folder_).out, told);
  EXPECT_EQ(run_program({"/bin/sh", "-c", tell}, folder_, {}, 60).out, told);
}

TEST_F(StartedPrograms, FindWhatTheyAreGivenInPlaceOfIt) {
  EXPECT_EQ(run_program({"sh", "-c", tell}, folder_, {"LC_ALL=C", "TZ=XXX-1", "CROSSCHECK_OWN=another"}).out,
            "C----XXX-1-another\n");
  for (const std::string& entry : program_environment({"LC_ALLY=1", "LANG=C"}))
    EXPECT_FALSE(entry.starts_with("LANG=tr") || entry.starts_with("LC_ALL=de")) << entry;
}

class Gnuplot : public InFolder {
 protected:
  /// gnuplot's warnings about a script that must write `file`, or "failed: " and the error message.
  std::string said(const std::string& commands, const std::string& file) const {
    write("script.gp", commands);
    try {
      return run_gnuplot("script.gp", folder_, {file}, "figure x");
    } catch (const std::runtime_error& error) {
      return std::string("failed: ") + error.what();
    }
  }
};

TEST_F(Gnuplot, AWarningIsNoFailure) {
  for (const auto& [terminal, file] : {std::pair{"svg", "a.svg"}, {"pdfcairo", "a.pdf"}, {"pngcairo", "a.png"}}) {
    const std::string draws = fmt::format("set term {}\nset output '{}'\nplot x\nset output\n", terminal, file);
    EXPECT_EQ(said(draws, file), "") << file;
    EXPECT_EQ(said("print 'iconv failed to convert degree sign'\n" + draws, file),
              "iconv failed to convert degree sign");
  }
}

TEST_F(Gnuplot, AFileThatIsMissingEmptyOrCutOffIs) {
  EXPECT_EQ(said("print 'no idea'\n", "a.png"), "failed: figure x: gnuplot: a.png was not written: no idea");
  EXPECT_EQ(said("system 'touch b.png'\n", "b.png"), "failed: figure x: gnuplot: b.png is empty");
  for (const auto& [terminal, name] : {std::pair{"svg", "c.svg"}, {"pdfcairo", "c.pdf"}, {"pngcairo", "c.png"}}) {
    const std::string draws = fmt::format("set term {}\nset output '{}'\nplot x\nset output\n", terminal, name);
    ASSERT_EQ(said(draws, name), "");
    const auto file = folder_ / name;
    for (const double part : {0.9, 0.5, 0.1}) {
      std::filesystem::resize_file(file, static_cast<size_t>(part * static_cast<double>(file_size(file))));
      EXPECT_EQ(said("", name), fmt::format("failed: figure x: gnuplot: {} is cut off", name));
    }
  }
  EXPECT_TRUE(said("plot nonsense(", "a.png").starts_with("failed: figure x: gnuplot (exit code 1): "));
}

TEST_F(Gnuplot, NobodysOwnSettingsAreRead) {
  write(".gnuplot", "exit status 3\n");
  const SetVariable home("HOME", folder_.c_str());
  EXPECT_EQ(said("system 'echo drawn > d'\n", "d"), "");
}

}  // namespace
}  // namespace crosscheck
