// Submissions that attack the unpacking: links, names that point outside, bombs, names like options.
#include <archive.h>
#include <archive_entry.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <functional>

#include "tests/coursework/grader/build.h"
#include "tests/coursework/grader/grade.h"
#include "tests/coursework/test/canaries.h"
#include "tests/coursework/test/sandboxes.h"

namespace coursework {
namespace fs = std::filesystem;
namespace {

const char* const parts[] = {"euler.cpp", "trapezoidal.cpp", "rk4.cpp"};

/// Writes archives that no honest program creates.
class Packer {
 public:
  explicit Packer(const fs::path& file) : to_(archive_write_new()) {
    if (file.extension() == ".zip")
      archive_write_set_format_zip(to_);
    else
      archive_write_set_format_pax_restricted(to_);
    if (archive_write_open_filename(to_, file.c_str()) != ARCHIVE_OK) throw std::runtime_error("no archive");
  }
  ~Packer() { archive_write_free(to_); }
  void file(const std::string& name, const std::string& content, std::size_t times = 1) {
    archive_entry* entry = named(name, AE_IFREG);
    archive_entry_set_size(entry, static_cast<la_int64_t>(content.size() * times));
    archive_write_header(to_, entry);
    for (std::size_t i = 0; i < times; ++i) archive_write_data(to_, content.data(), content.size());
    archive_entry_free(entry);
  }
  void link(const std::string& name, const std::string& target, bool hard) {
    archive_entry* entry = named(name, hard ? AE_IFREG : AE_IFLNK);
    if (hard)
      archive_entry_set_hardlink(entry, target.c_str());
    else
      archive_entry_set_symlink(entry, target.c_str());
    archive_write_header(to_, entry);
    archive_entry_free(entry);
  }

