#include "report/regress/verdict_page.h"
#include "report/page/inline_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mysim/files.h"
#include "report/regress/failure_figures.h"

namespace crosscheck {
namespace {

std::string shown(const std::optional<double>& value, const std::string& word) {
  return value ? fmt::format("{:.7g}", *value) : word.empty() ? "-" : word;
}

std::string off_in_words(const Compared& row) {
  if (!row.was || !row.is) return "";
  return std::isinf(row.off()) ? "a count" : fmt::format("{:.3g}", row.off());
}

std::string where(const Compared& row) {
  std::string text = row.scene;
  if (!row.method.empty()) text += " under " + row.method;
  if (!row.without.empty()) text += " without " + row.without;
  return text;
}

PageTable table_of(const std::string& caption, const std::vector<Compared>& rows, bool with_question) {
  PageTable table{caption, {"quantity", "was", "is", "unit", "tolerance", "tolerances off", "verdict"}, {}};
  if (with_question) table.header.insert(table.header.begin(), "question");
  for (const Compared& row : rows) {
    std::vector<std::string> cells{row.quantity,
                                   shown(row.was, row.was_word),
                                   row.note.empty() ? shown(row.is, row.is_word) : row.note,
                                   row.unit == "word" ? "" : row.unit,
                                   row.was && row.is ? fmt::format("{:.2g}", row.tolerance) : "",
                                   off_in_words(row),
                                   std::string(name_of(row.state))};
    if (with_question) cells.insert(cells.begin(), where(row));
    table.rows.push_back(std::move(cells));
  }
  return table;
}

/// Those to look at first.
std::vector<Compared> by_size(std::vector<Compared> rows, size_t most) {
  std::stable_sort(rows.begin(), rows.end(), [](const Compared& a, const Compared& b) { return a.rank() > b.rank(); });
  if (rows.size() > most) rows.erase(rows.begin() + static_cast<long>(most), rows.end());
  return rows;
}

/// "12 of 39 questions, those that are off most"
std::string some_of(size_t shown, size_t all, const std::string& what) {
  return shown < all ? fmt::format("{} of {} {}: those that are off most", shown, all, what)
                     : fmt::format("{} {}", all, what);
}

std::string headline(const VerdictPage& page) {
  const auto wrong = std::count_if(page.result.rows.begin(), page.result.rows.end(),
                                   [](const auto& row) { return failed(row.state); });
  if (!page.blessed.empty()) return fmt::format("{} quantities blessed: {}", page.result.rows.size(), page.blessed);
  if (page.result.passed() && !page.speeds.passed()) return "The answers are the same, and something is slower";
  if (page.result.passed()) return fmt::format("Nothing moved: {} quantities are the same", page.result.rows.size());
  return fmt::format("{} of {} quantities failed", wrong, page.result.rows.size());
}

/// CPU times over those of a plain loop; empty where none was measured.
std::string speed_section(const Speeds& speeds) {
  if (speeds.rows.empty() && speeds.notes.empty()) return "";
  PageTable table{fmt::format("Speed of {} runs: CPU time over that of a plain loop of springs and gravity, in turns",
                              speeds.rows.size()),
                  {"run", "was", "is", "is / was", "interval", "noise", "verdict", "at what price"},
                  {}};
  for (const SpeedCompared& row : speeds.rows)
    table.rows.push_back({row.scene + " under " + row.method, row.was ? fmt::format("{:.3g}", *row.was) : "",
                          fmt::format("{:.3g}", row.is), row.was ? fmt::format("{:.3f}", row.change.median) : "",
                          row.was ? fmt::format("{:.3f} to {:.3f}", row.change.low, row.change.high) : "",
                          row.was ? fmt::format("{:.0f} %", 100 * row.noise) : "", std::string(name_of(row.state)),
                          row.sentence.empty() ? row.note : row.sentence});
  std::string out = "<section class=\"chapter\"><h2>Speed beside accuracy</h2>\n";
  for (const std::string& note : speeds.notes) out += fmt::format("<p class=\"note\">{}</p>\n", escaped(note));
  return out + (table.rows.empty() ? "" : page_table_html(table, !speeds.trades.empty())) + "</section>\n";
}

void first_screen(const VerdictPage& page, std::string& out) {
  out += fmt::format(
      "<header><h1>{}</h1></header>\n<main>\n<p class=\"question\">Beside {}.</p>\n<ul class=\"findings\">\n",
      escaped(headline(page)), escaped(page.beside));
  const auto say = [&out](const std::string& topic, const std::string& sentence) {
    out += fmt::format("<li class=\"{}\">{}</li>\n", topic, escaped(sentence));
  };
  if (!page.result.passed() && page.blessed.empty())
    say("failure", page.cause.empty() ? "Cause: not attributed. No single ingredient, rule or setting fits what moved "
                                        "and what held."
                                      : fmt::format("Cause: {}.", page.cause));
  for (const std::string& trade : page.speeds.trades) say("accuracy", fmt::format("Speed: {}.", trade));
  for (const FailedPoint& f : page.result.failures) say("failure", fmt::format("No answer: {}: {}", f.name, f.why));
  const auto fresh = std::count_if(page.result.rows.begin(), page.result.rows.end(),
                                   [](const auto& row) { return row.state == Standing::fresh; });
  if (fresh > 0)
    say("contact", fmt::format("New, with nothing to stand beside yet: {}.",
                               fresh == 1 ? "one quantity" : fmt::format("{} quantities", fresh)));
  out += "</ul>\n";
  for (const std::string& problem : page.problems)
    out += fmt::format("<p class=\"problem\">Missing: {}</p>\n", escaped(problem));
}

}  // namespace

std::string change_in_words(const Compared& row) {
  std::string text = fmt::format("was {}, is {}", shown(row.was, row.was_word), shown(row.is, row.is_word));
  if (row.unit != "word" && row.unit != "1") text += " " + row.unit;
  if (row.state == Standing::moved && row.was)
    text += fmt::format("; tolerance {:.2g}, {}{} off", row.tolerance, off_in_words(row),
                        std::isinf(row.off()) ? "" : " tolerances");
  return text;
}

std::vector<FailurePart> failure_parts(const std::vector<Question>& questions, const Regressed& result,
                                       const Regression& regression, int most, const Provenance& lines,
                                       std::vector<std::string>& problems) {
  std::vector<FailurePart> parts;
  for (const Question& q : worth_a_picture(questions, result.rows, most)) {
    const Evidence evidence = evidence_of(q, result.rows, regression);
    FailurePart part;
    part.scene = q.scene.name, part.heading = q.in_words();
    part.text = parting_in_words(evidence);
    part.images = failure_figures(evidence, lines, regression.out, problems);
    std::vector<Compared> wrong;
    std::copy_if(evidence.rows.begin(), evidence.rows.end(), std::back_inserter(wrong),
                 [](const Compared& row) { return failed(row.state); });
    const std::vector<Compared> worst = by_size(wrong, 6);
    part.table = table_of(some_of(worst.size(), wrong.size(), "quantities that failed"), worst, false);
    parts.push_back(std::move(part));
  }
  return parts;
}

void write_verdict_page(VerdictPage& page, const std::vector<Question>& questions, const Regression& regression,
                        int figures) {
  page.parts = failure_parts(questions, page.result, regression, figures, page.lines, page.problems);
  write_file(regression.out / "index.html", verdict_html(page));
  for (const std::string& problem : page.problems) fmt::print(stderr, "crosscheck: missing: {}\n", problem);
}

std::string verdict_html(const VerdictPage& page) {
  std::string out = page_head("Crosscheck: what moved");
  first_screen(page, out);
  const std::vector<Compared> worst = worst_of_each(page.result.rows);
  if (!worst.empty())
    out +=
        "<section class=\"chapter\"><h2>What failed</h2>\n<p class=\"note\">Of each question the quantity that is off "
        "most. All quantities: <code>regress.csv</code> beside this page.</p>\n" +
        page_table_html(
            table_of(some_of(std::min<size_t>(worst.size(), 15), worst.size(), "questions"), by_size(worst, 15), true),
            true) +
        "</section>\n";
  out += speed_section(page.speeds);
  if (!page.parts.empty() && page.parts.size() < worst.size())
    out += fmt::format(
        "<p class=\"note\">Drawn below: {} of {} questions, of each scene that which is off most first "
        "(more with --figures N).</p>\n",
        page.parts.size(), worst.size());
  for (const FailurePart& part : page.parts) {
    out += fmt::format("<section class=\"scene\"><h2>{}</h2>\n<p class=\"question\">{}</p>\n<div class=\"figures\">\n",
                       escaped(part.heading), escaped(part.text));
    for (const PageImage& image : part.images)
      if (image.file.extension() == ".svg") out += image_html(image, "chart");
    out += "</div>\n";
    for (const PageImage& image : part.images)
      if (image.file.extension() == ".png") out += image_html(image, "render");
    out += "<div class=\"chapter\">" + page_table_html(part.table) + "</div></section>\n";
  }
  return sharing_markers(
      out +
      "<section class=\"made\"><h2>How this was made</h2>\n<p>A tolerance is what rounding can do to the "
      "quantity in that engine, measured by moving the start a little; each row of a baseline says how. A "
      "cause is named only where it alone fits all that moved and all that held.</p>\n" +
      provenance_html(page.lines) + "</section>\n</main></body></html>\n");
}

}  // namespace crosscheck
