// Medians, thresholds, second measurements, and blessing.
#include "experiments/regress/speed_regression.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <thread>

#include "experiments/tables/typed.h"
#include "mysim/base/errors.h"
#include "mysim/base/files.h"

namespace crosscheck {
namespace {

constexpr SpeedOptions once{.rounds = 9}, again{.rounds = 15};
constexpr int confirmations = 4, blocks = 7;

std::vector<double> changes_of(const Ratios& ratios, double was) {
  std::vector<double> changes;
  for (size_t i = 0; i < ratios.is.size(); ++i)
    changes.push_back(ratios.is[i] / (ratios.was.empty() ? was : ratios.was[i]));
  return changes;
}

double middle(std::vector<double> values) { return timing_of(std::move(values)).median; }

/// The differences of a machine from this one, in words; empty where there are none.
std::string differences_of(const Machine& there, const Machine& here) {
  std::string text;
  const auto add_difference = [&](const char* part, const std::string& is, const std::string& would_be) {
    if (is == would_be) return;
    text += fmt::format("{}on another {} ({}; this is {})", text.empty() ? "" : " and ", part, is, would_be);
  };
  add_difference("processor", there.cpu, here.cpu);
  add_difference("compiler", there.compiler, here.compiler);
  add_difference("yardstick", there.reference_loop, here.reference_loop);
  return text;
}

int parts_apart(const Machine& a, const Machine& b) {
  return (a.cpu != b.cpu) + (a.compiler != b.compiler) + (a.reference_loop != b.reference_loop);
}

/// The case's blessed speed under other circumstances, in words: on the machine that is most like this one.
/// Empty where nothing is.
std::string why_elsewhere(const SpeedFile& file, const SpeedCase& q, const Machine& here) {
  const BlessedSpeed* nearest = nullptr;
  for (const BlessedSpeed& s : file.speeds) {
    if (s.scene != q.scene.name || s.method != q.method.name) continue;
    if (here.cpu.empty()) return "this processor cannot be told from others";
    if (s.machine == here && s.hash != q.scene.hash) return "blessed of another scene by that name";
    if (!nearest || parts_apart(s.machine, here) < parts_apart(nearest->machine, here)) nearest = &s;
  }
  return nearest ? "blessed " + differences_of(nearest->machine, here) : "";
}

void judge(SpeedComparison& row) {
  const int direction = direction_of(row.change, row.noise);
  row.state = direction > 0 ? SpeedStatus::slower : direction < 0 ? SpeedStatus::faster : SpeedStatus::same;
}

bool suspected(const SpeedComparison& row) {
  return row.state == SpeedStatus::slower || row.state == SpeedStatus::faster;
}

const SpeedCase& case_of(const SpeedComparison& row, const std::vector<SpeedCase>& cases) {
  return *std::find_if(cases.begin(), cases.end(),
                       [&](const SpeedCase& q) { return q.scene.name == row.scene && q.method.name == row.method; });
}

/// A suspicion and what was measured of it since.
struct SuspectedChange {
  SpeedComparison* row;
  std::vector<double> is, was;
  std::vector<Timing> changes;

