// Helpers shared by the grader's own tests.
#pragma once

#include <algorithm>
#include <cctype>
#include <map>
#include <string>
#include <string_view>

#include "tests/coursework/grader/build.h"
#include "tests/coursework/grader/grade.h"

namespace coursework {

inline Texts common_texts(const std::string& language = "en") {
  return Texts::read((folder_of_coursework() / "check" / ("common." + language + ".txt")).string());
}

/// The text with _ in place of all characters that are not letters or digits.
inline std::string name_of_test(std::string_view text) {
  std::string name(text);
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
}

inline GradeOptions options_for(const Assignment& assignment, std::uint64_t seed) {
  GradeOptions options;
  options.seed = seed;
  options.jobs = 2;
  options.common = common_texts();
  options.own = Texts::read((assignment.folder() / "texts.en.txt").string());
  return options;
}

/// The solution with these files replaced. An empty content removes a file.
inline Submission submission_of(const Assignment& assignment, const std::map<std::string, std::string>& changed = {}) {
  Submission submission;
  submission.name = "somebody";
  for (const std::string& file : wanted_files(assignment)) {
    const auto mine = changed.find(file);
    if (mine == changed.end())
      submission.files[file] = content_of_file(assignment.folder() / "solution" / file);
    else if (!mine->second.empty())
      submission.files[file] = mine->second;
    else
      submission.missing[file] = {"file.missing", {file}};
  }
  return submission;
}

}  // namespace coursework
