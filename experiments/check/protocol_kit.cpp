#include "experiments/check/protocol_kit.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>

#include "experiments/check/transformations.h"
#include "experiments/scenes/ingredients.h"
#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/json.h"
#include "mysim/base/process.h"
#include "reference/certificate/certificate.h"
#include "reference/method.h"
#include "reference/protocol/exec_engine.h"
#include "reference/protocol/run_json.h"
#include "reference/protocol/scene_json.h"
#include "reference/protocol/trajectory_files.h"

namespace crosscheck {

std::string_view name_of(Conformance state) {
  switch (state) {
    case Conformance::ok:
      return "ok";
    case Conformance::lacks:
      return "lacks";
    case Conformance::refuses:
      return "refuses";
  }
  return "unknown";
}

bool ConformanceReport::complete() const {
  return std::ranges::none_of(lines,
                              [](const ConformanceLine& l) { return l.required && l.state == Conformance::lacks; });
}

namespace {

namespace fs = std::filesystem;

// Together, these scenes contain every ingredient of the protocol except the wind on triangles.
constexpr const char* kit_scenes[] = {"fall", "damped-spring", "led-pin", "ball", "slope", "rod", "circle", "gusts"};

// s; a step of these scenes takes microseconds, and an interpreter starts in less than a second
constexpr double call_limit = 30;

constexpr auto called = "How it is called", answers = "What it answers", scene_file = "scene.json",
               run_file = "run.json";

struct KitCall {
  TemporaryFolder folder{"kit"};
  ProgramResult end;
  double limit = call_limit;  // s
  std::string unreadable;     // reason why the files of results cannot be read; empty if they can
  fs::path results() const { return folder.path / "out"; }
  bool refused() const { return end.signal == 0 && end.status == 3 && !end.timed_out; }
  bool good() const {
    return end.signal == 0 && end.status == 0 && !end.timed_out && !end.killed_watcher && unreadable.empty();
  }
  /// The last line of stderr, or of stdout if stderr is empty.
  std::string last_line() const {
    std::string line = last_lines(end.err.find_first_not_of(" \t\r\n") == std::string::npos ? end.out : end.err, 1);
    line.erase(std::find(line.begin(), line.end(), '\n'), line.end());
    return line;
  }
  std::string how() const {
    if (end.timed_out) return fmt::format("did not end within {:g} s", limit);
    if (!unreadable.empty()) return "delivered " + unreadable;
    if (end.signal != 0) return fmt::format("was ended by signal {}", end.signal);
    return fmt::format("ended with exit status {}", end.status);
  }
};

class Kit {
 public:
  explicit Kit(const std::string& text)
      : text_(text.starts_with(program_prefix) ? text.substr(program_prefix.size()) : text),
        program_(find_program(text_)),
        method_(exec_method(text_)) {
    report_.program = std::string(program_prefix) + text_;
  }

  ConformanceReport report() {
    for (const char* name : kit_scenes)
      if (!hangs_) try_scene(scene_in("kit", name));
    if (hangs_) {
      add("", "scenes", Conformance::lacks, true, "the other scenes are skipped, because the program does not end",
          answers);
      return std::move(report_);
    }
    if (taken_ == 0)
      add("", "scenes", Conformance::lacks, true, "no scene of the kit is supported: support at least one", answers);
    try_certificate();
    try_changed_scenes();
    return std::move(report_);
  }

 private:
  void add(const std::string& scene, const std::string& topic, Conformance state, bool required,
           const std::string& told, const char* section) {
    report_.lines.push_back({scene, topic, state, required, told, state == Conformance::lacks ? section : ""});
  }
  void add(const std::string& scene, const std::string& topic, bool ok, bool required, const std::string& told,
           const char* section) {
    add(scene, topic, ok ? Conformance::ok : Conformance::lacks, required, told, section);
  }
  /// Adds a line with the text that `work` returns. If `work` throws InputError, the line has the error message without
  /// the folder, and the function returns false.
  bool add_tried(const Scene& scene, const std::string& topic, const char* section, const KitCall& call,
                 const std::function<std::string()>& work) {
    try {
      add(scene.name, topic, true, true, work(), section);
      return true;
    } catch (const InputError& error) {
      std::string what = error.what();
      if (what.starts_with(call.results().string() + "/")) what.erase(0, call.results().string().size() + 1);
      add(scene.name, topic, false, true, what, section);
      return false;
    }
  }

