// SPDX-License-Identifier: Apache-2.0
// The bytes of an AHRS. An input is records, each a byte that says what it is: so many raw bytes,
// or a frame whose check holds, so that what stands behind the check is reached too.
#include "drivers/nav440/nav440.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "deploy/operator/decode/nav440_lines.h"
#include "drivers/stream/memory_line.h"
#include "tests/fuzz/oracle.h"
#include "tests/fuzz/targets.h"

namespace lodesman::fuzz {
namespace {

using ByteList = std::vector<std::uint8_t>;
using std::chrono::milliseconds;

[[nodiscard]] ByteList frame_of(nav440::PacketType type, const ByteList& payload) {
  ByteList frame(5 + payload.size());
  frame[0] = frame[1] = 0x55;
  frame[2] = static_cast<std::uint8_t>(type >> 8U);
  frame[3] = static_cast<std::uint8_t>(type & 0xFFU);
  frame[4] = static_cast<std::uint8_t>(payload.size());
  std::copy(payload.begin(), payload.end(), frame.begin() + 5);
  const std::uint16_t crc = nav440_crc(std::span{frame}.subspan(2));
  frame.push_back(static_cast<std::uint8_t>(crc >> 8U));
  frame.push_back(static_cast<std::uint8_t>(crc & 0xFFU));
  return frame;
}

// The records of an input, one after another.
class Records {
 public:
  explicit Records(std::string_view input) : left_{input} {}

  [[nodiscard]] bool at_end() const { return left_.empty(); }
  [[nodiscard]] ByteList next() {
    const std::uint8_t kind = take(1)[0];
    if (kind < 0x80) {
      return take(kind);
    }
    if (kind >= 0xC0) {
      ByteList payload = take(32);
      payload.resize(32);
      return frame_of(nav440::kA1, payload);
    }
    const ByteList type = take(2);
    return type.size() < 2 ? type
                           : frame_of(static_cast<nav440::PacketType>((type[0] << 8U) | type[1]),
                                      take(kind & 0x3FU));
  }

 private:
  [[nodiscard]] ByteList take(std::size_t count) {
    const std::string_view taken = left_.substr(0, count);
    left_.remove_prefix(taken.size());
    return {taken.begin(), taken.end()};
  }
  std::string_view left_;
};

struct Framed {
  std::uint16_t type;
  ByteList payload;

  friend bool operator==(const Framed&, const Framed&) = default;
};

[[nodiscard]] std::vector<Framed> framed(const ByteList& bytes, std::size_t piece) {
  Nav440Framing framing;
  std::vector<Framed> frames;
  std::size_t of_frames = 0;
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t size = std::min(piece, bytes.size() - at);
    at += framing.push(std::span{bytes}.subspan(at, size));
    while (const auto frame = framing.next()) {
      frames.push_back({frame->type, {frame->payload.begin(), frame->payload.end()}});
      of_frames += frame->payload.size() + Nav440Framing::kOverhead;
    }
    require(framing.wanted() > 0, "no byte is wanted");
  }
  require(of_frames + framing.counts().skipped_bytes + framing.pending() == bytes.size(),
          "bytes are lost count of");
  return frames;
}

// A driver at the end of a line, and a unit that answers what it must for the stream to begin.
class Wire {
 public:
  void say(const ByteList& bytes) {
    for (const std::uint8_t byte : bytes) {
      static_cast<void>(line_->send(byte, now_));
    }
  }
  void poll() {
    for (int i = 0; i < 32; ++i) {
      const auto reading = driver_.poll(now_);
      if (reading.status == ReadStatus::kFresh) {
        require(reading.sample.measured <= now_, "a sample of the future");
        require(reading.sample.measured > last_, "a sample out of order");
        require(std::abs(reading.sample.heading_rad) <= std::numbers::pi, "a heading out of range");
        require(std::abs(reading.sample.yaw_rate_rad_s) <= 11.0, "a rate out of range");
        last_ = reading.sample.measured;
      } else if (reading.status != ReadStatus::kCorrupt) {
        break;
      }
    }
    now_ += milliseconds{5};
  }
  void come_up() {
    for (int i = 0; i < 200 && driver_.state() != nav440::StartUp::State::kAwaitingStream; ++i) {
      poll();
      answer();
    }
    require(driver_.state() == nav440::StartUp::State::kAwaitingStream, "it does not start");
  }

 private:
  void answer() {
    std::array<std::uint8_t, 64> bytes{};
    const Received received = line_->receive(bytes, now_);
    static_cast<void>(heard_.push(std::span{bytes}.first(received.count)));
    while (const auto frame = heard_.next()) {
      const nav440::Packet request = nav440::decoded(frame->type, frame->payload);
      if (std::holds_alternative<nav440::Ping>(request)) {
        say(frame_of(nav440::kPing, {}));
      } else if (const auto* get = std::get_if<nav440::GetPacket>(&request)) {
        say(get->wanted == nav440::kIdentity ? frame_of(nav440::kIdentity, {0, 0, 0, 1, 'N', 0})
                                             : frame_of(nav440::kVersion, {1, 2, 3, 0, 5}));
      } else if (const auto* fields = std::get_if<nav440::Fields>(&request)) {
        ByteList reply{static_cast<std::uint8_t>(fields->size())};
        for (std::size_t i = 0; i < fields->size(); ++i) {
          append_word(reply, fields->id(i));
          if (!fields->have_values()) {
            append_word(reply, fields->id(i) == nav440::kContinuousType ? nav440::kA1 : 2);
          }
        }
        say(frame_of(frame->type, reply));
      }
    }
  }
  static void append_word(ByteList& to, unsigned word) {
    to.push_back(static_cast<std::uint8_t>(word >> 8U));
    to.push_back(static_cast<std::uint8_t>(word & 0xFFU));
  }

  std::unique_ptr<MemoryLine> line_ = std::make_unique<MemoryLine>();
  Nav440 driver_{line_->near_end(), Nav440Options{}};
  Nav440Framing heard_;
  Time now_{std::chrono::seconds{100}};
  Time last_{};
};

}  // namespace

void nav440(std::string_view input) {
  ByteList all;
  for (Records records{input}; !records.at_end();) {
    const ByteList record = records.next();
    all.insert(all.end(), record.begin(), record.end());
  }
  const std::vector<Framed> frames = framed(all, 1000);
  require(frames == framed(all, 1), "frames depend on where the bytes are cut");
  require(frames == framed(all, 1 + all.size() % 97), "frames depend on where the bytes are cut");

  std::size_t lines = 0;
  const DecodeCounts counts = nav440_lines(all, [&](const nlohmann::ordered_json& line) {
    using Handler = nlohmann::ordered_json::error_handler_t;
    require(line.dump(-1, ' ', false, Handler::replace).starts_with(R"({"type":")"),
            "a line without its type");
    ++lines;
  });
  require(counts.packets == lines && lines == frames.size(), "packets are lost count of");

  Wire fresh;
  Wire started;
  started.come_up();
  for (Records records{input}; !records.at_end();) {
    const ByteList record = records.next();
    for (Wire* wire : {&fresh, &started}) {
      wire->say(record);
      for (int i = 0; i < 4; ++i) {
        wire->poll();
      }
    }
  }
}

}  // namespace lodesman::fuzz
