// Tests sequences of mesh files with independent readers, and with another program if it is available.

#include <gtest/gtest.h>

#include <cstring>
#include <numbers>
#include <set>
#include <sstream>

#include "experiments/scenes/scenes.h"
#include "mysim/base/files.h"
#include "report/base/mesh_files.h"
#include "tests/unit/reference/helpers.h"

namespace crosscheck::testing_tools {
namespace {

struct ReadBack {
  std::vector<double> x;
  Shape shape;
};

ReadBack read_obj(const std::string& text) {
  ReadBack read;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "v")
      for (double value; words >> value;) read.x.push_back(value);
    std::vector<int> corners;
    if (kind == "f" || kind == "l")
      for (int i; words >> i;) corners.push_back(i - 1);
    if (kind == "f") read.shape.triangles.push_back({corners.at(0), corners.at(1), corners.at(2)});
    if (kind == "l") read.shape.lines.emplace_back(corners.at(0), corners.at(1));
  }
  return read;
}

ReadBack read_ply(const std::string& bytes) {
  ReadBack read;
  std::istringstream in(bytes);
  std::map<std::string, std::size_t> count;
  for (std::string line; std::getline(in, line) && line != "end_header";) {
    std::istringstream words(line);
    std::string word, element;
    if (words >> word >> element && word == "element") words >> count[element];
  }
  const auto next = [&](auto value) {
    in.read(reinterpret_cast<char*>(&value), sizeof value);
    return value;
  };
  for (std::size_t i = 0; i < 3 * count["vertex"]; ++i) read.x.push_back(next(0.0));
  for (std::size_t i = 0; i < count["face"]; ++i) {
    EXPECT_EQ(next(std::uint8_t{}), 3);
    auto& triangle = read.shape.triangles.emplace_back();
    for (int& corner : triangle) corner = next(std::int32_t{});
  }
  for (std::size_t i = 0; i < count["edge"]; ++i) {
    const int a = next(std::int32_t{});
    read.shape.lines.emplace_back(a, next(std::int32_t{}));
  }
  EXPECT_TRUE(in.good());
  EXPECT_EQ(in.peek(), std::char_traits<char>::eof());
  return read;
}

struct Written {
  explicit Written(const std::string& scene_name, const std::string& form)
      : folder("meshes"), scene(load_scene(scene_name)), writer(folder.path, scene, form) {
    Run run = default_run(scene);
    run.duration /= 10, run.samples = 3;
    run_method(find_method("leapfrog"), scene, run, {&recorder, &writer});
  }
  TemporaryFolder folder;
  Scene scene;
  Recorder recorder;
  MeshWriter writer;
};

TEST(MeshFiles, HoldEachSampleToTheLastBit) {
  for (const char* name : {"cloth-student", "chain", "projectile"})
    for (const std::string form : {"obj", "ply"}) {
      SCOPED_TRACE(std::string(name) + " " + form);
      const Written written(name, form);
      ASSERT_EQ(written.writer.frames(), 4);
      for (int i = 0; i < 4; ++i) {
        const std::string bytes = read_file(written.folder.path / fmt::format("frame-{:04}.{}", i + 1, form), "a mesh");
        const ReadBack read = form == "obj" ? read_obj(bytes) : read_ply(bytes);
        const Points& x = written.recorder.trajectory.x[i];
        EXPECT_TRUE(std::equal(read.x.begin(), read.x.end(), x.data(), x.data() + x.size()));
        EXPECT_EQ(read.shape.triangles, written.scene.triangles);
        EXPECT_EQ(read.shape.lines, shape_of(written.scene).lines);
      }
    }
}

TEST(MeshFiles, TrianglesAreClothLinesAreSprings) {
  const Shape cloth = shape_of(load_scene("cloth-student")), chain = shape_of(load_scene("chain"));
  EXPECT_FALSE(cloth.triangles.empty());
  EXPECT_TRUE(cloth.lines.empty());
  EXPECT_TRUE(chain.triangles.empty());
  EXPECT_EQ(chain.lines, (std::vector<std::pair<int, int>>{{0, 1}, {1, 2}, {2, 3}}));
}

