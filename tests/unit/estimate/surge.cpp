// SPDX-License-Identifier: Apache-2.0
#include "high_level/estimate/surge.h"

#include <cmath>

#include "tests/support/catch.h"
#include "tests/unit/estimate/support.h"

namespace lodesman::testing {
namespace {

using std::chrono::milliseconds;

TEST_CASE("surge: it follows SurgeRef as the vehicle model does, however often it is asked",
          "[high_level][estimate]") {
  const VehicleModel model{paper_hull(), paper_speeds()};
  VehicleMotion sailed;
  for (int i = 0; i < 200; ++i) {
    sailed = model.advanced(sailed, model.forces(57, 0), Eigen::Vector2d::Zero(), 0.01);
  }
  for (const milliseconds tick : {milliseconds{10}, milliseconds{100}, milliseconds{500}}) {
    Surge surge{model};
    double surge_m_s = surge.follow(Time{}, 57);
    CHECK(surge_m_s == Approx(0.0).margin(1e-12));
    for (Duration t = tick; t <= milliseconds{2000}; t += tick) {
      surge_m_s = surge.follow(Time{t}, 57);
    }
    CHECK(surge_m_s == Approx(sailed.velocity[0]).epsilon(0.01));
  }
}

TEST_CASE("surge: after any silence it is what SurgeRef holds", "[high_level][estimate]") {
  Surge surge{VehicleModel{paper_hull(), paper_speeds()}};
  (void)surge.follow(Time{}, 57);
  CHECK(surge.follow(Time{std::chrono::hours{1}}, 57) == Approx(0.735).epsilon(0.02));
  CHECK(surge.follow(Time{std::chrono::hours{2}}, 0) == Approx(0.0).margin(1e-6));
}

}  // namespace
}  // namespace lodesman::testing
