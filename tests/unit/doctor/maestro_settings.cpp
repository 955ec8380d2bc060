// SPDX-License-Identifier: Apache-2.0
// A Maestro's memory as bytes: what doctor reads in it, and says.
#include "deploy/operator/doctor/maestro_settings.h"

#include <map>

#include "tests/support/catch.h"

namespace lodesman::testing {
namespace {

using namespace cli;

constexpr const char* kAddress = "maestro:/dev/ttyACM0?left=0&right=1&time_out_s=0.5";

// By the index of the parameter, byte by byte; limits are in 16 us.
class Memory {
 public:
  Memory() {
    put(3, {0});
    put(6, {50, 0});  // 0.5 s
    put(8, {0});
    put(9, {1});
    for (unsigned channel = 0; channel < 24; ++channel) {
      put_channel(channel, {0x70, 0x17, 62, 125, 0x70, 0x17, 15, 0, 0});  // 1500, 992 to 2000 us
    }
  }
  void put(unsigned index, const std::vector<std::uint8_t>& bytes) {
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      bytes_[static_cast<unsigned>(index + i)] = bytes[i];
    }
  }
  // At so many bytes into the nine of the channel.
  void put_channel(unsigned channel, const std::vector<std::uint8_t>& bytes, unsigned at = 0) {
    put(30 + 9 * channel + at, bytes);
  }
  [[nodiscard]] MaestroParameters parameters() {
    return [this](std::uint8_t index, std::span<std::uint8_t> bytes) {
      asked_ += 1;
      for (std::size_t i = 0; i < bytes.size(); ++i) {
        bytes[i] = bytes_[static_cast<unsigned>(index + i)];
      }
      return asked_ != fails_at;
    };
  }
  [[nodiscard]] int asked() const { return asked_; }
  [[nodiscard]] std::vector<Finding> findings(const MaestroNeeds& needs) {
    const auto settings = read_maestro(parameters(), needs.options);
    REQUIRE(settings);
    return judge_maestro("box", *settings, needs);
  }
  [[nodiscard]] std::vector<Finding> findings(const std::string& address = kAddress) {
    return findings(maestro_needs(address, {}));
  }
  [[nodiscard]] Finding only_finding(const std::string& address = kAddress) {
    const auto all = findings(address);
    for (const Finding& one : all) {
      UNSCOPED_INFO(one.line());
    }
    REQUIRE(all.size() == 1);
    CHECK(all[0].name == "maestro");
    CHECK(all[0].what.starts_with("box: "));
    return all[0];
  }

  int fails_at = 0;  // that question

