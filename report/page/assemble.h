// Makes a report from its tables: findings, charts, existing pictures, the page, report.json.
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

/// The basis of a report: the tables that experiments wrote into data/, and their notes and failures.
struct ReportData {
  std::vector<Scene> scenes;  // scenes with a card
  std::vector<Scene> all;     // scenes of all experiments
  TableSet rows;
  Provenance provenance;
  Extent extent = Extent::quick;
  std::vector<std::string> problems;  // failures
  Json runs = Json::array();          // the index of recorded runs (report/player/runs.h)
  bool received = false;              // read from a folder: programs that it names must not be run

  /// True if each scene has charts of its own.
  bool each_has_charts() const { return extent != Extent::quick; }
};

/// Reads the data of a finished report from its folder. Throws InputError if a file is missing, cannot be read, or
/// differs from the reported one.
ReportData read_report(const std::filesystem::path& folder);

/// The certificates as a table, from which `report --from` reads them.
Table certificate_table(const std::vector<Certificate>& certificates);

/// Computes a list of points, several in parallel, and returns the failures.
using Workers = std::function<std::vector<std::string>(const std::vector<Point>&)>;

/// Writes the figures' data and scripts, draws those that open a chapter, renders missing pictures, and writes
/// report.json and index.html into the folder, which must contain data/. `against`: an earlier report, or empty.
/// Returns the content of the page.
struct WrittenReport {
  PageContent page;
  std::vector<std::pair<std::string, size_t>> blocks;  // size in bytes of the page's parts
  bool agree;                                          // engines with the same rule agree wherever they must
};
WrittenReport write_report(ReportData& data, const std::filesystem::path& folder, const std::filesystem::path& against,
                           const Workers& workers);

/// File of a scene's picture: `which` is "-thumbnail" or "-hero".
std::filesystem::path picture_file(const std::filesystem::path& folder, const Scene& scene, const char* which);

/// Draws a scene's thumbnail from a run.
void draw_scene(const Scene& scene, const MethodResult& shown, bool full, const std::filesystem::path& folder);

}  // namespace crosscheck
