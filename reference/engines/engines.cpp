#include "reference/engines/engines.h"

#include <fmt/format.h>
#include <unistd.h>

#include "mysim/base/installation.h"
#include "mysim/base/json.h"

namespace crosscheck {
namespace fs = std::filesystem;

std::vector<OutsideEngine> outside_engines() {
  std::vector<OutsideEngine> all;
  for (const JsonField& row :
       JsonField::parse_file((data_folder() / "reference/engines/engines.json").string())["engines"].elements()) {
    OutsideEngine engine;
    for (const auto& [key, value] : row.items()) {
      struct {
        const char* key;
        std::string OutsideEngine::*member;
      } const members[] = {{"name", &OutsideEngine::name},
                           {"title", &OutsideEngine::title},
                           {"built", &OutsideEngine::built},
                           {"licence", &OutsideEngine::licence},
                           {"precision", &OutsideEngine::precision},
                           {"rule", &OutsideEngine::rule},
                           {"forces", &OutsideEngine::forces},
                           {"source", &OutsideEngine::source},
                           {"cmake", &OutsideEngine::cmake},
                           {"module", &OutsideEngine::module},
                           {"package", &OutsideEngine::package},
                           {"header", &OutsideEngine::header},
                           {"npm", &OutsideEngine::npm},
                           {"prefix", &OutsideEngine::prefix},
                           {"prefix_file", &OutsideEngine::prefix_file}};
      const auto* member = std::ranges::find(members, key, [](const auto& m) { return std::string_view(m.key); });
      if (member != std::end(members))
        engine.*(member->member) = value.text();
      else if (key == "flags")
        engine.flags = value.texts();
      else
        value.fail("one of the keys that engines.h lists");
    }
    all.push_back(std::move(engine));
  }
  return all;
}

fs::path kept_program(const std::string& engine) {
  return cache_folder().value_or(fs::temp_directory_path() / fmt::format("crosscheck-{}", getuid())) / "engines/built" /
         engine;
}

std::optional<OutsideEngine> kept_engine_of(const std::string& method) {
  if (!method.starts_with("exec:")) return std::nullopt;
  for (OutsideEngine& engine : outside_engines()) {
    const std::string kept = "exec:" + kept_program(engine.name).string();
    if (method == kept || method.starts_with(kept + "+")) return std::move(engine);
  }
  return std::nullopt;
}

std::string without_folders(const std::string& method) {
  const std::string kept = "exec:" + kept_program("").string();
  return method.starts_with(kept) ? method.substr(kept.size()) : method;
}

std::string command_to_build(const OutsideEngine& engine) {
  const bool needs_prefix = engine.source.empty() && engine.npm.empty();
  return fmt::format("crosscheck engine {}{}", engine.name, needs_prefix ? " --prefix DIR" : "");
}

}  // namespace crosscheck
