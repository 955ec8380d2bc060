// SPDX-License-Identifier: Apache-2.0
#include <turbojpeg.h>

#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "mid_level/recording/mcap_reader.h"
#include "mid_level/recording/mcap_viewer_sink.h"
#include "mid_level/recording/raw_codec.h"
#include "mid_level/recording/sonar_picture.h"
#include "mid_level/recording/viewer_channels.h"
#include "mid_level/recording/viewer_json.h"
#include "tests/support/catch.h"
#include "tests/unit/recording/memory_file.h"
#include "tests/unit/recording/support.h"

using namespace lodesman;
using namespace lodesman::testing;

namespace {

// A file with nothing in it but what viewers are shown.
class Shown {
 public:
  template <class M>
  void show(const char* channel, const M& message, Time stamp) {
    std::vector<std::byte> raw(used_bytes(message));
    encode_raw(message, raw);
    viewers_.take({channel_named(channel), static_cast<std::uint32_t>(raw.size()), stamp, 1}, raw);
  }
  // By topic.
  [[nodiscard]] std::map<std::string, std::vector<viewer::Json>> read() {
    writer_.finish();
    McapBytesSource source{disk_.bytes};
    McapReader reader{source};
    std::map<std::string, std::vector<viewer::Json>> messages;
    for (McapItem item = reader.next(); item != McapItem::kEnd; item = reader.next()) {
      if (item == McapItem::kMessage) {
        const auto data = reader.message().data;
        messages[reader.channel_by_id(reader.message().channel)->topic].push_back(
            viewer::Json::parse(
                std::string{reinterpret_cast<const char*>(data.data()), data.size()}));
      }
    }
    return messages;
  }

 private:
  Disk disk_;
  MemoryFile file_{disk_};
  McapWriter writer_{file_, "test"};
  McapViewerSink sink_{writer_};
  ViewerChannels viewers_{sink_};
};

}  // namespace

TEST_CASE("viewers: a heading to the east turns ahead to the world's x", "[recording]") {
  const auto turn = viewer::rotation(0.5 * std::numbers::pi);
  const double z = turn["z"];
  const double w = turn["w"];
  // Ahead is y in the vehicle: (0, 1) turned by the quaternion (0, 0, z, w).
  CHECK(-2.0 * z * w == Approx(1.0));
  CHECK(w * w - z * z == Approx(0.0).margin(1e-12));
}

// The vectors of RFC 4648, section 10.
TEST_CASE("viewers: base64 is that of RFC 4648", "[recording]") {
  const auto of = [](const std::string& text) {
    return viewer::base64({text.begin(), text.end()});
  };
  CHECK(of("").empty());
  CHECK(of("f") == "Zg==");
  CHECK(of("fo") == "Zm8=");
  CHECK(of("foo") == "Zm9v");
  CHECK(of("foobar") == "Zm9vYmFy");
}

TEST_CASE("viewers: an ellipse lies as its angle says, body and zone alike", "[recording]") {
  Obstacle ellipse;
  ellipse.centre_x_m = 3.0;
  ellipse.centre_y_m = 4.0;
  ellipse.semi_axis_first_m = 2.0;
  ellipse.semi_axis_second_m = 1.0;
  ellipse.protection_first_m = 3.0;
  ellipse.protection_second_m = 2.0;
  ellipse.angle_rad = 0.5 * std::numbers::pi;  // its first semi-axis points to the east
  auto entity = viewer::entity("world", "obstacles", at(0));
  viewer::add_body(entity, ellipse, {});
  viewer::add_zone(entity, ellipse, {});
  CHECK(entity["cylinders"][0]["size"]["y"] == Approx(4.0));  // before it is turned
  double east_m = 0.0;
  double north_m = 0.0;
  for (const auto& point : entity["lines"][0]["points"]) {
    east_m = std::max(east_m, point["x"].get<double>());
    north_m = std::max(north_m, point["y"].get<double>());
  }
  CHECK(east_m == Approx(3.0 + 3.0));
  CHECK(north_m == Approx(4.0 + 2.0));
}

TEST_CASE("viewers: the log has each change once, and the transforms keep their pace",
          "[recording]") {
  Shown shown;
  VehicleState state;
  state.x_m = 5.0;
  state.odometry_x_m = 4.0;
  for (int ms = 0; ms < 1000; ms += 10) {
    shown.show("vehicle_state", state, at(1000 + ms));
  }
  MissionStatus mission;
  shown.show("mission_status", mission, at(2000));
  mission.state = MissionState::kUnderWay;
  shown.show("mission_status", mission, at(2050));
  shown.show("mission_status", mission, at(2100));
  DeviceHealth health;
  health.status = DeviceStatus::kSilent;
  health.fault = DeviceFault::kNoAnswer;
  shown.show("sonar_device", health, at(2200));
  auto messages = shown.read();
  CHECK(messages["/tf"].size() == 20);
  CHECK(messages["/tf"][0]["transforms"][1]["translation"]["x"] == Approx(1.0));
  REQUIRE(messages["/log"].size() == 3);
  CHECK(messages["/log"][1]["message"] == "mission_status: under_way");
  CHECK(messages["/log"][1]["timestamp"]["sec"] == 2);
  CHECK(messages["/log"][1]["timestamp"]["nsec"] == 50'000'000);
  CHECK(messages["/log"][2]["name"] == "sonar_device");
  CHECK(messages["/log"][2]["level"] == 3);
}

TEST_CASE("viewers: an echo ahead is bright where it was, and nowhere else", "[recording]") {
  const auto ping = std::make_unique<SonarPing>();
  ping->range_m = 30.0;
  ping->make_image(121, 500, 2.0 * std::numbers::pi / 3.0);
  for (std::uint32_t beam = 55; beam <= 65; ++beam) {
    for (std::uint32_t bin = 240; bin <= 260; ++bin) {
      ping->echo[beam * ping->bins + bin] = 255;
    }
  }
  SonarPicture picture;
  const auto jpeg = picture.jpeg_of(*ping);
  REQUIRE(jpeg.size() > 100);
  std::vector<unsigned char> grey(std::size_t{SonarPicture::kColumns} * SonarPicture::kRows);
  tjhandle decoder = tjInitDecompress();
  REQUIRE(tjDecompress2(decoder, jpeg.data(), jpeg.size(), grey.data(), SonarPicture::kColumns, 0,
                        SonarPicture::kRows, TJPF_GRAY, 0) == 0);
  tjDestroy(decoder);
  const auto pixel = [&](int column, int row) {
    return grey[static_cast<std::size_t>(row * SonarPicture::kColumns + column)];
  };
  CHECK(pixel(SonarPicture::kColumns / 2, SonarPicture::kRows / 2) > 200);
  CHECK(pixel(SonarPicture::kColumns / 2, SonarPicture::kRows / 4) < 60);
  CHECK(pixel(SonarPicture::kColumns / 2 + 60, SonarPicture::kRows / 2) < 60);
  CHECK(pixel(SonarPicture::kColumns / 2 - 60, SonarPicture::kRows / 2) < 60);
}
