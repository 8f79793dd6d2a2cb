// Collects sources, headers and scripts.
#include "tests/coursework/grader/pack.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "tests/coursework/grader/build.h"
#include "tests/coursework/grader/zip.h"

namespace coursework {
namespace fs = std::filesystem;
namespace {

using Files = std::map<std::string, std::string>;

// Runs once, as root, when the lecturer uploads the zip; the image is kept.
constexpr const char* setup = R"sh(#!/bin/sh
# Ubuntu 22.04 or later. All other libraries of the grader consist of headers, which are in headers/.
set -e
export DEBIAN_FRONTEND=noninteractive
apt-get update
apt-get install -y --no-install-recommends g++ libarchive-dev libseccomp-dev zlib1g-dev
sh /autograder/source/build.sh
)sh";

constexpr const char* build = R"sh(#!/bin/sh
# Builds the grader, and grades the starter and the solution once: what their gradings compile stays in the cache.
set -e
cd "$(dirname "$0")"
mkdir -p objects cache
export FLAGS="-std=c++20 -O1 -w -ffp-contract=off -fno-math-errno -DFMT_HEADER_ONLY -I. -isystem headers"
export FLAGS="$FLAGS -DCROSSCHECK_COURSEWORK_SOURCE=\"$PWD/tests/coursework\""
xargs -P "$(nproc)" -I SOURCE sh -c '
  object=objects/$(echo SOURCE | tr / _).o
  test -e "$object" || g++ $FLAGS -c SOURCE -o "$object"' < sources.txt
# as an archive: what nobody calls stays out, and with it what it would need
ar rc objects/all.a objects/*.o
g++ objects/tests_coursework_grader_main.cpp.o objects/all.a -larchive -lseccomp -lz -lpthread -o crosscheck-grade
rm -r objects
chmod 0700 .
export CROSSCHECK_CACHE="$PWD/cache" CROSSCHECK_COURSEWORK="$PWD/tests/coursework"
for folder in starter solution; do
  ./crosscheck-grade grade {0} "$CROSSCHECK_COURSEWORK/{0}/$folder" --seed 1 --no-sandbox --lane bare | tail -n 1
done
)sh";

constexpr const char* run = R"sh(#!/bin/sh
# Gradescope starts this for every submission.
root=${AUTOGRADER_ROOT:-/autograder}
chmod 0700 "$root/source" "$root/results"
export CROSSCHECK_CACHE="$root/source/cache" CROSSCHECK_COURSEWORK="$root/source/tests/coursework"
exec "$root/source/crosscheck-grade" grade {0} "$root/submission" --secret "$root/source/secret.txt" \
  --format gradescope --out "$root/results/results.json"
)sh";

std::string filled(std::string script, std::string_view name) {
  for (size_t at; (at = script.find("{0}")) != std::string::npos;) script.replace(at, 3, name);
  return script;
}

void add_folder(Files& files, const fs::path& from, const std::string& to) {
  for (const auto& entry : fs::recursive_directory_iterator(from))
    if (entry.is_regular_file())
      files[to + "/" + fs::relative(entry.path(), from).generic_string()] = content_of_file(entry.path());
}

/// Libraries that consist of headers, as far as they are used: the folder of headers, and one by which it is known.
void add_headers(Files& files) {
  constexpr std::pair<const char*, const char*> libraries[] = {
      {"Eigen", "Core"}, {"fmt", "core.h"}, {"nlohmann", "json.hpp"}, {"CLI", "CLI.hpp"}, {"toml++", "toml.h"}};
  for (const auto& [folder, header] : libraries) {
    fs::path found;
    for (const char* place : {"/usr/include", "/usr/include/eigen3", "/usr/local/include", "/usr/local/include/eigen3"})
      if (found.empty() && fs::exists(fs::path(place) / folder / header)) found = fs::path(place) / folder;
    if (found.empty()) throw std::runtime_error(fmt::format("{}/{} is not found in /usr/include", folder, header));
    add_folder(files, found, std::string("headers/") + folder);
  }
}

std::string identifier_of(std::string_view assignment) {
  std::string name(assignment);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;  // that of its function begins with it
}

/// The table with one row: no source of another assignment goes with this one.
std::string table_of_one(const std::string& table, const Assignment& only) {
  std::string out;
  size_t begin = 0;
  for (size_t end; (end = table.find('\n', begin)) != std::string::npos; begin = end + 1) {
    const std::string line = table.substr(begin, end - begin);
    bool others = false;
    for (const Assignment& other : assignments())
      others |= other.name != only.name && line.find(" " + identifier_of(other.name)) != std::string::npos;
    if (!others) out += line + "\n";
  }
  return out;
}

}  // namespace

void write_package(const Assignment& assignment, const std::string& secret, const fs::path& zip) {
  const fs::path coursework = folder_of_coursework(), root = coursework.parent_path().parent_path();
  const std::string name(assignment.name), ours = "tests/coursework/" + name,
                                           table = "tests/coursework/grader/assignments.cpp";
  std::vector<std::string> first = {"tests/coursework/grader/main.cpp", table};
  for (const auto& entry : fs::directory_iterator(assignment.folder())) {
    const std::string file = entry.path().filename().string();
    if (file.starts_with("tests") && file.ends_with(".cpp")) first.push_back(ours + "/" + file);
  }
  Files files;
  std::string sources;
  for (const std::string& file : sources_needed(root, first)) {
    files[file] = file == table ? table_of_one(content_of_file(root / file), assignment) : content_of_file(root / file);
    if (file.ends_with(".cpp")) sources += file + "\n";
  }
  add_folder(files, coursework / "check", "tests/coursework/check");
  add_folder(files, assignment.folder(), ours);
  add_headers(files);
  files["sources.txt"] = sources;
  files["secret.txt"] = secret + "\n";
  files["setup.sh"] = setup;
  files["build.sh"] = filled(build, name);
  files["run_autograder"] = filled(run, name);
  write_zip(zip, files);
}

}  // namespace coursework
