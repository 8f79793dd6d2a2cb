// Scenes from files: apart from what they mean, so that the engine can be built where there are none.
#include "mysim/base/files.h"
#include "mysim/scene/scene.h"

namespace crosscheck {

Scene read_scene(const std::string& file) {
  return parse_scene(read_file(file, "a scene file (TOML)"), file,
                     file_name_of(std::filesystem::path(file).stem().string()));
}

}  // namespace crosscheck
