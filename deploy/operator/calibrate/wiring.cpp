// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/calibrate/wiring.h"

namespace lodesman::cli {
namespace {

// Left and right thruster under a stick, in the stick's own units: eqs 13-14 are linear in thrust.
struct Thrusts {
  int left = 0;
  int right = 0;
};

[[nodiscard]] Thrusts thrusts_of(const Wiring& wiring, Stick stick) noexcept {
  const int first = stick.surge_ref + stick.head_ref;
  const int second = stick.surge_ref - stick.head_ref;
  Thrusts thrusts = wiring.swapped ? Thrusts{second, first} : Thrusts{first, second};
  thrusts.left *= wiring.left_reversed ? -1 : 1;
  thrusts.right *= wiring.right_reversed ? -1 : 1;
  return thrusts;
}

[[nodiscard]] Answer answer_to(const Wiring& wiring, Stick stick) noexcept {
  const Thrusts thrusts = thrusts_of(wiring, stick);
  if (thrusts.left == thrusts.right) {
    return thrusts.left > 0 ? Answer::kAhead : Answer::kAstern;
  }
  return thrusts.left > thrusts.right ? Answer::kStarboard : Answer::kPort;
}

}  // namespace

std::optional<Wiring> wiring_of(Answer to_ahead, Answer to_starboard) noexcept {
  for (int i = 0; i < 8; ++i) {
    const Wiring wiring{(i & 4) != 0, (i & 2) != 0, (i & 1) != 0};
    if (answer_to(wiring, {1, 0}) == to_ahead && answer_to(wiring, {0, 1}) == to_starboard) {
      return wiring;
    }
  }
  return std::nullopt;
}

Stick through(const Wiring& wiring, Stick wished) noexcept {
  // What each thruster is to give, taken back through the wires.
  int left = wished.surge_ref + wished.head_ref;
  int right = wished.surge_ref - wished.head_ref;
  left *= wiring.left_reversed ? -1 : 1;
  right *= wiring.right_reversed ? -1 : 1;
  const int first = wiring.swapped ? right : left;
  const int second = wiring.swapped ? left : right;
  return {(first + second) / 2, (first - second) / 2};
}

std::string described(const Wiring& wiring) {
  if (wiring.is_right()) {
    return "the thrusters are connected as they should be";
  }
  std::string text;
  if (wiring.swapped) {
    text =
        "left and right are exchanged: exchange the cables, or the channels of `maestro:` "
        "(left=1&right=0), or say swap=on to `roboclaw:`";
  }
  if (wiring.left_reversed || wiring.right_reversed) {
    // The box knows its outputs by the names that it has for them: exchanged, they are the other's.
    const bool left = wiring.left_reversed;
    const bool right = wiring.right_reversed;
    const char* which = left && right ? "both" : left ? "left" : "right";
    text += std::string{text.empty() ? "" : "; then "} +
            (left && right ? "both pull astern" : "one pulls astern") +
            " when told ahead: exchange its wires, or say reverse=" + which;
  }
  return text;
}

}  // namespace lodesman::cli
