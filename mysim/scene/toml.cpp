// The only file that includes a TOML library (toml++).
#include "mysim/scene/toml.h"

#include <fmt/ranges.h>
// parse errors are values, also in builds without exceptions
#define TOML_EXCEPTIONS 0
// toml++ asserts (and under NDEBUG lets clang assume) that header keys are well-formed, which depends on the file
#define TOML_ASSERT(expr) static_assert(true)
#pragma push_macro("NDEBUG")
#undef NDEBUG
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>

#include "mysim/base/errors.h"
#include "mysim/base/text.h"
#include "mysim/scene/keys.h"

namespace crosscheck {

namespace {

/// Text between two positions, which count code points from 1; on one line, shortened if long.
std::string written_between(std::string_view text, const toml::source_region& where) {
  std::size_t at = 0;
  for (toml::source_index line = 1; line < where.begin.line && at < text.size(); ++at) line += text[at] == '\n';
  const auto behind = [&](std::size_t from, toml::source_index columns) {
    for (; columns > 0 && from < text.size(); --columns) do
        ++from;
      while (from < text.size() && (static_cast<unsigned char>(text[from]) & 0xc0) == 0x80);
    return from;
  };
  const std::size_t begin = behind(at, where.begin.column - 1);
  for (toml::source_index line = where.begin.line; line < where.end.line && at < text.size(); ++at)
    line += text[at] == '\n';
  const std::size_t end = behind(at, where.end.column - 1);
  std::string out;
  for (std::size_t i = begin; i < end; ++i) {
    const bool blank = static_cast<unsigned char>(text[i]) <= ' ';
    if (!blank || (!out.empty() && out.back() != ' ')) out += blank ? ' ' : text[i];
  }
  while (!out.empty() && out.back() == ' ') out.pop_back();
  if (out.size() <= 40) return out;
  std::size_t cut = 37;
  while (cut > 0 && (static_cast<unsigned char>(out[cut]) & 0xc0) == 0x80) --cut;
  return out.substr(0, cut) + "...";
}

std::string as_written(const toml::node& n, std::string_view text) {
  if (n.is_table() && !n.as_table()->is_inline()) return "a table";
  if (n.is_array_of_tables()) return "tables";
  return written_between(text, n.source());
}

/// Appends a semicolon, so that a sentence can follow, unless the text is a question.
std::string and_then(const std::string& question) { return question.ends_with('?') ? question : question + ";"; }

/// Hint for a value that is no number but looks like one.
std::string mended_number(const toml::node& n) {
  if (const auto* word = n.as_string()) {
    const std::string& text = word->get();
    const auto from = text.find_first_not_of(" +");
    if (from == std::string::npos) return "";
    char* rest = nullptr;
    std::strtod(text.c_str() + from, &rest);
    const auto used = static_cast<std::size_t>(rest - text.c_str());
    if (used == from) return "; numbers are written without quotes";
    const std::string number = text.substr(from, used - from), unit = text.substr(used);
    if (unit.find_first_not_of(' ') == std::string::npos)
      return fmt::format("; numbers are written without quotes: {}", number);
    return "; a number is written alone, without quotes and without its unit";
  }
  if (const auto* list = n.as_array(); list && list->size() == 1 && list->is_homogeneous())
    return "; a single number is written without brackets";
  return "";
}

/// The known key in a line of the text, according to the headers above this line; null if the line has no known key.
const Key* key_in_line(std::string_view text, int line, std::span<const Key> keys) {
  std::span<const Key> here = keys;
  const auto find = [](std::span<const Key> among, std::string_view name) {
    const auto found = std::find_if(among.begin(), among.end(), [&](const Key& key) { return key.name == name; });
    return found == among.end() ? nullptr : &*found;
  };
  int i = 0;
  for (const std::string& at : split(text, '\n')) {
    if (++i > line) break;
    const std::size_t from = at.find_first_not_of(" \t");
    if (from == std::string::npos) continue;
    if (at[from] != '[') {
      const std::size_t end = at.find_first_of(" \t=:", from);
      if (i == line) return find(here, std::string_view(at).substr(from, end - from));
      continue;
    }
    here = keys;
    std::string path = at.substr(std::min(at.find_first_not_of("[ ", from), at.size()));
    path = path.substr(0, path.find_first_of("] \r")) + ".";
    for (std::size_t dot; (dot = path.find('.')) != std::string::npos; path = path.substr(dot + 1)) {
      const Key* table = find(here, path.substr(0, dot));
      here = table ? table->below : std::span<const Key>();
    }
  }
  return nullptr;
}

std::shared_ptr<const toml::table> parse(std::string_view text, const std::string& name,
                                         std::span<const Key> keys = {}) {
  if (const auto deep = too_deep_key(text))
    throw InputError(fmt::format("{}:{}: not valid TOML: {}", name, deep->line, deep->what));
  toml::parse_result parsed = toml::parse(text, name);
  if (parsed) return std::make_shared<const toml::table>(std::move(parsed).table());
  const toml::parse_error& e = parsed.error();
  TomlError fault = diagnose_toml(text, static_cast<int>(e.source().begin.line), e.description());
  if (const Key* key = key_in_line(text, fault.line, keys); key && key->kind == Key::Kind::value) {
    // quotes do not turn a word into the expected number
    if (fault.what.starts_with("expected a text in quotes") && key->expected.find('"') == std::string_view::npos &&
        key->expected.find("quotes") == std::string_view::npos)
      fault.what = "unexpected word" + fault.what.substr(fault.what.find("; the line"));
    fault.what += fmt::format("; {} is {}", key->name, key->expected);
  }
  throw InputError(fmt::format("{}:{}: not valid TOML: {}", name, fault.line, fault.what));
}

std::string full_key(const std::string& path, std::string_view key) {
  return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
}

}  // namespace

struct TomlTable::Node {
  std::shared_ptr<const toml::table> root;  // keeps the tree alive
  std::shared_ptr<const std::string> text;
  const toml::table* table = nullptr;
  std::string file;
  std::string path;                                     // dotted name of this table; empty at the root
  mutable std::set<std::string, std::less<>> read;      // every key that was looked up
  mutable std::vector<std::shared_ptr<Node>> children;  // tables read below this one, for finish()
  mutable std::map<std::string, std::vector<std::shared_ptr<Node>>, std::less<>> made;