 private:
  std::map<unsigned, std::uint8_t> bytes_;
  int asked_ = 0;
};

[[nodiscard]] bool says(const std::string& text, std::string_view words) {
  UNSCOPED_INFO(text);
  return text.find(words) != std::string::npos;
}

TEST_CASE("maestro settings: each parameter is read at its place", "[cli]") {
  Memory memory;
  memory.put(3, {1});
  memory.put(6, {0x2C, 0x01});
  memory.put(8, {1});
  memory.put(9, {0});
  memory.put_channel(5, {0x0F, 0x1F, 10, 200, 0, 0, 0, 3, 4});
  memory.put_channel(23, {1, 0, 64, 255, 0, 0, 0, 0, 7});
  MaestroOptions options;
  options.left_channel = 23;
  options.right_channel = 5;
  const auto settings = read_maestro(memory.parameters(), options);
  REQUIRE(settings);
  CHECK(settings->serial_mode == MaestroSettings::kUsbChained);
  CHECK(settings->time_out == std::chrono::seconds{3});
  CHECK(settings->crc);
  CHECK_FALSE(settings->never_suspend);
  CHECK(settings->left.home_quarter_us == MaestroChannel::kHomeIgnore);
  CHECK(settings->left.least_quarter_us == 4096);
  CHECK(settings->left.most_quarter_us == 16320);
  CHECK(settings->left.acceleration == 7);
  CHECK(settings->right.home_quarter_us == 0x1F0F);
  CHECK(settings->right.least_quarter_us == 640);
  CHECK(settings->right.most_quarter_us == 12800);
  CHECK(settings->right.speed == 3);
  CHECK(settings->right.acceleration == 4);
}

TEST_CASE("maestro settings: a box that leaves one question open is not judged", "[cli]") {
  Memory whole;
  REQUIRE(read_maestro(whole.parameters(), {}));
  CHECK(whole.asked() == 14);
  for (int fails_at = 1; fails_at <= 14; ++fails_at) {
    Memory memory;
    memory.fails_at = fails_at;
    CHECK_FALSE(read_maestro(memory.parameters(), {}));
    CHECK(memory.asked() == fails_at);  // and is not asked on
  }
}

TEST_CASE(
    "maestro settings: nothing is wrong with a box that is set as the manual of this boat says",
    "[cli]") {
  Memory memory;
  const Finding finding = memory.only_finding();
  CHECK(finding.verdict == Verdict::kOk);
  CHECK(finding.remedy.empty());
}

TEST_CASE("maestro settings: T1: as it leaves the factory it is told what to change", "[cli]") {
  Memory memory;
  memory.put(3, {2});
  memory.put(6, {0, 0});
  memory.put(9, {0});
  memory.put_channel(0, {0, 0});
  memory.put_channel(1, {0, 0});
  const auto findings = memory.findings();
  REQUIRE(findings.size() == 5);
  CHECK(says(findings[0].what, "UART, detect baud rate"));
  CHECK(findings[0].verdict == Verdict::kBad);
  CHECK(says(findings[0].remedy, "USB Dual Port"));
  CHECK(says(findings[0].remedy, "<SerialMode>USB_DUAL_PORT</SerialMode>"));
  CHECK(says(findings[0].remedy, "UscCmd --configure"));
  CHECK(says(findings[1].what, "no serial time-out"));
  CHECK(says(findings[2].what, "sleeps"));
  CHECK(says(findings[3].what, "channel 0 sends no pulses"));
  CHECK(says(findings[4].what, "channel 1 sends no pulses"));
  CHECK(any_bad(findings));
}

TEST_CASE("maestro settings: of the serial modes both of USB's do", "[cli]") {
  Memory memory;
  memory.put(3, {1});
  CHECK(memory.only_finding().verdict == Verdict::kInfo);
  memory.put(3, {3});
  CHECK(memory.only_finding().verdict == Verdict::kBad);
  CHECK(says(memory.only_finding().what, "fixed"));
  memory.put(3, {77});
  CHECK(memory.only_finding().verdict == Verdict::kBad);
  CHECK(says(memory.only_finding().what, "77"));
}

TEST_CASE("maestro settings: T2: a time-out that is not the configured one is told of", "[cli]") {
  Memory memory;
  memory.put(6, {0, 0});
  CHECK(memory.only_finding().verdict == Verdict::kBad);
  CHECK(says(memory.only_finding().remedy, "Timeout 0.5 s"));
  CHECK(says(memory.only_finding().remedy, "<SerialTimeout>50</SerialTimeout>"));
  CHECK_FALSE(says(memory.only_finding().remedy, "time_out_s"));
  memory.put(6, {80, 0});  // longer than the boat counts on
  CHECK(memory.only_finding().verdict == Verdict::kBad);
  CHECK(says(memory.only_finding().what, "0.8 s, and the boat counts on 0.5 s"));
  CHECK(says(memory.only_finding().remedy, "time_out_s=0.8"));
  memory.put(6, {40, 0});
  CHECK(memory.only_finding().verdict == Verdict::kWarn);
  memory.put(6, {0xFF, 0xFF});
  CHECK(says(memory.only_finding().what, "655.35 s"));
  CHECK_FALSE(says(memory.only_finding().remedy, "time_out_s"));
  for (const auto& [setting, units] :
       {std::pair{"0.3", 30}, std::pair{"0.35", 35}, std::pair{"0.7", 70}, std::pair{"0.9", 90}}) {
    memory.put(6, {static_cast<std::uint8_t>(units), 0});
    const std::string address = std::string{"maestro:/dev/ttyACM0?time_out_s="} + setting;
    CHECK(memory.only_finding(address).verdict == Verdict::kOk);
  }
}

TEST_CASE("maestro settings: box and driver have to agree on the CRC", "[cli]") {
  Memory memory;
  CHECK(memory.only_finding("maestro:/dev/ttyACM0?crc=on").verdict == Verdict::kBad);
  CHECK(says(memory.only_finding("maestro:/dev/ttyACM0?crc=on").remedy, "Enable CRC on"));
  memory.put(8, {1});
  CHECK(memory.only_finding().verdict == Verdict::kBad);
  CHECK(says(memory.only_finding().remedy, "<EnableCrc>false</EnableCrc>"));
  CHECK(says(memory.only_finding().remedy, "crc=on in devices.thrusters"));
  CHECK(memory.only_finding("maestro:/dev/ttyACM0?crc=on").verdict == Verdict::kOk);
}

TEST_CASE("maestro settings: U6: a box that may sleep with the bus is told of", "[cli]") {
  Memory memory;
  memory.put(9, {0});
  CHECK(memory.only_finding().verdict == Verdict::kWarn);
  CHECK(says(memory.only_finding().remedy, "Never sleep"));
}

TEST_CASE("maestro settings: on error both thrusters, and no other channel, go to neutral",
          "[cli]") {
  Memory memory;
  memory.put_channel(2, {0, 0});
  CHECK(memory.only_finding().verdict == Verdict::kOk);
  memory.put_channel(1, {1, 0});
  CHECK(memory.only_finding().verdict == Verdict::kBad);
  CHECK(says(memory.only_finding().what, "channel 1 keeps its pulse"));
  CHECK(says(memory.only_finding().remedy, "homemode=\"Goto\" home=\"6000\""));
  CHECK(memory.only_finding("maestro:/dev/ttyACM0?left=3&right=4").verdict == Verdict::kOk);
  memory.put_channel(1, {0xB0, 0x17});  // 1516 us
  CHECK(says(memory.only_finding().what, "goes to 1516 us, and neutral is 1500 us"));
  CHECK(says(memory.only_finding("maestro:/dev/ttyACM0?neutral_us=1516").what, "channel 0 goes"));
  memory.put_channel(1, {0x71, 0x17});  // a quarter off, as the driver allows
  CHECK(memory.only_finding().verdict == Verdict::kOk);
  memory.put_channel(1, {0x72, 0x17});
  CHECK(memory.only_finding().verdict == Verdict::kBad);
}

TEST_CASE("maestro settings: limits have room for all the thrust that is ever commanded", "[cli]") {
  Memory memory;
  memory.put_channel(0, {63}, 2);  // 1008 us is within 1023.75
  CHECK(memory.only_finding().verdict == Verdict::kOk);
  memory.put_channel(0, {64}, 2);  // 1024 us is not
  CHECK(memory.only_finding().verdict == Verdict::kBad);
  CHECK(says(memory.only_finding().what,
             "limited to 1024 to 2000 us, and thrust needs 1023.75 to 1976.25 us"));
  CHECK(says(memory.only_finding().remedy, "Min 1008, Max 1984"));
  CHECK(says(memory.only_finding().remedy, "min=\"4032\" max=\"7936\""));
  memory.put_channel(0, {62, 123}, 2);  // 1968 us
  CHECK(memory.only_finding().verdict == Verdict::kBad);
  memory.put_channel(0, {200, 10}, 2);  // the wrong way round
  CHECK(memory.only_finding().verdict == Verdict::kBad);
}

TEST_CASE("maestro settings: a thrust curve that ends sooner needs less room, on the right side",
          "[cli]") {
  ThrustShapeOptions shape;
  shape.curve[0] = {-1.0, -0.5};
  shape.curve_points = 1;
  shape.slew_per_s = 0.1;
  shape.zero_pause = std::chrono::seconds{1};
  const MaestroNeeds needs = maestro_needs(kAddress, shape);
  CHECK(needs.most_ahead == Approx(1.0));
  CHECK(needs.most_astern == Approx(0.5));
  Memory memory;
  memory.put_channel(0, {78, 125}, 2);  // 1248 to 2000 us, and 1261.875 are needed
  CHECK(memory.findings(needs).at(0).verdict == Verdict::kOk);
  const MaestroNeeds reversed = maestro_needs("maestro:/dev/ttyACM0?reverse=left", shape);
  REQUIRE(memory.findings(reversed).size() == 1);
  CHECK(says(memory.findings(reversed)[0].what, "needs 1023.75 to 1738.25 us"));
}

TEST_CASE("maestro settings: a limit of speed or acceleration is told of", "[cli]") {
  Memory memory;
  memory.put_channel(1, {8}, 7);
  CHECK(memory.only_finding().verdict == Verdict::kBad);
  CHECK(says(memory.only_finding().remedy, "channel 1: Speed 0, Acceleration 0"));
  memory.put_channel(1, {0, 1}, 7);
  CHECK(memory.only_finding().verdict == Verdict::kBad);
}

TEST_CASE("maestro settings: an address of another box or a wrong one asks for the usual",
          "[cli]") {
  for (const char* address : {"sim:", "roboclaw:/dev/ttyACM0?address=128", "none",
                              "maestro:/dev/ttyACM0?left=99", "maestro:/dev/ttyACM0?what=1"}) {
    INFO(address);
    const MaestroNeeds needs = maestro_needs(address, {});
    CHECK(needs.options.left_channel == 0);
    CHECK(needs.options.right_channel == 1);
    CHECK(needs.options.time_out == std::chrono::milliseconds{500});
    CHECK(needs.most_ahead == Approx(1.0));
    CHECK(needs.most_astern == Approx(1.0));
  }
}

TEST_CASE("maestro settings: whatever bytes a box gives, it is judged", "[cli]") {
  unsigned chance = 1;
  for (int i = 0; i < 2000; ++i) {
    const MaestroParameters any = [&chance](std::uint8_t, std::span<std::uint8_t> bytes) {
      for (std::uint8_t& byte : bytes) {
        chance = chance * 1103515245U + 12345U;
        byte = static_cast<std::uint8_t>(chance >> 16U);
      }
      return true;
    };
    const MaestroNeeds needs = maestro_needs(kAddress, {});
    const auto settings = read_maestro(any, needs.options);
    REQUIRE(settings);
    const auto findings = judge_maestro("box", *settings, needs);
    REQUIRE_FALSE(findings.empty());
    for (const Finding& one : findings) {
      REQUIRE((one.verdict == Verdict::kOk || !one.remedy.empty()));
      REQUIRE(one.to_json().at("what").is_string());
    }
  }
}

}  // namespace
}  // namespace lodesman::testing
