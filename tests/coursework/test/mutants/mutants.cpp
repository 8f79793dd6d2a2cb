// A tokeniser for the C++ of the solutions, and the mutation rules.
#include "tests/coursework/test/mutants/mutants.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <map>
#include <set>

#include "mysim/base/errors.h"

namespace coursework {
namespace {

using std::size_t;
using std::string;

enum class Kind { name, whole, decimal, sign, quoted, end };

struct Token {
  Kind kind = Kind::end;
  size_t begin = 0, end = 0;
  string text;
};

bool in_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

/// Tokens without comments and preprocessor lines.
std::vector<Token> tokens_of(const string& s) {
  static const char* signs[] = {
      "<<=", ">>=", "->", "++", "--", "+=", "-=", "*=", "/=", "==", "!=", "<=", ">=", "&&", "||", "::", "<<", ">>"};
  std::vector<Token> tokens;
  for (size_t i = 0; i < s.size();) {
    size_t end = i + 1;
    Kind kind = Kind::sign;
    if (std::isspace(static_cast<unsigned char>(s[i]))) {
      ++i;
      continue;
    }
    if (s[i] == '#' || s.compare(i, 2, "//") == 0) {
      i = std::min(s.size(), s.find('\n', i));
      continue;
    }
    if (s[i] == '"' || s[i] == '\'') {
      kind = Kind::quoted;
      while (end < s.size() && s[end] != s[i]) end += s[end] == '\\' ? 2 : 1;
      ++end;
    } else if (std::isdigit(static_cast<unsigned char>(s[i]))) {
      while (end < s.size() && (in_name(s[end]) || s[end] == '.' || (s[end] == '-' && s[end - 1] == 'e'))) ++end;
      kind = s.substr(i, end - i).find_first_of(".ef") == string::npos ? Kind::whole : Kind::decimal;
    } else if (in_name(s[i])) {
      kind = Kind::name;
      while (end < s.size() && in_name(s[end])) ++end;
    } else {
      for (const string sign : signs)
        if (s.compare(i, sign.size(), sign) == 0) {
          end = i + sign.size();
          break;
        }
    }
    tokens.push_back({kind, i, end, s.substr(i, end - i)});
    i = end;
  }
  tokens.push_back({Kind::end, s.size(), s.size(), ""});
  return tokens;
}

string trimmed(const string& text) {
  const size_t begin = text.find_first_not_of(" \n"), end = text.find_last_not_of(" \n");
  return begin == string::npos ? "" : text.substr(begin, end - begin + 1);
}

class Mutation {
 public:
  explicit Mutation(const string& source) : s_(source), t_(tokens_of(source)) {}

  std::vector<Mutant> all() {
    for (size_t i = 0; i + 1 < t_.size(); ++i) {
      operators(i);
      constants(i);
      names(i);
      terms(i);
      types(i);
      counts(i);
      late(i);
    }
    statements();
    std::stable_sort(made_.begin(), made_.end(), [](const Mutant& a, const Mutant& b) { return a.line < b.line; });
    return made_;
  }

 private:
  const string& text(size_t i) const { return i < t_.size() ? t_[i].text : t_.back().text; }
  bool is(size_t i, std::initializer_list<const char*> which) const {
    return std::any_of(which.begin(), which.end(), [&](const char* one) { return text(i) == one; });
  }
  /// True if a value ends with this token, so that a following sign is a binary operator.
  bool value(size_t i) const {
    return (t_[i].kind == Kind::name && !is(i, {"return", "const", "case"})) || t_[i].kind == Kind::whole ||
           t_[i].kind == Kind::decimal || is(i, {")", "]"});
  }