  std::string full(std::string_view key) const { return full_key(path, key); }

  [[noreturn]] void fail_at(const toml::source_region& where, std::string_view key, const std::string& expected) const {
    throw InputError(fmt::format("{}:{}: {}: {}", file, where.begin.line, full(key), expected));
  }

  [[noreturn]] void refuse(const toml::node& n, std::string_view key, std::string_view expected,
                           const std::string& hint = "") const {
    fail_at(n.source(), key, fmt::format("expected {}, got {}{}", expected, as_written(n, *text), hint));
  }

  const toml::node& need(std::string_view key, std::string_view expected) const {
    read.emplace(key);
    if (const toml::node* n = table->get(key)) return *n;
    fail_at(table->source(), key, fmt::format("is missing; expected {}", expected));
  }

  double finite(const toml::node& n, std::string_view key, std::string_view expected) const {
    const auto value = n.value<double>();
    if (const auto* word = n.as_string(); word && word->get() == "fit")
      fail_at(n.source(), key,
              fmt::format("expected {}; \"fit\" is for `crosscheck advise`, which finds it from [wish]", expected));
    if (!value || !(n.is_floating_point() || n.is_integer()) || !std::isfinite(*value))
      refuse(n, key, expected, mended_number(n));
    return *value;
  }

  int whole(const toml::node& n, std::string_view key, int least, int most) const {
    const auto value = n.is_integer() ? n.value<int64_t>() : std::nullopt;
    if (value && *value >= least && *value <= most) return static_cast<int>(*value);
    std::string hint = n.is_integer() || n.is_floating_point() ? "" : mended_number(n);
    if (const auto decimal = n.is_floating_point() ? n.value<double>() : std::nullopt;
        decimal && *decimal >= least && *decimal <= most && *decimal == std::floor(*decimal))
      hint = fmt::format("; a whole number has no point and no exponent: {:.0f}", *decimal);
    refuse(n, key, fmt::format("a whole number from {} to {}", least, most), hint);
  }

