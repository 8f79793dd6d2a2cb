// The page as data for the templates in report/page/templates/.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "report/page/page.h"
#include "report/page/template.h"

namespace crosscheck {

/// Contents of folds and cards. The page keeps them packed until the reader opens one (page.ts); readers without
/// scripts do not see them.
class Folds {
 public:
  /// Fills a template with folded content; returns the number under which the page finds it.
  size_t hold(const std::string& template_name, const Json& data);
  /// Data of fold.html.
  Json fold(const std::string& heading, const std::string& kind, const std::string& template_name, const Json& data,
            const std::string& id = "");
  const Json& held() const { return held_; }

 private:
  Json held_ = Json::array();
};

/// Data of image.html and picture.html: the image embedded in the page. Throws std::runtime_error if it cannot be read.
Json image_data(const PageImage& image);
/// Data of figure.html.
Json figure_data(const PageFigure& figure, const PageContent& page);
/// Data of table.html: a small table, without its empty columns.
Json table_data(const PageTable& table);
Json findings_data(const Findings& findings);
/// Data of provenance.html.
Json provenance_data(const Provenance& lines);

/// Data for scripts: an element of the list in data.html. `block`: the name under which its bytes are counted.
Json data_element(const std::string& block, const std::string& id, const std::string& text,
                  const char* type = "application/json");

/// "mysim leapfrog": the name of the engine, then the method's name for readers, unique among these methods.
std::string engine_and_reader_name(const std::string& method, const std::vector<std::string>& among);

/// Data of first-screen.html.
Json first_screen_data(const PageContent& content);
/// " next to Bullet and mine": the engines that ran the scenes.
std::string beside_mysim(const PageContent& content);

/// Chapters with something to show, as data of chapter.html.
Json chapters_data(const PageContent& content, Folds& folds);
/// Names of the figures of chapters that are visible without opening a fold.
std::vector<std::string> figures_in_sight(const PageContent& content);

/// All runs of one scene; means and spreads over perturbed runs; one recommendation per scene: data of table.html.
Json run_table_data(const ScenePart& part);
Json statistics_data(const Table& statistics);
Json recommendations_data(const std::vector<ScenePart>& scenes);
/// The built-in methods with these names, one row each.
Json methods_data(const std::vector<std::string>& shown);
/// The parity certificate of one method: data of certificate.html.
Json certificate_data(const Certificate& certificate);
/// All certificates in one picture, with a dot per quantity of each scene: data of parity.html. Null without one.
Json parity_data(const std::vector<ScenePart>& scenes);
/// Relations that need no reference solution: data of relations.html. Null without rows.
Json relations_data(const std::vector<RelationRow>& rows);

/// The glossary: data of glossary.html.
Json glossary_data();
/// A chapter from its text: a head of "- key: value" lines, then Markdown. Throws std::runtime_error ("ID.md: …").
Chapter chapter_of_text(const std::string& id, const std::string& text);

}  // namespace crosscheck
