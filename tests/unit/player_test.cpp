// What the page's player is given: packed numbers come back, places lie within the stated bound, failures are told.
#include <gtest/gtest.h>

#include <random>

#include "experiments/scenes.h"
#include "mysim/json.h"
#include "report/player/packed_numbers.h"
#include "report/player/player_data.h"
#include "report/player/quantised.h"
#include "tests/unit/unpacked.h"

namespace crosscheck {
namespace {

using testing_tools::unpacked;

std::vector<std::uint16_t> numbers_of(const JsonField& p) {
  return unpacked(p["count"].natural(), p["lag"].natural(), p["order"].whole_number(0, 9), p["data"].text());
}

/// A number of a lattice, which wrapped at 2^16.
int lattice_number(std::uint16_t n) { return n < 65536 - 24576 ? n : n - 65536; }

TEST(PackedNumbers, AnyNumbersComeBack) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    std::vector<std::uint16_t> numbers(random() % 3000);
    for (auto& n : numbers) n = static_cast<std::uint16_t>(random());
    for (const int order : {0, 1, 2}) {
      const size_t lag = 1 + random() % 40;
      const Packed p = packed(numbers, lag, order);
      EXPECT_EQ(unpacked(p.count, p.lag, p.order, p.data), numbers) << "seed " << seed << ", order " << order;
    }
  }
}

TEST(PackedNumbers, EvenMotionTakesHardlyAnyRoom) {
  std::vector<std::uint16_t> numbers;
  for (int frame = 0; frame < 150; ++frame)
    for (int i = 0; i < 300; ++i) numbers.push_back(static_cast<std::uint16_t>(40 * i + 7 * frame));
  EXPECT_LT(packed(numbers, 300, 2).data.size(), 2000u);
}

TEST(QuantisedPlaces, NoneIsFurtherFromItsNumberThanTheBound) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> part(-1, 1);
    // boxes of millimetres to a hundred metres, also far from the origin, also flat
    const double size = std::pow(10, 3.5 * part(random) - 0.5);
    const Vec3 middle = 50 * part(random) * Vec3(part(random), part(random), part(random));
    std::vector<Points> frames(7, Points(3, 40));
    for (Points& x : frames) {
      for (double& c : x.reshaped()) c = size * part(random);
      x.colwise() += middle;
      if (seed % 4 == 0) x.row(2).setConstant(0.25);
    }
    const QuantisedPlaces q = quantised(frames);
    // a unit is the 16383rd part of the box, whose edges are 2 `size` at most
    EXPECT_LE(q.bound, std::sqrt(3) / 2 * 2 * size / 16383 + 1e-9);
    double worst = 0;
    size_t at = 0;
    for (const Points& x : frames)
      for (Eigen::Index i = 0; i < x.cols(); ++i, at += 3) {
        Vec3 drawn = q.low;
        for (int k = 0; k < 3; ++k) drawn[k] += q.unit[k] * q.numbers[at + k];
        worst = std::max(worst, (drawn - x.col(i)).norm());
      }
    EXPECT_LE(worst, q.bound) << "seed " << seed;
    EXPECT_GT(worst, q.bound / 3) << "the bound is no larger than it has to be, seed " << seed;
  }
}

TEST(SharedLattice, TellsPlacesAroundItsBoxApartAndRefusesThoseBeyond) {
  Points around = Points::Zero(3, 2);
  around.col(1) << 2, 1, 0;  // m: the longest side is 2
  const Lattice lattice = lattice_around(std::span(&around, 1));
  EXPECT_DOUBLE_EQ(lattice.unit, 2. / 16383);
  for (const double x : {-2.99, -1., 0., 1.7, 4.99}) {
    const auto numbers = lattice.numbers_of(std::vector<Points>{Points::Constant(3, 1, x)});
    ASSERT_TRUE(numbers) << x;
    EXPECT_NEAR(lattice.unit * lattice_number((*numbers)[0]), x, lattice.unit / 2 + 1e-12);
  }
  for (const double x : {-3.01, 5.01, 1e300, double(NAN)})
    EXPECT_FALSE(lattice.numbers_of(std::vector<Points>{Points::Constant(3, 1, x)})) << x;
}

TEST(SharedLattice, OfASinglePlaceIsOneToo) {
  const Lattice lattice = lattice_around(std::vector<Points>{Points::Constant(3, 1, 0.5)});
  EXPECT_GT(lattice.unit, 0);
  EXPECT_TRUE(lattice.numbers_of(std::vector<Points>{Points::Constant(3, 1, 0.5)}));
}

