// Pieces that the page is put together from.
#pragma once

#include <string>
#include <vector>

#include "report/page/page.h"

namespace crosscheck {

/// A figure's frame, which chart.js fills; below it what it says, and the ways to its files.
std::string figure_html(const PageFigure& figure, const PageContent& page);
/// Contents that stand in the page when they are asked for.
std::string fold_html(const std::string& heading, const std::string& kind, const std::string& contents,
                      const std::string& id = "");
std::string findings_html(const std::vector<Finding>& findings);

/// " beside Bullet and mine": the engines that the scenes were run by.
std::string beside_mysim(const PageContent& content);
std::string first_screen_html(const PageContent& content);
/// `number`: its place among the chapters, from 1.
std::string chapter_html(const Chapter& chapter, size_t number, const PageContent& content);
/// Names of the figures of chapters that are seen without a fold being opened.
std::vector<std::string> figures_in_sight(const PageContent& content);

}  // namespace crosscheck
