#include "experiments/regress/regress.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "experiments/scenes.h"
#include "mysim/errors.h"
#include "mysim/files.h"

namespace crosscheck {
namespace {

Table answers_table() {
  return {"answers",
          {{"question", "1"},
           {"quantity", "1"},
           {"unit", "1"},
           {"value", "1"},
           {"word", "1"},
           {"count", "1"},
           {"tolerance", "1"},
           {"derivation", "1"}},
          {}};
}

/// Its rows are the question's quantities; tolerances take three more runs.
Point point_of(const Question& question, const std::string& name, bool with_tolerances_too) {
  return {name, question.scene.hash + question.method.fingerprint + (with_tolerances_too ? " tolerances" : ""),
          [question, name, with_tolerances_too](Rows& rows) {
            std::vector<Toleranced> all;
            if (with_tolerances_too)
              all = with_tolerances(question);
            else
              for (Quantity& q : quantities_of(question, answer_to(question))) all.push_back({std::move(q), 0, ""});
            Table table = answers_table();
            for (const Toleranced& t : all)
              table.add({name, t.quantity.name, t.quantity.unit, t.quantity.value, t.quantity.word,
                         static_cast<long>(t.quantity.count), t.tolerance, t.derivation});
            rows.add(table);
          },
          false};
}

using Answers = std::map<std::string, std::vector<Toleranced>>;  // by name of the point

Answers asked(const std::vector<Point>& points, const Regression& regression, Progress& progress,
              std::vector<FailedPoint>& failures) {
  const Store store(store_in(regression.out));
  store.clear();
  failures = run_points(points, {regression.jobs, {}}, store, progress);
  Answers answers;
  for (const Point& point : points) {
    const auto rows = store.find(point.hash());
    const Table* table = rows ? rows->table("answers") : nullptr;
    for (size_t i = 0; table && i < table->rows.size(); ++i) {
      Toleranced t;
      t.quantity = {std::get<std::string>(table->at(i, "quantity")), std::get<std::string>(table->at(i, "unit")),
                    std::get<double>(table->at(i, "value")), std::get<std::string>(table->at(i, "word")),
                    std::get<long>(table->at(i, "count")) != 0};
      t.tolerance = std::get<double>(table->at(i, "tolerance"));
      t.derivation = std::get<std::string>(table->at(i, "derivation"));
      answers[point.name].push_back(std::move(t));
    }
  }
  return answers;
}

bool has(const std::vector<Toleranced>& all, const std::string& name) {
  return std::any_of(all.begin(), all.end(), [&](const Toleranced& t) { return t.quantity.name == name; });
}

std::vector<Quantity> quantities_in(const std::vector<Toleranced>& all) {
  std::vector<Quantity> list;
  for (const Toleranced& t : all) list.push_back(t.quantity);
  return list;
}

Question by(const Method& method, Question question) {
  question.method = method;
  return question;
}

std::string name_of_old(const Question& q) { return q.in_words() + " (against)"; }

/// The scenes' baselines; what is wrong with a file is a row.
class Shelf {
 public:
  Shelf(const std::filesystem::path& folder, std::vector<Compared>& rows) : folder_(folder), rows_(rows) {}

  /// Null where there is none that can be used.
  const Baseline* of(const Question& question) {
    const std::string& scene = question.scene.name;
    if (const auto known = shelf_.find(scene); known != shelf_.end()) return known->second ? &*known->second : nullptr;
    auto& place = shelf_[scene];
    Compared row;
    row.scene = scene, row.quantity = "baseline", row.unit = "word";
    try {
      place = read_baseline(folder_, scene);
      if (!place) {
        row.state = Standing::missing, row.note = fmt::format("{}: no such file", file_of(folder_, scene).string());
        rows_.push_back(row);
      } else if (const std::string now = load_scene(scene).hash; place->hash != now) {
        row.state = Standing::stale, row.was_word = place->hash, row.is_word = now;
        row.note = "the scene is another one than the one that these are answers to";
        rows_.push_back(row);
        place.reset();
      }
    } catch (const InputError& error) {
      row.state = Standing::unreadable, row.note = error.what();
      rows_.push_back(row);
    }
    return place ? &*place : nullptr;
  }

