// The methods that a report may name: what each is, for who has never seen the code.
#include <fmt/format.h>

#include "report/page/page.h"

namespace crosscheck {
namespace {

/// What it is, without how to ask for it on a command line.
std::string about(std::string what) {
  const std::string asking = ": give --tol, not --step";
  if (const size_t at = what.find(asking); at != std::string::npos) what.erase(at, asking.size());
  return what;
}

std::string row_of(const Method& method) {
  const Stepper* own = method.stepper;
  return fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                     escaped(method.name), prose(about(method.what)), own ? std::to_string(own->order) : "–",
                     !own                   ? "–"
                     : own->evaluations > 0 ? std::to_string(own->evaluations)
                                            : "its solver's",
                     own ? prose(std::string(own->limit_formula)) : "–");
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
