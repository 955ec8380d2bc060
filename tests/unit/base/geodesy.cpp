// SPDX-License-Identifier: Apache-2.0
#include "mid_level/base/geodesy.h"

#include <cmath>

#include "tests/support/catch.h"

using namespace lodesman;

TEST_CASE("geodesy: a minute of latitude is a nautical mile to the north", "[mid_level][base]") {
  const LocalFrame frame{{35.0, 139.0}};
  const auto north = frame.to_world({35.0 + 1.0 / 60.0, 139.0});
  CHECK(north.xy_m.y() == Approx(1849.0).epsilon(1e-3));
  CHECK(north.xy_m.x() == Approx(0.0).margin(1e-6));
  CHECK(frame.to_world({35.0, 139.001}).xy_m.x() > 0.0);
}

TEST_CASE("geodesy: to_world undoes to_geo over a harbour", "[mid_level][base]") {
  const LocalFrame frame{{35.0, 139.0}};
  for (double x = -500.0; x <= 500.0; x += 125.0) {
    for (double y = -500.0; y <= 500.0; y += 125.0) {
      const auto back = frame.to_world(frame.to_geo({{x, y}}));
      CHECK((back.xy_m - Eigen::Vector2d{x, y}).norm() < 0.02);
    }
  }
}

namespace {

struct Corner {
  const char* name;
  GeoPoint origin;
  double metres_a_degree_east;
};

// A degree of longitude on WGS-84: pi a cos(phi) / (180 sqrt(1 - e2 sin(phi)2)).
constexpr Corner kCorners[] = {
    {"Tokyo", {35.0, 139.0}, 91288.170},
    {"Sydney", {-33.85, 151.2}, 92546.855},
    {"Ushuaia", {-54.8, -68.3}, 64312.051},
    {"Maine", {44.1, -70.1}, 80071.357},
    {"the date line, Fiji", {-17.0, 179.9995}, 106485.831},
    {"the date line from the east", {-17.0, -179.9995}, 106485.831},
    {"Svalbard", {80.0, 16.0}, 19393.486},
    {"the equator and Greenwich", {0.0, 0.0}, 111319.491},
};

}  // namespace

TEST_CASE(
    "geodesy: x is east and y north in every quarter of the earth, on the date line and at 80 "
    "degrees north",
    "[mid_level][base]") {
  for (const Corner& corner : kCorners) {
    INFO(corner.name);
    const LocalFrame frame{corner.origin};
    const double step_deg = 0.001;
    const double east_deg = corner.origin.longitude_deg + step_deg;
    const GeoPoint east{corner.origin.latitude_deg, east_deg > 180.0 ? east_deg - 360.0 : east_deg};
    const auto to_east = frame.to_world(east);
    CHECK(to_east.xy_m.x() == Approx(step_deg * corner.metres_a_degree_east).epsilon(1e-6));
    CHECK(to_east.xy_m.y() == Approx(0.0).margin(0.02));
    const auto to_north =
        frame.to_world({corner.origin.latitude_deg + step_deg, corner.origin.longitude_deg});
    CHECK(to_north.xy_m.x() == Approx(0.0).margin(1e-6));
    CHECK(to_north.xy_m.y() > 110.5);
    CHECK(to_north.xy_m.y() < 111.8);
  }
}

TEST_CASE("geodesy: there and back is the identity there too", "[mid_level][base]") {
  for (const Corner& corner : kCorners) {
    INFO(corner.name);
    const LocalFrame frame{corner.origin};
    for (const double x : {-800.0, 0.0, 350.0}) {
      for (const double y : {-600.0, 0.0, 900.0}) {
        const GeoPoint there = frame.to_geo({{x, y}});
        CHECK(std::abs(there.longitude_deg) <= 180.0);
        const auto back = frame.to_world(there);
        // A plane that touches: at 1 km the ground is 8 cm below it.
        CHECK((back.xy_m - Eigen::Vector2d{x, y}).norm() < 0.001);
      }
    }
  }
}

TEST_CASE("geodesy: a frame that is moved is the one that is made there", "[mid_level][base]") {
  LocalFrame moved;
  CHECK_FALSE(moved.is_fixed());
  moved.move_to({-33.85, 151.2});
  CHECK(moved.is_fixed());
  const LocalFrame made{{-33.85, 151.2}};
  const GeoPoint place{-33.86, 151.21};
  CHECK((moved.to_world(place).xy_m - made.to_world(place).xy_m).norm() < 1e-9);
  CHECK(moved.to_world({-33.85, 151.2}).xy_m.norm() < 1e-9);
}

TEST_CASE("geodesy: the rough distance is the plane's to a hundredth, and goes round the earth",
          "[mid_level][base]") {
  for (const Corner& corner : kCorners) {
    const LocalFrame frame{corner.origin};
    for (const auto& [x_m, y_m] : {std::pair{0.5, 0.0}, {-300.0, 400.0}, {0.0, 20000.0}}) {
      INFO(corner.name << " " << x_m << " " << y_m);
      CHECK(rough_distance_m(corner.origin, frame.to_geo({{x_m, y_m}})) ==
            Approx(std::hypot(x_m, y_m)).epsilon(0.01));
    }
  }
  CHECK(rough_distance_m({0.0, 0.0}, {0.0, 180.0}) == Approx(20015114.0).epsilon(1e-4));
  CHECK(rough_distance_m({10.0, 179.999}, {10.0, -179.999}) == Approx(219.0).epsilon(0.01));
  CHECK(std::isnan(rough_distance_m({std::nan(""), 0.0}, {0.0, 0.0})));
}