  void add(const string& rule, size_t begin, size_t end, const string& instead) {
    Mutant one{rule, 0, "", "", s_.substr(0, begin) + instead + s_.substr(end)};
    one.line = static_cast<int>(std::count(s_.begin(), s_.begin() + static_cast<long>(begin), '\n')) + 1;
    const size_t from = begin == 0 ? 0 : s_.rfind('\n', begin - 1) + 1;
    const size_t to = std::min(s_.size(), s_.find('\n', std::max(begin + 1, end) - 1));
    if (is_free(from, to)) return;
    one.right = trimmed(s_.substr(from, to - from));
    one.wrong = trimmed(s_.substr(from, begin - from) + instead + (to > end ? s_.substr(end, to - end) : ""));
    for (string* each : {&one.right, &one.wrong}) std::replace(each->begin(), each->end(), '\n', ' ');
    if (one.source != s_ && seen_.insert(one.source).second) made_.push_back(std::move(one));
  }
  /// True for code that is not tested: constants outside of functions, whose values students choose (in classic), and
  /// drawing code.
  bool is_free(size_t from, size_t to) const {
    const size_t draw = s_.find("::draw()");
    return (s_.compare(from, 6, "const ") == 0 && s_.substr(from, to - from).find('(') == string::npos) || from > draw;
  }
  void instead(const string& rule, size_t i, const string& with) { add(rule, t_[i].begin, t_[i].end, with); }

  void operators(size_t i) {
    static const std::multimap<string, string> others{
        {"+", "-"},  {"-", "+"},   {"*", "/"},   {"/", "*"},   {"+=", "-="}, {"-=", "+="}, {"+=", "="},
        {"-=", "="}, {"*=", "/="}, {"/=", "*="}, {"<", "<="},  {"<", ">"},   {"<=", "<"},  {">", ">="},
        {">", "<"},  {">=", ">"},  {"==", "!="}, {"!=", "=="}, {"&&", "||"}, {"||", "&&"}};
    if (t_[i].kind != Kind::sign || i == 0) return;
    const bool two_sided = value(i - 1);
    if (is(i, {"-", "!"}) && !two_sided) return instead(text(i) == "-" ? "sign" : "operator", i, "");
    if (is(i, {"+", "-", "*", "/"}) && !two_sided) return;
    const auto [from, to] = others.equal_range(text(i));
    for (auto one = from; one != to; ++one)
      instead(is(i, {"+", "-", "+=", "-="}) ? "sign" : "operator", i, one->second);
  }

  void constants(size_t i) {
    if (t_[i].kind == Kind::whole) {
      const bool divides = i > 0 && text(i - 1) == "/";
      const long n = std::stol(text(i));
      const bool index = i > 0 && text(i - 1) == "[";
      instead(index ? "index" : "constant", i, std::to_string(n + 1));
      if (n > 0) instead(index ? "index" : "constant", i, std::to_string(n - 1));
      if (divides) add("integer division", t_[i - 1].begin, t_[i].end, "* (1 / " + text(i) + ")");
    } else if (t_[i].kind == Kind::decimal) {
      const string number = text(i).substr(0, text(i).find('f')), end = text(i).substr(number.size());
      const double value = std::stod(number);
      instead("constant", i, fmt::format("{}{}", value == 0 ? "1.0" : fmt::format("({} * 1.01)", number), end));
      if (value == std::floor(value) && (text(i + 1) == "/" || (i > 0 && text(i - 1) == "/")))
        instead("integer division", i, fmt::format("{}", static_cast<long>(value)));
    }
  }

