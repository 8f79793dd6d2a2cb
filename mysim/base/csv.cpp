#include "mysim/base/csv.h"

namespace crosscheck {

std::string csv_quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

std::string csv_field(const std::string& text) {
  return text.find_first_of(",\"\n\r") == std::string::npos ? text : csv_quoted(text);
}

std::optional<std::vector<CsvField>> csv_record(std::string_view text, std::size_t& at) {
  std::vector<CsvField> fields(1);
  bool within = false;
  for (; at < text.size() && (within || text[at] != '\n'); ++at) {
    CsvField& field = fields.back();
    if (text[at] == '"' && within && text.substr(at + 1).starts_with('"'))
      field.text += text[at++];
    else if (text[at] == '"')
      within = !within, field.quoted = true;
    else if (text[at] == ',' && !within)
      fields.emplace_back();
    else
      field.text += text[at];
  }
  if (within) return std::nullopt;
  return fields;
}

}  // namespace crosscheck
