// SPDX-License-Identifier: Apache-2.0
// A satellite receiver aboard a vessel: when it speaks, how far off it is, and its faults.
#include "hal_sim/emulators/nmea_receiver.h"

#include <cmath>
#include <map>
#include <memory>
#include <sstream>

#include "hal_sim/devices/sim_position_sensor.h"
#include "hal_sim/emulators/emulated_position.h"
#include "tests/support/catch.h"
#include "tests/unit/devices/support.h"
#include "tests/unit/emulators/support.h"

namespace lodesman {
namespace {

using namespace lodesman::testing;

using Fields = std::vector<std::string>;

// A sentence that is whole; empty where it is not.
[[nodiscard]] Fields fields_of(const Bytes& bytes) {
  const std::string text{bytes.begin(), bytes.end()};
  const auto star = text.rfind('*');
  if (text.empty() || text[0] != '$' || star == std::string::npos || star + 5 != text.size()) {
    return {};
  }
  unsigned sum = 0;
  for (const char c : text.substr(1, star - 1)) {
    sum ^= static_cast<unsigned char>(c);
  }
  if (std::stoul(text.substr(star + 1, 2), nullptr, 16) != sum) {
    return {};
  }
  Fields fields;
  std::stringstream rest{text.substr(1, star - 1) + ",end"};
  for (std::string field; std::getline(rest, field, ',');) {
    fields.push_back(field);
  }
  return fields;
}

// ddmm.mmmmm and its letter.
[[nodiscard]] double degrees(const std::string& angle, const std::string& letter) {
  const double all = std::stod(angle);
  const double whole = std::floor(all / 100.0);
  const double deg = whole + (all - whole * 100.0) / 60.0;
  return letter == "S" || letter == "W" ? -deg : deg;
}

constexpr GeoPoint kOrigin{35.0, 139.0};

struct Antenna {
  EmulatedNmeaReceiver receiver;
  LocalFrame frame{kOrigin};

  explicit Antenna(double sigma_m = 0.0, std::uint64_t seed = 1)
      : receiver{options(sigma_m, seed), at_ms(0)} {
    AntennaMotion motion;
    motion.x_m = 30.0;
    motion.y_m = 40.0;
    receiver.set_motion(motion);
  }
  [[nodiscard]] static NmeaReceiverOptions options(double sigma_m, std::uint64_t seed) {
    NmeaReceiverOptions options;
    options.origin = kOrigin;
    options.sigma_m = sigma_m;
    options.seed = seed;
    return options;
  }
  // All that is said of one type until then; `lost`: sentences that are not whole.
  [[nodiscard]] std::vector<Fields> said(const std::string& type, std::int64_t until_ms) {
    std::vector<Fields> all;
    lost = 0;
    for (const Utterance& utterance : said_until(receiver, at_ms(until_ms))) {
      const Fields fields = fields_of(utterance.bytes);
      lost += fields.empty() ? 1 : 0;
      if (!fields.empty() && fields[0] == type) {
        all.push_back(fields);
      }
    }
    return all;
  }
  [[nodiscard]] std::vector<WorldPoint> places(std::int64_t until_ms) {
    std::vector<WorldPoint> all;
    for (const Fields& gga : said("GPGGA", until_ms)) {
      all.push_back(frame.to_world({degrees(gga[2], gga[3]), degrees(gga[4], gga[5])}));
    }
    return all;
  }
  [[nodiscard]] double off_m(const WorldPoint& place) const {
    return (place.xy_m - Eigen::Vector2d{30.0, 40.0}).norm();
  }

