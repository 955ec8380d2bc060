// SPDX-License-Identifier: Apache-2.0
// Whether the filter knows its own doubt: over many boats that sail by its own model, with the
// noise that it reckons with, its errors are as large as its covariance says (Bar-Shalom, Li and
// Kirubarajan, Estimation with Applications to Tracking and Navigation, ch. 5.4).
#include <Eigen/Cholesky>
#include <vector>

#include "tests/support/catch.h"
#include "tests/unit/estimate/support.h"

namespace lodesman::testing {
namespace {

constexpr int kRuns = 100;
constexpr int kSteps = 3000;      // a minute
constexpr int kStepsAFix = 10;    // 5 Hz
constexpr int kStepsALook = 500;  // every 10 s

struct Consistency {
  std::vector<double> nees = std::vector<double>(kSteps / kStepsALook);  // mean of the runs
  double nis = 0.0;                                                      // mean of all fixes
  int refused = 0;
  int fixes = 0;
};

void sail(std::uint64_t seed, Consistency& seen) {
  const PoseFilterOptions options = filter_options();
  SailedBoat boat{options, seed, 1.0};
  PoseFilter filter{options};
  for (int i = 0; i < kSteps; ++i) {
    const int surge_ref = i % 1000 < 500 ? 16 : 57;
    const int head_ref = i % 700 < 350 ? 12 : -12;
    boat.step(surge_ref, head_ref);
    filter.advance(boat.now, surge_ref, head_ref, boat.attitude());
    if (i % kStepsAFix == 0) {
      const FixVerdict verdict = filter.fix(boat.fix(1.0), 1.0, boat.now);
      seen.refused += verdict == FixVerdict::kRefused ? 1 : 0;
      if (verdict == FixVerdict::kBelieved) {
        ++seen.fixes;
        seen.nis += filter.normalised_innovation_squared();
      }
    }
    if (i % kStepsALook == kStepsALook - 1) {
      PoseFilter::Vector error = boat.state() - filter.mean();
      error[PoseFilter::kHeading] = wrap_to_pi(error[PoseFilter::kHeading]);
      const double nees = error.dot(filter.covariance().llt().solve(error));
      seen.nees[static_cast<std::size_t>(i / kStepsALook)] += nees / kRuns;
    }
  }
}

}  // namespace

TEST_CASE("pose filter: its errors are as large as it says, over 100 runs",
          "[high_level][estimate]") {
  Consistency seen;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    sail(seed, seen);
  }
  // Chi squared of 800 degrees of freedom over 100, two-sided 99 %: 7.01 to 9.07.
  for (const double nees : seen.nees) {
    CHECK(nees > 7.01);
    CHECK(nees < 9.07);
  }
  // Of 2 x 29,900 degrees of freedom over 29,900: 2 within 3 %.
  CHECK(seen.nis / seen.fixes == Approx(2.0).margin(0.06));
  CHECK(seen.refused <= 10);  // 3 by chance
}

TEST_CASE("pose filter: its covariance stays symmetric and positive", "[high_level][estimate]") {
  PoseFilterOptions options = filter_options();
  options.gate.sigma_least_m = 1e-4;
  SailedBoat boat{options, 1, 0.0};
  PoseFilter filter{options};
  for (int i = 0; i < 20000; ++i) {
    boat.step(31, i % 300 < 150 ? 40 : -40);
    filter.advance(boat.now, 31, 0, boat.attitude());
    (void)filter.fix(boat.fix(1e-4), 1e-4, boat.now);
  }
  const PoseFilter::Matrix& covariance = filter.covariance();
  CHECK((covariance - covariance.transpose()).norm() == Approx(0.0).margin(1e-12));
  CHECK(covariance.llt().info() == Eigen::Success);
}

}  // namespace lodesman::testing
