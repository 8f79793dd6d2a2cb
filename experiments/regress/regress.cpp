#include "experiments/regress/regress.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "experiments/regress/baseline.h"
#include "experiments/tables/typed.h"
#include "mysim/base/errors.h"
#include "mysim/base/hash.h"

namespace crosscheck {
namespace {

/// With tolerances, a case needs three or four more runs.
struct Job {
  Case test_case;
  std::string name;
  bool with_tolerances = false;
};

struct JobResults {
  std::map<std::string, std::vector<QuantityWithTolerance>>
      quantities;  // by name of the job; tolerances are 0 if the job does not compute them
  std::vector<FailedPoint> failures;
};

/// A quantity as the process that ran the case passes it to the parent.
struct QuantityRow {
  TABLE("quantities");
  COLUMN(std::string, test_case, "case", "1", "scene, method and the removed ingredient");
  COLUMN(std::string, quantity, "quantity", "1", "name of the quantity");
  COLUMN(std::string, unit, "unit", "1", "unit of value and tolerance; word: the value is a text");
  COLUMN(double, value, "value", "1", "value, if it is a number");
  COLUMN(std::string, word, "word", "1", "value, if it is a text");
  COLUMN(bool, count, "count", "1", "1 for a whole number that is unaffected by rounding");
  COLUMN(double, tolerance, "tolerance", "1", "largest change by rounding; 0 if it was not measured");
  COLUMN(std::string, derivation, "derivation", "1", "derivation of the tolerance");
};

Point point_of(const Job& job) {
  const auto& [test_case, name, tolerances] = job;
  return {name, test_case.scene.hash + test_case.method.fingerprint + (tolerances ? " tolerances" : ""),
          [job](TableSet& tables) {
            std::vector<QuantityWithTolerance> all;
            if (job.with_tolerances)
              all = with_tolerances(job.test_case);
            else
              for (Quantity& q : quantities_of(job.test_case, run_case(job.test_case)))
                all.push_back({std::move(q), 0, ""});
            Table table = table_of<QuantityRow>();
            for (const auto& [q, tolerance, derivation] : all)
              add(table, QuantityRow{job.name, q.name, q.unit, q.value, q.word, q.count, tolerance, derivation});
            tables.add(table);
          },
          false};
}

std::vector<QuantityWithTolerance> quantities_of(const Table& table) {
  std::vector<QuantityWithTolerance> all;
  for (QuantityRow& row : rows_of<QuantityRow>(table))
    all.push_back({{row.quantity, row.unit, row.value, row.word, row.count}, row.tolerance, row.derivation});
  return all;
}

/// Runs each case in a separate process. `out`: folder for finished cases.
JobResults run_jobs(const std::vector<Job>& all, const std::filesystem::path& out, const LockPatience& patience,
                    Progress& progress) {
  std::vector<Point> points;
  for (const Job& job : all) points.push_back(point_of(job));
  progress.expect(static_cast<int>(points.size()));
  const Store store(store_in(out));
  store.clear();
  JobResults results;
  results.failures = run_points(points, {patience}, store, progress);
  for (const Point& point : points) {
    const auto found = store.find(point.hash());
    if (const Table* table = found ? found->table(std::string(QuantityRow::table)) : nullptr)
      results.quantities[point.name] = quantities_of(*table);
  }
  return results;
}

const QuantityWithTolerance* find(const std::vector<QuantityWithTolerance>& all, const std::string& name) {
  const auto at =
      std::find_if(all.begin(), all.end(), [&](const QuantityWithTolerance& t) { return t.quantity.name == name; });
  return at == all.end() ? nullptr : &*at;
}

std::vector<Quantity> quantities_in(const std::vector<QuantityWithTolerance>& all) {
  std::vector<Quantity> list;
  for (const QuantityWithTolerance& t : all) list.push_back(t.quantity);
  return list;
}

Case with_method(const Method& method, Case test_case) {
  test_case.method = method;
  return test_case;
}

std::string name_with_other_method(const Case& q) { return q.in_words() + " (against)"; }

std::string source_hash(const Scene& scene) { return fmt::format("{:016x}", Fnv1a::of(scene.source)); }

/// False if the method refused the scene.
bool is_measured(const std::string& word) { return !word.empty() && word != name_of(Verdict::unsupported); }

/// Reports a missing, stale or unreadable file as a failed row.
class BaselineCache {
 public:
  BaselineCache(const std::filesystem::path& folder, std::vector<Comparison>& rows) : folder_(folder), rows_(rows) {}

