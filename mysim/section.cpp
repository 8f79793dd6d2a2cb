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
    if (!value || !(n.is_floating_point() || n.is_integer()) || !std::isfinite(*value))
      fail_at(n.source(), key, fmt::format("expected {}, got {}", expected, shown(n)));
    return *value;
  }

  std::shared_ptr<Node> child(const toml::table& t, const std::string& name) const {
    auto node = std::make_shared<Node>();
    node->root = root;
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

}  // namespace crosscheck
