// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/proof_limit.h"

namespace lodesman {

void ProofLimit::failed(NetworkId network, Time now) noexcept {
  if (network != kOwnMachine) {
    failures_[next_] = {network, now};
    next_ = (next_ + 1) % failures_.size();
  }
}

Duration ProofLimit::pause(NetworkId network, Time now) const noexcept {
  if (network == kOwnMachine) {
    return Duration::zero();
  }
  int of_network = 0;
  int of_all = 0;
  for (const Failure& failure : failures_) {
    if (failure.network != kOwnMachine && now - failure.when <= kProofWindow) {
      ++of_all;
      of_network += failure.network == network ? 1 : 0;
    }
  }
  return of_network >= kNetworkFailures || of_all >= kAllFailures ? kProofPause : Duration::zero();
}

}  // namespace lodesman
