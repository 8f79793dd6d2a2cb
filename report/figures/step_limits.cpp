#include "report/figures/step_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "report/base/gnuplot.h"
#include "report/figures/plot_layout.h"
#include "report/findings/findings_text.h"

namespace crosscheck {
namespace {

/// For each scene, the frequency (rad/s) of the fastest vibration, which limits the step.
std::map<std::string, double> fastest_of(const std::vector<LimitRow>& table) {
  std::map<std::string, double> fastest;
  for (const LimitRow& row : table)
    if (row.state == LimitState::rest && row.omega && *row.omega > 0)
      fastest[row.scene] = std::max(fastest[row.scene], *row.omega);
  return fastest;
}

/// At most four scenes whose frequencies differ most. `always`, the scene of the columns, is one of them.
std::vector<StepLimits::SceneMark> marked_scenes(const std::map<std::string, double>& fastest,
                                                 const std::string& always) {
  std::vector<StepLimits::SceneMark> all;
  for (const auto& [name, omega] : fastest) all.push_back({name, omega});
  std::ranges::sort(all, {}, &StepLimits::SceneMark::omega);
  while (all.size() > 4) {
    size_t nearest = 1;
    for (size_t i = 1; i + 1 < all.size(); ++i)
      if (all[nearest].name == always || (all[i].name != always && all[i + 1].omega / all[i - 1].omega <
                                                                       all[nearest + 1].omega / all[nearest - 1].omega))
        nearest = i;
    all.erase(all.begin() + static_cast<long>(nearest));
  }
  return all;
}

std::string milliseconds(std::optional<double> step) { return step ? fmt::format("{:#.5g}", 1e3 * *step) : "–"; }

}  // namespace

std::string measured_text(const LimitRow& row) {
  switch (row.measurement) {
    case MeasuredLimit::found:
      return milliseconds(row.measured);
    case MeasuredLimit::no_step:
      return "none";
    case MeasuredLimit::every_step:
    case MeasuredLimit::refused_above:
      return "> " + milliseconds(row.held);
    case MeasuredLimit::unsupported:
      return "n/a";
  }
  return "";
}

std::string predicted_text(const LimitRow& row) {
  switch (row.prediction) {
    case PredictionKind::limit:
      return milliseconds(row.predicted);
    case PredictionKind::no_step:
      return "none";
    case PredictionKind::every_step:
      return "all";
    case PredictionKind::none:
      return "–";
  }
  return "";
}

namespace {

struct Gathered {
  StepLimits::Row row;
  std::string without;                   // a scene without a stable step
  std::string bound;                     // scene with a limit
  std::optional<double> every, refused;  // h omega, minimum over scenes. every: longest step tried, if none failed;
                                         // refused: longest step that the method accepts
  bool any() const { return !bound.empty() || !without.empty() || every || refused; }

  void add(const LimitRow& limit, double omega, const std::vector<StepLimits::SceneMark>& scenes) {
    const double held = limit.held.value_or(0) * omega;
    if (limit.measurement == MeasuredLimit::no_step) without = limit.scene;
    if (limit.measurement == MeasuredLimit::every_step) every = std::min(every.value_or(held), held);
    if (limit.measurement == MeasuredLimit::refused_above) refused = std::min(refused.value_or(held), held);
    if (limit.measurement != MeasuredLimit::found) return;
    const double found = *limit.measured * omega;
    row.held = bound.empty() ? found : std::min(row.held, found);
    bound = limit.scene;
    const auto scene = std::ranges::find(scenes, limit.scene, &StepLimits::SceneMark::name);
    if (scene == scenes.end()) return;
    StepLimits::Mark mark{static_cast<size_t>(scene - scenes.begin()), found, {}, ""};
    if (limit.predicted) mark.predicted = *limit.predicted * omega;
    mark.words = fmt::format("{} on {}\nmeasured {}, h ω = {}\n{}", name_in_sentence(limit.method), limit.scene,
                             step_text(*limit.measured), nice(found),
                             limit.predicted ? "theory " + step_text(*limit.predicted) : "no theory");
    row.marks.push_back(std::move(mark));
  }

