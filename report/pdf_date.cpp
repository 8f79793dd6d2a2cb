// Finds the date in the bytes and writes another one over it.
#include "report/pdf_date.h"

#include <fstream>
#include <iterator>

#include "mysim/files.h"

namespace crosscheck {

void undate(const std::filesystem::path& pdf) {
  std::ifstream in(pdf, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::string key = "/CreationDate (D:", date = "19700101000000";
  const size_t at = text.find(key);
  if (at == std::string::npos) return;
  text.replace(at + key.size(), date.size(), date);
  write_file(pdf, text);
}

}  // namespace crosscheck
