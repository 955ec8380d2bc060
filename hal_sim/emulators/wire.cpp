// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/emulators/wire.h"

#include <algorithm>
#include <string>

namespace lodesman {
namespace {

[[nodiscard]] Time up_to_multiple(Time at, Duration of) noexcept {
  if (of <= Duration::zero()) {
    return at;
  }
  const Duration past = at.time_since_epoch() % of;
  return past == Duration::zero() ? at : at + (of - past);
}

[[nodiscard]] bool speeds_differ(int host_baud, int device_baud) noexcept {
  return host_baud != 0 && device_baud != 0 && host_baud != device_baud;
}

}  // namespace

EmulatedWire::EmulatedWire(std::string_view name, std::uint64_t seed, const WireSettings& settings)
    : settings_{settings},
      inward_faults_{std::string{name} + " in", seed},
      outward_faults_{std::string{name} + " out", seed},
      utterance_faults_{std::string{name} + " said", seed},
      outages_{std::string{name} + " line", seed},
      garble_in_{std::string{name} + " in at another speed", seed},
      garble_out_{std::string{name} + " out at another speed", seed} {}

bool EmulatedWire::has_fault(FaultKind kind) noexcept {
  return kind == FaultKind::kBatch || emulated::ByteFaults::has(kind) ||
         emulated::UtteranceFaults::has(kind) || emulated::Outages::has(kind);
}

void EmulatedWire::begin_fault(const Fault& fault, Time now) {
  if (fault.kind == FaultKind::kBatch) {
    batch_fault_ = fault;
    book_.note(fault.kind, now);
  }
  if (emulated::ByteFaults::has(fault.kind)) {
    inward_faults_.begin(fault, now);
    outward_faults_.begin(fault, now);
  }
  if (emulated::UtteranceFaults::has(fault.kind)) {
    utterance_faults_.begin(fault, now);
  }
  if (emulated::Outages::has(fault.kind)) {
    outages_.begin(fault, now);
  }
}

void EmulatedWire::end_fault(const Fault& fault) {
  if (fault.kind == FaultKind::kBatch) {
    batch_fault_.reset();
  }
  inward_faults_.end(fault);
  outward_faults_.end(fault);
  utterance_faults_.end(fault);
  outages_.end(fault);
}

void EmulatedWire::advance(Time now) {
  outages_.advance(now, thrust_share_, book_);
  if (!plugged()) {
    lose_all(now);
  }
}

void EmulatedWire::lose_all(Time now) noexcept {
  pending_.clear();
  batch_.clear();
  outward_.clear();
  inward_free_ = now;
  outward_free_ = now;
  last_arrival_ = std::max(last_arrival_, now);
}

Duration EmulatedWire::byte_time(int baud) const noexcept {
  return settings_.instant || baud == 0 ? Duration::zero()
                                        : Duration{std::chrono::seconds{kBitsAByte}} / baud;
}

std::uint8_t EmulatedWire::as_read(std::uint8_t byte, bool garbled, RandomStream& stream) {
  if (!garbled) {
    return byte;
  }
  ++garbled_;
  return static_cast<std::uint8_t>(emulated::one_of(stream, 256));
}

void EmulatedWire::from_host(std::uint8_t byte, Time written, int host_baud, int device_baud) {
  if (!plugged() || outages_.is_silent()) {
    return;
  }
  outward_free_ = std::max(outward_free_, written);
  const std::uint8_t read = as_read(byte, speeds_differ(host_baud, device_baud), garble_out_);
  passed_.clear();
  outward_faults_.pass(read, written, thrust_share_, passed_, book_);
  outward_free_ += byte_time(device_baud);
  for (const std::uint8_t value : passed_) {
    outward_.push_back({outward_free_, value});
  }
}

std::optional<TimedByte> EmulatedWire::next_to_device(Time until) {
  if (outward_.empty() || outward_.front().at > until) {
    return std::nullopt;
  }
  const TimedByte next = outward_.front();
  outward_.pop_front();
  return next;
}

void EmulatedWire::from_device(Utterance utterance, bool is_answer, int host_baud,
                               int device_baud) {
  if (!plugged() || outages_.is_silent()) {
    return;
  }
  const std::size_t kept = utterance_faults_.pass(utterance, is_answer, book_);
  const auto later = std::find_if(pending_.begin(), pending_.end(), [&](const Pending& pending) {
    return pending.utterance.begins > utterance.begins;
  });
  pending_.insert(later, {std::move(utterance), kept, byte_time(device_baud),
                          speeds_differ(host_baud, device_baud)});
}

// Faults look at what is cut off too, so that a cut moves no other fault's stream.
void EmulatedWire::send(const Pending& pending, std::vector<TimedByte>& bytes) {
  InjectionBook nobody_reads;
  inward_free_ = std::max(inward_free_, pending.utterance.begins);
  for (std::size_t i = 0; i < pending.utterance.bytes.size(); ++i) {
    const bool is_sent = i < pending.kept;
    inward_free_ += is_sent ? pending.byte_time : Duration::zero();
    passed_.clear();
    inward_faults_.pass(as_read(pending.utterance.bytes[i], pending.is_garbled, garble_in_),
                        inward_free_, thrust_share_, passed_, is_sent ? book_ : nobody_reads);
    for (std::size_t k = 0; is_sent && k < passed_.size(); ++k) {
      collect(passed_[k], inward_free_, bytes);
    }
  }
}

void EmulatedWire::to_host(Time now, std::vector<TimedByte>& bytes) {
  auto sent = pending_.begin();
  for (; sent != pending_.end() && sent->utterance.begins <= now; ++sent) {
    send(*sent, bytes);
  }
  pending_.erase(pending_.begin(), sent);
  if (!batch_.empty() && up_to_multiple(batch_.front().at, batch()) <= now) {
    release(up_to_multiple(batch_.front().at, batch()), bytes);
  }
}

Duration EmulatedWire::batch() const noexcept {
  return batch_fault_ ? std::max(settings_.batch, from_seconds(batch_fault_->value))
                      : settings_.batch;
}

void EmulatedWire::collect(std::uint8_t byte, Time at, std::vector<TimedByte>& bytes) {
  if (!batch_.empty() && up_to_multiple(batch_.front().at, batch()) < at) {
    release(up_to_multiple(batch_.front().at, batch()), bytes);
  }
  batch_.push_back({at, byte});
  if (batch() <= Duration::zero() || batch_.size() >= settings_.batch_bytes) {
    release(at, bytes);
  }
}

void EmulatedWire::release(Time at, std::vector<TimedByte>& bytes) {
  const Time arrives = std::max(last_arrival_, up_to_multiple(at, settings_.usb_frame));
  for (const TimedByte& byte : batch_) {
    bytes.push_back({arrives, byte.value});
    last_arrival_ = arrives;
  }
  batch_.clear();
}

}  // namespace lodesman
