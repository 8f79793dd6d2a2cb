// Calls of advance and choose.
//   iterations.frame    n, steps, iterations, frame, mass, stiffness, rest, gravity, x (n), v (n)
//                       x, v of each particle a frame later
//   iterations.many     as iterations.frame, then the prediction of a belief, which is shown but not used
//                       the depth of the lowest particle after a frame with 1, 2, 5, 20 and all iterations
//   iterations.choose   budget, number of plans, then steps, iterations, error of each plan whose cost is the budget
//                       steps, iterations of the chosen plan. Plans that cost more or less have error 0
#include "beliefs.h"
#include "calls.h"
#include "numbers.h"

namespace coursework {
namespace {

/// A film whose errors are given as a table.
class Table : public Film {
 public:
  std::vector<Plan> plans;
  std::vector<double> errors;
  double error(Plan plan) const override {
    for (std::size_t i = 0; i < plans.size(); ++i)
      if (plans[i].steps == plan.steps && plans[i].iterations == plan.iterations) return errors[i];
    return 0;
  }
};

Line moved(const Chain& chain, const Line& line, double frame, Plan plan) {
  calling("advance");
  const Line next = advance(chain, line, frame, plan);
  if (next.x.size() != line.x.size() || next.v.size() != line.x.size())
    throw Unusable("particles", {next.x.size() != line.x.size() ? next.x.size() : next.v.size(), line.x.size()});
  return next;
}

}  // namespace

bool answer_iterations(const std::string& call, const Numbers& in, Numbers& out) {
  Reader reader(in);
  if (call == "iterations.choose") {
    const int budget = reader.integer();
    Table table;
    for (std::size_t left = reader.count(); left > 0; --left) {
      const int steps = reader.integer(), iterations = reader.integer();
      table.plans.push_back({steps, iterations});
      table.errors.push_back(reader.number());
    }
    calling("choose");
    const Plan chosen = choose(table, budget);
    out = {static_cast<double>(chosen.steps), static_cast<double>(chosen.iterations)};
    return true;
  }
  if (call != "iterations.frame" && call != "iterations.many") return false;
  const std::size_t n = reader.count();
  const int steps = reader.integer(), iterations = reader.integer();
  const double frame = reader.number(), mass = reader.number(), stiffness = reader.number(), rest = reader.number(),
               gravity = reader.number();
  const Chain chain{mass, stiffness, rest, gravity};
  Line line;
  line.x = reader.numbers(n), line.v = reader.numbers(n);
  if (call == "iterations.frame") {
    const Line next = moved(chain, line, frame, {steps, iterations});
    for (std::size_t i = 0; i < n; ++i) out.push_back(next.x[i]), out.push_back(next.v[i]);
  } else {
    for (const int few : {1, 2, 5, 20, iterations}) out.push_back(moved(chain, line, frame, {steps, few}).x.back());
  }
  return true;
}

}  // namespace coursework
