// Findings: plain sentences with the numbers and the tier that they rest on.
#pragma once

#include <string>
#include <vector>

#include "report/findings/report_data.h"

namespace crosscheck {

struct Finding {
  std::string scene;         // or empty: of the whole report
  std::string topic;         // agreement, accuracy, failure, cost, contact, order, energy, adequacy
  std::string sentence;      // for a reader who has never seen the code
  std::string tier;          // of the truth that it rests on; "another engine" for differences; "measured" for costs
  std::string rule;          // how it comes from the tables (evidence.h)
  std::string chapter = {};  // of the report, by its id, that shows what it rests on; empty: none
};

/// Findings of one scene.
std::vector<Finding> findings_of(const Scene& scene, const SceneData& facts);
/// Findings of all scenes together, the most important first.
std::vector<Finding> overall_findings(const std::vector<Scene>& scenes, const std::vector<SceneData>& facts,
                                      const Rows& result);
/// The cheapest methods for a given accuracy, and by how much.
std::vector<Finding> speed_findings(const Rows& result);

/// The cost of a step in both engines.
std::vector<Finding> cost_findings(const Rows& result);

/// Of experiment `energy`.
std::vector<Finding> energy_findings(const Rows& result);
/// Of experiment `sphere`.
std::vector<Finding> sphere_findings(const Rows& result);
/// The least models.
std::vector<Finding> adequacy_findings(const Rows& result);

/// The number of known disagreements in this run.
std::vector<Finding> disagreement_findings(const Rows& result);

/// Findings of experiment `stability`.
std::vector<Finding> stability_findings(const Rows& rows);

}  // namespace crosscheck
