// The lab's part of the page: the engine's module, the scenes as text, and the scripts that run them (report/lab/).
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "mysim/base/json.h"
#include "mysim/scene/scene.h"

namespace crosscheck {

/// Debian's packages that make the module; they bring the C library along.
inline constexpr std::string_view lab_packages = "clang lld libc++-dev-wasm32 libclang-rt-dev-wasm32 binaryen";

/// Whether the engine was built for the page, and where it lies then.
bool has_lab_module();
std::filesystem::path lab_module_file();

/// The module and the scenes for the end of a page: those given, and those of the guided experiments. Empty where there
/// is no module.
Json lab_data(const std::vector<Scene>& scenes);

/// A page with the lab alone. Throws InputError, with what to install, where there is no module.
std::string lab_page_html(const std::vector<Scene>& scenes);

}  // namespace crosscheck
