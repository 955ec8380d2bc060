// SPDX-License-Identifier: Apache-2.0
// What the console answers to HTTP, apart from sockets: who may ask at all, and which file is
// meant. Pure functions on texts that may be anything; any thread.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lodesman::console {

struct HttpRequest {
  std::string method;
  std::string target;
  std::string host;
  std::optional<std::string> origin;  // where the browser says it
  std::string content_type;
  std::string cookie;  // the whole header
  std::string body;
};

struct HttpReply {
  unsigned status = 200;
  std::string content_type;
  std::string body;
  std::vector<std::pair<std::string, std::string>> headers;  // beside those that all have
};

// What every reply has, so that a page runs no script but the console's own and asks nobody else.
[[nodiscard]] const std::vector<std::pair<std::string, std::string>>& common_headers();

[[nodiscard]] HttpReply json_reply(unsigned status, const std::string& body);
[[nodiscard]] HttpReply error_reply(unsigned status, const std::string& reason);

// Whether a Host header, with or without a port, is one of the names, or of loopback's.
[[nodiscard]] bool is_own_host(std::string_view host, const std::vector<std::string>& names);
// Whether a page of that origin is this console's own, as the same request's Host has it.
[[nodiscard]] bool is_own_origin(std::string_view origin, std::string_view host);

// The value of a cookie in its header; empty where it is not there.
[[nodiscard]] std::string cookie_value(std::string_view header, std::string_view name);
inline constexpr const char* kSessionCookie = "lodesman_console";

// The file below the page's directory that a target means: letters, digits, '-', '_' and '.', in
// parts that begin with no '.'. Empty where it is none.
[[nodiscard]] std::string page_file(std::string_view target);
[[nodiscard]] std::string media_type(std::string_view file);

}  // namespace lodesman::console
