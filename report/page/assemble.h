// A report made from its tables: findings, charts, pictures that are there, the page, report.json.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "experiments/experiment.h"
#include "reference/certificate/certificate.h"
#include "report/findings/evidence.h"
#include "report/page/page.h"

namespace crosscheck {

/// The extent of a report.
enum class Extent { quick, named, full };
std::string_view name_of(Extent extent);

/// Everything that a report says rests on: what experiments wrote into data/, and what was said while they did.
struct ReportData {
  std::vector<Scene> scenes;  // with a part of their own
  std::vector<Scene> all;     // of all experiments
  TableSet rows;
  Provenance provenance;
  Extent extent = Extent::quick;
  std::vector<std::string> problems;  // what failed to be made
  Json runs = Json::array();          // the index of recorded runs (report/player/runs.h)
  bool received = false;              // read from a folder: no program that it names may be run

  /// Whether each scene has charts of its own.
  bool each_has_charts() const { return extent != Extent::quick; }
};

/// The data of a finished report, from its folder. Throws InputError where one of its files is missing or cannot be
/// read, or is not the one that was reported.
ReportData read_report(const std::filesystem::path& folder);

/// The certificates as a table, in which `report --from` finds them again.
Table certificate_table(const std::vector<Certificate>& certificates);

/// Works on a list of points, several at a time, and returns what failed.
using Workers = std::function<std::vector<std::string>(const std::vector<Point>&)>;

/// Writes the figures' data and scripts, draws those that open a chapter, renders the pictures that are not there yet,
/// and writes report.json and index.html into the folder, whose data/ is there. `against`: an earlier report, or empty.
/// Returns what the page says.
struct WrittenReport {
  PageContent page;
  std::vector<std::pair<std::string, size_t>> blocks;  // bytes of the page's parts
  bool agree;                                          // engines with one rule agree where they must
};
WrittenReport write_report(ReportData& data, const std::filesystem::path& folder, const std::filesystem::path& against,
                           const Workers& workers);

/// Where the pictures of a scene stand: "-thumbnail", "-hero".
std::filesystem::path picture_file(const std::filesystem::path& folder, const Scene& scene, const char* which);

/// Draws a scene's thumbnail from a run.
void draw_scene(const Scene& scene, const MethodResult& shown, bool full, const std::filesystem::path& folder);

}  // namespace crosscheck
