// Reading of folders, archives and whole programs: finds the requested files, and is safe for any content.

#include <archive.h>
#include <archive_entry.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "tests/coursework/classic/build_plan.h"
#include "tests/coursework/grader/assignment.h"
#include "tests/coursework/grader/build.h"
#include "tests/coursework/grader/layouts.h"
#include "tests/coursework/grader/submission.h"
#include "tests/coursework/test/helpers.h"

namespace coursework {
namespace {
namespace fs = std::filesystem;
using crosscheck::TemporaryFolder;
using crosscheck::write_file;

const std::vector<std::string> wanted = {"rk4.cpp", "euler.cpp"};

struct Entry {
  std::string path, content;
  mode_t type = AE_IFREG;
  std::string link = {};
};

/// The file's extension selects the format. Without a known extension, `zip` selects zip or tar.gz.
void pack(const fs::path& file, const std::vector<Entry>& entries, bool zip) {
  archive* to = archive_write_new();
  const std::string ending = file.extension().string();
  if (ending == ".7z") {
    archive_write_set_format_7zip(to);
  } else if (zip) {
    archive_write_set_format_zip(to);
  } else {
    archive_write_set_format_pax_restricted(to);
    if (ending == ".xz")
      archive_write_add_filter_xz(to);
    else if (ending == ".bz2")
      archive_write_add_filter_bzip2(to);
    else
      archive_write_add_filter_gzip(to);
  }
  archive_write_open_filename(to, file.c_str());
  for (const Entry& one : entries) {
    archive_entry* entry = archive_entry_new();
    archive_entry_set_pathname(entry, one.path.c_str());
    archive_entry_set_filetype(entry, one.type);
    archive_entry_set_perm(entry, 0644);
    archive_entry_set_size(entry, static_cast<la_int64_t>(one.content.size()));
    if (one.type == AE_IFLNK) archive_entry_set_symlink(entry, one.link.c_str());
    if (one.type == AE_IFREG && !one.link.empty()) archive_entry_set_hardlink(entry, one.link.c_str());
    archive_write_header(to, entry);
    archive_write_data(to, one.content.data(), one.content.size());
    archive_entry_free(entry);
  }
  archive_write_close(to);
  archive_write_free(to);
}

TEST(Submission, FilesAreFoundWhereStudentsPutThem) {
  for (const char* folder : {"", "src/", "smith/", "smith/src/", "SRC/"}) {
    const TemporaryFolder here("test");
    write_file(here.path / "handed" / folder / "rk4.cpp", "rk4");
    write_file(here.path / "handed" / folder / "euler.cpp", "euler");
    std::vector<Submission> all{read_submission(here.path / "handed", wanted)};
    for (const bool zip : {false, true}) {
      pack(here.path / "archive",
           {{std::string(folder) + "rk4.cpp", "rk4"}, {std::string(folder) + "euler.cpp", "euler"}}, zip);
      all.push_back(read_submission(here.path / "archive", wanted));
    }
    for (const Submission& one : all) {
      EXPECT_EQ(one.files.at("rk4.cpp"), "rk4") << folder;
      EXPECT_EQ(one.files.at("euler.cpp"), "euler") << folder;
      EXPECT_TRUE(one.missing.empty() && one.remarks.empty()) << folder;
    }
  }
}

TEST(Layouts, EveryPersonIsOneSubmissionWhateverWasExported) {
  const TemporaryFolder here("test");
  const std::string archive = (here.path / "all.zip").string();
  pack(archive, {{"work/rk4.cpp", "rk4"}, {"work/euler.cpp", "euler"}}, true);
  const auto put = [&](const std::string& name) {
    fs::create_directories((here.path / name).parent_path());
    fs::copy_file(archive, here.path / name);
  };
  // a folder per student with the archive in it, and archives without folders
  put("moodle/Ada Lovelace_123_assignsubmission_file_/a1.zip");
  write_file(here.path / "moodle/Ada Lovelace_123_assignsubmission_onlinetext_/onlinetext.html", "see file");
  put("moodle/Bo_124_assignsubmission_file_a1.zip");
  put("canvas/lovelaceada_12345_67890_a1.zip");
  put("canvas/bo_LATE_12346_67891_a1-2.zip");
  write_file(here.path / "canvas/chen_12347_67892_rk4.cpp", "rk4");
  write_file(here.path / "canvas/chen_12347_67893_euler-1.cpp", "euler");
  write_file(here.path / "canvas/chen_12347_67894_photo.png", "x");
  write_file(here.path / "gradescope/submission_metadata.yml",
             "---\nsubmission_71:\n  :submitters:\n  - :name: Ada Lovelace\n    :sid: '1'\n  - :name: 'Bo'\n"
             "submission_72:\n  :submitters:\n  - :name: Chen\n  :created_at: 2026\n");
  for (const char* number : {"71", "72"})
    for (const char* file : {"rk4", "euler"})
      write_file(here.path / "gradescope" / (std::string("submission_") + number) / (file + std::string(".cpp")), file);
  for (const char* who : {"ada", "bo"}) {
    write_file(here.path / "git" / who / ".git/HEAD", "ref");
    write_file(here.path / "git" / who / ".git/rk4.cpp", "not this one");
    for (const char* file : {"rk4", "euler"})
      write_file(here.path / "git" / who / "a1/src" / (file + std::string(".cpp")), file);
  }
  const std::pair<const char*, std::vector<std::string>> table[] = {
      {"Moodle", {"Ada Lovelace_123", "Bo_124"}},
      {"Canvas", {"bo_12346", "chen_12347", "lovelaceada_12345"}},
      {"Gradescope", {"Ada Lovelace + Bo (submission_71)", "Chen (submission_72)"}},
      {"Git", {"ada", "bo"}},
  };
  for (const auto& [layout, people] : table) {
    const fs::path folder = here.path / lower(layout);
    EXPECT_EQ(class_layout(folder, wanted), layout);
    std::vector<std::string> found;
    for (const Handed& one : submissions_in(folder)) {
      found.push_back(one.name);
      const Submission read = read_submission(one, wanted);
      EXPECT_FALSE(read.refused) << one.name;
      EXPECT_EQ(read.files.count("rk4.cpp") + read.files.count("euler.cpp"), 2u) << one.name;
      if (!read.files.empty()) {
        EXPECT_EQ(read.files.begin()->second, "euler") << one.name;
      }
    }
    EXPECT_EQ(found, people) << layout;
  }
}

TEST(Layouts, WhatCannotBeGradedHasAReason) {
  const TemporaryFolder here("test");
  write_file(here.path / "text/notes.txt", "see my mail");
  write_file(here.path / "two/a.zip", "x");
  write_file(here.path / "two/b.zip", "x");
  write_file(here.path / "damaged/a.zip", "PK\x03\x04 and no more");
  fs::create_directory_symlink(here.path / "two", here.path / "linked");
  write_file(here.path / "letter.txt", "see my mail");
  const std::pair<const char*, const char*> table[] = {{"text", "submission.empty"},
                                                       {"two", "submission.archives"},
                                                       {"damaged", "archive.unreadable"},
                                                       {"linked", "submission.link"},
                                                       {"letter.txt", "archive.unreadable"}};
  for (const Handed& one : submissions_in(here.path)) {
    const Submission read = read_submission(one, wanted);
    EXPECT_TRUE(read.refused) << one.name;
    const auto row =
        std::find_if(std::begin(table), std::end(table), [&](const auto& r) { return one.name == r.first; });
    ASSERT_NE(row, std::end(table)) << one.name;
    EXPECT_EQ(read.remarks.back().key, row->second) << one.name;
  }
  EXPECT_EQ(read_submission(here.path / "text", {}).remarks.back().key, "submission.empty_program");
}

TEST(Layouts, OneSubmissionIsNoClass) {
  const TemporaryFolder here("test");
  for (const char* file : {"one/src/rk4.cpp", "one/old/rk4.cpp", "many/a/rk4.cpp", "many/b/RK4.cpp", "many/c/rk4.cpp",
                           "top/rk4.cpp", "top/a/rk4.cpp", "top/b/rk4.cpp", "top/c/rk4.cpp"})
    write_file(here.path / file, "rk4");
  for (const char* file : {"a.zip", "b.tar.gz", "c.rar"}) write_file(here.path / "packed" / file, "x");
  EXPECT_EQ(class_layout(here.path / "one", wanted), "");
  EXPECT_EQ(class_layout(here.path / "top", wanted), "");
  EXPECT_EQ(class_layout(here.path / "many", wanted), "folders");
  EXPECT_EQ(class_layout(here.path / "packed", wanted), "folders");
}

TEST(Submission, BackupsAndOlderCopiesStandBehindAndAreSaid) {
  struct Two {
    const char *graded, *left_out;
  };
  for (const Two& one :
       {Two{"rk4.cpp", "old/rk4.cpp"}, Two{"src/rk4.cpp", "rk4 - Copy.cpp"}, Two{"x/rk4.cpp", "rk4 (1).cpp"},
        Two{"x/rk4.cpp", "backup/rk4.cpp"}, Two{"x/rk4.cpp", "a (2)/rk4.cpp"}, Two{"b/rk4.cpp", "a/rk4.cpp"},
        Two{"rk4.cpp", "Copy of rk4.cpp"}, Two{"rk4.cpp", "rk4_old.cpp"}}) {
    const TemporaryFolder here("test");
    write_file(here.path / one.graded, "now");
    write_file(here.path / one.left_out, "then");
    write_file(here.path / "b/euler.cpp", "the fuller copy is b");
    const Submission read = read_submission(here.path, wanted);
    EXPECT_EQ(read.files.at("rk4.cpp"), "now") << one.left_out;
    ASSERT_FALSE(read.remarks.empty()) << one.left_out;
    EXPECT_EQ(read.remarks[0].key, "file.left_out");
    EXPECT_EQ(read.remarks[0].with, (std::vector<std::string>{one.left_out, one.graded}));
  }
  const TemporaryFolder here("test");
  write_file(here.path / "rk4 (1).cpp", "the only one");
  write_file(here.path / "a/euler.cpp", "the same");
  write_file(here.path / "c/euler.cpp", "the same");
  const Submission only = read_submission(here.path, wanted);
  EXPECT_EQ(only.files.at("rk4.cpp"), "the only one");
  EXPECT_EQ(only.files.at("euler.cpp"), "the same");
  EXPECT_EQ(only.remarks.size(), 1u) << "of two that are the same nothing need be said";
}

TEST(Submission, MarksOfCopiesAreCutOffAndNoOthers) {
  const std::pair<const char*, const char*> table[] = {{"src/a - Copy.cpp", "src/a.cpp"},
                                                       {"a - Copy (2).cpp", "a.cpp"},
                                                       {"a (1).cpp", "a.cpp"},
                                                       {"a(12).h", "a.h"},
                                                       {"Copy of a.cpp", "a.cpp"},
                                                       {"a copy 2.cpp", "a.cpp"},
                                                       {"a.orig.cpp", "a.cpp"},
                                                       {"a_old.cpp", "a.cpp"},
                                                       {"a~.cpp", "a.cpp"},
                                                       {"a - 副本.cpp", "a.cpp"},
                                                       {"a - 副本 (2).cpp", "a.cpp"},
                                                       {"a 副本.cpp", "a.cpp"},
                                                       {"a 副本 2.cpp", "a.cpp"},
                                                       {"a的副本.cpp", "a.cpp"},
                                                       {"threshold.cpp", "threshold.cpp"},
                                                       {"a2.cpp", "a2.cpp"},
                                                       {"photocopy.cpp", "photocopy.cpp"},
                                                       {"(1).cpp", "(1).cpp"},
                                                       {"f(x).cpp", "f(x).cpp"},
                                                       {"Makefile", "Makefile"}};
  for (const auto& [name, plain] : table) EXPECT_EQ(without_copy_marks(name), plain);
}

TEST(Submission, TextsOfOtherEncodingsBecomePlain) {
  const std::string utf16 = std::string("i\0n\0t\0\xe9\0", 8);
  EXPECT_EQ(plain_utf8("\xef\xbb\xbfint"), "int");
  EXPECT_EQ(plain_utf8("\xff\xfe" + utf16), "int\xc3\xa9");
  EXPECT_EQ(plain_utf8("\xfe\xff" + std::string("\0i\0n\x20\xac", 6)), "in\xe2\x82\xac");
  EXPECT_EQ(plain_utf8("\xff\xfe" + std::string("=\xd8\0\xde", 4)), "\xf0\x9f\x98\x80") << "two units";
  EXPECT_EQ(plain_utf8("int\xe9"), "int\xe9");
  // text in GBK: the second byte of the last character in the comment is a backslash
  EXPECT_EQ(plain_utf8("// \xd6\xd0\x81\x5c\nint x;"), "// \xe4\xb8\xad\xe4\xb9\x97\nint x;");
  EXPECT_EQ(plain_utf8("// \xe4\xb8\xad"), "// \xe4\xb8\xad");
}

TEST(Submission, WhatPartsIncludeIsTakenAlong) {
  const TemporaryFolder here("test");
  const std::map<std::string, std::string> all = {
      {"src/rk4.cpp",
       "#include \"helper.h\"\n#include <vector>\n#include \"util\\more.h\"\n#include \"../inc/far.h\"\n"},
      {"src/euler.cpp", "#include \"Odd.H\"\n#include \"/etc/passwd\"\n#include \"../../out.h\"\n"},
      {"src/helper.h", "#include \"table.inc\"\n"},
      {"src/table.inc", "#include \"helper.h\"\n"},
      {"src/util/more.h", "#include \"helper.h\"\n"},
      {"inc/far.h", "far"},
      {"src/odd.h", "odd"},
      {"src/unused.h", "unused"},
      {"elsewhere/a/vector", "no header of this name is ours to take"}};
  for (const auto& [path, content] : all) write_file(here.path / "handed" / path, content);
  std::vector<Entry> entries;
  for (const auto& [path, content] : all) entries.push_back({path, content});
  pack(here.path / "handed.zip", entries, true);
  for (const char* name : {"handed", "handed.zip"}) {
    const Submission one = read_submission(here.path / name, wanted);
    std::vector<std::string> taken;
    for (const auto& [file, content] : one.files) taken.push_back(file);
    EXPECT_EQ(taken, (std::vector<std::string>{"euler.cpp", "inc/far.h", "rk4.cpp", "src/helper.h", "src/odd.h",
                                               "src/table.inc", "src/util/more.h"}))
        << name;
    EXPECT_NE(one.files.at("rk4.cpp").find("#include \"util/more.h\""), std::string::npos) << "only / works everywhere";
    const auto found = own_includes(one.files, one.places.at("rk4.cpp"), one.files.at("rk4.cpp"));
    EXPECT_EQ(found, (std::map<std::string, std::string>{{"inc/far.h", "inc/far.h"},
                                                         {"src/helper.h", "src/helper.h"},
                                                         {"src/table.inc", "src/table.inc"},
                                                         {"src/util/more.h", "src/util/more.h"}}))
        << name;
    EXPECT_EQ(own_includes(one.files, "src/euler.cpp", one.files.at("euler.cpp")),
              (std::map<std::string, std::string>{{"src/Odd.H", "src/odd.h"}}))
        << name;
  }
}

TEST(Submission, ArchivesOfManyKindsAndInsideEachOtherAreRead) {
  for (const char* ending : {".zip", ".7z", ".tar.xz", ".tar.bz2"}) {
    const TemporaryFolder here("test");
    const fs::path inner = here.path / (std::string("inner") + ending), outer = here.path / "outer.zip";
    pack(inner, {{"work/rk4.cpp", "rk4"}, {"work/euler.cpp", "euler"}}, inner.extension() == ".zip");
    pack(outer, {{"report.pdf", "x"}, {"homework/inner" + std::string(ending), content_of_file(inner)}}, true);
    for (const fs::path& one : {inner, outer}) {
      const Submission read = read_submission(one, wanted);
      EXPECT_EQ(read.files.size(), 2u) << one << (read.remarks.empty() ? "" : read.remarks[0].key);
    }
  }
}

// An archive from a Chinese system: the folder's name is encoded in GBK, and its last byte is a backslash.
TEST(Submission, FoldersWithNamesInGBKAreRead) {
  const TemporaryFolder here("test");
  pack(here.path / "a.tar.gz", {{"\xd7\xf7\x81\x5c/rk4.cpp", "rk4"}}, false);
  const Submission one = read_submission(here.path / "a.tar.gz", wanted);
  EXPECT_EQ(one.files.count("rk4.cpp"), 1u);
  EXPECT_EQ(one.places.at("rk4.cpp"), "\xe4\xbd\x9c\xe4\xb9\x97/rk4.cpp");
  // a path too long to lay out is ignored
  const std::string far = std::string(300, 'x') + "/rk4.cpp";
  pack(here.path / "b.zip", {{far, "rk4"}}, true);
  EXPECT_EQ(read_submission(here.path / "b.zip", wanted).places.count("rk4.cpp"), 0u);
}

TEST(Submission, LimitsHoldForArchivesInsideOthers) {
  const TemporaryFolder here("test");
  const fs::path inner = here.path / "inner.zip", outer = here.path / "outer.zip";
  const auto refused = [&](const std::vector<Entry>& entries, std::size_t copies = 1) {
    pack(inner, entries, true);
    std::vector<Entry> outside;
    for (std::size_t i = 0; i < copies; ++i) outside.push_back({std::to_string(i) + ".zip", content_of_file(inner)});
    pack(outer, outside, true);
    const Submission read = read_submission(outer, wanted);
    EXPECT_TRUE(read.files.empty());
    return read.remarks.empty() ? "" : read.remarks.back().key;
  };
  const std::string block(largest_total / 4, 'x');
  EXPECT_EQ(refused({{"rk4.cpp", "rk4"}, {"a", block}, {"b", block}, {"c", block}, {"d", block}}), "archive.size");
  EXPECT_EQ(refused(std::vector<Entry>(most_entries, {"data", ""})), "archive.entries");
  EXPECT_EQ(refused({{"../rk4.cpp", "x"}}), "archive.path");
  EXPECT_EQ(refused({{"rk4.cpp", "rk4"}}, 2), "submission.archives");
  pack(outer, {{"rk4.cpp", "", AE_IFLNK, "/etc/passwd"}}, true);
  pack(inner, {{"a.zip", content_of_file(outer)}}, true);
  EXPECT_EQ(read_submission(inner, wanted).missing.at("rk4.cpp").key, "file.link");
  pack(inner, {{"rk4.cpp", "rk4"}}, true);
  for (int depth = 1; depth <= deepest_archive; ++depth) {
    const Submission read = read_submission(inner, wanted);
    EXPECT_EQ(read.files.count("rk4.cpp"), 1u) << depth;
    pack(outer, {{"a.zip", content_of_file(inner)}}, true);
    fs::rename(outer, inner);
  }
  const Remark nested = read_submission(inner, wanted).remarks.at(0);
  EXPECT_NE(said(common_texts(), nested).find("Archives are nested more than 3 deep"), std::string::npos);
}

TEST(Submission, GradeTomlChoosesFoldersFilesAndClasses) {
  const TemporaryFolder here("test");
  for (const char* path : {"a/rk4.cpp", "a/euler.cpp", "b/rk4.cpp", "b/euler.cpp"}) write_file(here.path / path, path);
  EXPECT_EQ(read_submission(here.path, wanted).files.at("rk4.cpp"), "a/rk4.cpp");
  write_file(here.path / "grade.toml", "folder = \"b/\"\n");
  Submission one = read_submission(here.path, wanted);
  EXPECT_EQ(one.files.at("rk4.cpp"), "b/rk4.cpp");
  EXPECT_TRUE(one.remarks.empty());
  write_file(here.path / "grade.toml", "[[leave_out]]\npath = \"a/rk4.cpp\"\n[classes]\nchain = \"Rope\"\n");
  one = read_submission(here.path, {}, {"chain", "cloth"});
  EXPECT_EQ(one.files.size(), 3u);
  EXPECT_EQ(one.choice.classes, (std::map<std::string, std::string>{{"chain", "Rope"}}));
}

TEST(Submission, GradeTomlThatIsWrongIsSaidAndNotUsed) {
  const std::pair<const char*, const char*> table[] = {
      {"folder = ", "grade.toml:1: "},
      {"folder = 3", "grade.toml:1: folder: expected a folder of the submission, in quotes, got 3"},
      {"folder = \"c\"", "grade.toml:1: folder: expected a folder of the submission that holds sources"},
      {"[[leave_out]]\npath = \"c\"", "grade.toml:2: leave_out[0].path: expected a file or folder of the submission"},
      {"[[leave_out]]\nfile = \"a\"", "path: is missing"},
      {"colour = 1", "grade.toml:1: colour: unknown key"},
      {"[classes]\nrope = \"A\"", "grade.toml:2: classes.rope: unknown key"},
      {"[classes]\nchain = 1", "classes.chain: expected the name of a class, in quotes, got 1"}};
  for (const auto& [text, says] : table) {
    const TemporaryFolder here("test");
    write_file(here.path / "a/rk4.cpp", "rk4");
    write_file(here.path / "grade.toml", text);
    const Submission one = read_submission(here.path, {}, {"chain"});
    EXPECT_EQ(one.files.size(), 1u) << text;
    ASSERT_EQ(one.remarks.size(), 1u) << text;
    EXPECT_EQ(one.remarks[0].key, "choice.bad");
    EXPECT_NE(one.remarks[0].with.at(0).find(says), std::string::npos) << one.remarks[0].with[0];
  }
  const TemporaryFolder here("test");
  write_file(here.path / "grade.toml", std::string(largest_choice + 1, ' '));
  EXPECT_EQ(read_submission(here.path, {}).remarks.at(0).with.at(0), "grade.toml: expected a file of at most 16 kB");
}

TEST(Submission, CaseOfLettersDiffersAndIsSaid) {
  const TemporaryFolder here("test");
  write_file(here.path / "RK4.CPP", "rk4");
  const Submission one = read_submission(here.path, wanted);
  EXPECT_EQ(one.files.at("rk4.cpp"), "rk4");
  ASSERT_EQ(one.remarks.size(), 1u);
  EXPECT_EQ(one.remarks[0].key, "file.case");
  EXPECT_EQ(one.missing.at("euler.cpp").key, "file.missing");
}

TEST(Submission, ThatIsAPipeIsRefusedAndNotWaitedFor) {
  const TemporaryFolder here("test");
  fs::create_directories(here.path / "class");
  for (const char* name : {"ada.zip", "bo", "rk4.cpp"})
    ASSERT_EQ(mkfifo((here.path / "class" / name).c_str(), 0600), 0);
  for (const Handed& handed : submissions_in(here.path / "class")) {
    const Submission one = read_submission(handed, wanted);
    EXPECT_TRUE(one.files.empty()) << handed.name;
    EXPECT_TRUE(one.missing.contains("rk4.cpp")) << handed.name;
  }
  ASSERT_EQ(mkfifo((here.path / "class/submission_metadata.yml").c_str(), 0600), 0);
  EXPECT_THROW(submissions_in(here.path / "class"), crosscheck::InputError);
}

TEST(Submission, LinksPipesAndLargeFilesOfAFolderAreRefused) {
  const TemporaryFolder here("test");
  write_file(here.path / "secret", "secret");
  fs::create_directories(here.path / "handed");
  fs::create_symlink(here.path / "secret", here.path / "handed/rk4.cpp");
  ASSERT_EQ(mkfifo((here.path / "handed/euler.cpp").c_str(), 0600), 0);
  Submission one = read_submission(here.path / "handed", wanted);
  EXPECT_TRUE(one.files.empty());
  EXPECT_EQ(one.missing.at("rk4.cpp").key, "file.link");
  EXPECT_EQ(one.missing.at("euler.cpp").key, "file.link");
  for (const bool too_large : {false, true}) {
    write_file(here.path / "large/rk4.cpp", std::string(largest_file + too_large, 'x'));
    one = read_submission(here.path / "large", wanted);
    EXPECT_EQ(one.files.count("rk4.cpp"), too_large ? 0u : 1u);
    if (too_large) {
      EXPECT_EQ(one.missing.at("rk4.cpp").key, "file.large");
    }
  }
  // a folder of links is not followed
  write_file(here.path / "elsewhere/rk4.cpp", "rk4");
  fs::create_directories(here.path / "linked");
  fs::create_directory_symlink(here.path / "elsewhere", here.path / "linked/src");
  EXPECT_EQ(read_submission(here.path / "linked", wanted).missing.at("rk4.cpp").key, "file.missing");
}

TEST(Submission, LinksInArchivesAreRefused) {
  const TemporaryFolder here("test");
  for (const bool zip : {false, true}) {
    std::vector<Entry> entries{{"rk4.cpp", "", AE_IFLNK, "/etc/passwd"}};
    if (!zip) entries.push_back({"euler.cpp", "", AE_IFREG, "/etc/passwd"});
    pack(here.path / "archive", entries, zip);
    const Submission one = read_submission(here.path / "archive", wanted);
    EXPECT_TRUE(one.files.empty());
    EXPECT_EQ(one.missing.at("rk4.cpp").key, "file.link");
    EXPECT_EQ(one.missing.at("euler.cpp").key, zip ? "file.missing" : "file.link");
  }
}

TEST(Submission, ArchivesThatPointOutsideAreRefusedAsAWhole) {
  for (const char* path : {"../rk4.cpp", "a/../../rk4.cpp", "/rk4.cpp", "..\\rk4.cpp", "src/../rk4.cpp"})
    for (const bool zip : {false, true}) {
      const TemporaryFolder here("test");
      pack(here.path / "archive", {{"euler.cpp", "euler"}, {path, "rk4"}}, zip);
      const Submission one = read_submission(here.path / "archive", wanted);
      EXPECT_TRUE(one.files.empty()) << path;
      ASSERT_EQ(one.remarks.size(), 1u) << path;
      EXPECT_EQ(one.remarks[0].key, "archive.path") << path;
      EXPECT_EQ(std::distance(fs::directory_iterator(here.path), {}), 1) << path;
    }
}

TEST(Submission, ArchivedFilesWithUnsafeNamesAreNotTaken) {
  const TemporaryFolder here("test");
  pack(here.path / "archive", {{"a.cpp", "a"}, {"b\nc.cpp", "b"}, {"src//d.cpp", "d"}, {"\x1b[2J.cpp", "e"}}, false);
  const Submission one = read_submission(here.path / "archive", {});
  std::vector<std::string> names;
  for (const auto& [name, content] : one.files) names.push_back(name);
  EXPECT_EQ(names, (std::vector<std::string>{"a.cpp", "src/d.cpp"}));
}

TEST(Submission, BombsAreRefusedOnBothSidesOfTheLimit) {
  const TemporaryFolder here("test");
  for (const bool too_much : {false, true}) {
    const std::string block((largest_total >> 2) - 1, 'x');
    std::vector<Entry> entries{{"rk4.cpp", "rk4"}};
    for (int i = 0; i < (too_much ? 5 : 3); ++i) entries.push_back({"data" + std::to_string(i), block});
    pack(here.path / "archive", entries, true);
    const Submission one = read_submission(here.path / "archive", wanted);
    EXPECT_EQ(one.files.count("rk4.cpp"), too_much ? 0u : 1u);
    EXPECT_EQ(one.remarks.empty(), !too_much);
    if (too_much) {
      EXPECT_EQ(one.remarks[0].key, "archive.size");
    }
  }
  for (const std::size_t count : {most_entries, most_entries + 1}) {
    std::vector<Entry> entries(count, {"data", ""});
    entries[0] = {"rk4.cpp", "rk4"};
    pack(here.path / "archive", entries, false);
    const Submission one = read_submission(here.path / "archive", wanted);
    EXPECT_EQ(one.files.count("rk4.cpp"), count > most_entries ? 0u : 1u);
    if (count > most_entries) {
      EXPECT_EQ(one.remarks.at(0).key, "archive.entries");
    }
  }
}

TEST(Submission, DamagedGzipIsUnreadableWhereverTheDamageIs) {
  const TemporaryFolder here("test");
  std::string noise;  // incompressible, so that a changed byte changes only the text
  for (unsigned i = 1; noise.size() < 3000; i = i * 1664525 + 1013904223) noise += static_cast<char>(i >> 24);
  pack(here.path / "whole", {{"rk4.cpp", noise}, {"euler.cpp", "euler"}}, false);
  const std::string whole = content_of_file(here.path / "whole");
  const auto changed = [&](std::size_t at) {
    std::string text = whole;
    text[at] = static_cast<char>(text[at] ^ 4);
    return text;
  };
  const std::pair<const char*, std::string> damaged[] = {{"in the middle", changed(whole.size() / 2)},
                                                         {"in the checksum", changed(whole.size() - 6)},
                                                         {"in the length", changed(whole.size() - 1)},
                                                         {"the end is cut off", whole.substr(0, whole.size() - 3)},
                                                         {"no checksum", whole.substr(0, whole.size() - 8)},
                                                         {"half", whole.substr(0, whole.size() / 2)},
                                                         {"something behind", whole + "rubbish"},
                                                         {"a second one, cut off", whole + whole.substr(0, 40)}};
  for (const auto& [what, bytes] : damaged) {
    write_file(here.path / "archive", bytes);
    const Submission one = read_submission(here.path / "archive", wanted);
    EXPECT_TRUE(one.files.empty()) << what;
    ASSERT_EQ(one.remarks.size(), 1u) << what;
    EXPECT_EQ(one.remarks[0].key, "archive.unreadable") << what;
  }
  // intact archives stay valid with zero padding, which some transfers add
  for (const std::string& bytes : {whole, whole + std::string(512, '\0')}) {
    write_file(here.path / "archive", bytes);
    const Submission one = read_submission(here.path / "archive", wanted);
    EXPECT_EQ(one.files.at("rk4.cpp"), noise);
    EXPECT_TRUE(one.remarks.empty());
  }
}

TEST(Submission, NamesLikeOptionsAndRubbishDoNoHarm) {
  const TemporaryFolder here("test");
  pack(here.path / "archive",
       {{"-o", "x"}, {"@file", "x"}, {"-rf *", "x"}, {"__MACOSX/rk4.cpp", "x"}, {"rk4.cpp", "rk4"}}, true);
  EXPECT_EQ(read_submission(here.path / "archive", wanted).files.at("rk4.cpp"), "rk4");
  write_file(here.path / "rubbish", "neither zip nor tar");
  write_file(here.path / "empty", "");
  pack(here.path / "whole", {{"rk4.cpp", std::string(1 << 16, 'x')}, {"data", std::string(1 << 16, 'y')}}, false);
  write_file(here.path / "half", content_of_file(here.path / "whole").substr(0, 100));
  for (const char* name : {"rubbish", "half"}) {
    const Submission one = read_submission(here.path / name, wanted);
    EXPECT_TRUE(one.files.empty()) << name;
    ASSERT_FALSE(one.remarks.empty()) << name;
    EXPECT_EQ(one.remarks[0].key, "archive.unreadable") << name;
  }
  EXPECT_TRUE(read_submission(here.path / "empty", wanted).files.empty());
  EXPECT_THROW(read_submission(here.path / "nothing there", wanted), crosscheck::InputError);
}

namespace fs = std::filesystem;
using crosscheck::TemporaryFolder;
using crosscheck::write_file;

TEST(Whole, MoreFilesThanAProgramHasAreRefused) {
  const TemporaryFolder here("test");
  for (std::size_t i = 0; i < most_program_files; ++i)
    write_file(here.path / ("f" + std::to_string(i) + ".h"), "int x;");
  write_file(here.path / "notes.txt", "no C++ file counts for nothing");
  EXPECT_EQ(read_submission(here.path, {}).files.size(), most_program_files);
  write_file(here.path / "one_more.cpp", "");
  const Submission refused = read_submission(here.path, {});
  EXPECT_TRUE(refused.files.empty());
  ASSERT_EQ(refused.remarks.size(), 1u);
  EXPECT_EQ(refused.remarks.front().key, "program.entries");
}

TEST(Whole, ALargerOneThanAProgramIsIsRefused) {
  const TemporaryFolder here("test");
  for (int i = 0; i < 4; ++i) write_file(here.path / ("f" + std::to_string(i) + ".h"), std::string(largest_file, ' '));
  EXPECT_EQ(read_submission(here.path, {}).files.size(), 4u);
  write_file(here.path / "more.h", " ");
  const Submission refused = read_submission(here.path, {});
  EXPECT_TRUE(refused.files.empty());
  ASSERT_EQ(refused.remarks.size(), 1u);
  EXPECT_EQ(refused.remarks.front().key, "program.size");
  // if files are requested by name, all other files are ignored
  EXPECT_EQ(read_submission(here.path, {"more.h"}).files.size(), 1u);
}

std::vector<std::string> notes_on(const classic::Files& files) {
  std::vector<std::string> keys;
  for (const Remark& note : classic::choose_files(files).notes) keys.push_back(note.key);
  return keys;
}

TEST(Whole, FilesAreChosenByNameAndTheOthersAreSaid) {
  using Keys = std::vector<std::string>;
  EXPECT_EQ(notes_on({{"a.h", "class ClothSystem {"}, {"b.cpp", ""}}), Keys());
  EXPECT_EQ(notes_on({{"a.h", ""}, {"old/a.h", ""}}), Keys{"whole.twice"});
  EXPECT_EQ(notes_on({{"a.h", ""}, {"a.h/b.h", ""}, {"a.h/c/d.h", ""}}), Keys());
  EXPECT_EQ(notes_on({{std::string(300, 'x') + ".h", ""}, {std::string(300, 'x') + "/b.h", ""}}), Keys{"whole.name"});
  const std::string defines = "vector<Vector3f> ClothSystem::evalF(vector<Vector3f> s) { return s; }";
  EXPECT_EQ(notes_on({{"ClothSystem.cpp", defines}, {"attempt.cpp", defines}}), Keys{"whole.same_class"});
  EXPECT_EQ(notes_on({{"ClothSystem.cpp", defines}, {"ClothSystem - Copy.cpp", defines}}), Keys{"whole.twice"});
}

TEST(Whole, OtherVersionsAreWorthATryWhereTheyDiffer) {
  const classic::Files files = {
      {"a.h", "1"}, {"b.h", "1"}, {"all/final/a.h", "2"}, {"all/final/b.h", "2"}, {"zz/a.h", "1"}};
  const classic::Selection first = classic::choose_files(files);
  EXPECT_EQ(first.others, std::vector<std::string>{"all/"});
  EXPECT_EQ(first.files, (classic::Files{{"a.h", "1"}, {"b.h", "1"}}));
  EXPECT_EQ(classic::choose_files(files, "all/").files,
            (classic::Files{{"all/final/a.h", "2"}, {"all/final/b.h", "2"}}));
}

TEST(Whole, ClassesAreFoundWithTheirBasesAndScopes) {
  const std::string text =
      "namespace a { namespace b { class S : public virtual x::ParticleSystem, private Q<int, P> {\n"
      "  struct Inner { int evalF(int); };\n  virtual V evalF(V s) const = 0; }; }\n"
      "struct T final : S { V evalF(V s) { struct Local { int x; }; return s; } }; }\n"
      "template <class C> class U : public S {}; class Announced; enum class E { x }; class Step { void takeStep(); "
      "};\n";
  std::vector<std::string> names;
  const classic::ClassList all = classic::classes_in(classic::tokens_of(text), "a.h");
  for (const classic::ClassInfo& one : all) names.push_back(one.full());
  EXPECT_EQ(names, (std::vector<std::string>{"a::b::S", "a::b::S::Inner", "a::T", "a::T::Local", "U", "Step"}));
  ASSERT_FALSE(all.empty());
  EXPECT_EQ(all[0].bases, (std::vector<std::string>{"x", "ParticleSystem", "Q", "int", "P"}));
}

TEST(Whole, ClassesAreTriedByNameAndThenAllOthersOfTheKind) {
  const std::string text =
      "class ClothSystem : public ParticleSystem {}; template <int N> struct Rule : TimeStepper {};\n"
      "struct ForwardEuler : Rule<1> {}; struct Other : Rule<2> {}; struct RK4 : TimeStepper {}; struct Spring {};\n"
      "class PendulumSystem : ParticleSystem {}; class Rope : PendulumSystem {}; class Boids : ParticleSystem {};";
  const classic::ClassList list = classic::classes_in(classic::tokens_of(text), "a.h");
  const auto tried = [&](const char* role, const std::map<std::string, std::string>& says = {}) {
    std::string names;
    for (const auto& one : candidates(list, classic::role_of(role), says))
      names += one.of->name + (one.named ? "! " : " ");
    return names;
  };
  EXPECT_EQ(tried("euler"), "ForwardEuler! Rule Other ");
  EXPECT_EQ(tried("cloth"), "ClothSystem! Rope Boids ");
  EXPECT_EQ(tried("pendulum"), "PendulumSystem! Rope Boids ");
  EXPECT_EQ(tried("chain"), "PendulumSystem Rope Boids ");
  EXPECT_EQ(tried("chain", {{"chain", "Boids"}, {"cloth", "Sail"}}), "Boids! ");
  EXPECT_EQ(tried("simple"), "Rope Boids ");
}

/// All files are in one folder, to which includes are redirected. Error messages keep the student's own paths.
TEST(Whole, IncludesAreMetWhateverTheyAreCalled) {
  const TemporaryFolder here("test");
  const std::string long_name(4000, 'x');
  const std::string odd = "#include \"../A.H\"\n#include <time.h>\n#include \"C:\\x\\Time.h\"\n#include <GL/GLUT.h>\n" +
                          ("#include \"" + long_name + "/a.h\"\n#include \"particlesystem.h\"\n# include <vector>\n") +
                          "#include \"/etc/shadow\"\n";
  const classic::BuildPlan plan({{"A.h", "class ClothSystem {};"}, {"src/Time.h", ""}, {"b.cpp", odd}},
                                here.path / "tree", folder_of_coursework());
  EXPECT_EQ(content_of_file(here.path / "tree/in/his/b.cpp"),
            "#line 1 \"/handed-in/b.cpp\"\n#include \"a.h\"\n#include <time.h>\n#include \"time.h\"\n#include "
            "<GL/glut.h>\n#include \"a.h\"\n#include \"particlesystem.h\"\n# include <vector>\n#include \"shadow\"\n");
  ASSERT_TRUE(named(plan.classes(), "ParticleSystem"));
  EXPECT_TRUE(named(plan.classes(), "ParticleSystem")->ours);
  EXPECT_FALSE(named(plan.classes(), "TimeStepper"));
}

TEST(Whole, NamesOfDrawingThatTheCompilerMissesAreDeclaredOnce) {
  const TemporaryFolder here("test");
  const classic::BuildPlan plan({{"b.cpp", ""}}, here.path / "tree", folder_of_coursework());
  const std::string said =
      "/handed-in/b.cpp:3:4: error: 'glFoo' was not declared in this scope; did you mean 'glFog'?\n"
      "/handed-in/b.cpp:4:4: error: use of undeclared identifier 'GL_BAR'\n"
      "/handed-in/b.cpp:5:4: error: 'glance' was not declared in this scope\n";
  EXPECT_TRUE(plan.declare_drawing(said));
  EXPECT_FALSE(plan.declare_drawing(said));
  const std::string names = content_of_file(here.path / "tree/in/names.h");
  EXPECT_NE(names.find("CLASSIC_NOTHING(glFoo)\n#define GL_BAR "), std::string::npos) << names;
  EXPECT_EQ(names.find("glance"), std::string::npos) << names;
}

}  // namespace
}  // namespace coursework
