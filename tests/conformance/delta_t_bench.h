// SPDX-License-Identifier: Apache-2.0
// The driver of the Delta T on a bench: datagrams in memory, and ten images a second from what
// stands for the maker's program. What a bench is says bench.h. One thread.
#pragma once

#include "drivers/delta_t/delta_t.h"
#include "drivers/stream/memory_datagrams.h"
#include "tests/conformance/bench.h"
#include "tests/support/delta_t_records.h"

namespace lodesman::conformance {

class DeltaTBench {
 public:
  [[nodiscard]] ImagingSonar& device() noexcept { return driver_; }
  [[nodiscard]] Time now() const noexcept { return now_; }
  [[nodiscard]] static Duration period() noexcept { return std::chrono::milliseconds{100}; }
  [[nodiscard]] static Duration recovery() noexcept { return 3 * period(); }

  void pass(Duration span) {
    for (const Time end = now_ + span; now_ < end;) {
      now_ = std::min(now_ + std::chrono::milliseconds{1}, end);
      if (now_ >= due_) {
        due_ += period();
        send();
      }
    }
  }
  void come_up() {
    const auto ping = std::make_unique<SonarPing>();
    for (int i = 0; i < kStepsToComeUp; ++i) {
      pass(period() / 4);
      if (driver_.poll(now_, *ping) == ReadStatus::kFresh) {
        return;
      }
    }
  }
  void fail(BenchFault fault) {
    fault_ = fault;
    fails_ = true;
    if (fault == BenchFault::kDisconnect) {
      socket_->unplug();
    }
  }
  void mend() {
    fails_ = false;
    socket_->plug();
  }

 private:
  void send() {
    ++number_;
    if (fails_ && fault_ != BenchFault::kCorrupt) {
      return;
    }
    testing::RecordWriter number{4};
    number.number(0, 4, number_);
    const auto bytes = number.take();
    std::copy(bytes.begin(), bytes.end(), image_.begin() + 93);
    const std::size_t cut = fails_ ? 1 : 0;
    static_cast<void>(socket_->far_end().reply(std::span{image_}.first(image_.size() - cut)));
  }

  Time now_{std::chrono::seconds{10}};
  Time due_{now_};
  std::uint32_t number_ = 0;
  BenchFault fault_ = BenchFault::kStall;
  bool fails_ = false;
  std::unique_ptr<MemoryDatagrams> socket_ = std::make_unique<MemoryDatagrams>();
  testing::ByteList image_ =
      testing::usual_image(testing::usual_header(delta_t::RecordKind::kImage, 0));
  DeltaT driver_{socket_->near_end(), DeltaTSettings{}};
};

}  // namespace lodesman::conformance
