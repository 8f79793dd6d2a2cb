// Each line is a keyword and its values:
//   assignment NAME, title TEXT, hidden COUNT     once
//   test ID PART POINTS, read HEADING             begins a test
//   case CALL, small CALL                         begins one of its cases; in, expected: COUNT numbers
#include "cases_file.h"

#include <cstdio>
#include <cstdlib>
#include <istream>
#include <ostream>
#include <sstream>
#include <stdexcept>

namespace coursework {
namespace {

std::string text_of(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

void write_numbers(std::ostream& out, const char* word, const Numbers& numbers) {
  out << word << ' ' << numbers.size();
  for (const double value : numbers) out << ' ' << text_of(value);
  out << '\n';
}

class Line {
 public:
  Line(const std::string& text, int number) : in_(text), number_(number) { in_ >> word_; }
  const std::string& word() const { return word_; }
  std::string next() {
    std::string value;
    if (!(in_ >> value)) fail("something is missing");
    return value;
  }
  std::string rest() {
    std::string value;
    std::getline(in_ >> std::ws, value);
    return value;
  }
  double number() {
    const std::string text = next();
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (end == text.c_str() || *end != '\0') fail("'" + text + "' is no number");
    return value;
  }
  int integer() {
    const double value = number();
    if (!(value >= -1e9 && value <= 1e9) || value != static_cast<int>(value)) fail("no whole number");
    return static_cast<int>(value);
  }
  Numbers numbers() {
    const int count = integer();
    if (count < 0) fail("a negative count");
    Numbers out;
    for (int i = 0; i < count; ++i) out.push_back(number());
    return out;
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error("public cases, line " + std::to_string(number_) + ": " + what);
  }

 private:
  std::istringstream in_;
  std::string word_;
  int number_;
};

bool read_into(Case& c, Line& line) {
  const std::string& word = line.word();
  if (word == "row")
    c.row = line.rest();
  else if (word == "column")
    c.column = line.rest();
  else if (word == "columns")
    c.columns = line.integer();
  else if (word == "tolerance")
    c.tolerance = line.number();
  else if (word == "plot")
    c.plot_x = line.integer(), c.plot_y = line.integer(), c.row_size = line.number();
  else if (word == "in")
    c.in = line.numbers();
  else if (word == "expected")
    c.expected = line.numbers();
  else
    return false;
  return true;
}

}  // namespace

void write_cases(std::ostream& out, const PublicTests& all) {
  out << "assignment " << all.assignment << "\ntitle " << all.title << "\nhidden " << all.hidden << '\n';
  for (const PublicTest& test : all.tests) {
    out << "\ntest " << test.id << ' ' << test.part << ' ' << test.points << "\nread " << test.read << '\n';
    for (std::size_t i = 0; i < test.cases.size() + test.small.size(); ++i) {
      const bool small = i >= test.cases.size();
      const Case& c = small ? test.small[i - test.cases.size()] : test.cases[i];
      out << (small ? "small " : "case ") << c.call << "\nrow " << c.row << "\ncolumn " << c.column << "\ncolumns "
          << c.columns << "\ntolerance " << text_of(c.tolerance) << "\nplot " << c.plot_x << ' ' << c.plot_y << ' '
          << text_of(c.row_size) << '\n';
      write_numbers(out, "in", c.in);
      write_numbers(out, "expected", c.expected);
    }
  }
}

PublicTests read_cases(std::istream& in) {
  PublicTests all;
  std::string text;
  for (int number = 1; std::getline(in, text); ++number) {
    Line line(text, number);
    const std::string& word = line.word();
    if (word.empty() || word[0] == '#') continue;
    PublicTest* test = all.tests.empty() ? nullptr : &all.tests.back();
    if (word == "assignment") {
      all.assignment = line.next();
    } else if (word == "title") {
      all.title = line.rest();
    } else if (word == "hidden") {
      all.hidden = line.integer();
    } else if (word == "test") {
      PublicTest begun;
      begun.id = line.next(), begun.part = line.next(), begun.points = line.integer();
      all.tests.push_back(begun);
    } else if (word == "read" && test) {
      test->read = line.rest();
    } else if ((word == "case" || word == "small") && test) {
      std::vector<Case>& to = word == "case" ? test->cases : test->small;
      to.emplace_back();
      to.back().call = line.next();
    } else if (!test || test->cases.empty() ||
               !read_into(test->small.empty() ? test->cases.back() : test->small.back(), line)) {
      line.fail("'" + word + "' is not known here");
    }
  }
  if (all.tests.empty()) throw std::runtime_error("public cases: there are no tests");
  return all;
}

}  // namespace coursework
