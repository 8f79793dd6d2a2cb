// Mesh sequences: read back by readers of their own here, and by another program where it is there.

#include <gtest/gtest.h>

#include <cstring>
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

/// A short run's states, and the files of its samples.
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

TEST(MeshFiles, AnotherFormIsRefused) {
  try {
    MeshWriter("out", load_scene("chain"), "fbx");
    ADD_FAILURE() << "fbx was taken";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "--meshes fbx: expected obj or ply");
  }
}

TEST(MeshFiles, AnotherProgramReadsThem) {
  NEEDS_PROGRAM("assimp", "assimp-utils", "no other program reads meshes");
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
