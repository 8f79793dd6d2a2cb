// Version 0.1 wrote no manifest: its files are known by their names, and tables by their first line.
#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string_view>

#include "mysim/output_folder.h"

namespace crosscheck {
namespace fs = std::filesystem;
namespace {

struct KnownCommand {
  std::string_view command;
  std::string_view sign;  // the file that is there whenever the command wrote anything
  std::string_view mark;  // stands in it
};

constexpr std::string_view unfinished = "the report was not finished", first_line = "# command: crosscheck";
constexpr std::array known_commands{KnownCommand{"run", "run.json", "\"force_evaluations\""},
                                    KnownCommand{"compare", "engines.csv", first_line},
                                    KnownCommand{"experiment", "plan.json", "\"experiments\""},
                                    KnownCommand{"report", "report.json", "\"findings\""},
                                    KnownCommand{"report", "report.json", unfinished},
                                    KnownCommand{"figures", "figures.json", "\"figures\""},
                                    KnownCommand{"advise", "advice.csv", first_line},
                                    KnownCommand{"regress", "regress.json", "\"without_answer\""},
                                    KnownCommand{"bench", "bench.json", "\"tables\""}};

/// In whatever folder of ours.
const std::set<std::string_view> known_names{
    "trajectory.npy", "velocities.npy", "run.json",    "plan.json",    "report.json", "index.html", "figures.json",
    "CITATION.cff",   "advice.toml",    "advice.json", "regress.json", "junit.xml",   "bench.json"};

/// Names that nobody gives to a file by hand; runs lie in folders by their figure, scenes by their name.
const std::regex& known_patterns() {
  static const std::regex all(
      R"((steppers/your-[^/]+|points/[0-9a-f]{16}\.(json|failed)|(data/)?certificate-[^/]+\.json|data/[^/]+-motions\.json)"
      R"(|data/runs/[^/]+/[^/]+\.json|data/scenes/[^/]+\.toml|figures/([^/]+-picture|sphere-drop-aside|stability-moment)\.png|.*\.[0-9]+\.part))");
  return all;
}

std::string text_in(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

bool is_our_table(const fs::path& file) {
  if (file.extension() != ".csv") return false;
  std::ifstream in(file);
  std::string line;
  return std::getline(in, line) && line.starts_with(first_line);
}

}  // namespace

std::optional<Manifest> adopted(const fs::path& folder, const std::string& command, std::string& foreign) {
  const bool known = std::any_of(known_commands.begin(), known_commands.end(), [&](const KnownCommand& k) {
    return k.command == command && fs::is_regular_file(fs::symlink_status(folder / k.sign)) &&
           text_in(folder / k.sign).find(k.mark) != std::string::npos;
  });
  if (!known) return std::nullopt;
  // pictures and what belongs to a figure are named by the figure's table, or by the page or list of what was made
  std::string told;
  for (const char* list : {"index.html", "report.json", "figures.json"}) told += text_in(folder / list);
  Manifest manifest = Manifest::begun(command);
  manifest.finished = true;
  for (const std::string& path : paths_in(folder)) {
    if (path.ends_with("/")) continue;
    const fs::path file = folder / path;
    const std::string name = file.filename().string();
    const bool ours = fs::is_regular_file(fs::symlink_status(file)) &&
                      (known_names.contains(name) || std::regex_match(path, known_patterns()) || is_our_table(file) ||
                       is_our_table(fs::path(file).replace_extension(".csv")) ||
                       told.find("\"" + file.stem().string() + "\"") != std::string::npos);
    if (!ours) {
      foreign = path;
      return std::nullopt;
    }
    manifest.files[path] = listed(file);
  }
  return manifest;
}

}  // namespace crosscheck
