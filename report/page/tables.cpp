#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "reference/engines/engines.h"
#include "report/findings/findings_text.h"
#include "report/page/page_parts.h"

namespace crosscheck {
namespace {

/// Cell of a table. An empty text becomes a dash.
Json cell(const std::string& text, const std::string& css_class = "") {
  return {{"text", text.empty() ? "–" : text},
          {"class", text.empty() ? "none" : css_class},
          {"link", ""},
          {"note", ""},  // grey text that follows the cell's text
          {"law", ""}};  // the method's force laws that differ from mysim's
}
Json cell(const std::string& text, const std::string& css_class, const char* key, const std::string& value) {
  Json made = cell(text, css_class);
  made[key] = value;
  return made;
}
Json cells(const std::vector<std::string>& texts, const std::string& css_class = "") {
  Json all = Json::array();
  for (const std::string& text : texts) all.push_back(cell(text, css_class));
  return all;
}

Json table(const std::string& caption, Json header) {
  return {{"class", ""}, {"caption", caption}, {"header", std::move(header)}, {"rows", Json::array()}};
}
void add_row(Json& table, const std::string& method, Json head, Json cells) {
  table["rows"].push_back({{"method", method}, {"head", std::move(head)}, {"cells", std::move(cells)}});
}

std::string length_text(const std::optional<double>& value, double floor = 0) {
  return !value ? "" : *value < floor ? "< " + nice_length(floor) : nice_length(*value);
}

/// A clearance, which is negative inside the body; round-off counts as zero.
std::string signed_length(double metres) { return std::abs(metres) < 1e-12 ? "0 m" : nice_length(metres); }

Json verdict_cell(const MethodData& m, const SceneData& facts) {
  if (is_useless(m, facts))
    return cell(fmt::format("ok, but {} of the motion off", percent(*m.error, facts.motion)), "failed");
  if (m.ok()) return cell("ok", "ok");
  if (!m.supported()) return cell("unsupported: " + m.reason, "unsupported");
  return cell(fmt::format("{} at {:.3g} s", m.failure(), m.end), "failed");
}

/// The mean, with as many digits as the deviation justifies.
std::string with_digits_of(double mean, double spread) {
  if (std::abs(mean) < 1e-12) return "0";
  if (!(spread > 0) || std::abs(mean) < 1e-3) return nice(mean);
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(spread))), 0, 9);
  return fmt::format("{:.{}f}", mean, decimals);
}

/// Replaces a program's path by its title.
std::string shown_method(const std::string& text) {
  return text.starts_with(program_prefix) ? program_title(text) : text;
}

/// True for a number with its unit ("1.0e-7 m"), which must stay on one line.
bool is_number(const std::string& text) {
  return text.size() <= 12 && text.find_first_of("0123456789") <= 2 && !text.starts_with("1/");
}

}  // namespace

Json table_data(const PageTable& given) {
  const auto has_cells = [&](size_t column) {
    return std::ranges::any_of(given.rows, [&](const auto& row) { return !row[column].empty(); });
  };
  Json all = table(given.caption, Json::array());
  for (size_t i = 0; i < given.header.size(); ++i)
    if (has_cells(i)) all["header"].push_back(cell(given.header[i]));
  for (const auto& row : given.rows) {
    Json others = Json::array();
    for (size_t i = 1; i < row.size(); ++i)
      if (has_cells(i)) others.push_back(cell(row[i], is_number(row[i]) ? "number" : ""));
    add_row(all, builtin_method(row[0]) ? row[0] : "", cell(shown_method(row[0])), std::move(others));
  }
  return all;
}

Json run_table_data(const ScenePart& part) {
  const bool contact = has_contact(part.scene->model);
  Json all = table("", cells({"method", "verdict", "RMS position error", "difference from symplectic Euler"}));
  if (contact)
    for (const char* head : {"distance between centres of mass", "clearance", "creep at end"})
      all["header"].push_back(cell(head));
  for (const char* head : {"relative energy residual", "force evaluations"}) all["header"].push_back(cell(head));
  for (const MethodData& m : part.facts->methods) {
    Json row = Json::array({verdict_cell(m, *part.facts), cell(length_text(m.error, part.facts->error_bar)),
                            cell(length_text(m.difference))});
    if (contact)
      for (const std::string& text : {length_text(m.centre_difference), m.clearance ? signed_length(*m.clearance) : "",
                                      m.creep ? nice(1e3 * *m.creep) + " mm/s" : ""})
        row.push_back(cell(text));
    row.push_back(cell(m.energy_error ? nice(100 * *m.energy_error) + " %" : ""));
    row.push_back(cell(m.supported() ? std::to_string(m.evaluations) : ""));
    add_row(all, m.method, cell(shown_method(m.method), "", "law", m.different_law), std::move(row));
  }
  return all;
}

Json statistics_data(const Table& given) {
  std::vector<std::string> quantities, methods;
  std::map<std::pair<std::string, std::string>, std::string> texts;
  for (size_t i = 0; i < given.rows.size(); ++i) {
    const auto spread = number_at(given, i, "deviation");
    if (!spread) continue;  // a single run
    const std::string quantity = text_at(given, i, "quantity"), method = text_at(given, i, "method"),
                      unit = text_at(given, i, "unit");
    add_once(quantities, quantity), add_once(methods, method);
    texts[{quantity, method}] = fmt::format("{} {} ± {}", with_digits_of(*number_at(given, i, "mean"), *spread), unit,
                                            unit == "m" ? nice_length(*spread) : nice(*spread) + " " + unit);
  }
  Json all = table("", cells({"mean ± standard deviation of 16 perturbed runs"}));
  for (const std::string& m : methods) all["header"].push_back(cell(m));
  for (const std::string& quantity : quantities) {
    Json row = Json::array();
    for (const std::string& m : methods) row.push_back(cell(texts[{quantity, m}]));
    add_row(all, "", cell(quantity), std::move(row));
  }
  return all;
}

