#include "experiments/regress/baseline.h"

#include <fmt/format.h>

#include <cstdio>
#include <sstream>

#include "experiments/tables/table.h"
#include "mysim/base/csv.h"
#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/installation.h"
#include "mysim/base/names.h"

namespace crosscheck {
namespace {

constexpr const char* baseline_header = "method,without,asked,quantity,unit,value,tolerance,blessing,derivation";

BaselineRow baseline_row_from(const std::string& line, size_t blessings) {
  const std::vector<std::string> f = fields_of(line);
  if (f.size() != 9) throw InputError(fmt::format("expected 9 fields, got {}", f.size()));
  BaselineRow e;
  e.method = f[0], e.without = f[1];
  if (f[2] != "always" && f[2] != "full") throw InputError(fmt::format("expected always or full, got '{}'", f[2]));
  e.slow = f[2] == "full";
  Quantity& q = e.what.quantity;
  q.name = f[3], q.unit = f[4];
  if (q.unit == "word")
    q.word = f[5];
  else
    q.value = finite_number(f[5], "value");
  e.what.tolerance = finite_number(f[6], "tolerance");
  if (e.what.tolerance < 0) throw InputError("expected a tolerance that is not negative");
  q.count = q.unit != "word" && e.what.tolerance == 0;
  e.blessing = number_up_to(blessings, f[7], "blessing");
  e.what.derivation = f[8];
  return e;
}

}  // namespace

std::filesystem::path file_of(const std::filesystem::path& folder, const std::string& scene) {
  return path_inside(folder, file_name_of(scene) + ".csv");
}

std::string text_of(const Baseline& baseline) {
  std::string out = fmt::format("# written by `crosscheck regress --bless`, never by hand\n# scene: {}\n# hash: {}\n",
                                baseline.scene, baseline.hash);
  if (!baseline.source.empty()) out += fmt::format("# source: {}\n", baseline.source);
  for (size_t i = 0; i < baseline.blessings.size(); ++i) out += comment_line_of(baseline.blessings[i], i + 1);
  out += fmt::format("# rows: {}\n", baseline.expected.size());
  std::istringstream derivations(
      read_file(data_folder() / "experiments/regress/derivations.txt", "the explanation of derivations"));
  for (std::string line; std::getline(derivations, line);) out += fmt::format("# {}\n", line);
  out += fmt::format("{}\n", baseline_header);
  for (const BaselineRow& e : baseline.expected) {
    const Quantity& q = e.what.quantity;
    out +=
        fmt::format("{},{},{},{},{},{},{},{},{}\n", csv_field(e.method), csv_field(e.without),
                    e.slow ? "full" : "always", csv_field(q.name), q.unit, q.is_word() ? q.word : exact_text(q.value),
                    fmt::format("{:.2g}", e.what.tolerance), e.blessing, csv_field(e.what.derivation));
  }
  return out;
}

std::optional<Baseline> read_baseline(const std::filesystem::path& folder, const std::string& scene) {
  const std::filesystem::path file = file_of(folder, scene);
  if (!std::filesystem::exists(file)) return std::nullopt;
  Baseline baseline;
  read_strictly(file, [&](StrictCsvReader& lines) {
    lines.next(), lines.next();
    baseline.scene = without_prefix("# scene: ", lines.line());
    if (baseline.scene != scene) throw InputError(fmt::format("expected the scene {}", scene));
    lines.next();
    baseline.hash = without_prefix("# hash: ", lines.line());
    lines.next();
    if (lines.line().starts_with("# source: "))
      baseline.source = without_prefix("# source: ", lines.line()), lines.next();
    baseline.blessings = lines.blessings();
    lines.rows(baseline_header, [&](const std::string& row) {
      baseline.expected.push_back(baseline_row_from(row, baseline.blessings.size()));
    });
  });
  return baseline;
}

std::filesystem::path shape_file(const std::filesystem::path& folder, const std::string& scene) {
  return path_inside(folder, file_name_of(scene) + "-shape.csv");
}

std::string shape_text(const std::string& scene, const std::string& method, double t, const Points& x) {
  std::string text =
      fmt::format("# written by `crosscheck regress --bless`, for pictures: {} under {}\n# t: {}\nx [m],y [m],z [m]\n",
                  scene, method, t);
  for (int i = 0; i < x.cols(); ++i) text += fmt::format("{:.6g},{:.6g},{:.6g}\n", x(0, i), x(1, i), x(2, i));
  return text;
}

std::optional<FinalShape> read_shape(const std::filesystem::path& folder, const std::string& scene, int particles) {
  std::istringstream in(try_read_file(shape_file(folder, scene)).value_or(""));
  std::string line;
  FinalShape shape{0, Points(3, particles)};
  if (!std::getline(in, line) || !std::getline(in, line) || std::sscanf(line.c_str(), "# t: %lf", &shape.t) != 1 ||
      !std::getline(in, line))
    return std::nullopt;
  int i = 0;
  for (; std::getline(in, line); ++i)
    if (i >= particles || std::sscanf(line.c_str(), "%lf,%lf,%lf", &shape.x(0, i), &shape.x(1, i), &shape.x(2, i)) != 3)
      return std::nullopt;
  return i == particles && shape.x.allFinite() ? std::optional(shape) : std::nullopt;
}

}  // namespace crosscheck
