// Every known disagreement is reproduced according to its own criterion, and described in a sentence with numbers. No
// healthy method reproduces it.

#include <map>
#include <numbers>
#include <set>

#include "experiments/disagreements/disagreements.h"
#include "experiments/disagreements/upstream.h"
#include "experiments/scenes/scenes.h"
#include "experiments/sweep/sweep.h"
#include "experiments/tables/disagreements.h"
#include "mysim/base/errors.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

struct Expected {
  std::string name;
  TroubleState state;
};
const Expected expected[] = {
    {"pbd-friction", TroubleState::explained},       {"pbd-stiffness", TroubleState::explained},
    {"link-law", TroubleState::explained},           {"implicit-freeze", TroubleState::explained},
    {"indefinite-hessian", TroubleState::explained}, {"rest-lengths", TroubleState::explained},
    {"wind-at-rest", TroubleState::explained},       {"speed-clamp", TroubleState::explained},
    {"distance-field", TroubleState::explained},     {"contact-direction", TroubleState::explained},
    {"contact-hop", TroubleState::reproduced},       {"single-precision", TroubleState::explained},
    {"network-in-pieces", TroubleState::explained},  {"one-stiffness", TroubleState::explained},
    {"gravity-factor", TroubleState::explained},     {"stiffness-unused", TroubleState::explained},
    {"over-relaxation", TroubleState::explained},    {"small-things", TroubleState::explained},
    {"sleeping", TroubleState::explained},
};

Disagreement row(const std::string& name) {
  for (Disagreement& d : disagreements())
    if (d.name == name) return std::move(d);
  throw std::logic_error(name);
}

double apart(const Series& a, const Series& b, double until = INFINITY) {
  double most = 0;
  for (size_t i = 0; i < std::min(a.points.size(), b.points.size()) && a.points[i].first < until; ++i)
    most = std::max(most, std::abs(a.points[i].second - b.points[i].second));
  return most;
}

TEST(Disagreements, EachIsThereAndSaysSo) {
  const std::vector<Disagreement> all = disagreements();
  ASSERT_EQ(all.size(), std::size(expected));
  for (size_t d = 0; d < all.size(); ++d) {
    const Expected& e = expected[d];
    SCOPED_TRACE(e.name);
    ASSERT_EQ(all[d].name, e.name);
    for (const std::string& text : {all[d].what, all[d].cause, all[d].quantity, all[d].unit, all[d].world})
      EXPECT_FALSE(text.empty());
    const Scene scene = scene_of(all[d]);
    const std::vector<Series> series = run_variants(all[d], scene);
    ASSERT_EQ(series.size(), all[d].variants.size());
    for (const Series& s : series) {
      EXPECT_NE(s.outcome.verdict, Verdict::unsupported) << s.variant.method << ": " << s.outcome.reason;
      // a hanging run has only its initial state
      EXPECT_GE(s.points.size(), s.outcome.verdict == Verdict::timeout ? 1u : 2u) << s.variant.method;
    }
    EXPECT_EQ(series[0].outcome.verdict, Verdict::ok);  // the first variant is the scene itself
    EXPECT_EQ(why_not_asked(all[d], series), "");
    for (const auto* conditions : {&all[d].symptom, &all[d].cause_removed})
      for (const Condition& c : *conditions)
        EXPECT_TRUE(holds(c, series)) << "condition on " << c.a << " and " << c.b << ": " << criterion_of(all[d])
                                      << "; apart by " << apart(series[c.a], series[c.b], c.until);
    EXPECT_EQ(name_of(state_of(all[d], series)), name_of(e.state));
    const std::string effect = all[d].effect(series);
    fmt::print("{}: {}\n", e.name, effect);
    EXPECT_FALSE(effect.empty());
    for (const auto no_number : {"nan", "inf"}) EXPECT_EQ(effect.find(no_number), std::string::npos) << effect;
  }
}

TEST(Disagreements, AHealthyMethodHasNone) {
  for (Disagreement d : disagreements()) {
    SCOPED_TRACE(d.name);
    // Replaces each Bullet world by the reference method with the scene's own step.
    for (Variant& v : d.variants)
      if (find_method(v.method).family().role == Role::peer) v.method = d.variants[0].method, v.step = 0;
    EXPECT_EQ(name_of(state_of(d, run_variants(d, scene_of(d)))), "not reproduced");
  }
}

