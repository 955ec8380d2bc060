// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/proof_limit.h"

#include "tests/support/catch.h"

using namespace lodesman;
using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {
constexpr Time kProofStart{seconds{1000}};
}

TEST_CASE("proof limit: who has failed often waits a moment, and others do not",
          "[high_level][mission]") {
  ProofLimit limit;
  for (int i = 0; i < kNetworkFailures; ++i) {
    CHECK(limit.pause(7, kProofStart) == Duration::zero());
    limit.failed(7, kProofStart);
  }
  CHECK(limit.pause(7, kProofStart) == kProofPause);
  CHECK(limit.pause(8, kProofStart) == Duration::zero());
  CHECK(limit.pause(7, kProofStart + kProofWindow) == kProofPause);
  CHECK(limit.pause(7, kProofStart + kProofWindow + milliseconds{1}) == Duration::zero());
}

TEST_CASE("proof limit: where many fail from many places all of a network wait, this machine never",
          "[high_level][mission]") {
  ProofLimit limit;
  for (NetworkId network = 1; network <= kAllFailures; ++network) {
    CHECK(limit.pause(1000, kProofStart) == Duration::zero());
    limit.failed(network, kProofStart);
  }
  CHECK(limit.pause(1000, kProofStart) == kProofPause);
  CHECK(limit.pause(kOwnMachine, kProofStart) == Duration::zero());
}

TEST_CASE("proof limit: this machine's failures make nobody wait", "[high_level][mission]") {
  ProofLimit limit;
  for (int i = 0; i < 1000; ++i) {
    limit.failed(kOwnMachine, kProofStart);
  }
  CHECK(limit.pause(kOwnMachine, kProofStart) == Duration::zero());
  CHECK(limit.pause(1, kProofStart) == Duration::zero());
}

TEST_CASE("proof limit: however many fail, nobody waits for longer", "[high_level][mission]") {
  ProofLimit limit;
  for (NetworkId network = 1; network <= 100000; ++network) {
    limit.failed(network, kProofStart);
  }
  CHECK(limit.pause(5, kProofStart) == kProofPause);
  CHECK(limit.pause(5, kProofStart + seconds{60}) == Duration::zero());
}
