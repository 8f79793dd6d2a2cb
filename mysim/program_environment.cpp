// The inherited entries, less those that name a locale or a time zone.
#include "mysim/program_environment.h"

#include <unistd.h>

#include <algorithm>
#include <string_view>

namespace crosscheck {
namespace {

std::string_view name_of_entry(std::string_view entry) { return entry.substr(0, entry.find('=')); }

bool names_a_locale(std::string_view name) { return name == "LANG" || name == "LANGUAGE" || name.starts_with("LC_"); }

}  // namespace

std::vector<std::string> program_environment(const std::vector<std::string>& extra) {
  std::vector<std::string> all = extra;
  const auto given = [&](std::string_view name) {
    return std::ranges::any_of(all, [&](const std::string& entry) { return name_of_entry(entry) == name; });
  };
  for (const char* own : {"LC_ALL=C.UTF-8", "TZ=UTC"})
    if (!given(name_of_entry(own))) all.emplace_back(own);
  for (char** entry = environ; *entry; ++entry)
    if (const std::string_view name = name_of_entry(*entry); !names_a_locale(name) && !given(name))
      all.emplace_back(*entry);
  return all;
}

}  // namespace crosscheck