  std::shared_ptr<Node> child(const toml::table& t, const std::string& name) const {
    auto node = std::make_shared<Node>();
    node->root = root;
    node->text = text;
    node->table = &t;
    node->file = file;
    node->path = name;
    children.push_back(node);
    return node;
  }
};

TomlTable::TomlTable(std::shared_ptr<Node> node) : node_(std::move(node)) {}

TomlTable TomlTable::parse_text(std::string_view text, const std::string& name) {
  auto node = std::make_shared<Node>();
  node->root = parse(text, name);
  node->text = std::make_shared<const std::string>(text);
  node->table = node->root.get();
  node->file = name;
  return TomlTable(node);
}

const std::string& TomlTable::source() const { return *node_->text; }

bool TomlTable::has(std::string_view key) const {
  node_->read.emplace(key);
  return node_->table->contains(key);
}

double TomlTable::number(std::string_view key) const {
  constexpr auto expected = "a finite number";
  return node_->finite(node_->need(key, expected), key, expected);
}

double TomlTable::positive(std::string_view key) const {
  constexpr auto expected = "a number above zero";
  const toml::node& n = node_->need(key, expected);
  const double value = node_->finite(n, key, expected);
  if (!(value > 0)) node_->refuse(n, key, expected);
  return value;
}

double TomlTable::not_negative(std::string_view key) const {
  constexpr auto expected = "a number not below zero";
  const toml::node& n = node_->need(key, expected);
  const double value = node_->finite(n, key, expected);
  if (!(value >= 0)) node_->refuse(n, key, expected);
  return value;
}

int TomlTable::count(std::string_view key, int most) const {
  return node_->whole(node_->need(key, "a whole number from 1"), key, 1, most);
}

std::string TomlTable::text(std::string_view key, std::string_view expected) const {
  const toml::node& n = node_->need(key, expected);
  const auto* value = n.as_string();
  if (!value || value->get().empty()) node_->refuse(n, key, expected);
  return value->get();
}

Vec3 TomlTable::vec3(std::string_view key) const {
  constexpr auto expected = "three finite numbers [x, y, z]";
  const toml::node& n = node_->need(key, expected);
  const toml::array* values = n.as_array();
  if (!values) node_->refuse(n, key, expected);
  if (values->size() != 3) node_->refuse(n, key, expected, fmt::format(" ({} numbers)", values->size()));
  Vec3 v;
  for (int i = 0; i < 3; ++i) v[i] = node_->finite((*values)[i], fmt::format("{}[{}]", key, i), "a finite number");
  return v;
}

std::vector<int> TomlTable::integers(std::string_view key, int least) const {
  const std::string expected = fmt::format("a list of whole numbers from {0}, as in [{0}, {1}]", least, least + 1);
  const toml::node& n = node_->need(key, expected);
  const toml::array* values = n.as_array();
  if (!values) node_->refuse(n, key, expected);
  std::vector<int> list;
  for (const toml::node& item : *values)
    list.push_back(node_->whole(item, fmt::format("{}[{}]", key, list.size()), least, greatest_count));
  return list;
}

Eigen::VectorXd TomlTable::numbers(std::string_view key, int count) const {
  const std::string expected = fmt::format("a list of {} finite numbers", count);
  const toml::node& n = node_->need(key, expected);
  const toml::array* values = n.as_array();
  if (!values) node_->refuse(n, key, expected);
  if (values->size() != static_cast<size_t>(count))
    node_->fail_at(n.source(), key, fmt::format("expected {}, got {}", expected, values->size()));
  Eigen::VectorXd list(count);
  for (int i = 0; i < count; ++i)
    list[i] = node_->finite((*values)[i], fmt::format("{}[{}]", key, i), "a finite number");
  return list;
}

Points TomlTable::points(std::string_view key, int count) const {
  const toml::array* values = node_->need(key, fmt::format("a list of {} finite numbers", 3 * count)).as_array();
  if (!values || values->empty() || !values->front().is_array()) return numbers(key, 3 * count).reshaped(3, count);
  if (values->size() != static_cast<size_t>(count))
    fail(key, fmt::format("a list of {} triples [x, y, z], got {}", count, values->size()));
  Points points(3, count);
  for (int i = 0; i < count; ++i) {
    const std::string name = fmt::format("{}[{}]", key, i);
    const toml::array* triple = (*values)[i].as_array();
    if (!triple || triple->size() != 3) node_->refuse((*values)[i], name, "three finite numbers [x, y, z]");
    for (int axis = 0; axis < 3; ++axis)
      points(axis, i) = node_->finite((*triple)[axis], fmt::format("{}[{}]", name, axis), "a finite number");
  }
  return points;
}

TomlTable TomlTable::section(std::string_view key) const {
  const toml::node& n = node_->need(key, "a table");
  const toml::table* t = n.as_table();
  if (!t) node_->refuse(n, key, fmt::format("a table [{}]", node_->full(key)));
  auto& made = node_->made[std::string(key)];
  if (made.empty()) made.push_back(node_->child(*t, node_->full(key)));
  return TomlTable(made.front());
}

std::vector<TomlTable> TomlTable::sections(std::string_view key) const {
  std::vector<TomlTable> list;
  if (!has(key)) return list;
  const toml::node& n = node_->need(key, "tables");
  const toml::array* tables = n.as_array();
  auto& made = node_->made[std::string(key)];
  for (size_t i = 0; tables && i < tables->size(); ++i) {
    const toml::table* t = (*tables)[i].as_table();
    if (!t) break;
    if (made.size() <= i) made.push_back(node_->child(*t, fmt::format("{}[{}]", node_->full(key), i)));
    list.push_back(TomlTable(made[i]));
  }
  if (!tables || list.size() != tables->size()) node_->refuse(n, key, fmt::format("tables [[{}]]", node_->full(key)));
  return list;
}

std::vector<TomlTable> TomlTable::one_or_more(std::string_view key) const {
  return node_->need(key, "a table").is_table() ? std::vector{section(key)} : sections(key);
}

void TomlTable::fail(std::string_view key, const std::string& expected) const {
  // key[i] is an entry of a list, which may have a line of its own
  const toml::node* n = node_->table->get(key.substr(0, key.find('[')));
  if (const toml::node* entry = n ? (*node_->table).at_path(key).node() : nullptr) n = entry;
  const bool shown = n && n->is_value() && expected.find("got ") == std::string::npos;
  node_->fail_at(n ? n->source() : node_->table->source(), key,
                 fmt::format("expected {}{}", expected, shown ? ", got " + as_written(*n, *node_->text) : ""));
}

void TomlTable::finish() const {
  for (const auto& [key, value] : *node_->table)
    if (!node_->read.contains(std::string_view(key.str()))) {
      const std::vector<std::string> known(node_->read.begin(), node_->read.end());
      throw InputError(fmt::format("{}:{}: {}: unknown key{} expected one of: {}", node_->file, key.source().begin.line,
                                   node_->full(key.str()), and_then(did_you_mean(key.str(), known)),
                                   fmt::join(known, ", ")));
    }
  for (const auto& child : node_->children) TomlTable(child).finish();
}

namespace {

class KeyCheck {
 public:
  KeyCheck(std::string_view text, const std::string& file, std::span<const Key> keys)
      : text_(text), file_(file), all_(keys) {}