  /// Swaps names that students confuse.
  void names(size_t i) {
    static const std::vector<std::vector<string>> alike{{"row", "column"},
                                                        {"rows", "columns"},
                                                        {"across", "down"},
                                                        {"a", "b"},
                                                        {"b", "c"},
                                                        {"c", "d"},
                                                        {"x", "v"},
                                                        {"f0", "f1"},
                                                        {"k1", "k2"},
                                                        {"k2", "k3"},
                                                        {"k3", "k4"},
                                                        {"mass", "drag"},
                                                        {"sin", "cos"},
                                                        {"min", "max"},
                                                        {"x", "y"},
                                                        {"i", "j"},
                                                        {"before", "proposed"},
                                                        {"i", "k"},
                                                        {"along", "tangential"},
                                                        {"radius", "margin"},
                                                        {"rest", "k"},
                                                        {"stiffness", "rest"},
                                                        {"spring", "s"},
                                                        {"landing", "x"},
                                                        {"ahead", "x"},
                                                        {"next", "state"},
                                                        {"structural", "shear"},
                                                        {"shear", "flexion"},
                                                        {"downward", "sideward"},
                                                        {"low", "high"},
                                                        {"coarse", "fine"},
                                                        {"slow", "fast"},
                                                        {"stable", "unstable"},
                                                        {"omega", "gamma"},
                                                        {"inward", "change"}};
    if (t_[i].kind != Kind::name) return;
    for (const auto& pair : alike)
      for (const bool first : {true, false}) {
        const string& other = pair[first ? 1 : 0];
        if (text(i) != pair[first ? 0 : 1] || !there(other)) continue;
        instead(in_brackets(i) ? "index" : "swapped name", i, other);
      }
    if (in_brackets(i) && text(i - 1) == "[" && text(i + 1) == "]") {
      instead("index", i, "0");
      instead("index", i, text(i) + " + 1");
      instead("index", i, text(i) + " - 1");
    }
  }
  bool there(const string& name) const {
    return std::any_of(t_.begin(), t_.end(), [&](const Token& t) { return t.text == name; });
  }
  bool in_brackets(size_t i) const {
    int depth = 0;
    for (size_t k = i; k-- > 0 && !is(k, {";", "{", "}"});) {
      depth += text(k) == "]" ? 1 : text(k) == "[" ? -1 : 0;
      if (depth < 0) return true;
    }
    return false;
  }

  /// Position after the operand that begins here: a name, a number or a bracket, with its suffixes.
  size_t behind(size_t i) const {
    if (is(i, {"-"})) ++i;
    if (is(i, {"("}))
      i = closing(i) + 1;
    else if (value(i) && !is(i, {")", "]"}))
      ++i;
    else
      return 0;
    for (;;) {
      if (is(i, {"(", "["}))
        i = closing(i) + 1;
      else if (is(i, {".", "::", "->"}))
        i += 2;
      else
        return i;
    }
  }
  size_t closing(size_t i) const {
    int depth = 0;
    for (size_t k = i; k + 1 < t_.size(); ++k) {
      depth += is(k, {"(", "["}) ? 1 : is(k, {")", "]"}) ? -1 : 0;
      if (depth == 0) return k;
    }
    return i;
  }

  /// Removes a term or a factor with the sign before or after it.
  void terms(size_t i) {
    if (i == 0 || !is(i, {"+", "-", "*", "/", "&&", "||"}) || !value(i - 1)) return;
    if (const size_t end = behind(i + 1)) add("term left out", t_[i].begin, t_[end - 1].end, "");
    const size_t k = i - 1;
    if (is(k, {")", "]"}) || t_[k].kind == Kind::end || (k > 0 && is(k - 1, {".", "::", "->"}))) return;
    add("term left out", t_[k].begin, t_[i + 1].begin, text(i) == "-" ? "-" : "");
  }

  /// Shifts the bounds of loops and of rounded numbers, and lets estimates use only the first of many values.
  void counts(size_t i) {
    const string other = text(i) == "ceil" ? "floor" : text(i) == "floor" ? "ceil" : "";
    if (!other.empty() && is(i + 1, {"("})) {
      const size_t from = i >= 2 && is(i - 1, {"::"}) ? i - 2 : i;
      const string rest = s_.substr(t_[i].end, t_[closing(i + 1)].end - t_[i].end);
      add("count", t_[from].begin, t_[closing(i + 1)].end,
          fmt::format("({}{}{} {} 1)", s_.substr(t_[from].begin, t_[i].begin - t_[from].begin), other, rest,
                      other == "floor" ? "+" : "-"));
    }
    if (is(i, {"<", "<="}))
      if (const size_t end = behind(i + 1); end > 0 && is(end, {";"})) {
        add("count", t_[end].begin, t_[end].begin, " - 1");
        if (is(end - 1, {")"})) add("few", t_[i + 1].begin, t_[end].begin, "1");
      }
    if (is(i, {"."}) && is(i + 1, {"back"}) && is(i + 2, {"("})) add("few", t_[i].begin, t_[i + 3].end, "[1]");
    if (is(i, {"size"}) && is(i + 1, {"("}) && is(i + 3, {"-"}) && i >= 2 && is(i - 1, {"."}))
      add("few", t_[i - 2].begin, t_[i + 4].end, "1");
  }

