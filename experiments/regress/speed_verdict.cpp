// Medians, thresholds, second looks.
#include "experiments/regress/speed_verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace crosscheck {
namespace {

constexpr SpeedPlan once{.rounds = 9}, again{.rounds = 15};
constexpr int confirmations = 4, blocks = 7;

std::vector<double> changes_of(const Ratios& ratios, double was) {
  std::vector<double> changes;
  for (size_t i = 0; i < ratios.is.size(); ++i)
    changes.push_back(ratios.is[i] / (ratios.was.empty() ? was : ratios.was[i]));
  return changes;
}

double middle(std::vector<double> values) { return timing_of(std::move(values)).median; }

/// What a machine differs in from this one, in words; empty where in nothing.
std::string differences_of(const Machine& there, const Machine& here) {
  std::string text;
  const auto tell = [&](const char* part, const std::string& is, const std::string& would_be) {
    if (is == would_be) return;
    text += fmt::format("{}on another {} ({}; this is {})", text.empty() ? "" : " and ", part, is, would_be);
  };
  tell("processor", there.cpu, here.cpu);
  tell("compiler", there.compiler, here.compiler);
  tell("yardstick", there.yardstick, here.yardstick);
  return text;
}

int parts_apart(const Machine& a, const Machine& b) {
  return (a.cpu != b.cpu) + (a.compiler != b.compiler) + (a.yardstick != b.yardstick);
}

/// What is blessed of the question under other circumstances, in words: on the machine that is most like this one.
/// Empty where nothing is.
std::string why_elsewhere(const SpeedFile& file, const SpeedQuestion& q, const Machine& here) {
  const BlessedSpeed* nearest = nullptr;
  for (const BlessedSpeed& s : file.speeds) {
    if (s.scene != q.scene.name || s.method != q.method.name) continue;
    if (here.cpu.empty()) return "this processor cannot be told from others";
    if (s.machine == here && s.hash != q.scene.hash) return "blessed of another scene by that name";
    if (!nearest || parts_apart(s.machine, here) < parts_apart(nearest->machine, here)) nearest = &s;
  }
  return nearest ? "blessed " + differences_of(nearest->machine, here) : "";
}

void judge(SpeedCompared& row) {
  const int direction = direction_of(row.change, row.noise);
  row.state = direction > 0 ? Pace::slower : direction < 0 ? Pace::faster : Pace::same;
}

bool suspected(const SpeedCompared& row) { return row.state == Pace::slower || row.state == Pace::faster; }

const SpeedQuestion& question_of(const SpeedCompared& row, const std::vector<SpeedQuestion>& questions) {
  return *std::find_if(questions.begin(), questions.end(), [&](const SpeedQuestion& q) {
    return q.scene.name == row.scene && q.method.name == row.method;
  });
}

/// A suspicion and what was measured of it since.
struct Suspect {
  SpeedCompared* row;
  std::vector<double> is, was;
  std::vector<Timing> changes;

  /// Whether it shows again.
  bool look(const Ratios& ratios) {
    if (ratios.is.empty()) return false;
    is.push_back(middle(ratios.is)), was.push_back(ratios.was.empty() ? *row->was : middle(ratios.was));
    changes.push_back(timing_of(changes_of(ratios, *row->was)));
    return direction_of(changes.back(), row->noise) == (row->state == Pace::slower ? 1 : -1);
  }
  void settle() const {
    if (is.empty()) return;
    row->is = middle(is), row->was = middle(was), row->seen = static_cast<int>(is.size());
    std::vector<double> medians;
    Timing& all = row->change;
    all = changes.front();
    for (const Timing& c : changes) {
      medians.push_back(c.median);
      all.low = std::min(all.low, c.low), all.high = std::max(all.high, c.high);
    }
    all.median = middle(medians);
  }
};

}  // namespace

std::string_view name_of(Pace state) {
  // in the order of the states
  constexpr std::string_view names[] = {"slower", "gone", "faster", "same", "new", "not compared"};
  return names[static_cast<int>(state)];
}

