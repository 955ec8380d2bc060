// SPDX-License-Identifier: Apache-2.0
#include "mid_level/messages/layout.h"

#include <algorithm>
#include <string>
#include <vector>

#include "mid_level/messages/tracks.h"
#include "tests/support/catch.h"

using namespace lodesman;

namespace {

struct Described {
  std::vector<std::string> words;
  void operator()(const char* text) { words.emplace_back(text); }
  void operator()(std::uint64_t number) { words.push_back(std::to_string(number)); }
};

template <class M>
std::vector<std::string> layout_of() {
  Described described;
  visit_layout<M>(described);
  return described.words;
}

struct Point {
  double x_m = 0.0;
  double y_m = 0.0;
  static constexpr auto fields() noexcept {
    return field_list(field("x_m", &Point::x_m), field("y_m", &Point::y_m));
  }
};

// The same names in the same order and the same size, but x and y have changed places.
struct SwappedPoint {
  double y_m = 0.0;
  double x_m = 0.0;
  static constexpr auto fields() noexcept {
    return field_list(field("x_m", &SwappedPoint::x_m), field("y_m", &SwappedPoint::y_m));
  }
};

// A type in each message below stands behind a count, which is 0 in a message just made.
template <class Element, std::size_t kSize = 4>
struct Counted {
  std::uint32_t count = 0;
  std::array<Element, kSize> elements{};
  static constexpr auto fields() noexcept {
    using C = Counted;
    return field_list(field("count", &C::count), field("elements", &C::elements, &C::count));
  }
};

template <class T>
struct Single {
  T value{};
  static constexpr auto fields() noexcept { return field_list(field("value", &Single::value)); }
};

struct SingleInRange {
  std::int32_t value = 0;
  static constexpr auto fields() noexcept {
    return field_list(field("value", &SingleInRange::value).within(-100, 100));
  }
};

enum class Colour : std::uint8_t { kRed, kGreen };
constexpr auto enumerators(Colour) noexcept {
  return enumerators_to<Colour::kGreen>("red", "green");
}
enum class Light : std::uint8_t { kRed, kGreen };
constexpr auto enumerators(Light) noexcept { return enumerators_to<Light::kGreen>("green", "red"); }

}  // namespace

TEST_CASE("layout: fields that change places are another layout, behind a count too",
          "[mid_level][messages]") {
  CHECK(layout_of<Point>() == layout_of<Point>());
  CHECK(layout_of<Point>() != layout_of<SwappedPoint>());
  CHECK(layout_of<Counted<Point>>() != layout_of<Counted<SwappedPoint>>());
}

TEST_CASE("layout: another type of the same size, another length or bound is another layout",
          "[mid_level][messages]") {
  CHECK(layout_of<Single<std::int64_t>>() != layout_of<Single<std::uint64_t>>());
  CHECK(layout_of<Single<double>>() != layout_of<Single<std::uint64_t>>());
  CHECK(layout_of<Single<Time>>() != layout_of<Single<Duration>>());
  CHECK(layout_of<Single<bool>>() != layout_of<Single<std::uint8_t>>());
  CHECK(layout_of<Counted<Point, 4>>() != layout_of<Counted<Point, 5>>());
  CHECK(layout_of<Single<std::int32_t>>() != layout_of<SingleInRange>());
}

TEST_CASE("layout: enumerators that change places are another layout", "[mid_level][messages]") {
  CHECK(layout_of<Single<Colour>>() != layout_of<Single<Light>>());
}

TEST_CASE("layout: every field of a message inside an array is part of it",
          "[mid_level][messages]") {
  const auto words = layout_of<Tracks>();
  for (const char* name : {"velocity_yy_m2_s2", "centre_x_m", "vertices", "polyline"}) {
    CAPTURE(name);
    CHECK(std::find(words.begin(), words.end(), name) != words.end());
  }
}
