#include "experiments/regress/baseline.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "experiments/table.h"
#include "mysim/errors.h"
#include "mysim/files.h"

namespace crosscheck {
namespace {

constexpr const char* header = "method,without,asked,quantity,unit,value,tolerance,blessing,derivation";

/// One line of CSV as its fields (RFC 4180; fields hold no line breaks here). Throws InputError, "expected ...".
std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields{""};
  bool quoted = false;
  for (size_t i = 0; i < line.size(); ++i) {
    if (quoted) {
      if (line[i] != '"')
        fields.back() += line[i];
      else if (i + 1 < line.size() && line[i + 1] == '"')
        fields.back() += line[i++];
      else
        quoted = false;
    } else if (line[i] == '"') {
      quoted = true;
    } else if (line[i] == ',') {
      fields.emplace_back();
    } else {
      fields.back() += line[i];
    }
  }
  if (quoted) throw InputError("expected a closing quote");
  return fields;
}

double finite_number(const std::string& text, const std::string& what) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value))
    throw InputError(fmt::format("expected a finite number for the {}, got '{}'", what, text));
  return value;
}

std::string one_line(std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  return text;
}

/// The rest of a line that begins so; throws InputError, "expected ...".
std::string after(const std::string& begin, const std::string& line) {
  if (!line.starts_with(begin)) throw InputError(fmt::format("expected a line '{}...'", begin));
  return line.substr(begin.size());
}

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
  const double blessing = finite_number(f[7], "blessing");
  if (!(blessing >= 1 && blessing <= static_cast<double>(blessings)) || blessing != std::floor(blessing))
    throw InputError(fmt::format("expected the number of a blessing from 1 to {}, got {}", blessings, f[7]));
  e.blessing = static_cast<int>(blessing);
  e.what.derivation = f[8];
  return e;
}

Blessing blessing_from(const std::string& text) {
  Blessing b;
  std::istringstream in(text);
  for (auto* field : {&b.date, &b.commit, &b.build})
    if (!std::getline(in, *field, '|')) throw InputError("expected DATE | COMMIT | BUILD | REASON");
  std::getline(in, b.reason);
  for (auto* field : {&b.date, &b.commit, &b.build, &b.reason}) {
    const size_t from = field->find_first_not_of(' '), to = field->find_last_not_of(' ');
    *field = from == std::string::npos ? "" : field->substr(from, to - from + 1);
    if (field->empty()) throw InputError("expected DATE | COMMIT | BUILD | REASON, none of them empty");
  }
  return b;
}

}  // namespace

std::filesystem::path file_of(const std::filesystem::path& folder, const std::string& scene) {
  return folder / (file_name_of(scene) + ".csv");
}

std::string text_of(const Baseline& baseline) {
  std::string out = fmt::format("# written by `crosscheck regress --bless`, never by hand\n# scene: {}\n# hash: {}\n",
                                baseline.scene, baseline.hash);
  for (size_t i = 0; i < baseline.blessings.size(); ++i) {
    const Blessing& b = baseline.blessings[i];
    out += fmt::format("# blessing {}: {} | {} | {} | {}\n", i + 1, b.date, b.commit, b.build, one_line(b.reason));
  }
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
  std::ifstream in(file);
  Baseline baseline;
  int number = 0;
  std::string line;
  const auto next = [&] {
    ++number;
    if (!std::getline(in, line)) throw InputError("expected more lines");
  };
  try {
    next();
    next();
    baseline.scene = after("# scene: ", line);
    if (baseline.scene != scene) throw InputError(fmt::format("expected the scene {}", scene));
    next();
    baseline.hash = after("# hash: ", line);
    for (next(); line.starts_with("# blessing"); next())
      baseline.blessings.push_back(
          blessing_from(after(fmt::format("# blessing {}: ", baseline.blessings.size() + 1), line)));
    const double rows = finite_number(after("# rows: ", line), "rows");
    while (line.starts_with("#")) next();
    if (line != header) throw InputError(fmt::format("expected the header {}", header));
    for (++number; std::getline(in, line); ++number)
      baseline.expected.push_back(expected_from(line, baseline.blessings.size()));
    // a file that lost its end would else pass what it no longer holds for new
    if (baseline.expected.empty() || static_cast<double>(baseline.expected.size()) != rows)
      throw InputError(fmt::format("expected {} rows, got {}", rows, baseline.expected.size()));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}:{}: {}", file.string(), number, error.what()));
  }
  return baseline;
}

}  // namespace crosscheck