Json certificate_data(const Certificate& certificate) {
  Json all = table("", cells({"quantity", "requested", "mapped", "read back", "verdict"}));
  for (const CertificateRow& r : certificate.rows) {
    Json row = cells({r.requested, r.mapped, r.read_back}, "text");
    row.push_back(cell(std::string(name_of(r.parity)), r.parity == Parity::mismatch ? "failed"
                                                       : r.parity == Parity::match  ? "ok"
                                                                                    : "none"));
    add_row(all, "", cell(r.quantity), std::move(row));
  }
  return {{"method", without_folders(certificate.method)},
          {"summary", summary_of(certificate)},
          {"mismatch", certificate.mismatch()},
          {"table", std::move(all)}};
}

Json parity_data(const std::vector<ScenePart>& scenes) {
  constexpr const char* classes[] = {"match", "law", "mismatch", "unattested"};  // in the order of Parity
  std::vector<std::string> methods;
  size_t all = 0, matched = 0;
  for (const ScenePart& part : scenes)
    for (const Certificate* certificate : part.certificates) {
      add_once(methods, certificate->method);
      for (const CertificateRow& row : certificate->rows) ++all, matched += row.parity == Parity::match;
    }
  if (methods.empty()) return nullptr;
  Json header = Json::array(), rows = Json::array();
  for (const std::string& method : methods) header.push_back({{"text", name_in_sentence(method)}, {"title", method}});
  for (const ScenePart& part : scenes) {
    if (part.certificates.empty()) continue;
    Json row = Json::array();
    for (const std::string& method : methods) {
      const auto own = std::ranges::find(part.certificates, method, &Certificate::method);
      Json dots = Json::array();
      long same = 0;
      if (own != part.certificates.end())
        for (const CertificateRow& r : (*own)->rows) {
          dots.push_back({{"class", classes[static_cast<int>(r.parity)]},
                          {"says", fmt::format("{}: {}", r.quantity, name_of(r.parity))}});
          same += r.parity == Parity::match;
        }
      const char* absent = part.facts && part.facts->find(method) ? "not supported" : "not run";
      row.push_back({{"matched", same}, {"count", dots.size()}, {"dots", std::move(dots)}, {"absent", absent}});
    }
    rows.push_back({{"scene", part.scene->name}, {"cells", std::move(row)}});
  }
  return {{"header", std::move(header)}, {"rows", std::move(rows)}, {"all", all}, {"matched", matched}};
}

Json recommendations_data(const std::vector<ScenePart>& scenes) {
  std::vector<std::string> engines;  // engines except mysim; if there is only one, the column has its name
  for (const ScenePart& part : scenes)
    if (part.take)
      for (const EngineBeside& other : part.take->beside) add_once(engines, other.engine);
  const std::string others = engines.size() == 1 ? name_in_sentence(engines[0]) : "others";
  Json all = table("", Json::array({cell("scene"), cell("recommended", "text"), cell("step or tolerance"),
                                    cell("error"), cell("force evaluations"), cell("CPU time"), cell("× real time"),
                                    cell(others + " / mysim"), cell("step bound by", "text")}));
  for (const ScenePart& part : scenes) {
    if (!part.take) continue;
    const RecommendedRun& run = *part.take;
    std::vector<std::string> beside;
    for (const EngineBeside& other : run.beside)
      beside.push_back((engines.size() == 1 ? "" : name_in_sentence(other.engine) + " ") +
                       (other.timed_whole && run.timed_whole ? "" : "≈ ") + times_text(other.times));
    const double factor = part.scene->duration / run.cost;
    add_row(all, run.method, cell(part.scene->name, "", "link", part.scene->name),
            Json::array({cell(name_in_sentence(run.method), "text best", "note",
                              run.tied.empty() ? "" : "tied in cost: " + joined(names_in_sentence(run.tied))),
                         cell(setting_text(name_of(run.setting), run.requested), "number"),
                         cell(percent(run.error, run.motion)), cell(count_text(run.evaluations), "number"),
                         cell((run.timed_whole ? "" : "≈ ") + step_text(run.cost), "number"),
                         cell(factor >= 10 ? times_text(factor) : fmt::format("{:.2g}", factor)),
                         cell(fmt::format("{}", fmt::join(beside, ", "))), cell(std::string(run.bound), "text")}));
  }
  return all;
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

Json methods_data(const std::vector<std::string>& shown) {
  Json all = table("", cells({"method", "description", "order", "force evaluations per time step",
                              "stable for (ω: largest angular frequency, γ: drag rate, h: time step)"}));
  all["class"] = "methods";
  for (const Method& method : all_methods()) {
    if (std::ranges::find(shown, method.name) == shown.end()) continue;
    const Stepper* own = stepper_of(method);
    add_row(all, "", cell(method.name),
            cells({readable(method.stepper ? std::string(method.stepper->what) : method.what),
                   own ? std::to_string(own->order) : "",
                   !own                   ? ""
                   : own->evaluations > 0 ? std::to_string(own->evaluations)
                                          : "its solver's",
                   own ? readable(std::string(own->limit_formula)) : ""}));
  }
  return all;
}

}  // namespace crosscheck
