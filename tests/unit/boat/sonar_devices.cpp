// SPDX-License-Identifier: Apache-2.0
// The sonars that an address can name, made as lodesman-low makes them.
#include <fstream>

#include "deploy/boat/device_contract.h"
#include "drivers/delta_t/control.h"
#include "drivers/stream/udp_socket.h"
#include "tests/support/delta_t_records.h"
#include "tests/support/pty_device.h"
#include "tests/unit/report/temporary_directory.h"

namespace lodesman {
namespace {

using std::chrono::milliseconds;

struct Yard {
  BoatConfig config = load_configuration("default", {});
  std::unique_ptr<Blackboard> board = std::make_unique<Blackboard>();
  std::vector<std::unique_ptr<ByteStream>> lines;
  Nav440FixRelay fixes;

  [[nodiscard]] std::unique_ptr<ImagingSonar> sonar(const std::string& address) {
    const Workshop shop{config, *board, nullptr, nullptr, nullptr, lines, fixes};
    return make_sonar(shop, address);
  }
};

[[nodiscard]] BoatConfig with_sonar(const std::string& address) {
  CommonOptions options;
  options.sets = {"devices.sonar=\"" + address + "\""};
  return load_configuration("default", options);
}

TEST_CASE("sonar devices: addresses are checked where they stand, and nothing is opened",
          "[boat]") {
  for (const std::string good :
       {"sim:", "delta_t:192.0.2.7", "delta_t:sonar-pc?output=83P&beams=480&range_m=80",
        "file:/no/such/directory", "file:recording?beam_sign=port"}) {
    INFO(good);
    const BoatConfig config = with_sonar(good);
    CHECK_NOTHROW(require_addresses(config));
  }
  for (const std::string bad : {"delta_t:", "delta_t:pc?range_m=31", "delta_t:pc?output=83Z",
                                "delta_t:pc?beams=240", "file:", "file:x?beam_sign=left",
                                "file:x?port=4040", "sim:?range_m=30", "loop:delta_t?x=1"}) {
    INFO(bad);
    CHECK_THROWS_AS(require_addresses(with_sonar(bad)), StartupError);
  }
}

// Why the sonar of that address is refused with the fault; empty where it is not.
[[nodiscard]] std::string refusal_of(const std::string& address, FaultKind kind) {
  Scenario scenario;
  scenario.faults = {{FaultDevice::kSonar, kind, 0.0, 1.0}};
  try {
    require_faults(with_sonar(address), scenario);
    return {};
  } catch (const StartupError& error) {
    return error.what();
  }
}

TEST_CASE("sonar devices: each has the faults that it can have, and the rest are refused",
          "[boat]") {
  const auto is_of_bytes = [](const std::string& refusal) {
    return refusal.find("needs a device that is emulated to the byte") != std::string::npos;
  };
  CHECK(is_of_bytes(refusal_of("sim:", FaultKind::kDrop)));
  CHECK(refusal_of("loop:delta_t", FaultKind::kDrop).empty());
  for (const FaultKind kind : {FaultKind::kSaturated, FaultKind::kFrozen, FaultKind::kBlinded,
                               FaultKind::kWeed, FaultKind::kInterference}) {
    CHECK(refusal_of("sim:", kind).empty());
    CHECK(refusal_of("loop:delta_t", kind).empty());
    CHECK(refusal_of("loop:delta_t?output=83P&control=off", kind).empty());
    CHECK(refusal_of("loop:delta_t?output=83P", kind).find("output=83P") != std::string::npos);
  }
}

TEST_CASE("sonar devices: a recording is played", "[boat]") {
  const testing::TemporaryDirectory folder;
  {
    std::ofstream stream{folder.path() / "a.83B", std::ios::binary};
    for (const std::uint8_t byte :
         testing::usual_image(testing::usual_header(delta_t::RecordKind::kImage, 1))) {
      stream.put(static_cast<char>(byte));
    }
  }
  Yard yard;
  const auto sonar = yard.sonar("file:" + folder.path().string());
  REQUIRE(sonar);
  const auto ping = std::make_unique<SonarPing>();
  REQUIRE(sonar->poll(Time{std::chrono::seconds{1}}, *ping) == ReadStatus::kFresh);
  CHECK(ping->echo[30 * 500 + 100] == 200);
  CHECK_THROWS_AS(yard.sonar("file:" + (folder.path() / "none").string()), StartupError);
}

TEST_CASE("sonar devices: a datagram wakes the task, is given, and is answered", "[boat]") {
  const std::uint16_t port = UdpSocket{{"127.0.0.1"}}.local_port();  // one that was free just now
  Yard yard;
  const Bell<>& bell = yard.board->bell_of(TaskId::kDeltaT);
  const auto sonar = yard.sonar("delta_t:127.0.0.1?range_m=10&port=" + std::to_string(port));
  REQUIRE(sonar);
  UdpSocket program{{"127.0.0.1", port}};
  const auto ping = std::make_unique<SonarPing>();
  Time now{std::chrono::seconds{1}};
  CHECK(sonar->poll(now, *ping) == ReadStatus::kNothingNew);
  const std::uint32_t before = look_at(bell);
  REQUIRE(
      program.reply(testing::usual_image(testing::usual_header(delta_t::RecordKind::kImage, 1))));
  CHECK(testing::eventually([&] { return look_at(bell) != before; }));
  now += milliseconds{20};
  REQUIRE(sonar->poll(now, *ping) == ReadStatus::kFresh);
  CHECK(ping->captured == now);
  testing::ByteList asked(1024);
  DatagramSocket::Received received;
  REQUIRE(testing::eventually([&] { return (received = program.receive(asked)).any; }));
  const auto control = delta_t::control_in(std::span{asked}.first(received.size));
  REQUIRE(control);
  CHECK(control->range_m == 10);
  CHECK_THROWS_AS(yard.sonar("delta_t:127.0.0.1?port=" + std::to_string(port)), StartupError);
}

}  // namespace
}  // namespace lodesman
