#include "mysim/base/manifest.h"

#include <fmt/format.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <string_view>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/hash.h"
#include "mysim/base/json.h"
#include "mysim/base/names.h"

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
    const JsonField json = JsonField::parse_file(path_inside(folder, Manifest::file_name).string());
    if (json["format"].whole() != manifest_format) throw std::invalid_argument("another format");
    Manifest manifest;
    manifest.command = json["command"].text();
    manifest.finished = json["state"].text() == state_finished;
    manifest.process = json["process"]["id"].whole();
    manifest.since = json["process"]["since"].text();
    for (const auto& [path, about] : json["files"].items()) {
      if (!is_path_inside(path)) throw std::invalid_argument("a path outside");
      const auto hash = about.find("hash");
      manifest.files[path] = {about["bytes"].natural(), hash ? hash->text() : ""};
    }
    return manifest;
  } catch (const std::exception&) {
    throw InputError(
        fmt::format("{}: expected a list of results that this version of crosscheck wrote (format {}); "
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
  write_file(folder / Manifest::file_name, dump(json, 1) + "\n");
}

std::vector<std::string> paths_in(const fs::path& folder) {
  std::vector<std::string> paths;
  if (!fs::is_directory(folder)) return paths;
  for (fs::recursive_directory_iterator at(folder), end; at != end; ++at) {
    std::string path = at->path().lexically_relative(folder).generic_string();
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

}  // namespace crosscheck
