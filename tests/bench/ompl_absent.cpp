// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/ompl_rrt_connect.h"

namespace lodesman::bench {

std::unique_ptr<OmplRrtConnect> OmplRrtConnect::make(const PassableGrid& /*grid*/) {
  return nullptr;
}

}  // namespace lodesman::bench
