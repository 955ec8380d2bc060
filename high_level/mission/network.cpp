// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/network.h"

#include <arpa/inet.h>

#include <algorithm>
#include <array>
#include <span>

namespace lodesman {
namespace {

constexpr NetworkId kSomeOther = 1;  // for an address that would come out as this machine's
constexpr std::size_t kV4Prefix = 12;

// An IPv6 address; an IPv4 address as it is mapped into IPv6 (RFC 4291, 2.5.5.2).
using Address = std::array<std::uint8_t, 16>;

constexpr std::array<std::uint8_t, kV4Prefix> kMapped{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xff, 0xff};
constexpr Address kLoopbackV6{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1};

[[nodiscard]] std::optional<Address> address_of(const std::string& text) {
  Address address{};
  std::copy(kMapped.begin(), kMapped.end(), address.begin());
  if (inet_pton(AF_INET, text.c_str(), address.data() + kV4Prefix) == 1) {
    return address;
  }
  const std::string without_zone = text.substr(0, text.find('%'));
  return inet_pton(AF_INET6, without_zone.c_str(), address.data()) == 1 ? std::optional{address}
                                                                        : std::nullopt;
}

[[nodiscard]] bool is_v4(const Address& address) noexcept {
  return std::equal(kMapped.begin(), kMapped.end(), address.begin());
}

[[nodiscard]] bool is_loopback(const Address& address) noexcept {
  constexpr std::uint8_t kLoopbackV4 = 127;  // 127.0.0.0/8, RFC 1122
  return is_v4(address) ? address[kV4Prefix] == kLoopbackV4 : address == kLoopbackV6;
}

[[nodiscard]] bool is_link_local(const Address& address) noexcept {  // fe80::/10, RFC 4291
  return address[0] == 0xfe && (address[1] & 0xc0U) == 0x80;
}

[[nodiscard]] NetworkId number_of(std::span<const std::uint8_t> bytes) noexcept {
  NetworkId number = 0;
  for (const std::uint8_t byte : bytes) {
    number = number << 8U | byte;
  }
  return std::max(number, kSomeOther);
}

}  // namespace

std::optional<Reach> reach_of(const std::string& text) {
  const auto address = address_of(text);
  if (!address) {
    return std::nullopt;
  }
  return is_loopback(*address) ? Reach::kLoopback : Reach::kNetwork;
}

NetworkId network_of(const std::string& text) {
  constexpr std::size_t kHalf = 8;
  const Address address = address_of(text).value_or(Address{});
  if (is_loopback(address)) {
    return kOwnMachine;
  }
  const std::span<const std::uint8_t> bytes{address};
  if (is_v4(address)) {
    return number_of(bytes.subspan(kV4Prefix));
  }
  return number_of(bytes.subspan(is_link_local(address) ? kHalf : 0, kHalf));
}

}  // namespace lodesman