  void call(KitCall& made, const Scene& scene, const std::string& scene_text) const {
    made.limit = std::min(program_.timeout, call_limit);
    write_file(made.folder.path / "scene.json", scene_text);
    fs::create_directories(made.results());
    try {
      made.end =
          run_program({program_.path.string(), (made.folder.path / "scene.json").string(), made.results().string()},
                      ".", {}, made.limit);
      require_result_files(made.results(), scene);
    } catch (const InputError& error) {
      made.unreadable = error.what();
    } catch (const CannotStart& error) {
      made.end.status = 127, made.end.err = "cannot be started: " + error.reason;
    }
  }

  void try_scene(const Scene& scene) {
    const Run run = default_run(scene);
    KitCall made;
    call(made, scene, scene_json(scene, run, program_.options));
    if (made.refused()) {
      add(scene.name, "starts and ends", Conformance::refuses, false,
          made.last_line().empty() ? "exit status 3 without a reason: write one line on stderr" : made.last_line(),
          answers);
      return;
    }
    ++taken_;
    hangs_ = made.end.timed_out;
    if (!made.good()) {
      const std::string line = made.last_line();
      add(scene.name, "starts and ends", false, true,
          fmt::format("it {}{}: exit 0 with an answer, or 3 with one line if the scene has an unsupported ingredient",
                      made.how(), line.empty() ? "" : " (" + line + ")"),
          answers);
      return;
    }
    add(scene.name, "starts and ends", true, true, fmt::format("in {:.2g} s of CPU time", made.end.cpu_seconds),
        answers);
    if (made.end.left_children)
      add(scene.name, "leaves nothing behind", false, true,
          "one of its processes was still running 0.2 s after it ended: wait for all processes that you start", called);
    if (!try_files(scene, run, made)) return;
    try_whole(scene, run, made);
  }

  /// Returns false if the program wrote no usable trajectory.
  bool try_files(const Scene& scene, const Run& run, const KitCall& made) {
    const int frames = time_grid(run).samples + 1, particles = scene.model.particles.size();
    const fs::path x = made.results() / "trajectory.npy", v = made.results() / "velocities.npy",
                   json = made.results() / "run.json";
    if (!fs::exists(x)) {
      add(scene.name, "trajectory", false, true, "trajectory.npy is missing: write it into OUTDIR", answers);
      return false;
    }
    std::vector<Points> path;
    if (!add_tried(scene, "trajectory", answers, made, [&] {
          path = read_npy(x, frames, frames, particles);
          return fmt::format("{} frames of {}", frames, particles == 1 ? "one particle" : "two particles");
        }))
      return false;
    const bool begins = add_tried(scene, "first frame", answers, made, [&] {
      read_positions(x, scene, run);
      return std::string("the scene's initial state");
    });
    if (scene.name == "fall") try_times(scene, run, path);
    std::vector<Points> speeds;
    if (scene.model.first_order())
      ;
    else if (!fs::exists(v))
      add(scene.name, "velocities", false, false, "write velocities.npy too: without it there are no energies",
          answers);
    else if (add_tried(scene, "velocities", answers, made,
                       [&] {
                         speeds = read_npy(v, frames, frames, particles);
                         return std::string("of the same shape");
                       }) &&
             scene.name == "fall")
      try_speeds(scene, run, speeds);
    if (fs::exists(json))
      try_run_json(scene, run, made, json);
    else
      add(scene.name, "run.json", false, false, "write run.json, which reports cost and read-back", run_file);
    return begins;
  }