TEST(Disagreements, WorldsInThisProcessRefuseWhatWouldHangThem) {
  const auto refusal = [](const std::string& method, const std::string& scene) {
    const Scene of = scene_of(row(scene));
    const Outcome out = run_method(find_method(method), of, default_run(of), {});
    EXPECT_EQ(out.verdict, Verdict::unsupported) << method;
    return out.reason;
  };
  for (const auto method : {"bullet/deformable-explicit", "bullet/deformable-implicit", "bullet/pbd",
                            "bullet/deformable-explicit+bodies", "bullet32/deformable-explicit"})
    EXPECT_EQ(refusal(method, "network-in-pieces"),
              "Bullet's contact search hangs on a body whose springs do not join all particles");
  EXPECT_TRUE(contains(refusal("bullet/deformable-explicit+bodies", "distance-field"),
                       "only springs, gravity and pins at rest"));
  EXPECT_TRUE(
      contains(refusal("bullet/deformable-explicit+bodies", "small-things"), "only springs, gravity and pins at rest"));
}

Series series(Verdict verdict, std::vector<std::pair<double, double>> points, double cpu = 0) {
  Series s{{"curve", "method"}, {}, std::move(points)};
  s.outcome.verdict = verdict, s.outcome.process_seconds = cpu, s.outcome.reason = "no such thing";
  return s;
}

TEST(Disagreements, ConditionsLookAtCommonTimesAndAtVerdicts) {
  using enum Condition::Kind;
  const std::vector<Series> all{series(Verdict::ok, {{0, 0}, {1, 0}, {2, 0}}, 0.1),
                                series(Verdict::ok, {{0, 0}, {1, 1}, {2, 3}}),
                                series(Verdict::energy, {{0, 0}, {1, 1}}), series(Verdict::timeout, {{0, 0}}, 1),
                                series(Verdict::ok, {{0, NAN}})};
  EXPECT_TRUE(holds({apart, 1, 0, 2}, all));
  EXPECT_FALSE(holds({apart, 1, 0, 3}, all));
  EXPECT_FALSE(holds({apart, 1, 0, 2, 2}, all)) << "later times do not count";
  EXPECT_FALSE(holds({apart, 2, 0, 2}, all)) << "times reached by one run only do not count";
  EXPECT_TRUE(holds({within, 1, 0, 3}, all));
  EXPECT_FALSE(holds({within, 1, 0, 2}, all));
  EXPECT_FALSE(holds({within, 2, 0, 3}, all)) << "a failed run is never within a bound";
  EXPECT_TRUE(holds({apart, 4, 0, 1e300}, all));
  EXPECT_FALSE(holds({within, 4, 0, 1e300}, all));
  EXPECT_TRUE(holds({hangs, 3, 0, 9}, all));
  EXPECT_FALSE(holds({hangs, 3, 0, 11}, all)) << "a slow start is not a hang";
  EXPECT_FALSE(holds({hangs, 1, 0, 0}, all));
}

TEST(Disagreements, StateFollowsFromSymptomAndCause) {
  using enum Condition::Kind;
  Disagreement d;
  std::vector<Series> all{series(Verdict::ok, {{0, 0}}), series(Verdict::ok, {{0, 2}})};
  d.symptom = {{apart, 1, 0, 1}};
  EXPECT_EQ(state_of(d, all), TroubleState::reproduced);
  d.cause_removed = {{within, 0, 0, 0}};
  EXPECT_EQ(state_of(d, all), TroubleState::explained);
  d.cause_removed = {{within, 1, 0, 1}};
  EXPECT_EQ(state_of(d, all), TroubleState::reproduced);
  d.symptom = {{apart, 1, 0, 3}};
  EXPECT_EQ(state_of(d, all), TroubleState::not_reproduced);
  all.push_back(series(Verdict::crash, {}));
  EXPECT_EQ(state_of(d, all), TroubleState::not_asked);
  EXPECT_EQ(why_not_asked(d, all), "curve (method): no such thing");
  all.back() = series(Verdict::frozen, {{0, 0}});
  EXPECT_EQ(state_of(d, all), TroubleState::not_asked) << "a failed run cannot meet the condition";
  EXPECT_TRUE(why_not_asked(d, all).starts_with("curve (method): no such thing, ")) << why_not_asked(d, all);
  d.symptom = {{apart, 1, 0, 1}};
  EXPECT_EQ(state_of(d, all), TroubleState::reproduced) << "another run's failure does not hide the symptom";
}

