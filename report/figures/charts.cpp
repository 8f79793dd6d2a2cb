#include "report/figures/charts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <concepts>
#include <stdexcept>

#include "mysim/base/files.h"
#include "mysim/base/text.h"
#include "report/base/assets.h"
#include "report/findings/findings_text.h"

namespace crosscheck {

std::string builds_text(const std::vector<std::string>& methods) {
  std::vector<std::string> own, debians, parts;
  bool programs = false;
  for (const MethodFamily& family : method_families()) {
    if (std::ranges::none_of(methods, [&](const std::string& m) { return &family_of(m) == &family; })) continue;
    if (family.build == Build::here) own.emplace_back(family.name);
    if (family.build == Build::debian) debians.emplace_back(family.title);
    programs |= family.build == Build::own_program;
  }
  if (!own.empty()) parts.push_back(joined(own) + " built here");
  if (!debians.empty()) parts.push_back(joined(debians) + " by Debian for generic x86-64");
  if (programs) parts.emplace_back("external programs as they were built");
  return fmt::format("{}", fmt::join(parts, ", "));
}

namespace {

/// Appends the figure's tier to its caption. Throws std::logic_error if the figure has no tier.
void append_tier(Chart& chart) {
  std::visit(
      []<class F>(F& figure) {
        if constexpr (std::derived_from<F, FigureInfo>) {
          if (figure.tier.empty()) throw std::logic_error("figure " + figure.name + " has no tier");
          figure.caption += (figure.tier == "measured"             ? " Measured."
                             : figure.tier.starts_with("measured") ? " It is " + figure.tier + "."
                                                                   : " Reference: " + figure.tier + ".");
        }
      },
      chart.figure);
}

}  // namespace

std::vector<Chart> all_charts(const ChartInput& input) {
  std::vector<Chart> all;
  for (const auto make :
       {scoreboard_charts, same_rule_charts, order_charts, error_charts, agreement_charts, contact_charts,
        balance_charts, matrix_charts, cheapest_charts, speed_accuracy_charts, stability_charts, energy_charts,
        probe_charts, adequacy_charts, cost_charts, stiffness_charts, fabric_charts, disagreement_charts})
    for (Chart& chart : make(input)) append_tier(chart), all.push_back(std::move(chart));
  return all;
}

namespace {

using Words = std::map<std::string, std::string>;

const std::map<std::string, Words>& figure_texts() {
  static const std::map<std::string, Words> texts = [] {
    std::map<std::string, Words> all;
    Words* words = nullptr;
    for (const std::string& line : split(asset("figures/texts.md"), '\n')) {
      const size_t colon = line.find(": ");
      if (line.starts_with("## "))
        words = &all[line.substr(3)];
      else if (line.starts_with("- ") && colon != std::string::npos)
        words->emplace(line.substr(2, colon - 2), line.substr(colon + 2));
    }
    return all;
  }();
  return texts;
}

}  // namespace

std::string filled_text(const std::string& key, const std::string& word, fmt::format_args values) {
  const Words& words = figure_texts().at(key);
  const auto found = words.find(word);
  return found == words.end() ? "" : fmt::vformat(found->second, values);
}

Chart described_chart(const std::string& key, AnyFigure drawn, fmt::format_args values) {
  const auto text = [&](const char* word) { return filled_text(key, word, values); };
  const auto add = [&](std::string& to, const char* word) {
    if (std::string words = text(word); !words.empty()) to = std::move(words);
  };
  const auto add_axis = [&](Axis& axis, const char* letter, const char* log_letter) {
    add(axis.label, letter), add(axis.label, log_letter);
    axis.logarithmic |= !text(log_letter).empty();
  };
  Chart chart{"", std::move(drawn), text("chapter"), text("text"), text("heading")};
  std::visit(
      [&]<class F>(F& f) {
        if constexpr (std::derived_from<F, FigureInfo>) {
          if (f.name.empty()) f.name = fmt::vformat(key, values);
          add(f.title, "title"), add(f.caption, "caption"), add(f.tier, "tier"), add(f.finding, "finding");
        }
        if constexpr (std::same_as<F, Figure>) add_axis(f.x, "x", "log x"), add_axis(f.y, "y", "log y");
        if constexpr (std::same_as<F, HeatMap>) add(f.x_label, "log x"), add(f.y_label, "log y");
        if constexpr (requires { f.label; }) add(f.label, "x"), add(f.label, "log x");
      },
      chart.figure);
  if (const Figure* figure = std::get_if<Figure>(&chart.figure);
      figure && figure->curves.empty() && figure->failures.empty()) {
    if (chart.text.empty()) chart.text = figure->caption;
    chart.figure = std::monostate{};
  }
  if (std::holds_alternative<std::monostate>(chart.figure) && chart.heading.empty()) chart.heading = text("title");
  return chart;
}

Curve& curve_of(Figure& figure, const std::string& title, const MethodStyle& style) {
  const auto found = std::ranges::find(figure.curves, title, &Curve::title);
  return found != figure.curves.end() ? *found : figure.curves.emplace_back(Curve{title, style, {}, true, true});
}

const FigureInfo* figure_info(const Chart& chart) {
  return std::visit(
      [](const auto& figure) -> const FigureInfo* {
        if constexpr (std::derived_from<std::decay_t<decltype(figure)>, FigureInfo>) return &figure;
        return nullptr;
      },
      chart.figure);
}

void draw_figure(const Chart& chart, const Provenance& provenance, const std::filesystem::path& folder) {
  std::visit(
      [&]<class F>(const F& figure) {
        if constexpr (std::derived_from<F, FigureInfo>) draw(drawing_of(figure), provenance, folder);
      },
      chart.figure);
}

void write_figure_data(const Chart& chart, const Provenance& provenance, const std::filesystem::path& folder) {
  std::visit(
      [&]<class F>(const F& figure) {
        if constexpr (std::derived_from<F, FigureInfo>) {
          const Drawing drawing = drawing_of(figure);
          write_csv(drawing.data, provenance, folder);
          write_file(folder / (drawing.name + ".gp"), drawing.script);
        }
      },
      chart.figure);
}

std::string method_in(const std::string& title) {
  const std::string name = title.substr(0, title.find_first_of(", "));
  const std::string method = name.ends_with(":") ? name.substr(0, name.size() - 1) : name;
  const bool named = method.find_first_of("/:") != std::string::npos && method.find("//") == std::string::npos;
  const bool outside = family_of(method).role == Role::outside && method.find(':') != std::string::npos;
  return named && (builtin_without_options(method) || outside) ? method : "";
}

std::vector<std::string> methods_in(const Chart& chart) {
  std::vector<std::string> titles;
  std::visit(
      [&]<class F>(const F& figure) {
        if constexpr (std::same_as<F, Figure>) {
          for (const Curve& curve : figure.curves) titles.push_back(curve.method.empty() ? curve.title : curve.method);
          for (const FailureMark& mark : figure.failures) titles.push_back(mark.title);
        } else if constexpr (std::same_as<F, HeatMap>) {
          for (const HeatMap::Panel& panel : figure.panels) titles.push_back(panel.title);
        } else if constexpr (std::derived_from<F, FigureInfo>) {
          titles = figure.names;
        }
        if constexpr (std::same_as<F, DotPlot>)
          for (const DotPlot::Series& series : figure.series) titles.push_back(series.title);
      },
      chart.figure);
  std::vector<std::string> methods;
  for (const std::string& title : titles)
    if (const std::string method = method_in(title);
        !method.empty() && std::ranges::find(methods, method) == methods.end())
      methods.push_back(method);
  return methods;
}

std::vector<std::pair<double, double>> points_of(const Table& table, const std::string& method,
                                                 const std::string& column, bool positive) {
  std::vector<std::pair<double, double>> points;
  for (size_t i = 0; i < table.rows.size(); ++i) {
    if (std::get<std::string>(table.at(i, "method")) != method) continue;
    if (const auto* y = std::get_if<double>(&table.at(i, column)); y && (!positive || *y > 0))
      points.emplace_back(std::get<double>(table.at(i, "t")), *y);
  }
  return points;
}

std::string caption_of(const Scene& scene, const std::string& commit) {
  return fmt::format("Scene {}; step {}; commit {}.", scene.name, own_step_text(scene), commit);
}

std::string tier_of(const SceneData& facts) {
  return fmt::format("the {} solution, error bar {} ({})", facts.tier, nice_length(facts.error_bar), facts.truth);
}

std::string another_engine(const SceneData& facts) {
  const auto round_off = facts.round_off();
  return "another engine: these are differences, not errors" +
         (round_off ? fmt::format("; round-off alone may cause {}", nice_length(*round_off)) : "");
}

}  // namespace crosscheck
