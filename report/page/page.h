// The page: one self-contained HTML file. First the answers, next to a moving scene; then one chapter per question;
// then the recommended method for each scene, and the scenes as cards, which open in place.
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
#include "report/player/runs.h"

namespace crosscheck {

/// A picture on disk.
struct PageImage {
  std::filesystem::path file;  // .png or .svg
  std::string alt, caption;
};

/// A chart that the page draws (page/chart/), or gnuplot on paper (files with its name in figures/).
struct PageFigure {
  std::string name, title, caption;
  std::string runs = {};  // key of the PlayableRuns that its markers or cells play; empty: none
};

/// The runs of one set, in the player's format.
struct PlayableRuns {
  std::string key;    // the set: "SCENE-engines", "SCENE-speed-accuracy", "SCENE-stiffness-map"
  std::string scene;  // the scene of the player's data that they are added to
  std::string stage;  // or JSON of a separate stage (report/player/stage.h)
  std::vector<RunFile> files;
};

/// A run that the page shows individually.
struct ShownRun {
  std::string key;  // its method and its index among the method's runs of the chart; or "own": at the scene's own step
  std::string method, setting;
  std::optional<double> error, cpu;  // m, s
  bool beside = false;               // shown with others on the first screen
  Run run = {};
  std::string difference = {};  // text: difference from the subject's run, if another engine ran its rule
};

struct ScenePart {
  const Scene* scene;
  const SceneData* facts;
  Findings findings;
  std::string motions;                    // its stage as JSON (report/player/stage.h); empty: only pictures
  std::filesystem::path thumbnail, hero;  // .png, or empty
  std::vector<PageFigure> figures;
  std::vector<const Certificate*> certificates;
  const Table* statistics = nullptr;   // statistics of perturbed runs, for scenes with contact
  std::optional<RecommendedRun> take;  // recommended run within 1 %
  std::vector<ShownRun> runs = {};     // in the small table of its card
};

/// A chapter of the page: it answers a question.
struct Chapter {
  struct Entry {
    std::string part;  // id of the chart's own chapter, if this chapter joins several
    std::string heading, text;
    std::vector<PageFigure> figures;
    std::vector<PageImage> images;
    std::vector<PageTable> tables;
    bool shown = false;  // not folded
  };
  /// Figures of one kind that share a fold; one at a time is visible.
  struct Group {
    std::string figures;  // pattern; "*" matches anything
    std::string heading;
    bool titled = false;  // chosen by their titles, otherwise by the part that the star matches
  };
  /// A guided experiment of the lab: its name (report/page/lab/experiments.ts), and the text of the link to it.
  struct Experiment {
    std::string name, title;
    bool contact = false;  // only if a scene has a ball
  };
  std::string id, title = {}, label = {};  // label: in the table of contents
  std::vector<std::string> joins = {};     // chapter ids of its charts
  std::vector<std::string> leads = {};     // patterns of figures that open it: the first that exists
  std::vector<std::string> folds = {};     // patterns of its other figures, the most important first
  std::string formula = {};                // HTML; the Markdown below is the teaching text; both are templates
  std::string teaching = {};
  std::vector<Experiment> experiments = {};
  std::vector<Group> groups = {};
  std::vector<Entry> entries = {};
};

struct PageContent {
  Findings findings;  // about all scenes
  std::vector<ScenePart> scenes;
  std::vector<Chapter> chapters;
  Json charts = Json::object();        // by figure name: content of the charts (report/figures/chart_json.h)
  std::vector<std::string> methods;    // all methods shown
  std::vector<RelationRow> relations;  // all relations tested
  std::vector<PlayableRuns> runs;      // runs that figures play
  Json lab = Json::array();            // its module and its scenes, for the page's end (data.html)
  std::string main_scene;              // representative scene; empty: none
  std::filesystem::path figures;       // folder of the figures for paper
  std::vector<std::string> notes;      // omissions, with their reasons
  std::vector<std::string> problems;   // failures
  std::string against;                 // an earlier report, or empty
  std::vector<Change> changes;         // since the earlier report
  Provenance provenance;
};

/// Names of its figures, in order; each figure has the anchor #figure-NAME.
std::vector<std::string> figures_of(const PageContent& content);
/// The scenes that move on the first screen: the main scene, and the last cloth with contact.
std::vector<const ScenePart*> first_scenes(const PageContent& content);
/// True if the figure with this name opens a chapter, so that it is drawn for paper and for readers without scripts.
bool opens_a_chapter(const PageContent& content, const std::string& figure);

/// The whole page; `blocks` receives the size in bytes of its parts. Throws std::runtime_error if an image or motions
/// cannot be read.
std::string page_html(const PageContent& content, std::vector<std::pair<std::string, size_t>>* blocks = nullptr);

/// The style sheets of a page, and its script: "app", or "lab_page" for a page with the lab alone. Throws
/// std::runtime_error if the script was not built.
std::string page_styles();
std::string page_script(const std::string& bundle);

/// Escapes text for HTML.
std::string escaped(const std::string& text);
/// Escapes text for HTML, and keeps numbers and their units on one line.
std::string prose(const std::string& text);
/// prose() with each number and its unit in bold.
std::string prose_with_bold_numbers(const std::string& text);
/// prose() for narrow columns: names of methods may break after a slash.
std::string narrow_prose(const std::string& text);
/// Paragraphs of Markdown with **bold**, *emphasis* and `code`; HTML in it stays as it is.
std::string markdown_html(const std::string& text);
/// JSON for a <script> element: escapes the only character that could end it.
std::string json_for_script(const std::string& json);
/// A message of the program as the page writes it, without references to command-line options.
std::string readable(std::string text);

/// The chapters of the report, in order, without entries: report/page/texts/ID.md.
std::vector<Chapter> chapters();
/// True if the chapter shows anything; the first one has the certificates.
bool has_contents(const Chapter& chapter);

/// A page with only the relations that need no reference solution, and pictures of breaks.
std::string relations_page_html(const std::vector<RelationRow>& rows, const std::vector<PageImage>& pictures,
                                const Provenance& lines);

// report.json: the content of a report as data, with the evidence of each sentence.

/// The format number; findings with formula, rows and fingerprints; scenes; tables with their fingerprints; figures,
/// notes and problems; the index of runs.
std::string report_json(const PageContent& page, const AllFindings& findings, const std::vector<Chart>& charts,
                        const TableSet& result, std::string_view extent, const Json& runs = Json::array());

}  // namespace crosscheck
