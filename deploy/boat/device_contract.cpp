// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/device_contract.h"

#include <algorithm>
#include <array>

#include "drivers/stream/make_line.h"

namespace lodesman {
namespace {

constexpr std::array<std::string_view, 4> kLoopSettings{"wire", "batch_s", "flicker", "esc"};

}  // namespace

std::string scheme_of(const std::string& address) { return address.substr(0, address.find(':')); }

std::string rest_of(const std::string& address) {
  return address.substr(std::min(address.find(':'), address.size() - 1) + 1);
}

bool is_sim(const Workshop& shop, const std::string& address) {
  return scheme_of(address) == "sim" && shop.scenario != nullptr;
}

DeviceAddress looped_address(const std::string& address, const std::vector<std::string_view>& known,
                             std::vector<std::string_view> (*settings)(std::string_view driver)) {
  const std::string rest = rest_of(address);
  const std::string driver = rest.substr(0, rest.find('?'));
  if (std::find(known.begin(), known.end(), driver) == known.end()) {
    throw StartupError("nothing stands in for \"" + driver + "\" here");
  }
  std::vector<std::string_view> all = settings(driver);
  all.insert(all.end(), kLoopSettings.begin(), kLoopSettings.end());
  return {rest, all};
}

WireSettings wire_of(const DeviceAddress& address) {
  WireSettings wire;
  wire.instant = address.word("wire", "slow", {"slow", "instant"}) == "instant";
  wire.batch = from_seconds(address.number("batch_s", 0.0, 0.0, 0.1));
  return wire;
}

ByteStream& real_line(const Workshop& shop, const std::string& path, int baud, Bell<>* bell) {
  std::function<void()> on_bytes;
  if (bell != nullptr) {
    on_bytes = [bell] { ring(*bell); };
  }
  shop.lines.push_back(make_line(path, baud, std::move(on_bytes)));
  return *shop.lines.back();
}

}  // namespace lodesman