double noise_of(double spread) { return std::max(0.1, 2 * spread); }

double spread_of(const std::vector<double>& middles) {
  const double m = middle(middles);
  std::vector<double> off;
  for (const double each : middles) off.push_back(std::max(each / m, m / each) - 1);
  std::sort(off.begin(), off.end());
  return off.size() > 1 ? off[off.size() - 2] : 0;
}

int direction_of(const Timing& change, double noise) {
  return change.low > 1 + noise ? 1 : change.high < 1 / (1 + noise) ? -1 : 0;
}

std::vector<SpeedCompared> first_look(const std::vector<SpeedQuestion>& questions, const SpeedFile* blessed,
                                      const Machine& machine, const Measure& measure) {
  const std::vector<Ratios> measured = measure(questions, once);
  std::vector<std::vector<double>> each;
  for (const Ratios& ratios : measured) each.push_back(changes_of(ratios, 1));
  const double noise_now = noise_floor(each);
  std::vector<SpeedCompared> rows;
  for (size_t i = 0; i < questions.size(); ++i) {
    const SpeedQuestion& q = questions[i];
    const Ratios& now = measured[i];
    const BlessedSpeed* known = blessed && !q.against ? find_speed(*blessed, q, machine) : nullptr;
    if (known && known->hash != q.scene.hash) known = nullptr;
    SpeedCompared row{q.scene.name, q.method.name};
    if (now.is.empty()) {
      if (!known) continue;
      row.was = known->ratio, row.state = Pace::gone, row.note = "no speed: the run is now refused or fails";
      rows.push_back(std::move(row));
      continue;
    }
    row.is = middle(now.is);
    if (q.against) {
      row.was = middle(now.was), row.noise = noise_of(noise_now);
    } else if (known) {
      row.was = known->ratio, row.noise = noise_of(std::max(known->spread, noise_now));
    } else {
      row.note = blessed ? why_elsewhere(*blessed, q, machine) : "";
      row.state = row.note.empty() ? Pace::fresh : Pace::elsewhere;
    }
    if (row.was) {
      row.change = timing_of(changes_of(now, *row.was));
      judge(row);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

void confirm(std::vector<SpeedCompared>& rows, const std::vector<SpeedQuestion>& questions, const Measure& measure) {
  std::vector<Suspect> suspects;
  for (SpeedCompared& row : rows)
    if (suspected(row)) suspects.push_back({&row, {}, {}, {}});
  for (int i = 0; i < confirmations && !suspects.empty(); ++i) {
    std::vector<SpeedQuestion> asked;
    for (const Suspect& s : suspects) asked.push_back(question_of(*s.row, questions));
    const std::vector<Ratios> measured = measure(asked, again);
    std::vector<Suspect> left;
    for (size_t k = 0; k < suspects.size(); ++k) {
      const bool shows = suspects[k].look(measured[k]);
      suspects[k].settle();
      if (shows)
        left.push_back(std::move(suspects[k]));
      else
        suspects[k].row->state = Pace::same;
    }
    suspects = std::move(left);
  }
}

std::vector<BlessedSpeed> speeds_to_bless(const std::vector<SpeedQuestion>& questions, const Machine& machine,
                                          const Measure& measure) {
  std::vector<std::vector<double>> middles(questions.size());
  for (int block = 0; block < blocks; ++block) {
    const std::vector<Ratios> measured = measure(questions, once);
    for (size_t i = 0; i < questions.size(); ++i)
      if (!measured[i].is.empty()) middles[i].push_back(middle(measured[i].is));
  }
  std::vector<BlessedSpeed> speeds;
  for (size_t i = 0; i < questions.size(); ++i)
    if (!middles[i].empty())
      speeds.push_back({questions[i].scene.name, questions[i].scene.hash, questions[i].method.name, middle(middles[i]),
                        spread_of(middles[i]), machine});
  return speeds;
}

}  // namespace crosscheck
