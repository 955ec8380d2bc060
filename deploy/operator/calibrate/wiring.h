// SPDX-License-Identifier: Apache-2.0
// How a boat's two thrusters are connected, told from what it does under the stick: eight ways,
// each with another pair of answers to "ahead" and "to starboard". Pure functions.
#pragma once

#include <optional>
#include <string>

namespace lodesman::cli {

// What a boat does first when it is pushed.
enum class Answer { kAhead, kAstern, kStarboard, kPort };

struct Wiring {
  bool swapped = false;         // the left command reaches the thruster on the right
  bool left_reversed = false;   // the thruster on the left pulls astern when told ahead
  bool right_reversed = false;  // the one on the right

  [[nodiscard]] bool is_right() const noexcept {
    return !swapped && !left_reversed && !right_reversed;
  }
};

// From the answers to ahead alone and to starboard alone; nothing where no wiring has these two.
[[nodiscard]] std::optional<Wiring> wiring_of(Answer to_ahead, Answer to_starboard) noexcept;

struct Stick {
  int surge_ref = 0;
  int head_ref = 0;
};

// What to say so that a boat so wired does what is wished.
[[nodiscard]] Stick through(const Wiring& wiring, Stick wished) noexcept;

// For people, with the options of a thruster box that put it right.
[[nodiscard]] std::string described(const Wiring& wiring);

}  // namespace lodesman::cli
