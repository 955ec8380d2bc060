// SPDX-License-Identifier: Apache-2.0
#include "drivers/nav440/framing.h"

#include <fstream>
#include <iterator>

#include "mid_level/base/random_stream.h"
#include "tests/support/catch.h"
#include "tests/support/data_dir.h"
#include "tests/unit/nav440/support.h"

namespace lodesman::testing {
namespace {

constexpr std::size_t kWhole = 1000;

[[nodiscard]] ByteList recording(const std::filesystem::path& file) {
  std::ifstream stream{file, std::ios::binary};
  return {std::istreambuf_iterator<char>{stream}, {}};
}

TEST_CASE("nav440 framing: the CRC is the manual's, and has the check value of its name",
          "[nav440]") {
  const ByteList digits{'1', '2', '3', '4', '5', '6', '7', '8', '9'};
  CHECK(nav440_crc(digits) == 0xE5CC);
  CHECK(manual_crc(digits) == 0xE5CC);
  CHECK(nav440_crc({}) == 0x1D0F);
  CHECK(nav440_crc(ByteList{0x50, 0x4B, 0x00}) == 0x9EF4);
}

TEST_CASE("nav440 framing: every vector is one frame, wherever it is cut", "[nav440]") {
  for (const Vector& vector : kVectors) {
    INFO(vector.number);
    const ByteList bytes = bytes_of(vector.hex);
    const std::string_view type{reinterpret_cast<const char*>(bytes.data()) + 2, 2};
    CHECK(frame_of(type, kept_of(bytes).payload) == bytes);
    for (const std::size_t piece : {std::size_t{1}, std::size_t{2}, std::size_t{5}, kWhole}) {
      Nav440Framing framing;
      CHECK(fed(framing, bytes, piece) == std::vector{kept_of(bytes)});
      CHECK(framing.counts().frames == 1);
      CHECK(framing.counts().skipped_bytes == 0);
      CHECK(framing.counts().crc_failures == 0);
      CHECK(framing.counts().protocol_errors == 0);
      CHECK(framing.pending() == 0);
    }
  }
}

TEST_CASE("nav440 framing: all vectors one behind the other come out in order", "[nav440]") {
  ByteList stream;
  std::vector<Kept> all;
  for (const Vector& vector : kVectors) {
    append(stream, bytes_of(vector.hex));
    all.push_back(kept_of(bytes_of(vector.hex)));
  }
  for (std::size_t piece = 1; piece < 80; ++piece) {
    REQUIRE(frames_in(stream, piece) == all);
  }
}

TEST_CASE("nav440 framing: what is asked for at a time never reaches beyond a frame", "[nav440]") {
  ByteList stream;
  for (const Vector& vector : kVectors) {
    append(stream, bytes_of(vector.hex));
  }
  Nav440Framing framing;
  std::size_t ends = 0;
  for (std::size_t at = 0; at < stream.size();) {
    const std::size_t wanted = framing.wanted();
    REQUIRE(wanted > 0);
    REQUIRE(framing.push(std::span{stream}.subspan(at, wanted)) == wanted);
    at += wanted;
    if (framing.next()) {
      CHECK(framing.pending() == 0);
      ++ends;
    }
  }
  CHECK(ends == kVectors.size());
}

TEST_CASE("nav440 framing: a frame whose CRC fails is silence", "[nav440]") {
  ByteList wrong = vector_bytes("A-1");
  wrong.back() = 0xF5;
  Nav440Framing framing;
  CHECK(fed(framing, wrong, kWhole).empty());
  CHECK(framing.counts().crc_failures == 1);
  CHECK(framing.counts().skipped_bytes == wrong.size());
  ByteList swapped = vector_bytes("A-28");
  std::swap(swapped[swapped.size() - 1], swapped[swapped.size() - 2]);
  CHECK(frames_in(swapped).empty());
}

TEST_CASE("nav440 framing: a frame that is cut short costs none of those behind it", "[nav440]") {
  const ByteList whole = vector_bytes("A-22");
  ByteList stream = vector_bytes("A-21");
  stream.resize(20);
  append(stream, whole);
  for (const std::size_t piece : {std::size_t{1}, std::size_t{7}, kWhole}) {
    CHECK(frames_in(stream, piece) == std::vector{kept_of(whole)});
  }
}

TEST_CASE("nav440 framing: F1: from any byte of a frame on, the next whole one is the first",
          "[nav440]") {
  for (const char* number : {"A-21", "A-23", "A-28"}) {
    const ByteList first = vector_bytes(number);
    for (std::size_t cut = 0; cut < first.size(); ++cut) {
      INFO(number << " from " << cut);
      ByteList stream{first.begin() + static_cast<std::ptrdiff_t>(cut), first.end()};
      append(stream, vector_bytes("A-22"));
      append(stream, vector_bytes("A-24"));
      std::vector<Kept> expected{kept_of(vector_bytes("A-22")), kept_of(vector_bytes("A-24"))};
      if (cut == 0) {
        expected.insert(expected.begin(), kept_of(first));
      }
      CHECK(frames_in(stream) == expected);
    }
  }
}

TEST_CASE("nav440 framing: F2: one flipped byte costs one frame", "[nav440]") {
  const ByteList frame = vector_bytes("A-21");
  for (std::size_t at = 0; at < frame.size(); ++at) {
    INFO("byte " << at);
    ByteList stream = frame;
    stream[at] ^= 0x20U;
    for (int i = 0; i < 10; ++i) {
      append(stream, frame);
    }
    Nav440Framing framing;
    CHECK(fed(framing, stream, kWhole).size() == 10);
    CHECK(framing.counts().frames == 10);
    CHECK(framing.counts().skipped_bytes == frame.size());
    // Where preamble, type or length is hit, no check may ever be made of the frame itself.
    CHECK((at <= 4 || framing.counts().crc_failures == 1));
  }
}

TEST_CASE("nav440 framing: F3: more of the preamble in front of a frame loses nothing",
          "[nav440]") {
  for (const char* number : {"A-1", "A-21", "A-23", "A-34"}) {
    for (std::size_t more = 1; more < 6; ++more) {
      ByteList stream(more, 0x55);
      append(stream, vector_bytes(number));
      for (const std::size_t piece : {std::size_t{1}, kWhole}) {
        Nav440Framing framing;
        CHECK(fed(framing, stream, piece) == std::vector{kept_of(vector_bytes(number))});
        CHECK(framing.counts().skipped_bytes == more);
      }
    }
  }
}

TEST_CASE("nav440 framing: F7: bytes lost anywhere in a frame cost that frame alone", "[nav440]") {
  const ByteList frame = vector_bytes("A-21");
  const std::vector<Kept> behind(3, kept_of(frame));
  for (std::size_t lost = 1; lost < frame.size(); ++lost) {
    for (std::size_t at = 0; at + lost <= frame.size(); ++at) {
      ByteList stream = frame;
      stream.erase(stream.begin() + static_cast<std::ptrdiff_t>(at),
                   stream.begin() + static_cast<std::ptrdiff_t>(at + lost));
      for (int i = 0; i < 3; ++i) {
        append(stream, frame);
      }
      INFO(lost << " bytes from " << at);
      REQUIRE(frames_in(stream) == behind);
    }
  }
}

TEST_CASE("nav440 framing: a frame inside another's payload is none", "[nav440]") {
  CHECK(frames_in(vector_bytes("A-19")).size() == 1);
  CHECK(frames_in(vector_bytes("A-19"), 1) == std::vector{kept_of(vector_bytes("A-19"))});
}

TEST_CASE("nav440 framing: a length that a known type cannot have is counted and dropped",
          "[nav440]") {
  for (const auto& [type, size] : std::vector<std::pair<const char*, std::size_t>>{
           {"A1", 31}, {"A1", 33}, {"N1", 32}, {"PK", 1}, {"VR", 4}, {"SF", 2}, {"ID", 3}}) {
    INFO(type << " of " << size);
    ByteList stream = frame_of(type, ByteList(size, 0x07));
    append(stream, vector_bytes("A-22"));
    Nav440Framing framing;
    CHECK(fed(framing, stream, kWhole) == std::vector{kept_of(vector_bytes("A-22"))});
    CHECK(framing.counts().protocol_errors == 1);
    CHECK(framing.counts().skipped_bytes == size + 7);
  }
}

TEST_CASE("nav440 framing: a type that is not known is a frame like any other, and counted",
          "[nav440]") {
  for (const char* type : {"T1", "N3", "ZZ", "z1", "\x01\x02"}) {
    ByteList stream = frame_of(type, {1, 2, 3});
    append(stream, vector_bytes("A-1"));
    Nav440Framing framing;
    CHECK(fed(framing, stream, 1).size() == 2);
    CHECK(framing.counts().unknown_types == 1);
    CHECK(framing.counts().skipped_bytes == 0);
  }
}

TEST_CASE("nav440 framing: a long one of a type that is not known holds nothing up", "[nav440]") {
  ByteList stream = frame_of("\x01\x02", ByteList(250, 0x03));
  stream.resize(9);
  append(stream, vector_bytes("A-1"));
  CHECK(frames_in(stream) == std::vector{kept_of(vector_bytes("A-1"))});
}

TEST_CASE("nav440 framing: a new connection takes nothing over", "[nav440]") {
  const ByteList frame = vector_bytes("A-21");
  const auto half = static_cast<std::ptrdiff_t>(frame.size() / 2);
  Nav440Framing framing;
  CHECK(fed(framing, ByteList{frame.begin(), frame.begin() + half}, kWhole).empty());
  framing.restart();
  CHECK(framing.pending() == 0);
  CHECK(fed(framing, ByteList{frame.begin() + half, frame.end()}, kWhole).empty());
  CHECK(fed(framing, frame, kWhole).size() == 1);
}

TEST_CASE("nav440 framing: any bytes leave a whole frame behind them to be found", "[nav440]") {
  RandomStream chance{"nav440 framing", 1};
  ByteList tail(Nav440Framing::kLongestFrame, 0x00);
  append(tail, vector_bytes("A-21"));
  for (int i = 0; i < 2000; ++i) {
    ByteList stream(static_cast<std::size_t>(chance.uniform() * 400.0));
    for (std::uint8_t& byte : stream) {
      // Half of them what a frame is made of.
      const double draw = chance.uniform();
      byte = draw < 0.3   ? 0x55
             : draw < 0.5 ? 0x41
                          : static_cast<std::uint8_t>(chance.uniform() * 256.0);
    }
    append(stream, tail);
    Nav440Framing framing;
    const auto frames = fed(framing, stream, kWhole);
    REQUIRE(!frames.empty());
    REQUIRE(frames.back() == kept_of(vector_bytes("A-21")));
    REQUIRE(frames_in(stream, 1) == frames);
    std::uint64_t of_frames = 0;
    for (const Kept& frame : frames) {
      of_frames += frame.payload.size() + Nav440Framing::kOverhead;
    }
    REQUIRE(of_frames + framing.counts().skipped_bytes + framing.pending() == stream.size());
  }
}

TEST_CASE("nav440 framing: a recorded stream of a sister unit has its 1002 packets", "[nav440]") {
  const auto file = data_path("imu_0x5555/Scale1.raw");
  if (!file) {
    return;
  }
  const ByteList bytes = recording(*file);
  for (const std::size_t piece : {std::size_t{1}, std::size_t{62}, std::size_t{997}}) {
    Nav440Framing framing;
    const auto frames = fed(framing, bytes, piece);
    REQUIRE(frames.size() == 1002);
    CHECK(frames.front() == kept_of(vector_bytes("A-29")));
    CHECK(frames.back() == kept_of(vector_bytes("A-30")));
    CHECK(framing.counts().skipped_bytes == 0);
    CHECK(framing.counts().unknown_types == 0);
  }
}

TEST_CASE("nav440 framing: a recorded stream of another family is framed, and no type is known",
          "[nav440]") {
  const auto file = data_path("imu_0x5555/s1.raw");
  if (!file) {
    return;
  }
  const ByteList bytes = recording(*file);
  for (const std::size_t piece : {std::size_t{1}, std::size_t{62}, std::size_t{997}}) {
    Nav440Framing framing;
    CHECK(fed(framing, bytes, piece).size() == 1694);
    CHECK(framing.counts().unknown_types == 1694);
    CHECK(framing.counts().skipped_bytes == 47);
    CHECK(framing.pending() == 7);
  }
}

}  // namespace
}  // namespace lodesman::testing
