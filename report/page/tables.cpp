// Tables of the page: recommendations, chapters, runs of a scene, certificates, methods.

#include <fmt/format.h>

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

/// A clearance: negative inside; round-off is neither.
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

/// The mean to the digits that its spread leaves it.
std::string with_digits_of(double mean, double spread) {
  if (std::abs(mean) < 1e-12) return "0";
  if (!(spread > 0) || std::abs(mean) < 1e-3) return nice(mean);
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(spread))), 0, 9);
  return fmt::format("{:.{}f}", mean, decimals);
}

/// "1.0e-7 m": whatever else breaks, this does not.
bool is_number(const std::string& cell) {
  return cell.size() <= 12 && cell.find_first_of("0123456789") <= 2 && !cell.starts_with("1/");
}

/// Names of methods may break behind the slash: in half a page's width eight columns have to stand.
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

std::string page_table_html(const PageTable& table, bool open) {
  // long ones open on a click: the figure above has said most of it
  const bool shut = !open && !table.open && table.rows.size() > 6;
  std::string out = shut ? fmt::format("<details><summary>{}</summary>\n", prose(table.caption)) : "";
  out += "<div class=\"scroll\"><table>";
  if (!shut) out += fmt::format("<caption>{}</caption>", prose(table.caption));
  out += "<thead><tr>";
  for (const std::string& head : table.header) out += fmt::format("<th>{}</th>", prose(head));
  out += "</tr></thead><tbody>\n";
  for (const auto& row : table.rows) {
    out += "<tr>";
    for (size_t i = 0; i < row.size(); ++i)
      out += i == 0 ? fmt::format("<th scope=\"row\">{}</th>", narrow(row[i]))
                    : fmt::format("<td{}>{}</td>",
                                  row[i].empty()      ? " class=\"none\""
                                  : is_number(row[i]) ? " class=\"number\""
                                                      : "",
                                  row[i].empty() ? "–" : narrow(row[i]));
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n" + (shut ? "</details>\n" : "");
}

std::string run_table_html(const ScenePart& part) {
  const bool contact = part.scene->model.find<Spheres>();
  std::string out = fmt::format(
      "<div class=\"scroll\"><table><thead><tr><th>method</th><th>verdict</th><th>error from truth</th><th>away from "
      "symplectic "
      "Euler</th>{}<th>energy off</th><th>evaluations</th><th title=\"of the run as it is watched at every step; the "
      "chapter on cost times steps alone\">CPU, watched / s</th></tr></thead><tbody>\n",
      contact ? "<th>centres apart</th><th>clearance</th><th>creep at end</th>" : "");
  for (const MethodData& m : part.facts->methods) {
    out += fmt::format(
        "<tr><th scope=\"row\">{}{}</th>{}{}{}", escaped(m.method),
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
    out += m.supported() ? fmt::format("<td>{}</td><td>{}</td>", m.evaluations, m.cpu ? nice(*m.cpu) : "–")
                         : "<td class=\"none\">–</td><td class=\"none\">–</td>";
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string statistics_html(const Table& table) {
  std::string out = "<div class=\"scroll\"><table><thead><tr><th>mean over 16 perturbed runs ± their spread</th>";
  std::vector<std::string> quantities, methods;
  auto note = [](std::vector<std::string>& list, const Cell& cell) {
    const auto& text = std::get<std::string>(cell);
    if (std::find(list.begin(), list.end(), text) == list.end()) list.push_back(text);
  };
  for (size_t i = 0; i < table.rows.size(); ++i)
    note(quantities, table.at(i, "quantity")), note(methods, table.at(i, "method"));
  for (const std::string& m : methods) out += fmt::format("<th>{}</th>", escaped(m));
  out += "</tr></thead><tbody>\n";
  for (const std::string& quantity : quantities) {
    out += fmt::format("<tr><th scope=\"row\">{}</th>", escaped(quantity));
    // a method's rows come in one order, so that its cells stand below its name
    for (const std::string& m : methods)
      for (size_t i = 0; i < table.rows.size(); ++i) {
        if (std::get<std::string>(table.at(i, "quantity")) != quantity ||
            std::get<std::string>(table.at(i, "method")) != m)
          continue;
        const double mean = std::get<double>(table.at(i, "mean")), spread = std::get<double>(table.at(i, "deviation"));
        const auto& unit = std::get<std::string>(table.at(i, "unit"));
        out += fmt::format("<td>{} {} ± {}</td>", with_digits_of(mean, spread), unit,
                           unit == "m" ? nice_length(spread) : nice(spread) + " " + unit);
      }
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string certificate_html(const Certificate& certificate) {
  const bool bad = certificate.mismatch();
  std::string out = fmt::format(
      "<details{}><summary>Is it the same scene? {}: {}</summary><div "
      "class=\"scroll\"><table><thead><tr><th>quantity"
      "</th><th>asked</th><th>handed over</th><th>read back</th><th>verdict</th></tr></thead><tbody>\n",
      bad ? " open" : "", escaped(certificate.method), escaped(summary_of(certificate)));
  for (const CertificateRow& r : certificate.rows)
    out += fmt::format(
        "<tr><th scope=\"row\">{}</th><td class=\"text\">{}</td><td class=\"text\">{}</td><td "
        "class=\"text\">{}</td><td class=\"{}\">{}</td></tr>\n",
        escaped(r.quantity), escaped(r.asked), escaped(r.mapped), escaped(r.read_back),
        r.parity == Parity::mismatch     ? "failed"
        : r.parity == Parity::unattested ? "none"
                                         : "ok",
        name_of(r.parity));
  return out + "</tbody></table></div></details>\n";
}

std::string recommendation_table_html(const std::vector<ScenePart>& scenes) {
  std::string out =
      "<section id=\"scenes\">\n<h2>Which method for which scene?</h2>\n<div class=\"scroll\"><table "
      "class=\"choice\"><thead><tr><th>scene</th>";
  // a column in which nothing stands is left out
  std::vector<size_t> shown;
  for (size_t i = 0; i < recommendation_columns().size(); ++i)
    if (std::any_of(scenes.begin(), scenes.end(),
                    [i](const ScenePart& part) { return !part.recommendations.at(i).empty(); }))
      shown.push_back(i);
  for (const size_t i : shown) out += fmt::format("<th>{}</th>", prose(recommendation_columns()[i].head));
  out += "</tr></thead><tbody>\n";
  for (const ScenePart& part : scenes) {
    out += fmt::format("<tr><th scope=\"row\"><a href=\"#{0}\" title=\"{1}\">{0}</a></th>", escaped(part.scene->name),
                       escaped(part.scene->question));
    for (const size_t i : shown)
      out += fmt::format("<td class=\"{}\">{}</td>", part.recommendations[i].css_class,
                         prose(part.recommendations[i].text));
    out += "</tr>\n";
  }
  out +=
      "</tbody></table></div>\n<p class=\"note\">Errors at the scene's own step, in % of its motion (*: by steps of "
      "the method's own); in bold who is "
      "nearest, or within 5 % of the nearest; – where nothing was asked, or cannot be said. What each <a "
      "href=\"#methods\">method</a> is; what "
      "is meant by";
  const char* mark = " ";
  for (const size_t i : shown) out += std::exchange(mark, ", ") + term_link(recommendation_columns()[i].term);
  return out + ".</p>\n</section>\n";
}

namespace {

/// A terminal's text as a page writes it, without hints at command-line options.
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

std::string methods_html() {
  std::string out =
      "<h3 id=\"methods\">Methods</h3>\n<div class=\"scroll\"><table "
      "class=\"methods\"><thead><tr><th>method</th><th>what it is</th><th>order</th><th>force evaluations a step</th>"
      "<th>stable while (ω: fastest vibration, γ: drag, h: step)</th></tr></thead><tbody>\n";
  for (const Method& method : all_methods())
    if (method.family().role != Role::truth) out += row_of(method);
  return out + "</tbody></table></div>\n";
}

}  // namespace crosscheck
