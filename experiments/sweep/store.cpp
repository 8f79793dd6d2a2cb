// Files.
#include "experiments/sweep/store.h"

#include <fstream>
#include <sstream>

#include "experiments/sweep/rows_json.h"
#include "mysim/errors.h"
#include "mysim/files.h"

namespace crosscheck {
namespace {

std::optional<std::string> content_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace

std::optional<Rows> Store::find(const std::string& hash) const {
  const auto text = content_of(file_of(hash));
  if (!text) return std::nullopt;
  try {
    return read_rows(*text);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

void Store::keep(const std::string& hash, const Rows& rows) const {
  write_file(file_of(hash), rows_json(rows));
  forget_failure(hash);
}

void Store::forget_failure(const std::string& hash) const {
  std::error_code ignored;
  std::filesystem::remove(failure_file_of(hash), ignored);
}

void Store::keep_failure(const std::string& hash, const std::string& why) const {
  write_file(failure_file_of(hash), why);
}

std::optional<std::string> Store::failure_of(const std::string& hash) const {
  return content_of(failure_file_of(hash));
}

}  // namespace crosscheck
