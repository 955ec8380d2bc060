// SPDX-License-Identifier: Apache-2.0
#include "drivers/nmea/framing.h"

#include <string>
#include <vector>

#include "tests/support/allocations.h"
#include "tests/support/catch.h"
#include "tests/unit/nmea/support.h"

namespace lodesman::testing {
namespace {

using Sentences = std::vector<std::string>;

constexpr const char* kGood = "$GPHDT,056.20,T*04\r\n";

[[nodiscard]] Sentences framed(NmeaFraming& framing, std::string_view bytes) {
  Sentences sentences;
  for (const char byte : bytes) {
    if (const auto sentence = framing.push(static_cast<std::uint8_t>(byte))) {
      sentences.emplace_back(*sentence);
    }
  }
  return sentences;
}

[[nodiscard]] Sentences framed(std::string_view bytes) {
  NmeaFraming framing;
  return framed(framing, bytes);
}

const Sentences kOne{"$GPHDT,056.20,T"};

TEST_CASE("nmea framing: G13: a bad or a missing checksum is refused, small letters are taken",
          "[nmea]") {
  NmeaFraming framing;
  CHECK(framed(framing, "$GPHDT,056.20,T*05\r\n").empty());
  CHECK(framing.counts().wrong_checksums == 1);
  CHECK(framed(framing, "$GPHDT,056.20,T\r\n").empty());
  CHECK(framed(framing, "$GPHDT,056.20,T*0\r\n").empty());
  CHECK(framed(framing, "$GPHDT,056.20,T*0G\r\n").empty());
  CHECK(framed(framing, "$\r\n$*\r\n$*0\r\n").empty());
  CHECK(framing.counts().without_checksum == 6);
  CHECK(framing.counts().sentences == 0);
  const std::string capitals = "$GNRMC,001031.00,A,4404.13993,N,12118.86023,W,0.146,,100117,,,A*7B";
  CHECK(framed(framing, capitals + "\r\n").size() == 1);
  CHECK(framed(framing, capitals.substr(0, capitals.size() - 1) + "b\n").size() == 1);
  CHECK(framing.counts().sentences == 2);
}

TEST_CASE("nmea framing: lines may end by either byte, and other sentences may lie between",
          "[nmea]") {
  CHECK(framed("$GPHDT,056.20,T*04\n") == kOne);
  CHECK(framed("$GPHDT,056.20,T*04\r") == kOne);
  CHECK(framed("!AIVDM,1,1,,B,13Pchd0027whQN@LU67:2`9n0PS4,0*7D\r\n").size() == 1);
}

TEST_CASE("nmea framing: what is whole comes out of any garbage", "[nmea]") {
  const std::string bytes[] = {"\xFF\x01half of one*",
                               "$GPRMC,1235",
                               "$GPGG\x80",
                               "$$$",
                               "!",
                               "$GPHDT,056.20,T*0",
                               std::string(500, 'x'),
                               "$" + std::string(500, 'x')};
  for (const std::string& garbage : bytes) {
    INFO(garbage);
    CHECK(framed(garbage + kGood) == kOne);
    CHECK(framed(garbage + kGood + garbage + "\r\n" + kGood).size() == 2);
  }
}

TEST_CASE("nmea framing: from any byte of a stream on, the first whole sentence is the first",
          "[nmea]") {
  const std::string stream = std::string{kGood} + "$GPHDT,274.07,T*03\r\n" + kGood;
  for (std::size_t from = 0; from < stream.size(); ++from) {
    const Sentences got = framed(std::string_view{stream}.substr(from));
    const std::size_t whole = from == 0 ? 3U : from <= 20 ? 2U : from <= 40 ? 1U : 0U;
    INFO(from);
    CHECK(got.size() == whole);
  }
}

TEST_CASE("nmea framing: one damaged byte costs its own sentence at most", "[nmea]") {
  const std::string stream = std::string{kGood} + "$GPHDT,274.07,T*03\r\n" + kGood;
  const std::size_t first = 20;
  const std::size_t length = 18;
  for (std::size_t at = first; at < first + length; ++at) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string damaged = stream;
      damaged[at] = static_cast<char>(static_cast<unsigned char>(damaged[at]) ^ (1U << bit));
      const Sentences got = framed(damaged);
      INFO(at << " " << bit);
      CHECK(got.size() >= 2);
      CHECK(got.front() == kOne.front());
      CHECK(got.back() == kOne.front());
    }
  }
}

TEST_CASE("nmea framing: longer than the standard's 82 characters is taken, without end is not",
          "[nmea]") {
  const std::string rtk =
      "$GPGGA,094155.20,2234.33145313,N,11431.87220478,E,4,21,0.7,1.2097,M,-1.3523,M,02,0000*73";
  CHECK(rtk.size() > 82);
  CHECK(framed(rtk + "\r\n").size() == 1);
  NmeaFraming framing;
  const std::string endless = line_of("$GPTXT," + std::string(NmeaFraming::kLongest, 'x'));
  CHECK(framed(framing, endless).empty());
  CHECK(framing.counts().too_long == 1);
  const std::string longest = line_of("$GPTXT," + std::string(NmeaFraming::kLongest - 3 - 7, 'x'));
  CHECK(framed(framing, longest).size() == 1);
}

TEST_CASE("nmea framing: no byte is lost count of, and nothing is allocated", "[nmea]") {
  NmeaFraming framing;
  const std::string bytes = "abc$GPHDT,056.20,T*05\r\n\x02$GPHDT,056.20,T*04\r\n$GP";
  std::size_t of_sentences = 0;
  const AllocationScope scope;
  for (const char byte : bytes) {
    const auto sentence = framing.push(static_cast<std::uint8_t>(byte));
    of_sentences += sentence ? sentence->size() + 3 : 0;
  }
  CHECK(scope.count() == 0);
  const std::size_t of_line_ends = 4;
  CHECK(of_sentences + framing.counts().skipped_bytes + framing.pending() + of_line_ends ==
        bytes.size());
  framing.restart();
  CHECK(framing.pending() == 0);
}

}  // namespace
}  // namespace lodesman::testing
