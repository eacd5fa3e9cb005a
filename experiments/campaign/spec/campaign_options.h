// How much a campaign may spend, and on what.
#pragma once

#include <optional>

#include "base/field.h"
#include "base/problems.h"

namespace talus::campaign {

struct BudgetOptions {
  static constexpr int kMostSimulations = 1000000;

  int simulations = 60;                // trials of noise and search together, >= 1; 0: any number
  int min_simulations = 0;             // before the strategy may end the search, >= 0
  std::optional<double> core_time{};   // [s], of the trials of noise and search together, > 0
  std::optional<double> wall_clock{};  // [s], all sessions together, > 0
  double sensitivity_share = 0;        // of the search's core time, in [0, 1]; 0: not by itself

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("simulations", self.simulations,
          {.doc = "trials for noise and search; the confirmation comes on top; >= 1, or 0 for any "
                  "number, which is what it is beside core_time"});
    visit("min_simulations", self.min_simulations,
          {.doc = "so many trials before the strategy may end the search early, >= 0"});
    visit("core_time", self.core_time,
          {.dimension = base::Dimension::kTime,
           .doc = "processor time for noise and search; no new trial of the search after it, > 0"});
    visit("wall_clock", self.wall_clock,
          {.dimension = base::Dimension::kTime,
           .doc = "none of the search is proposed after this time of work; those under way still "
                  "run; > 0"});
    visit("sensitivity_share", self.sensitivity_share,
          {.doc = "at the end `talus sensitivity` runs by itself where its first simulations take "
                  "this share of the search's processor time at most, such as 0.05; in [0, 1], 0 "
                  "never"});
  }
  void Validate(base::Problems& problems) const;
};

struct NoiseOptions {
  int replicates = 0;  // at one point with other seeds before the search, 0 or >= 2

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit(
        "replicates", self.replicates,
        {.doc = "trials at one point before the search, to see the run-to-run scatter; 0 or >= 2"});
  }
  void Validate(base::Problems& problems) const;
};

// How the posterior reads the observations, and when it knows enough.
struct PosteriorOptions {
  double model_error = 1;  // sd of what no simulation can match, in run-to-run sds, in [0, 1000]
  bool learn_model_error =
      false;                // from what no set can fit; model_error is its prior's scale then
  double stop_share = 0.1;  // of a range's width that more simulations would take away [-]

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("model_error", self.model_error,
          {.doc = "standard deviation of what no simulation can match, over that of the "
                  "experiment's runs; in [0, 1000]"});
    visit("learn_model_error", self.learn_model_error,
          {.doc = "whether the model error of each experiment is learnt from what no set can fit; "
                  "model_error, > 0, is then the scale of its half-normal prior"});
    visit("stop_share", self.stop_share,
          {.doc = "the search ends when no number of simulations would take this share of its "
                  "width from the range of a parameter that is asked for; >= 0, 0 never"});
  }
  void Validate(base::Problems& problems) const;
};

struct ConfirmOptions {
  int candidates = 2;                    // sets that are simulated again at the end, >= 0
  int replicates = 3;                    // fresh seeds of each, >= 1
  bool ends = true;                      // … and the two ends of a curve or region
  std::optional<double> scale_factor{};  // >= 1; default: that of the search

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("candidates", self.candidates,
          {.doc = "best sets that are simulated again at the end, >= 0"});
    visit("replicates", self.replicates, {.doc = "fresh seeds of each, >= 1"});
    visit("ends", self.ends,
          {.doc = "whether the two ends of a curve or region are simulated again, too: only sets "
                  "that give what was measured are shown as fitting equally"});
    visit("scale_factor", self.scale_factor,
          {.doc = "of the confirmation, to see whether coarse graining matters; >= 1"});
  }
  void Validate(base::Problems& problems) const;

  // Trials of one experiment, at most.
  int MostTrials() const {
    constexpr int kEnds = 2;
    return candidates == 0 ? 0 : (candidates + (ends ? kEnds : 0)) * replicates;
  }
};

// What is looked into once the answer is known.
struct AdviceOptions {
  double share = 0.2;  // core time for it / core time of the campaign [-], in [0, 10]

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("share", self.share,
          {.doc = "where the answer is no point: core time, over that of the campaign, for the few "
                  "simulations that tell what a further test would teach; in [0, 10], 0 none"});
  }
  void Validate(base::Problems& problems) const;
};

}  // namespace talus::campaign
