// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/sealed_lines.h"

#include <nlohmann/json.hpp>

#include "high_level/mission/handshake.h"
#include "tests/support/catch.h"

using namespace lodesman;

namespace {

SessionKeys some_keys() { return {message_code("a", "to boat"), message_code("a", "to client")}; }

struct Ends {
  SealedLines boat{some_keys(), SessionEnd::kBoat};
  SealedLines client{some_keys(), SessionEnd::kClient};
};

const std::string kAbortObject = R"({"command":"abort","protocol":2})";
const std::string kHoldObject = R"({"command":"hold","protocol":2})";

}  // namespace

// The keys are those of the handshake's vectors; by `printf '1\n{"command":...}' | openssl dgst
// -sha256 -mac HMAC -macopt hexkey:KEY`, and by Python's hmac and hashlib.
TEST_CASE("sealed lines: a line is sealed as another program seals it", "[high_level][mission]") {
  SessionKeys keys;
  keys.to_boat = *digest_of("42444ee3646945957edd455a23da5b7f67f3b669f528f41751fa07dc8d477aa2");
  keys.to_client = *digest_of("f62f550c9addef5c435367adb45b4d4acb5af093016186826623d2f9350ea16b");
  SealedLines client{keys, SessionEnd::kClient};
  SealedLines boat{keys, SessionEnd::kBoat};
  CHECK(
      client.seal(kAbortObject) ==
      R"({"sequence":1,"code":"542f573dff563ab5ce11409cd16b8cf359dcdf9dc54cc2e5267a5ec4c58803d1",)"
      R"("command":"abort","protocol":2})");
  CHECK(
      client.seal(R"({"command":"status","protocol":2})") ==
      R"({"sequence":2,"code":"3577e4429b70863c01800ee3c233673d3e2841b425ad09668a94e5926a52f2de",)"
      R"("command":"status","protocol":2})");
  CHECK(
      boat.seal(R"({"ok":true,"state":"aborted"})") ==
      R"({"sequence":1,"code":"0c7da4fd03da76306e0c20d9618bdd930841ed72d64f39c15a59b30562621f82",)"
      R"("ok":true,"state":"aborted"})");
}

TEST_CASE("sealed lines: each way lines arrive as they were sent, and are JSON",
          "[high_level][mission]") {
  Ends ends;
  for (int i = 1; i <= 120; ++i) {
    const std::string sealed = ends.client.seal(kAbortObject);
    CHECK(nlohmann::json::parse(sealed).at("sequence") == i);
    CHECK(nlohmann::json::parse(sealed).at("command") == "abort");
    CHECK(ends.boat.open(sealed) == kAbortObject);
    CHECK(ends.client.open(ends.boat.seal(R"({"ok":true})")) == R"({"ok":true})");
  }
}

TEST_CASE("sealed lines: what is repeated, left out or out of order is not opened",
          "[high_level][mission]") {
  Ends ends;
  const std::string first = ends.client.seal(kAbortObject);
  const std::string second = ends.client.seal(kHoldObject);
  const std::string third = ends.client.seal(kAbortObject);
  CHECK_FALSE(ends.boat.open(second));  // before the first
  REQUIRE(ends.boat.open(first) == kAbortObject);
  CHECK_FALSE(ends.boat.open(first));  // again
  CHECK_FALSE(ends.boat.open(third));  // without the second
  CHECK(ends.boat.open(second) == kHoldObject);
}

TEST_CASE("sealed lines: a line that is altered in any one bit is not opened",
          "[high_level][mission]") {
  Ends ends;
  const std::string sealed = ends.client.seal(kAbortObject);
  for (std::size_t bit = 0; bit < 8 * sealed.size(); ++bit) {
    std::string altered = sealed;
    altered[bit / 8] = static_cast<char>(altered[bit / 8] ^ (1 << (bit % 8)));
    CHECK_FALSE(ends.boat.open(altered));
  }
  for (std::size_t length = 0; length < sealed.size(); ++length) {
    CHECK_FALSE(ends.boat.open(sealed.substr(0, length)));
  }
  CHECK_FALSE(ends.boat.open(sealed + " "));
  CHECK(ends.boat.open(sealed) == kAbortObject);
}

TEST_CASE("sealed lines: one of another session, of the other way or in the clear is not opened",
          "[high_level][mission]") {
  Ends ends;
  SealedLines stranger{{message_code("b", "to boat"), message_code("b", "to client")},
                       SessionEnd::kClient};
  CHECK_FALSE(ends.boat.open(stranger.seal(kAbortObject)));
  CHECK_FALSE(ends.boat.open(Ends{}.boat.seal(kAbortObject)));
  CHECK_FALSE(ends.boat.open(kAbortObject));
  CHECK_FALSE(ends.boat.open(""));
  CHECK(ends.boat.open(ends.client.seal(kAbortObject)) == kAbortObject);
}
