// SPDX-License-Identifier: Apache-2.0
// Random numbers by name: each consumer has a stream of its own, made from its name and the
// scenario's seed, so that what one draws moves no other. A stream belongs to one thread.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string_view>

namespace lodesman {

class RandomStream {
 public:
  RandomStream(std::string_view name, std::uint64_t scenario_seed) noexcept
      : engine_{seed_of(name, scenario_seed)} {}

  // In (0, 1): the engine's upper 52 bits and a half. The standard's distributions are not the
  // same everywhere, its engine is.
  [[nodiscard]] double uniform() noexcept {
    return (static_cast<double>(engine_() >> 12U) + 0.5) * 0x1p-52;
  }

  // Mean 0, standard deviation 1. Two draws a number; nothing is kept for the next call.
  [[nodiscard]] double gaussian() noexcept {
    const double radius = std::sqrt(-2.0 * std::log(uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

 private:
  // FNV-1a over the bytes of the name and of the seed.
  [[nodiscard]] static std::uint64_t seed_of(std::string_view name, std::uint64_t seed) noexcept {
    std::uint64_t hash = 0xcbf29ce484222325U;
    const auto mix = [&hash](std::uint64_t byte) noexcept {
      hash = (hash ^ byte) * 0x100000001b3U;
    };
    for (const char c : name) {
      mix(static_cast<unsigned char>(c));
    }
    for (unsigned shift = 0; shift < 64; shift += 8) {
      mix((seed >> shift) & 0xffU);
    }
    return hash;
  }

  std::mt19937_64 engine_;
};

}  // namespace lodesman
