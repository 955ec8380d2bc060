// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/console/topics.h"

#include "tests/support/catch.h"

using namespace lodesman;
using namespace lodesman::console;

namespace {

[[nodiscard]] MessagePtr message(const std::string& text) {
  return std::make_shared<const Message>(Message{{}, text});
}

}  // namespace

TEST_CASE("newest parts: a part's newer message takes the place of its older", "[console]") {
  NewestParts parts;
  parts.put("a", message("1"));
  parts.put("b", message("2"));
  parts.put("a", message("3"));
  CHECK(parts.take()->json == "2");
  CHECK(parts.take()->json == "3");
  CHECK(parts.take() == nullptr);
}

TEST_CASE("newest parts: their number is bounded, and the oldest give way", "[console]") {
  NewestParts parts;
  for (int i = 0; i < 1000; ++i) {
    parts.put(std::to_string(i), message(std::to_string(i)));
  }
  std::size_t count = 0;
  parts.for_each([&](const std::string&, const MessagePtr&) { ++count; });
  CHECK(count == NewestParts::kMaxParts);
  CHECK(parts.take()->json == std::to_string(1000 - NewestParts::kMaxParts));
}
