// Names, depths, and what to say of each file that was asked for.
#include "tests/coursework/grader/picker.h"

#include <algorithm>
#include <cctype>

namespace coursework {
namespace {

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::string base_of(const std::string& path) { return path.substr(path.rfind('/') + 1); }

}  // namespace

bool is_cpp(const std::string& path) {
  const std::string base = lower(base_of(path));
  const std::size_t dot = base.rfind('.');
  static constexpr const char* endings[] = {"h", "hpp", "hh", "hxx", "inl", "cpp", "cc", "cxx", "c++"};
  return dot != std::string::npos &&
         std::find(std::begin(endings), std::end(endings), base.substr(dot + 1)) != std::end(endings);
}

int depth_of(const std::string& path) {
  int depth = 0;
  std::size_t begin = 0;
  for (std::size_t end; (end = path.find('/', begin)) != std::string::npos; begin = end + 1)
    depth += lower(path.substr(begin, end - begin)) != "src";
  return depth;
}

std::string Picker::match(const std::string& path) const {
  // what macOS puts beside each file when it packs
  if (path.rfind("__MACOSX/", 0) == 0) return "";
  if (wanted_.empty()) return is_cpp(path) ? path : "";
  if (depth_of(path) > 1) return "";
  const std::string base = base_of(path);
  for (const std::string& name : wanted_)
    if (lower(name) == lower(base)) return name;
  return "";
}

void Picker::take(const std::string& path, std::string content) {
  taken_ += content.size();
  found_[match(path)].push_back({path, {}, std::move(content)});
}

std::optional<Remark> Picker::too_large() const {
  if (!wanted_.empty()) return {};
  if (found_.size() > most_program_files) return Remark{"program.entries", {std::to_string(most_program_files)}};
  if (taken_ > largest_program) return Remark{"program.size", {std::to_string(largest_program >> 20)}};
  return {};
}

void Picker::into(Submission& submission) const {
  if (wanted_.empty())
    for (const auto& [path, found] : found_) {
      if (found.front().refused.empty())
        submission.files[path] = found.front().content;
      else
        submission.remarks.push_back({found.front().refused, {path}});
    }
  for (const std::string& name : wanted_) {
    const auto all = found_.find(name);
    if (all == found_.end()) {
      submission.missing[name] = {"file.missing", {name}};
      continue;
    }
    // the shallowest first, and the name as it was asked for before one that differs in case
    auto rank = [&](const Found& f) { return 2 * depth_of(f.path) + (base_of(f.path) != name); };
    std::vector<Found> found = all->second;
    std::stable_sort(found.begin(), found.end(), [&](const Found& a, const Found& b) { return rank(a) < rank(b); });
    const Found& best = found.front();
    if (found.size() > 1 && rank(found[1]) == rank(best))
      submission.missing[name] = {"file.twice", {name, best.path, found[1].path}};
    else if (!best.refused.empty())
      submission.missing[name] = {best.refused, {name}};
    else
      submission.files[name] = best.content;
    if (submission.files.count(name) && base_of(best.path) != name)
      submission.remarks.push_back({"file.case", {name, base_of(best.path)}});
  }
}

}  // namespace coursework
