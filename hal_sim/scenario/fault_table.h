// SPDX-License-Identifier: Apache-2.0
// The table of the faults: which device has which kind, under what name, with what numbers, and
// what a help text says of it. Plain data; any thread.
#pragma once

#include <span>
#include <string_view>

#include "hal_sim/scenario/fault.h"

namespace lodesman {

// A number that belongs to a fault: what it is when it is left out, and from where to where it may
// be. None where both ends are the same.
struct FaultParameter {
  double otherwise = 0.0;
  double least = 0.0;
  double most = 0.0;

  [[nodiscard]] constexpr bool exists() const noexcept { return least < most; }
};

struct FaultRow {
  FaultKind kind;
  std::string_view name;
  unsigned devices;  // a bit each, by FaultDevice
  FaultParameter rate;
  FaultParameter value;
  std::string_view help;

  [[nodiscard]] constexpr bool is_of(FaultDevice device) const noexcept {
    return ((devices >> static_cast<unsigned>(device)) & 1U) != 0;
  }
};

// Every kind but kNone, in the order of FaultKind.
[[nodiscard]] std::span<const FaultRow> fault_rows() noexcept;
// What some kinds are to other devices, with numbers of their own.
[[nodiscard]] std::span<const FaultRow> further_fault_rows() noexcept;

}  // namespace lodesman
