// SPDX-License-Identifier: Apache-2.0
#include "mid_level/recording/mcap_reader.h"

#include <zstd.h>

#include <random>
#include <set>
#include <string>

#include "mid_level/recording/mcap_recover.h"
#include "tests/support/catch.h"
#include "tests/unit/recording/memory_file.h"

using namespace lodesman;
using namespace lodesman::testing;

namespace {

// A small file of some chunks; where each of them ends, its indexes left out.
struct SmallFile {
  std::vector<std::byte> bytes;
  std::vector<std::size_t> chunk_ends;
  static constexpr std::size_t kChunks = 4;
  static constexpr std::size_t kMessagesEach = 3;
};

[[nodiscard]] SmallFile small_file() {
  Disk disk;
  MemoryFile file{disk};
  McapWriter writer{file, "test"};
  const auto schema = writer.add(McapSchema{0, "s", "e", "d"});
  const auto channel = writer.add(McapChannel{0, schema, "t", "m", {}});
  std::uint32_t sequence = 0;
  for (std::size_t i = 0; i < SmallFile::kChunks; ++i) {
    for (std::size_t j = 0; j < SmallFile::kMessagesEach; ++j) {
      ++sequence;
      const std::string data = "message " + std::to_string(sequence);
      writer.add(McapMessage{channel, sequence, sequence, sequence, bytes_of(data)});
    }
    writer.close_chunk();
  }
  writer.finish();
  SmallFile small;
  small.bytes = disk.bytes;
  for (std::size_t at = kMcapMagic.size(); at < small.bytes.size() - kMcapMagic.size();) {
    McapTaker head{std::span{small.bytes}.subspan(at)};
    const auto code = static_cast<McapOpcode>(head.number<std::uint8_t>());
    at += kMcapRecordHead_bytes + static_cast<std::size_t>(head.number<std::uint64_t>());
    if (code == McapOpcode::kChunk) {
      small.chunk_ends.push_back(at);
    }
  }
  return small;
}

struct Seen {
  std::vector<std::uint32_t> sequences;
  McapEnding ending = McapEnding::kOpen;
  std::uint64_t damaged = 0;
  std::uint64_t first_ns = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t last_ns = 0;
};

[[nodiscard]] Seen read_all(std::span<const std::byte> bytes) {
  McapBytesSource source{bytes};
  McapReader reader{source};
  Seen seen;
  for (McapItem item = reader.next(); item != McapItem::kEnd; item = reader.next()) {
    if (item == McapItem::kMessage) {
      const auto data = reader.message().data;
      const std::string text{reinterpret_cast<const char*>(data.data()), data.size()};
      // Never a value that was not written.
      REQUIRE(text == "message " + std::to_string(reader.message().sequence));
      seen.sequences.push_back(reader.message().sequence);
      seen.first_ns = std::min(seen.first_ns, reader.message().log_time_ns);
      seen.last_ns = std::max(seen.last_ns, reader.message().log_time_ns);
    }
  }
  seen.ending = reader.ending();
  seen.damaged = reader.damaged();
  return seen;
}

}  // namespace

TEST_CASE("mcap reader: cut off at any byte, every whole chunk comes back", "[recording]") {
  const SmallFile small = small_file();
  REQUIRE(small.chunk_ends.size() == SmallFile::kChunks);
  for (std::size_t size = 0; size < small.bytes.size(); ++size) {
    INFO("cut off after " << size << " of " << small.bytes.size());
    std::size_t whole = 0;
    for (const std::size_t end : small.chunk_ends) {
      whole += end <= size ? 1U : 0U;
    }
    const Seen seen = read_all(std::span{small.bytes}.first(size));
    CHECK(seen.sequences.size() == whole * SmallFile::kMessagesEach);
    CHECK(seen.ending == McapEnding::kCutOff);
    CHECK(seen.damaged == 0);
  }
  CHECK(read_all(small.bytes).ending == McapEnding::kWhole);
}

TEST_CASE("mcap recover: cut off at any byte, the file is closed with all that was whole",
          "[recording]") {
  const SmallFile small = small_file();
  for (std::size_t size = 8; size <= small.bytes.size(); ++size) {
    Disk disk;
    MemoryFile file{disk};
    McapWriter writer{file, "recover"};
    McapBytesSource source{std::span{small.bytes}.first(size)};
    const McapRecovery recovery = recover(source, writer);
    const Seen before = read_all(std::span{small.bytes}.first(size));
    const Seen after = read_all(disk.bytes);
    CHECK(after.ending == McapEnding::kWhole);
    CHECK(after.sequences == before.sequences);
    CHECK(recovery.messages == before.sequences.size());
    CHECK(recovery.first_ns == before.first_ns);
    CHECK(recovery.last_ns == before.last_ns);
    CHECK((recovery.ending == McapEnding::kWhole) == (size == small.bytes.size()));
    CHECK(recovery.reason.empty() == (size == small.bytes.size()));
  }
}

