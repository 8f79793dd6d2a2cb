// Tests how the page's code lays out charts of a stored quick report, and checks the types in the page's scripts.

#include "mysim/base/files.h"
#include "mysim/base/installation.h"
#include "mysim/base/json.h"
#include "mysim/base/process.h"
#include "report/base/assets.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/temporary.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

using ChartLayout = InFolder;

// golden/charts.json: `charts` of the report.json of a quick report, with long curves thinned and tooltips removed
TEST_F(ChartLayout, NamesLieAtTheirCurvesAndNothingIsCutOrMissing) {
  NEEDS_PROGRAM("node", "nodejs", "chart layout outside a browser is not tested");
  const std::filesystem::path source =
      std::filesystem::path(CROSSCHECK_SOURCE) / "tests/unit/report/golden/charts.json";
  write_file(folder_ / "layout.js",
             "const charts = " + read(source) + ";\n" + content_of_file(programs_folder() / "page/chart_layout.js"));
  const ProgramResult result = run_program({"node", (folder_ / "layout.js").string()}, folder_);
  ASSERT_TRUE(begins(result.out, "{")) << last_lines(result.err, 20);
  const JsonField saw = JsonField::parse(result.out, "what was laid out");
  for (const std::string& complaint : saw["complaints"].texts()) ADD_FAILURE() << complaint;
  EXPECT_GT(saw["charts"].number(), 100);
  EXPECT_GT(saw["names"].number(), 500);
  EXPECT_GT(saw["names"].number(), saw["leaders"].number()) << "some names must lie next to their curves";
}

TEST(Scripts, PassTheTypeChecker) {
  NEEDS_PROGRAM("tsc", "node-typescript", "the types of the page's scripts are not checked");
  const std::filesystem::path page = std::filesystem::path(CROSSCHECK_SOURCE) / "report/page";
  const ProgramResult result = run_program({"tsc", "-p", page.string()}, page);
  EXPECT_EQ(result.status, 0) << last_lines(result.out, 20);
}

}  // namespace
}  // namespace crosscheck
