// Part 5: the complete right-hand side and its consequences.

#include "mysim/steppers/steppers.h"
#include "tests/coursework/a3-cloth/cases.h"

namespace coursework::a3 {
namespace {

using crosscheck::State;

struct Scene {
  Sheet sheet;
  Points v;
  std::vector<double> mass;
  std::vector<int> pins;
  std::vector<std::array<int, 3>> faces;
  Vec3 gravity;
  double drag;
  Breeze breeze;

  crosscheck::Model model(double t) const;
  Numbers numbers() const;
};

crosscheck::Model Scene::model(double t) const {
  const int count = static_cast<int>(mass.size());
  crosscheck::Model model;
  crosscheck::Particles& p = model.particles;
  p.mass = Eigen::Map<const Eigen::VectorXd>(mass.data(), count);
  p.pins = pins;
  p.pinned.assign(count, 0);
  p.pin_home.resize(3, static_cast<int>(pins.size()));
  for (int i = 0; i < p.pin_home.cols(); ++i) {
    p.pinned[pins[i]] = 1;
    p.pin_home.col(i) = sheet.x.col(pins[i]);
  }
  model.terms = {crosscheck::Gravity{gravity}, crosscheck::Springs{sheet.springs},
                 crosscheck::Drag{Eigen::VectorXd::Constant(count, drag)}};
  if (breeze.on) model.terms.push_back(aerodynamics(breeze, t, faces));
  return model;
}

Numbers Scene::numbers() const {
  Numbers in;
  in.push_back(static_cast<double>(mass.size()));
  in.insert(in.end(), mass.begin(), mass.end());
  in.push_back(static_cast<double>(pins.size()));
  in.insert(in.end(), pins.begin(), pins.end());
  put(in, sheet.springs);
  put(in, faces);
  put(in, gravity);
  in.push_back(drag);
  put(in, breeze);
  put(in, sheet.x);
  put(in, v);
  return in;
}

Scene scene_of(Random& random, const Sheet& sheet) {
  Scene scene{sheet, {}, {}, {}, {}, {}, random.uniform(0.05, 0.1), random_breeze(random)};
  const int count = scene.sheet.mesh.size();
  scene.v.resize(3, count);
  for (int i = 0; i < count; ++i) {
    scene.v.col(i) = random_vector(random, 1);
    // random numbers of few digits could be equal
    scene.mass.push_back(random.rounds() ? 0.02 + 0.01 * i : random.uniform(0.02, 0.04));
  }
  if (scene.sheet.mesh.rows > 1) scene.faces = grid_triangles(grid_of(scene.sheet.mesh, 1, 0, 0));
  scene.gravity = Vec3(0, -9.81, 0) + random_vector(random, 1);
  return scene;
}

Scene random_scene(Random& random) { return scene_of(random, random_sheet(random, 3, 4, 0.03)); }

template <class Make>
Cases small_scenes(Random& random, Make make) {
  Cases cases;
  for (const int size : {1, 2, 4}) {
    Scene scene = scene_of(random, small_sheet(random, size, 0.03));
    scene.breeze.on = size == 4;
    cases.push_back(make(scene));
  }
  return cases;
}

/// x' and v' of each particle, computed by mysim.
Points rates_of(const Scene& scene, const Points& x, const Points& v, double t) {
  const crosscheck::Model model = scene.model(t);
  crosscheck::System system(model);
  State stage{t, x, v}, rate = stage;
  system.derivative(stage, rate);
  Eigen::MatrixXd both(6, x.cols());
  both << rate.x, rate.v;
  return Eigen::Map<const Points>(both.data(), 3, 2 * x.cols());
}

Case rates_case(const char* call, const Scene& scene) {
  // each acceleration is at most 3000 m/s^2 and a sum of some 20 terms, so that its round-off is below 1e-11
  return {.call = call, .in = scene.numbers(), .columns = 6, .tolerance = 1e-8, .row = "particle", .column = "rates"};
}

void pin_upper_corners(Scene& scene) { scene.pins = {0, scene.sheet.mesh.columns - 1}; }

}  // namespace

namespace {

Case rates_at(const Scene& scene, double t) {
  Case c = rates_case("derivative", scene);
  c.in.push_back(t);
  c.expected = numbers_of(rates_of(scene, scene.sheet.x, scene.v, t));
  return c;
}

}  // namespace

Cases rates(Random& random) {
  const Scene scene = random_scene(random);
  return {rates_at(scene, random.uniform(0.2, 2))};
}
Cases small_rates(Random& random) {
  return small_scenes(random, [](const Scene& scene) { return rates_at(scene, 1); });
}

// pins have velocities here, but must not move
Cases pinned_rates(Random& random) {
  Scene scene = random_scene(random);
  pin_upper_corners(scene);
  scene.breeze.on = false;
  return {rates_at(scene, random.uniform(0.2, 2))};
}
Cases small_pinned_rates(Random& random) {
  return small_scenes(random, [](Scene& scene) {
    scene.pins = {0};
    scene.breeze.on = false;
    return rates_at(scene, 1);
  });
}

namespace {

Case again(Random& random, const Scene& scene) {
  Points x = scene.sheet.x, v = scene.v;
  for (int i = 0; i < x.cols(); ++i) {
    x.col(i) += random_vector(random, 0.03);
    v.col(i) += random_vector(random, 1);
  }
  const double t = random.uniform(0.2, 2);
  Case c = rates_case("derivative_again", scene);
  c.columns = 18;
  c.column = "rates_again";
  put(c.in, x);
  put(c.in, v);
  c.in.push_back(t);
  const Points first = rates_of(scene, scene.sheet.x, scene.v, t), other = rates_of(scene, x, v, t);
  for (int i = 0; i < x.cols(); ++i)
    for (const Points* one : {&first, &other, &first}) put(c.expected, Points(one->middleCols(2 * i, 2)));
  return c;
}

}  // namespace

Cases rates_again(Random& random) { return {again(random, random_scene(random))}; }
Cases small_rates_again(Random& random) {
  Cases cases = small_scenes(random, [&](const Scene& scene) { return again(random, scene); });
  cases.pop_back();  // leaves out the cell of four particles: two states of it are too many numbers to read
  return cases;
}

Cases hanging_strip(Random& random) {
  // a column hangs from its first particle: each spring stretches by the weight below it divided by its stiffness
  Scene scene{};
  const int count = random.integer(4, 6);
  const double g = random.uniform(5, 12);
  scene.sheet.x.resize(3, count);
  const Vec3 top = random_vector(random, 1);
  for (int i = 0; i < count; ++i) {
    scene.mass.push_back(random.uniform(0.08, 0.12));
    scene.sheet.x.col(i) = top - Vec3(0, 0.2 * i, 0);
    if (i > 0) scene.sheet.springs.push_back({i - 1, i, random.uniform(80, 120), 0.2});
  }
  scene.v = Points::Zero(3, count);
  scene.pins = {0};
  scene.gravity = {0, -g, 0};
  scene.drag = 1;
  const double h = 0.005;
  const int steps = 1600;
  Case c{.call = "cloth_end", .in = scene.numbers(), .columns = 3, .row = "particle", .column = "position"};
  c.in.insert(c.in.end(), {h, double(steps)});
  Points rest = scene.sheet.x;
  double fallen = 0;
  for (int i = 1; i < count; ++i) {
    double below = 0;
    for (int j = i; j < count; ++j) below += scene.mass[j] * g;
    fallen += below / scene.sheet.springs[i - 1].k;
    rest(1, i) -= fallen;
  }
  c.expected = numbers_of(rest);
  // drag damps every mode at least as fast as exp(-4 t), so that 1e-14 of the initial 0.5 m is left after 8 s. The
  // round-off is 1e-13
  c.tolerance = 1e-9;
  c.plot_x = 0;
  c.plot_y = 1;
  return {c};
}

Cases swinging_cloth(Random& random) {
  Scene scene = random_scene(random);
  pin_upper_corners(scene);
  for (int pin : scene.pins) scene.v.col(pin).setZero();
  scene.breeze.gust = 0;  // mysim defines gusts differently
  const double h = 0.004;
  const int steps = 75, watched = scene.sheet.mesh.size() - 1;
  Case c{.call = "cloth_path", .in = scene.numbers(), .columns = 3, .row = "step", .column = "position"};
  c.in.insert(c.in.end(), {h, double(steps), double(watched)});
  const crosscheck::Model model = scene.model(0);
  crosscheck::System system(model);
  State state{0, scene.sheet.x, scene.v};
  crosscheck::Workspace work(state);
  for (int n = 0; n < steps; ++n) {
    trapezoidal(system, state, h, work);
    state.t = (n + 1) * h;
    put(c.expected, Vec3(state.x.col(watched)));
  }
  // mysim uses the same rule with the same order of stages. On 20 seeds the round-off was at most 1e-14 m, and a cloth
  // with this drag cannot amplify round-off by 1e5 in 0.3 s
  c.tolerance = 1e-9;
  c.plot_x = 0;
  c.plot_y = 1;
  c.row_size = h;
  return {c};
}

}  // namespace coursework::a3