  void check(const toml::table& table, const std::string& path, std::span<const Key> keys) {
    around_.push_back(&table);
    names(table, path, keys);
    kinds(table, path, keys);
    for (const Key& key : keys) {
      const toml::node* n = table.get(key.name);
      if (!n || key.kind == Key::Kind::value) continue;
      const std::string below = full_key(path, key.name);
      if (n->is_table()) check(*n->as_table(), below, key.below);
      if (const toml::array* list = n->as_array())
        for (std::size_t i = 0; i < list->size(); ++i)
          check(*(*list)[i].as_table(), fmt::format("{}[{}]", below, i), key.below);
    }
    around_.pop_back();
  }

 private:
  /// The key as written in a file, with its expected content.
  static std::string written(const std::string& path, const Key& key) {
    std::string name = full_key(path, key.name), keys, more;
    // [sphere.motion] belongs to [[sphere]], without an index
    while (name.find('[') != std::string::npos) name.erase(name.find('['), name.find(']') - name.find('[') + 1);
    if (key.kind == Key::Kind::value) return fmt::format("{} = {}", key.name, key.expected);
    for (const Key& below : key.below)
      if (below.required) keys += (keys.empty() ? " with " : ", ") + written(name, below);
    const bool several = key.kind == Key::Kind::tables;
    return fmt::format("{}{}{}{}", several ? "[[" : "[", name, several ? "]]" : "]", keys);
  }
  [[noreturn]] void fail(toml::source_index line, const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}", file_, std::max<toml::source_index>(line, 1), what));
  }

