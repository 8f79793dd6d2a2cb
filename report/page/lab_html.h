// The lab in the page: the engine's module, the scenes as text, and scripts (report/lab/).
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "mysim/base/json.h"
#include "mysim/scene/scene.h"

namespace crosscheck {

/// Debian's packages for building the module, including the C library.
inline constexpr std::string_view lab_packages = "clang lld libc++-dev-wasm32 libclang-rt-dev-wasm32 binaryen";

bool has_lab_module();
std::filesystem::path lab_module_file();

/// The module, the given scenes, and those of the guided experiments, for the end of a page. Empty without a module.
Json lab_data(const std::vector<Scene>& scenes);

/// A page that contains only the lab. Throws InputError, which lists the packages to install, if there is no module.
std::string lab_page_html(const std::vector<Scene>& scenes);

}  // namespace crosscheck
