// The page: one self-contained HTML file with the answers next to a moving scene, a chapter per question, the
// recommended methods, and the scenes as cards.
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

struct PageImage {
  std::filesystem::path file;  // .png or .svg
  std::string alt, caption;
};

/// A chart that is drawn in the page by page/chart/, and on paper by gnuplot (files with its name in figures/).
struct PageFigure {
  std::string name, title, caption;
  std::string runs = {};  // key of the PlayableRuns that its markers or cells play; empty: they play nothing
};

/// A set of runs in the player's format.
struct PlayableRuns {
  std::string key;    // "SCENE-engines", "SCENE-speed-accuracy", "SCENE-stiffness-map"
  std::string scene;  // scene of the player's data to which the runs belong; if empty, `stage` is used
  std::string stage;  // JSON of a separate stage (report/player/stage.h)
  std::vector<RunFile> files;
};

struct ShownRun {
  std::string key;  // method and index among the method's runs in the chart, or "own" for a run at the scene's step
  std::string method, setting;
  std::optional<double> error, cpu;  // m, s
  bool beside = false;               // true: on the first screen, next to other runs
  Run run = {};
  std::string difference = {};  // text on the difference from the subject's run, if another engine ran the same rule
};

struct ScenePart {
  const Scene* scene;
  const SceneData* facts;
  Findings findings;
  std::string motions;                    // stage as JSON (report/player/stage.h); empty: there are only pictures
  std::filesystem::path thumbnail, hero;  // .png, or empty
  std::vector<PageFigure> figures;
  std::vector<const Certificate*> certificates;
  const Table* statistics = nullptr;   // statistics of perturbed runs, for scenes with contact
  std::optional<RecommendedRun> take;  // recommended run with an error of at most 1 %
  std::vector<ShownRun> runs = {};     // runs in the small table of the scene's card
};

struct Chapter {
  struct Entry {
    std::string part;  // id of the chapter to which the chart belongs, if this chapter joins several
    std::string heading, text;
    std::vector<PageFigure> figures;
    std::vector<PageImage> images;
    std::vector<PageTable> tables;
    bool shown = false;  // not folded
  };
  /// Figures of one kind in a common fold, of which one is visible at a time.
  struct Group {
    std::string figures;  // pattern; "*" matches anything
    std::string heading;
    bool titled = false;  // true: buttons show the figures' titles; false: they show the star's match
  };
  /// A guided experiment (report/page/lab/experiments.ts) and the text of its link.
  struct Experiment {
    std::string name, title;
    bool contact = false;  // requires a scene with a ball
  };
  std::string id, title = {}, label = {};  // label: title in the table of contents
  std::vector<std::string> joins = {};     // ids of other chapters whose charts this one shows
  std::vector<std::string> leads = {};     // patterns of opening figures; the first pattern with a match counts
  std::vector<std::string> folds = {};     // patterns of other figures, the most important first
  std::string formula = {};                // HTML template, unlike `teaching`, which is a template in Markdown
  std::string teaching = {};
  std::vector<Experiment> experiments = {};
  std::vector<Group> groups = {};
  std::vector<Entry> entries = {};
};

struct PageContent {
  Findings findings;  // across scenes
  std::vector<ScenePart> scenes;
  std::vector<Chapter> chapters;
  Json charts = Json::object();  // contents of the charts by figure name (report/figures/chart_json.h)
  std::vector<std::string> methods;
  std::vector<RelationRow> relations;
  std::vector<PlayableRuns> runs;
  Json lab = Json::array();  // the module and its scenes, for the end of the page (data.html)
  std::string main_scene;
  std::filesystem::path figures;      // folder of the figures for paper
  std::vector<std::string> notes;     // omissions, with reasons
  std::vector<std::string> problems;  // failures
  std::string against;
  std::vector<Change> changes;  // since the report `against`
  Provenance provenance;
};

/// Names of all figures in order; each has the anchor #figure-NAME.
std::vector<std::string> figures_of(const PageContent& content);
/// Scenes with moving pictures on the first screen: the main scene, and the last cloth with contact.
std::vector<const ScenePart*> first_scenes(const PageContent& content);
/// True if a figure opens a chapter; such figures are also drawn for paper and for readers without scripts.
bool opens_a_chapter(const PageContent& content, const std::string& figure);

/// `blocks` receives the sizes of the page's blocks in bytes. Throws std::runtime_error if an image or motion is
/// unreadable.
std::string page_html(const PageContent& content, std::vector<std::pair<std::string, size_t>>* blocks = nullptr);

/// Style sheet and script of the page. `bundle` is "app", or "lab_page" for a page with only the lab. Throws
/// std::runtime_error if the script was not built.
std::string page_styles();
std::string page_script(const std::string& bundle);

std::string escaped(const std::string& text);
/// Escapes text for HTML, and keeps each number and its unit on one line.
std::string prose(const std::string& text);
std::string prose_with_bold_numbers(const std::string& text);
/// prose() for narrow columns, where names of methods may break after a slash.
std::string narrow_prose(const std::string& text);
/// Converts paragraphs of Markdown with **bold**, *emphasis* and `code` to HTML; keeps HTML.
std::string markdown_html(const std::string& text);
/// Escapes JSON for a <script> element.
std::string json_for_script(const std::string& json);
/// Removes references to command-line options from a message.
std::string readable(std::string text);

/// All chapters in order, without entries (report/page/texts/ID.md).
std::vector<Chapter> chapters();
/// True if the chapter is not empty. The first chapter has the certificates.
bool has_contents(const Chapter& chapter);

/// A page that contains only relations, with pictures of violations.
std::string relations_page_html(const std::vector<RelationRow>& rows, const std::vector<PageImage>& pictures,
                                const Provenance& lines);

/// Contents of report.json (report/CONTRACT.md).
std::string report_json(const PageContent& page, const AllFindings& findings, const std::vector<Chart>& charts,
                        const TableSet& result, std::string_view extent, const Json& runs = Json::array());

}  // namespace crosscheck