class PlayerData : public testing::Test {
 protected:
  JsonField data_of(const Scene& scene, const std::vector<std::string>& methods) {
    Request request;
    request.scenes = {scene};
    std::vector<const Answer*> shown;
    for (const std::string& name : methods) shown.push_back(&answer_of(request, scene, find_method(name), answers_));
    return JsonField::parse(player_json(scene, shown, truth_of(scene, run_of(request, scene))), "player");
  }
  Answers answers_;
};

TEST_F(PlayerData, PlacesOfTheChainAreThoseOfItsRunInEachFrame) {
  const Scene scene = load_scene("chain");
  const JsonField data = data_of(scene, {"mysim/leapfrog", "mysim/rk4"});
  ASSERT_EQ(data["times"].size(), 151u);
  ASSERT_EQ(data["methods"].size(), 3u) << "two methods and the truth";
  const JsonField method = data["methods"][0];
  const auto numbers = numbers_of(method["places"]);
  const int n = scene.model.particles.size();
  ASSERT_EQ(numbers.size(), 151u * 3 * n);
  EXPECT_FALSE(method.find("over").has_value());
  const double bound = data["finest"].number();
  for (int f = 0; f < 151; ++f)
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(
            method["low"][k].number() + method["unit"][k].number() * lattice_number(numbers[3 * (f * n + i) + k]),
            answers_[0].trajectory.x[f](k, i), bound);
  EXPECT_EQ(data["springs"]["families"][0]["count"].number(), n - 1);
  EXPECT_TRUE(data["floor"].is_null()) << "all lies in a plane";
}

TEST_F(PlayerData, TheSameMotionTwiceTakesItsRoomOnce) {
  const Scene scene = load_scene("chain");
  const JsonField data = data_of(scene, {"mysim/symplectic-euler", "bullet/deformable-explicit"});
  const JsonField ours = data["methods"][0], theirs = data["methods"][1];
  ASSERT_EQ(theirs["over"].number(), 0);
  EXPECT_LT(theirs["places"]["data"].text().size(), 100u);
  // what is left of a motion that is not quite the same comes back
  const JsonField truth = data["methods"][2];
  const auto first = numbers_of(ours["places"]), own = numbers_of(truth["places"]);
  const auto path = truth_of(scene, run_of({{scene}}, scene))->trajectory;
  const auto n = static_cast<size_t>(3 * scene.model.particles.size());
  for (size_t i = 0; i < own.size(); ++i) {
    const auto number = static_cast<std::uint16_t>(own[i] + (truth.find("over").has_value() ? first[i] : 0));
    EXPECT_NEAR(truth["low"][i % 3].number() + truth["unit"][i % 3].number() * lattice_number(number),
                path.x[i / n].reshaped()[static_cast<Eigen::Index>(i % n)], data["finest"].number());
  }
}

TEST_F(PlayerData, ARunThatBlewUpEndsNearTheOthersAndSaysWhenAndWhy) {
  const Scene scene = load_scene("chain");
  const JsonField data = data_of(scene, {"mysim/leapfrog", "mysim/explicit-euler"});
  const JsonField failed = data["methods"][1];
  EXPECT_LT(failed["frames"].number(), 151);
  EXPECT_NE(failed["failure"].text().find(" s"), std::string::npos) << failed["failure"].text();
  EXPECT_EQ(failed["reason"].text(), "ten times too fast");
  EXPECT_LE(failed["stops"].number(), failed["failed"].number());
  for (int k = 0; k < 3; ++k) EXPECT_LT(failed["unit"][k].number() * 16383, 20) << "m: within sight";
  EXPECT_EQ(data["methods"][0]["failure"].text(), "");
}

TEST_F(PlayerData, DistancesFromTheContactRuleAreDifferencesAndEndWithIt) {
  const Scene scene = load_scene("cloth-sphere");
  const JsonField data = data_of(scene, {"mysim/symplectic-euler"});
  ASSERT_TRUE(data["distance"].is_object());
  EXPECT_EQ(data["distance"]["name"].text(), "difference from the converged contact rule");
  const JsonField distance = data["methods"][0]["distance"];
  const double frames = distance["count"].number() / scene.model.particles.size();
  EXPECT_LE((frames - 1) * scene.duration / scene.samples, scene.window + 1e-9);
  const auto levels = numbers_of(distance);
  EXPECT_LE(*std::max_element(levels.begin(), levels.end()), 63);
}

}  // namespace
}  // namespace crosscheck
