// SPDX-License-Identifier: Apache-2.0
// The driver with the maker's program in the test's hand, and time that passes as the test will
// have it.
#pragma once

#include <memory>

#include "drivers/delta_t/delta_t.h"
#include "drivers/stream/memory_datagrams.h"
#include "mid_level/messages/sane.h"
#include "tests/support/catch.h"
#include "tests/support/delta_t_records.h"

namespace lodesman::testing {

class DeltaTBench {
 public:
  explicit DeltaTBench(const DeltaTSettings& settings = {}) : driver{socket->near_end(), settings} {
    poll();  // from here on what comes is news
  }

  bool send(const ByteList& bytes) { return socket->far_end().reply(bytes); }
  bool send_image(std::uint32_t number) {
    return send(usual_image(usual_header(delta_t::RecordKind::kImage, number)));
  }
  ReadStatus poll(Duration after = std::chrono::milliseconds{10}) {
    now += after;
    const ReadStatus status = driver.poll(now, *ping);
    if (status == ReadStatus::kFresh) {
      REQUIRE(sane(*ping));
      REQUIRE(ping->captured <= now);
      REQUIRE(ping->captured > last_stamp);
      REQUIRE(ping->number > last_number);
      last_stamp = ping->captured;
      last_number = ping->number;
    }
    return status;
  }
  // What it was asked for since the last time: the last frame, and how many there were.
  [[nodiscard]] std::optional<delta_t::Control> asked() {
    std::optional<delta_t::Control> control;
    asked_frames = 0;
    ByteList buffer(65536);
    for (auto got = socket->far_end().receive(buffer); got.any;
         got = socket->far_end().receive(buffer)) {
      REQUIRE(got.size == delta_t::kControlBytes);
      control = delta_t::control_in(std::span{buffer}.first(got.size));
      REQUIRE(control);
      ++asked_frames;
    }
    return control;
  }

  std::unique_ptr<MemoryDatagrams> socket = std::make_unique<MemoryDatagrams>();
  Time now{std::chrono::seconds{100}};
  Time last_stamp{};
  std::uint64_t last_number = 0;
  int asked_frames = 0;
  std::unique_ptr<SonarPing> ping = std::make_unique<SonarPing>();
  DeltaT driver;
};

}  // namespace lodesman::testing
