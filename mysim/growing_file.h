// A file that is written piece by piece while a run goes on, and is seen only when it is whole.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

namespace crosscheck {

/// Until finish() it has no name, or, where file systems know no nameless files, a temporary one beside the file: a
/// killed run leaves no half file. Everything throws InputError that names the file when it cannot be written.
class GrowingFile {
 public:
  /// Makes the folder where it is missing.
  explicit GrowingFile(std::filesystem::path file);
  /// What was not finished is gone.
  ~GrowingFile();
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  void append(std::string_view bytes);
  /// Writes over the first bytes; there must be as many.
  void rewrite_beginning(std::string_view bytes);
  /// Puts the file under its name, in place of one that was there. Nothing can be appended afterwards.
  void finish();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  [[noreturn]] void fail(const std::string& why) const;

  std::filesystem::path file_, temporary_;
  bool named_ = false;  // the temporary name is there
  std::unique_ptr<std::FILE, Close> out_;
};

}  // namespace crosscheck