TEST(Disagreements, AProgramTakesThePlaceOfBulletsWorlds) {
  const Disagreement d = with_worlds_of(row("network-in-pieces"), "exec:./other");
  EXPECT_EQ(d.world, "exec:./other");
  EXPECT_EQ(d.variants[0].method, "mysim/leapfrog");
  EXPECT_EQ(d.variants[1].method, "exec:./other+world=deformable-explicit+in-pieces+timeout=0.5");
  EXPECT_EQ(with_worlds_of(row("one-stiffness"), "exec:./other").world, "exec:./other+world=deformable-explicit");
}

/// Tests rows about an external program: the single-precision adapter, or an engine without Bullet's disagreements.
TEST(Disagreements, AreAskedOfAProgram) {
  const std::string adapter = "exec:" CROSSCHECK_BULLET32_PROGRAM, healthy = "exec:" CROSSCHECK_EXAMPLE;
  for (const auto name : {"one-stiffness", "gravity-factor"}) {
    const Disagreement d = row(name);
    const auto state = [&](const std::string& program) {
      return name_of(state_of(d, run_variants(with_worlds_of(d, program), scene_of(d))));
    };
    EXPECT_EQ(state(adapter), "explained") << name;
    EXPECT_EQ(state(healthy), "not reproduced") << name;
  }
  Disagreement d = with_worlds_of(row("gravity-factor"), adapter);
  d.variants[1].method += "+no-such-option";
  EXPECT_TRUE(contains(why_not_asked(d, run_variants(d, scene_of(d))), "unknown option '+no-such-option'"));
  Request request;
  request.methods = {find_method(adapter + "+world=pbd"), find_method(healthy + "+world=pbd")};
  try {
    find_experiment("disagreements").points(request);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_TRUE(contains(error.what(), "disagreements: expected one program with +world=, got exec:"));
  }
  request.methods = {find_method(healthy)};
  EXPECT_EQ(find_experiment("disagreements").points(request)[0].content,
            find_experiment("disagreements").points({})[0].content)
      << "a program without +world is not treated as Bullet";
}

TEST(Disagreements, LinkLawInMysimIsThePositionBasedWorlds) {
  const Disagreement d = row("link-law");
  const std::vector<Series> all = run_variants(d, scene_of(d));
  EXPECT_LT(apart(all[1], all[2]), 0.1 * apart(all[0], all[1]));
}

/// Direction of contact for a ball whose distance field is given on a grid: the gradient of the trilinear interpolation
/// in a voxel.
Vec3 gradient_of_the_grid(const Vec3& x, double radius, double voxel) {
  const Eigen::Array3d at = (x / voxel).array(), low = at.floor(), part = at - low;
  Vec3 gradient = Vec3::Zero();
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Array3d up(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    const double distance = (voxel * (low + up)).matrix().norm() - radius;
    const Eigen::Array3d weight = up * part + (1 - up) * (1 - part);
    for (int axis = 0; axis < 3; ++axis)
      gradient[axis] += (up[axis] > 0 ? 1 : -1) * distance * weight[(axis + 1) % 3] * weight[(axis + 2) % 3];
  }
  return gradient.normalized();
}

TEST(Disagreements, DirectionOfContactIsTheGradientOfTheGridInAVoxel) {
  const Scene scene = read_scene(file_of_disagreement("contact-direction"));
  std::vector<double> angles;
  for (double degrees = 2.22; degrees < 45; degrees += 3.1) angles.push_back(degrees * std::numbers::pi / 180);
  for (const double voxel : {0.005, 0.02}) {
    const auto errors = direction_errors(fmt::format("bullet/deformable-explicit+voxel={:g}", voxel), scene, angles);
    double largest = 0;
    for (const DirectionError& e : errors) {
      SCOPED_TRACE(fmt::format("{:.3g} degrees, voxel {:g} m", e.angle * 180 / std::numbers::pi, voxel));
      // No position is within 0.3 mm of a face between voxels. The particle starts on the surface and stays within 0.1
      // mm of it.
      const Vec3 n = gradient_of_the_grid(1.02 * Vec3(std::sin(e.angle), std::cos(e.angle), 0), 1, voxel);
      const double in_plane = std::atan2(n.x(), n.y()) - e.angle, sideways = std::asin(n.z());
      fmt::print("{:.4f} rad, voxel {:g} m: in plane {:+.2e}, by the grid {:+.2e}; sideways {:+.2e}, {:+.2e}\n",
                 e.angle, voxel, e.in_plane, in_plane, e.sideways, sideways);
      // The displacement d of the particle turns the gradient by at most d / R = 6e-5.
      EXPECT_NEAR(e.in_plane, in_plane, 1e-4);
      EXPECT_NEAR(e.sideways, sideways, 1e-4);
      largest = std::max(largest, std::abs(e.in_plane));
    }
    EXPECT_GT(largest, 0.2 * voxel);
    EXPECT_LT(largest, 0.5 * voxel);  // a / 2R
  }
  for (const DirectionError& e : direction_errors("mysim/leapfrog", scene, angles)) {
    EXPECT_NEAR(e.in_plane, 0, 1e-4);
    EXPECT_NEAR(e.sideways, 0, 1e-12);
  }
}

