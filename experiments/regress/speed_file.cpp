// Comment lines with blessings and kinds of machine, then one row for each scene and method.
#include "experiments/regress/speed_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "experiments/table.h"
#include "mysim/errors.h"

namespace crosscheck {
namespace {

constexpr const char* header = "scene,hash,method,ratio,spread,machine,blessing";
constexpr const char* form_of_machine = "CPU | COMPILER AND FLAGS | YARDSTICK";

std::vector<Machine> machines_of(const std::vector<BlessedSpeed>& speeds) {
  std::vector<Machine> all;
  for (const BlessedSpeed& s : speeds)
    if (std::find(all.begin(), all.end(), s.machine) == all.end()) all.push_back(s.machine);
  return all;
}

BlessedSpeed speed_from(const std::string& line, const std::vector<Machine>& machines, size_t blessings) {
  const std::vector<std::string> f = fields_of(line);
  if (f.size() != 7) throw InputError(fmt::format("expected 7 fields, got {}", f.size()));
  BlessedSpeed s{f[0], f[1], f[2], finite_number(f[3], "ratio"), finite_number(f[4], "spread")};
  if (s.scene.empty() || s.method.empty()) throw InputError("expected a scene and a method");
  if (!(s.ratio > 0)) throw InputError("expected a ratio above zero");
  if (s.spread < 0) throw InputError("expected a spread that is not negative");
  s.machine = machines[static_cast<size_t>(number_up_to(machines.size(), f[5], "machine")) - 1];
  s.blessing = number_up_to(blessings, f[6], "blessing");
  return s;
}

}  // namespace

const BlessedSpeed* find_speed(const SpeedFile& file, const SpeedQuestion& question, const Machine& machine) {
  if (machine.cpu.empty()) return nullptr;
  for (const BlessedSpeed& s : file.speeds)
    if (s.scene == question.scene.name && s.method == question.method.name && s.machine == machine) return &s;
  return nullptr;
}

std::filesystem::path speed_file_in(const std::filesystem::path& folder) { return folder / "speed-cost.csv"; }

std::string text_of(const SpeedFile& file) {
  std::string out = "# written by `crosscheck regress --bless`, never by hand\n";
  for (size_t i = 0; i < file.blessings.size(); ++i) out += line_of(file.blessings[i], i + 1);
  const std::vector<Machine> machines = machines_of(file.speeds);
  for (size_t i = 0; i < machines.size(); ++i)
    out += fmt::format("# machine {}: {} | {} | {}\n", i + 1, machines[i].cpu, machines[i].compiler,
                       machines[i].yardstick);
  out += fmt::format("# rows: {}\n", file.speeds.size());
  out += "# ratio: CPU time of the method over that of as many steps of the plain loop on the same scene, in turns;\n";
  out +=
      "# the middle of seven measurements apart in time, each in a process of its own, laid out otherwise in memory\n";
  out += "# spread: how far the second farthest of these is from the middle, relative\n";
  out += fmt::format("{}\n", header);
  for (const BlessedSpeed& s : file.speeds)
    out += fmt::format("{},{},{},{:.5g},{:.2g},{},{}\n", csv_field(s.scene), s.hash, csv_field(s.method), s.ratio,
                       s.spread, std::find(machines.begin(), machines.end(), s.machine) - machines.begin() + 1,
                       s.blessing);
  return out;
}

std::optional<SpeedFile> read_speed_file(const std::filesystem::path& folder) {
  const std::filesystem::path name = speed_file_in(folder);
  if (!std::filesystem::exists(name)) return std::nullopt;
  SpeedFile file;
  read_strictly(name, [&file](StrictLines& lines) {
    lines.next(), lines.next();
    file.blessings = lines.blessings();
    std::vector<Machine> machines;
    for (; lines.line().starts_with("# machine"); lines.next()) {
      const auto parts =
          parts_of(after(fmt::format("# machine {}: ", machines.size() + 1), lines.line()), 3, form_of_machine);
      machines.push_back({parts[0], parts[1], parts[2]});
    }
    lines.rows(header, [&](const std::string& row) {
      file.speeds.push_back(speed_from(row, machines, file.blessings.size()));
    });
  });
  return file;
}

}  // namespace crosscheck