  void conclude() {
    if (!bound.empty()) {
      row.words = fmt::format("h ω = {}", nice(row.held));
      if (!without.empty()) row.words = fmt::format("0 without drag; {} with the drag of {}", nice(row.held), bound);
      if (every) row.words += ", elsewhere none";
    } else if (!without.empty()) {
      row.words = "no step holds without drag";
    } else if (every) {
      row.open = true, row.held = *every, row.words = fmt::format("every step tried, up to h ω = {}", nice(*every));
    } else {
      row.held = *refused, row.words = "longer steps are refused";
    }
  }
};

}  // namespace

StepLimits step_limits_of(const std::vector<LimitRow>& table, const std::string& scene) {
  StepLimits f;
  const std::map<std::string, double> fastest = fastest_of(table);
  if (fastest.empty()) return f;
  f.columns_of = fastest.contains(scene)
                     ? scene
                     : std::ranges::max_element(fastest, {}, &std::pair<const std::string, double>::second)->first;
  f.scenes = marked_scenes(fastest, f.columns_of);
  std::vector<std::pair<std::string, Gathered>> methods;
  for (const LimitRow& row : table) {
    if (row.state != LimitState::rest || !fastest.contains(row.scene) || row.measurement == MeasuredLimit::unsupported)
      continue;
    auto method = std::ranges::find(methods, row.method, &std::pair<std::string, Gathered>::first);
    if (method == methods.end()) method = methods.insert(methods.end(), {row.method, {}});
    method->second.add(row, row.omega.value_or(fastest.at(row.scene)), f.scenes);
    if (row.scene == f.columns_of)
      method->second.row.measured = measured_text(row), method->second.row.predicted = predicted_text(row);
  }
  for (auto& [name, gathered] : methods) gathered.conclude();
  std::ranges::stable_sort(methods, [](const auto& a, const auto& b) {
    const StepLimits::Row &x = a.second.row, &y = b.second.row;
    return x.open != y.open ? x.open : !x.open && x.held > y.held * 1.01;
  });
  for (auto& [name, gathered] : methods) f.names.push_back(name), f.rows.push_back(std::move(gathered.row));
  return f;
}

namespace {

Table data_of(const StepLimits& f) {
  Table table{f.name,
              {{"what", "1"}, {"method", "1"}, {"place", "1"}, {"scene", "1"}, {"h omega", "1"}, {"time step", "s"}},
              {}};
  for (size_t i = 0; i < f.rows.size(); ++i) {
    const auto place = static_cast<double>(i + 1);
    const StepLimits::Row& row = f.rows[i];
    table.add(
        {std::string(row.open ? "held at every step" : "held"), f.names[i], place, std::string(), row.held, Cell()});
    for (const StepLimits::Mark& mark : row.marks) {
      const auto& [name, omega] = f.scenes[mark.scene];
      table.add({std::string("measured"), f.names[i], place, name, mark.measured, mark.measured / omega});
      if (mark.predicted)
        table.add({std::string("predicted"), f.names[i], place, name, *mark.predicted, *mark.predicted / omega});
    }
  }
  return checked(std::move(table));
}

double top_of(const StepLimits& f) {
  double top = 0;
  for (const StepLimits::Row& row : f.rows)
    if (!row.open) top = std::max(top, row.held);
  for (const StepLimits::Row& row : f.rows)
    for (const StepLimits::Mark& mark : row.marks) top = std::max(top, mark.measured);
  return top > 0 ? 1.4 * top : 4;
}

}  // namespace

Drawing drawing_of(const StepLimits& f) {
  Drawing drawing{f.name, data_of(f), ""};
  const double top = top_of(f);
  const bool columns = f.size.units() > 560;
  const double shift = columns ? 1 : 0;  // for the heads of the columns
  const auto lines = static_cast<double>(f.rows.size()) + shift;
  constexpr int points[] = {7, 5, 13, 9};
  std::vector<KeyEntry> key{{"theory", KeyEntry::Kind::line, {"#111111", "1", -1}}};
  for (size_t s = 0; s < f.scenes.size(); ++s)
    key.push_back({fmt::format("{}, ω = {} rad/s", f.scenes[s].name, nice(f.scenes[s].omega)),
                   KeyEntry::Kind::mark,
                   {"#0072B2", "1", points[s % 4]}});
  const NamedLines layout(f, "time step × fastest frequency, h ω", f.names, lines, key, columns ? 150 : 14);
  std::string out = script_head(f) + fmt::format("set xrange [0:{:.6g}]\n", top) + layout.y_range(lines) +
                    layout.commands(f, ticks_of(0, top, false, layout.box.right - layout.box.left, false));
  const double ends[] = {layout.wide - 78, layout.wide - 10};
  if (columns) out += layout.ending_at(ends[0], 1, "measured / ms") + layout.ending_at(ends[1], 1, "theory / ms");
  const std::string file = single_quoted(f.name + ".csv");
  std::vector<std::string> parts;
  for (size_t i = 0; i < f.rows.size(); ++i) {
    const StepLimits::Row& row = f.rows[i];
    const double place = static_cast<double>(i + 1) + shift;
    const std::string colour = style_of(f.names[i]).colour;
    out += layout.name(place, i);
    const bool said = i > 0 && row.open && f.rows[i - 1].words == row.words;
    const std::string words = columns    ? row.words
                              : row.open ? fmt::format("h ω > {}", nice(row.held))
                                         : row.words.substr(0, row.words.find(';'));
    if (row.open)
      out += fmt::format(
          "set arrow from {:.6g}, {} to {:.6g}, {} head filled size screen 0.014,25 lw 2 lc rgb \"{}\" "
          "front\n",
          0.94 * top, place, top, place, colour);
    if (!said)
      out += fmt::format("set label {} at {:.6g}, {} left offset 1.2,0 noenhanced front\n", single_quoted(words),
                         row.open ? 0. : row.held, place);
    if (columns)
      out += layout.ending_at(ends[0], place, row.measured) + layout.ending_at(ends[1], place, row.predicted);
    parts.push_back(
        fmt::format("{0} using (strcol(1)[1:4] eq 'held' && $3 == {1} ? 0 : NaN):($3+{2}):(0):({3}):($3+{2}-0.28):"
                    "($3+{2}+0.28) with boxxyerror lc rgb \"{4}\" fs transparent solid 0.3 noborder notitle",
                    file, i + 1, shift, row.open ? fmt::format("{:.6g}", top) : "$5", colour));
  }
  parts.push_back(
      fmt::format("{} using (strcol(1) eq 'predicted' ? $5 : NaN):($3+{}-0.42):(0):(0.84) with vectors nohead "
                  "lw 2 lc rgb \"#111111\" notitle",
                  file, shift));
  for (size_t s = 0; s < f.scenes.size(); ++s)
    parts.push_back(fmt::format(
        "{} using (strcol(1) eq 'measured' && strcol(4) eq {} ? $5 : NaN):($3+{:.3g}) with points pt {} ps 0.8 lc rgb "
        "\"#0072B2\" notitle",
        file, single_quoted(f.scenes[s].name),
        shift +
            (f.scenes.size() < 2 ? 0 : 0.5 * (static_cast<double>(s) / static_cast<double>(f.scenes.size() - 1) - 0.5)),
        points[s % 4]));
  drawing.script = out + terminals(f, layout.tall, joined_plot(parts));
  return drawing;
}

}  // namespace crosscheck
