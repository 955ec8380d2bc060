// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstdint>
#include <cstring>

#include "mid_level/blackboard/segment.h"
#include "tests/fuzz/oracle.h"
#include "tests/fuzz/targets.h"

namespace lodesman::fuzz {
namespace {

// As segments are laid out; a good header that is refused would tell of a difference.
struct Segment {
  SegmentHeader header;
  Blackboard board;
};

// The fields of the header, and how many bytes are mapped. The input is laid over the right values
// by exclusive or, because no input could guess the hash of a build's layout.
enum Field : std::size_t { kMagic, kLayoutHash, kSizeBytes, kReady, kMapped, kFields };
using Changes = std::array<std::uint64_t, kFields>;

}  // namespace

void segment_header(std::string_view input) {
  static const std::uint64_t hash = layout_hash();
  Changes changes{};
  std::memcpy(changes.data(), input.data(), std::min(input.size(), sizeof changes));
  SegmentHeader header;
  header.magic = SegmentHeader::kMagic ^ changes[kMagic];
  header.layout_hash = hash ^ changes[kLayoutHash];
  header.size_bytes = sizeof(Segment) ^ changes[kSizeBytes];
  header.ready = SegmentHeader::kReady ^ changes[kReady];
  const std::string fault = header_fault(header, sizeof(Segment) ^ changes[kMapped]);
  require(fault.empty() == (changes == Changes{}), "a header is judged wrongly: " + fault);
}

}  // namespace lodesman::fuzz
