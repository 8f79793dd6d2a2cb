// Test systems, read from the numbers of a call, and the quantities recorded while a stepper advances them.
#include "calls_steppers.h"

#include <cmath>

#include "calls.h"
#include "numbers.h"

namespace coursework {
namespace {

struct Start {
  std::size_t n, steps;
  double t, h;
  State x;
};

Start read_start(Reader& in) {
  Start s;
  s.n = in.count(), s.steps = in.count(), s.t = in.number(), s.h = in.number();
  s.x = in.numbers(s.n);
  return s;
}

void expect_size(const char* key, const State& x, std::size_t n) {
  if (x.size() != n) throw Unusable(key, {x.size(), n});
}

const char* const f_got = "f_size";

Derivative linear(Reader& in, std::size_t n) {
  const Numbers a = in.numbers(n * n), b = in.numbers(n), c = in.numbers(n);
  return [=](double t, const State& x) {
    calling("f");
    expect_size(f_got, x, n);
    State rate(n);
    for (std::size_t i = 0; i < n; ++i) {
      rate[i] = b[i] + c[i] * t;
      for (std::size_t j = 0; j < n; ++j) rate[i] += a[i * n + j] * x[j];
    }
    return rate;
  };
}

Derivative circle(Reader& in) {
  const double omega = in.number();
  return [=](double, const State& x) {
    calling("f");
    expect_size(f_got, x, 2);
    return State{-omega * x[1], omega * x[0]};
  };
}

Derivative cosine(Reader& in, std::size_t n) {
  const Numbers a = in.numbers(n), w = in.numbers(n), p = in.numbers(n);
  return [=](double t, const State& x) {
    calling("f");
    expect_size(f_got, x, n);
    State rate(n);
    for (std::size_t i = 0; i < n; ++i) rate[i] = a[i] * std::cos(w[i] * t + p[i]);
    return rate;
  };
}

Derivative seasonal_growth(Reader& in, std::size_t n) {
  const Numbers r = in.numbers(n), w = in.numbers(n), p = in.numbers(n);
  return [=](double t, const State& x) {
    calling("f");
    expect_size(f_got, x, n);
    State rate(n);
    for (std::size_t i = 0; i < n; ++i) rate[i] = r[i] * (1 + std::cos(w[i] * t + p[i]) / 2) * x[i] * (1 - x[i]);
    return rate;
  };
}

void put(const State& x, Numbers& out) { out.insert(out.end(), x.begin(), x.end()); }

/// Advances one step; throws on a state of the wrong size, which would only confuse the following calls.
State advanced(Stepper step, const Derivative& f, double t, const State& x, double h) {
  calling("step");
  State next = step(f, t, x, h);
  expect_size("step_size", next, x.size());
  return next;
}

/// Appends one row per step.
void march(Stepper step, const Derivative& f, Start s, Numbers& out) {
  for (std::size_t k = 0; k < s.steps; ++k) {
    s.x = advanced(step, f, s.t + static_cast<double>(k) * s.h, s.x, s.h);
    put(s.x, out);
  }
}

void march_with_radius(Stepper step, const Derivative& f, Start s, Numbers& out) {
  for (std::size_t k = 0; k < s.steps; ++k) {
    const double before = std::hypot(s.x[0], s.x[1]);
    s.x = advanced(step, f, s.t + static_cast<double>(k) * s.h, s.x, s.h);
    put(s.x, out), out.push_back(std::hypot(s.x[0], s.x[1]) / before);
  }
}

void march_halved(Stepper step, const Derivative& f, const Start& s, Numbers& out) {
  State whole = s.x, halves = s.x;
  for (std::size_t k = 0; k < s.steps; ++k) {
    const double t = s.t + static_cast<double>(k) * s.h;
    whole = advanced(step, f, t, whole, s.h);
    halves = advanced(step, f, t, halves, s.h / 2);
    halves = advanced(step, f, t + s.h / 2, halves, s.h / 2);
    put(whole, out), put(halves, out);
  }
}

void record_points(Stepper step, const Derivative& f, const Start& s, Numbers& out) {
  step(
      [&](double t, const State& x) {
        out.push_back(t);
        put(x, out);
        return f(t, x);
      },
      s.t, s.x, s.h);
}

void take_twice(Stepper step, const Derivative& f, const Start& s, Numbers& out) {
  State argument = s.x;
  const State first = advanced(step, f, s.t, argument, s.h);
  put(first, out), put(argument, out);
  State other = s.x;
  for (double& number : other) number = 1 - 2 * number;
  advanced(step, f, s.t + 1, other, s.h / 2);
  advanced(step, f, s.t, other, s.h);
  put(advanced(step, f, s.t, s.x, s.h), out);
}

}  // namespace

bool answer_stepper(const std::string& part, Stepper step, const std::string& call, const Numbers& in, Numbers& out) {
  if (call.compare(0, part.size() + 1, part + ".") != 0) return false;
  const std::string what = call.substr(part.size() + 1);
  Reader reader(in);
  const Start start = read_start(reader);
  if (what == "linear") return march(step, linear(reader, start.n), start, out), true;
  if (what == "circle") return march_with_radius(step, circle(reader), start, out), true;
  if (what == "cosine") return march(step, cosine(reader, start.n), start, out), true;
  if (what == "halved") return march_halved(step, seasonal_growth(reader, start.n), start, out), true;
  if (what == "points") return record_points(step, linear(reader, start.n), start, out), true;
  if (what == "twice") return take_twice(step, linear(reader, start.n), start, out), true;
  return false;
}

}  // namespace coursework