  /// Nothing acts along x in this scene, so that every consistent rule moves the particle along x at the initial speed.
  /// Its position therefore shows the time of a frame, much more precisely than the allowed half step.
  void try_times(const Scene& scene, const Run& run, const std::vector<Points>& path) {
    const TimeGrid grid = time_grid(run);
    for (size_t i = 0; i < path.size(); ++i) {
      const double t = grid.time(static_cast<int>(i), 0),
                   told = (path[i](0, 0) - scene.start.x(0, 0)) / scene.start.v(0, 0);
      if (std::abs(told - t) <= grid.h / 2) continue;
      add(scene.name, "sample times", false, true,
          fmt::format("frame {} shows t = {:.6g} s, expected {:.6g} s: write frames at run.times", i, told, t),
          scene_file);
      return;
    }
    add(scene.name, "sample times", true, true, "at run.times", scene_file);
  }

  /// A first-order rule is off by g h / 2, and so are velocities that are half a step late or early. The tolerance is
  /// the sum of both errors and another g h / 2.
  void try_speeds(const Scene& scene, const Run& run, const std::vector<Points>& speeds) {
    const TimeGrid grid = time_grid(run);
    const Vec3 g = scene.model.find<Gravity>()->acceleration;
    for (size_t i = 0; i < speeds.size(); ++i) {
      const Vec3 right = scene.start.v.col(0) + grid.time(static_cast<int>(i), 0) * g;
      const double off = (speeds[i].col(0) - right).norm(), allowed = 1.5 * g.norm() * grid.h;
      if (off <= allowed) continue;
      add(scene.name, "speeds", false, true,
          fmt::format(
              "frame {} is off by {:.3g} m/s, but a rule explains at most {:.3g}: write velocities in m/s at run.times",
              i, off, allowed),
          answers);
      return;
    }
    add(scene.name, "speeds", true, true, "those of a fall", answers);
  }

  void try_run_json(const Scene& scene, const Run& run, const KitCall& made, const fs::path& file) {
    Outcome told;
    if (!add_tried(scene, "run.json", run_file, made, [&] {
          read_run_json(file, told, run.duration);
          return std::string("is understood");
        }))
      return;
    if (scene.name != first_json_ && !first_json_.empty()) return;
    first_json_ = scene.name;
    const JsonField json = JsonField::parse_file(file.string());
    for (const auto& [key, what] : {std::pair{"cpu_seconds", "the time of stepping alone"},
                                    {"steps", "the number of steps"},
                                    {"force_evaluations", "the number of force evaluations"}})
      add(scene.name, fmt::format("run.json: {}", key), json.find(key).has_value(), false,
          json.find(key) ? what : fmt::format("add the key: {}", what), run_file);
  }

  /// Repeats the call as other commands make it, and checks verdict, pins, ingredients and certificate.
  void try_whole(const Scene& scene, const Run& run, const KitCall& made) {
    Recorder recorder;
    const Outcome out = run_method(method_, scene, run, {&recorder});
    add(scene.name, "verdict", out.verdict == Verdict::ok, true,
        out.verdict == Verdict::ok ? "ok" : fmt::format("{}: {}", name_of(out.verdict), out.reason), answers);
    if (out.verdict != Verdict::ok) return;
    const int frames = recorder.trajectory.frames();
    Frames delivered{recorder.trajectory.x, {}};
    if (!scene.model.particles.pins.empty()) {
      const std::string misled = misled_pin(delivered, scene, run, out);
      add(scene.name, scene.model.particles.move ? "pins led" : "pins held", misled.empty(), true,
          misled.empty() ? "where they are prescribed" : misled + ": place pins at home + d(t) at the end of each step",
          scene_file);
    }
    const bool same = read_npy(made.results() / "trajectory.npy", frames, frames, scene.model.particles.size()) ==
                      recorder.trajectory.x;
    add(scene.name, "same call twice", same, false,
        same ? "the same bytes"
             : "different bytes: seed random numbers and add in a fixed order, or results cannot be blessed",
        answers);
    try_ingredients(scene, run, recorder.trajectory);
    if (!scene.model.first_order()) collect_rows(scene, out);
  }