  const Baseline* of(const Case& test_case) {
    const std::string& scene = test_case.scene.name;
    if (const auto known = cache_.find(scene); known != cache_.end()) return known->second ? &*known->second : nullptr;
    auto& place = cache_[scene];
    Comparison row;
    row.scene = scene, row.quantity = "baseline", row.unit = "word";
    try {
      place = read_baseline(folder_, scene);
      if (!place) {
        row.state = Status::missing, row.note = fmt::format("{}: no such file", file_of(folder_, scene).string());
        rows_.push_back(row);
      } else if (const std::string now = test_case.hash; place->hash != now) {
        row.state = Status::stale, row.was_word = place->hash, row.is_word = now;
        row.note = place->source == source_hash(test_case.scene)
                       ? "the same file now expands to another scene: the code that reads it has changed"
                       : fmt::format("the scene is not the one that was blessed{}",
                                     place->source.empty() ? "" : ": its file has changed");
        rows_.push_back(row);
        place.reset();
      }
    } catch (const InputError& error) {
      row.state = Status::unreadable, row.note = error.what();
      rows_.push_back(row);
    }
    return place ? &*place : nullptr;
  }

 private:
  std::filesystem::path folder_;
  std::vector<Comparison>& rows_;
  std::map<std::string, std::optional<Baseline>> cache_;
};

/// The other method's quantities as expected values. Ignores quantities that only one of the methods has. The verdict
/// is always compared, because both methods have one.
std::vector<BaselineRow> rows_from_other_method(const std::vector<QuantityWithTolerance>& old,
                                                const std::vector<QuantityWithTolerance>& now, const Case& q) {
  std::vector<BaselineRow> expected;
  for (const QuantityWithTolerance& t : old)
    if (find(now, t.quantity.name)) expected.push_back({q.method.name, q.without, false, t});
  return expected;
}

/// Rows of blessed cases that no longer exist.
std::vector<Comparison> no_longer_selected(const Baseline& baseline, const std::vector<Case>& all, bool full) {
  std::set<std::pair<std::string, std::string>> selected;
  for (const Case& q : all)
    if (q.scene.name == baseline.scene) selected.emplace(q.method.name, q.without);
  std::vector<Comparison> rows;
  for (const BaselineRow& e : baseline.expected) {
    if ((e.slow && !full) || !selected_by_default(e.method) || !selected.emplace(e.method, e.without).second) continue;
    Comparison row;
    row.scene = baseline.scene, row.method = e.method, row.without = e.without;
    row.quantity = "all", row.unit = "word", row.state = Status::gone;
    row.note = "no longer measured";
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

bool RegressionResult::measured() const {
  return std::any_of(rows.begin(), rows.end(),
                     [](const Comparison& row) { return row.is || is_measured(row.is_word); });
}

bool RegressionResult::passed() const {
  return measured() && failures.empty() &&
         std::none_of(rows.begin(), rows.end(), [](const Comparison& row) { return failed(row.state); });
}

RegressionResult regress(const Regression& regression, Progress& progress) {
  const std::vector<Case> all = cases(regression.selection);
  std::vector<Job> todo;
  for (const Case& q : all) {
    todo.push_back({q, q.in_words()});
    if (regression.against) todo.push_back({with_method(*regression.against, q), name_with_other_method(q), true});
  }
  JobResults results = run_jobs(todo, regression.out, regression.patience, progress);
  RegressionResult result;
  result.failures = std::move(results.failures);
  std::vector<Comparison> rows;
  BaselineCache cache(regression.baselines, result.rows);
  std::set<std::string> whole_scenes;
  for (const Case& q : all) {
    const auto is = results.quantities.find(q.in_words());
    if (is == results.quantities.end()) continue;
    std::vector<BaselineRow> expected;
    if (regression.against) {
      const auto was = results.quantities.find(name_with_other_method(q));
      if (was == results.quantities.end()) continue;
      expected = rows_from_other_method(was->second, is->second, q);
    } else if (const Baseline* baseline = cache.of(q)) {
      expected = baseline_rows_of(*baseline, q);
      if (covers_all(regression.selection) && whole_scenes.insert(q.scene.name).second) {
        const auto gone = no_longer_selected(*baseline, all, regression.selection.full);
        rows.insert(rows.end(), gone.begin(), gone.end());
      }
    } else {
      continue;  // the missing baseline is reported once per scene
    }
    const std::vector<Comparison> more = compared(q, quantities_in(is->second), expected);
    rows.insert(rows.end(), more.begin(), more.end());
  }
  result.rows.insert(result.rows.end(), rows.begin(), rows.end());
  return result;
}

namespace {

using CaseKey = std::pair<std::string, std::string>;  // method, without

class Change {
 public:
  /// Throws InputError if the file cannot be read, or if it is stale and only some of its cases are selected.
  Change(const Case& test_case, const Regression& regression, const Blessing& blessing) {
    auto old = read_baseline(regression.baselines, test_case.scene.name);
    const Selection& selection = regression.selection;
    const bool part = !selection.filter.empty() && selection.filter != test_case.scene.name;
    if (old && old->hash != test_case.hash) {
      if (part || !selection.methods.empty() || !selection.full)
        throw InputError(
            fmt::format("{}: expected the whole scene to be blessed (--full --filter {}), as the scene has changed",
                        file_of(regression.baselines, test_case.scene.name).string(), test_case.scene.name));
      old->expected.clear();
    }
    if (old) baseline_ = *old;
    baseline_.scene = test_case.scene.name, baseline_.hash = test_case.hash;
    baseline_.source = source_hash(test_case.scene);
    baseline_.blessings.push_back(blessing);
  }

  /// Unchanged quantities keep their row and blessing. Throws InputError if a number is not finite.
  void add(const Case& q, const std::vector<QuantityWithTolerance>& now) {
    selected_.emplace(q.method.name, q.without);
    const std::vector<BaselineRow> before = baseline_rows_of(baseline_, q);
    std::vector<BaselineRow> after;
    for (const Comparison& row : compared(q, quantities_in(now), before)) {
      if (row.state == Status::not_finite)
        throw InputError(fmt::format("nothing is blessed: {}: {} is not finite; --method can leave this method out",
                                     q.in_words(), row.quantity));
      if (row.state != Status::same) changed_.push_back(row);
      if (row.state == Status::gone) continue;
      const auto kept =
          std::ranges::find(before, row.quantity, [](const BaselineRow& e) { return e.what.quantity.name; });
      if (row.state == Status::same)
        after.push_back({q.method.name, q.without, q.slow, kept->what, kept->blessing});
      else
        after.push_back(
            {q.method.name, q.without, q.slow, *find(now, row.quantity), static_cast<int>(baseline_.blessings.size())});
    }
    std::erase_if(baseline_.expected,
                  [&](const BaselineRow& e) { return e.method == q.method.name && e.without == q.without; });
    baseline_.expected.insert(baseline_.expected.end(), after.begin(), after.end());
  }

  void drop_what_is_not_selected() {
    std::erase_if(baseline_.expected, [&](const BaselineRow& e) {
      if (!selected_by_default(e.method) || selected_.contains({e.method, e.without})) return false;
      Comparison row;
      row.scene = baseline_.scene, row.method = e.method, row.without = e.without;
      row.quantity = e.what.quantity.name, row.unit = e.what.quantity.unit, row.state = Status::gone;
      changed_.push_back(row);
      return true;
    });
  }

  const std::vector<Comparison>& changed() const { return changed_; }

  int blessing() const { return static_cast<int>(baseline_.blessings.size()); }

  std::string text() {
    std::stable_sort(baseline_.expected.begin(), baseline_.expected.end(),
                     [](const BaselineRow& a, const BaselineRow& b) {
                       return std::tie(a.method, a.without) < std::tie(b.method, b.without);
                     });
    return text_of(baseline_);
  }

 private:
  Baseline baseline_;
  std::set<CaseKey> selected_;
  std::vector<Comparison> changed_;
};

/// Empty if there is no shape.
std::string shape_of(const Case& q) {
  const CaseRun part = comparable_part(run_case(q));
  if (part.trajectory.frames() == 0) return "";
  return shape_text(q.scene.name, q.method.name, part.trajectory.t.back(), part.trajectory.x.back());
}

}  // namespace

BlessResult bless(const Regression& regression, const Blessing& blessing, Progress& progress) {
  const std::vector<Case> all = cases(regression.selection);
  std::vector<Job> todo;
  for (const Case& q : all) todo.push_back({q, q.in_words(), true});
  const JobResults results = run_jobs(todo, regression.out, regression.patience, progress);
  for (const FailedPoint& f : results.failures)
    throw InputError(fmt::format("nothing is blessed: {}: {}", f.name, f.why));

  std::map<std::string, Change> changes;
  for (const Case& q : all)
    changes.try_emplace(q.scene.name, q, regression, blessing)
        .first->second.add(q, results.quantities.at(q.in_words()));
  BlessResult blessed;
  for (const Case& q : all)
    for (const QuantityWithTolerance& t : results.quantities.at(q.in_words()))
      blessed.measured |= !t.quantity.is_word() || is_measured(t.quantity.word);
  if (!blessed.measured) return blessed;
  for (auto& [scene, change] : changes) {
    if (covers_all(regression.selection) && regression.selection.full) change.drop_what_is_not_selected();
    if (change.changed().empty()) continue;
    blessed.files.emplace_back(file_of(regression.baselines, scene), change.text());
    blessed.numbers[scene] = change.blessing();
    blessed.changed.insert(blessed.changed.end(), change.changed().begin(), change.changed().end());
    for (const Case& q : all)
      if (q.scene.name == scene && q.without.empty() && q.method.name == find_method(q.scene.method).name)
        if (const std::string shape = shape_of(q); !shape.empty())
          blessed.files.emplace_back(shape_file(regression.baselines, scene), shape);
  }
  return blessed;
}

}  // namespace crosscheck
