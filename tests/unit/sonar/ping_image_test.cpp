// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/ping_image.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "low_level/sonar/view_image.h"
#include "mid_level/base/startup_error.h"
#include "tests/support/catch.h"
#include "tests/unit/sonar/synthetic.h"

namespace lodesman {
namespace {

namespace fs = std::filesystem;

// A file that is gone with the test.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, const std::string& bytes)
      : path_{fs::temp_directory_path() /
              ("lodesman-test-" + std::to_string(getpid()) + "-" + name)} {
    std::ofstream{path_, std::ios::binary} << bytes;
  }
  ~TemporaryFile() { fs::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

}  // namespace

TEST_CASE("frame files: a polar image's columns are beams and its top row is nearest",
          "[low_level][sonar]") {
  const TemporaryFile file{"polar.pgm", std::string{"P5 3 2 255\n"} + "\x01\x02\x03\x04\x05\x06"};
  const GreyImage image = read_grey_image(file.path());
  REQUIRE(image.columns == 3);
  REQUIRE(image.rows == 2);
  const auto ping = std::make_unique<SonarPing>();
  polar_to_ping(image, file.path(), *ping);
  CHECK(ping->beams == 3);
  CHECK(ping->bins == 2);
  CHECK(ping->echo_count == 6);
  CHECK(ping->echo[0] == 1);
  CHECK(ping->echo[1] == 4);  // the same beam, one bin farther
  CHECK(ping->echo[2] == 2);
}

TEST_CASE("frame files: what is no whole 8-bit image is refused with one line",
          "[low_level][sonar]") {
  const std::string half_png{"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0", 18};
  const auto [name, bytes] = GENERATE_COPY(
      table<std::string, std::string>({{"empty.pgm", ""},
                                       {"text.png", "hello"},
                                       {"half.png", half_png},
                                       {"half.jpg", "\xFF\xD8\xFF\xE0 and so on"},
                                       {"half.pgm", "P5 120 500 255\nabc"},
                                       {"deep.pgm", std::string{"P5 1 1 65535\n"} + "ab"},
                                       {"header.pgm", "P5 x"}}));
  const TemporaryFile file{name, bytes};
  CHECK_THROWS_WITH(read_grey_image(file.path()),
                    Catch::Matchers::StartsWith(file.path().string() + ":1: image: "));
  CHECK_THROWS_AS(read_grey_image(file.path().string() + ".absent"), StartupError);
  CHECK_THROWS_AS(read_grey_image(fs::temp_directory_path()), StartupError);
}

TEST_CASE("frame files: no other format is tried", "[low_level][sonar]") {
  for (const std::string bytes : {"\x89PNG\r\n\x1b\n IEND", "\xFF\xD8 \xFF\xD9", "BM", "II*"}) {
    const TemporaryFile file{"other", bytes};
    CHECK_THROWS_WITH(read_grey_image(file.path()),
                      file.path().string() + ":1: image: not a binary PGM, PNG or JPEG image");
  }
}

// `file` with one more part after its first `place` bytes.
std::string with_part(const std::vector<std::uint8_t>& file, std::size_t place,
                      const std::string& part) {
  std::string bytes{file.begin(), file.end()};
  return bytes.insert(place, part);
}

std::string big_endian(std::size_t number, int size) {
  std::string bytes;
  for (int shift = 8 * (size - 1); shift >= 0; shift -= 8) {
    bytes.push_back(static_cast<char>(number >> static_cast<unsigned>(shift) & 0xFFU));
  }
  return bytes;
}

TEST_CASE("frame files: an image cut off is refused though a preview in it ends",
          "[low_level][sonar]") {
  const auto jpeg = encode_view({30.0}, ViewFormat::kJpeg);
  const auto png = encode_view({30.0}, ViewFormat::kPng);
  REQUIRE(jpeg.size() < 60000);
  // The preview is the same picture again, in a segment as cameras write it.
  const std::string preview{jpeg.begin(), jpeg.end()};
  const std::string segment = "\xFF\xED" + big_endian(preview.size() + 2, 2) + preview;
  // A PNG's chunk of text that holds the name of its last; readers skip its check (a private one).
  const std::string chunk = big_endian(8, 4) + "prIvno IEND!" + std::string(4, '\0');
  constexpr std::size_t kAfterStart = 2;
  constexpr std::size_t kAfterHeader = 8 + 25;
  const auto [name, whole, least] = GENERATE_COPY(table<std::string, std::string, std::size_t>(
      {{"a.jpg", with_part(jpeg, kAfterStart, segment), kAfterStart + segment.size()},
       {"a.png", with_part(png, kAfterHeader, chunk), kAfterHeader + chunk.size()}}));
  CAPTURE(name);
  {
    const TemporaryFile file{name, whole};
    CHECK(read_grey_image(file.path()).columns == 866);
  }
  for (const double share : {0.0, 0.3, 0.6, 0.99}) {
    const auto left = static_cast<double>(whole.size() - least);
    const TemporaryFile file{name, whole.substr(0, least + static_cast<std::size_t>(share * left))};
    CHECK_THROWS_WITH(read_grey_image(file.path()),
                      file.path().string() + ":1: image: the image is truncated");
  }
}

TEST_CASE("frame files: an image that says it is huge is refused before it is decoded",
          "[low_level][sonar]") {
  using namespace std::string_literals;
  const std::string png =
      "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x75\x30\0\0\x75\x30\x08\0\0\0\0 and IEND"s;
  const std::string jpeg =
      "\xFF\xD8\xFF\xE0\0\x04\xFF\xD8 \xFF\xFF\xC2\0\x0B\x08\x80\0\x80\0\x01 \xFF\xD9"s;
  for (const std::string& bytes : {png, jpeg}) {
    const TemporaryFile file{"huge", bytes};
    CHECK_THROWS_WITH(read_grey_image(file.path()),
                      file.path().string() + ":1: image: must have at most 64 million pixels");
  }
}

TEST_CASE("frame files: a polar image too large for a ping is refused", "[low_level][sonar]") {
  GreyImage image;
  image.columns = kMaxBeams + 1;
  image.rows = 1;
  image.pixels.resize(image.columns);
  const auto ping = std::make_unique<SonarPing>();
  CHECK_THROWS_AS(polar_to_ping(image, "wide.pgm", *ping), StartupError);
}

TEST_CASE("frame files: a spot to the right in a fan is to starboard, apex up or down",
          "[low_level][sonar]") {
  const bool bottom = GENERATE(true, false);
  GreyImage image{866, 500, std::vector<std::uint8_t>(866 * 500)};
  const int down = bottom ? -1 : 1;
  for (int dr = -10; dr <= 10; ++dr) {  // 15 m at 30 degrees to starboard of 30 m
    for (int dc = -10; dc <= 10; ++dc) {
      const int row = (bottom ? 499 : 0) + down * 217 + dr;
      image.pixels[static_cast<std::size_t>(row * 866 + 433 + 125 + dc)] = 200;
    }
  }
  const auto ping = std::make_unique<SonarPing>();
  ping->range_m = 30.0;
  ping->sector_rad = to_rad(120.0);
  fan_to_ping(image, whole_image_fan(image, bottom), *ping);
  CHECK(ping->beams == kMaxBeams);
  CHECK(ping->bins == 500);
  const auto seen = std::make_unique<SonarObstacles>();
  Segmenter{testing::shipped_options()}.segment(*ping, *seen);
  REQUIRE(seen->count == 1);
  CHECK(seen->obstacles[0].centre_x_m == Approx(7.5).margin(0.06));
  CHECK(seen->obstacles[0].centre_y_m == Approx(13.02).margin(0.06));
}

}  // namespace lodesman
