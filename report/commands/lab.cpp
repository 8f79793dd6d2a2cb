#include "report/commands/command_line.h"
#include "report/page/lab_html.h"

namespace crosscheck {
namespace {

struct LabOptions {
  std::vector<std::string> scenes;
  std::string file;
};

int lab_command(const LabOptions& options) {
  const std::vector<Scene> scenes = load_scenes(options.scenes);
  if (!options.file.ends_with(".html"))
    throw InputError(fmt::format("lab: -o: expected a file name such as lab.html, got '{}'", options.file));
  write_file(options.file, lab_page_html(scenes));
  fmt::print("{}\n", options.file);
  return 0;
}

}  // namespace

void add_lab(CLI::App& app, Invocation& call) {
  auto [lab, options] =
      add_command(app, call, "lab", "writes a page that runs mysim live, next to the reference solution", lab_command);
  lab.add_option("SCENE", options.scenes, "shipped scenes or TOML files")->required();
  lab.add_option("-o", options.file, "the page, FILE.html");
}

}  // namespace crosscheck
