// Chooses rows, and reads drift, oscillation and growth off them.
#include "experiments/long_ledger.h"

#include <algorithm>
#include <cmath>

namespace crosscheck {

Verdict LongLedger::observe(const State& state, bool sample) {
  bool look = sample || seen_ % stride_ == 0;
  if (seen_ == next_) {
    look = true;
    next_ = std::max(next_ + 1, std::lround(static_cast<double>(next_) * 1.12));  // twenty to a decade
  }
  ++seen_;
  return ledger_.observe(state, look);
}

LongRun summary_of(const std::vector<LedgerRow>& rows) {
  LongRun run;
  if (rows.size() < 2) return run;
  const LedgerRow &start = rows.front(), &end = rows.back();
  const auto residual = [&](const LedgerRow& row) { return row.balance() - start.balance(); };
  double early = 0, twice_kinetic = 0;
  for (size_t i = 0; i < rows.size(); ++i) {
    const LedgerRow& row = rows[i];
    run.turned_over =
        std::max({run.turned_over, row.energy.kinetic, std::abs(row.energy.gravitational - start.energy.gravitational),
                  std::abs(row.energy.elastic - start.energy.elastic)});
    run.worst = std::max(run.worst, std::abs(residual(row)));
    if (row.t <= 0.1 * end.t) early = run.worst;
    if (i > 0) twice_kinetic += (row.t - rows[i - 1].t) * (row.energy.kinetic + rows[i - 1].energy.kinetic);
  }
  run.final = residual(end);
  run.growth = early > 0 ? std::log10(run.worst / early) : 0;
  run.equivalent_drag = twice_kinetic > 0 ? -run.final / twice_kinetic : 0;

  // the first states of each decade crowd at the start: each row weighs as much as the time since the one before
  double weight = 0, mean_t = 0, mean_r = 0, tt = 0, tr = 0, rr = 0;
  const auto each = [&](auto&& use) {
    for (size_t i = 1; i < rows.size(); ++i) use(rows[i].t - rows[i - 1].t, rows[i].t, residual(rows[i]));
  };
  each([&](double w, double t, double r) { weight += w, mean_t += w * t, mean_r += w * r; });
  mean_t /= weight, mean_r /= weight;
  each([&](double w, double t, double r) {
    tt += w * (t - mean_t) * (t - mean_t), tr += w * (t - mean_t) * (r - mean_r);
    rr += w * (r - mean_r) * (r - mean_r);
  });
  run.drift = tt > 0 ? tr / tt : 0;
  run.oscillation = std::sqrt(std::max(0.0, (rr - run.drift * tr) / weight));
  return run;
}

}  // namespace crosscheck
