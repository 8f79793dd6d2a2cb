// Observations on wrong answers, which come from arithmetic and from repeated calls with other numbers.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/coursework/check/seen.h"
#include "tests/coursework/check/words.h"
#include "tests/coursework/grader/fit.h"
#include "tests/coursework/grader/observe.h"
#include "tests/coursework/test/helpers.h"

namespace coursework {
namespace {

const Texts& layouts() {
  static const Texts texts = Texts::parse(
      "[given.rates]\n| n m[n] g[3] drag x[n,3] v[n,3]\n\n[column.rates]\n(x'.x, x'.y, x'.z, v'.x, v'.y, v'.z)\n\n"
      "[row.particle]\nparticle\n",
      "texts");
  return texts;
}

/// Two particles that fall with drag. `force` maps m, g, drag and v, for components 0 to 2, to a force.
template <class Force>
Numbers rates(const Numbers& in, Force force) {
  Numbers out;
  for (std::size_t i = 0; i < 2; ++i) {
    const double *g = &in[3], *v = &in[13 + 3 * i];
    out.insert(out.end(), v, v + 3);
    for (int k = 0; k < 3; ++k) out.push_back(force(in[1 + i], g[k], in[6], v[k]) / in[1 + i]);
  }
  return out;
}
Numbers right_rates(const Numbers& in) {
  return rates(in, [](double m, double g, double drag, double v) { return m * g - drag * v; });
}

Case falling(double drag = 0.2) {
  Case c{"rates", {2, 0.5, 0.8, 0.7, -9, 0.3, drag, 1, 2, 3, 4, 5, 6, 0.6, -1.1, 0.9, -0.4, 1.7, 0.3}, {}, 6, 1e-9};
  c.row = "particle", c.column = "rates", c.expected = right_rates(c.in);
  return c;
}

/// Observations on one case, confirmed by a second case with another drag.
template <class Force>
std::string seen(Force force) {
  const Case what = falling(), other = falling(0.3);
  return seen_text(common_texts(), layouts(), what, {How::answered, rates(what.in, force)},
                   {{other, {How::answered, rates(other.in, force)}}});
}

TEST(Seen, SaysWhichVectorsAreRightAndWhatTheOthersAre) {
  EXPECT_EQ(seen([](double m, double g, double drag, double v) { return m * g - drag * v; }), "");
  EXPECT_EQ(seen([](double, double, double, double) { return 0.; }),
            "Right: x'. Wrong: v'. Where v' is wrong, it is 0.");
  EXPECT_EQ(seen([](double m, double g, double drag, double v) { return -(m * g - drag * v); }),
            "Right: x'. Wrong: v'. Where v' is wrong, it is the right value with the opposite sign.");
  EXPECT_EQ(seen([](double m, double g, double drag, double v) { return m * (m * g - drag * v); }),
            "Right: x'. Wrong: v'. Where v' is wrong, it is the right value times m.");
  EXPECT_EQ(seen([](double m, double g, double drag, double v) { return (m * g - drag * v) / 3; }),
            "Right: x'. Wrong: v'. Where v' is wrong, it is the right value times 1/3.");
  EXPECT_EQ(
      seen([](double m, double, double, double v) { return m * v; }),
      "Right: x'. Wrong: v'. Where v' is wrong, it equals v of the input. Where v' is wrong, it is what x' should "
      "be.");
  EXPECT_EQ(seen([](double m, double g, double drag, double v) { return m * g - drag * v + m * drag * v; }),
            "Right: x'. Wrong: v'. Where v' is wrong, it is the right value plus (drag) times v.");
  // two simultaneous errors have no simple explanation
  EXPECT_EQ(seen([](double m, double g, double drag, double v) { return 1.3 * m * g - 1.7 * drag * v + 0.1; }),
            "Right: x'. Wrong: v'.");
}

// In a single case a factor may fit by chance, and may have several names.
TEST(Seen, AFactorNeedsASecondCase) {
  const Case what = falling(), other = falling(0.3);
  const auto answer = [](const Case& c, double factor) {
    return Answer{How::answered,
                  rates(c.in, [=](double m, double g, double drag, double v) { return factor * (m * g - drag * v); })};
  };
  const auto told = [&](double here, double there) {
    return seen_text(common_texts(), layouts(), what, answer(what, here), {{other, answer(other, there)}});
  };
  const std::string split = "Right: x'. Wrong: v'.";
  EXPECT_EQ(seen_text(common_texts(), layouts(), what, answer(what, 1.0 / 6)), split);
  EXPECT_EQ(told(1.0 / 6, 1.0 / 3), split);
  EXPECT_EQ(told(1.0 / 6, 1.0 / 6), split + " Where v' is wrong, it is the right value times 1/6.");
  // drag is 0.2 here and 0.3 in the other case, so both factors are drag/2
  EXPECT_EQ(told(0.1, 0.15), split + " Where v' is wrong, it is the right value times drag/2.");
}

TEST(Table, HasExpectedBesideGot) {
  const Texts common = common_texts();
  Case what{"rates", {}, {1, -9.81, 0, 1.0 / 3}, 2, 1e-9, "particle", "pair"};
  const auto table = [&](const Numbers& got) { return table_text(common, layouts(), what, {How::answered, got}); };
  EXPECT_EQ(table({1, 9.81, 1e-17, 1.0 / 3}),
            "                       expected       got\n"
            "  particle 0, pair[0]         1         1\n"
            "  particle 0, pair[1]     -9.81      9.81  <- differs\n"
            "  particle 1, pair[0]         0         0\n"
            "  particle 1, pair[1]  0.333333  0.333333");
  // the table of many numbers shows only those that differ, if they are few
  what.expected = Numbers(8, 1.0);
  EXPECT_EQ(table({1, 1, 1, 2, 1, 1, 1, 1}),
            "                       expected  got\n"
            "  particle 1, pair[1]         1    2  <- differs\n"
            "  (the other 7 are right)");
  EXPECT_EQ(table(Numbers(8, 2.0)), "");
  EXPECT_EQ(table({1, 2}), "");
}

TEST(Seen, TellsParticlesAndPartsApart) {
  const Case what = falling();
  Numbers got = what.expected;
  got[9] += 1;
  EXPECT_EQ(seen_text(common_texts(), layouts(), what, {How::answered, got}),
            "Right: x'; v' of particle 0. Wrong: v' of particle 1.");
  got[3] += 1;
  EXPECT_EQ(seen_text(common_texts(), layouts(), what, {How::answered, got}), "Right: x'; v'.y; v'.z. Wrong: v'.x.");
}

// Arithmetic does not explain measured quantities such as an order of accuracy.
TEST(Seen, NothingOfWhatIsComparedLoosely) {
  const Case order{"order", {1}, {4}, 1, 0.1, "order", "order"};
  EXPECT_EQ(seen_text(common_texts(), layouts(), order, {How::answered, {2}}), "");
}

TEST(Seen, NumbersHaveNamesWhereOneFits) {
  const std::vector<Param> params{{"h", {0}}, {"k", {1}}, {"m", {2}}};
  const Numbers in{0.3, 70, 1.7};
  const auto name = [&](double value) { return named_number(value, 1e-12, params, in); };
  EXPECT_EQ(name(0.5), "1/2");
  EXPECT_EQ(name(-4. / 3), "-4/3");
  EXPECT_EQ(name(0.15), "h/2");
  EXPECT_EQ(name(-0.09), "-h^2");
  EXPECT_EQ(name(1 / 1.7), "1/m");
  EXPECT_EQ(name(70 / 1.7), "k/m");
  EXPECT_EQ(name(0.777), "0.777");
}

TEST(Seen, SumsAreFittedOrRefused) {
  const Numbers a{1, 2, 3}, b{0, 1, 1};
  EXPECT_EQ(sum_text({{"x"}, {"h k1"}}, coefficients({a, b}, {1, 2.5, 3.5}, 1e-12), 1e-9), "x + 1/2 h k1");
  EXPECT_TRUE(coefficients({a, b}, {1, 2, 4}, 1e-12).empty());
  EXPECT_TRUE(coefficients({a, a}, a, 1e-12).empty());
}

/// The case with generic numbers, which are not related to each other.
Case in_general(Case c) {
  for (std::size_t i = 1; i < c.in.size(); ++i) c.in[i] *= 1 + 0.0123456789 * static_cast<double>(i);
  c.expected = right_rates(c.in);
  return c;
}

std::string observed(Numbers (*student)(const Numbers&), double mass = 0.5) {
  const auto answers = [](Numbers (*of)(const Numbers&)) {
    return [of](const std::vector<Case>& cases) {
      std::vector<Answer> all;
      for (const Case& what : cases) all.push_back({How::answered, of(what.in)});
      return all;
    };
  };
  const Texts common = common_texts();
  const Test test{"1.1", "part", 1, 0, {}, "", nullptr};
  Case what = falling(), other = in_general(falling(0.3));
  what.in[1] = mass, what.in[2] = 1.6 * mass, what.expected = right_rates(what.in);
  const Assignment assignment{"test/tiny", "", {}, {}};
  return seen_at({answers(student), answers(right_rates), common, layouts()}, assignment, "part",
                 {{&test, {what, other}, {{How::answered, student(what.in)}, {How::answered, student(other.in)}}}},
                 {true})
      .at(0);
}

TEST(Observe, TellsWithWhichNumbersTheAnswersWouldBeRight) {
  EXPECT_EQ(
      observed([](const Numbers& in) { return rates(in, [](double m, double g, double, double) { return m * g; }); }),
      "Tried with other numbers: all your answers of this kind are what the right code returns with drag = 0.");
  EXPECT_EQ(
      observed([](const Numbers& in) {
        return rates(in, [&](double, double g, double drag, double v) { return in[1] * g - drag * v; });
      }),
      "Tried with other numbers: with g = 0 your answers are right. They are wrong only where this quantity matters. "
      "Its contribution: Where v' is wrong, it is the right value times m[0]/m.");
}

TEST(Observe, TellsWithoutWhichTermTheAnswerIsRight) {
  EXPECT_EQ(
      observed([](const Numbers& in) {
        return rates(in, [](double m, double g, double drag, double v) { return m * g - drag * v * std::abs(v); });
      }),
      "Tried with other numbers: with drag = 0 your answers are right. They are wrong only where this quantity "
      "matters. "
      "Tried with other numbers: with v = 0 your answers are right. They are wrong only where this quantity matters.");
  EXPECT_EQ(observed([](const Numbers& in) { return rates(in, [](double, double, double, double) { return 7.; }); }),
            "");
  // without drag, the answers for particles of mass 1 and 1.6 are right by accident
  EXPECT_EQ(observed(
                [](const Numbers& in) {
                  return rates(in, [](double m, double g, double drag, double v) {
                    return m * g * (m == 1 || m == 1.6 ? 1 : 2) - drag * v * std::abs(v);
                  });
                },
                1),
            "");
}

// The code computes a frame of several steps, and is right only if the frame has a single step.
TEST(Observe, TellsByWhichNumberRightAndWrongAreToldApart) {
  const Texts own = Texts::parse("[given.frame]\n| steps# frame x v\n", "texts");
  const auto x = [](const Numbers& in, double h) { return in[2] + in[0] * h * in[3] + h * h * std::sin(in[1]); };
  const auto answers = [&](bool right) {
    return [&x, right](const std::vector<Case>& cases) {
      std::vector<Answer> all;
      for (const Case& what : cases)
        all.push_back({How::answered, {x(what.in, right ? what.in[1] / what.in[0] : what.in[1])}});
      return all;
    };
  };
  TestRun one;
  const coursework::Test test{"1.1", "part", 1, 0, {}, "", nullptr};
  one.test = &test;
  for (const double steps : {1., 1., 3., 4.})
    one.cases.push_back({"frame", {steps, 0.1 + steps / 7, 0.4, 2 + steps}, {}, 1, 1e-9, "", "x"});
  one.cases[1].in[3] = 7;
  one.answers = answers(false)(one.cases);
  for (Case& what : one.cases) what.expected = answers(true)({what}).at(0).got;
  const Texts common = common_texts();
  EXPECT_EQ(
      seen_at({answers(false), answers(true), common, own}, {"test/tiny", "", {}, {}}, "part", {one}, {true}).at(0),
      "Of all tested cases, those with steps = 1 are right (2 of them), and all others are wrong (2 of them).");
}

/// Formula analysis for a stepper of this kind: f is linear, and the positions of its calls are recorded.
template <class Step>
std::string looked(Step step) {
  const auto ask = [&](const std::vector<Case>& cases) {
    std::vector<Answer> answers;
    for (const Case& what : cases) {
      const auto n = static_cast<std::size_t>(what.in[0]);
      const double* a = &what.in[4 + n];
      Numbers points;
      const auto f = [&](double t, const Numbers& x) {
        points.push_back(t), points.insert(points.end(), x.begin(), x.end());
        Numbers slope;
        for (std::size_t i = 0; i < n; ++i) {
          slope.push_back(a[n * n + i] + a[n * n + n + i] * t);
          for (std::size_t k = 0; k < n; ++k) slope.back() += a[i * n + k] * x[k];
        }
        return slope;
      };
      const Numbers end =
          step(f, what.in[2], Numbers(what.in.begin() + 4, what.in.begin() + 4 + static_cast<long>(n)), what.in[3]);
      answers.push_back({How::answered, what.call == "trapezoidal.points" ? points : end});
    }
    return answers;
  };
  return find_assignment("a1-steppers").look(common_texts(), "trapezoidal", ask).text;
}

Numbers moved(Numbers x, double h, const Numbers& slope) {
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += h * slope[i];
  return x;
}

TEST(Look, ReadsAStepperOffItsCalls) {
  const auto rule = [](double time, double ahead, double weight) {
    return looked([=](auto f, double t, const Numbers& x, double h) {
      const Numbers k1 = f(t, x), k2 = f(t + time * h, moved(x, ahead * h, k1));
      return moved(moved(x, h / 2, k1), weight * h, k2);
    });
  };
  EXPECT_EQ(rule(1, 1, 0.5), common_texts().of("rule.right"));
  EXPECT_EQ(rule(0.5, 1, 0.5), "Call 2 is at the time t + 1/2 h; right is t + h.");
  EXPECT_EQ(rule(1, -1, 0.5), "Your calls of f show that call 2 is at the state x - h k1; right is x + h k1.");
  EXPECT_EQ(rule(1, 1, 0.25),
            "Your step returns x + 1/2 h k1 + 1/4 h k2, where k1 is the first slope, k2 the second; right is x + 1/2 h "
            "k1 + 1/2 h k2.");
  EXPECT_EQ(looked([](auto f, double t, const Numbers& x, double h) { return moved(x, h, f(t, x)); }),
            "Number of times your step calls f, for a system of five numbers: expected 2, got 1.");
}

TEST(Look, ReadsTheEquationOfAnImplicitStep) {
  // solves the 2 x 2 system of two particles on a line by Cramer's rule. `sign` multiplies the term with the
  // velocities, `ahead` a term of the position
  const auto equation = [](double sign, double ahead) {
    const auto ask = [&](const std::vector<Case>& cases) {
      std::vector<Answer> answers;
      for (const Case& what : cases) {
        const Numbers& in = what.in;
        const double h = in[2], c = in[3], g = in[4], k = in[10], e = in[19] - in[16] - in[11];
        const bool fixed = in[14] != 0;
        const double m[2] = {in[12], in[13]}, v[2] = {in[22], in[25]}, hk = h * h * k;
        const double a = m[0] + h * c + hk, d = m[1] + h * c + hk;
        const double r0 = h * (m[0] * g - c * v[0] + k * e) - sign * hk * (v[0] - v[1]);
        const double r1 = h * (m[1] * g - c * v[1] - k * e) - sign * hk * (v[1] - v[0]);
        const double dv[2] = {fixed ? 0 : (r0 * d + hk * r1) / (a * d - hk * hk),
                              fixed ? r1 / d : (a * r1 + hk * r0) / (a * d - hk * hk)};
        Answer answer{How::answered, Numbers(12, 0.0)};
        for (int i = 0; i < 2; ++i) {
          answer.got[6 * i] = in[16 + 3 * i] + h * (v[i] + ahead * dv[i]);
          answer.got[6 * i + 3] = v[i] + dv[i];
        }
        answers.push_back(answer);
      }
      return answers;
    };
    return find_assignment("a5-stiff").look(common_texts(), "implicit_euler", ask).text;
  };
  EXPECT_EQ(equation(1, 1), "");
  EXPECT_NE(
      equation(-1, 1).find("m dv = h m g - h c v - h c dv - h k e + h^2 k v - h^2 k dv; right is m dv = h m g - h c "
                           "v - h c dv - h k e - h^2 k v - h^2 k dv."),
      std::string::npos)
      << equation(-1, 1);
  EXPECT_EQ(equation(1, 0),
            "Your steps show that the velocity is right for motion along a line. The new position is x + h v; right is "
            "x + h v + h dv.");
}

}  // namespace
}  // namespace coursework
