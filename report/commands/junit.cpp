// Writes JUnit XML.
#include "report/commands/junit.h"

#include <fmt/format.h>

#include "report/page/page.h"

namespace crosscheck {

void JUnitReport::add(const std::string& class_name, const std::string& name, const std::string& outcome,
                      const std::string& message, const std::string& text) {
  ++cases_;
  body_ += fmt::format("  <testcase classname=\"{}\" name=\"{}\"", escaped(class_name), escaped(name));
  if (outcome.empty()) {
    body_ += "/>\n";
    return;
  }
  ++count_.at(outcome);
  body_ += fmt::format("><{} message=\"{}\"{}</testcase>\n", outcome, escaped(message),
                       text.empty() ? "/>" : fmt::format(">{}</{}>", escaped(text), outcome));
}

std::string JUnitReport::xml() const {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n<testsuite name=\"{}\" tests=\"{}\" "
      "failures=\"{}\" errors=\"{}\" skipped=\"{}\">\n{}</testsuite>\n</testsuites>\n",
      suite_, cases_, count_.at("failure"), count_.at("error"), count_.at("skipped"), body_);
}

}  // namespace crosscheck
