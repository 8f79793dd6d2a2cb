// The methods that a report may name: what each is, for who has never seen the code.
#include <fmt/format.h>

#include <string_view>
#include <utility>

#include "report/page/page.h"

namespace crosscheck {
namespace {

/// As a page writes what a terminal spells out, and without how to ask for it on a command line.
std::string readable(std::string text) {
  constexpr std::pair<std::string_view, std::string_view> table[] = {{": give --tol, not --step", ""},
                                                                     {"--step", "the scene's step"},
                                                                     {"omega", "ω"},
                                                                     {"gamma", "γ"},
                                                                     {"lambda", "λ"},
                                                                     {"^2", "²"}};
  for (const auto& [spelt, written] : table)
    for (size_t at = text.find(spelt); at != std::string::npos; at = text.find(spelt, at + written.size()))
      text.replace(at, spelt.size(), written);
  return text;
}

std::string row_of(const Method& method) {
  const Stepper* own = rule_of(method);
  return fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                     escaped(method.name),
                     prose(readable(method.stepper ? std::string(method.stepper->what) : method.what)),
                     own ? std::to_string(own->order) : "–",
                     !own                   ? "–"
                     : own->evaluations > 0 ? std::to_string(own->evaluations)
                                            : "its solver's",
                     own ? prose(readable(std::string(own->limit_formula))) : "–");
}

}  // namespace

std::string methods_html() {
  std::string out =
      "<h3 id=\"methods\">Methods</h3>\n<div class=\"scroll\"><table "
      "class=\"methods\"><thead><tr><th>method</th><th>what it is</th><th>order</th><th>force evaluations a step</th>"
      "<th>stable while (ω: fastest vibration, γ: drag, h: step)</th></tr></thead><tbody>\n";
  for (const Method& method : all_methods())
    if (!method.name.starts_with("truth/")) out += row_of(method);
  return out + "</tbody></table></div>\n";
}

}  // namespace crosscheck
