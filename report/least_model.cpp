#include "report/least_model.h"

#include "experiments/cells.h"

namespace crosscheck {

std::vector<LeastModel> least_models_of(const Rows& rows, const std::string& scene) {
  std::vector<LeastModel> all;
  const Table* t = rows.table("adequacy-least");
  for (size_t i = 0; t && i < t->rows.size(); ++i) {
    if (text_at(*t, i, "scene") != scene) continue;
    LeastModel least{text_at(*t, i, "tolerance is"),     text_at(*t, i, "left out"), flag_at(*t, i, "holds"), 0, 0,
                     number_at(*t, i, "cost of full", 1)};
    for (const char* column : {"unseen error 1", "unseen error 2", "unseen error 3"}) {
      ++least.starts;
      least.failing += !(number_at(*t, i, column, INFINITY) <= number_at(*t, i, "tolerance", 0));
    }
    all.push_back(std::move(least));
  }
  return all;
}

std::vector<std::string> kept_without(const Rows& rows, const std::string& scene, const std::string& left_out) {
  std::vector<std::string> kept;
  const Table* t = rows.table("adequacy");
  for (size_t i = 0; t && i < t->rows.size(); ++i) {
    const std::string& one = text_at(*t, i, "left out");
    if (text_at(*t, i, "scene") == scene && text_at(*t, i, "kind") == "single" && one != "all springs" &&
        (", " + left_out + ", ").find(", " + one + ", ") == std::string::npos)
      kept.push_back(one);
  }
  return kept;
}

}  // namespace crosscheck
