// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/emulators/emulated_network.h"

#include <algorithm>
#include <string>

#include "hal_sim/emulators/chance.h"

namespace lodesman {
namespace {

[[nodiscard]] bool is_of_datagrams(FaultKind kind) noexcept {
  return kind == FaultKind::kDrop || kind == FaultKind::kDuplicate || kind == FaultKind::kCut ||
         kind == FaultKind::kReorder;
}

[[nodiscard]] bool is_outage(FaultKind kind) noexcept {
  return kind == FaultKind::kStall || kind == FaultKind::kDisconnect || kind == FaultKind::kHang;
}

}  // namespace

EmulatedNetwork::EmulatedNetwork(std::string_view name, std::uint64_t seed)
    : inward_faults_{std::string{name} + " in", seed},
      outward_faults_{std::string{name} + " out", seed},
      outages_{std::string{name} + " line", seed} {}

bool EmulatedNetwork::can_have(FaultKind kind) const noexcept {
  return is_of_datagrams(kind) || is_outage(kind);
}

void EmulatedNetwork::begin_fault(const Fault& fault, Time now) {
  if (is_of_datagrams(fault.kind)) {
    inward_faults_.begin(fault, now);
    outward_faults_.begin(fault, now);
  }
  if (is_outage(fault.kind)) {
    outages_.begin(fault, now);
  }
}

void EmulatedNetwork::end_fault(const Fault& fault) {
  inward_faults_.end(fault);
  outward_faults_.end(fault);
  outages_.end(fault);
}

void EmulatedNetwork::advance(Time now) { outages_.advance(now, 0.0, book_); }

// As many draws for each datagram, whatever becomes of it.
EmulatedNetwork::DatagramFaults::Fate EmulatedNetwork::DatagramFaults::of(std::size_t size, Time at,
                                                                          InjectionBook& book) {
  Fate fate;
  for (emulated::RunningFault& running : running_) {
    const bool hits = emulated::happens(running.stream, running.fault.rate);
    const std::uint32_t kept = emulated::one_of(
        running.stream, static_cast<std::uint32_t>(std::max<std::size_t>(size, 1)));
    if (!hits) {
      continue;
    }
    book.note(running.fault.kind, at);
    switch (running.fault.kind) {
      case FaultKind::kDrop: fate.times = 0; break;
      case FaultKind::kDuplicate: fate.times *= 2; break;
      case FaultKind::kCut: fate.kept = kept; break;
      default: fate.is_overtaken = true; break;
    }
  }
  return fate;
}

std::size_t EmulatedNetwork::from_host(Time now) {
  if (!plugged() || outages_.is_silent()) {
    return 0;
  }
  return outward_faults_.of(1, now, book_).times;
}

void EmulatedNetwork::from_device(Utterance datagram) {
  const auto later = std::find_if(
      waiting_.begin(), waiting_.end(),
      [&datagram](const Utterance& waiting) { return waiting.begins > datagram.begins; });
  waiting_.insert(later, std::move(datagram));
}

void EmulatedNetwork::send(Utterance datagram, std::vector<Utterance>& datagrams) {
  const DatagramFaults::Fate fate =
      inward_faults_.of(datagram.bytes.size(), datagram.begins, book_);
  if (fate.kept) {
    datagram.bytes.resize(std::min(*fate.kept, datagram.bytes.size()));
  }
  std::vector<Utterance>& into = fate.is_overtaken ? overtaken_ : datagrams;
  into.insert(into.end(), fate.times, datagram);
  if (!fate.is_overtaken && fate.times > 0) {
    for (Utterance& late : overtaken_) {
      late.begins = datagram.begins;
      datagrams.push_back(std::move(late));
    }
    overtaken_.clear();
  }
}

void EmulatedNetwork::to_host(Time now, std::vector<Utterance>& datagrams) {
  auto left = waiting_.begin();
  for (; left != waiting_.end() && left->begins <= now; ++left) {
    if (plugged() && !outages_.is_silent()) {
      send(std::move(*left), datagrams);
    }
  }
  waiting_.erase(waiting_.begin(), left);
}

}  // namespace lodesman