  /// Checks that each ingredient that the program did not refuse has an effect. The inactive ingredients are the set of
  /// ingredients without which mysim's path is nearest to the program's. A set of several ingredients counts only if it
  /// halves the distance of every smaller set, because the program may differ much from mysim in other respects.
  void try_ingredients(const Scene& scene, const Run& run, const Trajectory& theirs) {
    const std::vector<Ingredient> all = ingredients_of(scene);
    const auto in = [](unsigned set, size_t i) { return (set >> i & 1) != 0; };
    // infinite if removing one ingredient of the set also removes another, because a smaller set then has the same
    // effect
    const auto distance_without = [&](unsigned set) -> double {
      Recorder recorder;
      try {
        Scene less = scene;
        for (size_t i = 0; i < all.size(); ++i) {
          const auto left = ingredients_of(less);
          const auto at = std::ranges::find(left, all[i].name, &Ingredient::name);
          if (in(set, i) && at == left.end()) return INFINITY;
          if (in(set, i)) less = without(less, *at);
        }
        if (scene.model.first_order() && set != 0)
          recorder.trajectory = {theirs.t, std::vector<Points>(theirs.x.size(), scene.start.x), {}};
        else if (find_method(scene.method).engine(less, run, recorder).verdict != Verdict::ok)
          return INFINITY;
      } catch (const std::runtime_error&) {
        return INFINITY;
      }
      return largest_rms_distance(theirs, recorder.trajectory);
    };
    const double with = distance_without(0);
    double least = with;
    unsigned missing = 0, tried = 0;
    for (int size = 1; size <= static_cast<int>(all.size()); ++size) {
      const double bound = size > 1 ? least / 2 : least;
      for (unsigned set = 1; set < 1U << all.size(); ++set)
        if (const double apart = std::popcount(set) == size ? distance_without(set) : INFINITY; apart < INFINITY) {
          tried |= set;
          if (apart < std::min(bound, least)) least = apart, missing = set;
        }
    }
    std::string names;
    for (size_t i = 0; i < all.size(); ++i)
      if (in(missing, i)) names += (names.empty() ? "" : " and ") + all[i].name;
    for (size_t i = 0; i < all.size(); ++i)
      if (in(tried, i))
        add(scene.name, fmt::format("acts: {}", all[i].name), !in(missing, i), true,
            in(missing, i) ? fmt::format("its path is {:.2g} m from mysim's without {}, {:.2g} m from mysim's with it: "
                                         "compute it, or exit 3",
                                         least, names, with)
                           : fmt::format("{:.2g} m from mysim", with),
            scene_file);
  }

  void collect_rows(const Scene& scene, const Outcome& out) {
    has_readback_ |= out.readback.has_value();
    if (!out.readback) return;
    for (const CertificateRow& row : certify(method_.name, scene, out).rows) {
      const auto [at, is_new] = rows_.try_emplace(row.quantity, scene.name, row);
      const bool worse = rank(row.parity) > rank(at->second.second.parity);
      if (worse) at->second = {scene.name, row};
    }
  }
  static int rank(Parity parity) {
    return parity == Parity::mismatch ? 3 : parity == Parity::unattested ? 2 : parity == Parity::different_law ? 1 : 0;
  }
  /// The read-back key that certifies a quantity.
  static std::string key_of(const std::string& quantity) {
    static constexpr std::pair<std::string_view, std::string_view> keys[] = {
        {"start", "start"},
        {"spring law", "probe.springs"},
        {"bending", "probe.bending"},
        {"dashpots", "probe.dashpots"},
        {"wind", "probe.wind"},
        {"motion", "later"},
        {"sleeping", "may_sleep"},
        {"contact radius", "spheres[].radius"},
        {"contact offset", "planes[].point"},
        {"normal", "planes[].normal"},
        {"friction", "spheres[].friction and planes[].friction"},
        {"restitution", "spheres[].restitution and planes[].restitution"},
        {"nothing else",
         "zeros and empty lists for ingredients that the scene does not have (gravity, drag, spheres, "
         "later, probe.dashpots, probe.wind)"}};
    for (const auto& [begin, key] : keys)
      if (quantity.starts_with(begin)) return std::string(key);
    return quantity.ends_with("stiffness") ? "links[].stiffness or probe.springs" : quantity;
  }

