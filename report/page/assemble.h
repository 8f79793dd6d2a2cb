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

enum class Extent { quick, named, full };
std::string_view name_of(Extent extent);

/// Content of a report: the tables, notes and failures of experiments.
struct ReportData {
  std::vector<Scene> scenes;  // scenes that have a card
  std::vector<Scene> all;     // scenes of all experiments
  TableSet rows;
  Provenance provenance;
  Extent extent = Extent::quick;
  std::vector<std::string> problems;
  Json runs = Json::array();  // index of recorded runs (report/player/runs.h)
  bool received = false;      // true: read from a folder, so that the programs that it names must not be run

  bool each_has_charts() const { return extent != Extent::quick; }
};

/// Reads the data of a finished report. Throws InputError if a file is missing, unreadable, or differs from the report.
ReportData read_report(const std::filesystem::path& folder);

/// Certificates as a table, which `report --from` reads.
Table certificate_table(const std::vector<Certificate>& certificates);

/// Computes points, several in parallel. Returns descriptions of failures.
using Workers = std::function<std::vector<std::string>(const std::vector<Point>&)>;

struct WrittenReport {
  PageContent page;
  std::vector<std::pair<std::string, size_t>> blocks;  // size in bytes
  bool agree;                                          // true if engines with the same rule agree
};
/// Writes report.json, index.html, and the figures' data and scripts; draws the figures that open a chapter, and
/// renders missing pictures. The folder must contain data/. `against` is the folder of an earlier report, or empty.
WrittenReport write_report(ReportData& data, const std::filesystem::path& folder, const std::filesystem::path& against,
                           const Workers& workers);

/// `which` is "-thumbnail" or "-hero".
std::filesystem::path picture_file(const std::filesystem::path& folder, const Scene& scene, const char* which);

void draw_scene(const Scene& scene, const MethodResult& shown, bool full, const std::filesystem::path& folder);

}  // namespace crosscheck
