// The sets that are simulated again at the end of a campaign: the recommended one, the other
// branches of its posterior, and the two ends of what fits equally.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/field.h"
#include "experiments/campaign/spec/campaign_options.h"
#include "optimizer/answer.h"

namespace talus::campaign {

// Share of a searched range above which a 90 % range is no point.
inline constexpr double kWideRange = 0.25;

enum class CandidateRole { kRecommended, kBranch, kEnd };
constexpr CandidateRole LastOf(CandidateRole) { return CandidateRole::kEnd; }

struct Candidate {
  Eigen::VectorXd point;  // unit cube
  CandidateRole role = CandidateRole::kRecommended;
};

// Representatives of points that fit equally (unit cube, one a row): the ends of their longest
// direction in the coordinates asked for, with the recommended one between; the recommended one
// alone where they are close together.
std::vector<Eigen::VectorXd> RepresentativeSets(const Eigen::MatrixXd& points,
                                                const Eigen::VectorXd& recommended,
                                                const std::vector<Eigen::Index>& asked);

// What fits equally.
struct EqualSets {
  Eigen::MatrixXd region{};  // the draws inside the joint 90 % region, unit cube, one a row
  std::vector<Eigen::Index> asked{};  // its coordinates that are no nuisances
};

// The recommended set first, then the branches, up to `options.candidates`; then the ends of what
// fits equally. None is near another.
std::vector<Candidate> CandidatesOf(const optimizer::Answer& answer, const EqualSets& equal,
                                    const ConfirmOptions& options);

// Whether two sets are one for people.
bool AreNear(const Eigen::VectorXd& a, const Eigen::VectorXd& b);

}  // namespace talus::campaign
