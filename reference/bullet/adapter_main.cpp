// Bullet as a program of the engine protocol: the same worlds in a different precision, or with a different Bullet.
//
//   PROGRAM scene.json OUTDIR [world=deformable-explicit | world=pbd ...] [options of that world]

#include "reference/bullet/worlds.h"
#include "reference/protocol/adapter.h"

using namespace crosscheck;

int main(int argc, char** argv) {
  return run_as_program(argc, argv, [](const std::vector<std::string>& asked) {
    std::string world = "deformable-explicit";
    std::vector<std::string> options;
    for (const std::string& option : asked) {
      if (option.starts_with("world="))
        world = option.substr(6);
      else
        options.push_back(option);
    }
    return bullet::choose_world(world, options).engine;
  });
}
