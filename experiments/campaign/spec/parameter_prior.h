// What is known of a campaign's parameters beforehand: of one, or of several together by the
// posterior of an earlier campaign.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/field.h"
#include "base/problems.h"
#include "optimizer/space/prior.h"

namespace talus::campaign {

// Mean and sd, or median and factor, or `from`.
template <base::Dimension kDimension>
struct ParameterPrior {
  std::optional<double> mean{};
  std::optional<double> sd{};                   // > 0
  std::optional<double> median{};               // > 0
  std::optional<double> factor{};               // exp(sd of ln), > 1
  std::optional<std::filesystem::path> from{};  // the folder of a finished campaign
  std::vector<double> draws{};                  // of `from`, SI

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("mean", self.mean, {.dimension = kDimension, .doc = "of a normal prior, with sd"});
    visit("sd", self.sd,
          {.dimension = kDimension,
           .doc = "standard deviation of a normal prior, > 0",
           .unit_of = "mean"});
    visit("median", self.median,
          {.dimension = kDimension, .doc = "of a log-normal prior, with factor, > 0"});
    visit("factor", self.factor,
          {.doc = "of a log-normal prior: two thirds lie between median / factor and median x "
                  "factor; > 1"});
    visit("from", self.from,
          {.doc = "folder of a finished campaign of the same powder: its posterior of this "
                  "parameter"});
    visit("draws", self.draws, {.doc = "filled in by the program, from the campaign in `from`"});
  }

  // The density of the value; nothing where `from` says it.
  std::optional<optimizer::NormalPrior> Normal() const;
  std::string Text() const;
  // What is wrong with it by itself, and with the range [min, max] that it is cut off at.
  void ValidateIn(double min, double max, base::Problems& problems) const;
};

// The posterior of an earlier campaign with its correlations.
struct EarlierPosterior {
  std::filesystem::path from;  // the folder of a finished campaign
  std::vector<std::string> names{};
  std::vector<std::vector<double>> draws{};  // one a row, in the order of `names`, SI

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("from", self.from,
          {.required = true,
           .doc = "folder of a finished campaign of the same powder: its posterior of the "
                  "parameters together"});
    visit("names", self.names, {.doc = "filled in by the program, with draws"});
    visit("draws", self.draws, {.doc = "filled in by the program, from the campaign in `from`"});
  }
};

}  // namespace talus::campaign