  /// A key and a description of its table. owners() lists the keys that a file may have outside the table `here`.
  using Owned = std::pair<std::string, std::string>;
  void owners(std::span<const Key> keys, const std::string& path, const std::string& table, const std::string& here,
              std::vector<Owned>& out) const {
    for (const Key& k : keys) {
      if (path != here) out.emplace_back(k.name, table);
      const std::string below = full_key(path, k.name);
      if (k.kind != Key::Kind::value)
        owners(k.below, below, k.kind == Key::Kind::tables ? "[[" + below + "]]" : "[" + below + "]", here, out);
    }
  }

  /// Hint for an unknown key: the tables in which it, or else a similar key, is allowed; empty if there is none.
  std::string elsewhere(std::string_view key, const std::string& here) const {
    std::vector<Owned> all;
    owners(all_, "", "the top of the file, before the first [table]", here, all);
    std::vector<std::string> tables, names;
    for (const auto& [name, table] : all) {
      names.push_back(name);
      if (name == key) tables.push_back(table);
    }
    if (!tables.empty()) return fmt::format("; it belongs to {}", fmt::join(tables, " or "));
    if (key.size() < 6) return "";  // short words resemble too many keys
    const std::string meant = closest_match(key, names);
    for (const auto& [name, table] : all)
      if (name == meant) return fmt::format("; did you mean '{}' in {}?", name, table);
    return "";
  }

  /// True if the innermost table need not contain the key.
  bool may_miss(const Key& key) const {
    const auto has = [&](const toml::table* table) { return table->contains(key.unless); };
    return !key.required || (!key.unless.empty() && std::any_of(around_.begin(), around_.end(), has));
  }

  static std::string unless_clause(const Key& key) {
    const bool included = key.unless.empty() || key.expected.find(key.unless) != std::string_view::npos;
    return included ? "" : fmt::format(", unless the file has '{}'", key.unless);
  }

