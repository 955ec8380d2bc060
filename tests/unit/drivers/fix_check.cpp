// SPDX-License-Identifier: Apache-2.0
#include "drivers/hal/fix_check.h"

#include <cmath>
#include <limits>

#include "tests/support/catch.h"

namespace lodesman {
namespace {

using std::chrono::seconds;

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

TEST_CASE("fix check: accuracy is by quality, and never nothing or no number", "[drivers]") {
  CHECK(fix_sigma_m(FixQuality::kSingle, 0.9) == Approx(2.7));
  CHECK(fix_sigma_m(FixQuality::kUnknown, std::nullopt) == Approx(6.0));
  CHECK(fix_sigma_m(FixQuality::kRtkFixed, 0.8) == Approx(0.02));
  for (const FixQuality quality :
       {FixQuality::kUnknown, FixQuality::kSingle, FixQuality::kDifferential, FixQuality::kRtkFloat,
        FixQuality::kRtkFixed}) {
    for (const double hdop : {0.0, -1.0, kNoNumber, 1e-9, 99.9, 1e300}) {
      const double sigma_m = fix_sigma_m(quality, hdop);
      CHECK(std::isfinite(sigma_m));
      CHECK(sigma_m >= 0.02);
      CHECK(sigma_m <= 150.0);
    }
  }
}

TEST_CASE("fix check: a date before this software, or 1024 weeks on, is none", "[drivers]") {
  constexpr std::int64_t kSecond = 1'000'000'000;
  CHECK(is_plausible_utc(1795264500 * kSecond));                      // 2026
  CHECK(!is_plausible_utc((1795264500 - 7168 * 86400LL) * kSecond));  // 2007
  CHECK(!is_plausible_utc(0));
  CHECK(!is_plausible_utc((1795264500 + 7168 * 86400LL) * kSecond));
}

TEST_CASE("fix check: nowhere is both nought, not one of them", "[drivers]") {
  CHECK(is_nowhere(0.0, 0.0));
  CHECK(is_nowhere(-0.0, 1e-7));
  CHECK(!is_nowhere(0.0, 6.5));
  CHECK(!is_nowhere(51.5, 0.0));
}

TEST_CASE("fix check: without a speed a position is frozen where it was lively before",
          "[drivers]") {
  for (const bool lively : {true, false}) {
    FrozenPosition watch;
    PositionFix fix;
    fix.measured = Time{seconds{100}};
    fix.latitude_deg = 35.0;
    bool frozen = false;
    for (int i = 0; i < 40; ++i) {
      fix.measured += seconds{1};
      fix.latitude_deg += i < 20 && (lively || i % 3 == 0) ? 1e-6 : 0.0;
      frozen = watch.frozen(fix);
    }
    CHECK(frozen == lively);
  }
}

}  // namespace
}  // namespace lodesman
