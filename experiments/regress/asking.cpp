#include "experiments/regress/asking.h"

#include <algorithm>

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

/// Its rows are the question's quantities.
Point point_of(const Asking& asking) {
  const auto& [question, name, tolerances] = asking;
  return {name, question.scene.hash + question.method.fingerprint + (tolerances ? " tolerances" : ""),
          [asking](Rows& rows) {
            std::vector<Toleranced> all;
            if (asking.with_tolerances)
              all = with_tolerances(asking.question);
            else
              for (Quantity& q : quantities_of(asking.question, answer_to(asking.question)))
                all.push_back({std::move(q), 0, ""});
            Table table = answers_table();
            for (const Toleranced& t : all)
              table.add({asking.name, t.quantity.name, t.quantity.unit, t.quantity.value, t.quantity.word,
                         static_cast<long>(t.quantity.count), t.tolerance, t.derivation});
            rows.add(table);
          },
          false};
}

std::vector<Toleranced> answer_in(const Table& table) {
  std::vector<Toleranced> all;
  for (size_t i = 0; i < table.rows.size(); ++i) {
    Toleranced t;
    t.quantity = {std::get<std::string>(table.at(i, "quantity")), std::get<std::string>(table.at(i, "unit")),
                  std::get<double>(table.at(i, "value")), std::get<std::string>(table.at(i, "word")),
                  std::get<long>(table.at(i, "count")) != 0};
    t.tolerance = std::get<double>(table.at(i, "tolerance"));
    t.derivation = std::get<std::string>(table.at(i, "derivation"));
    all.push_back(std::move(t));
  }
  return all;
}

}  // namespace

AskedAnswers ask(const std::vector<Asking>& all, const std::filesystem::path& out, int jobs, Progress& progress) {
  std::vector<Point> points;
  for (const Asking& asking : all) points.push_back(point_of(asking));
  progress.expect(static_cast<int>(points.size()));
  const Store store(store_in(out));
  store.clear();
  AskedAnswers asked;
  asked.failures = run_points(points, {jobs, {}}, store, progress);
  for (const Point& point : points) {
    const auto rows = store.find(point.hash());
    if (const Table* table = rows ? rows->table("answers") : nullptr) asked.answers[point.name] = answer_in(*table);
  }
  return asked;
}

const Toleranced* find(const std::vector<Toleranced>& all, const std::string& name) {
  const auto at = std::find_if(all.begin(), all.end(), [&](const Toleranced& t) { return t.quantity.name == name; });
  return at == all.end() ? nullptr : &*at;
}

std::vector<Quantity> quantities_in(const std::vector<Toleranced>& all) {
  std::vector<Quantity> list;
  for (const Toleranced& t : all) list.push_back(t.quantity);
  return list;
}

}  // namespace crosscheck
