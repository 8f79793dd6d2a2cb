#include "page.h"

#include <sstream>

#include "plot.h"
#include "words.h"

namespace coursework {

std::string page(const std::string& language, const std::string& title, const std::string& total,
                 const std::vector<ShownTest>& tests, const std::string& passed, const std::string& failed) {
  std::string out =
      "<!doctype html>\n<html lang=\"" + escaped(language) + "\"><head><meta charset=\"utf-8\"><title>" +
      escaped(title) +
      "</title>\n<style>body{font:16px/1.5 sans-serif;max-width:50em;margin:2em auto;padding:0 1em}"
      "section{border-left:6px solid #c33;margin:1em 0;padding:0 1em}section.passed{border-color:#393}"
      "p{margin:.3em 0}pre{overflow-x:auto}b{font-weight:600}svg{margin-right:1em}</style></head><body>\n<h1>" +
      escaped(title) + "</h1>\n<p>" + escaped(total) + "</p>\n";
  std::string part;
  for (const ShownTest& test : tests) {
    if (test.part != part) out += "<h2>" + escaped(part = test.part) + "</h2>\n";
    out += std::string("<section") + (test.passed ? " class=\"passed\"" : "") + "><h3>" +
           (test.passed ? "&#10003; " : "&#10007; ") + escaped(test.heading) + ": " +
           escaped(test.passed ? passed : failed) + "</h3>\n";
    std::vector<std::string> lines;
    std::istringstream said(test.said);
    for (std::string line; std::getline(said, line);) lines.push_back(line);
    out += paragraphs(lines);
    for (const std::string& plot : test.plots) out += plot;
    out += "</section>\n";
  }
  return out + "</body></html>\n";
}

std::string paragraphs(const std::vector<std::string>& lines) {
  std::string out;
  bool table = false;
  for (const std::string& line : lines) {
    const bool in_table = is_of_table(line);
    if (in_table != table)
      out += in_table ? "<pre>" : "</pre>\n";
    else if (in_table)
      out += "\n";
    out += in_table ? escaped(line) : "<p>" + escaped(line) + "</p>\n";
    table = in_table;
  }
  return out + (table ? "</pre>\n" : "");
}

}  // namespace coursework