  /// Replaces a name that is initialised by `const T name = f(x);` with a repeated call of f, at `x` or at a later copy
  /// of `x`.
  void late(size_t i) {
    if (!is(i, {"="}) || i < 3 || t_[i - 1].kind != Kind::name || t_[i - 2].kind != Kind::name) return;
    if (t_[i + 1].kind != Kind::name || !is(i + 2, {"("}) || !is(closing(i + 2) + 1, {";"})) return;
    const string name = text(i - 1), asks = s_.substr(t_[i + 1].begin, t_[closing(i + 2)].end - t_[i + 1].begin);
    std::vector<string> moved;  // the call with one argument replaced by a copy of this argument
    int depth = 0;
    for (size_t k = closing(i + 2) + 1; k + 1 < t_.size() && depth >= 0; ++k) {
      depth += is(k, {"{"}) ? 1 : is(k, {"}"}) ? -1 : 0;
      if (is(k, {"="}) && is(k + 2, {";"}))  // State next = x;
        for (size_t from = i + 3; from < closing(i + 2); ++from)
          if (text(from) == text(k + 1) && is(from + 1, {",", ")"}))
            moved.push_back(s_.substr(t_[i + 1].begin, t_[from].begin - t_[i + 1].begin) + text(k - 1) +
                            s_.substr(t_[from].end, t_[closing(i + 2)].end - t_[from].end));
      if (text(k) != name || is(k - 1, {".", "->"})) continue;
      if (text(i + 1) == "f") instead("asked again", k, asks);
      if (is(k + 1, {"["}))
        for (const string& one : moved) instead("half moved", k, one);
    }
  }

  void types(size_t i) {
    if (text(i) == "double") instead("float", i, "float");
    if (text(i) == "float" || text(i) == "double") {
      if (t_[i + 1].kind == Kind::name) instead("integer", i, "int");
    }
  }

  /// Changes statements on a line of their own: omits or reorders them, or makes their variable static or a reference.
  void statements() {
    std::vector<Line> lines;
    for (size_t at = 0; at < s_.size();) {
      const size_t end = std::min(s_.size(), s_.find('\n', at));
      const size_t first = s_.find_first_not_of(' ', at);
      size_t stop = end;
      if (const size_t comment = s_.find("//", at); comment < stop) stop = comment;
      while (stop > at && s_[stop - 1] == ' ') --stop;
      const string body = first < stop ? s_.substr(first, stop - first) : "";
      const bool statement = first > at && body.ends_with(';') &&
                             std::count(body.begin(), body.end(), '(') == std::count(body.begin(), body.end(), ')');
      if (statement) {
        lines.push_back({first, stop, first - at});
        one_statement(first, stop, body);
        if (lines.size() > 1) order(lines[lines.size() - 2], lines.back());
      }
      at = end + 1;
    }
  }

  struct Line {
    size_t begin, end, indent;
  };

  /// Swaps two consecutive statements if the second reads what the first one writes.
  void order(const Line& first, const Line& second) {
    const string between = s_.substr(first.end, second.begin - first.end);
    if (first.indent != second.indent || between.find_first_not_of(" \n") != string::npos) return;
    const string one = s_.substr(first.begin, first.end - first.begin);
    const string two = s_.substr(second.begin, second.end - second.begin);
    const std::vector<Token> a = tokens_of(one), b = tokens_of(two);
    static const std::set<string> assigns{"=", "+=", "-=", "*=", "/="};
    const auto sign_of = [](const std::vector<Token>& t) {
      return std::find_if(t.begin(), t.end(), [](const Token& each) { return assigns.count(each.text) > 0; });
    };
    const auto at = sign_of(a);
    if (at == a.end() || at == a.begin()) return;
    const bool declares = std::prev(at)->kind == Kind::name && at - a.begin() > 1;
    const string written = declares ? std::prev(at)->text : a.front().text;
    const auto reads = sign_of(b) == b.end() ? b.begin() : sign_of(b);
    if (std::none_of(reads, b.end(), [&](const Token& each) { return each.text == written; })) return;
    add("order", first.begin, second.end, two + between + one);
  }

