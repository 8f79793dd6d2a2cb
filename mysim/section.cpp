// The only file that knows TOML: Section on top of toml++.
#include "mysim/section.h"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "mysim/errors.h"

namespace crosscheck {

struct Section::Node {
  std::shared_ptr<const toml::table> root;  // keeps the tree alive
  std::shared_ptr<const std::string> text;
  const toml::table* table = nullptr;
  std::string file;
  std::string path;                                     // dotted name of this table; empty at the root
  mutable std::set<std::string, std::less<>> read;      // every key that was asked for
  mutable std::vector<std::shared_ptr<Node>> children;  // so that finish() sees what was read below
  mutable std::map<std::string, std::vector<std::shared_ptr<Node>>, std::less<>> made;

  std::string full(std::string_view key) const {
    return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
  }

  [[noreturn]] void fail_at(const toml::source_region& where, std::string_view key, const std::string& expected) const {
    throw InputError(fmt::format("{}:{}: {}: {}", file, where.begin.line, full(key), expected));
  }

  const toml::node& need(std::string_view key, const char* expected) const {
    read.emplace(key);
    if (const toml::node* n = table->get(key)) return *n;
    fail_at(table->source(), key, fmt::format("is missing; expected {}", expected));
  }

  double finite(const toml::node& n, std::string_view key, const char* expected) const {
    const auto value = n.value<double>();
    if (const auto* word = n.as_string(); word && word->get() == "fit")
      fail_at(n.source(), key,
              fmt::format("expected {}; \"fit\" is for `crosscheck advise`, which finds it from [wish]", expected));
    if (!value || !(n.is_floating_point() || n.is_integer()) || !std::isfinite(*value))
      fail_at(n.source(), key, fmt::format("expected {}, got {}", expected, shown(n)));
    return *value;
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

  static std::string shown(const toml::node& n) {
    std::ostringstream out;
    n.visit([&](const auto& v) { out << v; });
    std::string text = out.str();
    for (char& c : text)
      if (c == '\n') c = ' ';
    return text.size() > 40 ? text.substr(0, 37) + "..." : text;
  }
};

namespace {
std::shared_ptr<const toml::table> parse(std::string_view text, const std::string& name) {
  try {
    return std::make_shared<const toml::table>(toml::parse(text, name));
  } catch (const toml::parse_error& e) {
    throw InputError(fmt::format("{}:{}: not valid TOML: {}", name, e.source().begin.line, e.description()));
  }
}
}  // namespace

Section::Section(std::shared_ptr<Node> node) : node_(std::move(node)) {}

Section Section::parse_text(std::string_view text, const std::string& name) {
  auto node = std::make_shared<Node>();
  node->root = parse(text, name);
  node->text = std::make_shared<const std::string>(text);
  node->table = node->root.get();
  node->file = name;
  return Section(node);
}

Section Section::parse_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::stringstream text;
  if (!in || !(text << in.rdbuf()))
    throw InputError(fmt::format("{}: cannot be read; expected a scene file (TOML)", file.string()));
  return parse_text(text.str(), file.string());
}

const std::string& Section::source() const { return *node_->text; }

bool Section::has(std::string_view key) const {
  node_->read.emplace(key);
  return node_->table->contains(key);
}

double Section::number(std::string_view key) const {
  constexpr auto expected = "a finite number";
  return node_->finite(node_->need(key, expected), key, expected);
}

double Section::positive(std::string_view key) const {
  constexpr auto expected = "a number above zero";
  const toml::node& n = node_->need(key, expected);
  const double value = node_->finite(n, key, expected);
  if (!(value > 0)) node_->fail_at(n.source(), key, fmt::format("expected {}, got {}", expected, value));
  return value;
}

double Section::not_negative(std::string_view key) const {
  constexpr auto expected = "a number not below zero";
  const toml::node& n = node_->need(key, expected);
  const double value = node_->finite(n, key, expected);
  if (!(value >= 0)) node_->fail_at(n.source(), key, fmt::format("expected {}, got {}", expected, value));
  return value;
}

int Section::count(std::string_view key) const {
  constexpr auto expected = "a whole number from 1 to 100000000";
  const toml::node& n = node_->need(key, expected);
  const auto value = n.is_integer() ? n.value<int64_t>() : std::nullopt;
  if (!value || *value < 1 || *value > 100000000)
    node_->fail_at(n.source(), key, fmt::format("expected {}, got {}", expected, Node::shown(n)));
  return static_cast<int>(*value);
}

std::string Section::text(std::string_view key) const {
  constexpr auto expected = "a text in quotes";
  const toml::node& n = node_->need(key, expected);
  const auto* value = n.as_string();
  if (!value || value->get().empty())
    node_->fail_at(n.source(), key, fmt::format("expected {}, got {}", expected, Node::shown(n)));
  return value->get();
}

Vec3 Section::vec3(std::string_view key) const {
  constexpr auto expected = "three finite numbers [x, y, z]";
  const toml::node& n = node_->need(key, expected);
  const toml::array* values = n.as_array();
  if (!values || values->size() != 3)
    node_->fail_at(n.source(), key, fmt::format("expected {}, got {}", expected, Node::shown(n)));
  Vec3 v;
  for (int i = 0; i < 3; ++i) v[i] = node_->finite((*values)[i], key, expected);
  return v;
}

std::vector<int> Section::integers(std::string_view key) const {
  constexpr auto expected = "a list of whole numbers from 0";
  const toml::node& n = node_->need(key, expected);
  const toml::array* values = n.as_array();
  if (!values) node_->fail_at(n.source(), key, fmt::format("expected {}, got {}", expected, Node::shown(n)));
  std::vector<int> list;
  for (const toml::node& item : *values) {
    const auto value = item.is_integer() ? item.value<int64_t>() : std::nullopt;
    if (!value || *value < 0 || *value > 100000000)
      node_->fail_at(n.source(), key, fmt::format("expected {}, got {}", expected, Node::shown(n)));
    list.push_back(static_cast<int>(*value));
  }
  return list;
}

Section Section::section(std::string_view key) const {
  const toml::node& n = node_->need(key, "a table");
  const toml::table* t = n.as_table();
  if (!t) node_->fail_at(n.source(), key, fmt::format("expected a table, got {}", Node::shown(n)));
  auto& made = node_->made[std::string(key)];
  if (made.empty()) made.push_back(node_->child(*t, node_->full(key)));
  return Section(made.front());
}

std::vector<Section> Section::sections(std::string_view key) const {
  std::vector<Section> list;
  if (!has(key)) return list;
  const toml::node& n = node_->need(key, "tables");
  const toml::array* tables = n.as_array();
  auto& made = node_->made[std::string(key)];
  for (size_t i = 0; tables && i < tables->size(); ++i) {
    const toml::table* t = (*tables)[i].as_table();
    if (!t) break;
    if (made.size() <= i) made.push_back(node_->child(*t, fmt::format("{}[{}]", node_->full(key), i)));
    list.push_back(Section(made[i]));
  }
  if (!tables || list.size() != tables->size())
    node_->fail_at(n.source(), key, fmt::format("expected tables [[{}]], got {}", node_->full(key), Node::shown(n)));
  return list;
}

std::vector<Section> Section::one_or_more(std::string_view key) const {
  return node_->need(key, "a table").is_table() ? std::vector{section(key)} : sections(key);
}

void Section::fail(std::string_view key, const std::string& expected) const {
  const toml::node* n = node_->table->get(key);
  node_->fail_at(n ? n->source() : node_->table->source(), key, fmt::format("expected {}", expected));
}

void Section::finish() const {
  for (const auto& [key, value] : *node_->table)
    if (!node_->read.contains(std::string_view(key.str()))) {
      std::string known;
      for (const std::string& k : node_->read) known += (known.empty() ? "" : ", ") + k;
      throw InputError(fmt::format("{}:{}: {}: unknown key; expected one of: {}", node_->file, key.source().begin.line,
                                   node_->full(key.str()), known));
    }
  for (const auto& child : node_->children) Section(child).finish();
}

struct Document::Tree {
  toml::table root;
  std::string file;

  /// The table that a path's last key stands in, and that key.
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

Document::Document(std::string_view text, const std::string& name)
    : tree_(std::make_shared<Tree>(Tree{*parse(text, name), name})) {}

bool Document::has(std::string_view path) const { return static_cast<bool>(tree_->root.at_path(path)); }
void Document::set(std::string_view path, double value) { tree_->assign(path, value); }
void Document::set(std::string_view path, const std::string& value) { tree_->assign(path, value); }
void Document::set(std::string_view path, const std::vector<int>& values) {
  toml::array list;
  for (const int value : values) list.push_back(value);
  tree_->assign(path, std::move(list));
}
void Document::erase(std::string_view path) { erase_from(&tree_->root, path); }

std::vector<std::string> Document::where(std::string_view value) const {
  std::vector<std::string> out;
  find_text(tree_->root, value, "", out);
  return out;
}

std::string Document::text() const {
  std::ostringstream out;
  out << tree_->root << "\n";
  return out.str();
}

}  // namespace crosscheck
