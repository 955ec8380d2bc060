// SPDX-License-Identifier: Apache-2.0
// An emulated device that can be given faults of its own, apart from those of its line; and the
// book of what was done to it, so that a test can hold what was noticed against what was injected.
// One thread.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "hal_sim/emulators/emulated_device.h"
#include "hal_sim/scenario/fault.h"

namespace lodesman {

struct Injection {
  std::uint64_t count = 0;  // so far
  Time last{};              // when the last one was; 0: never
};

class InjectionBook {
 public:
  void note(FaultKind kind, Time at) noexcept {
    Injection& injection = injections_[static_cast<std::size_t>(kind)];
    ++injection.count;
    injection.last = at;
  }
  [[nodiscard]] const Injection& of(FaultKind kind) const noexcept {
    return injections_[static_cast<std::size_t>(kind)];
  }

 private:
  std::array<Injection, kFaultKindCount> injections_{};
};

// The way between a device and its host, which can have faults of its own.
class FaultyWay {
 public:
  FaultyWay() = default;
  FaultyWay(const FaultyWay&) = delete;
  FaultyWay& operator=(const FaultyWay&) = delete;
  virtual ~FaultyWay() = default;

  // Whether it can have such a fault.
  [[nodiscard]] virtual bool can_have(FaultKind kind) const noexcept = 0;
  // One that it can have; the rest are passed over.
  virtual void begin_fault(const Fault& fault, Time now) = 0;
  // The one of that kind that begins at that time.
  virtual void end_fault(const Fault& fault) = 0;
};

class FaultyDevice : public EmulatedDevice {
 public:
  // Whether it can have such a fault; the rest are of the line or of another device.
  [[nodiscard]] virtual bool has_fault(FaultKind kind) const noexcept = 0;
  // One that it can have; the rest are passed over. Of each kind there is one at a time: a second
  // takes the place of the first.
  void begin_fault(const Fault& fault, Time now);
  void end_fault(const Fault& fault, Time now);
  // [-] [0, 1] what the thrusters do: some faults grow with it.
  virtual void set_thrust_share(double /*share*/) noexcept {}

  [[nodiscard]] const InjectionBook& injections() const noexcept { return injections_; }

 protected:
  struct Running {
    Fault fault;
    Time since{};
  };
  // The one of that kind, or none.
  [[nodiscard]] const Running* running(FaultKind kind) const noexcept;
  [[nodiscard]] bool is_off() const noexcept { return running(FaultKind::kPower) != nullptr; }
  void note(FaultKind kind, Time at) noexcept { injections_.note(kind, at); }
  // What a device does about it at once.
  virtual void begun(const Fault& /*fault*/, Time /*now*/) {}

 private:
  InjectionBook injections_;
  std::array<std::optional<Running>, kFaultKindCount> running_{};
};

}  // namespace lodesman
