// The table of methods, and how a name with options is read.
#include "reference/method.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mysim/base/errors.h"
#include "mysim/base/text.h"
#include "mysim/run/observers.h"

namespace crosscheck {
namespace {

/// The table: one family after the other.
std::vector<MethodRow> table() {
  std::vector<MethodRow> rows;
  for (const auto family : {mysim_methods, bullet_methods, integrator_methods, truth_methods})
    for (MethodRow& row : family()) rows.push_back(std::move(row));
  return rows;
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  size_t begin = 0;
  for (size_t end; (end = text.find(at, begin)) != std::string::npos; begin = end + 1)
    parts.push_back(text.substr(begin, end - begin));
  parts.push_back(text.substr(begin));
  return parts;
}

}  // namespace

void refuse_option(const std::string& method, const std::string& option, const std::string& known) {
  std::vector<std::string> options;  // of the sentence, all words behind a plus
  for (size_t at = known.find('+'); at != std::string::npos; at = known.find('+', at + 1))
    options.push_back(known.substr(at + 1, known.find_first_of(" ,;", at) - at - 1));
  throw InputError(fmt::format("method {}: unknown option '+{}'; expected {}{}", method, option, known,
                               did_you_mean(option, options)));
}

std::vector<Method> all_methods() {
  std::vector<Method> methods;
  for (const MethodRow& row : table())
    for (const std::string& name : row.full_names()) methods.push_back(find_method(name));
  return methods;
}

Method find_method(const std::string& text) {
  if (text.starts_with("exec:")) return exec_method(text.substr(5));
  const std::vector<std::string> parts = split(text, '+');
  const std::string name = parts[0].find('/') == std::string::npos ? "mysim/" + parts[0] : parts[0];
  std::vector<std::string> known;
  for (const MethodRow& row : table()) {
    if (row.name == name) {
      Method method = row.make({parts.begin() + 1, parts.end()});
      for (size_t i = 1; i < parts.size(); ++i) method.name += "+" + parts[i];
      return method;
    }
    for (const std::string& full : row.full_names()) known.push_back(full);
  }
  // "leapfrg" is nearer to the short name
  std::vector<std::string> names = known;
  if (parts[0].find('/') == std::string::npos)
    for (std::string& full : names)
      if (full.starts_with("mysim/")) full = full.substr(6);
  throw InputError(fmt::format("unknown method '{}'; expected one of: {}, exec:PATH{}", text, fmt::join(known, ", "),
                               did_you_mean(parts[0], names)));
}

const Stepper* stepper_of(const Method& method) {
  if (method.stepper) return method.stepper;
  const std::string name = method.rule == "implicit-euler+linear" ? "implicit-euler" : method.rule;
  for (const Stepper& rule : steppers())
    if (rule.name == name) return &rule;
  return nullptr;
}

std::vector<Method> find_methods(const std::string& list) {
  std::vector<Method> methods;
  for (const std::string& name : split(list, ',')) methods.push_back(find_method(name));
  return methods;
}

/// Of mysim: simulate(), mysim/run/engine.cpp.
Outcome run_method(const Method& method, const Scene& scene, const Run& run, std::vector<Observer*> observers,
                   const MotionBoundsFunction& bounds) {
  DivergenceMonitor monitor(scene, run, bounds);
  MonitoredObservers all(monitor, std::move(observers));
  try {
    return method.engine(scene, run, all);
  } catch (const Unsupported& refusal) {
    Outcome out;
    out.verdict = Verdict::unsupported;
    out.reason = refusal.what();
    return out;
  }
}

}  // namespace crosscheck
