// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/emulators/wire_faults.h"

#include <algorithm>
#include <array>

#include "mid_level/base/short_number.h"

namespace lodesman::emulated {
namespace {

using std::chrono::milliseconds;

// Spells of a bad line, on the average.
constexpr double kGoodSpell_s = 10.0;
constexpr double kBadSpell_s = 0.020;

// Bytes that mean something to somebody, or that a line's software takes for itself.
constexpr std::array<std::uint8_t, 5> kTellingBytes{0x55, 0x11, 0x13, 0xFF, 0x00};

// Flips with the thrusters at rest.
constexpr double kFlipsAtRest = 1e-6;
constexpr double kUnplugsAtFullThrust_per_minute = 0.01;
constexpr Duration kUnpluggedByInterference = milliseconds{100};

constexpr Duration kHangLeast = milliseconds{50};
constexpr Duration kHangMost = std::chrono::seconds{30};
constexpr Duration kUnpluggedLeast = milliseconds{100};
constexpr Duration kUnpluggedMost = std::chrono::seconds{5};
constexpr double kUnplugsAgain = 0.1;
constexpr Duration kUnplugsAgainAfter = milliseconds{200};
constexpr double kOtherName = 0.5;
constexpr double kMinute_s = 60.0;

[[nodiscard]] std::uint8_t other_bits(RandomStream& stream) noexcept {
  return static_cast<std::uint8_t>(1 + one_of(stream, 255));
}

[[nodiscard]] std::uint8_t stray_byte(RandomStream& stream) noexcept {
  const bool telling = happens(stream, 0.5);
  return telling ? kTellingBytes[one_of(stream, kTellingBytes.size())]
                 : static_cast<std::uint8_t>(one_of(stream, 256));
}

// Brings the spells of a bursting line up to a time; whether it is bad then.
[[nodiscard]] bool is_bad(RunningFault& running, Time at) noexcept {
  if (running.until == Time{}) {
    running.until = running.since + from_seconds(kGoodSpell_s * exponential(running.stream));
  }
  while (at >= running.until) {
    running.bad = !running.bad;
    const double mean_s = running.bad ? kBadSpell_s : kGoodSpell_s;
    running.until += from_seconds(mean_s * exponential(running.stream));
  }
  return running.bad;
}

// Whether a byte is hit.
[[nodiscard]] bool hits(RunningFault& running, Time at, double thrust_share) noexcept {
  switch (running.fault.kind) {
    case FaultKind::kBurst:
      return is_bad(running, at) && happens(running.stream, running.fault.rate);
    case FaultKind::kInterference:
      return happens(running.stream,
                     kFlipsAtRest + running.fault.rate * thrust_share * thrust_share);
    default: return happens(running.stream, running.fault.rate);
  }
}

}  // namespace

void FaultSet::begin(const Fault& fault, Time now) {
  const std::string stream =
      name_ + " " + std::string{name_of(fault.kind)} + " at " + short_number(fault.at_s);
  running_.push_back({fault, RandomStream{stream, seed_}, now, false, {}, false, {}});
}

void FaultSet::end(const Fault& fault) {
  const auto ended =
      std::find_if(running_.begin(), running_.end(), [&fault](const RunningFault& running) {
        return running.fault.kind == fault.kind && running.fault.at_s >= fault.at_s &&
               running.fault.at_s <= fault.at_s;
      });
  if (ended != running_.end()) {
    running_.erase(ended);
  }
}

bool ByteFaults::has(FaultKind kind) noexcept {
  switch (kind) {
    case FaultKind::kFlip:
    case FaultKind::kBurst:
    case FaultKind::kDrop:
    case FaultKind::kDuplicate:
    case FaultKind::kInsert:
    case FaultKind::kInterference: return true;
    default: return false;
  }
}

void ByteFaults::pass(std::uint8_t byte, Time at, double thrust_share,
                      std::vector<std::uint8_t>& out, InjectionBook& book) {
  std::uint8_t becomes = byte;
  std::size_t times = 1;
  bool is_lost = false;
  for (RunningFault& running : running_) {
    if (!hits(running, at, thrust_share)) {
      continue;
    }
    book.note(running.fault.kind, at);
    switch (running.fault.kind) {
      case FaultKind::kDrop: is_lost = true; break;
      case FaultKind::kDuplicate: ++times; break;
      case FaultKind::kInsert: out.push_back(stray_byte(running.stream)); break;
      default: becomes = static_cast<std::uint8_t>(becomes ^ other_bits(running.stream)); break;
    }
  }
  if (!is_lost) {
    out.insert(out.end(), times, becomes);
  }
}

bool UtteranceFaults::has(FaultKind kind) noexcept {
  return kind == FaultKind::kCorrupt || kind == FaultKind::kCut || kind == FaultKind::kLate;
}

std::size_t UtteranceFaults::pass(Utterance& utterance, bool is_answer, InjectionBook& book) {
  const auto length = static_cast<std::uint32_t>(utterance.bytes.size());
  std::size_t kept = length;
  for (RunningFault& running : running_) {
    RandomStream& stream = running.stream;
    const bool is_late = running.fault.kind == FaultKind::kLate;
    if (length == 0 || (is_late && !is_answer) ||
        (running.fault.kind != FaultKind::kCorrupt && !happens(stream, running.fault.rate))) {
      continue;
    }
    if (is_late) {
      utterance.begins += from_seconds(running.fault.value * (1.0 + 2.0 * stream.uniform()));
    } else if (running.fault.kind == FaultKind::kCut) {
      kept = std::min<std::size_t>(kept, one_of(stream, length));
    } else {
      std::uint8_t& byte = utterance.bytes[one_of(stream, length)];
      byte = static_cast<std::uint8_t>(byte ^ other_bits(stream));
    }
    book.note(running.fault.kind, utterance.begins);
  }
  return kept;
}

bool Outages::has(FaultKind kind) noexcept {
  switch (kind) {
    case FaultKind::kStall:
    case FaultKind::kDisconnect:
    case FaultKind::kHang:
    case FaultKind::kReplug:
    case FaultKind::kInterference: return true;
    default: return false;
  }
}

// Whether a thing that recurs begins now; it does not while it lasts.
bool Outages::recurs(RunningFault& running, double rate_per_s, Time now, Duration passed,
                     InjectionBook& book) {
  running.bad = now < running.until;
  if (running.bad || !running.recurrence.due(running.stream, rate_per_s, passed)) {
    return false;
  }
  running.bad = true;
  book.note(running.fault.kind, now);
  return true;
}

void Outages::advance_replug(RunningFault& running, Time now, Duration passed,
                             InjectionBook& book) {
  const bool goes_again = running.again && now >= running.until + kUnplugsAgainAfter;
  if (goes_again) {
    running.bad = true;
    running.again = false;
    book.note(running.fault.kind, now);
  } else if (running.again || !recurs(running, running.fault.rate / kMinute_s, now, passed, book)) {
    running.bad = now < running.until;
    return;
  }
  RandomStream& stream = running.stream;
  running.until = now + log_uniform(stream, kUnpluggedLeast, kUnpluggedMost);
  renames_ += happens(stream, kOtherName) ? 1U : 0U;
  running.again = !goes_again && happens(stream, kUnplugsAgain);
}

void Outages::advance_one(RunningFault& running, Time now, Duration passed, double thrust_share,
                          InjectionBook& book) {
  const double rate_per_s = running.fault.rate / kMinute_s;
  const double interference_per_s =
      kUnplugsAtFullThrust_per_minute / kMinute_s * thrust_share * thrust_share;
  switch (running.fault.kind) {
    case FaultKind::kHang:
      if (recurs(running, rate_per_s, now, passed, book)) {
        running.until = now + log_uniform(running.stream, kHangLeast, kHangMost);
      }
      break;
    case FaultKind::kReplug: advance_replug(running, now, passed, book); break;
    case FaultKind::kInterference:
      if (recurs(running, interference_per_s, now, passed, book)) {
        running.until = now + kUnpluggedByInterference;
      }
      break;
    default:  // a stall or a disconnection lasts as long as it runs
      if (!running.bad) {
        running.bad = true;
        book.note(running.fault.kind, now);
      }
      break;
  }
}

void Outages::advance(Time now, double thrust_share, InjectionBook& book) {
  const Duration passed = has_advanced_ ? now - advanced_ : Duration::zero();
  advanced_ = now;
  has_advanced_ = true;
  is_silent_ = false;
  is_unplugged_ = false;
  for (RunningFault& running : running_) {
    advance_one(running, now, passed, thrust_share, book);
    const bool silences =
        running.fault.kind == FaultKind::kStall || running.fault.kind == FaultKind::kHang;
    (silences ? is_silent_ : is_unplugged_) |= running.bad;
  }
}

}  // namespace lodesman::emulated