/// Volume by the divergence theorem; the triangles must be counter-clockwise as seen from outside.
double volume_inside(const Points& x, const std::vector<std::array<int, 3>>& triangles) {
  double six_volumes = 0;
  for (const auto& [a, b, c] : triangles) six_volumes += x.col(a).dot(Vec3(x.col(b)).cross(Vec3(x.col(c))));
  return six_volumes / 6;
}

TEST(MeshFiles, ABallIsClosedAndRoundAndSeenFromOutside) {
  const double radius = 0.4;
  const auto [x, shape] = ball_mesh(radius);
  for (Eigen::Index i = 0; i < x.cols(); ++i) EXPECT_NEAR(x.col(i).norm(), radius, 1e-15);
  std::set<std::pair<int, int>> edges;
  for (const auto& [a, b, c] : shape.triangles)
    for (const auto& edge : {std::pair(a, b), {b, c}, {c, a}}) EXPECT_TRUE(edges.insert(edge).second);
  for (const auto& [a, b] : edges) EXPECT_TRUE(edges.count({b, a}));
  EXPECT_EQ(x.cols() - edges.size() / 2 + shape.triangles.size(), 2u);  // Euler's characteristic
  // facets dip below the sphere by a distance of second order in the angle pi / 32 between neighbouring vertices
  const double ball = 4 * std::numbers::pi / 3 * std::pow(radius, 3), dip = std::pow(std::numbers::pi / 32, 2);
  EXPECT_LT(volume_inside(x, shape.triangles), ball);
  EXPECT_GT(volume_inside(x, shape.triangles), ball * (1 - dip));
}

TEST(MeshFiles, SpheresStandBesideTheFramesAndMoveWithThem) {
  for (const char* name : {"cloth-carried", "bounce"}) {
    SCOPED_TRACE(name);
    const Written written(name, "ply");
    const auto& list = written.scene.model.find<Spheres>()->list;
    const auto& times = written.recorder.trajectory.t;
    std::size_t files = times.size();
    for (std::size_t i = 0; i < list.size(); ++i)
      for (std::size_t frame = 0; frame < (list[i].motion ? times.size() : 1); ++frame, ++files) {
        const std::string file =
            list[i].motion ? fmt::format("sphere-{}-{:04}.ply", i + 1, frame + 1) : fmt::format("sphere-{}.ply", i + 1);
        const ReadBack read = read_ply(read_file(written.folder.path / file, "a sphere"));
        const Vec3 centre = list[i].centre_at(times[frame]);
        ASSERT_EQ(read.x.size(), 3u * ball_mesh(1).first.cols());
        for (std::size_t v = 0; v < read.x.size(); v += 3)
          EXPECT_NEAR((Vec3(read.x[v], read.x[v + 1], read.x[v + 2]) - centre).norm(), list[i].radius, 1e-14);
      }
    const auto all = std::filesystem::directory_iterator(written.folder.path);
    EXPECT_EQ(static_cast<std::size_t>(std::distance(begin(all), end(all))), files);
  }
}

TEST(MeshFiles, AnotherFormIsRefused) {
  try {
    MeshWriter("out", load_scene("chain"), "fbx");
    ADD_FAILURE() << "expected an error for fbx";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "--meshes fbx: expected obj or ply");
  }
}

TEST(MeshFiles, AnotherProgramReadsThem) {
  NEEDS_PROGRAM("assimp", "assimp-utils", "reading meshes by another program is not tested");
  for (const std::string form : {"obj", "ply"}) {
    const Written written("cloth-student", form);
    const ProgramResult told = run_program({"assimp", "info", "frame-0004." + form}, written.folder.path);
    EXPECT_EQ(told.status, 0) << told.out << told.err;
    const auto number = [&](const char* what) {
      std::istringstream lines(told.out);
      for (std::string line; std::getline(lines, line);)
        if (line.starts_with(what)) return std::stoul(line.substr(line.find(':') + 1));
      return 0ul;
    };
    EXPECT_EQ(number("Faces:"), written.scene.triangles.size()) << told.out;
    EXPECT_GE(number("Vertices:"), static_cast<unsigned long>(written.scene.model.particles.size())) << told.out;
  }
}

}  // namespace
}  // namespace crosscheck::testing_tools
