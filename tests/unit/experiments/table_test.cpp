// Tables and files: CSV quoting, numbers that survive a round trip bit for bit, and atomic writes.

#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

#include "experiments/tables/certificates.h"
#include "experiments/tables/dictionary.h"
#include "experiments/tables/engines.h"
#include "experiments/tables/stability.h"
#include "experiments/tables/table.h"
#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

namespace fs = std::filesystem;
using namespace testing_tools;

class Folder {
 public:
  explicit Folder(const std::string& name)
      : path_(fs::temp_directory_path() / fmt::format("crosscheck-{}-{}", name, getpid())) {
    fs::remove_all(path_);
    fs::create_directories(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

TEST(Csv, HasProvenanceHeaderWithUnitsAndQuotesWhereNeeded) {
  Table t{"probe", {{"scene", "1"}, {"error", "m"}, {"steps", "1"}, {"note, long", "1"}}, {}};
  t.add({std::string("a,b"), 0.1, 7L, std::string("plain")});
  t.add({std::string("say \"so\""), -2.0, -3L, {}});
  t.add({std::string("two\nlines"), 1e300, 0L, std::string()});
  EXPECT_EQ(
      csv(t, {{"command", "test"}, {"seed", "1"}}),
      "# command: test\n# seed: 1\nscene [1],error [m],steps [1],\"note, long [1]\"\n"
      "\"a,b\",0.10000000000000001,7,plain\n\"say \"\"so\"\"\",-2,-3,\n\"two\nlines\",1.0000000000000001e+300,0,\n");
}

TEST(Csv, NumbersReadBackToTheSameBits) {
  Random random(1);
  std::vector<double> numbers = {0, -0.0, 1.0 / 3, 5e-324, 2.2250738585072014e-308, 1.7976931348623157e308, 1e22, 0.1};
  for (int i = 0; i < 2000; ++i)
    numbers.push_back(std::ldexp(random.between(-1, 1), static_cast<int>(random.between(-1000, 1000))));
  for (const double number : numbers) {
    const double back = std::strtod(exact_text(number).c_str(), nullptr);
    EXPECT_EQ(std::memcmp(&back, &number, sizeof back), 0) << exact_text(number);
  }
  EXPECT_EQ(exact_text(NAN), "nan");
  EXPECT_EQ(exact_text(-INFINITY), "-inf");
}

TEST(Csv, ColumnsAreFoundByName) {
  Table t{"probe", {{"a", "1"}, {"b", "m"}}, {}};
  t.add({1.0, 2.0});
  EXPECT_EQ(t.column("b"), 1);
  EXPECT_EQ(std::get<double>(t.at(0, "b")), 2.0);
  try {
    t.column("c");
    ADD_FAILURE();
  } catch (const std::out_of_range& e) {
    EXPECT_TRUE(contains(e.what(), "table probe has no column c"));
  }
}

struct ProbeRow {
  TABLE("probe");
  COLUMN(std::string, name, "name", "1", "a text");
  COLUMN(double, size, "size", "m", "a number");
  COLUMN(long, count, "count", "1", "a whole number");
  COLUMN(int, order, "order", "1", "a small one");
  COLUMN(bool, within, "within", "1", "yes or no");
  COLUMN(Verdict, verdict, "verdict", "1", "a word");
  COLUMN(std::optional<double>, error, "error", "m", "a number or nothing");
  COLUMN(std::optional<Tier>, tier, "tier", "1", "a word or nothing");
  COLUMN(std::optional<TruthKind>, truth, "truth", "1", "a value of its own");
  bool operator==(const ProbeRow&) const = default;
};

Table read_back(const Table& table) {
  const Folder folder("rows");
  write_csv(table, {{"command", "test"}}, folder.path());
  return read_csv(folder.path() / (table.name + ".csv"));
}

template <class Row>
std::string refusal(const Table& table) {
  try {
    rows_of<Row>(table);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(TypedTables, RowsComeBackFromTheirFileAsTheyWere) {
  std::vector<ProbeRow> rows = {{"plain", 0.1, 7, 2, true, Verdict::ok, 1e-300, Tier::exact, TruthKind{}},
                                {"with, comma", -3, -1, 0, false, Verdict::timeout, {}, {}, {}}};
  for (int tier = 1; tier <= 4; ++tier)
    for (const bool of_rule : {false, true}) {
      rows.push_back({"", 2, 0, 0, false, Verdict::ok, -0.5, Tier(tier), TruthKind{Tier(tier), of_rule}});
      rows.back().verdict = static_cast<Verdict>(static_cast<int>(Verdict::energy) + tier + 4 * of_rule - 1);
    }
  Table table = table_of<ProbeRow>();
  for (const ProbeRow& row : rows) add(table, row);
  EXPECT_EQ(rows_of<ProbeRow>(table), rows);
  EXPECT_EQ(rows_of<ProbeRow>(read_back(table)), rows);
  EXPECT_EQ(csv_row(table.rows[1]), "\"with, comma\",-3,-1,0,0,timeout,,,");
  // columns in which all cells are empty are read as text
  table.rows = {table.rows[1]};
  EXPECT_EQ(rows_of<ProbeRow>(read_back(table)), std::vector{rows[1]});
  // Integers in a file are accepted as floating-point numbers, but not vice versa.
  table.rows[0][2] = 0.5;
  EXPECT_TRUE(contains(refusal<ProbeRow>(table), "table probe, column count: expected a whole number"));
}

TEST(TypedTables, OtherColumnsAndUnknownWordsAreRefusedByTableAndColumn) {
  Table table = table_of<ProbeRow>("mine");
  add(table, ProbeRow{"a", 1, 1, 1, true, Verdict::ok, {}, {}, {}});
  EXPECT_EQ(refusal<ProbeRow>(table), "");
  EXPECT_TRUE(contains(refusal<EngineRow>(table), "table mine: expected the columns of table engines"));
  Table other = table;
  other.columns[1].unit = "mm";
  EXPECT_TRUE(contains(refusal<ProbeRow>(other), "table mine: expected the columns of table probe"));
  other = table;
  other.rows[0][5] = std::string("fine");
  EXPECT_TRUE(contains(refusal<ProbeRow>(other), "table mine, column verdict: unknown word 'fine'"));
  other.rows[0][5] = std::string("ok");
  other.rows[0][8] = std::string("exact, in-house rule");
  EXPECT_TRUE(contains(refusal<ProbeRow>(other), "table mine, column truth: unknown word 'exact, in-house rule'"));
  other.rows[0][8] = 1.0;
  EXPECT_TRUE(contains(refusal<ProbeRow>(other), "table mine, column truth: expected a text"));
}

TEST(Dictionary, SaysOfEveryColumnOnceWhatItIs) {
  const Table all = dictionary();
  std::set<std::pair<std::string, std::string>> seen;
  for (size_t i = 0; i < all.rows.size(); ++i) {
    const std::string table = text_at(all, i, "table"), column = text_at(all, i, "column");
    EXPECT_TRUE(seen.insert({table, column}).second) << table << " " << column << " is a duplicate";
    for (const char* said : {"unit", "type", "description"})
      EXPECT_FALSE(text_at(all, i, said).empty()) << table << " " << column;
  }
  for (const Column& column : columns_of<EngineRow>()) EXPECT_TRUE(seen.contains({"engines", column.name}));
  EXPECT_TRUE(seen.contains({"NAME-angles", "sideways"}));
}

TEST(Dictionary, OfTablesAtHandHasTheseOnly) {
  const std::vector<Table> present = {table_of<EngineRow>(), table_of<EngineEnergyRow>(),
                                      table_of<EngineTimeRow>("chain-engines")};
  EXPECT_EQ(distinct(dictionary(present), "table"),
            (std::vector<std::string>{"engines", "SCENE-engines", "engines-energy"}));
  const Table some = dictionary(std::span(present).first(1));
  EXPECT_EQ(some.rows.size(), present[0].columns.size());
  EXPECT_EQ(text_at(some, 2, "type"),
            "one of: ok | energy | nan | stretch | solver | frozen | timeout | crash | unsupported");
  EXPECT_EQ(text_at(some, 13, "type"), "number, or empty");
}

TEST(DeclaredTypes, AreThoseOfTheRowsWhateverTheFileLooksLike) {
  Table certificates = table_of<AttestedRow>();
  add(certificates, AttestedRow{"s", "m", "mass", "4", "1e-3", "", Parity::different_law});
  add(certificates, AttestedRow{"s", "m", "law", "Hooke", "the same", "Hooke", Parity::match});
  Table engines = table_of<EngineRow>();
  EngineRow row;
  row.scene = "s", row.method = "m", row.end = 2, row.reason = "why";
  add(engines, row);
  const Folder folder("declared");
  for (const Table& table : {certificates, engines}) {
    write_csv(table, {}, folder.path());
    const Table read = read_csv(folder.path() / (table.name + ".csv")), typed = with_declared_types(read);
    ASSERT_EQ(typed.rows.size(), table.rows.size());
    for (size_t i = 0; i < table.rows.size(); ++i) EXPECT_EQ(csv_row(typed.rows[i]), csv_row(table.rows[i]));
    if (table.name == "engines") {
      EXPECT_EQ(std::get<double>(typed.at(0, "end")), 2) << "a floating-point number with an integer value";
    }
    EXPECT_EQ(typed.columns, table.columns);
    EXPECT_EQ(typed.name, table.name);
  }
  Table own{"nobody's", {{"number", "m"}}, {{2L}}};
  EXPECT_EQ(with_declared_types(own).rows, own.rows) << "no row type has that name";
}

TEST(Tables, AVerdictThatReadsAsANumberIsStillAVerdict) {
  Table limits = table_of<LimitRow>();
  add(limits, LimitRow{.scene = "circle", .method = "mysim/rk4", .above = Verdict::nan});
  add(limits, LimitRow{.scene = "circle", .method = "mysim/leapfrog"});
  const Folder folder("verdicts");
  write_csv(limits, {}, folder.path());
  const std::vector<LimitRow> read = rows_of<LimitRow>(read_csv(folder.path() / "stability.csv"));
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].above, Verdict::nan);
  EXPECT_FALSE(read[1].above);
}

TEST(Files, AreWrittenWholeIntoNewFoldersAndOverOldOnes) {
  const Folder folder("files");
  const fs::path file = folder.path() / "deep" / "er" / "text.csv";
  const std::string bytes = std::string("zero\0byte\r\n", 11) + "end";
  for (const std::string& text : {std::string("first"), bytes, std::string()}) {
    write_file(file, text);
    EXPECT_EQ(content_of(file), text);
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(file.parent_path()), {}), 1) << "a temporary file was left";
  write_csv({"probe", {{"a", "1"}}, {}}, {}, folder.path());
  EXPECT_EQ(content_of(folder.path() / "probe.csv"), "a [1]\n");
  fs::create_symlink("elsewhere.csv", folder.path() / "link.csv");
  for (const char* name : {"../probe", "/tmp/probe", "link"})
    EXPECT_THROW(write_csv({name, {{"a", "1"}}, {}}, {}, folder.path()), InputError) << name;
}

TEST(Files, UnwritablePathsAreNamedAndNothingIsLeft) {
  const Folder folder("unwritable");
  write_file(folder.path() / "file", "x");
  fs::create_directories(folder.path() / "taken" / "inside");
  // A file cannot be written below another file, in place of a non-empty folder, or in a file system without regular
  // files, not even by root.
  for (const fs::path& file :
       {folder.path() / "file" / "below.csv", folder.path() / "taken", fs::path("/proc/crosscheck.csv")}) {
    SCOPED_TRACE(file);
    try {
      write_file(file, "text");
      ADD_FAILURE() << "expected an error";
    } catch (const InputError& e) {
      EXPECT_TRUE(contains(e.what(), file.string() + ": cannot be written"));
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    }
  }
  EXPECT_EQ(content_of(folder.path() / "file"), "x");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 2) << "a temporary file was left";
  EXPECT_THROW(require_writable(folder.path() / "file"), InputError);
  EXPECT_THROW(require_writable("/proc/crosscheck"), InputError);
  try {
    require_writable(folder.path() / "file" / "x");
    ADD_FAILURE();
  } catch (const InputError& e) {
    EXPECT_TRUE(contains(e.what(), (folder.path() / "file" / "x").string()));
  }
  EXPECT_NO_THROW(require_writable(folder.path() / "new" / "folder"));
  EXPECT_TRUE(fs::is_directory(folder.path() / "new" / "folder"));
}

TEST(Files, NamesKeepSafeCharactersOnly) {
  EXPECT_EQ(file_name_of("bullet/pbd+n=10"), "bullet-pbd+n=10");
  EXPECT_EQ(file_name_of("a b:c\\d*e?f\"g<h>i|j,k"), "a-b-c-d-e-f-g-h-i-j-k");
  EXPECT_EQ(file_name_of("AZaz09._=+-"), "AZaz09._=+-");
  EXPECT_EQ(file_name_of("caf\xc3\xa9"), "caf\xc3\xa9");
  EXPECT_EQ(file_name_of("caf\xc3"), "caf-");  // invalid UTF-8
  EXPECT_EQ(file_name_of(""), "");
}

}  // namespace
}  // namespace crosscheck
