// Writes points into the export of a learning-management system, whose other columns are unchanged.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mysim/base/csv.h"
#include "tests/coursework/grader/class.h"

namespace coursework {

class Gradebook {
 public:
  /// Reads an export of `layout` ("moodle", "canvas", "csv"). `column` is the name of the column to fill. If it is
  /// empty, the column is "Grade" in Moodle's worksheet, "points" or "grade" in other tables, otherwise the one whose
  /// name contains the assignment's. Throws InputError with the file if it is not comma-separated UTF-8, lacks the
  /// layout's columns, has no column to fill, or several, or states a maximum other than `points`.
  Gradebook(const std::string& layout, const std::filesystem::path& file, const std::string& column,
            const Assignment& assignment, double points);

  /// Fills the cells of graded students; other cells keep the export's content. Returns a line for each person whose
  /// submission fits no row, several rows, or the row of another submission; their cells are not filled.
  std::vector<std::string> fill(const Assignment& assignment, const std::vector<Handed>& submissions,
                                const std::vector<GradedSubmission>& graded, const Texts& common);
  /// The export with the filled cells. Everything else is unchanged, byte for byte.
  std::string text() const;

 private:
  struct Record {
    std::vector<crosscheck::CsvField> fields;
    std::string end;  // line feed, with or without carriage return
  };
  void read(const std::string& whole);
  /// The text of a field, or an empty string if the record has no such field.
  static std::string cell(const Record& record, int column);
  /// The first of the named columns, ignoring case, or -1 if there is none.
  int column_of(const std::vector<std::string_view>& names) const;
  int column_to_fill(const std::string& named, const Assignment& assignment) const;
  std::vector<std::size_t> rows_of(const Person& person, const std::string& layout) const;
  [[noreturn]] void fail(const std::string& why) const;

  std::string layout_, file_;
  bool mark_ = false;  // byte-order mark present
  std::vector<Record> records_;
  int points_ = -1;
};

}  // namespace coursework
