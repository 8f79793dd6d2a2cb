// Trials of run verdicts (mysim/run/observers.h), not part of the suite. The trials are random, with a seed each, and
// every run continues to its end. For each family of methods, prints how many good runs were condemned and how many bad
// runs passed, with 95 % intervals (C. J. Clopper and E. S. Pearson, 1934). Runs are judged twice: in the normal way,
// and with every step observed. Writes verdict-trials.csv and verdict-trials-by-family.csv.
//
//   verdict_trials [SEEDS=4000] [FOLDER=.] [FIRST=1]
#include "tests/unit/experiments/verdict_trials.h"

#include <boost/math/distributions/binomial.hpp>

#include <cstdio>
#include <cstdlib>

using namespace crosscheck;
using namespace crosscheck::testing_tools;

namespace {

struct Count {
  long cells = 0, wrong = 0, wrong_every = 0;
};

/// The 95 % confidence interval of a rate, in %.
std::pair<double, double> interval(long wrong, long cells) {
  using Binomial = boost::math::binomial_distribution<>;
  const auto n = static_cast<double>(cells), k = static_cast<double>(wrong);
  return {100 * Binomial::find_lower_bound_on_p(n, k, 0.025), 100 * Binomial::find_upper_bound_on_p(n, k, 0.025)};
}

std::string rate(long wrong, long cells) {
  if (cells == 0) return "none";
  const auto [low, high] = interval(wrong, cells);
  return fmt::format("{} of {} ({:.2f} to {:.2f} %)", wrong, cells, low, high);
}

}  // namespace

int main(int argc, char** argv) {
  const unsigned first = argc > 3 ? std::strtoul(argv[3], nullptr, 10) : 1,
                 last = first - 1 + (argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 4000);
  Table table{"verdict-trials",
              {{"seed", "1"},
               {"family", "1"},
               {"method", "1"},
               {"scene", "1"},
               {"step", "s"},
               {"share of limit", "1"},
               {"steps", "1"},
               {"stretch over truth", "1"},
               {"speed over truth", "1"},
               {"left at step", "1"},
               {"verdict", "1"},
               {"verdict at step", "1"},
               {"verdict by every step", "1"},
               {"that at step", "1"},
               {"largest K over B", "1"},
               {"fails later", "1"},
               {"margin", "1"}},
              {}};
  std::map<std::string, std::array<Count, 2>> counts;  // by family: counts of stable and unstable runs
  std::map<std::string, std::array<long, 2>> later;    // by family: later failures, and how many had a small margin
  for (unsigned seed = first; seed <= last; ++seed) {
    std::optional<Trial> t;
    try {
      t = tried(seed);
    } catch (const std::exception& error) {
      fmt::print("seed {}: {}\n", seed, error.what());
      continue;
    }
    if (!t) continue;
    const auto brief = [](double value) { return Cell(fmt::format("{:.4g}", value)); };
    table.add({static_cast<long>(seed), t->family, t->method, t->kind, brief(t->step),
               t->share > 0 ? brief(t->share) : Cell(), t->steps, brief(t->stretch), brief(t->speed),
               t->left > 0 ? Cell(t->left) : Cell(), std::string(name_of(t->verdict)),
               t->when_verdict > 0 ? Cell(t->when_verdict) : Cell(), std::string(name_of(t->every)),
               t->when_every > 0 ? Cell(t->when_every) : Cell(), brief(t->most), static_cast<long>(t->later),
               t->share > 0 ? brief(t->margin) : Cell()});
    for (const std::string& name : {t->family, std::string("all")}) {
      Count& count = counts[name][t->within ? 0 : 1];
      ++count.cells, count.wrong += t->wrong(t->verdict), count.wrong_every += t->wrong(t->every);
      if (t->later) ++later[name][0], later[name][1] += t->margin < 0.1;
    }
    if (t->wrong(t->verdict) || t->wrong(t->every)) {
      fmt::print(
          "seed {} {} on {}: {:.4g} of the limit, {} steps, stretch {:.3g}, speed {:.3g} of truth's, left at {}; "
          "said {} at {}, by every step {} at {}, K/B {:.3g}\n",
          seed, t->method, t->kind, t->share, t->steps, t->stretch, t->speed, t->left, name_of(t->verdict),
          t->when_verdict, name_of(t->every), t->when_every, t->most);
      std::fflush(stdout);
    }
  }
  Table families{"verdict-trials-by-family",
                 {{"family", "1"},
                  {"good", "1"},
                  {"condemned", "1"},
                  {"condemned from", "%"},
                  {"condemned to", "%"},
                  {"bad", "1"},
                  {"passed", "1"},
                  {"passed from", "%"},
                  {"passed to", "%"},
                  {"fail later", "1"},
                  {"told", "1"}},
                 {}};
  for (const auto& [name, both] : counts) {
    std::vector<Cell> row{name};
    for (const Count& count : both) {
      row.insert(row.end(), {count.cells, count.wrong});
      const auto [low, high] = interval(count.wrong, std::max(1l, count.cells));
      for (const double bound : {low, high})
        row.push_back(count.cells > 0 ? Cell(fmt::format("{:.2f}", bound)) : Cell());
    }
    row.insert(row.end(), {later[name][0], later[name][1]});
    families.add(row);
    fmt::print("{:16} good condemned {:32} bad passed {:32} by every step {} and {}; fail later {}, told {}\n", name,
               rate(both[0].wrong, both[0].cells), rate(both[1].wrong, both[1].cells), both[0].wrong_every,
               both[1].wrong_every, later[name][0], later[name][1]);
  }
  const std::string folder = argc > 2 ? argv[2] : ".";
  const Provenance command{{"command", fmt::format("verdict_trials {} . {}", last - first + 1, first)}};
  write_csv(families, command, folder);
  write_csv(table, command, folder);
  const auto& all = counts["all"];
  return all[0].wrong <= 0.005 * static_cast<double>(all[0].cells) &&
                 all[1].wrong <= 0.01 * static_cast<double>(all[1].cells)
             ? 0
             : 1;
}