 private:
  static archive_entry* named(const std::string& name, unsigned type) {
    archive_entry* entry = archive_entry_new();
    archive_entry_set_pathname(entry, name.c_str());
    archive_entry_set_filetype(entry, type);
    archive_entry_set_perm(entry, 0644);
    return entry;
  }
  archive* to_;
};

/// A submission whose part euler is malicious. Its other parts are honest.
struct Trick {
  std::string name;  // name of the submission
  std::function<void(const fs::path& file, const Canaries&)> make;
  std::string says;      // key of the texts for the expected remark
  bool all_lost = true;  // true: the whole submission earns nothing; false: only euler earns nothing
};

void honest(const fs::path& folder, const Canaries& canaries) {
  fs::create_directories(folder);
  for (const char* part : parts) fs::copy_file(canaries.tests() / "solution" / part, folder / part);
}

void honest(Packer& packer, const Canaries& canaries) {
  for (const char* part : {"trapezoidal.cpp", "rk4.cpp"})
    packer.file(part, content_of_file(canaries.tests() / "solution" / part));
}

const std::vector<Trick> tricks = {
    {"link",
     [](const fs::path& at, const Canaries& canaries) {
       honest(at, canaries);
       fs::remove(at / "euler.cpp");
       fs::create_symlink(canaries.tests() / "solution/euler.cpp", at / "euler.cpp");
     },
     "file.link", false},
    {"pipe",
     [](const fs::path& at, const Canaries& canaries) {
       honest(at, canaries);
       fs::remove(at / "euler.cpp");
       mkfifo((at / "euler.cpp").c_str(), 0644);
     },
     "file.link", false},
    {"folder",
     [](const fs::path& at, const Canaries& canaries) {
       honest(at, canaries);
       fs::remove(at / "euler.cpp");
       fs::create_directory_symlink(canaries.tests() / "solution", at / "src");
     },
     "file.missing", false},
    {"large",
     [](const fs::path& at, const Canaries& canaries) {
       honest(at, canaries);
       fs::resize_file(at / "euler.cpp", 1ull << 40);
     },
     "file.large", false},
    {"link.tar",
     [](const fs::path& at, const Canaries& canaries) {
       Packer packer(at);
       packer.link("euler.cpp", (canaries.tests() / "solution/euler.cpp").string(), false);
       honest(packer, canaries);
     },
     "file.link", false},
    {"hard-link.tar",
     [](const fs::path& at, const Canaries& canaries) {
       Packer packer(at);
       packer.link("euler.cpp", (canaries.tests() / "solution/euler.cpp").string(), true);
       honest(packer, canaries);
     },
     "file.link", false},
    {"link-to-folder.tar",
     [](const fs::path& at, const Canaries& canaries) {
       Packer packer(at);
       packer.link("src", canaries.results().string(), false);
       packer.file("src/results.json", "{\"score\": 100}");
       honest(packer, canaries);
     },
     "file.missing", false},
    {"above.tar",
     [](const fs::path& at, const Canaries& canaries) {
       Packer packer(at);
       packer.file("../../../../../../../.." + (canaries.results() / "results.json").string(), "{\"score\": 100}");
       honest(packer, canaries);
     },
     "archive.path"},
    {"above.zip",
     [](const fs::path& at, const Canaries& canaries) {
       Packer packer(at);
       packer.file("src/../../cheat.cpp", "int cheat;");
       honest(packer, canaries);
     },
     "archive.path"},
    {"absolute.tar",
     [](const fs::path& at, const Canaries& canaries) {
       Packer packer(at);
       packer.file((canaries.home() / ".bashrc").string(), "# cheat");
       honest(packer, canaries);
     },
     "archive.path"},
    {"bomb.zip",
     [](const fs::path& at, const Canaries& canaries) {
       Packer packer(at);
       packer.file("euler.cpp", std::string(1 << 20, '\0'), 300);
       honest(packer, canaries);
     },
     "archive.size"},
    {"many.zip",
     [](const fs::path& at, const Canaries& canaries) {
       Packer packer(at);
       for (int i = 0; i < 5000; ++i) packer.file("f" + std::to_string(i), "");
       honest(packer, canaries);
     },
     "archive.entries"},
};

Result graded(const Assignment& assignment, const Submission& submission, GradeOptions& options) {
  options.common = Texts::read((fs::path(COURSEWORK_FOLDER) / "check/common.en.txt").string());
  return grade(assignment, submission, *choose_sandbox("", false), options);
}

Assignment with_first_tests(const Assignment& all, std::vector<Test>& kept) {
  for (const Test& test : all.tests)
    if (std::string_view(test.id).ends_with(".1")) kept.push_back(test);
  Assignment few = all;
  few.tests = kept;
  return few;
}

TEST(ArchiveCheats, EarnNothingAndHarmNothing) {
  std::vector<coursework::Test> kept;
  const Assignment few = with_first_tests(find_assignment("a1-steppers"), kept);
  for (const Trick& trick : tricks) {
    const Canaries canaries;
    const PrivateFolder inbox(0700);
    trick.make(inbox.path() / trick.name, canaries);
    const Submission submission = read_submission(inbox.path() / trick.name, wanted_files(few));
    GradeOptions options;
    const Result result = graded(few, submission, options);
    for (const TestResult& test : result.tests)
      EXPECT_EQ(test.earned, trick.all_lost || test.part == "euler" ? 0 : test.points) << trick.name << ' ' << test.id;
    std::string remarks = result.not_graded + "\n";
    for (const std::string& line : result.preflight) remarks += line + "\n";
    const std::string& text = options.common.of(trick.says);
    const std::string fixed = text.substr(text.find('}') + 1, text.find('.') - text.find('}'));
    EXPECT_NE(remarks.find(fixed.substr(0, fixed.find('{'))), std::string::npos) << trick.name << ": " << remarks;
    EXPECT_EQ(canaries.harm(), "") << trick.name;
  }
}

TEST(ArchiveCheats, NamesLikeOptionsAreNames) {
  std::vector<coursework::Test> kept;
  const Assignment few = with_first_tests(find_assignment("a1-steppers"), kept);
  const Canaries canaries;
  const PrivateFolder inbox(0700);
  const fs::path folder = inbox.path() / "--no-sandbox";
  honest(folder, canaries);
  for (const char* name :
       {"-o", "-fplugin=euler.cpp", "--version.cpp", "@euler.cpp", "$(touch cheat).cpp", "-rf *.cpp"})
    std::ofstream(folder / name) << "#error never read\n";
  GradeOptions options;
  const Result result = graded(few, read_submission(folder, wanted_files(few)), options);
  EXPECT_EQ(result.earned(), result.points());
  EXPECT_EQ(canaries.harm(), "");
}

}  // namespace
}  // namespace coursework
