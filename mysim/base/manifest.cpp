// The manifest of a folder of results, as JSON; and one made up for folders that version 0.1 wrote without.
#include "mysim/base/manifest.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <fstream>
#include <set>
#include <string_view>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/hash.h"
#include "mysim/base/json.h"
#include "mysim/base/pattern.h"

namespace crosscheck {
namespace fs = std::filesystem;
namespace {

constexpr int manifest_format = 1;
constexpr auto state_finished = "finished", state_begun = "being written";

}  // namespace

std::optional<std::string> whole_name(const std::string& path) {
  constexpr std::string_view ending = ".part";
  if (!path.ends_with(ending)) return std::nullopt;
  const std::string stem = path.substr(0, path.size() - ending.size());
  const size_t dot = stem.find_last_not_of("0123456789");
  if (dot == std::string::npos || dot + 1 == stem.size() || stem[dot] != '.') return std::nullopt;
  return stem.substr(0, dot);
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[64];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S UTC", &parts);
  return text;
}

Manifest Manifest::begun(std::string command) {
  Manifest manifest;
  manifest.command = std::move(command);
  manifest.process = getpid();
  manifest.since = utc_now();
  return manifest;
}

bool Manifest::names(const std::string& path) const {
  if (files.contains(path)) return true;
  const auto whole = whole_name(path);
  return whole && (*whole == file_name || files.contains(*whole));
}

bool Manifest::ours(const fs::path& folder, const std::string& path) const {
  const auto found = files.find(path);
  if (found == files.end()) return names(path);
  const fs::path file = folder / path;
  std::error_code error;
  if (!fs::is_regular_file(fs::symlink_status(file, error))) return false;
  if (found->second.hash.empty()) return true;
  return fs::file_size(file, error) == found->second.bytes && file_entry(file).hash == found->second.hash;
}

Manifest::File file_entry(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  Fnv1a sum;
  Manifest::File found;
  std::string block(1 << 16, '\0');
  while (in.read(block.data(), static_cast<std::streamsize>(block.size())) || in.gcount() > 0) {
    for (std::streamsize i = 0; i < in.gcount(); ++i)
      sum.add(static_cast<unsigned char>(block[static_cast<size_t>(i)]));
    found.bytes += static_cast<std::uintmax_t>(in.gcount());
  }
  if (!in.eof()) throw InputError(fmt::format("{}: cannot be read", file.string()));
  found.hash = fmt::format("{:016x}", sum.value());
  return found;
}

std::optional<Manifest> read_manifest(const fs::path& folder) {
  const fs::path file = folder / Manifest::file_name;
  if (!fs::exists(fs::symlink_status(file))) return std::nullopt;
  try {
    const JsonField json = JsonField::parse_file(file.string());
    if (json["format"].whole() != manifest_format) throw std::invalid_argument("another format");
    Manifest manifest;
    manifest.command = json["command"].text();
    manifest.finished = json["state"].text() == state_finished;
    manifest.process = json["process"]["id"].whole();
    manifest.since = json["process"]["since"].text();
    for (const auto& [path, about] : json["files"].items()) {
      const auto hash = about.find("hash");
      manifest.files[path] = {about["bytes"].natural(), hash ? hash->text() : ""};
    }
    return manifest;
  } catch (const std::exception&) {
    throw InputError(
        fmt::format("{}: expected what this version of crosscheck writes under that name (format {}); "
                    "give another folder",
                    file.string(), manifest_format));
  }
}

void write_manifest(const Manifest& manifest, const fs::path& folder) {
  Json files = Json::object();
  for (const auto& [path, about] : manifest.files)
    files[path] = Json{{"bytes", about.bytes}, {"hash", about.hash.empty() ? Json() : Json(about.hash)}};
  const Json json{{"format", manifest_format},
                  {"command", manifest.command},
                  {"state", manifest.finished ? state_finished : state_begun},
                  {"process", {{"id", manifest.process}, {"since", manifest.since}}},
                  {"files", std::move(files)}};
  write_file(folder / Manifest::file_name, json.dump(1) + "\n");
}

std::vector<std::string> paths_in(const fs::path& folder) {
  std::vector<std::string> paths;
  if (!fs::is_directory(folder)) return paths;
  for (fs::recursive_directory_iterator at(folder), end; at != end; ++at) {
    std::string path = at->path().lexically_relative(folder).generic_string();
    if (path == inner_work_folder) {
      at.disable_recursion_pending();
      continue;
    }
    if (path == Manifest::file_name) continue;
    if (at->is_directory() && !at->is_symlink()) {
      if (!fs::is_empty(at->path())) continue;
      path += "/";
    }
    paths.push_back(std::move(path));
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

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

/// Names in the folders of all commands.
const std::set<std::string_view> known_names{
    "trajectory.npy", "velocities.npy", "run.json",    "plan.json",    "report.json", "index.html", "figures.json",
    "CITATION.cff",   "advice.toml",    "advice.json", "regress.json", "junit.xml",   "bench.json"};

/// Names that no user gives to a file by hand; runs lie in folders by their figure, scenes by their name.
const Pattern& known_pattern() {
  static const Pattern all(
      R"((steppers/your-[^/]+|points/[0-9a-f]{16}\.(json|failed)|(data/)?certificate-[^/]+\.json|data/[^/]+-motions\.json)"
      R"(|data/runs/[^/]+/[^/]+\.json|data/scenes/[^/]+\.toml|figures/([^/]+-picture|sphere-drop-aside|stability-moment)\.png|.*\.[0-9]+\.part))");
  return all;
}

bool is_our_table(const fs::path& file) {
  if (file.extension() != ".csv") return false;
  std::ifstream in(file);
  std::string line;
  return std::getline(in, line) && line.starts_with(first_line);
}

}  // namespace

std::optional<Manifest> adopt_version_0_1(const fs::path& folder, const std::string& command, std::string& foreign) {
  const bool known = std::any_of(known_commands.begin(), known_commands.end(), [&](const KnownCommand& k) {
    return k.command == command && fs::is_regular_file(fs::symlink_status(folder / k.sign)) &&
           try_read_file(folder / k.sign).value_or("").find(k.mark) != std::string::npos;
  });
  if (!known) return std::nullopt;
  // pictures and what belongs to a figure are named by the figure's table, or by the page or list of what was made
  std::string lists;
  for (const char* list : {"index.html", "report.json", "figures.json"})
    lists += try_read_file(folder / list).value_or("");
  Manifest manifest = Manifest::begun(command);
  manifest.finished = true;
  for (const std::string& path : paths_in(folder)) {
    if (path.ends_with("/")) continue;
    const fs::path file = folder / path;
    const std::string name = file.filename().string();
    const bool ours = fs::is_regular_file(fs::symlink_status(file)) &&
                      (known_names.contains(name) || known_pattern().match(path) || is_our_table(file) ||
                       is_our_table(fs::path(file).replace_extension(".csv")) ||
                       lists.find("\"" + file.stem().string() + "\"") != std::string::npos);
    if (!ours) {
      foreign = path;
      return std::nullopt;
    }
    manifest.files[path] = file_entry(file);
  }
  return manifest;
}

}  // namespace crosscheck