  /// Reports unknown and missing keys together, because they are often the same mistake.
  void names(const toml::table& table, const std::string& path, std::span<const Key> keys) const {
    std::vector<std::string> known, absent;
    for (const Key& key : keys) {
      known.emplace_back(key.name);
      if (!table.contains(key.name)) absent.emplace_back(key.name);
    }
    std::vector<const Key*> missing;
    for (const Key& key : keys)
      if (!table.contains(key.name) && !may_miss(key)) missing.push_back(&key);

    std::vector<std::pair<toml::source_index, std::string>> unknown;
    for (const auto& [key, value] : table) {
      if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
      std::string here = path;
      while (here.find('[') != std::string::npos) here.erase(here.find('['), here.find(']') - here.find('[') + 1);
      // a misspelt key more likely means a missing key than one that is present
      const std::string meant = closest_match(key.str(), absent);
      std::string hint = elsewhere(key.str(), here);
      const bool lacks = std::any_of(missing.begin(), missing.end(), [&](const Key* k) { return k->name == meant; });
      if (lacks || !hint.starts_with("; it belongs")) {
        if (!meant.empty())
          hint = fmt::format("; did you mean '{}'?", meant);
        else if (const std::string there = did_you_mean(key.str(), known); !there.empty())
          hint = there;
        std::erase_if(missing, [&](const Key* k) { return k->name == meant; });
      }
      unknown.emplace_back(key.source().begin.line, fmt::format("{}: unknown key{}", full_key(path, key.str()), hint));
    }
    // if the keys of a missing table are present, only its header is missing
    const auto only_header = [&](const Key& key) {
      return std::any_of(unknown.begin(), unknown.end(), [&](const auto& one) {
        return one.second.ends_with(fmt::format("; it belongs to [{}]", full_key(path, key.name)));
      });
    };
    std::string lacking;
    for (const Key* key : missing) {
      lacking += (lacking.empty() ? "" : ", ") +
                 (only_header(*key) ? fmt::format("the line [{}] above them", full_key(path, key->name))
                                    : written(path, *key));
      for (const Key& other : keys)
        if (other.name == key->unless && other.kind != Key::Kind::value)
          lacking += fmt::format(" (or {} in its place)", written(path, other));
    }
    if (!unknown.empty()) {
      std::sort(unknown.begin(), unknown.end());
      std::string what = fmt::format("{} expected one of: {}", and_then(unknown[0].second), fmt::join(known, ", "));
      for (std::size_t i = 1; i < unknown.size(); ++i)
        what += fmt::format("; line {}: {}", unknown[i].first, unknown[i].second);
      if (!lacking.empty()) what += fmt::format("; also missing: {}", lacking);
      fail(unknown[0].first, what);
    }
    if (missing.empty()) return;
    std::string which;
    for (const Key* key : missing) which += (which.empty() ? "" : ", ") + full_key(path, key->name);
    const bool one_value = missing.size() == 1 && missing[0]->kind == Key::Kind::value;
    fail(table.source().begin.line,
         fmt::format("{}: {} missing; expected {}", which, missing.size() == 1 ? "is" : "are",
                     one_value ? std::string(missing[0]->expected) + unless_clause(*missing[0]) : lacking));
  }

  /// Reports values that should be tables, and single tables that should be arrays.
  void kinds(const toml::table& table, const std::string& path, std::span<const Key> keys) const {
    for (const Key& key : keys) {
      const toml::node* n = table.get(key.name);
      if (!n || key.kind == Key::Kind::value) continue;
      const bool tables = n->is_array() && (n->is_array_of_tables() || n->as_array()->empty());
      const bool good = key.kind == Key::Kind::table    ? n->is_table()
                        : key.kind == Key::Kind::tables ? tables
                                                        : n->is_table() || tables;
      if (good) continue;
      const std::string name = full_key(path, key.name);
      std::string got = as_written(*n, text_), hint;
      if (n->is_table() && !n->as_table()->is_inline()) {
        got = fmt::format("[{}]", name);
        hint = "; each table begins with a line in double brackets";
      } else if (tables && !n->as_array()->empty()) {
        got = fmt::format("[[{}]]", name);
        hint = "; only one is allowed, in single brackets";
        std::vector<std::string> several;
        for (const Key& other : keys)
          if (other.kind != Key::Kind::value && other.kind != Key::Kind::table) several.emplace_back(other.name);
        if (const std::string meant = closest_match(key.name, several); !meant.empty())
          hint += fmt::format("; did you mean [[{}]]?", meant);
      } else if (!key.below.empty() && n->is_number() && key.below[0].expected.starts_with("a number")) {
        hint = fmt::format("; in one line: {} = {{ {} = {} }}", key.name, key.below[0].name, got);
      }
      fail(n->source().begin.line,
           fmt::format("{}: expected {}, got {}{}", name,
                       (key.kind == Key::Kind::tables ? "tables " : "a table ") + written(path, key), got, hint));
    }
  }

