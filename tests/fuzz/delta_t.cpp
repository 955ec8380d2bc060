// SPDX-License-Identifier: Apache-2.0
// The bytes of a sonar's program. An input is a file of records for `decode`, and the same bytes
// are datagrams for the driver: each begins with two bytes of its length, the high one first, of
// which the highest bit says that its header's own lengths are put right, so that what stands
// behind them is reached too.
#include "drivers/delta_t/delta_t.h"

#include <cmath>
#include <memory>
#include <vector>

#include "deploy/operator/decode/delta_t_lines.h"
#include "drivers/delta_t/control.h"
#include "drivers/stream/memory_datagrams.h"
#include "mid_level/messages/sane.h"
#include "tests/fuzz/oracle.h"
#include "tests/fuzz/targets.h"

namespace lodesman::fuzz {
namespace {

using ByteList = std::vector<std::uint8_t>;
using std::chrono::milliseconds;

void put_lengths_right(ByteList& record) {
  constexpr std::size_t kMost = 60256;
  if (record.size() < delta_t::kHeaderBytes) {
    record.resize(delta_t::kHeaderBytes);
  }
  const bool is_image = record[2] == 'B';
  const std::size_t beams = std::size_t{record[70]} << 8U | record[71];
  const std::size_t samples = std::size_t{record[72]} << 8U | record[73];
  const std::size_t a_beam = is_image ? samples : record[117] == 1 ? 4 : 2;
  const std::size_t length = std::min(kMost, delta_t::kHeaderBytes + beams * a_beam);
  record.resize(length);
  const std::size_t at = is_image ? 5 : 4;
  record[4] = 0;
  record[at] = static_cast<std::uint8_t>(length >> 8U);
  record[at + 1] = static_cast<std::uint8_t>(length & 0xFFU);
}

// The datagrams of an input, one after another.
class Datagrams {
 public:
  explicit Datagrams(std::string_view input) : left_{input} {}

  [[nodiscard]] bool at_end() const { return left_.size() < 2; }
  [[nodiscard]] ByteList next() {
    constexpr unsigned kIsMended = 0x80;
    const auto high = static_cast<std::uint8_t>(left_[0]);
    const auto low = static_cast<std::uint8_t>(left_[1]);
    const std::string_view taken = left_.substr(2, ((high & ~kIsMended) << 8U) | low);
    left_.remove_prefix(2 + taken.size());
    ByteList bytes{taken.begin(), taken.end()};
    if ((high & kIsMended) != 0) {
      put_lengths_right(bytes);
    }
    return bytes;
  }

 private:
  std::string_view left_;
};

void decode(std::string_view input) {
  const ByteList all{input.begin(), input.end()};
  std::size_t lines = 0;
  const DecodeCounts counts = delta_t_lines(all, [&](const nlohmann::ordered_json& line) {
    require(line.dump().starts_with(R"({"type":")"), "a line without its type");
    ++lines;
  });
  require(counts.packets == lines, "records are lost count of");
  require(counts.skipped_bytes <= all.size(), "more bytes are skipped than there are");
}

// A driver, and what it may make of any datagrams.
class Listener {
 public:
  void hear(const ByteList& bytes) {
    static_cast<void>(socket_->far_end().reply(bytes));
    for (int i = 0; i < 3; ++i) {
      now_ += milliseconds{20};
      if (driver_.poll(now_, *ping_) == ReadStatus::kFresh) {
        require(sane(*ping_), "a ping that is not sane");
        require(ping_->captured <= now_, "a ping of the future");
        require(ping_->captured > last_, "a ping out of order");
        require(ping_->number > number_, "a number that does not rise");
        last_ = ping_->captured;
        number_ = ping_->number;
      }
    }
    ByteList asked(1024);
    while (true) {
      const auto got = socket_->far_end().receive(asked);
      if (!got.any) {
        break;
      }
      require(delta_t::control_in(std::span{asked}.first(got.size)) == delta_t::Control{},
              "it asks for something else");
    }
  }

 private:
  std::unique_ptr<MemoryDatagrams> socket_ = std::make_unique<MemoryDatagrams>();
  std::unique_ptr<SonarPing> ping_ = std::make_unique<SonarPing>();
  DeltaT driver_{socket_->near_end(), DeltaTSettings{}};
  Time now_{std::chrono::seconds{100}};
  Time last_{};
  std::uint64_t number_ = 0;
};

}  // namespace

void delta_t(std::string_view input) {
  decode(input);
  Listener listener;
  listener.hear({});
  for (Datagrams datagrams{input}; !datagrams.at_end();) {
    listener.hear(datagrams.next());
  }
}

}  // namespace lodesman::fuzz
