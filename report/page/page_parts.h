// Data for the templates in report/page/templates/. For most functions NAME_data(), the template is NAME.html.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "report/page/page.h"
#include "report/page/template.h"

namespace crosscheck {

/// Contents of folds and cards, packed until the reader opens one (page.ts). Readers without scripts do not see them.
class Folds {
 public:
  /// Fills a template for a fold and stores the result. Returns the index by which the page finds it.
  size_t hold(const std::string& template_name, const Json& data);
  /// Data of fold.html.
  Json fold(const std::string& heading, const std::string& kind, const std::string& template_name, const Json& data,
            const std::string& id = "");
  const Json& held() const { return held_; }

 private:
  Json held_ = Json::array();
};

/// Data of image.html and picture.html, with the embedded image. Throws std::runtime_error if the image cannot be read.
Json image_data(const PageImage& image);
Json figure_data(const PageFigure& figure, const PageContent& page);
/// Omits empty columns.
Json table_data(const PageTable& table);
Json findings_data(const Findings& findings);
Json provenance_data(const Provenance& lines);

/// Data for scripts, as an element in data.html. Its bytes count towards the size of `block`.
Json data_element(const std::string& block, const std::string& id, const std::string& text,
                  const char* type = "application/json");

/// "mysim leapfrog": the engine's name and the method's name for readers, unique among the methods `among`.
std::string engine_and_reader_name(const std::string& method, const std::vector<std::string>& among);

Json first_screen_data(const PageContent& content);
/// Lists the engines that ran the scenes: " next to Bullet and my-engine".
std::string beside_mysim(const PageContent& content);

/// Data of chapter.html for each chapter with contents.
Json chapters_data(const PageContent& content, Folds& folds);
/// Figures that are visible without opening a fold.
std::vector<std::string> figures_in_sight(const PageContent& content);

/// Tables (table.html): all runs of a scene, means and deviations over perturbed runs, recommendations by scene.
Json run_table_data(const ScenePart& part);
Json statistics_data(const Table& statistics);
Json recommendations_data(const std::vector<ScenePart>& scenes);
/// Data of table.html: one row per built-in method.
Json methods_data(const std::vector<std::string>& shown);
Json certificate_data(const Certificate& certificate);
/// All certificates, with a dot per quantity and scene. Null if there are none.
Json parity_data(const std::vector<ScenePart>& scenes);
/// Null if there are no rows.
Json relations_data(const std::vector<RelationRow>& rows);

Json glossary_data();
/// Reads a text that begins with lines "- key: value", followed by Markdown. Throws std::runtime_error ("ID.md: …").
Chapter chapter_of_text(const std::string& id, const std::string& text);

}  // namespace crosscheck