  std::string_view text_;
  const std::string& file_;
  std::span<const Key> all_;
  std::vector<const toml::table*> around_;  // the table being checked, and the enclosing ones
};

}  // namespace

void check_keys(std::string_view text, const std::string& name, std::span<const Key> keys) {
  const auto root = parse(text, name, keys);
  try {
    KeyCheck(text, name, keys).check(*root, "", keys);
  } catch (const InputError& error) {
    if (!root->empty()) throw;
    const std::string what = error.what();
    throw InputError(fmt::format("{}: the file is empty{}: {}", name, text.empty() ? "" : " except for comments",
                                 what.substr(what.find(": ", name.size() + 1) + 2)));
  }
}

struct TomlDocument::Tree {
  toml::table root;
  std::string file;

  /// The table of a path's last key, and that key.
  std::pair<toml::table&, std::string_view> parent(std::string_view path) {
    const size_t dot = path.rfind('.');
    if (dot == std::string_view::npos) return {root, path};
    auto* table = root.at_path(path.substr(0, dot)).as_table();
    if (!table) throw InputError(fmt::format("{}: {}: no such table", file, path.substr(0, dot)));
    return {*table, path.substr(dot + 1)};
  }
  template <class T>
  void assign(std::string_view path, T&& value) {
    auto [table, key] = parent(path);
    table.insert_or_assign(key, std::forward<T>(value));
  }
};

namespace {
void erase_from(toml::node* node, std::string_view path) {
  if (!node || !node->is_table()) return;
  toml::table& table = *node->as_table();
  const size_t dot = path.find('.');
  if (dot == std::string_view::npos) {
    table.erase(path);
    return;
  }
  std::string_view key = path.substr(0, dot);
  if (key.ends_with("[]")) key.remove_suffix(2);
  toml::node* below = table.get(key);
  if (below && below->is_array())
    for (toml::node& item : *below->as_array()) erase_from(&item, path.substr(dot + 1));
  else
    erase_from(below, path.substr(dot + 1));
}

void find_text(const toml::node& node, std::string_view value, const std::string& path, std::vector<std::string>& out) {
  if (const auto* text = node.as_string(); text && text->get() == value) out.push_back(path);
  if (const auto* table = node.as_table())
    for (const auto& [key, below] : *table)
      find_text(below, value, path.empty() ? std::string(key.str()) : fmt::format("{}.{}", path, key.str()), out);
  if (const auto* array = node.as_array())
    for (size_t i = 0; i < array->size(); ++i) find_text((*array)[i], value, fmt::format("{}[{}]", path, i), out);
}
}  // namespace

TomlDocument::TomlDocument(std::string_view text, const std::string& name)
    : tree_(std::make_shared<Tree>(Tree{*parse(text, name), name})) {}

bool TomlDocument::has(std::string_view path) const { return static_cast<bool>(tree_->root.at_path(path)); }
void TomlDocument::set(std::string_view path, double value) { tree_->assign(path, value); }
void TomlDocument::set(std::string_view path, const std::string& value) { tree_->assign(path, value); }
void TomlDocument::set(std::string_view path, const std::vector<int>& values) {
  toml::array list;
  for (const int value : values) list.push_back(value);
  tree_->assign(path, std::move(list));
}
void TomlDocument::erase(std::string_view path) { erase_from(&tree_->root, path); }

std::vector<std::string> TomlDocument::where(std::string_view value) const {
  std::vector<std::string> out;
  find_text(tree_->root, value, "", out);
  return out;
}

std::string TomlDocument::text() const {
  std::ostringstream out;
  out << tree_->root << "\n";
  return out.str();
}

}  // namespace crosscheck
