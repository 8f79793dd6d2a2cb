// What makes the page smaller without a change of what it shows.
#pragma once

#include <string>
#include <string_view>

namespace crosscheck {

/// The page with what its outermost templates hold in one packed list at its end, which page.ts puts back: without
/// scripts nobody sees it either way.
std::string with_folds_packed(const std::string& page);

/// An SVG file as an element of the page: its <svg> alone, in one line, no coordinate with zeros at its end.
std::string svg_element(std::string_view file, const std::string& label);

}  // namespace crosscheck
