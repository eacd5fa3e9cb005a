// What is changed of a campaign that goes on: its spec's file, its budget, its parameters.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/journal/journal.h"
#include "experiments/journal/objective.h"

namespace talus::campaign {

struct ResumeOptions {
  std::filesystem::path spec{};                   // a changed spec; empty: the one it began with
  int add_simulations = 0;                        // >= 0
  std::optional<journal::Objective> objective{};  // searched on with, instead of the spec's
  // Parameters to be searched from now on, "restitution=0.3..0.95" each: add_parameter.h.
  std::vector<std::string> search{};
};

// A change of the campaign, to be written when nothing is left that could refuse it.
struct SpecChange {
  CampaignSpec spec;
  std::string path{};  // of a file that was named, absolute; empty: the one it began with
  std::string text;    // as the user wrote it
  std::string event;   // its kind; empty when nothing changes
  std::string words;
  std::string note{};          // where another spec is read than the usual one
  bool asks_more = false;      // a search that has ended goes on
  bool engine_is_new = false;  // a mended one, with which no trial has been run
};

// Whether the search has ended for good. One that gave up, as nothing worked, has not: it goes on
// once that is mended.
bool SearchHasEnded(const journal::ProgressRecord& progress, const BudgetOptions& budget);

// Throws ConfigError that names what has changed in the spec where that is not allowed. Nothing is
// written.
SpecChange ChangeOf(journal::Journal& journal, const std::filesystem::path& root,
                    const ResumeOptions& options);

}  // namespace talus::campaign
