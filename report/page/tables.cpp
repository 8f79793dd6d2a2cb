// Tables of the page: recommendations, chapters, runs of a scene, certificates, methods.

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "report/findings/findings_text.h"
#include "report/page/page.h"

namespace crosscheck {
namespace {

std::string length_cell(const std::optional<double>& value, double floor = 0) {
  if (!value) return "<td class=\"none\">–</td>";
  if (*value < floor) return fmt::format("<td>&lt; {}</td>", nice_length(floor));
  return fmt::format("<td>{}</td>", nice_length(*value));
}

/// A clearance, negative inside; round-off counts as zero.
std::string signed_length(double metres) { return std::abs(metres) < 1e-12 ? "0 m" : nice_length(metres); }

std::string verdict_cell(const MethodData& m, const SceneData& facts) {
  if (is_useless(m, facts))
    return fmt::format("<td class=\"failed\">ok, but {} of the motion off</td>",
                       prose(percent(*m.error, facts.motion)));
  if (m.ok()) return "<td class=\"ok\">ok</td>";
  if (!m.supported()) return fmt::format("<td class=\"unsupported\">unsupported: {}</td>", escaped(m.reason));
  const std::string what = m.verdict == Verdict::energy ? "ten times too fast"
                           : m.verdict == Verdict::nan  ? "not a number"
                                                        : m.failure();
  return fmt::format("<td class=\"failed\" title=\"{}\">{} at {:.3g} s</td>", what, m.failure(), m.end);
}

/// The mean with as many digits as its deviation allows.
std::string with_digits_of(double mean, double spread) {
  if (std::abs(mean) < 1e-12) return "0";
  if (!(spread > 0) || std::abs(mean) < 1e-3) return nice(mean);
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(spread))), 0, 9);
  return fmt::format("{:.{}f}", mean, decimals);
}

/// Whether a cell is a number with its unit ("1.0e-7 m"), which is not broken over lines.
bool is_number(const std::string& cell) {
  return cell.size() <= 12 && cell.find_first_of("0123456789") <= 2 && !cell.starts_with("1/");
}

/// Lets names of methods break behind the slash, so that eight columns fit half a page.
std::string narrow(const std::string& cell) {
  std::string out;
  bool in_tag = false;
  for (const char c : prose(cell)) {
    in_tag = c == '<' || (in_tag && c != '>');
    out += c;
    if (c == '/' && !in_tag) out += "<wbr>";
  }
  return out;
}

}  // namespace

