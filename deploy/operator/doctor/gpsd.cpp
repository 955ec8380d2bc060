// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/doctor/gpsd.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <thread>

#include "drivers/gpsd/options.h"
#include "drivers/stream/tcp_port.h"
#include "mid_level/base/startup_error.h"

namespace lodesman::cli {
namespace {

constexpr const char* kScheme = "gpsd:";
constexpr int kProtocol = 3;
constexpr std::size_t kMostBytes = 65536;

void ask(Port& port, GpsdFacts& facts) {
  constexpr std::string_view kQuestion = "?DEVICES;\n";
  const std::vector<std::uint8_t> bytes{kQuestion.begin(), kQuestion.end()};
  static_cast<void>(port.write(bytes));
  const auto until = std::chrono::steady_clock::now() + kGpsdPatience;
  std::string text;
  std::array<std::uint8_t, 4096> piece{};
  while (std::chrono::steady_clock::now() < until && text.size() < kMostBytes &&
         text.find("\"DEVICES\"") == std::string::npos && !port.is_gone()) {
    const std::size_t count = port.read(piece);
    text.append(piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(count));
    if (count == 0) {
      std::this_thread::sleep_for(std::chrono::milliseconds{10});
    }
  }
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    take_gpsd_line(text.substr(at, end - at), facts);
    at = end + 1;
  }
}

}  // namespace

std::optional<GpsdFacts> measure_gpsd(const std::string& address) {
  if (!address.starts_with(kScheme)) {
    return std::nullopt;
  }
  GpsdFacts facts;
  try {
    const std::string rest = address.substr(std::string_view{kScheme}.size());
    const GpsdOptions options = gpsd_options({rest, gpsd_settings()});
    facts.place = options.place;
    facts.wanted = options.device;
  } catch (const StartupError&) {
    return std::nullopt;
  }
  if (const OpenedPort opened = TcpPort::open(facts.place); opened.port) {
    ask(*opened.port, facts);
  }
  return facts;
}

void take_gpsd_line(const std::string& line, GpsdFacts& facts) {
  const auto json = nlohmann::json::parse(line, nullptr, false);
  if (!json.is_object()) {
    return;
  }
  const auto text = [](const nlohmann::json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string{};
  };
  if (text(json, "class") == "VERSION") {
    facts.answers = true;
    facts.release = text(json, "release");
    const auto major = json.find("proto_major");
    facts.protocol_major =
        major != json.end() && major->is_number_integer() ? major->get<int>() : 0;
  } else if (text(json, "class") == "DEVICES" && json.contains("devices")) {
    for (const auto& device : json["devices"]) {
      if (device.is_object()) {
        facts.receivers.push_back(text(device, "path"));
      }
    }
  }
}

Finding judge_gpsd(const GpsdFacts& facts) {
  constexpr const char* kName = "position";
  if (!facts.answers) {
    return {kName, Verdict::kBad, fmt::format("no gpsd answers at {}", facts.place),
            "sudo apt-get install gpsd; sudo systemctl enable --now gpsd.socket"};
  }
  const std::string who = fmt::format("gpsd {} at {}", facts.release, facts.place);
  if (facts.protocol_major != kProtocol) {
    return {
        kName, Verdict::kBad,
        fmt::format("{} speaks protocol {}, the driver {}", who, facts.protocol_major, kProtocol),
        "install the gpsd of Debian 12 or 13"};
  }
  if (facts.receivers.empty()) {
    return {kName, Verdict::kBad, who + " has no receiver",
            "name it in DEVICES of /etc/default/gpsd; sudo systemctl restart gpsd"};
  }
  const std::string list = fmt::format("{}", fmt::join(facts.receivers, ", "));
  if (!facts.wanted.empty() && std::find(facts.receivers.begin(), facts.receivers.end(),
                                         facts.wanted) == facts.receivers.end()) {
    return {kName, Verdict::kBad, fmt::format("{} has no {}, but {}", who, facts.wanted, list),
            "name one of these in devices.position"};
  }
  if (facts.wanted.empty() && facts.receivers.size() > 1) {
    return {kName, Verdict::kWarn, fmt::format("{} has several receivers: {}", who, list),
            "choose one: devices.position = \"gpsd:HOST?device=PATH\""};
  }
  return {kName, Verdict::kOk, fmt::format("{} has {}", who, list), ""};
}

}  // namespace lodesman::cli
