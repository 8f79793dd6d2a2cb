// The same bytes, whatever locale and time zone the program is started in: its figures, pictures, tables and words.
#include <regex>

#include "tests/unit/cli.h"
#include "tests/unit/optional_packages.h"

namespace crosscheck::testing_tools {
namespace {

/// What differs with the clock, and with nothing else.
std::string without_clock(const std::string& text) {
  static const std::regex clock("[0-9]{4}-[0-9]{2}-[0-9]{2}( [0-9]{2}:[0-9]{2}:[0-9]{2} UTC)?");
  return std::regex_replace(text, clock, "TIME");
}

class LocaleCli : public Cli {
 protected:
  /// Runs the program with these entries as its environment, besides PATH, HOME and the folder of truths.
  ProgramResult bare(const std::vector<std::string>& entries, const std::vector<std::string>& words) const {
    std::vector<std::string> call{"env", "-i", "HOME=" + folder_.string(), "ASAN_OPTIONS=detect_leaks=0"};
    for (const char* kept : {"PATH", "CROSSCHECK_CACHE"})
      if (const char* value = std::getenv(kept)) call.push_back(std::string(kept) + "=" + value);
    call.insert(call.end(), entries.begin(), entries.end());
    call.emplace_back(CROSSCHECK_PROGRAM);
    call.insert(call.end(), words.begin(), words.end());
    return run_program(call, folder_);
  }

  /// All files of a small set of figures and tables, by name; text files without the clock.
  std::map<std::string, std::string> made_in(const std::vector<std::string>& entries) const {
    fs::remove_all(folder_ / "out");
    write("mine.toml", own_scene);
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"figures", "order", "mine-picture", "--scene", "mine.toml", "--out", "out"},
          {"run", "mine.toml", "--method", "rk4", "--out", "out/run"},
          {"render", "mine.toml", "--methods", "rk4", "--size", "320x180", "-o", "out/still.png"}}) {
      const ProgramResult made = bare(entries, words);
      EXPECT_EQ(made.status, 0) << words[0] << ": " << made.err;
      EXPECT_EQ(made.err.find("gnuplot warns"), std::string::npos) << made.err;
    }
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / "out"))
      // the manifest holds who wrote when, and hashes of files that hold the date
      if (entry.is_regular_file() && entry.path().filename() != "crosscheck.json") {
        const std::string ending = entry.path().extension();
        const bool text = ending == ".csv" || ending == ".json" || ending == ".cff";
        files[fs::relative(entry.path(), folder_ / "out")] = text ? without_clock(read(entry)) : read(entry);
      }
    return files;
  }

  void expect_same(const std::map<std::string, std::string>& files,
                   const std::map<std::string, std::string>& expected) {
    EXPECT_EQ(files.size(), expected.size());
    for (const auto& [name, content] : expected) {
      ASSERT_TRUE(files.contains(name)) << name;
      EXPECT_TRUE(files.at(name) == content) << name << " differs";
    }
  }
};

/// What a run tells of its own time: run.json has costs.
std::map<std::string, std::string> without_costs(std::map<std::string, std::string> files) {
  files.erase("run/run.json");
  return files;
}

TEST_F(LocaleCli, ChangesNoByte) {
  const auto plain = without_costs(made_in({}));
  for (const char* file : {"mine-order.svg", "mine-order.pdf", "mine-order.png", "mine-order.csv", "mine-picture.pdf",
                           "mine-picture.png", "figures.json", "run/energy.csv", "still.png"})
    EXPECT_TRUE(plain.contains(file)) << file;
  // zones as POSIX writes them, which need no data base; St. John's half hour and Kathmandu's three quarters
  for (const std::vector<std::string>& entries :
       {std::vector<std::string>{"LC_ALL=C", "TZ=NPT-5:45"},
        {"LC_ALL=POSIX", "TZ=NST3:30NDT"},
        {"LC_ALL=C.UTF-8", "TZ=LINT-14"},
        {"LANG=tr_TR.UTF-8", "LC_NUMERIC=de_DE.UTF-8", "LANGUAGE=de", "TZ=:nowhere"}}) {
    SCOPED_TRACE(entries[0] + " " + entries.back());
    expect_same(without_costs(made_in(entries)), plain);
  }
}

TEST_F(LocaleCli, WithDecimalCommasChangesNoByte) {
  if (!fs::exists("/usr/share/i18n/locales/de_DE"))
    GTEST_SKIP() << "package locales is not installed: no locale with decimal commas is tried";
  fs::create_directories(folder_ / "locales");
  const ProgramResult compiled =
      run_program({"localedef", "-i", "de_DE", "-f", "UTF-8", (folder_ / "locales/de_DE.UTF-8").string()}, folder_);
  ASSERT_TRUE(fs::exists(folder_ / "locales/de_DE.UTF-8")) << compiled.err;
  const std::vector<std::string> german{"LOCPATH=" + (folder_ / "locales").string(), "LC_ALL=de_DE.UTF-8"};
  // that it is in force: bash writes numbers as its locale does
  std::vector<std::string> comma{"env"};
  comma.insert(comma.end(), german.begin(), german.end());
  comma.insert(comma.end(), {"bash", "-c", "printf %.1f 0,5"});
  ASSERT_EQ(run_program(comma, folder_).out, "0,5");
  expect_same(without_costs(made_in(german)), without_costs(made_in({})));
}

TEST_F(LocaleCli, TimesInTablesAreUtc) {
  write("mine.toml", own_scene);
  for (const char* zone : {"TZ=LINT-14", "TZ=AoE12"}) {
    const std::time_t before = std::time(nullptr);
    const ProgramResult made = bare({zone}, {"run", "mine.toml", "--method", "rk4", "--out", "out"});
    ASSERT_EQ(made.status, 0) << made.err;
    const std::string table = read(folder_ / "out/energy.csv");
    const size_t at = table.find("# date: ");
    ASSERT_NE(at, std::string::npos) << table.substr(0, 500);
    std::tm time{};
    ASSERT_NE(strptime(table.c_str() + at + 8, "%Y-%m-%d %H:%M:%S UTC", &time), nullptr);
    EXPECT_NEAR(std::difftime(timegm(&time), before), 0, 3600) << zone << ": 14 and 12 hours off otherwise";
  }
}

}  // namespace
}  // namespace crosscheck::testing_tools
