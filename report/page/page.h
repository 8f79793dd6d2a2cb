// The page: one self-contained HTML file that opens with the summary; and report.json, the same as data.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/figures/charts.h"
#include "report/findings/evidence.h"
#include "report/findings/findings.h"
#include "report/findings/recommendation.h"
#include "report/findings/verify.h"
#include "report/page/inline_svg.h"

namespace crosscheck {

/// A picture or a figure already on disk.
struct PageImage {
  std::filesystem::path file;  // .png or .svg
  std::string alt, caption;
  Tooltips tooltips = {};  // of .svg
  std::string runs = {};   // which runs its markers or cells play: the key of PlayableRuns; empty: none
};

/// The runs of a figure, as the player has them: one file of JSON for each method (report/player/run_motions.h).
struct PlayableRuns {
  std::string key;
  std::string scene;  // the scene of the player's data that they are added to
  std::string stage;  // or JSON of a stage of their own (report/player/player_data.h)
  std::vector<std::filesystem::path> methods;
};

struct ScenePart {
  const Scene* scene;
  const SceneData* facts;
  std::vector<Finding> findings;
  std::vector<PageImage> pictures;  // renders
  std::filesystem::path
      motions;  // what plays over the first picture (report/player/player_data.h); empty: it stays a picture
  std::vector<PageImage> figures;  // charts
  std::vector<const Certificate*> certificates;
  const Table* statistics = nullptr;                     // of perturbed runs, where there is contact
  std::vector<RecommendationCell> recommendations = {};  // which method for it
};

/// A part of the report that belongs to no scene of its own.
struct Chapter {
  struct Entry {
    std::string heading, text;
    std::vector<PageImage> images;
    std::vector<PageTable> tables;
  };
  std::string id, title, intro;
  std::vector<Entry> entries;
  std::string label = {};  // in the line of contents; empty: the title
};

struct PageContent {
  std::vector<Finding> findings;  // of the whole report
  std::vector<PageImage> hero;    // next to the summary: a picture, and the figures of the whole report
  std::vector<ScenePart> scenes;
  std::vector<Chapter> chapters;
  std::vector<PlayableRuns> runs;     // that figures play
  std::vector<std::string> notes;     // what was left out, and why
  std::vector<std::string> problems;  // what failed to be made
  std::string against;                // an earlier report, or empty
  std::vector<Change> changes;        // since then
  Provenance provenance;
};

/// Names of the figures that are drawings, in order: each is at #figure-NAME.
std::vector<std::string> figures_of(const PageContent& content);

/// The whole page. Throws std::runtime_error when an image or motions cannot be read.
std::string page_html(const PageContent& content);

/// The beginning of a page up to its body, styles included, and what else belongs into its head; and the table of its
/// provenance.
std::string page_head(const std::string& title, const std::string& more = "");
std::string provenance_html(const Provenance& lines);

/// All bytes of a file. Throws std::runtime_error that names it.
std::string content_of_file(const std::filesystem::path& file);
/// Text made safe for HTML.
std::string escaped(const std::string& text);
/// The same for reading: numbers and their units stay on one line.
std::string prose(const std::string& text);

/// The chapters of the report, in order, without entries. A new one is a row.
std::vector<Chapter> chapters();

/// A long table is folded unless it is to be open.
std::string page_table_html(const PageTable& table, bool open = false);

/// <img> with the image inside the page; and a <figure> of it with its caption.
std::string image_tag(const PageImage& image);
std::string image_html(const PageImage& image, const std::string& css_class);

/// The run table of one scene, and its parity certificates.
std::string run_table_html(const ScenePart& part);
/// Means and spreads over perturbed runs.
std::string statistics_html(const Table& statistics);
std::string certificate_html(const Certificate& certificate);
/// The table on the first screen: one row per scene.
std::string recommendation_table_html(const std::vector<ScenePart>& scenes);

/// The way through the page.
std::string contents_html(const PageContent& content);
/// The words that the page uses; and a link to one of them, by its id. Throws std::logic_error where none has that id.
std::string glossary_html();
/// All methods, a line each.
std::string methods_html();
std::string term_link(const std::string& id);

// report.json: what a report says, as data, and what each sentence rests on.

/// Findings with formula, rows and fingerprints; scenes; tables with their fingerprints; figures, notes, problems.
std::string report_json(const PageContent& page, const AllFindings& findings, const std::vector<Chart>& charts,
                        const Rows& result);

}  // namespace crosscheck
