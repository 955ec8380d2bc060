// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/console/http_rules.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "deploy/operator/console/json_values.h"

namespace lodesman::console {
namespace {

[[nodiscard]] std::string in_small_letters(std::string_view text) {
  std::string small{text};
  std::transform(small.begin(), small.end(), small.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return small;
}

// Nothing where what stands behind the name is no port.
[[nodiscard]] std::optional<std::string> without_port(std::string_view host) {
  const std::size_t bracket = host.find(']');
  const std::size_t colon = host.find(':', bracket == std::string_view::npos ? 0 : bracket);
  if (colon == std::string_view::npos) {
    return in_small_letters(host);
  }
  const std::string_view port = host.substr(colon + 1);
  const bool digits = port.size() <= 5 && std::all_of(port.begin(), port.end(),
                                                      [](char c) { return c >= '0' && c <= '9'; });
  return digits ? std::optional{in_small_letters(host.substr(0, colon))} : std::nullopt;
}

[[nodiscard]] bool is_plain(char c) noexcept {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' || c == '.';
}

}  // namespace

const std::vector<std::pair<std::string, std::string>>& common_headers() {
  static const std::vector<std::pair<std::string, std::string>> kHeaders{
      {"Content-Security-Policy",
       "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; "
       "img-src 'self' data: blob:; connect-src 'self'; base-uri 'none'; form-action 'none'; "
       "frame-ancestors 'none'"},
      {"X-Content-Type-Options", "nosniff"},
      {"Referrer-Policy", "no-referrer"},
      {"Cache-Control", "no-cache"}};
  return kHeaders;
}

HttpReply json_reply(unsigned status, const std::string& body) {
  return {status, "application/json", body, {}};
}

HttpReply error_reply(unsigned status, const std::string& reason) {
  return json_reply(status, text_of({{"error", reason}}));
}

bool is_own_host(std::string_view host, const std::vector<std::string>& names) {
  const auto name = without_port(host);
  if (!name || name->empty()) {
    return false;
  }
  constexpr std::array<std::string_view, 3> kLoopback{"localhost", "127.0.0.1", "[::1]"};
  if (std::find(kLoopback.begin(), kLoopback.end(), *name) != kLoopback.end()) {
    return true;
  }
  return std::any_of(names.begin(), names.end(), [&](const std::string& known) {
    const std::string small = in_small_letters(known);
    return *name == small || *name == "[" + small + "]";
  });
}

bool is_own_origin(std::string_view origin, std::string_view host) {
  const std::string small = in_small_letters(origin);
  const std::string own = in_small_letters(host);
  return small == "http://" + own || small == "https://" + own;
}

std::string cookie_value(std::string_view header, std::string_view name) {
  constexpr std::string_view kBlank = " \t;";
  for (std::size_t from = header.find_first_not_of(kBlank); from != std::string_view::npos;) {
    const std::size_t to = std::min(header.find(';', from), header.size());
    const std::string_view pair = header.substr(from, to - from);
    if (pair.size() > name.size() && pair.starts_with(name) && pair[name.size()] == '=') {
      std::string_view value = pair.substr(name.size() + 1);
      value = value.substr(0, value.find_last_not_of(" \t") + 1);
      return std::string{value};
    }
    from = header.find_first_not_of(kBlank, to);
  }
  return {};
}

std::string page_file(std::string_view target) {
  target = target.substr(0, target.find('?'));
  if (target == "/") {
    return "index.html";
  }
  constexpr std::size_t kMaxName = 200;
  if (!target.starts_with('/') || target.size() > kMaxName || target.ends_with('/')) {
    return {};
  }
  target.remove_prefix(1);
  char before = '/';
  for (const char c : target) {
    const bool begins_part = before == '/';
    if ((begins_part && (c == '.' || c == '/')) || (c != '/' && !is_plain(c))) {
      return {};
    }
    before = c;
  }
  return std::string{target};
}

std::string media_type(std::string_view file) {
  constexpr std::array<std::pair<std::string_view, const char*>, 10> kTypes{
      {{".html", "text/html; charset=utf-8"},
       {".js", "text/javascript; charset=utf-8"},
       {".mjs", "text/javascript; charset=utf-8"},
       {".css", "text/css; charset=utf-8"},
       {".svg", "image/svg+xml"},
       {".png", "image/png"},
       {".ico", "image/x-icon"},
       {".json", "application/json"},
       {".webmanifest", "application/manifest+json"},
       {".txt", "text/plain; charset=utf-8"}}};
  for (const auto& [ending, type] : kTypes) {
    if (file.ends_with(ending)) {
      return type;
    }
  }
  return {};
}

}  // namespace lodesman::console
