// Separate from scene.cpp so that the engine can be built without file access.
#include "mysim/base/files.h"
#include "mysim/base/names.h"
#include "mysim/scene/scene.h"

namespace crosscheck {

Scene read_scene(const std::string& file) {
  const std::string name = std::filesystem::path(file).stem().string();
  return parse_scene(read_file(file, "a scene file (TOML)"), file, file_name_of(require_name(name, "scene " + file)));
}

}  // namespace crosscheck
