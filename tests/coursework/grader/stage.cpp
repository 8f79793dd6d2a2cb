// Copies in, moves out.
#include "tests/coursework/grader/stage.h"

#include <algorithm>
#include <stdexcept>

namespace coursework {
namespace fs = std::filesystem;
namespace {

/// Plain files and folders, readable for whoever gets to them.
void copy_for_others(const fs::path& from, const fs::path& to) {
  fs::copy(from, to, fs::copy_options::recursive | fs::copy_options::skip_symlinks);
  fs::permissions(to, fs::perms(0755));
  for (const auto& entry : fs::recursive_directory_iterator(to)) {
    const bool runs =
        entry.is_directory() || (fs::status(entry.path()).permissions() & fs::perms::owner_exec) != fs::perms::none;
    fs::permissions(entry.path(), fs::perms(runs ? 0755 : 0644));
  }
}

void move_entries(const fs::path& from, const fs::path& to) {
  std::vector<fs::path> entries;
  for (const auto& entry : fs::directory_iterator(from)) entries.push_back(entry.path());
  for (const fs::path& entry : entries) {
    std::error_code elsewhere;
    fs::rename(entry, to / entry.filename(), elsewhere);
    if (elsewhere)  // another file system
      fs::copy(entry, to / entry.filename(), fs::copy_options::recursive | fs::copy_options::overwrite_existing);
  }
}

}  // namespace

Stage::Stage(const Job& job, unsigned user) : job_(job), own_(0700, user) {
  for (std::size_t i = 0; i < job.readable.size(); ++i) {
    places_.emplace_back(job.readable[i], job.readable[i]);
    if (!user) continue;
    // the last name stays: compilers' messages have it
    const fs::path above = own() / std::to_string(i);
    fs::create_directory(above);
    fs::permissions(above, fs::perms(0755));
    places_.back().second = above / job.readable[i].filename();
    copy_for_others(job.readable[i], places_.back().second);
  }
  if (job.writable.empty()) return;
  places_.emplace_back(job.writable, job.writable);
  if (user) {
    places_.back().second = own() / "writable";
    fs::create_directory(places_.back().second);
    move_entries(job.writable, places_.back().second);
  }
  loan_ = std::make_unique<Loan>(places_.back().second, user);
}

const fs::path& Stage::of(const fs::path& folder) const {
  for (const auto& [named, stands] : places_)
    if (named == folder) return stands;
  throw std::logic_error(folder.string() + " is no folder of the job");
}

std::vector<std::string> Stage::command() const {
  auto longest_first = places_;
  std::sort(longest_first.begin(), longest_first.end(),
            [](const auto& a, const auto& b) { return a.first.string().size() > b.first.string().size(); });
  std::vector<std::string> words = job_.command;
  for (std::string& word : words)
    for (const auto& [named, stands] : longest_first) {
      if (named == stands) continue;
      std::size_t at = 0;
      while ((at = word.find(named.string(), at)) != std::string::npos) {
        word.replace(at, named.string().size(), stands.string());
        at += stands.string().size();
      }
    }
  return words;
}

void Stage::give_back() {
  if (!loan_) return;
  loan_.reset();
  if (of(job_.writable) != job_.writable) move_entries(of(job_.writable), job_.writable);
}

}  // namespace coursework
