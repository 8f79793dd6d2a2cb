// Blessed speeds, noise, confirmations, and blessing.
#include "experiments/regress/speed_regression.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <thread>

#include "experiments/tables/typed.h"
#include "mysim/base/csv.h"
#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/names.h"

namespace crosscheck {

namespace {

constexpr const char* speed_header = "scene,hash,method,ratio,spread,machine,blessing";
constexpr const char* form_of_machine = "CPU | COMPILER AND FLAGS | YARDSTICK";

std::vector<Machine> machines_of(const std::vector<BlessedSpeed>& speeds) {
  std::vector<Machine> all;
  for (const BlessedSpeed& s : speeds)
    if (std::find(all.begin(), all.end(), s.machine) == all.end()) all.push_back(s.machine);
  return all;
}

BlessedSpeed speed_from(const std::string& line, const std::vector<Machine>& machines, size_t blessings) {
  const std::vector<std::string> f = fields_of(line);
  if (f.size() != 7) throw InputError(fmt::format("expected 7 fields, got {}", f.size()));
  BlessedSpeed s{f[0], f[1], f[2], finite_number(f[3], "ratio"), finite_number(f[4], "spread")};
  if (s.scene.empty() || s.method.empty()) throw InputError("expected a scene and a method");
  if (!(s.ratio > 0)) throw InputError("expected a ratio above zero");
  if (s.spread < 0) throw InputError("expected a spread that is not negative");
  s.machine = machines[static_cast<size_t>(number_up_to(machines.size(), f[5], "machine")) - 1];
  s.blessing = number_up_to(blessings, f[6], "blessing");
  return s;
}

}  // namespace

const BlessedSpeed* find_speed(const SpeedFile& file, const SpeedCase& test_case, const Machine& machine) {
  if (machine.cpu.empty()) return nullptr;
  for (const BlessedSpeed& s : file.speeds)
    if (s.scene == test_case.scene.name && s.method == test_case.method.name && s.machine == machine) return &s;
  return nullptr;
}

std::filesystem::path speed_file_in(const std::filesystem::path& folder) {
  return path_inside(folder, "speed-cost.csv");
}

std::string text_of(const SpeedFile& file) {
  std::string out = "# written by `crosscheck regress --bless`, never by hand\n";
  for (size_t i = 0; i < file.blessings.size(); ++i) out += comment_line_of(file.blessings[i], i + 1);
  const std::vector<Machine> machines = machines_of(file.speeds);
  for (size_t i = 0; i < machines.size(); ++i)
    out += fmt::format("# machine {}: {} | {} | {}\n", i + 1, machines[i].cpu, machines[i].compiler,
                       machines[i].reference_loop);
  out += fmt::format("# rows: {}\n", file.speeds.size());
  out += "# ratio: CPU time of the method over that of as many steps of the plain loop on the same scene, in turns;\n";
  out +=
      "# the middle of seven measurements apart in time, each in a process of its own, laid out otherwise in memory\n";
  out += "# spread: how far the second farthest of these is from the middle, relative\n";
  out += fmt::format("{}\n", speed_header);
  for (const BlessedSpeed& s : file.speeds)
    out += fmt::format("{},{},{},{:.5g},{:.2g},{},{}\n", csv_field(s.scene), s.hash, csv_field(s.method), s.ratio,
                       s.spread, std::find(machines.begin(), machines.end(), s.machine) - machines.begin() + 1,
                       s.blessing);
  return out;
}

std::optional<SpeedFile> read_speed_file(const std::filesystem::path& folder) {
  const std::filesystem::path name = speed_file_in(folder);
  if (!std::filesystem::exists(name)) return std::nullopt;
  SpeedFile file;
  read_strictly(name, [&file](StrictCsvReader& lines) {
    lines.next(), lines.next();
    file.blessings = lines.blessings();
    std::vector<Machine> machines;
    for (; lines.line().starts_with("# machine"); lines.next()) {
      const auto parts = split_by_bars(without_prefix(fmt::format("# machine {}: ", machines.size() + 1), lines.line()),
                                       3, form_of_machine);
      machines.push_back({parts[0], parts[1], parts[2]});
    }
    lines.rows(speed_header, [&](const std::string& row) {
      file.speeds.push_back(speed_from(row, machines, file.blessings.size()));
    });
  });
  return file;
}

namespace {

constexpr int rounds_at_first = 9, rounds_again = 15, confirmations = 4, blocks = 7;

/// is/was of each round; `was` is the blessed ratio where no other method ran.
std::vector<double> changes_of(const Ratios& ratios, double was) {
  return ratios_of_rounds(ratios.is, ratios.was.empty() ? std::vector(ratios.is.size(), was) : ratios.was);
}

constexpr std::pair<const char*, std::string Machine::*> machine_parts[] = {
    {"processor", &Machine::cpu}, {"compiler", &Machine::compiler}, {"yardstick", &Machine::reference_loop}};

/// The circumstances under which the case's speed is blessed, on the machine that is most like this one; empty if it is
/// not blessed at all.
std::string why_elsewhere(const SpeedFile& file, const SpeedCase& q, const Machine& here) {
  std::vector<std::string> nearest;
  for (const BlessedSpeed& s : file.speeds) {
    if (s.scene != q.scene.name || s.method != q.method.name) continue;
    if (here.cpu.empty()) return "this processor cannot be told from others";
    if (s.machine == here) return "blessed of another scene by that name";
    std::vector<std::string> differences;
    for (const auto& [part, value] : machine_parts)
      if (s.machine.*value != here.*value)
        differences.push_back(fmt::format("on another {} ({}; this is {})", part, s.machine.*value, here.*value));
    if (nearest.empty() || differences.size() < nearest.size()) nearest = std::move(differences);
  }
  return nearest.empty() ? "" : fmt::format("blessed {}", fmt::join(nearest, " and "));
}

std::optional<SpeedComparison> first_comparison(const SpeedCase& q, const Ratios& now, const SpeedFile* blessed,
                                                const Machine& machine, double noise_now) {
  const BlessedSpeed* known = blessed && !q.against ? find_speed(*blessed, q, machine) : nullptr;
  if (known && known->hash != q.scene.hash) known = nullptr;
  SpeedComparison row{q.scene.name, q.method.name};
  if (now.is.empty()) {
    if (!known) return std::nullopt;
    row.was = known->ratio, row.state = SpeedStatus::gone, row.note = "no speed: the run is now refused or fails";
    return row;
  }
  row.is = median_of(now.is);
  if (!known && !q.against) {
    row.note = blessed ? why_elsewhere(*blessed, q, machine) : "";
    row.state = row.note.empty() ? SpeedStatus::added : SpeedStatus::elsewhere;
    return row;
  }
  row.was = known ? known->ratio : median_of(now.was);
  row.noise = noise_of(known ? std::max(known->spread, noise_now) : noise_now);
  row.change = timing_of(changes_of(now, *row.was));
  const int direction = direction_of(row.change, row.noise);
  row.state = direction > 0 ? SpeedStatus::slower : direction < 0 ? SpeedStatus::faster : SpeedStatus::same;
  return row;
}

/// Measurements of a change that was suspected.
struct Confirmations {
  std::vector<double> is, was, change;  // medians

