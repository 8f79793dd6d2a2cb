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
#include "report/player/runs.h"

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

/// The runs of one set, as the player has them.
struct PlayableRuns {
  std::string key;    // the set: "SCENE-engines", "SCENE-speed-accuracy", "SCENE-stiffness-map"
  std::string scene;  // the scene of the player's data that they are added to
  std::string stage;  // or JSON of a stage of their own (report/player/stage.h)
  std::vector<RunFile> files;
};

/// A run that the page shows by itself.
struct ShownRun {
  std::string key;  // its method, and its place among the method's runs of the chart; or "own": at the scene's own step
  std::string method, setting;
  std::optional<double> error, cpu;  // m, s
  bool beside = false;               // the others on the first screen
  Run run = {};
  std::string difference = {};  // text: difference from the subject's run, if another engine ran its rule
};

struct ScenePart {
  const Scene* scene;
  const SceneData* facts;
  Findings findings;
  std::string motions;                    // its stage as JSON (report/player/stage.h); empty: pictures alone
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
  /// A guided experiment of the lab: its name (report/page/lab/experiments.ts), and the text of the link to it.
  struct Experiment {
    std::string name, title;
    bool contact = false;  // only where a scene has a ball
  };
  std::string id, title = {}, label = {};  // label: in the line of contents
  std::vector<std::string> joins = {};     // ids that charts name as their chapter
  std::vector<std::string> leads = {};     // figures that open it, "*" for any: the first that there is
  std::vector<std::string> folds = {};     // its other figures in the order of their worth, "*" for any
  std::string formula = {};                // HTML, and Markdown below: templates of their own
  std::string teaching = {};
  std::vector<Experiment> experiments = {};
  std::vector<Group> groups = {};
  std::vector<Entry> entries = {};
};

struct PageContent {
  Findings findings;  // on all scenes together
  std::vector<ScenePart> scenes;
  std::vector<Chapter> chapters;
  Json charts = Json::object();        // by the names of figures: what they draw (report/figures/chart_json.h)
  std::vector<std::string> methods;    // that stand in it
  std::vector<RelationRow> relations;  // that were asked
  std::vector<PlayableRuns> runs;      // that figures play
  Json lab = Json::array();            // its module and its scenes, for the page's end (data.html)
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

/// The whole page; `blocks` receives the bytes of its parts. Throws std::runtime_error if an image or motions cannot be
/// read.
std::string page_html(const PageContent& content, std::vector<std::pair<std::string, size_t>>* blocks = nullptr);

/// The style sheets of a page; its script: "app" or, for a page that holds the lab alone, "lab_page". Throws
/// std::runtime_error if it was not built.
std::string page_styles();
std::string page_script(const std::string& bundle);

/// Text made safe for HTML.
std::string escaped(const std::string& text);
/// Safe HTML for reading: numbers and their units stay on one line.
std::string prose(const std::string& text);
/// prose() with each number and its unit in bold.
std::string prose_with_bold_numbers(const std::string& text);
/// prose() for narrow columns: names of methods may break behind a slash.
std::string narrow_prose(const std::string& text);
/// Paragraphs of Markdown with **bold**, *emphasis* and `code`; HTML in it stays as it is.
std::string markdown_html(const std::string& text);
/// JSON for a <script> element: the one sign that could end it is written otherwise.
std::string json_for_script(const std::string& json);
/// A terminal's text as a page writes it, without hints at command-line options.
std::string readable(std::string text);

/// The chapters of the report, in order, without entries: report/page/texts/ID.md.
std::vector<Chapter> chapters();
/// True if that chapter shows anything; the first one has the certificates.
bool has_contents(const Chapter& chapter);

/// A page of relations that need no reference solution alone, with pictures of what is broken.
std::string relations_page_html(const std::vector<RelationRow>& rows, const std::vector<PageImage>& pictures,
                                const Provenance& lines);

// report.json: what a report says, as data, and what each sentence rests on.

/// The format, findings with formula, rows and fingerprints; scenes; tables with their fingerprints; figures, notes,
/// problems; the index of runs.
std::string report_json(const PageContent& page, const AllFindings& findings, const std::vector<Chart>& charts,
                        const TableSet& result, std::string_view extent, const Json& runs = Json::array());

}  // namespace crosscheck
