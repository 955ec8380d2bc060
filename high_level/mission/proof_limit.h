// SPDX-License-Identifier: Apache-2.0
// How fast tokens may be guessed over the network. A proof is never left unlooked at: who holds the
// token always gets in, however many others guess, from its own address too. Where many have failed
// each is looked at a moment later, so that a session costs its place for so long. Time is handed
// in; one thread; bounded memory.
#pragma once

#include <array>
#include <cstdint>

#include "high_level/mission/network.h"
#include "mid_level/base/time.h"

namespace lodesman {

// Failures within the last kProofWindow from which on proofs wait: those of one network, of all.
inline constexpr int kNetworkFailures = 5;
inline constexpr int kAllFailures = 50;
inline constexpr Duration kProofWindow = std::chrono::seconds{10};
// Long for a guesser: of its places (kMaxStrangers) each gives four guesses a second. Short for an
// operator, whose abort may take 5 s.
inline constexpr Duration kProofPause = std::chrono::milliseconds{250};

class ProofLimit {
 public:
  void failed(NetworkId network, Time now) noexcept;
  // Of a proof that has come from there. None for this machine, which is not counted either.
  [[nodiscard]] Duration pause(NetworkId network, Time now) const noexcept;

 private:
  // The last failures, the oldest overwritten.
  struct Failure {
    NetworkId network = kOwnMachine;  // none
    Time when{};
  };
  std::array<Failure, 256> failures_{};
  std::size_t next_ = 0;
};

}  // namespace lodesman