  /// Adds one; the change is taken back where it does not show again.
  void add(const Ratios& ratios, SpeedComparison& row) {
    const int direction = row.state == SpeedStatus::slower ? 1 : -1;
    int now = 0;
    if (!ratios.is.empty()) {
      const Timing next = timing_of(changes_of(ratios, *row.was));
      now = direction_of(next, row.noise);
      is.push_back(median_of(ratios.is)), change.push_back(next.median);
      was.push_back(ratios.was.empty() ? *row.was : median_of(ratios.was));
      const bool first = is.size() == 1;
      row.change = {median_of(change), first ? next.low : std::min(row.change.low, next.low),
                    first ? next.high : std::max(row.change.high, next.high), next.repetitions};
      row.is = median_of(is), row.was = median_of(was), row.seen = static_cast<int>(is.size());
    }
    if (now != direction) row.state = SpeedStatus::same;
  }
};

void confirm(std::vector<SpeedComparison>& rows, const std::vector<SpeedCase>& cases, const MeasureSpeeds& measure) {
  std::map<SpeedComparison*, Confirmations> seen;
  for (int i = 0; i < confirmations; ++i) {
    std::vector<SpeedComparison*> suspects;
    std::vector<SpeedCase> to_repeat;
    for (SpeedComparison& row : rows) {
      if (row.state != SpeedStatus::slower && row.state != SpeedStatus::faster) continue;
      suspects.push_back(&row);
      to_repeat.push_back(*std::ranges::find_if(
          cases, [&](const SpeedCase& q) { return q.scene.name == row.scene && q.method.name == row.method; }));
    }
    if (suspects.empty()) return;
    const std::vector<Ratios> measured = measure(to_repeat, rounds_again);
    for (size_t k = 0; k < suspects.size(); ++k) seen[suspects[k]].add(measured[k], *suspects[k]);
  }
}

std::vector<std::string> notes_of(const std::vector<SpeedComparison>& rows) {
  std::map<std::string, int> reasons;
  for (const SpeedComparison& row : rows)
    if (row.state == SpeedStatus::added || row.state == SpeedStatus::elsewhere)
      ++reasons[row.state == SpeedStatus::added ? "new (not blessed yet)" : row.note];
  std::vector<std::string> notes;
  for (const auto& [why, count] : reasons)
    notes.push_back(fmt::format("{} of {} speeds not compared: {}", count, rows.size(), why));
  return notes;
}

/// One round's ratios of a case on their way from the process that measured them.
struct RatiosRow {
  TABLE("ratios");
  COLUMN(long, test_case, "case", "1", "number of the case, from 0");
  COLUMN(double, is, "is", "1", "CPU time over the plain loop's, in one round");
  COLUMN(OptionalNumber, was, "was", "1", "the same of the method that it stands beside");
};

/// The reason for no speed where no case is selected, in words.
std::string nothing_selected(const Regression& regression) {
  std::string outside;
  std::vector<Method> methods = regression.selection.methods;
  if (regression.against) methods.push_back(*regression.against);
  for (const Method& method : methods)
    if (!method.family().in_process()) outside = method.name;
  return outside.empty()
             ? "no speed: none is asked of what the filter leaves"
             : fmt::format("no speed: {} is no method inside this program, and has a clock of its own", outside);
}

}  // namespace

std::string_view name_of(SpeedStatus state) {
  // in the order of the states
  constexpr std::string_view names[] = {"slower", "gone", "faster", "same", "new", "not compared"};
  return names[static_cast<int>(state)];
}

double noise_of(double spread) { return std::max(0.1, 2 * spread); }

bool Speeds::passed() const {
  return failures.empty() &&
         std::none_of(rows.begin(), rows.end(), [](const SpeedComparison& row) { return failed(row.state); });
}

Speeds compared_speeds(const std::vector<SpeedCase>& cases, const SpeedFile* blessed, const Machine& machine,
                       const MeasureSpeeds& measure) {
  const std::vector<Ratios> measured = measure(cases, rounds_at_first);
  std::vector<std::vector<double>> changes;
  for (const Ratios& ratios : measured) changes.push_back(changes_of(ratios, 1));
  const double noise_now = noise_floor(changes);
  Speeds speeds;
  for (size_t i = 0; i < cases.size(); ++i)
    if (auto row = first_comparison(cases[i], measured[i], blessed, machine, noise_now))
      speeds.rows.push_back(std::move(*row));
  confirm(speeds.rows, cases, measure);
  speeds.notes = notes_of(speeds.rows);
  return speeds;
}

void add_sentences(std::vector<SpeedComparison>& speeds, std::span<const Comparison> quantities) {
  for (SpeedComparison& speed : speeds) {
    if (speed.state != SpeedStatus::slower && speed.state != SpeedStatus::faster) continue;
    const bool faster = speed.state == SpeedStatus::faster;
    const double factor = faster ? 1 / speed.change.median : speed.change.median;
    speed.sentence = fmt::format("{:.3g} times {}", factor, faster ? "faster" : "slower");
    for (const Comparison& row : quantities)
      if (row.state == Status::moved && row.scene == speed.scene && row.method == speed.method && row.without.empty() &&
          (row.quantity == error_quantity || row.quantity == halving_quantity))
        speed.sentence += fmt::format("; {} was {:.2g}, is {:.2g} m", row.quantity, *row.was, *row.is);
  }
}

std::vector<BlessedSpeed> speeds_to_bless(const std::vector<SpeedCase>& cases, const Machine& machine,
                                          const MeasureSpeeds& measure) {
  std::vector<std::vector<double>> middles(cases.size());
  for (int block = 0; block < blocks; ++block) {
    const std::vector<Ratios> measured = measure(cases, rounds_at_first);
    for (size_t i = 0; i < cases.size(); ++i)
      if (!measured[i].is.empty()) middles[i].push_back(median_of(measured[i].is));
  }
  std::vector<BlessedSpeed> speeds;
  for (size_t i = 0; i < cases.size(); ++i)
    if (!middles[i].empty())
      speeds.push_back({cases[i].scene.name, cases[i].scene.hash, cases[i].method.name, median_of(middles[i]),
                        spread_of(middles[i]), machine});
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

MeasureSpeeds measurements_in(const std::filesystem::path& out, const LockPatience& patience, Progress& progress) {
  using Clock = std::chrono::steady_clock;
  return [out, patience, &progress, count = 0, begun = Clock::time_point()](const std::vector<SpeedCase>& cases,
                                                                            int rounds) mutable {
    std::this_thread::sleep_until(begun + std::chrono::seconds(1));
    begun = Clock::now();
    ++count;
    const Point point{fmt::format("speed, measurement {}", count), "",
                      [&](TableSet& tables) {
                        const std::vector<Ratios> all = measured_ratios(cases, rounds, count);
                        Table ratios = table_of<RatiosRow>();
                        for (size_t i = 0; i < all.size(); ++i)
                          for (size_t k = 0; k < all[i].is.size(); ++k)
                            add(ratios, RatiosRow{static_cast<long>(i), all[i].is[k],
                                                  all[i].was.empty() ? std::nullopt : std::optional(all[i].was[k])});
                        tables.add(ratios);
                      },
                      true};
    const Store store(out / "speed-points");
    store.clear();
    progress.expect(1);
    for (const FailedPoint& f : run_points({&point, 1}, {patience}, store, progress)) throw std::runtime_error(f.why);
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
  };
}

Speeds compared_speeds(const Regression& regression, const Machine& machine, Progress& progress) {
  Speeds speeds;
  const std::vector<SpeedCase> cases = speed_cases(regression.selection, regression.against);
  try {
    std::optional<SpeedFile> file;
    if (!regression.against) file = read_speed_file(regression.baselines);
    if (cases.empty()) {
      speeds.notes.push_back(nothing_selected(regression));
      return speeds;
    }
    speeds = compared_speeds(cases, file ? &*file : nullptr, machine,
                             measurements_in(regression.out, regression.patience, progress));
    if (!regression.against && !file)
      speeds.notes = {
          fmt::format("speeds not compared: {}: no such file", speed_file_in(regression.baselines).string())};
  } catch (const InputError& error) {
    speeds.failures.push_back({"blessed speeds", error.what()});
  } catch (const std::runtime_error& error) {
    speeds.failures.push_back({"speed", error.what()});
  }
  if (regression.patience.exhausted()) speeds.notes.emplace_back(timed_beside_other_work);
  return speeds;
}

std::vector<BlessedSpeed> bless_speeds(const Regression& regression, const Machine& machine, const Blessing& blessing,
                                       Progress& progress) {
  SpeedFile file = read_speed_file(regression.baselines).value_or(SpeedFile{});
  const std::vector<SpeedCase> cases = speed_cases(regression.selection, {});
  if (cases.empty()) return {};
  const std::vector<BlessedSpeed> written = merge_into(
      file, speeds_to_bless(cases, machine, measurements_in(regression.out, regression.patience, progress)), blessing);
  if (!written.empty()) write_file(speed_file_in(regression.baselines), text_of(file));
  return written;
}

}  // namespace crosscheck
