// The families of methods: each file beside this one makes the rows of one.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "reference/method.h"

namespace crosscheck {

/// What stands behind the pluses of a name: "sticky", "n=10".
using MethodOptions = std::vector<std::string>;

/// A name, how its method is made from the options, and the options one of which must be given: each of them is a
/// method of its own.
struct MethodRow {
  std::string name;
  std::function<Method(const MethodOptions&)> make;  // throws InputError
  MethodOptions choices = {};

  std::vector<std::string> full_names() const {
    std::vector<std::string> names;
    for (const std::string& choice : choices) names.push_back(name + "+" + choice);
    return choices.empty() ? std::vector{name} : names;
  }
};

std::vector<MethodRow> mysim_methods();
std::vector<MethodRow> bullet_methods();  // in double and in single precision
std::vector<MethodRow> integrator_methods();
std::vector<MethodRow> truth_methods();
/// An outside program: what stands behind "exec:".
Method exec_method(const std::string& text);

/// InputError: "method NAME: unknown option '+OPTION'; expected KNOWN".
[[noreturn]] void refuse_option(const std::string& method, const std::string& option, const std::string& known);

}  // namespace crosscheck
