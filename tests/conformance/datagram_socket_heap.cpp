// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "tests/conformance/datagram_bench.h"
#include "tests/support/allocations.h"

namespace lodesman::conformance {
namespace {

using DatagramSockets = std::tuple<MemoryDatagramsBench, UdpBench>;

TEMPLATE_LIST_TEST_CASE("datagrams: nothing is taken from the heap", "[conformance]",
                        DatagramSockets) {
  TestType bench;
  const Bytes bytes = datagram(60256);
  Bytes buffer(65536);
  std::size_t moved = 0;
  std::uint64_t taken_from_heap = 0;
  {
    const testing::AllocationScope scope;
    for (int i = 0; i < 100; ++i) {
      moved += bench.far_end().reply(bytes) ? 1U : 0U;
      moved += bench.near_end().receive(buffer).size;
      moved += bench.near_end().reply(bytes) ? 1U : 0U;
      moved += bench.near_end().fault() == DeviceFault::kNone ? 1U : 0U;
    }
    taken_from_heap = scope.count();
  }
  CHECK(moved > 60256);
  CHECK(taken_from_heap == 0);
}

}  // namespace
}  // namespace lodesman::conformance
