// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/emulators/line_feed.h"

#include <array>

namespace lodesman {
namespace {

void hand_over(std::vector<Utterance>& said, bool is_answer, EmulatedWire& wire, int host_baud,
               int device_baud) {
  for (Utterance& utterance : said) {
    wire.from_device(std::move(utterance), is_answer, host_baud, device_baud);
  }
  said.clear();
}

}  // namespace

void exchange(FaultyDevice& device, EmulatedWire& wire, int host_baud, Time now,
              std::vector<TimedByte>& to_host) {
  std::vector<Utterance> said;
  while (const auto byte = wire.next_to_device(now)) {
    device.step(byte->at, said);
    hand_over(said, false, wire, host_baud, device.baud());
    device.receive(std::span{&byte->value, 1}, byte->at, said);
    hand_over(said, true, wire, host_baud, device.baud());
  }
  device.step(now, said);
  hand_over(said, false, wire, host_baud, device.baud());
  wire.to_host(now, to_host);
}

void LineFeed::pump(Time now) {
  wire_.advance(now);
  if (wire_.plugged()) {
    line_.plug();
  } else {
    line_.unplug();
  }
  std::array<std::uint8_t, 1> byte{};
  for (;;) {
    const Received received = line_.receive(byte, now);
    if (received.count == 0) {
      break;
    }
    wire_.from_host(byte[0], received.at, line_.baud(), device_.baud());
  }
  to_host_.clear();
  exchange(device_, wire_, line_.baud(), now, to_host_);
  for (const TimedByte& sent : to_host_) {
    line_.send(sent.value, sent.at);
  }
}

FaultTimetable::FaultTimetable(const std::vector<Fault>& faults, FaultDevice device)
    : device_{device} {
  for (const Fault& fault : faults) {
    if (fault.device == device) {
      entries_.push_back({fault, State::kToCome});
    }
  }
}

bool FaultTimetable::add(const Fault& fault, const FaultyDevice& device, const FaultyWay& way) {
  // Of those that a scenario may name for a thruster box, no box has every one.
  if (fault.device != device_ || !(device.has_fault(fault.kind) || way.can_have(fault.kind))) {
    return false;
  }
  entries_.push_back({fault, State::kToCome});
  return true;
}

void FaultTimetable::clear() noexcept {
  for (Entry& entry : entries_) {
    entry.fault.duration_s = 0.0;
    entry.state = entry.state == State::kRunning ? State::kRunning : State::kOver;
  }
}

void FaultTimetable::advance(double scenario_time_s, Time now, FaultyDevice& device,
                             FaultyWay& way) {
  for (Entry& entry : entries_) {
    const Fault& fault = entry.fault;
    const bool has_begun = scenario_time_s >= fault.at_s;
    const bool has_ended = scenario_time_s >= fault.at_s + fault.duration_s;
    if (entry.state == State::kRunning && has_ended) {
      device.end_fault(fault, now);
      way.end_fault(fault);
      entry.state = State::kOver;
    }
    // However short it is, it runs at least from one step to the next.
    if (entry.state == State::kToCome && has_begun) {
      device.begin_fault(fault, now);
      way.begin_fault(fault, now);
      entry.state = State::kRunning;
    }
  }
}

}  // namespace lodesman
