// A number of a test and the closed form that it is held against. scripts/verify prints what is
// recorded.
#pragma once

#include <gtest/gtest.h>

#include <sstream>
#include <string>

namespace talus::engine::testing {

struct Claim {
  std::string what;      // one of a test's
  double ours = 0;       // in the unit that is said in `what`, or SI
  double reference = 0;  // what the formula gives, not zero
  double tolerance = 0;  // of ours over the reference, less 1
};

// The formula of all claims of a test, as a table shows it.
inline void Formula(const std::string& text) { ::testing::Test::RecordProperty("formula", text); }

inline void Verify(const Claim& claim) {
  const double off = claim.ours / claim.reference - 1;
  std::ostringstream numbers;
  numbers << claim.reference << ' ' << claim.ours << ' ' << off << ' ' << claim.tolerance;
  ::testing::Test::RecordProperty("claim " + claim.what, numbers.str());
  EXPECT_NEAR(off, 0, claim.tolerance) << claim.what;
}

}  // namespace talus::engine::testing
