// Folds and drawings, made smaller.
#include "report/page/smaller.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

#include "mysim/base/json.h"
#include "mysim/base/text.h"
#include "report/page/page.h"
#include "report/player/packed_numbers.h"

namespace crosscheck {

std::string with_folds_packed(const std::string& page) {
  constexpr std::string_view begin = "<template", close = "</template>",
                             end_of_body = "<script type=\"text/plain\" id=\"charts\"";
  std::string out;
  Json held = Json::array();
  size_t count = 0, from = 0;
  const auto finish = page.find(end_of_body);
  if (finish == std::string::npos) return page;
  for (size_t at = page.find(begin); at < finish; at = page.find(begin, from)) {
    const size_t inside = page.find('>', at) + 1;
    // up to the end that belongs to it: templates lie in templates
    size_t end = inside;
    for (int depth = 1; depth > 0;) {
      const size_t next = page.find(begin, end), last = page.find(close, end);
      if (last == std::string::npos) return page;
      depth += next < last ? 1 : -1;
      end = next < last ? next + begin.size() : last + close.size();
    }
    out += page.substr(from, inside - 1 - from) + fmt::format(" data-held=\"{}\"></template>", count++);
    held.push_back(page.substr(inside, end - close.size() - inside));
    from = end;
  }
  if (count == 0) return page;
  return out + page.substr(from, finish - from) +
         fmt::format("<script type=\"text/plain\" id=\"held\">{}</script>\n", base64(gzipped(dump(held)))) +
         page.substr(finish);
}

std::string svg_element(std::string_view file, const std::string& label) {
  const size_t begin = file.find("<svg");
  if (begin == std::string_view::npos) return "";
  std::string out = fmt::format("<svg role=\"img\" aria-label=\"{}\"", escaped(label));
  bool blank = false, in_tag = true;
  for (size_t at = begin + 4; at < file.size(); ++at) {
    const char sign = file[at];
    const bool space = sign == '\n' || sign == '\t' || sign == ' ';
    in_tag = sign == '<' || (in_tag && sign != '>');
    const bool in_number = sign == '.' && at + 1 < file.size() && file[at + 1] >= '0' && file[at + 1] <= '9';
    if (in_tag && in_number) {  // of a coordinate: no zeros at its end
      const size_t end = std::min(file.find_first_not_of("0123456789", at + 1), file.size());
      std::string_view part = file.substr(at, end - at);
      part.remove_suffix(part.size() - 1 - part.find_last_not_of('0'));
      if (part.size() > 1) out.append(part);
      at = end - 1;
    } else if (!space || !blank) {
      out += space ? ' ' : sign;
    }
    blank = space;
  }
  // inside HTML the names of the languages are known
  for (const std::string_view name : {" xmlns=\"", " xmlns:xlink=\""})
    for (size_t at; (at = out.find(name)) != std::string::npos;)
      out.erase(at, out.find('"', at + name.size()) + 1 - at);
  return out;
}

}  // namespace crosscheck
