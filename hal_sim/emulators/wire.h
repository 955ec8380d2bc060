// SPDX-License-Identifier: Apache-2.0
// The line between an emulated device and its host: bytes take their time, adapters collect them,
// and faults have their way with them. It has no clock and no line of its own, but is handed bytes
// and gives them back with the time at which they arrive. One thread.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string_view>
#include <vector>

#include "hal_sim/emulators/faulty_device.h"
#include "hal_sim/emulators/wire_faults.h"

namespace lodesman {

struct TimedByte {
  Time at{};  // when it arrives
  std::uint8_t value = 0;
};

struct WireSettings {
  bool instant = false;          // bytes take no time, whatever the device's speed
  Duration batch{};              // an adapter hands on at multiples of it; 0: at once
  std::size_t batch_bytes = 62;  // ... or when it has so many
  Duration usb_frame{};          // what is handed on arrives at multiples of it; 0: at once
};

class EmulatedWire final : public FaultyWay {
 public:
  // name, seed: of the streams of its faults.
  EmulatedWire(std::string_view name, std::uint64_t seed, const WireSettings& settings = {});

  [[nodiscard]] static bool has_fault(FaultKind kind) noexcept;
  [[nodiscard]] bool can_have(FaultKind kind) const noexcept override { return has_fault(kind); }
  void begin_fault(const Fault& fault, Time now) override;
  void end_fault(const Fault& fault) override;
  // [-] [0, 1] what the thrusters do.
  void set_thrust_share(double share) noexcept { thrust_share_ = share; }

  // Outages begin and end. Called before the bytes of each step; time never falls.
  void advance(Time now);
  [[nodiscard]] bool plugged() const noexcept { return !outages_.is_unplugged(); }
  // How often it was plugged in under another name than before.
  [[nodiscard]] std::uint64_t renames() const noexcept { return outages_.renames(); }

  // A byte that the host wrote, at its speed (0: it has none). Bytes at another speed than the
  // device's arrive as anything.
  void from_host(std::uint8_t byte, Time written, int host_baud, int device_baud);
  // The next byte that is whole at the device by `until`.
  [[nodiscard]] std::optional<TimedByte> next_to_device(Time until);

  // What the device said, at its speed. An answer may be late.
  void from_device(Utterance utterance, bool is_answer, int host_baud, int device_baud);
  // Appends what has been said by `now` and is known to arrive, which may be later; in order.
  void to_host(Time now, std::vector<TimedByte>& bytes);

  [[nodiscard]] const InjectionBook& injections() const noexcept { return book_; }
  // How many bytes were spoilt because the speeds differed.
  [[nodiscard]] std::uint64_t garbled() const noexcept { return garbled_; }

 private:
  struct Pending {
    Utterance utterance;
    std::size_t kept = 0;  // of its bytes; the rest are not sent
    Duration byte_time{};
    bool is_garbled = false;
  };

  [[nodiscard]] Duration byte_time(int baud) const noexcept;
  [[nodiscard]] std::uint8_t as_read(std::uint8_t byte, bool garbled, RandomStream& stream);
  [[nodiscard]] Duration batch() const noexcept;
  void send(const Pending& pending, std::vector<TimedByte>& bytes);
  void collect(std::uint8_t byte, Time at, std::vector<TimedByte>& bytes);
  void release(Time at, std::vector<TimedByte>& bytes);
  void lose_all(Time now) noexcept;

  WireSettings settings_;
  emulated::ByteFaults inward_faults_;  // to the host
  emulated::ByteFaults outward_faults_;
  emulated::UtteranceFaults utterance_faults_;
  emulated::Outages outages_;
  RandomStream garble_in_;
  RandomStream garble_out_;
  std::optional<Fault> batch_fault_;
  InjectionBook book_;
  double thrust_share_ = 0.0;
  std::uint64_t garbled_ = 0;

  std::vector<Pending> pending_;  // said and not yet sent, by when it begins
  Time inward_free_{};            // when the line to the host is
  Time outward_free_{};
  Time last_arrival_{};
  std::vector<TimedByte> batch_;  // held by the adapter
  std::deque<TimedByte> outward_;
  std::vector<std::uint8_t> passed_;
};

}  // namespace lodesman
