#include "experiments/bench/bench.h"

#include "experiments/scenes/scenes.h"
#include "experiments/timing/machine.h"

namespace crosscheck {
namespace {

// settings of peers: tolerances, or steps in units of 2 / omega, of which the first is just below the method's limit
Peer odeint_rk4() { return {"odeint/rk4", {1.35, 1, 0.5}}; }
Peer odeint_dopri5() { return {"odeint/dopri5", {1e-4, 1e-6, 1e-7}}; }
Peer arkode() { return {"sundials/arkode+order=4", {1e-3, 1e-5, 1e-7}}; }
Peer cvode() { return {"sundials/cvode", {1e-3, 1e-4}}; }
Peer bullet_explicit() { return {"bullet/deformable-explicit", {0.95, 0.5}}; }
Peer bullet_implicit() { return {"bullet/deformable-implicit", {4, 1}}; }
Peer bullet_pbd() { return {"bullet/pbd", {1, 0.5}, true}; }
Peer bullet_pbd_on_links() { return {"bullet/pbd", {1, 0.25}}; }

/// Settings for engines with unknown properties. For fixed steps, leapfrog's limit and three successive halvings of it,
/// to measure the cost of both large and small errors; for adaptive methods, two of odeint's tolerances.
Peer chosen(const std::string& name) {
  if (find_method(name).adaptive) return {name, {1e-4, 1e-6}};
  return {name, {1, 0.5, 0.25, 0.125}};
}

std::vector<std::string> all_scenes() {
  std::vector<std::string> names;
  for (const auto name : shipped_scenes()) names.emplace_back(name);
  return names;
}

}  // namespace

BenchSuite bench_suite(bool full, const std::vector<std::string>& beside) {
  const std::vector<Peer> all{odeint_rk4(),      odeint_dopri5(),   arkode(),    cvode(),
                              bullet_explicit(), bullet_implicit(), bullet_pbd()};
  BenchSuite suite{{64, 128, 256},
                   all_scenes(),
                   {{32, all},
                    {32, {bullet_explicit()}, hanging_cloth_of_two_stiffnesses},
                    {32, {bullet_pbd_on_links()}, hanging_cloth_of_links},
                    {64, {odeint_rk4()}}},
                   {},
                   {{64}, {60, 240}, {3, 0.1}},
                   {11, 0.015},
                   {11, 0.004},
                   {},
                   // particles a side: too few for a second thread; just enough for two threads; the largest cloth that
                   // fits into the caches of two cores; and a larger one
                   {{64, 96, 256, 512}, {11, 0.06}}};
  if (full) {
    suite.cloths = {{32, all},
                    {32, {bullet_explicit()}, hanging_cloth_of_two_stiffnesses},
                    {32, {bullet_pbd_on_links()}, hanging_cloth_of_links},
                    {64, all},
                    {64, {bullet_explicit()}, hanging_cloth_of_two_stiffnesses},
                    {64, {bullet_pbd_on_links()}, hanging_cloth_of_links},
                    {128, {odeint_rk4(), {"odeint/dopri5", {1e-4}}, {"bullet/deformable-explicit", {0.95}}}}};
    suite.implicit_step = {{32, 64, 128}, {60, 240}, {5, 0.1}};
    suite.kernels = {21, 0.02};
    suite.on_scenes = {21, 0.005};
    suite.turns = {11, 0.04};
    suite.threads.turns = {21, 0.2};
  }
  suite.same_step.turns = suite.turns;
  // named engines run on two small cloths, because most of them take minutes on larger ones
  if (!beside.empty()) suite.cloths.insert(suite.cloths.begin(), {16, {}});
  for (BenchSuite::PeerCloth& cloth : suite.cloths)
    for (const std::string& name : beside)
      if (cloth.of == BenchSuite::PeerCloth::hooke && cloth.side <= 32) cloth.peers.push_back(chosen(name));
  return suite;
}

BenchResult bench(const BenchSuite& suite, const LockPatience& patience) {
  std::vector<EqualErrorOptions> cloths;
  for (const BenchSuite::PeerCloth& cloth : suite.cloths)
    cloths.push_back({std::make_shared<const Scene>(cloth.scene()), cloth.peers, suite.turns});
  // 3 units of work: the shipped scenes, and two cloths at the same step
  size_t work = 3 + suite.kernel_sides.size() + suite.threads.sides.size() +
                suite.implicit_step.sides.size() * suite.implicit_step.rates.size();
  for (const EqualErrorOptions& options : cloths) work += static_cast<size_t>(work_of(options));
  Progress progress(static_cast<int>(work));
  BenchRecord record{patience, progress};
  measure_threads(suite.threads, record);
  pin_to_one_core();
  for (const int side : suite.kernel_sides) measure_kernels(side, suite.kernels, record);
  measure_scenes(load_scenes(suite.scenes), suite.on_scenes, record);
  for (const EqualErrorOptions& options : cloths) measure_equal_error(options, record);
  measure_same_step(suite.same_step, record);
  measure_implicit_steps(suite.implicit_step, record);
  if (patience.exhausted()) record.notes.emplace_back(timed_beside_other_work);
  progress.done();
  return {std::move(record.rows), std::move(record.notes)};
}

void set_times(BenchRow& row, const std::vector<double>& peer, const std::vector<double>& mysim, double peer_factor,
               double factor) {
  const Timing theirs = timing_of(peer).times(peer_factor), own = timing_of(mysim).times(factor),
               ratio = ratio_of_rounds(peer, mysim).times(peer_factor / factor);
  row.peer_time = theirs.median, row.peer_low = theirs.low, row.peer_high = theirs.high;
  row.time = own.median, row.low = own.low, row.high = own.high;
  row.ratio = ratio.median, row.ratio_low = ratio.low, row.ratio_high = ratio.high;
}

}  // namespace crosscheck
