// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/nav440/scripted_unit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "mid_level/base/heading.h"
#include "tests/support/catch.h"

namespace lodesman::testing {
namespace {

using std::chrono::milliseconds;

constexpr std::array<int, 4> kSpeeds{9600, 19200, 38400, 57600};

void put(ByteList& to, std::int64_t value, int bytes) {
  while (bytes-- > 0) {
    to.push_back(static_cast<std::uint8_t>((value >> (8 * bytes)) & 0xFF));
  }
}

[[nodiscard]] std::int64_t counts(double value, double span) {
  return std::lround(value / span * 65536.0);
}

[[nodiscard]] unsigned word_at(const ByteList& bytes, std::size_t at) {
  return static_cast<unsigned>((bytes[at] << 8U) | bytes[at + 1]);
}

}  // namespace

void ScriptedUnit::power_cycle() {
  baud_ = stored_baud;
  divider_ = stored_divider;
  type_ = stored_type;
  time_off_ms = -tick_ms_;
  framing_.restart();
}

void ScriptedUnit::go_on_to(Time now) {
  for (; now_ <= now; now_ += milliseconds{1}) {
    listen();
    if (!is_dead) {
      stream();
    }
    ++tick_ms_;
  }
}

void ScriptedUnit::listen() {
  std::array<std::uint8_t, 64> bytes{};
  for (;;) {
    const Received received = line_.receive(bytes, now_);
    if (received.count == 0) {
      return;
    }
    if (is_dead || (has_speed && line_.baud() != baud_)) {
      continue;
    }
    for (const Kept& request : fed(framing_, std::span{bytes}.first(received.count), 64)) {
      obey(request);
    }
  }
}

void ScriptedUnit::obey(const Kept& request) {
  const std::string type{static_cast<char>(request.type >> 8U),
                         static_cast<char>(request.type & 0xFFU)};
  if (is_foreign) {
    reply(frame_of(std::string_view{"\0\0", 2},
                   {static_cast<std::uint8_t>(type[0]), static_cast<std::uint8_t>(type[1])}));
    return;
  }
  if (type == "PK") {
    ++pings;
    reply(frame_of("PK", {}));
  } else if (type == "GP") {
    const unsigned wanted = word_at(request.payload, 0);
    if (wanted == 0x4944 && has_identity) {
      ByteList identity{0x1A, 0x3B, 0xC0, 0x40};
      for (const char c : std::string_view{"NAV440 2.0.1 8350-2000"}) {
        identity.push_back(static_cast<std::uint8_t>(c));
      }
      identity.push_back(0);
      reply(frame_of("ID", identity));
    } else if (wanted == 0x5652 && has_version) {
      reply(frame_of("VR", {20, 2, 1, 0, 10}));
    } else {
      reply(frame_of("\x15\x15", {'G', 'P'}));
    }
  } else if (type == "SF") {
    set(request);
  } else if (type == "GF") {
    get(request);
  } else if (type == "WF") {
    ++writes;
  }
}

bool ScriptedUnit::accepts(unsigned id, unsigned value) const {
  return id != 3 || refuses_type.empty() ||
         value != word_at(ByteList{static_cast<std::uint8_t>(refuses_type[0]),
                                   static_cast<std::uint8_t>(refuses_type[1])},
                          0);
}

void ScriptedUnit::set(const Kept& request) {
  ++sets;
  const std::size_t asked = request.payload[0];
  ByteList taken{0};
  for (std::size_t i = 0; i < asked; ++i) {
    const unsigned id = word_at(request.payload, 1 + 4 * i);
    const unsigned value = word_at(request.payload, 3 + 4 * i);
    if (accepts(id, value)) {
      apply(id, value);
      put(taken, id, 2);
      ++taken[0];
    }
  }
  if (taken[0] > 0) {
    reply(frame_of("SF", taken));
  }
  if (taken[0] < asked) {
    reply(frame_of("\x15\x15", {'S', 'F'}));
  }
}

void ScriptedUnit::get(const Kept& request) {
  ByteList values{request.payload[0]};
  for (std::size_t i = 0; i < request.payload[0]; ++i) {
    const unsigned id = word_at(request.payload, 1 + 2 * i);
    put(values, id, 2);
    put(values, field(id), 2);
  }
  reply(frame_of("GF", values));
}

void ScriptedUnit::apply(unsigned id, unsigned value) {
  if (id == 1) {
    divider_ = static_cast<int>(value);
  } else if (id == 2 && !ignores_speed) {
    baud_ = kSpeeds.at(value);
  } else if (id == 3) {
    type_ = {static_cast<char>(value >> 8U), static_cast<char>(value & 0xFFU)};
  }
}

unsigned ScriptedUnit::field(unsigned id) const {
  if (id == 1) {
    return static_cast<unsigned>(divider_);
  }
  return id == 3 ? word_at(ByteList{static_cast<std::uint8_t>(type_[0]),
                                    static_cast<std::uint8_t>(type_[1])},
                           0)
                 : 0;
}

void ScriptedUnit::reply(const ByteList& frame) {
  if (drops_reply > 0 && ++replies_ % drops_reply == 0) {
    return;
  }
  say(frame, now_ + reply_delay);
}

void ScriptedUnit::stream() {
  if (divider_ == 0 || tick_ms_ % (10 * divider_) != 0) {
    return;
  }
  if (busy_until_ > now_ + milliseconds{20}) {
    return;  // more than its line carries
  }
  ++packets;
  // A slow clock measures later and later than ours says.
  const Time measured = now_ + Duration{std::llround(static_cast<double>(tick_ms_) * clock_ppm)};
  ByteList frame =
      is_foreign ? frame_of("s1", ByteList(52, 0x3C)) : frame_of(type_, payload(measured));
  damage(frame);
  say(frame, measured);
}

ByteList ScriptedUnit::payload(Time measured) {
  const Motion is = motion(measured);
  const bool is_true = type_[0] == 'N';
  const double yaw_deg = std::remainder(is_true ? is.yaw_deg : is.yaw_deg - declination_deg, 360.0);
  const std::int64_t time_ms =
      time_stands ? 77 : ((tick_ms_ + time_off_ms) % 604800000 + 604800000) % 604800000;
  const auto flicker = [this] {
    noise_ = noise_ * 1103515245U + 12345U;
    return flickers ? std::int64_t{(noise_ >> 16U) % 5U} - 2 : std::int64_t{0};
  };
  ByteList bytes;
  put(bytes, 0, 4);
  put(bytes, std::min<std::int64_t>(counts(yaw_deg, 360.0), 32767), 2);
  put(bytes, flicker(), 2);
  put(bytes, flicker(), 2);
  put(bytes, counts(is.yaw_rate_deg_s, 1260.0) + flicker(), 2);
  if (type_ != "N0") {
    put(bytes, flicker(), 2);
    put(bytes, flicker(), 2);
    put(bytes, -3277 + flicker(), 2);
  }
  if (is_true) {
    const Whereabouts at = place(measured);
    put(bytes, std::llround(at.north_m_s * 128.0), 2);
    put(bytes, std::llround(at.east_m_s * 128.0), 2);
    put(bytes, 0, 2);
    put(bytes, std::llround(at.longitude_deg * 4294967296.0 / 360.0), 4);
    put(bytes, std::llround(at.latitude_deg * 4294967296.0 / 360.0), 4);
  }
  const bool whole = type_[1] == '1';
  const std::size_t size = type_ == "N1" ? 42U : type_ == "A0" ? 30U : 32U;
  bytes.resize(size - 2 - (whole ? 4U : 2U), 0);
  if (is_frozen && !frozen_.empty()) {
    bytes = frozen_;
  }
  frozen_ = bytes;
  put(bytes, time_ms, whole ? 4 : 2);
  put(bytes, bit, 2);
  return bytes;
}

// One byte behind the other, as a line has it.
void ScriptedUnit::say(ByteList bytes, Time from) {
  const Duration byte_time = has_speed ? Duration{10'000'000'000 / baud_} : Duration::zero();
  Time at = std::max(from, busy_until_);
  const bool garbled = has_speed && line_.baud() != 0 && line_.baud() != baud_;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    at += byte_time;
    const Duration since = at - kUnitOn;
    const Time arrives =
        batch > Duration::zero() ? kUnitOn + (since + batch - Duration{1}) / batch * batch : at;
    const auto byte = garbled ? static_cast<std::uint8_t>(bytes[i] * 37U + i) : bytes[i];
    static_cast<void>(line_.send(byte, arrives));
  }
  busy_until_ = at;
}

Motion turning(Time at, double rate_deg_s) {
  return {std::remainder(rate_deg_s * to_seconds(at - kUnitOn), 360.0), rate_deg_s};
}

// How far headings are off what the unit did at their stamps.
double worst_error_deg(const UnitBench& bench, std::size_t from) {
  double worst = 0.0;
  for (std::size_t i = from; i < bench.samples.size(); ++i) {
    const double is_rad = to_rad(bench.unit.motion(bench.samples[i].measured).yaw_deg);
    worst = std::max(worst, std::abs(to_deg(wrap_to_pi(bench.samples[i].heading_rad - is_rad))));
  }
  return worst;
}

void UnitBench::step() {
  if (!driver) {
    driver = std::make_unique<Nav440>(line->near_end(), options, &fixes);
  }
  unit.go_on_to(now);
  for (int i = 0; i < 64; ++i) {
    const Reading<Attitude> reading = driver->poll(now);
    corrupt += reading.status == ReadStatus::kCorrupt ? 1 : 0;
    disconnected += reading.status == ReadStatus::kDisconnected ? 1 : 0;
    if (reading.status == ReadStatus::kFresh) {
      REQUIRE(reading.sample.measured <= now);
      REQUIRE((samples.empty() || reading.sample.measured > samples.back().measured));
      REQUIRE(std::abs(reading.sample.heading_rad) <= std::numbers::pi);
      samples.push_back(reading.sample);
      given.push_back(now);
    } else if (reading.status != ReadStatus::kCorrupt) {
      break;
    }
  }
  now += period;
}

void UnitBench::run(double seconds) {
  for (const Time end = now + from_seconds(seconds); now < end;) {
    step();
  }
}

bool UnitBench::comes_up(double within_s) {
  const std::size_t before = samples.size();
  for (const Time end = now + from_seconds(within_s); now < end && samples.size() == before;) {
    step();
  }
  return samples.size() > before;
}

}  // namespace lodesman::testing
