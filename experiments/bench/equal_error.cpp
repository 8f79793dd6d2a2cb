#include "experiments/bench/equal_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/bench/equal_error_tables.h"
#include "experiments/bench/paths.h"
#include "experiments/speed_accuracy/conclude.h"
#include "experiments/speed_accuracy/speed_accuracy.h"
#include "experiments/timing.h"

namespace crosscheck {
namespace {

/// What an evaluation of mysim's methods takes by one path, s, round by round.
struct OwnTimes {
  Path path;
  std::map<std::string, std::vector<double>> per_evaluation;  // by method; those of which a run ended well
};

/// The times of the peers' runs in their order (none of those that failed), and mysim's.
struct Times {
  std::vector<TurnTimes> peers;
  std::vector<OwnTimes> own;
};

Times in_turns(const EqualErrorAsked& asked, const std::vector<SheetRun>& peers, const std::vector<SheetRun>& own) {
  Times times;
  times.peers.resize(peers.size());
  std::vector<Turn> turns;
  std::vector<std::function<void(const TurnTimes&)>> take;  // where the times of each turn go
  for (size_t i = 0; i < peers.size(); ++i) {
    if (!peers[i].ok()) continue;
    turns.push_back({peers[i].method, asked.scene, peers[i].run});
    take.push_back([&times, i](const TurnTimes& all) { times.peers[i] = all; });
  }
  for (const Path& path : paths()) times.own.push_back({path, {}});
  for (OwnTimes& mine : times.own)
    for (const SheetRun& run : own) {
      if (!run.ok()) continue;
      const auto [entry, is_new] = mine.per_evaluation.try_emplace(run.method.name);
      if (!is_new) continue;
      turns.push_back({run.method, asked.scene, run.run, mine.path.instructions});
      take.push_back([&to = entry->second](const TurnTimes& all) { to = all.per_evaluation; });
    }
  const std::vector<TurnTimes> all = timed_in_turns(turns, asked.turns);
  for (size_t i = 0; i < all.size(); ++i) take[i](all[i]);
  return times;
}

Timing time_of(const SheetRun& run, const std::vector<double>& per_evaluation) {
  return timing_of(per_evaluation).times(static_cast<double>(run.outcome.evaluations));
}

std::vector<WorkPoint> points_of(const std::vector<SheetRun>& own, const OwnTimes& times) {
  std::vector<WorkPoint> points;
  for (const SheetRun& run : own)
    if (run.ok())
      points.push_back({run.method.name, "step [s]", run.asked, true, run.error,
                        time_of(run, times.per_evaluation.at(run.method.name)).median});
  return points;
}

void append(std::vector<Cell>& cells, std::vector<Cell> more) {
  cells.insert(cells.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

/// What stands of the peer's run in each of its rows.
std::vector<Cell> cells_of(const SheetRun& run, const std::string& scene, double bar, const TurnTimes& times) {
  std::vector<Cell> cells{scene,
                          run.method.name,
                          std::string(run.other_model ? "other model" : "same"),
                          std::string(run.method.adaptive ? "tolerance [1]" : "step [s]"),
                          run.asked,
                          std::string(name_of(run.outcome.verdict)),
                          cell_of(run.error),
                          bar,
                          run.outcome.evaluations};
  if (times.per_evaluation.empty()) {
    cells.resize(cells.size() + 4);
  } else {
    const Timing t = time_of(run, times.per_evaluation);
    append(cells, {t.median, t.low, t.high, times.share});
  }
  append(cells, {run.outcome.cpu_seconds, build_of(run.method.name)});
  return cells;
}

/// What stands of mysim in one of them.
std::vector<Cell> beside(const SheetRun& peer, const TurnTimes& its, const std::vector<SheetRun>& own,
                         const OwnTimes& times, double bar) {
  std::vector<Cell> cells{times.path.name, std::string(name_of(times.path.instructions))};
  const auto without = [&](const char* remark) {
    cells.resize(cells.size() + 7);
    cells.push_back(std::string(remark));
    return cells;
  };
  if (!peer.ok() || its.per_evaluation.empty()) return without("the peer's run failed");
  const double left = *peer.error - 2 * bar;
  if (left <= 0) return without("below the error bar of the truth");
  const std::vector<WorkPoint> points = points_of(own, times);
  const WorkPoint* best = cheapest(points, left);
  if (!best) return without("no run of mysim that was tried errs as little");
  const auto run = std::find_if(own.begin(), own.end(), [&](const SheetRun& r) {
    return r.method.name == best->method && r.asked == best->asked;
  });
  const double evaluations =
      static_cast<double>(peer.outcome.evaluations) / static_cast<double>(run->outcome.evaluations);
  const Timing ratio =
      timing_of(quotients(its.per_evaluation, times.per_evaluation.at(best->method))).times(evaluations);
  append(cells, {best->method, best->asked, *best->error, best->cost, ratio.median, ratio.low, ratio.high, Cell()});
  return cells;
}

void add_own(const std::string& scene, const std::vector<SheetRun>& own, const OwnTimes& times, double bar,
             Table& table) {
  for (const SheetRun& run : own) {
    std::vector<Cell> cells{scene,
                            run.method.name,
                            run.asked,
                            std::string(name_of(run.outcome.verdict)),
                            cell_of(run.error),
                            bar,
                            run.outcome.evaluations,
                            times.path.name,
                            std::string(name_of(times.path.instructions))};
    if (run.ok()) {
      const Timing t = time_of(run, times.per_evaluation.at(run.method.name));
      append(cells, {t.median, t.low, t.high});
    } else {
      cells.resize(cells.size() + 3);
    }
    table.add(std::move(cells));
  }
}

}  // namespace

int work_of(const EqualErrorAsked& asked) { return 1 + SheetRuns::count(asked.peers); }

void equal_error(const EqualErrorAsked& asked, Rows& rows, Progress& progress) {
  const std::string& scene = asked.scene->name;
  const SheetRuns runs(*asked.scene, progress);
  const double bar = runs.bar();
  std::vector<SheetRun> peers = runs.of(asked.peers);
  std::erase_if(peers, [&](const SheetRun& run) {
    const bool refused = run.outcome.verdict == Verdict::unsupported;
    if (const std::string note = fmt::format("bench leaves out {}: {}", run.method.name, run.outcome.reason);
        refused && std::find(rows.notes.begin(), rows.notes.end(), note) == rows.notes.end())
      rows.notes.push_back(note);
    return refused;
  });
  double wanted = INFINITY;  // m: the least error that can be told
  long most = 0;             // evaluations: as many as take mysim about the time that the dearest run takes a peer
  for (const SheetRun& run : peers) {
    if (run.ok() && *run.error > 2 * bar) wanted = std::min(wanted, *run.error - 2 * bar);
    most = std::max(most, 5 * run.outcome.evaluations);
  }
  const std::vector<SheetRun> own = runs.own(wanted, most);

  progress.begin(fmt::format("{}: all in turns", scene));
  const Times times = in_turns(asked, peers, own);
  Table table = equal_error_table(), curve = own_runs_table();
  for (size_t i = 0; i < peers.size(); ++i)
    for (const OwnTimes& path : times.own) {
      std::vector<Cell> row = cells_of(peers[i], scene, bar, times.peers[i]);
      append(row, beside(peers[i], times.peers[i], own, path, bar));
      table.add(std::move(row));
    }
  for (const OwnTimes& path : times.own) add_own(scene, own, path, bar, curve);
  rows.add(table);
  rows.add(curve);
}

}  // namespace crosscheck
