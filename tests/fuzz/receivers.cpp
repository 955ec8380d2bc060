// SPDX-License-Identifier: Apache-2.0
// The bytes of a satellite receiver, or of gpsd in front of one: any bytes, and behind them a sound
// fix, which must come out.
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "deploy/operator/decode/nmea_lines.h"
#include "drivers/gpsd/gpsd_receiver.h"
#include "drivers/nmea/nmea_receiver.h"
#include "drivers/stream/memory_line.h"
#include "mid_level/messages/sane.h"
#include "tests/fuzz/oracle.h"
#include "tests/fuzz/targets.h"

namespace lodesman::fuzz {
namespace {

using std::chrono::milliseconds;

// Reads as the position task does.
class Listener {
 public:
  Listener(MemoryLine& line, PositionSensor& driver) : line_{line}, driver_{driver} { poll(); }

  void say(std::string_view text) {
    for (const char letter : text) {
      while (!line_.send(static_cast<std::uint8_t>(letter), now_)) {
        poll();
      }
    }
    poll();
  }
  void pass(Duration span) {
    now_ += span;
    poll();
  }
  [[nodiscard]] int fixes() const { return fixes_; }

 private:
  void poll() {
    for (int i = 0; i < 4096; ++i) {
      const auto reading = driver_.poll(now_);
      if (reading.status == ReadStatus::kFresh) {
        const PositionFix& fix = reading.sample;
        require(sane(fix), "a fix that is not sane");
        require(fix.measured <= now_, "a fix of the future");
        require(fix.measured > last_, "a fix out of order");
        require(fix.sigma_m >= 0.02, "a fix without doubt");
        last_ = fix.measured;
        ++fixes_;
      } else if (reading.status != ReadStatus::kCorrupt) {
        break;
      }
    }
    std::array<std::uint8_t, 128> heard{};
    static_cast<void>(line_.receive(heard, now_));
  }

  MemoryLine& line_;
  PositionSensor& driver_;
  Time now_{std::chrono::seconds{100}};
  Time last_{};
  int fixes_ = 0;
};

[[nodiscard]] std::vector<std::string> framed(std::string_view bytes) {
  NmeaFraming framing;
  std::vector<std::string> sentences;
  for (const char byte : bytes) {
    if (const auto sentence = framing.push(static_cast<std::uint8_t>(byte))) {
      sentences.emplace_back(*sentence);
      static_cast<void>(nmea::decoded(*sentence));
    }
  }
  require(framing.counts().sentences == sentences.size(), "sentences are lost count of");
  return sentences;
}

}  // namespace

void nmea(std::string_view input) {
  const std::vector<std::string> sentences = framed(input);
  static_cast<void>(nmea::decoded(input));
  std::size_t lines = 0;
  const std::vector<std::uint8_t> bytes{input.begin(), input.end()};
  const DecodeCounts counts = nmea_lines(bytes, [&](const nlohmann::ordered_json& line) {
    using Handler = nlohmann::ordered_json::error_handler_t;
    require(line.dump(-1, ' ', false, Handler::replace).starts_with(R"({"type":")"),
            "a line without its type");
    ++lines;
  });
  require(counts.packets == lines && lines == sentences.size(), "sentences are lost count of");

  const auto line = std::make_unique<MemoryLine>();
  NmeaReceiver driver{line->near_end(), NmeaOptions{}};
  Listener listener{*line, driver};
  listener.say(input);
  listener.pass(std::chrono::seconds{20});
  // Three that follow from each other, whatever the receiver's time was before.
  const int before = listener.fixes();
  listener.say("\r\n");
  for (const char* epoch : {"$GPRMC,000001,A,3501.6320,S,13854.0000,W,,,211126,,*1F\r\n",
                            "$GPRMC,000002,A,3501.6321,S,13854.0000,W,,,211126,,*1D\r\n",
                            "$GPRMC,000003,A,3501.6322,S,13854.0000,W,,,211126,,*1F\r\n",
                            "$GPRMC,000004,A,3501.6323,S,13854.0000,W,,,211126,,*19\r\n"}) {
    listener.say(epoch);
    listener.pass(std::chrono::seconds{1});
  }
  require(listener.fixes() > before, "a sound fix is lost behind what came before");
}

void gpsd(std::string_view input) {
  for (std::size_t at = 0; at <= input.size();) {
    const std::size_t end = std::min(input.find('\n', at), input.size());
    static_cast<void>(gpsd::decoded(input.substr(at, end - at)));
    at = end + 1;
  }
  const auto line = std::make_unique<MemoryLine>();
  GpsdReceiver driver{line->near_end(), GpsdOptions{}};
  Listener listener{*line, driver};
  listener.say(input);
  listener.pass(milliseconds{100});
  listener.pass(std::chrono::seconds{4});
  listener.pass(std::chrono::seconds{4});  // and the connection is given up
  listener.pass(std::chrono::seconds{4});
  const int before = listener.fixes();
  for (const char digit : {'1', '2', '3', '4'}) {
    std::string report = R"({"class":"TPV","device":"/x","mode":3,"time":"2026-11-21T00:00:0)";
    report += digit;
    report += R"(Z","lat":-35.)";
    report += digit;
    listener.say(report + ",\"lon\":-1}\n");
    listener.pass(std::chrono::seconds{1});
  }
  require(listener.fixes() > before, "a sound fix is lost behind what came before");
}

}  // namespace lodesman::fuzz
