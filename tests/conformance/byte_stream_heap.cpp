// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "tests/conformance/line_bench.h"
#include "tests/support/allocations.h"

namespace lodesman::conformance {
namespace {

using ByteStreams = std::tuple<MemoryLineBench, PtyBench, SerialPortBench>;
using std::chrono::milliseconds;

TEMPLATE_LIST_TEST_CASE("byte stream: nothing is taken from the heap, whatever happens",
                        "[conformance]", ByteStreams) {
  TestType bench;
  REQUIRE(connect(bench) == 1);
  std::array<std::uint8_t, 64> bytes{};
  std::size_t moved = 0;
  std::uint64_t taken_from_heap = 0;
  const auto use = [&] {
    ByteStream& line = bench.line();
    const testing::AllocationScope scope;
    for (int i = 0; i < 200; ++i) {
      moved += line.read(bytes, bench.now()).count;
      moved += line.write(bytes, bench.now());
      moved += line.connection(bench.now());
      moved += line.fault() == DeviceFault::kNone ? 1U : 0U;
      bench.pass(milliseconds{10});
    }
    taken_from_heap += scope.count();
  };
  REQUIRE(bench.device_sends(Bytes(1000, 7)) == 1000);
  use();  // until it is full, and given up
  bench.line().reconnect(9600);
  use();
  bench.unplug();
  use();
  CHECK(moved > 1000);
  CHECK(taken_from_heap == 0);
}

}  // namespace
}  // namespace lodesman::conformance
