// SPDX-License-Identifier: Apache-2.0
// An address of this machine that is not loopback, for what comes over a network.
#pragma once

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>

#include <array>
#include <iostream>
#include <optional>
#include <string>

namespace lodesman::testing {

// Of this family, AF_INET or AF_INET6; none that needs a zone. Where there is none it prints why
// the calling test is skipped, in the words by which ctest knows it.
[[nodiscard]] inline std::optional<std::string> own_address(int family) {
  ifaddrs* all = nullptr;
  std::optional<std::string> found;
  if (getifaddrs(&all) == 0) {
    for (const ifaddrs* each = all; each != nullptr && !found; each = each->ifa_next) {
      const bool usable = each->ifa_addr != nullptr && each->ifa_addr->sa_family == family &&
                          (each->ifa_flags & IFF_UP) != 0 && (each->ifa_flags & IFF_LOOPBACK) == 0;
      std::array<char, INET6_ADDRSTRLEN> text{};
      if (usable && family == AF_INET) {
        const auto* address = reinterpret_cast<const sockaddr_in*>(each->ifa_addr);
        inet_ntop(family, &address->sin_addr, text.data(), text.size());
        found = text.data();
      } else if (usable) {
        const auto* address = reinterpret_cast<const sockaddr_in6*>(each->ifa_addr);
        if (!IN6_IS_ADDR_LINKLOCAL(&address->sin6_addr)) {
          inet_ntop(family, &address->sin6_addr, text.data(), text.size());
          found = text.data();
        }
      }
    }
    freeifaddrs(all);
  }
  if (!found) {
    std::cout << "skipped: no address of this machine beyond loopback, family " << family << "\n";
  }
  return found;
}

}  // namespace lodesman::testing