TEST(Disagreements, EverySceneFileIsInTheTableAndEveryRowHasOne) {
  std::set<std::string> files, rows;
  for (const auto& entry : std::filesystem::directory_iterator(CROSSCHECK_SOURCE "/experiments/scenes/disagreements")) {
    EXPECT_EQ(entry.path().extension(), ".toml");
    files.insert(entry.path().stem());
  }
  for (const Disagreement& d : disagreements()) EXPECT_TRUE(rows.insert(d.name).second) << d.name;
  std::set<std::string> names = rows;
  for (const Disagreement& d : engine_disagreements()) {
    EXPECT_TRUE(names.insert(d.name).second) << d.name;
    rows.insert(d.scene.empty() ? d.name : d.scene);  // several rows may share a scene
  }
  EXPECT_EQ(files, rows);
}

TEST(Disagreements, ExperimentWritesACurveForEachAndOneSummary) {
  const TableSet result = computed(find_experiment("disagreements").points({}));
  const Table* summary = result.table("disagreements");
  ASSERT_TRUE(summary);
  EXPECT_EQ(summary->rows.size(), disagreements().size());
  for (const Disagreement& d : disagreements()) {
    const Table* curves = result.table(d.name + "-disagreement");
    ASSERT_TRUE(curves) << d.name;
    std::set<std::string> labels;
    for (size_t row = 0; row < curves->rows.size(); ++row)
      labels.insert(std::get<std::string>(curves->at(row, "curve")));
    EXPECT_EQ(labels.size(), d.variants.size());
  }
  std::map<std::string, std::string> texts;
  for (const UpstreamText& text : upstream_texts(result, "Bullet 9.9")) texts[text.file] = text.text;
  ASSERT_EQ(texts.size(), 3u);
  for (const DisagreementRow& d : rows_of<DisagreementRow>(*summary)) {
    EXPECT_TRUE(contains(texts["upstream-gallery.md"], d.effect)) << d.name;
    EXPECT_TRUE(contains(texts["upstream-gallery.md"], d.criterion)) << d.name;
  }
  for (const auto name : {"network-in-pieces", "contact-direction"}) {
    const std::string& text = texts[fmt::format("upstream-{}.md", name)];
    EXPECT_TRUE(contains(text, fmt::format("Version: Bullet 9.9, {}.", row(name).world))) << text;
    EXPECT_TRUE(contains(text, "int main(")) << text;
    for (const auto key : {"{version}", "{program}", "{effect}", "{threads}"}) EXPECT_FALSE(contains(text, key)) << key;
  }
}

TEST(Disagreements, WhatIsNotThereIsNotReported) {
  TableSet rows;
  Table table = table_of<DisagreementRow>();
  add(table, DisagreementRow{"network-in-pieces", "exec:./other", "it hangs", "why", "it ends", "x#1", "not reproduced",
                             "as said", "0"});
  rows.add(table);
  const auto texts = upstream_texts(rows, "Bullet 9.9");
  ASSERT_EQ(texts.size(), 1u);
  EXPECT_TRUE(contains(texts[0].text, "**not reproduced** · scene `network-in-pieces` · exec:./other"));
  EXPECT_TRUE(contains(texts[0].text, "Upstream: x#1."));
  EXPECT_TRUE(upstream_texts({}, "Bullet 9.9").empty());
}

}  // namespace
}  // namespace crosscheck
