// Glue between questions, the file and the verdict.
#include "experiments/regress/speed_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <thread>

#include "mysim/errors.h"
#include "mysim/files.h"

namespace crosscheck {
namespace {

Table ratios_table() { return {"ratios", {{"question", "1"}, {"is", "1"}, {"was", "1"}}, {}}; }

Point point_of(const std::vector<SpeedQuestion>& questions, const SpeedPlan& plan, int count) {
  return {fmt::format("speed, measurement {}", count), "",
          [&questions, plan, count](Rows& rows) {
            const std::vector<Ratios> all = measured_ratios(questions, plan, count);
            Table table = ratios_table();
            for (size_t i = 0; i < all.size(); ++i)
              for (size_t k = 0; k < all[i].is.size(); ++k) {
                std::optional<double> was;
                if (!all[i].was.empty()) was = all[i].was[k];
                table.add({static_cast<long>(i), all[i].is[k], cell_of(was)});
              }
            rows.add(table);
          },
          true};
}

/// Why there is no speed where none is asked for, in words.
std::string nothing_asked(const SpeedRun& run) {
  std::string outside;
  std::vector<Method> methods = run.asked.methods;
  if (run.against) methods.push_back(*run.against);
  for (const Method& method : methods)
    if (!method.name.starts_with("mysim/") && !method.name.starts_with("bullet/")) outside = method.name;
  return outside.empty()
             ? "no speed: none is asked of what the filter leaves"
             : fmt::format("no speed: {} is no method inside this program, and has a clock of its own", outside);
}

void tell_what_is_not_compared(Speeds& speeds) {
  std::vector<std::pair<std::string, int>> reasons;
  for (const SpeedCompared& row : speeds.rows) {
    if (row.state != Pace::fresh && row.state != Pace::elsewhere) continue;
    const std::string why = row.state == Pace::fresh ? "new (not blessed yet)" : row.note;
    const auto known = std::find_if(reasons.begin(), reasons.end(), [&](const auto& r) { return r.first == why; });
    if (known == reasons.end())
      reasons.emplace_back(why, 1);
    else
      ++known->second;
  }
  for (const auto& [why, count] : reasons)
    speeds.notes.push_back(fmt::format("{} of {} speeds not compared: {}", count, speeds.rows.size(), why));
}

}  // namespace

bool Speeds::passed() const {
  return failures.empty() &&
         std::none_of(rows.begin(), rows.end(), [](const SpeedCompared& row) { return failed(row.state); });
}

std::vector<Ratios> SpeedMeter::operator()(const std::vector<SpeedQuestion>& questions, const SpeedPlan& plan) {
  std::this_thread::sleep_until(begun_ + std::chrono::seconds(1));
  begun_ = std::chrono::steady_clock::now();
  const Store store(out_ / "speed-points");
  store.clear();
  const Point point = point_of(questions, plan, ++count_);
  progress_.expect(1);
  for (const FailedPoint& f : run_points({&point, 1}, {}, store, progress_)) throw std::runtime_error(f.why);
  const auto rows = store.find(point.hash());
  const Table* table = rows ? rows->table("ratios") : nullptr;
  if (!table) throw std::runtime_error("what was measured is gone");
  std::vector<Ratios> all(questions.size());
  for (size_t i = 0; i < table->rows.size(); ++i) {
    Ratios& one = all.at(static_cast<size_t>(std::get<long>(table->at(i, "question"))));
    one.is.push_back(std::get<double>(table->at(i, "is")));
    if (const auto* was = std::get_if<double>(&table->at(i, "was"))) one.was.push_back(*was);
  }
  return all;
}

Speeds compared_speeds(const std::vector<SpeedQuestion>& questions, const SpeedFile* blessed, const Machine& machine,
                       const Measure& measure) {
  Speeds speeds;
  speeds.rows = first_look(questions, blessed, machine, measure);
  confirm(speeds.rows, questions, measure);
  tell_what_is_not_compared(speeds);
  return speeds;
}

Speeds compared_speeds(const SpeedRun& run, Progress& progress) {
  Speeds speeds;
  std::optional<SpeedFile> file;
  try {
    if (!run.against) file = read_speed_file(run.baselines);
  } catch (const InputError& error) {
    speeds.failures.push_back({"blessed speeds", error.what()});
    return speeds;
  }
  const std::vector<SpeedQuestion> questions = speed_questions(run.asked, run.against);
  if (questions.empty()) {
    speeds.notes.push_back(nothing_asked(run));
    return speeds;
  }
  try {
    speeds = compared_speeds(questions, file ? &*file : nullptr, run.machine, SpeedMeter(run.out, progress));
  } catch (const std::runtime_error& error) {
    speeds.failures.push_back({"speed", error.what()});
  }
  if (!run.against && !file)
    speeds.notes = {fmt::format("speeds not compared: {}: no such file", speed_file_in(run.baselines).string())};
  return speeds;
}

std::vector<BlessedSpeed> put_into(SpeedFile& file, const std::vector<BlessedSpeed>& speeds, const Blessing& blessing) {
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

std::vector<BlessedSpeed> bless_speeds(const SpeedRun& run, const Blessing& blessing, Progress& progress) {
  SpeedFile file = read_speed_file(run.baselines).value_or(SpeedFile{});
  const std::vector<SpeedQuestion> questions = speed_questions(run.asked, {});
  if (questions.empty()) return {};
  const std::vector<BlessedSpeed> written =
      put_into(file, speeds_to_bless(questions, run.machine, SpeedMeter(run.out, progress)), blessing);
  if (!written.empty()) write_file(speed_file_in(run.baselines), text_of(file));
  return written;
}

}  // namespace crosscheck
