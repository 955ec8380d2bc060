// SPDX-License-Identifier: Apache-2.0
// Makes devices from addresses "scheme:rest" (sim:sonar, nav440:/dev/ttyUSB0). Schemes are
// registered by explicit calls in a main file, and devices are made before any task runs.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "mid_level/base/startup_error.h"

namespace lodesman {

template <class Contract>
class DeviceRegistry {
 public:
  // Is handed what follows the colon. Throws StartupError when it cannot be used.
  using Factory = std::function<std::unique_ptr<Contract>(std::string_view rest)>;

  explicit DeviceRegistry(std::string contract) : contract_{std::move(contract)} {}

  void add(const std::string& scheme, Factory factory) {
    factories_.insert_or_assign(scheme, std::move(factory));
  }

  [[nodiscard]] bool knows(const std::string& address) const {
    return factories_.contains(address.substr(0, address.find(':')));
  }

  // Throws StartupError, naming the schemes there are, when the address fits none. What it says is
  // the reason alone: the caller knows in which file the address stands.
  [[nodiscard]] std::unique_ptr<Contract> make(const std::string& address) const {
    const auto colon = address.find(':');
    const auto found = factories_.find(address.substr(0, colon));
    if (colon == std::string::npos || found == factories_.end()) {
      throw StartupError("\"" + address + "\" is no address of a " + contract_ +
                         "; known: " + known_schemes());
    }
    return found->second(std::string_view{address}.substr(colon + 1));
  }

 private:
  [[nodiscard]] std::string known_schemes() const {
    std::string list;
    for (const auto& [scheme, factory] : factories_) {
      list += (list.empty() ? "" : ", ") + scheme + ":...";
    }
    return list;
  }

  std::string contract_;
  std::map<std::string, Factory> factories_;
};

}  // namespace lodesman
