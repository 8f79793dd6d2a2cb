// A report from an untrusted source runs no script and starts no program.

#include <nlohmann/json.hpp>

#include "experiments/tables/table.h"
#include "mysim/base/csv.h"
#include "mysim/base/files.h"
#include "report/findings/evidence.h"
#include "tests/unit/helpers.h"
#include "tests/unit/report/in_browser.h"

namespace crosscheck {
namespace {

using namespace testing_tools;
namespace fs = std::filesystem;

constexpr auto payload = "</script><img src=x onerror=document.documentElement.dataset.pwned=1>\"' onclick='`&$(x)";

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

class ReceivedReport : public InBrowser {
 protected:
  ProgramResult call(std::vector<std::string> words) const {
    words.insert(words.begin(), CROSSCHECK_PROGRAM);
    return run_program(words, folder_, {"CROSSCHECK_LOCK=" + (folder_ / "lock").string()});
  }
  void change(const fs::path& file, const std::string& from, const std::string& to) const {
    std::string text = read(file);
    replace_all(text, from, to);
    write_file(file, text);
  }
  bool runs_script(const fs::path& page) const {
    return contains(browse(page, {"--dump-dom"}).out, "data-pwned=\"1\"");
  }

  /// Writes a report on a small cloth whose scene, rows and notes contain the payload. A program that touches PWNED
  /// replaces rk4. Fingerprints are correct.
  void make_report() const {
    const std::string program = script(std::string("evil") + std::string(payload).substr(9) + ".sh",
                                       "touch '" + (folder_ / "PWNED").string() + "'\n"),
                      name = "exec:" + program;
    std::string scene = small_cloth().source;
    const auto quoted = [](const std::string& text) { return dump(Json(text)); };
    replace_all(scene, "question = \"q\"", "question = " + quoted(payload));
    replace_all(scene, "parameters = \"p\"", "parameters = " + quoted(payload));
    write("own.toml", scene);
    const ProgramResult made = call({"report", "own.toml", "--quick", "--methods", "leapfrog,rk4", "--out", "rep"});
    ASSERT_TRUE(fs::exists(folder_ / "rep/index.html")) << made.err;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / "rep")) {
      if (entry.path().extension() == ".csv") change(entry.path(), "mysim/rk4", csv_field(name));
      if (entry.path().extension() == ".json") change(entry.path(), "\"mysim/rk4\"", quoted(name));
    }
    const fs::path file = folder_ / "rep/report.json";
    const JsonField json = JsonField::parse_file(file.string());
    for (const JsonField& table : json["tables"].elements())
      change(file, table["fingerprint"].text(),
             evidence_of(read_csv(folder_ / "rep/data" / (table["name"].text() + ".csv"))).fingerprint);
    for (const char* list : {"notes", "problems"})
      change(file, fmt::format("\"{}\": [", list),
             fmt::format("\"{}\": [{}{}", list, quoted(payload), json[list].size() > 0 ? "," : ""));
    for (const auto& entry : fs::directory_iterator(folder_ / "rep/figures"))
      if (entry.path().extension() == ".png") fs::remove(entry.path());  // so that the report draws the picture again
  }
};

TEST_F(ReceivedReport, RunsNoScriptInThePageAndNoProgram) {
  make_report();
  if (HasFatalFailure()) return;
  const ProgramResult again = call({"report", "--from", "rep", "--out", "again"});
  ASSERT_TRUE(fs::exists(folder_ / "again/index.html")) << again.err;
  call({"figures", "--from", "rep", "--out", "figures"});
  call({"report", "--verify", "rep"});
  EXPECT_FALSE(fs::exists(folder_ / "PWNED"));
  const std::string page = read(folder_ / "again/index.html");
  EXPECT_TRUE(contains(page, "onerror")) << "the payload must be in the page";
  NEEDS_CHROMIUM;
  // folds insert their contents when they are opened
  write("opened.html", page +
                           "<script>for (const fold of document.querySelectorAll('details')) fold.open = true;"
                           "</script>");
  write("control.html", std::string("<p>") + payload);
  EXPECT_TRUE(runs_script(folder_ / "control.html")) << "the control page must run the script";
  EXPECT_FALSE(runs_script(folder_ / "opened.html"));
}

TEST_F(ReceivedReport, WithPathsOutsideOrLinksIsRefused) {
  write("secret", "mine");
  const ProgramResult made = call({"report", "circle", "--quick", "--methods", "rk4,leapfrog", "--out", "rep"});
  ASSERT_EQ(made.status, 0) << made.err;
  std::vector<std::vector<std::string>> readers{{"report", "--verify", "rep"},
                                                {"report", "--from", "rep", "--out", "a"},
                                                {"figures", "--from", "rep", "--out", "b"}};
  const auto expect_refused = [&](const char* said) {
    for (const std::vector<std::string>& words : readers) {
      const ProgramResult refused = call(words);
      EXPECT_EQ(refused.status, 2);
      EXPECT_TRUE(contains(refused.err, said));
    }
    EXPECT_FALSE(fs::exists(folder_ / "a")) << "nothing may be written";
  };
  const fs::path file = folder_ / "rep/report.json";
  const std::string before = read(file);
  change(file, "\"name\": \"", "\"name\": \"../../");
  expect_refused("report.json: tables: expected a name");
  write_file(file, before);
  change(file, "\"format\": 2", "\"format\": 3");
  expect_refused("report.json: expected a report of format 2, got 3");
  EXPECT_EQ(call({"report", "circle", "--against", "rep", "--out", "a"}).status, 2);
  write_file(file, before);
  change(file, "\"file\":\"runs/", "\"file\":\"../runs/");
  readers.erase(readers.begin());  // `report --verify` reads no runs
  expect_refused("../runs/");
  write_file(file, before);
  for (const auto& runs : fs::recursive_directory_iterator(folder_ / "rep/runs"))
    if (runs.is_regular_file()) write_file(runs, std::string(fs::file_size(runs), 'x'));
  expect_refused(".u16.gz");
  fs::create_symlink("../../secret", folder_ / "rep/data/link.json");
  expect_refused("link.json: expected a file or folder, got a symbolic link");
}

}  // namespace
}  // namespace crosscheck
