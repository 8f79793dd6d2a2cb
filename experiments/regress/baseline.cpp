#include "experiments/regress/baseline.h"

#include <fmt/format.h>

#include <fstream>

#include "experiments/table.h"
#include "mysim/errors.h"
#include "mysim/files.h"

namespace crosscheck {
namespace {

constexpr const char* header = "method,without,asked,quantity,unit,value,tolerance,blessing,derivation";

Expected expected_from(const std::string& line, size_t blessings) {
  const std::vector<std::string> f = fields_of(line);
  if (f.size() != 9) throw InputError(fmt::format("expected 9 fields, got {}", f.size()));
  Expected e;
  e.method = f[0], e.without = f[1];
  if (f[2] != "always" && f[2] != "full") throw InputError(fmt::format("expected always or full, got '{}'", f[2]));
  e.dear = f[2] == "full";
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
  return folder / (file_name_of(scene) + ".csv");
}

std::string text_of(const Baseline& baseline) {
  std::string out = fmt::format("# written by `crosscheck regress --bless`, never by hand\n# scene: {}\n# hash: {}\n",
                                baseline.scene, baseline.hash);
  for (size_t i = 0; i < baseline.blessings.size(); ++i) out += line_of(baseline.blessings[i], i + 1);
  out += fmt::format("# rows: {}\n", baseline.expected.size());
  for (const std::string& line : words_of_derivations()) out += fmt::format("# {}\n", line);
  out += fmt::format("{}\n", header);
  for (const Expected& e : baseline.expected) {
    const Quantity& q = e.what.quantity;
    out +=
        fmt::format("{},{},{},{},{},{},{},{},{}\n", csv_field(e.method), csv_field(e.without),
                    e.dear ? "full" : "always", csv_field(q.name), q.unit, q.is_word() ? q.word : exact_text(q.value),
                    fmt::format("{:.2g}", e.what.tolerance), e.blessing, csv_field(e.what.derivation));
  }
  return out;
}

std::optional<Baseline> read_baseline(const std::filesystem::path& folder, const std::string& scene) {
  const std::filesystem::path file = file_of(folder, scene);
  if (!std::filesystem::exists(file)) return std::nullopt;
  Baseline baseline;
  read_strictly(file, [&](StrictLines& lines) {
    lines.next(), lines.next();
    baseline.scene = after("# scene: ", lines.line());
    if (baseline.scene != scene) throw InputError(fmt::format("expected the scene {}", scene));
    lines.next();
    baseline.hash = after("# hash: ", lines.line());
    lines.next();
    baseline.blessings = lines.blessings();
    lines.rows(header, [&](const std::string& row) {
      baseline.expected.push_back(expected_from(row, baseline.blessings.size()));
    });
  });
  return baseline;
}

}  // namespace crosscheck
