// Which runs are computed, the reference among them, and files without their numbers.
#include "report/player/computed_runs.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "mysim/base/json.h"
#include "mysim/base/text.h"
#include "reference/method.h"
#include "report/lab/live_run.h"
#include "report/player/packed_numbers.h"
#include "report/player/static_geometry.h"

namespace crosscheck {
namespace {

/// The stepper behind a method's name; null where it is none of mysim's.
const Stepper* mysim_stepper(const std::string& method) {
  return family_of(method).is_subject() ? stepper_of_rule(method.substr(method.find('/') + 1)) : nullptr;
}

PackedNumbers packed_of(const JsonField& json) {
  return {static_cast<size_t>(json["count"].natural()), static_cast<size_t>(json["lag"].natural()),
          json["order"].whole_number(0, 2), json["data"].text()};
}

/// A file of one method's runs, read back.
class Motions {
 public:
  explicit Motions(const FileOfRuns& file)
      : target_(file),
        json_(JsonField::parse(*file.json, "a file of runs")),
        name_(json_["name"].text()),
        computed_(is_computed_in_page(name_)) {
    if (!computed_) return;
    shapes_ = unpack(packed_of(json_["shapes"])), paths_ = unpack(packed_of(json_["paths"]));
    for (const JsonField& run : json_["runs"].elements()) {
      Part part;
      if (!run.is_null()) part.modes = run["modes"].natural(), part.frames = run["frames"].natural();
      require_numbers(part.modes <= shapes_.size() - modes_);
      modes_ += part.modes;
      parts_.push_back(part);
    }
    size_t shape = 0, path = 0;
    const size_t wide = modes_ == 0 ? 0 : shapes_.size() / modes_;
    for (Part& part : parts_) {
      require_numbers(part.modes == 0 || part.frames <= (paths_.size() - path) / part.modes);
      part.shapes = {shapes_.data() + shape, part.modes * wide},
      part.paths = {paths_.data() + path, part.modes * part.frames};
      shape += part.shapes.size(), path += part.paths.size();
    }
  }

  size_t size() const { return parts_.size(); }  // 0 of what is not computed
  std::string key(size_t i) const { return fmt::format("{} {}", name_, target_.own ? "own" : std::to_string(i)); }
  bool is_left_out(size_t i) const {
    const JsonField run = json_["runs"][i];
    // which steps a rule chooses by itself hangs on rounding where it may choose long ones
    constexpr double loose = 1e-3;
    const auto tolerance = run.is_null() ? std::nullopt : run.find("tolerance");
    return !run.is_null() && !run.find("failure") && !run.find("times") && !(tolerance && tolerance->number() > loose);
  }

  /// Whether every build computes a run with the same bits.
  bool is_exact(size_t i) const { return is_left_out(i) && has_same_bits_everywhere(*mysim_stepper(name_)); }
  /// The largest departure of a run, m.
  double departure(size_t i) const {
    const JsonField run = json_["runs"][i];
    const auto& [modes, frames, shapes, paths] = parts_[i];
    if (modes == 0) return 0;
    const size_t wide = shapes.size() / modes;
    const auto number = [](std::uint16_t bits) { return static_cast<double>(static_cast<std::int16_t>(bits)); };
    double largest = 0;
    std::vector<double> off(wide);
    for (size_t f = 0; f < frames; ++f) {
      std::ranges::fill(off, 0);
      for (size_t k = 0; k < modes; ++k)
        for (size_t c = 0; c < wide; ++c) off[c] += number(paths[k * frames + f]) * number(shapes[k * wide + c]);
      for (const double each : off) largest = std::max(largest, std::abs(each));
    }
    return largest * run["unit"].number() * run["path"].number();
  }
  double step(size_t i) const {
    const auto step = json_["runs"][i].find("step");
    return step ? step->number() : 0;
  }

  /// Writes the file again, without the runs that are left out and do not stay.
  void write(const std::set<std::string>& stay, const std::string& reference, double nearest) const {
    std::vector<std::uint16_t> shapes, paths;
    Json runs = Json::array();
    for (size_t i = 0; i < size(); ++i) {
      Json run = json_["runs"][i].json();
      // what is much nearer to the base than the reference is lost in how finely that is told
      if (is_left_out(i) && key(i) != reference && !stay.contains(key(i)) && departure(i) >= nearest / 3) {
        if (!run.is_null()) run.erase("unit"), run.erase("path");
        run["modes"] = 0, run["computed"] = true;
      } else {
        if (key(i) == reference) run["reference"] = true;
        shapes.insert(shapes.end(), parts_[i].shapes.begin(), parts_[i].shapes.end());
        paths.insert(paths.end(), parts_[i].paths.begin(), parts_[i].paths.end());
      }
      runs.push_back(std::move(run));
    }
    Json file = json_.json();
    file["runs"] = std::move(runs);
    file["shapes"] = packed_json(pack_small(shapes)), file["paths"] = packed_json(pack_small(paths));
    *target_.json = dump(file);
  }

 private:
  struct Part {
    size_t modes = 0, frames = 0;
    std::span<const std::uint16_t> shapes = {}, paths = {};
  };
  /// A received file may claim more modes and frames than it has numbers for.
  void require_numbers(bool has) const {
    if (!has) json_["runs"].fail("runs of no more modes and frames than there are numbers of");
  }

  FileOfRuns target_;
  JsonField json_;
  std::string name_;
  bool computed_;
  std::vector<std::uint16_t> shapes_, paths_;
  std::vector<Part> parts_;
  size_t modes_ = 0;  // of all runs
};

struct Candidate {
  std::string key;
  double departure, step;  // m, s
};

/// The run with the longest step among those about as near to the base as the nearest.
std::optional<Candidate> reference_of(const std::vector<Motions>& files) {
  std::vector<Candidate> all;
  for (const Motions& file : files)
    for (size_t i = 0; i < file.size(); ++i)
      if (file.is_exact(i)) all.push_back({file.key(i), file.departure(i), file.step(i)});
  if (all.empty()) return std::nullopt;
  const double least = std::ranges::min(all, {}, &Candidate::departure).departure;
  std::erase_if(all, [&](const Candidate& c) { return c.departure > 1.5 * least; });
  return std::ranges::max(all, {}, &Candidate::step);
}

}  // namespace

bool is_computed_in_page(const std::string& method) {
  const Stepper* rule = mysim_stepper(method);
  if (!rule) return false;
  const std::vector<std::string> words = split(method, '+');
  return std::all_of(words.begin() + 1, words.end(), [&](const std::string& word) {
    return contact_rule_of_option(word) || (word == "linear" && rule->linear);
  });
}

std::string cells_for_page(const std::string& json, bool lab) {
  const JsonField field = JsonField::parse(json, "a file of cells");
  const auto computed = field.find("lab");
  if (!computed) return json;
  Json file = field.json();
  file.erase("lab");
  if (lab) file.update(computed->json());
  return dump(file);
}

void leave_out_computed(std::span<const FileOfRuns> files, const std::set<std::string>& stay) {
  std::vector<Motions> all;
  all.reserve(files.size());
  for (const FileOfRuns& file : files) all.emplace_back(file);
  const std::optional<Candidate> reference = reference_of(all);
  if (!reference) return;
  for (const Motions& file : all)
    if (file.size() > 0) file.write(stay, reference->key, reference->departure);
}

}  // namespace crosscheck
