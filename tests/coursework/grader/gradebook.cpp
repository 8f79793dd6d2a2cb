// Exports of Moodle (mod/assign/gradingtable.php, grade/export/txt), of Canvas (lib/gradebook_exporter.rb), and other
// tables. Finds their columns, and the student of each row.
#include "tests/coursework/grader/gradebook.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/text.h"
#include "tests/coursework/check/plot.h"
#include "tests/coursework/grader/formats.h"

namespace coursework {
namespace {

using Names = std::vector<std::string_view>;

constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
// Columns that identify a row's student, in lower case.
const Names id_columns = {"id",          "id number",    "student id",    "student number",
                          "sis user id", "sis login id", "email address", "email",
                          "username",    "login",        "学号"};
const Names name_columns = {"full name", "student", "name", "姓名"}, last_names = {"last name", "lastname", "surname"};

/// Lower case, without leading and trailing blanks.
std::string folded(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t"), end = text.find_last_not_of(" \t");
  return begin == std::string::npos ? "" : lower(text.substr(begin, end - begin + 1));
}

/// Letters and digits only, in lower case, because "Lovelace, Ada" in an export is "lovelaceada" in Canvas's file
/// names, and Moodle drops apostrophes.
std::string letters_of(const std::string& text) {
  std::string out;
  for (const char c : lower(text))
    if (static_cast<unsigned char>(c) >= 0x80 || std::isalnum(static_cast<unsigned char>(c))) out += c;
  return out;
}

/// The name and the words between its separators: "20231234_王小明".
std::set<std::string> parts_of(const std::string& name) {
  std::set<std::string> words{folded(name)};
  std::string word;
  for (const char c : folded(name) + " ")
    if (std::string_view("_- ()[]+,").find(c) == std::string_view::npos)
      word += c;
    else
      words.insert(std::exchange(word, ""));
  return words;
}

}  // namespace

void Gradebook::fail(const std::string& why) const {
  throw crosscheck::InputError(fmt::format("--roster {}: {}", file_, why));
}

Gradebook::Gradebook(const std::string& layout, const std::filesystem::path& file, const std::string& column,
                     const Assignment& assignment, double points)
    : layout_(layout), file_(file.string()) {
  read(crosscheck::read_file(file, "an exported gradebook (CSV)"));
  const auto require = [&](const Names& one_of, const char* expected) {
    if (column_of(one_of) < 0)
      fail(fmt::format("expected the columns of {}; the first is '{}'", expected,
                       printable(cell(records_[0], 0)).substr(0, 60)));
  };
  if (layout == "moodle")
    require(
        {"identifier", "email address", "first name"},
        "Moodle's grading worksheet (Identifier, Grade) or gradebook export (First name, Email address) in English");
  else if (layout == "canvas")
    require({"section"}, "Canvas's gradebook export (Student, ID, Section)");
  else if (column_of(id_columns) < 0 && column_of(last_names) < 0)
    require(name_columns, "a table of students (id, name or email)");
  points_ = column_to_fill(column, assignment);
  // Moodle's worksheet has the maximum in each row, Canvas's gradebook has it in a separate row
  const int most = layout == "moodle" ? column_of({"maximum grade"}) : points_;
  for (const Record& record : std::span(records_).subspan(1)) {
    std::string text = layout == "moodle" || cell(record, 0).ends_with("Points Possible") ? cell(record, most) : "";
    std::replace(text.begin(), text.end(), ',', '.');
    char* end = nullptr;
    const double stated = std::strtod(text.c_str(), &end);
    if (end != text.c_str() && std::abs(stated - points) > 1e-6)
      fail(
          fmt::format("the maximum of '{}' is {}, and the assignment has {} points; change it there, or the points by "
                      "--rubric",
                      printable(cell(records_[0], points_)), points_text(stated), points_text(points)));
  }
}

void Gradebook::read(const std::string& whole) {
  if (whole.empty()) fail("it is empty");
  if (!is_utf8(whole)) fail("expected UTF-8; save it as \"CSV UTF-8\"");
  mark_ = whole.starts_with(byte_order_mark);
  for (std::size_t at = mark_ ? byte_order_mark.size() : 0; at < whole.size();) {
    auto fields = crosscheck::csv_record(whole, at);
    if (!fields) fail(fmt::format("record {}: a quote is not closed", records_.size() + 1));
    std::string end = at < whole.size() ? "\n" : "";
    at += end.size();
    if (std::string& last = fields->back().text; last.ends_with('\r')) last.pop_back(), end = "\r" + end;
    records_.push_back({std::move(*fields), end});
  }
  if (records_.empty() || text() != whole) fail("not valid CSV (RFC 4180): expected quotes around whole fields only");
  if (records_[0].fields.size() == 1 && cell(records_[0], 0).find_first_of(";\t") != std::string::npos)
    fail("expected commas between the columns; choose the comma as separator when you export it");
}

std::string Gradebook::cell(const Record& record, int column) {
  return column >= 0 && column < std::ssize(record.fields) ? record.fields[static_cast<std::size_t>(column)].text : "";
}

int Gradebook::column_of(const Names& names) const {
  for (const std::string_view name : names)
    for (int i = 0; i < std::ssize(records_[0].fields); ++i)
      if (folded(cell(records_[0], i)) == name) return i;
  return -1;
}

int Gradebook::column_to_fill(const std::string& named, const Assignment& assignment) const {
  int column = column_of({folded(named)});
  std::vector<std::string> all, found;
  for (const auto& field : records_[0].fields) {
    all.push_back(printable(field.text));
    if (letters_of(field.text).find(letters_of(std::string(assignment.name))) != std::string::npos &&
        !folded(field.text).ends_with("(feedback)"))
      found.push_back(all.back()), column = named.empty() ? static_cast<int>(all.size()) - 1 : column;
  }
  if (!named.empty() && column < 0) fail(fmt::format("no column '{}'{}", named, crosscheck::did_you_mean(named, all)));
  if (!named.empty()) return column;
  if (const int usual = column_of(layout_ == "csv" ? Names{"points", "grade"} : Names{"grade"});
      usual >= 0 && (layout_ == "csv" || column_of({"identifier"}) >= 0))
    return usual;
  if (found.size() != 1)
    fail(fmt::format("expected one column named after {}, found {}; choose with --column NAME", assignment.name,
                     found.empty() ? "none" : fmt::format("'{}'", fmt::join(found, "', '"))));
  return column;
}

std::vector<std::size_t> Gradebook::rows_of(const Person& person, const std::string& layout) const {
  // Moodle's participant numbers and Canvas's ids are meaningless in other tables
  const Names ids = layout == "Moodle" ? Names{"identifier"} : layout == "Canvas" ? Names{"id"} : id_columns;
  std::set<std::string> words = layout.empty() ? parts_of(person.name) : std::set<std::string>{folded(person.id)};
  std::set<std::string> names{letters_of(person.name)};
  if (layout.empty())
    for (const std::string& word : words) names.insert(letters_of(word));
  words.erase(""), names.erase("");
  std::vector<std::size_t> by_id, by_name;
  for (std::size_t i = 1; i < records_.size(); ++i) {
    const auto has = [&](const Names& columns, auto fits) {
      return std::ranges::any_of(columns, [&](auto name) { return fits(cell(records_[i], column_of({name}))); });
    };
    const std::string first = cell(records_[i], column_of({"first name", "firstname"}));
    if (has(ids, [&](std::string id) {
          id = folded(layout == "Moodle" ? id.substr(id.find_last_not_of("0123456789") + 1) : id);  // "Participant 123"
          return words.contains(id) || words.contains(id.substr(0, id.find('@')));
        }))
      by_id.push_back(i);
    if (has(name_columns, [&](const std::string& name) { return names.contains(letters_of(name)); }) ||
        has(last_names, [&](const std::string& last) {
          return !last.empty() &&
                 (names.contains(letters_of(last + first)) || names.contains(letters_of(first + last)));
        }))
      by_name.push_back(i);
  }
  // the id distinguishes people of the same name; if id and name belong to different people, returns both, so that
  // nothing is filled in
  if (std::ranges::find_first_of(by_id, by_name) == by_id.end())
    by_id.insert(by_id.end(), by_name.begin(), by_name.end());
  return by_id;
}

std::vector<std::string> Gradebook::fill(const Assignment& assignment, const std::vector<Handed>& submissions,
                                         const std::vector<GradedSubmission>& graded, const Texts& common) {
  std::vector<std::string> unmatched;
  std::map<std::size_t, std::vector<std::size_t>> claims;  // submissions by row
  for (std::size_t i = 0; i < submissions.size(); ++i)
    for (const Person& person : submissions[i].people) {
      const std::vector<std::size_t> rows = rows_of(person, submissions[i].layout);
      if (rows.size() == 1) {
        claims[rows[0]].push_back(i);
        continue;
      }
      const bool group = submissions[i].people.size() > 1;
      unmatched.push_back(fmt::format(
          "{}{}: {} of {}", submissions[i].name, group ? ": " + person.name : "",
          rows.empty() ? "fits no row" : fmt::format("fits several rows ({})", fmt::join(rows, ", ")), file_));
    }
  for (const auto& [row, who] : claims) {
    if (who.size() > 1) {
      for (const std::size_t i : who)
        unmatched.push_back(fmt::format("{}: fits row {} of {}, as another one does", submissions[i].name, row, file_));
      continue;
    }
    const GradedSubmission& one = graded[who[0]];
    const auto set = [&fields = records_[row].fields](int column, const std::string& text) {
      if (column < 0 || text.empty()) return;
      fields.resize(std::max(fields.size(), static_cast<std::size_t>(column) + 1));
      crosscheck::CsvField& field = fields[static_cast<std::size_t>(column)];
      field.text = defused(text);
      field.quoted |= field.text != text || crosscheck::csv_field(text) != text;
    };
    set(points_, points_in(one));
    if (layout_ == "csv") {
      set(column_of({"late"}), one.late ? "late" : "");
      set(column_of({"remark"}), remark_of(one));
    } else if (layout_ == "moodle") {
      std::string told = printable(total_of(one.result, common));
      for (const Part& part : assignment.parts)
        if (const std::string points = points_in(one, part.name); !points.empty())
          told += fmt::format("; {}: {}", part.name, points);
      set(column_of({"feedback comments"}), escaped(told));
    }
  }
  return unmatched;
}

std::string Gradebook::text() const {
  std::string out(mark_ ? byte_order_mark : "");
  for (const Record& record : records_) {
    for (std::size_t i = 0; i < record.fields.size(); ++i)
      out += (i > 0 ? "," : "") +
             (record.fields[i].quoted ? crosscheck::csv_quoted(record.fields[i].text) : record.fields[i].text);
    out += record.end;
  }
  return out;
}

}  // namespace coursework
