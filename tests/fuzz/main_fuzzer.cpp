// SPDX-License-Identifier: Apache-2.0
// libFuzzer's way in to the target that LODESMAN_FUZZ_TARGET names.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "tests/fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto target = std::ranges::find(lodesman::fuzz::targets(), LODESMAN_FUZZ_TARGET,
                                               &lodesman::fuzz::Target::name);
  if (target == lodesman::fuzz::targets().end()) {
    std::abort();
  }
  target->run({reinterpret_cast<const char*>(data), size});
  return 0;
}