  void try_certificate() {
    if (taken_ == 0) return;
    if (!has_readback_) {
      add("", "certificate", false, false,
          "nothing is attested: add readback to run.json, read from the engine's own data", run_file);
      return;
    }
    for (const auto& [quantity, where] : rows_) {
      const auto& [scene, row] = where;
      const std::string topic = "certificate: " + quantity;
      if (row.parity == Parity::mismatch)
        add(scene, topic, false, true,
            fmt::format("expected {}, read back {}: another scene was built", row.requested, row.read_back), run_file);
      else if (row.parity == Parity::unattested)
        add(scene, topic, false, false, fmt::format("add to readback: {}", key_of(quantity)), run_file);
      else
        add(scene, topic, true, false, std::string(name_of(row.parity)), run_file);
    }
  }

  void try_changed_scenes() {
    if (taken_ == 0) return;
    for (const char* name : kit_scenes) {
      const Scene scene = scene_in("kit", name);
      const Run run = default_run(scene);
      const std::string text = scene_json(scene, run, program_.options);
      KitCall plain;
      call(plain, scene, text);
      if (!plain.good()) continue;
      const auto changed = [&](const std::string& from, const std::string& to) {
        const size_t at = text.find(from);
        if (at == std::string::npos) throw std::logic_error("scene.json holds no " + from);
        return text.substr(0, at) + to + text.substr(at + from.size());
      };
      KitCall term, key, option;
      call(term, scene,
           changed("\"terms\": [", "\"terms\": [{\"type\":\"a-term-of-a-later-version\",\"strength\":1.0},"));
      if (term.refused())
        add(scene.name, "unknown term", Conformance::refuses, false, term.last_line(), answers);
      else
        add(scene.name, "unknown term", false, true,
            fmt::format("an unknown term: it {}, expected exit status 3 and the reason: check the type of "
                        "every term",
                        term.how()),
            answers);
      call(key, scene, changed("\"version\": 1,", "\"version\": 1,\n \"a-key-of-a-later-version\": {\"x\":[1,2]},"));
      add(scene.name, "unknown key", key.good(), true,
          key.good() ? "is ignored" : fmt::format("it {}: ignore keys that you do not know", key.how()), scene_file);
      std::vector<std::string> options = program_.options;
      options.push_back("an-option-that-nobody-has=1");
      call(option, scene, scene_json(scene, run, options));
      const bool said =
          !option.good() && option.end.signal == 0 && !option.end.timed_out && !option.last_line().empty();
      add(scene.name, "unknown option", option.good() || said, true,
          option.good() ? "is ignored"
          : said        ? "is refused: " + option.last_line()
                        : fmt::format("it {}: ignore it, or refuse it with one line", option.how()),
          called);
      return;
    }
  }

  std::string text_;
  Program program_;
  Method method_;
  ConformanceReport report_;
  int taken_ = 0;  // scenes that the program accepted
  bool has_readback_ = false;
  bool hangs_ = false;
  std::string first_json_;  // name of the scene whose run.json is reported key by key
  std::map<std::string, std::pair<std::string, CertificateRow>> rows_;  // quantity -> scene and its worst row
};

}  // namespace

ConformanceReport try_adapter(const std::string& program) { return Kit(program).report(); }

}  // namespace crosscheck