  void one_statement(size_t begin, size_t end, const string& body) {
    const bool keyword = body.starts_with("return") || body.starts_with("using") || body.starts_with("for");
    if (body.starts_with("if ") || body.starts_with("for ")) {
      const size_t open = body.find('('), close = s_.find(')', begin);
      if (open != string::npos && close < end && body.starts_with("if ")) add("left out", begin, end, ";");
      return;
    }
    if (keyword && !body.starts_with("return")) return;
    if (!keyword) add("left out", begin, end, ";");
    const size_t equals = body.find(" = ");
    const bool declares =
        equals != string::npos && body.rfind(' ', equals - 1) != string::npos && body.find_first_of(".[") > equals;
    const bool brackets = !keyword && equals == string::npos && body.find(" ") != string::npos &&
                          body.find_first_of("=<.+") > body.find('(') &&
                          std::isupper(static_cast<unsigned char>(body[0]));
    if (declares || brackets) add("static", begin, begin, "static ");
    if (!declares) return;
    // turns a copy, such as `State next = state;`, into a reference
    const string from = body.substr(equals + 3, body.size() - equals - 4);
    const size_t name = body.rfind(' ', equals - 1);
    if (!body.starts_with("const ") && std::all_of(from.begin(), from.end(), in_name) && !std::isdigit(from[0]))
      add("alias", begin, end,
          fmt::format("auto&{} = const_cast<{}&>({});", body.substr(name, equals - name), body.substr(0, name), from));
  }

  const string& s_;
  std::vector<Token> t_;
  std::vector<Mutant> made_;
  std::set<string> seen_;
};

}  // namespace

std::vector<Mutant> mutants_of(const string& source, size_t most) {
  std::map<string, std::vector<Mutant>> by_rule;
  for (Mutant& one : Mutation(source).all()) by_rule[one.rule].push_back(std::move(one));
  std::vector<Mutant> chosen;
  for (auto& [rule, all] : by_rule) {
    const size_t count = std::min(most, all.size());
    for (size_t i = 0; i < count; ++i) chosen.push_back(std::move(all[i * all.size() / count]));
  }
  return chosen;
}

std::vector<Equivalent> read_equivalents(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw crosscheck::InputError(fmt::format("{}: cannot be read", file.string()));
  std::vector<Equivalent> all;
  string where, line;
  for (int number = 1; std::getline(in, line); ++number) {
    const auto wrong = [&](const char* what) {
      return crosscheck::InputError(fmt::format("{}:{}: {}", file.string(), number, what));
    };
    const bool open = !all.empty() && all.back().why.empty();
    if (line.empty() || line[0] == '#') continue;
    if (line.front() == '[' && line.back() == ']') {
      if (open) throw wrong("expected the reason of the change before");
      where = line.substr(1, line.size() - 2);
    } else if (line.starts_with("- ")) {
      if (where.empty() || open)
        throw wrong(open ? "expected the reason of the change before" : "expected [ASSIGNMENT FILE] first");
      all.push_back({where, line.substr(2), "", ""});
    } else if (line.starts_with("+ ") || line == "+") {
      if (!open || !all.back().wrong.empty()) throw wrong("expected '- ' and the right line first");
      all.back().wrong = line.size() > 2 ? line.substr(2) : " ";
    } else {
      if (!open || all.back().wrong.empty()) throw wrong("expected '- ' and '+ ' first");
      all.back().why = line;
    }
  }
  if (!all.empty() && all.back().why.empty())
    throw crosscheck::InputError(fmt::format("{}: the last change has no reason", file.string()));
  for (Equivalent& one : all)
    if (one.wrong == " ") one.wrong.clear();
  return all;
}

}  // namespace coursework
