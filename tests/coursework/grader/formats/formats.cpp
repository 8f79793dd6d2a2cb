// The table of formats.
#include "tests/coursework/grader/formats/formats.h"

#include <stdexcept>

#include "mysim/nearest.h"
#include "tests/coursework/grader/text_format.h"

namespace coursework {

std::span<const Format> formats() {
  static constexpr Format table[] = {
      {"text", "result.txt", text_of, "plain text for the terminal, hidden tests included"},
      {"gradescope", "results.json", gradescope, "Gradescope's results.json"},
      {"junit", "junit.xml", junit, "JUnit XML, for GitHub Classroom and continuous integration"},
      {"autolab", "autolab.txt", autolab, "feedback, and Autolab's scores on the last line"},
  };
  return table;
}

const Format& find_format(const std::string& name) {
  std::string there;
  std::vector<std::string> names;
  for (const Format& format : formats()) {
    if (format.name == name) return format;
    there += (there.empty() ? "" : ", ") + std::string(format.name);
    names.emplace_back(format.name);
  }
  throw std::invalid_argument("unknown format '" + name + "'; expected one of: " + there +
                              crosscheck::did_you_mean(name, names));
}

}  // namespace coursework