 private:
  std::filesystem::path folder_;
  std::vector<Compared>& rows_;
  std::map<std::string, std::optional<Baseline>> shelf_;
};

}  // namespace

bool Regressed::passed() const {
  return failures.empty() &&
         std::none_of(rows.begin(), rows.end(), [](const Compared& row) { return failed(row.state); });
}

Regressed regress(const Regression& regression, Progress& progress) {
  const std::vector<Question> all = questions(regression.asked);
  std::vector<Point> points;
  for (const Question& q : all) {
    points.push_back(point_of(q, q.in_words(), false));
    if (regression.against) points.push_back(point_of(by(*regression.against, q), name_of_old(q), true));
  }
  progress.expect(static_cast<int>(points.size()));
  Regressed result;
  const Answers answers = asked(points, regression, progress, result.failures);
  std::vector<Compared> rows;
  Shelf shelf(regression.baselines, result.rows);
  for (const Question& q : all) {
    const auto is = answers.find(q.in_words());
    if (is == answers.end()) continue;
    std::vector<Expected> expected;
    if (regression.against) {
      const auto was = answers.find(name_of_old(q));
      if (was == answers.end()) continue;
      // what only one of two engines is asked for is no difference between them; their verdicts both have
      for (const Toleranced& t : was->second)
        if (has(is->second, t.quantity.name)) expected.push_back({q.method.name, q.without, false, t});
    } else if (const Baseline* baseline = shelf.of(q)) {
      expected = expected_of(*baseline, q);
    } else {
      continue;  // said once for the scene
    }
    const std::vector<Compared> more = compared(q, quantities_in(is->second), expected);
    rows.insert(rows.end(), more.begin(), more.end());
  }
  result.rows.insert(result.rows.end(), rows.begin(), rows.end());
  return result;
}

Blessed bless(const Regression& regression, const Blessing& blessing, Progress& progress) {
  const std::vector<Question> all = questions(regression.asked);
  std::vector<Point> points;
  for (const Question& q : all) points.push_back(point_of(q, q.in_words(), true));
  progress.expect(static_cast<int>(points.size()));
  std::vector<FailedPoint> failures;
  const Answers answers = asked(points, regression, progress, failures);
  for (const FailedPoint& f : failures) throw InputError(fmt::format("nothing is blessed: {}: {}", f.name, f.why));

  Blessed blessed;
  std::map<std::string, Baseline> changed;
  for (const Question& q : all) {
    const std::string& scene = q.scene.name;
    const std::string hash = load_scene(scene).hash;
    if (!changed.contains(scene)) {
      auto old = read_baseline(regression.baselines, scene);
      const bool part = !regression.asked.filter.empty() && regression.asked.filter != scene;
      if (old && old->hash != hash) {
        if (part || !regression.asked.methods.empty() || !regression.asked.full)
          throw InputError(
              fmt::format("{}: expected the whole scene to be blessed (--full --filter {}), as the scene has changed",
                          file_of(regression.baselines, scene).string(), scene));
        old->expected.clear();
      }
      changed[scene] = old.value_or(Baseline{});
      changed[scene].scene = scene, changed[scene].hash = hash;
      changed[scene].blessings.push_back(blessing);
    }
    Baseline& baseline = changed[scene];
    const std::vector<Toleranced>& now = answers.at(q.in_words());
    const std::vector<Expected> before = expected_of(baseline, q);
    std::vector<Expected> after;
    for (const Compared& row : compared(q, quantities_in(now), before)) {
      if (row.state == Standing::not_finite)
        throw InputError(fmt::format("nothing is blessed: {}: {} is not finite", q.in_words(), row.quantity));
      if (row.state != Standing::same) blessed.changed.push_back(row);
      if (row.state == Standing::gone) continue;
      const auto old = std::find_if(before.begin(), before.end(),
                                    [&](const Expected& e) { return e.what.quantity.name == row.quantity; });
      if (row.state == Standing::same) {
        after.push_back(*old);
        continue;
      }
      const auto fresh =
          std::find_if(now.begin(), now.end(), [&](const Toleranced& t) { return t.quantity.name == row.quantity; });
      after.push_back({q.method.name, q.without, q.dear, *fresh, static_cast<int>(baseline.blessings.size())});
    }
    std::erase_if(baseline.expected,
                  [&](const Expected& e) { return e.method == q.method.name && e.without == q.without; });
    baseline.expected.insert(baseline.expected.end(), after.begin(), after.end());
  }
  for (auto& [scene, baseline] : changed) {
    const bool any = std::any_of(blessed.changed.begin(), blessed.changed.end(),
                                 [&scene = scene](const Compared& row) { return row.scene == scene; });
    if (!any) continue;
    std::stable_sort(baseline.expected.begin(), baseline.expected.end(), [](const Expected& a, const Expected& b) {
      return std::tie(a.method, a.without) < std::tie(b.method, b.without);
    });
    write_file(file_of(regression.baselines, scene), text_of(baseline));
    blessed.files.push_back(file_of(regression.baselines, scene));
  }
  return blessed;
}

}  // namespace crosscheck
