// SPDX-License-Identifier: Apache-2.0
// The way of datagrams between an emulated device and its host: each arrives whole or not at all,
// as its sum has it, but some are lost, come twice, end early or overtake others. It has no clock
// and no socket of its own. One thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "hal_sim/emulators/faulty_device.h"
#include "hal_sim/emulators/wire_faults.h"

namespace lodesman {

class EmulatedNetwork final : public FaultyWay {
 public:
  // name, seed: of the streams of its faults.
  EmulatedNetwork(std::string_view name, std::uint64_t seed);

  [[nodiscard]] bool can_have(FaultKind kind) const noexcept override;
  void begin_fault(const Fault& fault, Time now) override;
  void end_fault(const Fault& fault) override;

  // Outages begin and end. Called before the datagrams of each step; time never falls.
  void advance(Time now);
  [[nodiscard]] bool plugged() const noexcept { return !outages_.is_unplugged(); }

  // How often a datagram that the host sends comes to the device: 0, 1 or more.
  [[nodiscard]] std::size_t from_host(Time now);
  // What the device said, whenever it leaves.
  void from_device(Utterance datagram);
  // Appends what has left by `now` and arrives, in the order of arrival.
  void to_host(Time now, std::vector<Utterance>& datagrams);

  [[nodiscard]] const InjectionBook& injections() const noexcept { return book_; }

 private:
  class DatagramFaults : public emulated::FaultSet {
   public:
    using FaultSet::FaultSet;
    // How often it arrives, and how much of it.
    struct Fate {
      std::size_t times = 1;
      std::optional<std::size_t> kept;
      bool is_overtaken = false;
    };
    [[nodiscard]] Fate of(std::size_t size, Time at, InjectionBook& book);
  };

  void send(Utterance datagram, std::vector<Utterance>& datagrams);

  DatagramFaults inward_faults_;  // to the host
  DatagramFaults outward_faults_;
  emulated::Outages outages_;
  InjectionBook book_;
  std::vector<Utterance> waiting_;    // said, and not left yet; by when they do
  std::vector<Utterance> overtaken_;  // until the next one has come
};

}  // namespace lodesman
