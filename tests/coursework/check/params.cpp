#include "params.h"

#include <cmath>
#include <cstdio>
#include <set>

namespace coursework {

std::vector<Param> params_of(const CallLayout& layout) {
  std::vector<Param> params;
  for (const Field& field : layout.fields) {
    if (field.size() == 0) continue;
    Param* param = nullptr;
    for (Param& known : params)
      if (known.name == field.name && known.group == field.group && field.item > 0) param = &known;
    if (!param) {
      params.push_back({field.name, {}, 0, field.columns, field.group, field.whole, field.angle});
      param = &params.back();
    }
    param->rows += field.list ? field.columns : field.rows;
    if (field.list) param->columns = 1;
    for (std::size_t i = 0; i < field.size(); ++i) param->at.push_back(field.begin + i);
  }
  return params;
}

namespace {

struct Simple {
  double value;
  const char* above;  // prefix
  const char* below;  // suffix
};
// factors that formulas of mechanics and of time steppers often lack, or have in excess
constexpr Simple simple[] = {{1, "", ""},          {2, "2 ", ""},     {0.5, "", "/2"},      {3, "3 ", ""},
                             {1. / 3, "", "/3"},   {4, "4 ", ""},     {0.25, "", "/4"},     {6, "6 ", ""},
                             {1. / 6, "", "/6"},   {1.5, "3 ", "/2"}, {2. / 3, "2 ", "/3"}, {0.75, "3 ", "/4"},
                             {4. / 3, "4 ", "/3"}, {1. / 8, "", "/8"}};

std::string alone(const Simple& one) {
  const std::string above = one.above, below = one.below;
  return (above.empty() ? "1" : above.substr(0, above.size() - 1)) + below;
}

/// Text of a simple number, such as 4/3, or an empty string for other numbers.
std::string simple_name(double value, double relative) {
  for (const Simple& one : simple)
    if (std::abs(std::abs(value) - one.value) <= relative * std::abs(value)) return (value < 0 ? "-" : "") + alone(one);
  return "";
}

/// All products that fit the value, such as h^2/2. Tries products of two parameters only if no single parameter fits.
std::set<std::string> product_names(double value, double relative, const std::vector<Param>& params,
                                    const Numbers& in) {
  if (relative > 1e-6) return {};  // too many products would match by chance
  const auto is = [&](double other) { return std::abs(std::abs(value) - other) <= relative * std::abs(value); };
  std::set<std::string> names;
  std::vector<const Param*> scalars;
  for (const Param& param : params)
    if (param.scalar() && !param.whole && in[param.at[0]] != 0 && std::abs(in[param.at[0]]) != 1)
      scalars.push_back(&param);
  const auto try_all = [&](double product, const std::string& name, bool below) {
    for (const Simple& one : simple) {
      if (&one - simple > 4 || !is(one.value * std::abs(product))) continue;
      const std::string sign = (value < 0) != (product < 0) ? "-" : "";
      if (below)
        names.insert(sign + (one.value < 1 ? "1/(" + std::string(one.below + 1) + " " + name + ")"
                                           : (*one.above ? alone(one) : "1") + "/" + name));
      else
        names.insert(sign + one.above + name + one.below);
    }
  };
  for (const Param* q : scalars) {
    const double number = in[q->at[0]];
    try_all(number, q->name, false);
    try_all(1 / number, q->name, true);
    try_all(number * number, q->name + "^2", false);
    try_all(1 / (number * number), q->name + "^2", true);
  }
  if (names.empty())
    for (const Param* q : scalars)
      for (const Param* p : scalars) {
        if (p == q) continue;
        const double a = in[q->at[0]], b = in[p->at[0]];
        if (q < p) try_all(a * b, q->name + " " + p->name, false);
        try_all(a / b, q->name + "/" + p->name, false);
        try_all(a * a * b, q->name + "^2 " + p->name, false);
      }
  return names;
}

}  // namespace

std::string name_of_number(double value, double relative, const std::vector<Param>& params, const Numbers& in) {
  if (!std::isfinite(value) || value == 0) return "";
  const std::string name = simple_name(value, relative);
  if (!name.empty()) return name;
  const std::set<std::string> names = product_names(value, relative, params, in);
  return names.size() == 1 ? *names.begin() : "";
}

std::vector<std::string> names_of_number(double value, double relative, const std::vector<Param>& params,
                                         const Numbers& in) {
  if (!std::isfinite(value) || value == 0) return {};
  const std::set<std::string> products = product_names(value, relative, params, in);
  std::vector<std::string> names(products.begin(), products.end());
  if (const std::string simple = simple_name(value, relative); !simple.empty()) names.insert(names.begin(), simple);
  return names;
}

std::string named_number(double value, double relative, const std::vector<Param>& params, const Numbers& in) {
  const std::string name = name_of_number(value, relative, params, in);
  if (!name.empty()) return name;
  char digits[40];
  std::snprintf(digits, sizeof digits, "%.6g", value);
  return digits;
}

}  // namespace coursework
