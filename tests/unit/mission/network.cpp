// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/network.h"

#include "tests/support/catch.h"

using namespace lodesman;

TEST_CASE("network: what is loopback, and what is no address", "[high_level][mission]") {
  for (const char* address : {"127.0.0.1", "127.9.8.7", "::1", "::ffff:127.0.0.1"}) {
    CHECK(reach_of(address) == Reach::kLoopback);
    CHECK(network_of(address) == kOwnMachine);
  }
  for (const char* address : {"0.0.0.0", "::", "192.0.2.1", "fd00::2", "::ffff:192.0.2.1", "::2",
                              "fe80::1", "fe80::", "::ffff:0.0.0.0", "fe80::1%eth0"}) {
    CHECK(reach_of(address) == Reach::kNetwork);
    CHECK(network_of(address) != kOwnMachine);
  }
  for (const char* text : {"", "boat", "127.0.0", "127.0.0.1:7447", "192.0.2.1 ", "%", "::1::"}) {
    CHECK_FALSE(reach_of(text));
  }
}

TEST_CASE("network: a client's network is its IPv4 address, or the /64 that is its own",
          "[high_level][mission]") {
  CHECK(network_of("192.0.2.1") == network_of("::ffff:192.0.2.1"));
  CHECK(network_of("192.0.2.1") != network_of("192.0.2.2"));
  CHECK(network_of("2001:db8::1") == network_of("2001:db8::ffff:1"));
  CHECK(network_of("2001:db8::1") != network_of("2001:db8:0:1::1"));
  // Of a link all are in one /64.
  CHECK(network_of("fe80::1") != network_of("fe80::2"));
  CHECK(network_of("fe80::1%eth0") == network_of("fe80::1"));
}