TEST_CASE("mcap recover: of a file that is closed and damaged in between the reason says so",
          "[recording]") {
  SmallFile small = small_file();
  small.bytes[small.chunk_ends.front() - 1] ^= std::byte{0xff};
  McapBytesSource source{small.bytes};
  const McapRecovery recovery = look_through(source);
  CHECK(recovery.ending == McapEnding::kWhole);
  CHECK(recovery.damaged > 0);
  CHECK(recovery.reason == "is closed, but damaged in between");
}

TEST_CASE("mcap reader: any byte that is changed gives no wrong message", "[recording]") {
  const SmallFile small = small_file();
  const Seen whole = read_all(small.bytes);
  std::size_t noticed = 0;
  for (std::size_t at = 0; at < small.bytes.size(); ++at) {
    for (const unsigned flip : {0x01U, 0x80U, 0xffU}) {
      auto bytes = small.bytes;
      bytes[at] ^= static_cast<std::byte>(flip);
      const Seen seen = read_all(bytes);  // which compares each message with what was written
      CHECK(seen.sequences.size() <= whole.sequences.size());
      noticed += seen.ending != McapEnding::kWhole || seen.damaged > 0 ? 1U : 0U;
    }
  }
  // Nothing of the file is without a check but the CRCs' own places, where 0 would mean none.
  CHECK(noticed == 3 * small.bytes.size());
}

TEST_CASE("mcap reader: random bytes and random changes end, without a crash", "[recording]") {
  const SmallFile small = small_file();
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    std::mt19937_64 random{seed};
    auto bytes = small.bytes;
    for (std::uint64_t i = random() % 8 + 1; i > 0; --i) {
      bytes[random() % bytes.size()] = static_cast<std::byte>(random());
    }
    bytes.resize(random() % 2 == 0 ? bytes.size() : random() % bytes.size());
    McapBytesSource source{bytes};
    const McapRecovery seen = look_through(source);
    CHECK(seen.ending != McapEnding::kOpen);
    CHECK(seen.messages <= SmallFile::kChunks * SmallFile::kMessagesEach);
  }
}

TEST_CASE("mcap reader: sizes that a file claims are not believed", "[recording]") {
  McapPutter bytes;
  bytes.magic();
  bytes.opcode(McapOpcode::kChunk);
  bytes.number(std::uint64_t{1} << 60);
  McapBytesSource long_record{bytes.bytes()};
  CHECK(look_through(long_record).ending == McapEnding::kDamaged);

  McapPutter chunk;
  chunk.magic();
  const auto place = chunk.begin_record(McapOpcode::kChunk);
  chunk.number(std::uint64_t{0});
  chunk.number(std::uint64_t{0});
  chunk.number(std::uint64_t{1} << 27);  // what it would unpack to
  chunk.number(std::uint32_t{0});
  chunk.text("zstd");
  chunk.number(std::uint64_t{4});
  chunk.number(std::uint32_t{0xfd2fb528});
  chunk.end_record(place);
  McapBytesSource large_chunk{chunk.bytes()};
  CHECK(look_through(large_chunk).damaged == 1);
}

// As encoders that stream write it.
TEST_CASE("mcap reader: a chunk whose frame does not say its size is read", "[recording]") {
  McapPutter records;
  put(records, McapSchema{1, "s", "e", std::string(1000, 'd')});
  ZSTD_CCtx* context = ZSTD_createCCtx();
  ZSTD_CCtx_setParameter(context, ZSTD_c_contentSizeFlag, 0);
  std::vector<std::byte> packed(ZSTD_compressBound(records.size()));
  packed.resize(ZSTD_compress2(context, packed.data(), packed.size(), records.bytes().data(),
                               records.size()));
  ZSTD_freeCCtx(context);
  REQUIRE(ZSTD_getFrameContentSize(packed.data(), packed.size()) == ZSTD_CONTENTSIZE_UNKNOWN);
  for (const std::uint64_t size :
       {std::uint64_t{records.size()}, std::uint64_t{records.size() - 1}, std::uint64_t{1} << 27}) {
    INFO(size << " bytes");
    McapPutter file;
    file.magic();
    const auto place = file.begin_record(McapOpcode::kChunk);
    file.number(std::uint64_t{0});
    file.number(std::uint64_t{0});
    file.number(size);
    file.number(crc32_of(records.bytes()));
    file.text("zstd");
    file.number(std::uint64_t{packed.size()});
    file.raw(packed);
    file.end_record(place);
    McapBytesSource source{file.bytes()};
    CHECK(look_through(source).chunks == (size == records.size() ? 1U : 0U));
  }
}

TEST_CASE("mcap reader: what is no MCAP file is said to be none", "[recording]") {
  const std::string words = "not a recording";
  McapBytesSource text{bytes_of(words)};
  const McapRecovery seen = look_through(text);
  CHECK(seen.ending == McapEnding::kDamaged);
  CHECK(seen.reason == "is no MCAP file");
}