  /// Whether it shows again.
  bool look(const Ratios& ratios) {
    if (ratios.is.empty()) return false;
    is.push_back(middle(ratios.is)), was.push_back(ratios.was.empty() ? *row->was : middle(ratios.was));
    changes.push_back(timing_of(changes_of(ratios, *row->was)));
    return direction_of(changes.back(), row->noise) == (row->state == SpeedStatus::slower ? 1 : -1);
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

std::string_view name_of(SpeedStatus state) {
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

std::vector<SpeedComparison> first_measurement(const std::vector<SpeedCase>& cases, const SpeedFile* blessed,
                                               const Machine& machine, const MeasureSpeeds& measure) {
  const std::vector<Ratios> measured = measure(cases, once);
  std::vector<std::vector<double>> each;
  for (const Ratios& ratios : measured) each.push_back(changes_of(ratios, 1));
  const double noise_now = noise_floor(each);
  std::vector<SpeedComparison> rows;
  for (size_t i = 0; i < cases.size(); ++i) {
    const SpeedCase& q = cases[i];
    const Ratios& now = measured[i];
    const BlessedSpeed* known = blessed && !q.against ? find_speed(*blessed, q, machine) : nullptr;
    if (known && known->hash != q.scene.hash) known = nullptr;
    SpeedComparison row{q.scene.name, q.method.name};
    if (now.is.empty()) {
      if (!known) continue;
      row.was = known->ratio, row.state = SpeedStatus::gone, row.note = "no speed: the run is now refused or fails";
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
      row.state = row.note.empty() ? SpeedStatus::added : SpeedStatus::elsewhere;
    }
    if (row.was) {
      row.change = timing_of(changes_of(now, *row.was));
      judge(row);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

void confirm(std::vector<SpeedComparison>& rows, const std::vector<SpeedCase>& cases, const MeasureSpeeds& measure) {
  std::vector<SuspectedChange> suspects;
  for (SpeedComparison& row : rows)
    if (suspected(row)) suspects.push_back({&row, {}, {}, {}});
  for (int i = 0; i < confirmations && !suspects.empty(); ++i) {
    std::vector<SpeedCase> to_repeat;
    for (const SuspectedChange& s : suspects) to_repeat.push_back(case_of(*s.row, cases));
    const std::vector<Ratios> measured = measure(to_repeat, again);
    std::vector<SuspectedChange> left;
    for (size_t k = 0; k < suspects.size(); ++k) {
      const bool shows = suspects[k].look(measured[k]);
      suspects[k].settle();
      if (shows)
        left.push_back(std::move(suspects[k]));
      else
        suspects[k].row->state = SpeedStatus::same;
    }
    suspects = std::move(left);
  }
}

std::vector<BlessedSpeed> speeds_to_bless(const std::vector<SpeedCase>& cases, const Machine& machine,
                                          const MeasureSpeeds& measure) {
  std::vector<std::vector<double>> middles(cases.size());
  for (int block = 0; block < blocks; ++block) {
    const std::vector<Ratios> measured = measure(cases, once);
    for (size_t i = 0; i < cases.size(); ++i)
      if (!measured[i].is.empty()) middles[i].push_back(middle(measured[i].is));
  }
  std::vector<BlessedSpeed> speeds;
  for (size_t i = 0; i < cases.size(); ++i)
    if (!middles[i].empty())
      speeds.push_back({cases[i].scene.name, cases[i].scene.hash, cases[i].method.name, middle(middles[i]),
                        spread_of(middles[i]), machine});
  return speeds;
}

namespace {

/// One round's ratios of a case on their way from the process that measured them.
struct RatiosRow {
  long test_case = 0;
  double is = 0;
  std::optional<double> was;
  static constexpr std::string_view table = "ratios", about = "Speeds of one measurement of a regression run.";
  static constexpr auto columns = [](auto&& column) {
    column("case", "1", &RatiosRow::test_case, "number of the case, from 0"),
        column("is", "1", &RatiosRow::is, "CPU time over the plain loop's, in one round"),
        column("was", "1", &RatiosRow::was, "the same of the method that it stands beside");
  };
};

Point point_of(const std::vector<SpeedCase>& cases, const SpeedOptions& options, int count) {
  return {fmt::format("speed, measurement {}", count), "",
          [&cases, options, count](TableSet& tables) {
            const std::vector<Ratios> all = measured_ratios(cases, options, count);
            Table ratios = table_of<RatiosRow>();
            for (size_t i = 0; i < all.size(); ++i)
              for (size_t k = 0; k < all[i].is.size(); ++k)
                add(ratios, RatiosRow{static_cast<long>(i), all[i].is[k],
                                      all[i].was.empty() ? std::nullopt : std::optional(all[i].was[k])});
            tables.add(ratios);
          },
          true};
}

/// The reason for no speed where no case is selected, in words.
std::string nothing_selected(const SpeedRun& run) {
  std::string outside;
  std::vector<Method> methods = run.selection.methods;
  if (run.against) methods.push_back(*run.against);
  for (const Method& method : methods)
    if (!method.family().in_process()) outside = method.name;
  return outside.empty()
             ? "no speed: none is asked of what the filter leaves"
             : fmt::format("no speed: {} is no method inside this program, and has a clock of its own", outside);
}

void note_what_is_not_compared(Speeds& speeds) {
  std::vector<std::pair<std::string, int>> reasons;
  for (const SpeedComparison& row : speeds.rows) {
    if (row.state != SpeedStatus::added && row.state != SpeedStatus::elsewhere) continue;
    const std::string why = row.state == SpeedStatus::added ? "new (not blessed yet)" : row.note;
    const auto known = std::find_if(reasons.begin(), reasons.end(), [&](const auto& r) { return r.first == why; });
    if (known == reasons.end())
      reasons.emplace_back(why, 1);
    else
      ++known->second;
  }
  for (const auto& [why, count] : reasons)
    speeds.notes.push_back(fmt::format("{} of {} speeds not compared: {}", count, speeds.rows.size(), why));
}

}  // namespace

bool Speeds::passed() const {
  return failures.empty() &&
         std::none_of(rows.begin(), rows.end(), [](const SpeedComparison& row) { return failed(row.state); });
}

std::vector<Ratios> SpeedMeasurement::operator()(const std::vector<SpeedCase>& cases, const SpeedOptions& options) {
  std::this_thread::sleep_until(begun_ + std::chrono::seconds(1));
  begun_ = std::chrono::steady_clock::now();
  const Store store(out_ / "speed-points");
  store.clear();
  const Point point = point_of(cases, options, ++count_);
  progress_.expect(1);
  for (const FailedPoint& f : run_points({&point, 1}, {patience_}, store, progress_)) throw std::runtime_error(f.why);
  const auto found = store.find(point.hash());
  const Table* table = found ? found->table(std::string(RatiosRow::table)) : nullptr;
  if (!table) throw std::runtime_error("what was measured is gone");
  std::vector<Ratios> all(cases.size());
  for (const RatiosRow& row : rows_of<RatiosRow>(*table)) {
    Ratios& one = all.at(static_cast<size_t>(row.test_case));
    one.is.push_back(row.is);
    if (row.was) one.was.push_back(*row.was);
  }
  return all;
}

Speeds compared_speeds(const std::vector<SpeedCase>& cases, const SpeedFile* blessed, const Machine& machine,
                       const MeasureSpeeds& measure) {
  Speeds speeds;
  speeds.rows = first_measurement(cases, blessed, machine, measure);
  confirm(speeds.rows, cases, measure);
  note_what_is_not_compared(speeds);
  return speeds;
}

Speeds compared_speeds(const SpeedRun& run, Progress& progress) {
  Speeds speeds;
  std::optional<SpeedFile> file;
  try {
    if (!run.against) file = read_speed_file(run.baselines);
  } catch (const InputError& error) {
    speeds.failures.push_back({"blessed speeds", error.what()});
    return speeds;
  }
  const std::vector<SpeedCase> cases = speed_cases(run.selection, run.against);
  if (cases.empty()) {
    speeds.notes.push_back(nothing_selected(run));
    return speeds;
  }
  try {
    speeds =
        compared_speeds(cases, file ? &*file : nullptr, run.machine, SpeedMeasurement(run.out, run.patience, progress));
  } catch (const std::runtime_error& error) {
    speeds.failures.push_back({"speed", error.what()});
  }
  if (!run.against && !file)
    speeds.notes = {fmt::format("speeds not compared: {}: no such file", speed_file_in(run.baselines).string())};
  if (run.patience.exhausted()) speeds.notes.emplace_back(timed_beside_other_work);
  return speeds;
}

std::vector<BlessedSpeed> merge_into(SpeedFile& file, const std::vector<BlessedSpeed>& speeds,
                                     const Blessing& blessing) {
  std::vector<BlessedSpeed> written;
  for (BlessedSpeed speed : speeds) {
    const auto old = std::find_if(file.speeds.begin(), file.speeds.end(), [&](const BlessedSpeed& s) {
      return s.scene == speed.scene && s.method == speed.method && s.machine == speed.machine;
    });
    const bool known = old != file.speeds.end();
    const double change = known ? std::max(old->ratio / speed.ratio, speed.ratio / old->ratio) : 0;
    if (known && old->hash == speed.hash && change <= 1 + noise_of(std::max(old->spread, speed.spread))) continue;
    if (written.empty()) file.blessings.push_back(blessing);
    speed.blessing = static_cast<int>(file.blessings.size());
    if (known)
      *old = speed;
    else
      file.speeds.push_back(speed);
    written.push_back(speed);
  }
  return written;
}

std::vector<BlessedSpeed> bless_speeds(const SpeedRun& run, const Blessing& blessing, Progress& progress) {
  SpeedFile file = read_speed_file(run.baselines).value_or(SpeedFile{});
  const std::vector<SpeedCase> cases = speed_cases(run.selection, {});
  if (cases.empty()) return {};
  const std::vector<BlessedSpeed> written = merge_into(
      file, speeds_to_bless(cases, run.machine, SpeedMeasurement(run.out, run.patience, progress)), blessing);
  if (!written.empty()) write_file(speed_file_in(run.baselines), text_of(file));
  return written;
}

}  // namespace crosscheck
