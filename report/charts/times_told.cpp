#include "report/charts/times_told.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "report/findings_text.h"

namespace crosscheck {

std::string builds_text(const std::vector<std::string>& methods) {
  const auto there = [&](const char* engine) {
    return std::any_of(methods.begin(), methods.end(), [&](const std::string& m) { return m.starts_with(engine); });
  };
  std::vector<std::string> own, debians, parts;
  for (const auto& [begin, name] : {std::pair{"mysim/", "mysim"}, {"odeint/", "odeint"}})
    if (there(begin)) own.emplace_back(name);
  for (const auto& [begin, name] : {std::pair{"bullet/", "Bullet"}, {"sundials/", "SUNDIALS"}})
    if (there(begin)) debians.emplace_back(name);
  if (!own.empty())
    parts.push_back(fmt::format("{} {} compiled in this build", joined(own), own.size() == 1 ? "is" : "are"));
  if (!debians.empty())
    parts.push_back(debians.size() == 1 ? debians[0] + " is Debian's generic x86-64 build"
                                        : joined(debians) + " are Debian's generic x86-64 builds");
  if (there("exec:") || there("bullet32/")) parts.emplace_back("programs of their own are as they were built");
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace crosscheck
