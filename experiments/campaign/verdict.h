// What kind of answer the measurements give, before any number: a point, a curve, a region or
// several separate sets. One sentence, the same on the terminal, in result.json and in the report.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/field.h"
#include "experiments/campaign/answer/result_posterior.h"
#include "optimizer/space/parameter_space.h"

namespace talus::campaign {

enum class VerdictKind {
  kPoint,    // every 90 % range is narrow
  kCurve,    // two parameters are known together only
  kRegion,   // a range is wide, and no other parameter ties it
  kSeparate  // several unconnected regions
};

struct ResultVerdict {
  VerdictKind kind = VerdictKind::kPoint;
  std::string text{};

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("kind", self.kind);
    visit("text", self.text);
  }
};

// What a verdict is made of. Values in the order of the parameters, SI.
struct VerdictBasis {
  std::vector<optimizer::Parameter> parameters{};  // the searched ones
  std::vector<std::string> names{};                // what the sentence calls them
  std::vector<double> low{};                       // of the 90 % ranges; NaN: not known
  std::vector<double> high{};
  std::vector<std::vector<double>> correlation{};
  std::vector<std::vector<double>> sets{};  // RepresentativeSets
  std::vector<ResultBranch> branches{};     // empty without a posterior
  double region_volume = 1;                 // of the joint 90 % region; without one of tied sets
};

// Nothing where the strategy gives no ranges.
std::optional<ResultVerdict> VerdictOf(const VerdictBasis& basis);

// The two parameters that are correlated most strongly, where by 0.8 or more in size.
std::optional<std::pair<std::size_t, std::size_t>> TiedPair(
    const std::vector<std::vector<double>>& correlation);

// Of points that fit equally (unit cube, one a row): the ends of their longest direction with the
// recommended one between; the recommended one alone where they are close together.
std::vector<Eigen::VectorXd> RepresentativeSets(const Eigen::MatrixXd& points,
                                                const Eigen::VectorXd& recommended);

}  // namespace talus::campaign

template <>
struct talus::base::Names<talus::campaign::VerdictKind> {
  using K = talus::campaign::VerdictKind;
  static constexpr std::array kList{std::pair{"point", K::kPoint}, std::pair{"curve", K::kCurve},
                                    std::pair{"region", K::kRegion},
                                    std::pair{"separate", K::kSeparate}};
};
