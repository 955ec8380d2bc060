// SPDX-License-Identifier: Apache-2.0
// The hand-over of a port between helper and task, with ports that keep account of who has them.
// tests/conformance has the same line over real ones.
#include "drivers/stream/reconnecting_line.h"

#include <array>
#include <latch>

#include "tests/support/pty_device.h"

namespace lodesman::testing {
namespace {

using std::chrono::milliseconds;

constexpr Time kNow{std::chrono::seconds{5}};

// What the ports of one line do, and what was seen of them.
struct PortBook {
  std::atomic<int> open{0};
  std::atomic<int> opened{0};
  std::atomic<int> tries{0};
  std::atomic<bool> is_there{true};
  std::atomic<bool> broken{false};  // a rule, by anybody
  std::atomic<std::thread::id> destroyed_by{};
  std::atomic<bool> may_close{true};
  std::atomic<int> speed_seen{0};
};

class BookedPort final : public Port {
 public:
  BookedPort(PortBook& book, int baud) : book_{book}, baud_{baud} {
    if (++book_.open != 1) {
      book_.broken = true;  // the one before it is still open
    }
    ++book_.opened;
  }
  ~BookedPort() override {
    book_.destroyed_by = std::this_thread::get_id();
    while (!book_.may_close) {
      std::this_thread::sleep_for(milliseconds{1});
    }
    in_use_ = 1000;  // not atomic: a task that is still at it is a race
    --book_.open;
  }
  std::size_t read(std::span<std::uint8_t> into) noexcept override {
    ++in_use_;
    into[0] = static_cast<std::uint8_t>(in_use_);
    book_.speed_seen = baud_;
    return 1;
  }
  std::size_t write(std::span<const std::uint8_t> bytes) noexcept override { return bytes.size(); }
  [[nodiscard]] bool is_gone() const noexcept override { return false; }
  [[nodiscard]] int descriptor() const noexcept override { return -1; }

 private:
  PortBook& book_;
  int baud_;
  int in_use_ = 0;
};

[[nodiscard]] PortOpener opener(PortBook& book) {
  return [&book](const std::string& /*path*/, int baud) -> OpenedPort {
    ++book.tries;
    if (!book.is_there) {
      return {nullptr, DeviceFault::kNoPort};
    }
    return {std::make_unique<BookedPort>(book, baud), DeviceFault::kNone};
  };
}

TEST_CASE("reconnecting line: one thread has a port at a time, and no two are open", "[drivers]") {
  PortBook book;
  {
    ReconnectingLine line{"port", 0, opener(book)};
    std::array<std::uint8_t, 4> bytes{};
    std::uint64_t last = 0;
    for (int baud = 1; baud <= 3000; ++baud) {
      line.reconnect(baud);
      if (baud % 3 != 0) {
        continue;  // asked again before it was done
      }
      REQUIRE(eventually([&] { return line.connection(kNow) != 0; }));
      CHECK(line.connection(kNow) > last);
      last = line.connection(kNow);
      for (int i = 0; i < 5; ++i) {
        REQUIRE(line.read(bytes, kNow).count == 1);
      }
      REQUIRE(book.speed_seen == baud);  // never one that was asked for before
    }
  }
  CHECK_FALSE(book.broken);
  CHECK(book.open == 0);
  CHECK(book.opened >= 1000);
  CHECK(book.destroyed_by != std::this_thread::get_id());
}

TEST_CASE("S2: a port that takes long to close or to open keeps nobody waiting", "[drivers]") {
  PortBook book;
  std::latch may_open{1};
  std::atomic<int> opening{0};
  const PortOpener at_once = opener(book);
  ReconnectingLine line{"port", 9600, [&](const std::string& path, int baud) {
                          ++opening;
                          if (book.tries > 0) {
                            may_open.wait();
                          }
                          return at_once(path, baud);
                        }};
  REQUIRE(eventually([&] { return line.connection(kNow) == 1; }));
  book.may_close = false;
  line.reconnect(19200);
  std::array<std::uint8_t, 4> bytes{};
  // Were one of these to wait for the port, this would never end.
  const auto use = [&](int baud) {
    for (int i = 0; i < 100; ++i) {
      CHECK(line.connection(kNow) == 0);
      CHECK(line.read(bytes, kNow).count == 0);
      CHECK(line.write(bytes, kNow) == 0);
      line.reconnect(baud + i);
    }
  };
  REQUIRE(eventually([&] { return book.destroyed_by.load() != std::thread::id{}; }));
  use(19200);
  book.may_close = true;
  REQUIRE(eventually([&] { return opening == 2; }));
  use(38400);  // while it is being opened at another speed
  CHECK(line.fault() == DeviceFault::kNone);
  may_open.count_down();
  REQUIRE(eventually([&] { return line.connection(kNow) == 2; }));
  REQUIRE(line.read(bytes, kNow).count == 1);
  CHECK(book.speed_seen == 38499);
  CHECK(book.destroyed_by != std::this_thread::get_id());
}

TEST_CASE("reconnecting line: it looks for a port ever more seldom, and at once when asked",
          "[drivers]") {
  PortBook book;
  book.is_there = false;
  std::array<std::atomic<std::int64_t>, 7> tried_ns{};
  const PortOpener counting = opener(book);
  ReconnectingLine line{
      "port", 9600, [&](const std::string& path, int baud) {
        if (const auto number = static_cast<std::size_t>(book.tries); number < tried_ns.size()) {
          tried_ns.at(number) = std::chrono::steady_clock::now().time_since_epoch().count();
        }
        return counting(path, baud);
      }};
  REQUIRE(eventually([&] { return book.tries >= 7; }));
  CHECK(line.fault() == DeviceFault::kNoPort);
  const std::array<int, 6> pauses_ms{100, 200, 400, 800, 1000, 1000};
  for (std::size_t i = 0; i < pauses_ms.size(); ++i) {
    CHECK(std::chrono::nanoseconds{tried_ns.at(i + 1) - tried_ns.at(i)} >=
          milliseconds{pauses_ms.at(i)});
  }
  book.is_there = true;
  line.reconnect(19200);
  CHECK(eventually([&] { return line.connection(kNow) == 1; }));
  CHECK(line.fault() == DeviceFault::kNone);
}

TEST_CASE("reconnecting line: nothing is asked of a port for no bytes", "[drivers]") {
  PortBook book;
  ReconnectingLine line{"port", 9600, opener(book)};
  REQUIRE(eventually([&] { return line.connection(kNow) == 1; }));
  for (int i = 0; i < 3; ++i) {
    const Time later = kNow + i * ReconnectingLine::kFullLimit;
    CHECK(line.read({}, later).count == 0);
    CHECK(line.write({}, later) == 0);
  }
  CHECK(book.speed_seen == 0);
  CHECK(line.connection(kNow) == 1);
}

}  // namespace
}  // namespace lodesman::testing