std::string page_table_html(const PageTable& table) {
  const auto has_cells = [&](size_t column) {  // an empty column says nothing
    return std::ranges::any_of(table.rows, [&](const auto& row) { return !row[column].empty(); });
  };
  std::string out = fmt::format("<div class=\"scroll\"><table><caption>{}</caption><thead><tr>", prose(table.caption));
  for (size_t i = 0; i < table.header.size(); ++i)
    if (has_cells(i)) out += fmt::format("<th>{}</th>", prose(table.header[i]));
  out += "</tr></thead><tbody>\n";
  for (const auto& row : table.rows) {
    out += builtin_method(row[0]) ? fmt::format("<tr data-method=\"{}\">", escaped(row[0])) : "<tr>";
    for (size_t i = 0; i < row.size(); ++i)
      if (has_cells(i))
        out += i == 0 ? fmt::format("<th scope=\"row\">{}</th>", narrow(row[i]))
                      : fmt::format("<td{}>{}</td>",
                                    row[i].empty()      ? " class=\"none\""
                                    : is_number(row[i]) ? " class=\"number\""
                                                        : "",
                                    row[i].empty() ? "–" : narrow(row[i]));
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string run_table_html(const ScenePart& part) {
  const bool contact = part.scene->model.find<Spheres>();
  std::string out = fmt::format(
      "<div class=\"scroll\"><table><thead><tr><th>method</th><th>verdict</th><th>RMS position "
      "error</th><th>difference "
      "from symplectic Euler</th>{}<th>relative energy residual</th><th>force evaluations</th></tr></thead><tbody>\n",
      contact ? "<th>distance between centres of mass</th><th>clearance</th><th>creep at end</th>" : "");
  for (const MethodData& m : part.facts->methods) {
    out += fmt::format(
        "<tr data-method=\"{0}\"><th scope=\"row\">{0}{1}</th>{2}{3}{4}", escaped(m.method),
        m.different_law.empty()
            ? ""
            : fmt::format("<span class=\"law\" title=\"{}\">different law</span>", escaped(m.different_law)),
        verdict_cell(m, *part.facts), length_cell(m.error, part.facts->error_bar), length_cell(m.difference));
    if (contact) {
      out += length_cell(m.centres);
      out += m.clearance ? fmt::format("<td>{}</td>", signed_length(*m.clearance)) : "<td class=\"none\">–</td>";
      out += m.creep ? fmt::format("<td>{} mm/s</td>", nice(1e3 * *m.creep)) : "<td class=\"none\">–</td>";
    }
    out += m.energy_error ? fmt::format("<td>{} %</td>", nice(100 * *m.energy_error)) : "<td class=\"none\">–</td>";
    out += m.supported() ? fmt::format("<td>{}</td>", m.evaluations) : "<td class=\"none\">–</td>";
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string statistics_html(const Table& table) {
  std::string out = "<div class=\"scroll\"><table><thead><tr><th>mean ± standard deviation of 16 perturbed runs</th>";
  std::vector<std::string> quantities, methods;
  auto note = [](std::vector<std::string>& list, const Cell& cell) {
    const auto& text = std::get<std::string>(cell);
    if (std::find(list.begin(), list.end(), text) == list.end()) list.push_back(text);
  };
  for (size_t i = 0; i < table.rows.size(); ++i)
    if (number_at(table, i, "deviation"))
      note(quantities, table.at(i, "quantity")), note(methods, table.at(i, "method"));
  for (const std::string& m : methods) out += fmt::format("<th>{}</th>", escaped(m));
  out += "<th class=\"text\">furthest method</th></tr></thead><tbody>\n";
  for (const std::string& quantity : quantities) {
    out += fmt::format("<tr><th scope=\"row\">{}</th>", escaped(quantity));
    // of single runs, which stand in the table of data, the one that is furthest from the first method's mean
    std::optional<double> of_first;
    double furthest = 0;
    std::string where = "<td class=\"none\">–</td>";
    // a method's rows come in one order, so that its cells stand below its name
    for (const std::string& m : methods)
      for (size_t i = 0; i < table.rows.size(); ++i) {
        if (text_at(table, i, "quantity") != quantity || text_at(table, i, "method") != m) continue;
        const double mean = std::get<double>(table.at(i, "mean")), spread = std::get<double>(table.at(i, "deviation"));
        const auto& unit = std::get<std::string>(table.at(i, "unit"));
        out += fmt::format("<td>{} {} ± {}</td>", with_digits_of(mean, spread), unit,
                           unit == "m" ? nice_length(spread) : nice(spread) + " " + unit);
        if (!of_first) of_first = mean;
      }
    for (size_t i = 0; i < table.rows.size() && of_first; ++i) {
      if (text_at(table, i, "quantity") != quantity || text_at(table, i, "method") == sticky_sphere) continue;
      const double off = *number_at(table, i, "mean") - *of_first;
      if (!(std::abs(off) > std::max(furthest, 1e-12))) continue;
      furthest = std::abs(off);
      const std::string unit = text_at(table, i, "unit");
      where = fmt::format("<td class=\"text\">{}{}, {}</td>", off > 0 ? "+" : "",
                          unit == "m" ? nice_length(off) : nice(off) + " " + unit,
                          escaped(name_in_sentence(text_at(table, i, "method"))));
    }
    out += where + "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string certificate_html(const Certificate& certificate) {
  const bool bad = certificate.mismatch();
  std::string out = fmt::format(
      "<details{}><summary>Is it the same scene? {}: {}</summary><div "
      "class=\"scroll\"><table><thead><tr><th>quantity"
      "</th><th>requested</th><th>mapped</th><th>read back</th><th>verdict</th></tr></thead><tbody>\n",
      bad ? " open" : "", escaped(certificate.method), escaped(summary_of(certificate)));
  for (const CertificateRow& r : certificate.rows)
    out += fmt::format(
        "<tr><th scope=\"row\">{}</th><td class=\"text\">{}</td><td class=\"text\">{}</td><td "
        "class=\"text\">{}</td><td class=\"{}\">{}</td></tr>\n",
        escaped(r.quantity), escaped(r.requested), escaped(r.mapped), escaped(r.read_back),
        r.parity == Parity::mismatch     ? "failed"
        : r.parity == Parity::unattested ? "none"
                                         : "ok",
        name_of(r.parity));
  return out + "</tbody></table></div></details>\n";
}

std::string parity_html(const std::vector<ScenePart>& scenes) {
  std::vector<std::string> methods;
  size_t all = 0, matched = 0;
  for (const ScenePart& part : scenes)
    for (const Certificate* certificate : part.certificates) {
      if (std::ranges::find(methods, certificate->method) == methods.end()) methods.push_back(certificate->method);
      for (const CertificateRow& row : certificate->rows) ++all, matched += row.parity == Parity::match;
    }
  if (methods.empty()) return "";
  std::string out =
      "<figure class=\"parity-figure\"><div class=\"scroll\"><table class=\"parity\"><thead><tr><th>scene</th>";
  for (const std::string& method : methods)
    out += fmt::format("<th class=\"text\" title=\"{}\">{}</th>", escaped(method), escaped(name_in_sentence(method)));
  out += "</tr></thead><tbody>\n";
  for (const ScenePart& part : scenes) {
    if (part.certificates.empty()) continue;
    out += fmt::format("<tr><th scope=\"row\"><a href=\"#{0}\">{0}</a></th>", escaped(part.scene->name));
    for (const std::string& method : methods) {
      const auto own =
          std::ranges::find_if(part.certificates, [&](const Certificate* c) { return c->method == method; });
      if (own == part.certificates.end()) {
        out += "<td class=\"none\">cannot</td>";
        continue;
      }
      // equal neighbours are one element, as wide as they are many
      out += fmt::format("<td title=\"{}\">", escaped(summary_of(**own)));
      for (const CertificateRow& row : (*own)->rows)
        out += fmt::format("<i class=\"{}\" title=\"{}: {}\"></i>",
                           row.parity == Parity::match           ? "match"
                           : row.parity == Parity::mismatch      ? "mismatch"
                           : row.parity == Parity::different_law ? "law"
                                                                 : "unattested",
                           escaped(row.quantity), name_of(row.parity));
      out += "</td>";
    }
    out += "</tr>\n";
  }
  return out + fmt::format(
                   "</tbody></table></div><figcaption>Parity certificates: a dot for each quantity that was read "
                   "back from the engine's memory. Full: it matches, {} of {}; ring: a law written otherwise; "
                   "dash: not told; red square: mismatch.</figcaption></figure>\n",
                   matched, all);
}

std::string recommendation_table_html(const std::vector<ScenePart>& scenes) {
  std::string rows;
  std::vector<std::string> engines;  // beside mysim; where there is one, the column is named after it
  for (const ScenePart& part : scenes)
    for (const EngineBeside& other : part.take ? part.take->beside : std::vector<EngineBeside>())
      if (std::ranges::find(engines, other.engine) == engines.end()) engines.push_back(other.engine);
  std::vector<std::string> untried;
  for (const ScenePart& part : scenes) {
    const bool tried = std::ranges::any_of(part.runs, [](const ShownRun& r) { return !r.key.ends_with(" own"); });
    if (!part.take && !tried) untried.push_back(part.scene->name);
    if (!part.take) continue;
    const RecommendedRun& run = *part.take;
    std::vector<std::string> tied, beside;
    for (const std::string& method : run.tied) tied.push_back(name_in_sentence(method));
    for (const EngineBeside& other : run.beside)
      beside.push_back((engines.size() == 1 ? "" : name_in_sentence(other.engine) + " ") + times_text(other.times));
    const double factor = part.scene->duration / run.cost;
    rows += fmt::format(
        "<tr data-method=\"{}\"><th scope=\"row\"><a href=\"#{}\">{}</a></th><td class=\"text\"><b>{}</b>{}</td><td "
        "class=\"number\">{}</td><td>{}</td><td class=\"number\">{}</td><td>{}</td><td>{}</td><td "
        "class=\"text\">{}</td></tr>\n",
        escaped(run.method), escaped(part.scene->name), escaped(part.scene->name),
        escaped(name_in_sentence(run.method)),
        tied.empty() ? "" : " <span class=\"soft\">tied in speed: " + escaped(joined(tied)) + "</span>",
        prose(setting_text(std::string(name_of(run.setting)), run.requested)), prose(percent(run.error, run.motion)),
        prose(step_text(run.cost)), factor >= 10 ? times_text(factor) : fmt::format("{:.2g}", factor),
        beside.empty() ? "–" : escaped(fmt::format("{}", fmt::join(beside, ", "))), run.bound);
  }
  if (rows.empty()) return "";
  return "<section class=\"chapter\" id=\"which-method\"><h2>Which method for which scene</h2>\n<p "
         "class=\"answer\">The "
         "cheapest run with an error of at most 1 % of the motion; where the clock cannot tell runs apart, the nearest "
         "to the truth.</p>\n<div class=\"scroll\"><table><thead><tr><th>scene</th><th "
         "class=\"text\">take</th><th>step or "
         "tolerance</th><th>error</th><th>CPU time</th><th>× real time</th><th>" +
         escaped(engines.size() == 1 ? name_in_sentence(engines[0]) : "others") +
         " / mysim</th><th "
         "class=\"text\">step "
         "bound by</th></tr></thead><tbody>\n" +
         rows + "</tbody></table></div>\n" +
         (untried.empty()
              ? ""
              : fmt::format("<p class=\"soft\">Tried at their own step only: {}.</p>\n", escaped(joined(untried)))) +
         "</section>\n";
}

std::string readable(std::string text) {
  constexpr std::pair<std::string_view, std::string_view> table[] = {{": give --tol, not --step", ""},
                                                                     {"--step", "the scene's step"},
                                                                     {"omega", "ω"},
                                                                     {"gamma", "γ"},
                                                                     {"lambda", "λ"},
                                                                     {"^2", "²"}};
  for (const auto& [spelt, written] : table)
    for (size_t at = text.find(spelt); at != std::string::npos; at = text.find(spelt, at + written.size()))
      text.replace(at, spelt.size(), written);
  return text;
}

namespace {

std::string row_of(const Method& method) {
  const Stepper* own = stepper_of(method);
  return fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                     escaped(method.name),
                     prose(readable(method.stepper ? std::string(method.stepper->what) : method.what)),
                     own ? std::to_string(own->order) : "–",
                     !own                   ? "–"
                     : own->evaluations > 0 ? std::to_string(own->evaluations)
                                            : "its solver's",
                     own ? prose(readable(std::string(own->limit_formula))) : "–");
}

}  // namespace

std::string methods_html(const std::vector<std::string>& shown) {
  std::string out =
      "<div class=\"scroll\"><table "
      "class=\"methods\"><thead><tr><th>method</th><th>what it is</th><th>order</th><th>force evaluations per time "
      "step</th>"
      "<th>stable for (ω: largest angular frequency, γ: drag rate, h: time step)</th></tr></thead><tbody>\n";
  for (const Method& method : all_methods())
    if (std::ranges::find(shown, method.name) != shown.end()) out += row_of(method);
  return out +
         "</tbody></table></div>\n<p class=\"note\">Bullet's worlds in single precision are called bullet32.</p>\n";
}

}  // namespace crosscheck
