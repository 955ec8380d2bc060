// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/doctor/maestro_boxes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>

#include "deploy/operator/doctor/port_diagnosis.h"
#include "deploy/operator/doctor/system_files.h"

namespace lodesman::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kVendor = "1ffb";
constexpr std::string_view kCommandInterface = "00";

struct Product {
  std::string_view id;
  std::string_view name;
  unsigned channels;
};
constexpr std::array<Product, 4> kProducts{{{"0089", "Micro Maestro 6", 6},
                                            {"008a", "Mini Maestro 12", 12},
                                            {"008b", "Mini Maestro 18", 18},
                                            {"008c", "Mini Maestro 24", 24}}};

// Of a USB device's folder; nullptr: it is no Maestro.
[[nodiscard]] const Product* product_of(const fs::path& device) {
  if (first_line_of(device / "idVendor") != kVendor) {
    return nullptr;
  }
  const std::string id = first_line_of(device / "idProduct");
  const auto* const found = std::find_if(kProducts.begin(), kProducts.end(),
                                         [&](const Product& product) { return product.id == id; });
  return found == kProducts.end() ? nullptr : found;
}

// /dev/bus/usb/001/004, as the kernel numbers it.
[[nodiscard]] std::string node_of(const fs::path& device) {
  const auto number = [&](const char* file) {
    return std::atoi(first_line_of(device / file).c_str());
  };
  return fmt::format("/dev/bus/usb/{:03}/{:03}", number("busnum"), number("devnum"));
}

[[nodiscard]] std::vector<PortHolder> holders_of_any(const fs::path& device, const fs::path& root) {
  std::vector<PortHolder> all;
  for (const fs::path& terminal : entries_of(root / "sys/class/tty")) {
    if (usb_device_of(terminal) == device) {
      const auto some = holders_of("/dev/" + terminal.filename().string(), root);
      all.insert(all.end(), some.begin(), some.end());
    }
  }
  return all;
}

[[nodiscard]] bool has_channels(const MaestroFacts& box, const MaestroOptions& options) {
  return options.left_channel < box.channels && options.right_channel < box.channels;
}

void measure_box(const fs::path& device, const Product& product, const MaestroNeeds& needs,
                 const fs::path& root, const AskMaestro& ask, MaestroFacts& box) {
  const fs::path node = root / fs::path{node_of(device)}.relative_path();
  box.channels = product.channels;
  box.group = group_of(node, root);
  box.holders = holders_of_any(device, root);
  if (box.holders.empty() && has_channels(box, needs.options)) {
    box.said = ask(node.string(), needs.options);
  }
}

[[nodiscard]] Finding finding(Verdict verdict, const MaestroFacts& box, const std::string& what,
                              std::string remedy = {}) {
  return {"maestro", verdict, fmt::format("{}: {}", box.name, what), std::move(remedy)};
}

[[nodiscard]] std::vector<Finding> judge_box(const MaestroFacts& box, const MaestroNeeds& needs) {
  if (box.port == MaestroFacts::Port::kOther) {
    return {finding(Verdict::kInfo, box, "is not a Maestro's own port: settings cannot be read")};
  }
  if (box.port == MaestroFacts::Port::kTtl) {
    return {finding(Verdict::kBad, box, "is its TTL port, which takes no commands",
                    "name its first port in devices.thrusters, usually the lower ttyACM")};
  }
  if (!has_channels(box, needs.options)) {
    return {finding(
        Verdict::kBad, box,
        fmt::format("has channels 0 to {}, and the thrusters are on {} and {}", box.channels - 1,
                    needs.options.left_channel, needs.options.right_channel),
        "name others by left and right in devices.thrusters")};
  }
  if (!box.said) {
    const PortHolder& holder = box.holders.front();
    return {finding(Verdict::kInfo, box,
                    fmt::format("its settings are not read while {} ({}) holds it", holder.program,
                                holder.process))};
  }
  switch (box.said->outcome) {
    case MaestroAnswer::Outcome::kRead: return judge_maestro(box.name, box.said->settings, needs);
    case MaestroAnswer::Outcome::kForbidden:
      return {finding(Verdict::kWarn, box, "this user may not read its settings",
                      permission_remedy(box.group))};
    case MaestroAnswer::Outcome::kSilent: break;
  }
  return {finding(Verdict::kWarn, box, "does not tell its settings by USB",
                  "plug it in anew; Maestro Control Center shows them")};
}

}  // namespace

std::vector<MaestroFacts> measure_maestros(const PortsFacts& ports, const MaestroNeeds& needs,
                                           const fs::path& root, const AskMaestro& ask) {
  std::vector<MaestroFacts> boxes;
  std::vector<fs::path> seen;
  for (const PortFacts& port : ports.ports) {
    if (port.named.scheme != "maestro" || !port.usb) {
      continue;
    }
    const fs::path terminal = root / "sys/class/tty" / fs::path{port.node}.filename();
    const fs::path device = usb_device_of(terminal);
    MaestroFacts box;
    box.named = true;
    const Product* const product = product_of(device);
    if (product == nullptr) {
      box.name = port.named.path;
      box.port = MaestroFacts::Port::kOther;
    } else {
      seen.push_back(device);
      box.name = fmt::format("{} at {}", product->name, port.named.path);
      const bool first = first_line_of(terminal / "device/bInterfaceNumber") == kCommandInterface;
      box.port = first ? MaestroFacts::Port::kCommand : MaestroFacts::Port::kTtl;
      measure_box(device, *product, needs, root, ask, box);
    }
    boxes.push_back(std::move(box));
  }
  for (const fs::path& entry : entries_of(root / "sys/bus/usb/devices")) {
    std::error_code error;
    const fs::path device = fs::canonical(entry, error);
    const Product* const product = error ? nullptr : product_of(device);
    if (product != nullptr && std::find(seen.begin(), seen.end(), device) == seen.end()) {
      MaestroFacts box;
      box.name = fmt::format("{} at USB {}, which no address names", product->name,
                             entry.filename().string());
      measure_box(device, *product, needs, root, ask, box);
      boxes.push_back(std::move(box));
    }
  }
  return boxes;
}

std::vector<Finding> judge_maestros(const std::vector<MaestroFacts>& boxes,
                                    const MaestroNeeds& needs) {
  std::vector<Finding> findings;
  for (const MaestroFacts& box : boxes) {
    for (Finding& one : judge_box(box, needs)) {
      if (!box.named) {
        one.verdict = std::min(one.verdict, Verdict::kWarn);
      }
      findings.push_back(std::move(one));
    }
  }
  return findings;
}

}  // namespace lodesman::cli
