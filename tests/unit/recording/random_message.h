// SPDX-License-Identifier: Apache-2.0
// Sane messages of any type with random fields, over memory that is not clean: padding, and what
// lies behind a count, hold what they held. One thread.
#pragma once

#include <algorithm>
#include <cstring>
#include <memory>
#include <random>
#include <type_traits>

#include "mid_level/blackboard/blackboard.h"
#include "mid_level/messages/layout.h"

namespace lodesman::testing {

class RandomMessages {
 public:
  explicit RandomMessages(std::uint64_t seed) : random_{seed} {}

  // `dirt`: what each byte was before.
  template <class M>
  [[nodiscard]] std::unique_ptr<M> make(unsigned char dirt) {
    auto message = std::make_unique<M>();
    std::memset(reinterpret_cast<std::byte*>(message.get()), dirt, sizeof(M));
    fill(*message, Bounds{});
    return message;
  }

 private:
  template <class T>
  void fill(T& value, const Bounds& bounds) {
    if constexpr (HasFields<T>) {
      T::fields()([&](const auto&... f) { (fill_field(value, f), ...); });
      mend(value);
    } else if constexpr (std::is_same_v<T, Time> || std::is_same_v<T, Duration>) {
      value = T{Duration{static_cast<std::int64_t>(random_() >> 4)}};
    } else if constexpr (std::is_same_v<T, bool>) {
      value = random_() % 2 == 0;
    } else if constexpr (std::is_enum_v<T>) {
      value = static_cast<T>(random_() % enumerators(T{}).size());
    } else if constexpr (std::is_floating_point_v<T>) {
      value = std::uniform_real_distribution<T>{bounds.least, bounds.most}(random_);
    } else if constexpr (std::is_integral_v<T>) {
      value = bounds == Bounds{}
                  ? static_cast<T>(random_())
                  : static_cast<T>(static_cast<std::int64_t>(bounds.least) +
                                   static_cast<std::int64_t>(random_() % span_of(bounds)));
    } else {
      for (auto& element : value) {
        fill(element, bounds);
      }
    }
  }

  [[nodiscard]] static std::uint64_t span_of(const Bounds& bounds) {
    return static_cast<std::uint64_t>(bounds.most - bounds.least) + 1;
  }

  template <class M, class F>
  void fill_field(M& message, const F& f) {
    if constexpr (requires { f.count; }) {
      auto& array = message.*(f.member);
      using Count = std::remove_cvref_t<decltype(message.*(f.count))>;
      const std::size_t count = random_() % (std::min<std::size_t>(array.size(), 40) + 1);
      message.*(f.count) = static_cast<Count>(count);
      for (std::size_t i = 0; i < count; ++i) {
        fill(array[i], Bounds{});
      }
    } else if constexpr (requires { f.bounds; }) {
      fill(message.*(f.member), f.bounds);
    } else {
      fill(message.*(f.member), Bounds{});
    }
  }

  // What belongs together.
  template <class M>
  void mend(M& /*message*/) {}
  void mend(Obstacle& obstacle) {
    obstacle.semi_axis_first_m += 0.1;
    obstacle.semi_axis_second_m += 0.1;
    while (obstacle.vertex_count < 2) {
      fill(obstacle.vertices[obstacle.vertex_count++], Bounds{});
    }
    obstacle.semi_axis_first_m = std::min(obstacle.semi_axis_first_m, 1e6);
    obstacle.semi_axis_second_m = std::min(obstacle.semi_axis_second_m, 1e6);
  }
  void mend(MissionArea& area) {
    while (area.corner_count < 3) {
      fill(area.corners[area.corner_count++], Bounds{});
    }
  }
  void mend(SonarPing& ping) {
    if (random_() % 2 == 0) {
      ping.make_image(1 + static_cast<std::uint32_t>(random_() % 16),
                      1 + static_cast<std::uint32_t>(random_() % 100), 2.0);
      for (std::size_t i = 0; i < ping.echo_count; ++i) {
        fill(ping.echo[i], Bounds{});
      }
      return;
    }
    ping.kind = PingKind::kProfile;
    ping.beams = 1 + static_cast<std::uint32_t>(random_() % 16);
    ping.bins = 0;
    ping.point_count = ping.beams;
    ping.echo_count = 0;
    ping.set_bearings(-1.0, 2.0 / ping.beams);
    for (std::size_t i = 0; i < ping.point_count; ++i) {
      ping.points[i].range_m = static_cast<double>(random_() % 300);
      ping.points[i].intensity = static_cast<std::uint32_t>(random_());
    }
  }

  std::mt19937_64 random_;
};

}  // namespace lodesman::testing
