// The page of one submission. All that came from the student is escaped.
#include <fmt/format.h>

#include "tests/coursework/check/plot.h"
#include "tests/coursework/grader/text_format.h"

namespace coursework {
namespace {

constexpr const char* style = R"(<style>
body{font:16px/1.5 system-ui,sans-serif;max-width:50rem;margin:2rem auto;padding:0 1rem;color:#222}
h1{font-size:1.4rem}h2{font-size:1.15rem;margin-top:2rem}
section{border-left:4px solid #d62728;padding:.2rem 1rem;margin:1rem 0;background:#fafafa}
section.passed{border-color:#2ca02c}section h3{font-size:1rem;margin:.3rem 0}
p{margin:.3rem 0}.points{float:right;font-weight:normal}.total{font-size:1.2rem;font-weight:bold;white-space:pre-line}
.remark{background:#fff3cd;padding:.4rem .8rem;white-space:pre-wrap}svg{max-width:100%;height:auto;background:#fff}
</style>)";

std::string section_of(const Result& result, const TestResult& test, const Texts& common) {
  std::string text = fmt::format("<section class=\"{}\">\n<h3>{} {} {}<span class=\"points\">{}</span></h3>\n",
                                 passed(test) ? "passed" : "failed", escaped(test.id), escaped(test.title),
                                 test.hidden ? "(" + escaped(common.of("hidden")) + ")" : "",
                                 escaped(common.fill("points", points_text(test.earned), points_text(test.points))));
  for (const std::string& line : lines_on(result, test, common)) text += "<p>" + escaped(line) + "</p>\n";
  return text + test.plot + "</section>\n";
}

}  // namespace

std::string page_of(const Result& result, const Texts& common, const Texts& own, const std::string& charts) {
  const std::string title =
      escaped(common.fill("page.title", own.has("title") ? own.of("title") : result.assignment, result.submission));
  std::string page = fmt::format(
      "<!DOCTYPE html>\n<html><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\">"
      "<title>{0}</title>\n{1}</head><body>\n<h1>{0}</h1>\n<p class=\"total\">{2}</p>\n<p>{3}</p>\n",
      title, style, escaped(total_of(result, common)),
      escaped(common.fill("page.lane", result.secret ? common.of("page.secret") : std::to_string(result.seed),
                          result.lane)));
  if (!result.complete) page += "<p class=\"remark\">" + escaped(common.of("page.not_done")) + "</p>\n";
  for (const std::string& line : result.preflight) page += "<p class=\"remark\">" + escaped(line) + "</p>\n";
  if (!charts.empty())
    page += fmt::format("<p><a href=\"{}\">{}</a></p>\n", escaped(charts), escaped(common.of("page.charts")));
  std::string part;
  bool hidden = false;
  for (const TestResult& test : result.tests) {
    if (test.part != part || test.hidden != hidden) {
      part = test.part, hidden = test.hidden;
      const std::string key = part + ".title";
      page += fmt::format("<h2>{}{}</h2>\n", escaped(own.has(key) ? own.of(key) : part),
                          hidden ? " (" + escaped(common.of("hidden")) + ")" : "");
    }
    page += section_of(result, test, common);
  }
  return page + "</body></html>\n";
}

}  // namespace coursework
