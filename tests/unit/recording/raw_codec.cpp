// SPDX-License-Identifier: Apache-2.0
#include "mid_level/recording/raw_codec.h"

#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "mid_level/recording/board_tap.h"
#include "tests/support/catch.h"
#include "tests/unit/recording/random_message.h"

using namespace lodesman;
using namespace lodesman::testing;

namespace {

template <class M>
std::vector<std::byte> encoded(const M& message) {
  std::vector<std::byte> bytes(used_bytes(message), std::byte{0xee});
  encode_raw(message, bytes);
  return bytes;
}

// Calls test<M>() for the type of every channel.
template <class Test>
void for_each_type(Test test) {
  const auto board = std::make_unique<Blackboard>();
  for_each_channel(*board, [&]<class C>(const ChannelInfo& info, const C& /*channel*/) {
    INFO(info.name);
    test.template operator()<typename C::Value>();
  });
}

struct Inner {
  std::uint8_t kind = 0;
  double x_m = 0.0;
  static constexpr auto fields() noexcept {
    return field_list(field("kind", &Inner::kind), field("x_m", &Inner::x_m));
  }
};

struct Outer {
  bool flag = false;
  Time at{};
  std::uint32_t count = 0;
  std::array<Inner, 2> parts{};
  PathReason reason = PathReason::kFound;
  static constexpr auto fields() noexcept {
    using O = Outer;
    return field_list(field("flag", &O::flag), field("at", &O::at), field("count", &O::count),
                      field("parts", &O::parts, &O::count), field("reason", &O::reason));
  }
};

}  // namespace

TEST_CASE("raw codec: any sane message of any channel comes back as it was", "[recording]") {
  for_each_type([]<class M>() {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      const auto message = RandomMessages{seed}.make<M>(0xa5);
      REQUIRE(sane(*message));
      const auto bytes = encoded(*message);
      const auto back = std::make_unique<M>();
      REQUIRE(decode_raw(bytes, *back));
      CHECK(encoded(*back) == bytes);
      CHECK(used_bytes(*back) == bytes.size());
    }
  });
}

TEST_CASE("raw codec: nothing of what memory held before is in the bytes", "[recording]") {
  for_each_type([]<class M>() {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const auto once = RandomMessages{seed}.make<M>(0xa5);
      const auto again = RandomMessages{seed}.make<M>(0x3c);
      CHECK(encoded(*once) == encoded(*again));
    }
  });
}

TEST_CASE("raw codec: every field lies where the layout says", "[recording]") {
  const Outer outer{
      true, Time{Duration{0x0102030405060708}}, 1, {{{7, 2.5}, {}}}, PathReason::kLimit};
  const auto bytes = encoded(outer);
  const auto layout = nlohmann::json::parse(raw_layout<Outer>());
  CHECK(layout["kind"] == "message");
  CHECK(layout["size"] == sizeof(Outer));
  const auto& fields = layout["fields"];
  REQUIRE(fields.size() == 5);
  CHECK(bytes[fields[0]["offset"].get<std::size_t>()] == std::byte{1});
  CHECK(fields[1]["type"]["kind"] == "time");
  CHECK(bytes[fields[1]["offset"].get<std::size_t>()] == std::byte{8});
  CHECK(fields[3]["count_offset"] == fields[2]["offset"]);
  CHECK(fields[3]["count_size"] == 4);
  const auto& parts = fields[3]["type"];
  CHECK(parts["kind"] == "array");
  CHECK(parts["length"] == 2);
  CHECK(parts["of"]["fields"][1]["name"] == "x_m");
  CHECK(bytes[fields[3]["offset"].get<std::size_t>()] == std::byte{7});
  double x_m = 0.0;
  std::memcpy(&x_m,
              bytes.data() + fields[3]["offset"].get<std::size_t>() +
                  parts["of"]["fields"][1]["offset"].get<std::size_t>(),
              sizeof x_m);
  CHECK(x_m == Approx(2.5));
  CHECK(fields[4]["type"]["names"][5] == "limit");
  CHECK(bytes[fields[4]["offset"].get<std::size_t>()] == std::byte{5});
}

TEST_CASE("raw codec: what is not sane or has another size is refused", "[recording]") {
  VehicleState state;
  state.heading_rad = 1.0;
  auto bytes = encoded(state);
  VehicleState back;
  REQUIRE(decode_raw(bytes, back));
  CHECK(back.heading_rad == Approx(1.0));
  bytes.pop_back();
  CHECK_FALSE(decode_raw(bytes, back));
  bytes.resize(sizeof(VehicleState) + 1);
  CHECK_FALSE(decode_raw(bytes, back));
  state.heading_rad = 4.0;  // more than half a turn
  CHECK_FALSE(decode_raw(encoded(state), back));
  CHECK(back.heading_rad == Approx(1.0));

  Tracks tracks;
  tracks.count = 1;
  auto tail = encoded(tracks);
  tail[offsetof(Tracks, count)] = std::byte{2};  // claims more than there is
  Tracks tracks_back;
  CHECK_FALSE(decode_raw(tail, tracks_back));
}

TEST_CASE("raw codec: every channel says its layout, and two types never the same", "[recording]") {
  const auto channels = raw_channels();
  std::set<std::string> names;
  for (const RawChannel& channel : channels) {
    names.insert(channel.name);
    CHECK(nlohmann::json::accept(channel.layout));
  }
  CHECK(names.size() == channels.size());
  CHECK(raw_layout<Attitude>() != raw_layout<PositionFix>());
}
