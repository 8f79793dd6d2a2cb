// The page: one self-contained HTML file. First the answers, beside something that moves; then a chapter for each
// question; then which method to take for which scene, and the scenes as cards, each of which opens in its place.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/tables/check.h"
#include "mysim/base/json.h"
#include "report/figures/charts.h"
#include "report/findings/answers.h"
#include "report/findings/evidence.h"
#include "report/findings/findings.h"
#include "report/findings/recommendation.h"
#include "report/findings/verify.h"

namespace crosscheck {

/// A picture already on disk.
struct PageImage {
  std::filesystem::path file;  // .png or .svg
  std::string alt, caption;
};

/// A chart that the page draws (chart.js), or on paper gnuplot (the files of its name in figures/).
struct PageFigure {
  std::string name, title, caption;
  std::string runs = {};  // which runs its markers or cells play: the key of PlayableRuns; empty: none
};

/// The runs of a figure, as the player has them: one file of JSON for each method (report/player/motions.h).
struct PlayableRuns {
  std::string key;
  std::string scene;  // the scene of the player's data that they are added to
  std::string stage;  // or JSON of a stage of their own (report/player/motions.h)
  std::vector<std::filesystem::path> methods;
  std::vector<std::string> names = {};  // of them
};

/// A run that the page shows by itself.
struct ShownRun {
  std::string key;  // its method, and its place among the method's runs of the chart; or "own": at the scene's own step
  std::string method, setting;
  std::optional<double> error, cpu;  // m, s
  bool beside = false;               // the others on the first screen
  Run run = {};
};

struct ScenePart {
  const Scene* scene;
  const SceneData* facts;
  std::vector<Finding> findings;
  std::filesystem::path motions;          // what the player shows (report/player/motions.h); empty: pictures alone
  std::filesystem::path thumbnail, hero;  // .png, or empty
  std::vector<PageFigure> figures;
  std::vector<const Certificate*> certificates;
  const Table* statistics = nullptr;   // of perturbed runs, where there is contact
  std::optional<RecommendedRun> take;  // within 1 %
  std::vector<ShownRun> runs = {};     // in the small table of its card
};

/// A chapter of the page: it answers a question.
struct Chapter {
  struct Entry {
    std::string part;  // the id of the chart's own chapter, of those that this one joins
    std::string heading, text;
    std::vector<PageFigure> figures;
    std::vector<PageImage> images;
    std::vector<PageTable> tables;
    bool shown = false;  // not folded away
  };
  /// Figures of one kind that share a fold, one at a time in sight.
  struct Group {
    std::string figures;  // "*" for any
    std::string heading;
    bool titled = false;  // chosen by their titles, else by what stands for the star
  };
  std::string id, title, label;    // label: in the line of contents
  std::vector<std::string> joins;  // ids that charts name as their chapter
  std::vector<std::string> leads;  // figures that open it, "*" for any: the first that there is
  std::string formula, teaching;   // HTML; what a reader learns from it; "{critical}": the main scene's numbers
  // guided experiments of the lab: their names (report/lab/experiments.js), and what a reader is shown
  std::vector<std::pair<std::string, std::string>> experiments = {};
  std::string contact_formula = {}, contact_teaching = {};  // besides, where a scene has a ball
  std::vector<Group> groups = {};
  std::vector<Entry> entries = {};
};

struct PageContent {
  std::vector<Finding> findings;  // of the whole report
  std::vector<ScenePart> scenes;
  std::vector<Chapter> chapters;
  Json charts = Json::object();        // by the names of figures: what they draw (report/figures/chart_json.h)
  std::vector<std::string> methods;    // that stand in it
  std::vector<RelationRow> relations;  // that were asked
  std::vector<PlayableRuns> runs;      // that figures play
  std::string lab;                     // its module and its scenes, for the page's end
  std::string main_scene;              // stands for the others; empty: none
  std::filesystem::path figures;       // the folder of the figures for paper
  std::vector<std::string> notes;      // what was left out, and why
  std::vector<std::string> problems;   // what failed to be made
  std::string against;                 // an earlier report, or empty
  std::vector<Change> changes;         // since then
  Provenance provenance;
};

/// Names of its figures, in order: each is at #figure-NAME.
std::vector<std::string> figures_of(const PageContent& content);
/// The scenes that move on the first screen: the main one, and the last cloth with contact.
std::vector<const ScenePart*> first_scenes(const PageContent& content);
/// Whether the figure of that name opens a chapter, so that it is drawn for paper and for readers without scripts.
bool opens_a_chapter(const PageContent& content, const std::string& figure);

/// The whole page. Throws std::runtime_error when an image or motions cannot be read.
std::string page_html(const PageContent& content);

/// The beginning of a page up to its body, styles included, and what else belongs into its head; and the table of its
/// provenance.
std::string page_head(const std::string& title, const std::string& more = "");
std::string provenance_html(const Provenance& lines);

/// Text made safe for HTML.
std::string escaped(const std::string& text);
/// The same for reading: numbers and their units stay on one line.
std::string prose(const std::string& text);
/// The same with each number and its unit in bold.
std::string prose_with_bold_numbers(const std::string& text);

/// The chapters of the report, in order, without entries. A new one is a row.
std::vector<Chapter> chapters();

/// A long table is folded unless it is to be open.
std::string page_table_html(const PageTable& table);

/// A terminal's text as a page writes it, without hints at command-line options.
std::string readable(std::string text);

/// <img> with the image inside the page; and a <figure> of it with its caption.
std::string image_tag(const PageImage& image);
std::string image_html(const PageImage& image, const std::string& css_class);

/// The run table of one scene, and its parity certificates.
std::string run_table_html(const ScenePart& part);
/// Means and spreads over perturbed runs.
std::string statistics_html(const Table& statistics);
std::string certificate_html(const Certificate& certificate);
/// All certificates in one picture: a dot for each quantity of each scene, in a column for each method.
std::string parity_html(const std::vector<ScenePart>& scenes);
/// Relations that need no truth: a row of marks for each engine, and the breaks with their causes; empty without rows.
std::string relations_html(const std::vector<RelationRow>& rows);
/// A page of that alone, with pictures of what is broken.
std::string relations_page_html(const std::vector<RelationRow>& rows, const std::vector<PageImage>& pictures,
                                const Provenance& lines);
/// One recommendation a scene: the method to take for 1 % of the motion, with step, error, cost and what binds the
/// step.
std::string recommendation_table_html(const std::vector<ScenePart>& scenes);

/// The way through the page.
std::string contents_html(const PageContent& content);
/// The words that the page uses.
std::string glossary_html();
/// Built-in methods of these names, a line each.
std::string methods_html(const std::vector<std::string>& shown);

// report.json: what a report says, as data, and what each sentence rests on.

/// Findings with formula, rows and fingerprints; scenes; tables with their fingerprints; figures, notes, problems.
std::string report_json(const PageContent& page, const AllFindings& findings, const std::vector<Chart>& charts,
                        const TableSet& result, std::string_view extent);

}  // namespace crosscheck