  int lost = 0;
};

TEST_CASE("nmea receiver: three sentences an epoch of UTC, a moment after it",
          "[hal_sim][emulators]") {
  Antenna received;
  const auto said = said_until(received.receiver, at_ms(1010));
  REQUIRE(said.size() == 6 * 3);
  CHECK(said[0].begins == at_ms(40));
  CHECK(said[3].begins == at_ms(240));
  CHECK(fields_of(said[0].bytes)[1] == "123500.00");
  CHECK(fields_of(said[15].bytes)[1] == "123501.00");
  const Fields rmc = fields_of(said[16].bytes);
  CHECK(rmc[0] == "GPRMC");
  CHECK(rmc[2] == "A");
  CHECK(rmc[8].empty());  // at rest
  CHECK(rmc[9] == "211126");
  CHECK(fields_of(said[17].bytes)[0] == "GPVTG");
}

TEST_CASE("nmea receiver: it goes on from where it was last told to be", "[hal_sim][emulators]") {
  Antenna received;
  AntennaMotion motion;
  motion.y_m = 10.0;
  motion.east_m_s = 3.0;
  motion.north_m_s = 4.0;
  motion.measured = at_ms(110);
  received.receiver.set_motion(motion);
  const auto ggas = received.said("GPGGA", 200);
  REQUIRE(ggas.size() == 2);
  const WorldPoint at =
      received.frame.to_world({degrees(ggas[1][2], ggas[1][3]), degrees(ggas[1][4], ggas[1][5])});
  CHECK(at.xy_m.x() == Approx(0.27).margin(0.011));
  CHECK(at.xy_m.y() == Approx(10.36).margin(0.011));
  const auto rmcs = received.said("GPRMC", 400);
  REQUIRE(rmcs.size() == 1);
  CHECK(rmcs[0][7] == "9.719");
  CHECK(rmcs[0][8] == "036.9");
}

TEST_CASE("nmea receiver: its error is as large as it is made to be, and by the seed",
          "[hal_sim][emulators]") {
  Antenna received{2.0};
  double sum2 = 0.0;
  const auto places = received.places(400'000);
  for (const WorldPoint& place : places) {
    sum2 += received.off_m(place) * received.off_m(place);
  }
  CHECK(std::sqrt(sum2 / 2.0 / static_cast<double>(places.size())) == Approx(2.0).epsilon(0.05));
  Antenna same{2.0};
  Antenna other{2.0, 2};
  CHECK(same.said("GPGGA", 5000) == Antenna{2.0}.said("GPGGA", 5000));
  CHECK(other.said("GPGGA", 5000) != Antenna{2.0}.said("GPGGA", 5000));
}

TEST_CASE("nmea receiver: its fixes are those of a simulated receiver, to the last digit",
          "[hal_sim][emulators]") {
  HandWorld world;
  Scenario scenario;
  scenario.seed = 5;
  SimPositionSensor simulated{scenario, world.link()};
  EmulatedPosition emulated{
      emulated_position_options(scenario), {}, world.now() + std::chrono::milliseconds{1}};
  Reader<WorldSample> samples{world.link().world};
  int compared = 0;
  for (int step = 0; step < 200; ++step) {
    world.state.x_m += 0.01;
    world.step(std::chrono::milliseconds{step == 0 ? 200 : 20});  // first at an epoch of UTC
    emulated.feel(samples.latest()->value, 0.0, world.now());
    const auto fix = simulated.poll(world.now());
    const auto said = said_until(emulated.device(), world.now());
    if (fix.status != ReadStatus::kFresh || said.empty()) {
      continue;
    }
    const Fields gga = fields_of(said[0].bytes);
    CHECK(degrees(gga[2], gga[3]) == Approx(fix.sample.latitude_deg).margin(1e-9));
    CHECK(degrees(gga[4], gga[5]) == Approx(fix.sample.longitude_deg).margin(1e-9));
    ++compared;
  }
  CHECK(compared >= 15);
}

TEST_CASE("nmea faults: no fix, a frozen one, and one at 0, 0", "[hal_sim][emulators]") {
  Antenna received{1.0};
  received.receiver.begin_fault(gps_fault(FaultKind::kVoid), at_ms(0));
  const Fields gga = received.said("GPGGA", 0).at(0);
  CHECK(gga[6] == "0");
  CHECK(gga[2].empty());
  CHECK(received.said("GPRMC", 200).at(0)[2] == "V");
  received.receiver.end_fault(gps_fault(FaultKind::kVoid), at_ms(200));
  received.receiver.begin_fault(gps_fault(FaultKind::kFrozen), at_ms(200));
  const auto frozen = received.said("GPGGA", 3000);
  REQUIRE(frozen.size() == 14);
  for (const Fields& fix : frozen) {
    CHECK(fix[2] == frozen[0][2]);
    CHECK(fix[4] == frozen[0][4]);
  }
  CHECK(frozen[13][1] != frozen[0][1]);  // the time goes on
  received.receiver.end_fault(gps_fault(FaultKind::kFrozen), at_ms(3000));
  CHECK(received.said("GPGGA", 3200).at(0)[2] != frozen[0][2]);
  received.receiver.begin_fault(gps_fault(FaultKind::kInvalid), at_ms(3200));
  const Fields zero = received.said("GPGGA", 3400).at(0);
  CHECK(zero[2] == "0000.00000");
  CHECK(zero[4] == "00000.00000");
  CHECK(zero[6] == "1");
}

TEST_CASE("nmea faults: a step, a drift and glitches", "[hal_sim][emulators]") {
  Antenna received;
  received.receiver.begin_fault(gps_fault(FaultKind::kStep, 0.0, -5.0), at_ms(0));
  const WorldPoint stepped = received.places(0).at(0);
  CHECK(stepped.xy_m.x() == Approx(25.0).margin(0.02));
  CHECK(stepped.xy_m.y() == Approx(40.0).margin(0.02));
  received.receiver.end_fault(gps_fault(FaultKind::kStep), at_ms(0));
  received.receiver.begin_fault(gps_fault(FaultKind::kDrift, 0.0, 0.5), at_ms(0));
  CHECK(received.places(10'000).back().xy_m.x() == Approx(35.0).margin(0.02));
  received.receiver.end_fault(gps_fault(FaultKind::kDrift), at_ms(10'000));
  received.receiver.begin_fault(gps_fault(FaultKind::kSpike, 0.1, 30.0), at_ms(10'000));
  std::uint64_t spikes = 0;
  for (const WorldPoint& place : received.places(210'000)) {
    const double off_m = received.off_m(place);
    CHECK((off_m < 0.1 || std::abs(off_m - 30.0) < 0.1));
    spikes += off_m > 1.0 ? 1U : 0U;
  }
  CHECK(spikes > 60);  // 100 of 1000
  CHECK(spikes < 150);
  CHECK(received.receiver.injections().of(FaultKind::kSpike).count == spikes);
}

TEST_CASE("nmea faults: sums that are wrong or missing, and a date 1024 weeks back",
          "[hal_sim][emulators]") {
  Antenna received;
  received.receiver.begin_fault(gps_fault(FaultKind::kBadChecksum, 0.3), at_ms(0));
  static_cast<void>(received.said("GPGGA", 20'000));
  CHECK(received.lost > 50);  // 90 of 303
  CHECK(static_cast<std::uint64_t>(received.lost) ==
        received.receiver.injections().of(FaultKind::kBadChecksum).count);
  received.receiver.end_fault(gps_fault(FaultKind::kBadChecksum), at_ms(20'000));
  received.receiver.begin_fault(gps_fault(FaultKind::kNoChecksum, 1.0), at_ms(20'000));
  const auto bare = said_until(received.receiver, at_ms(20'200));
  REQUIRE(bare.size() == 3);
  const std::string text{bare[0].bytes.begin(), bare[0].bytes.end()};
  CHECK(text.find('*') == std::string::npos);
  CHECK(text.ends_with("\r\n"));
  received.receiver.end_fault(gps_fault(FaultKind::kNoChecksum), at_ms(20'200));
  received.receiver.begin_fault(gps_fault(FaultKind::kWeek), at_ms(20'200));
  const Fields rmc = received.said("GPRMC", 20'400).at(0);
  CHECK(rmc[9] == "070407");
  CHECK(rmc[1] == "123520.40");  // the time of day is true
}

TEST_CASE("nmea faults: from an ordinary fix to RTK and back, with the error of each",
          "[hal_sim][emulators]") {
  Antenna received{3.0};
  received.receiver.begin_fault(gps_fault(FaultKind::kQuality, 1.0), at_ms(0));
  std::map<std::string, std::vector<double>> off_m;
  std::string before = "1";
  std::uint64_t changes = 0;
  for (const Fields& gga : received.said("GPGGA", 600'000)) {
    const WorldPoint place =
        received.frame.to_world({degrees(gga[2], gga[3]), degrees(gga[4], gga[5])});
    off_m[gga[6]].push_back(received.off_m(place));
    changes += gga[6] != before ? 1U : 0U;
    CHECK((gga[6] == "5" || before == "5" || gga[6] == before));  // through float alone
    before = gga[6];
  }
  CHECK(off_m.size() == 3);
  CHECK(changes > 300);
  CHECK(received.receiver.injections().of(FaultKind::kQuality).count == changes);
  const auto mean = [&](const char* quality) {
    double sum = 0.0;
    for (const double off : off_m[quality]) {
      sum += off;
    }
    return sum / static_cast<double>(off_m[quality].size());
  };
  CHECK(mean("4") < 0.05);
  CHECK(mean("5") < 0.5);
  CHECK(mean("1") > 3.0);
  received.receiver.end_fault(gps_fault(FaultKind::kQuality), at_ms(600'000));
  CHECK(received.said("GPGGA", 600'200).at(0)[6] == "1");
}

TEST_CASE("nmea faults: switched off it is silent, and on again it looks for its fix",
          "[hal_sim][emulators]") {
  Antenna received;
  received.receiver.begin_fault(gps_fault(FaultKind::kPower), at_ms(0));
  CHECK(said_until(received.receiver, at_ms(1000)).empty());
  received.receiver.end_fault(gps_fault(FaultKind::kPower), at_ms(1000));
  const auto ggas = received.said("GPGGA", 5000);
  REQUIRE(ggas.size() == 20);
  CHECK(ggas.front()[6] == "0");
  CHECK(ggas.back()[6] == "1");
}

TEST_CASE("emulated position: its sentences take their time on the line, and bytes are spoilt",
          "[hal_sim][emulators]") {
  Scenario scenario;
  const auto run = [&scenario](const std::vector<Fault>& faults) {
    EmulatedPosition emulated{emulated_position_options(scenario), faults, at_ms(0)};
    const auto line = std::make_unique<MemoryLine>();
    LineFeed feed{emulated.device(), emulated.wire(), *line};
    std::vector<std::pair<Time, Bytes>> sentences(1);
    for (std::int64_t ms = 0; ms < 10'000; ms += 20) {
      WorldSample sample;
      sample.stamp = at_ms(ms);
      sample.started = 1;
      sample.scenario_time_s = static_cast<double>(ms) * 1e-3;
      emulated.feel(sample, 0.0, at_ms(ms));
      feed.pump(at_ms(ms));
      std::array<std::uint8_t, 1> byte{};
      static_cast<void>(line->near_end().connection(at_ms(ms)));
      for (auto got = line->near_end().read(byte, at_ms(ms)); got.count > 0;
           got = line->near_end().read(byte, at_ms(ms))) {
        sentences.back().second.push_back(byte[0]);
        sentences.back().first = got.at;
        if (byte[0] == '\n') {
          sentences.emplace_back();
        }
      }
    }
    return sentences;
  };
  const auto clean = run({});
  REQUIRE(clean.size() > 145);
  const Duration byte_time = Duration{std::chrono::seconds{10}} / 38400;
  CHECK(clean[0].first ==
        at_ms(40) + byte_time * static_cast<std::int64_t>(clean[0].second.size()));
  CHECK_FALSE(fields_of(clean[0].second).empty());
  const auto spoilt = run({gps_fault(FaultKind::kFlip, 0.002)});
  const auto whole = [](const auto& sentences) {
    return std::count_if(sentences.begin(), sentences.end(),
                         [](const auto& sentence) { return !fields_of(sentence.second).empty(); });
  };
  CHECK(whole(spoilt) < whole(clean));
  CHECK(whole(spoilt) > 80);
}

}  // namespace
}  // namespace lodesman
