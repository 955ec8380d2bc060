// SPDX-License-Identifier: Apache-2.0
// What goes wrong on a line: with single bytes, with what is said in one go, and with the line as a
// whole. Each fault has a stream of its own and looks at everything that was sent, so that none
// changes what another does. One thread.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hal_sim/emulators/chance.h"
#include "hal_sim/emulators/faulty_device.h"

namespace lodesman::emulated {

// A fault that runs, with its stream.
struct RunningFault {
  Fault fault;
  RandomStream stream;
  Time since{};
  // kBurst: whether this is a bad spell. kHang, kReplug, kInterference: whether it is away.
  bool bad = false;
  Time until{};           // of that
  bool again = false;     // kReplug: it goes once more after `until`
  Recurrence recurrence;  // kHang, kReplug, kInterference
};

// The faults of one kind of thing that run, and the names of their streams.
class FaultSet {
 public:
  FaultSet(std::string name, std::uint64_t seed) : name_{std::move(name)}, seed_{seed} {}
  void begin(const Fault& fault, Time now);
  void end(const Fault& fault);

 protected:
  std::vector<RunningFault> running_;

 private:
  std::string name_;
  std::uint64_t seed_;
};

// Of single bytes, one way.
class ByteFaults : public FaultSet {
 public:
  using FaultSet::FaultSet;
  [[nodiscard]] static bool has(FaultKind kind) noexcept;
  // Appends what comes of a byte: nothing, itself or another, or more.
  void pass(std::uint8_t byte, Time at, double thrust_share, std::vector<std::uint8_t>& out,
            InjectionBook& book);
};

// Of what a device says in one go.
class UtteranceFaults : public FaultSet {
 public:
  using FaultSet::FaultSet;
  [[nodiscard]] static bool has(FaultKind kind) noexcept;
  // Gives how many of its bytes are sent.
  [[nodiscard]] std::size_t pass(Utterance& utterance, bool is_answer, InjectionBook& book);
};

// Of the line as a whole.
class Outages : public FaultSet {
 public:
  using FaultSet::FaultSet;
  [[nodiscard]] static bool has(FaultKind kind) noexcept;
  void advance(Time now, double thrust_share, InjectionBook& book);
  [[nodiscard]] bool is_silent() const noexcept { return is_silent_; }
  [[nodiscard]] bool is_unplugged() const noexcept { return is_unplugged_; }
  // How often it was plugged in under another name than before.
  [[nodiscard]] std::uint64_t renames() const noexcept { return renames_; }

 private:
  [[nodiscard]] static bool recurs(RunningFault& running, double rate_per_s, Time now,
                                   Duration passed, InjectionBook& book);
  void advance_one(RunningFault& running, Time now, Duration passed, double thrust_share,
                   InjectionBook& book);
  void advance_replug(RunningFault& running, Time now, Duration passed, InjectionBook& book);

  bool is_silent_ = false;
  bool is_unplugged_ = false;
  std::uint64_t renames_ = 0;
  Time advanced_{};
  bool has_advanced_ = false;
};

}  // namespace lodesman::emulated
