// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/console/console.h"

#include <algorithm>
#include <utility>

#include "deploy/boat/version.h"
#include "deploy/operator/console/json_values.h"

namespace lodesman::console {
namespace {

constexpr std::string_view kView = "/view/";
constexpr std::size_t kMaxToken = 1024;

[[nodiscard]] std::string cookie_of(const Session& session) {
  return std::string{kSessionCookie} + "=" + to_hex(session.secret) +
         "; HttpOnly; SameSite=Strict; Path=/";
}

[[nodiscard]] bool is_json(const std::string& content_type) {
  constexpr std::string_view kType = "application/json";
  return content_type.starts_with(kType) &&
         (content_type.size() == kType.size() || content_type[kType.size()] == ';' ||
          content_type[kType.size()] == ' ');
}

}  // namespace

Console::Console(ConsoleOptions options, PortMaker make_port)
    : options_{std::move(options)},
      make_port_{std::move(make_port)},
      id_{to_hex(random_digest()).substr(0, 16)},
      tokens_{options_.command_port, options_.lasting_tokens},
      sessions_{[this](const std::string& token) { return tokens_.scope_of(token); }},
      files_{options_.page},
      feed_{options_.segment, topics_},
      own_{{options_.hull, options_.min_range_m},
           topics_,
           feed_,
           clients_,
           make_port_(
               [this] {
                 const auto run = tokens_.of_run();
                 return run ? run->view : std::string{};
               },
               Insistence::kOnce)} {
  topics_.set_published(
      [this](std::uint16_t topic, const std::string& part, const MessagePtr& message) {
        for (const auto& client : clients_) {
          client->offer(topic, part, message);
        }
      });
}

Console::~Console() {
  for (const auto& client : clients_) {
    client->leave();
  }
}

std::optional<HttpReply> Console::refusal_of(const HttpRequest& request, bool any_origin) const {
  if (!is_own_host(request.host, options_.names)) {
    return error_reply(421, "this console is not known by that name: [console] names");
  }
  if (!any_origin && request.origin && !is_own_origin(*request.origin, request.host)) {
    return error_reply(403, "a page of another origin asks");
  }
  return std::nullopt;
}

const Session* Console::session_of(const HttpRequest& request, Time now) {
  return sessions_.find(cookie_value(request.cookie, kSessionCookie), now);
}

HttpReply Console::answer(const HttpRequest& request, Time now) {
  if (auto refusal = refusal_of(request, false)) {
    return *std::move(refusal);
  }
  if (request.target == "/session") {
    return answer_session(request, now);
  }
  if (request.target == "/ticket") {
    return answer_ticket(request, now);
  }
  if (request.method != "GET" && request.method != "HEAD") {
    return error_reply(405, "GET alone");
  }
  auto file = files_.find(request.target);
  return file ? *std::move(file) : error_reply(404, "there is no such file");
}

HttpReply Console::answer_session(const HttpRequest& request, Time now) {
  if (request.method == "POST") {
    return sign_in(request, now);
  }
  if (request.method == "DELETE") {
    return sign_out(request, now);
  }
  if (request.method != "GET") {
    return error_reply(405, "GET, POST or DELETE");
  }
  const Session* session = session_of(request, now);
  return json_reply(
      200, text_of({{"scope", scope_word(session != nullptr ? session->scope : Scope::kNone)},
                    {"boat", options_.boat},
                    {"recording", false},
                    {"version", kVersion}}));
}

HttpReply Console::sign_in(const HttpRequest& request, Time now) {
  if (!is_json(request.content_type)) {
    return error_reply(415, "Content-Type must be application/json");
  }
  const Json body = parsed(request.body);
  const auto token = body.is_object() ? body.find("token") : body.end();
  if (!body.is_object() || token == body.end() || !token->is_string() ||
      token->get_ref<const std::string&>().size() > kMaxToken) {
    return error_reply(400, "the body must be {\"token\": \"...\"}");
  }
  const Sessions::SignIn outcome = sessions_.sign_in(token->get<std::string>(), now);
  if (outcome.session == nullptr && outcome.wait > Duration{}) {
    HttpReply reply = error_reply(429, "too many wrong tokens in a row");
    reply.headers.emplace_back(
        "Retry-After",
        std::to_string(std::chrono::duration_cast<std::chrono::seconds>(outcome.wait).count()));
    return reply;
  }
  if (outcome.session == nullptr) {
    return error_reply(403, "this is no token of the boat's");
  }
  end_orphans();  // of a session that had to give way
  return {204, "", "", {{"Set-Cookie", cookie_of(*outcome.session)}}};
}

HttpReply Console::sign_out(const HttpRequest& request, Time now) {
  if (const Session* session = session_of(request, now)) {
    sessions_.end(session->number);
    end_orphans();
  }
  return {204,
          "",
          "",
          {{"Set-Cookie",
            std::string{kSessionCookie} + "=; HttpOnly; SameSite=Strict; Path=/; Max-Age=0"}}};
}

HttpReply Console::answer_ticket(const HttpRequest& request, Time now) {
  if (request.method != "POST") {
    return error_reply(405, "POST alone");
  }
  if (session_of(request, now) == nullptr) {
    return error_reply(401, "sign in first");
  }
  return json_reply(200, text_of({{"path", std::string{kView} + sessions_.make_ticket()}}));
}

Console::Admission Console::admit(const HttpRequest& request, Time now) {
  const bool by_ticket = request.target.starts_with(kView);
  if (auto refusal = refusal_of(request, by_ticket)) {
    return {std::nullopt, *std::move(refusal)};
  }
  if (clients_.size() >= kMaxClients) {
    return {std::nullopt, error_reply(503, "too many viewers")};
  }
  if (by_ticket) {
    return sessions_.is_ticket(request.target.substr(kView.size()))
               ? Admission{ClientRights{Scope::kView, 0, false}, {}}
               : Admission{std::nullopt, error_reply(403, "this is no ticket of this console's")};
  }
  if (request.target != "/") {
    return {std::nullopt, error_reply(404, "viewers connect to / or to a ticket's path")};
  }
  const Session* session = session_of(request, now);
  return session != nullptr ? Admission{ClientRights{session->scope, session->number, true}, {}}
                            : Admission{std::nullopt, error_reply(401, "sign in first")};
}

std::string Console::token_of(std::uint64_t number) const {
  const Session* session = sessions_.find(number);
  if (session == nullptr) {
    return {};
  }
  if (!session->token.empty()) {
    return session->token;
  }
  const auto run = tokens_.of_run();
  return run ? run->command : std::string{};
}

std::shared_ptr<Client> Console::add_client(const ClientRights& rights) {
  if (clients_.size() >= kMaxClients) {
    return nullptr;
  }
  auto client = std::make_shared<Client>(++last_client_, rights, topics_, pulse_);
  if (rights.may_ask) {
    const TokenOf token = [this, number = rights.session] { return token_of(number); };
    client->set_ports(make_port_(token, Insistence::kOnce), make_port_(token, Insistence::kAgain));
  }
  client->on_listener = [this](std::uint16_t topic) { own_.listener(topic); };
  client->on_command = [this](const CommandNews& news) {
    if (const auto event = event_of(news)) {
      own_.tell(*event);
    }
  };
  client->greet(options_.boat, id_);
  clients_.push_back(client);
  own_.tell({client->name() + " looks on", Severity::kInfo, ""});
  return client;
}

void Console::remove_client(Client& client) {
  client.leave();
  own_.tell({client.name() + " has gone", Severity::kInfo, ""});
  clients_.remove_if([&](const auto& kept) { return kept.get() == &client; });
}

// Whose session has ended meanwhile.
void Console::end_orphans() {
  for (const auto& client : clients_) {
    const std::uint64_t session = client->rights().session;
    if (session != 0 && sessions_.find(session) == nullptr) {
      client->end();
    }
  }
}

void Console::step(Time now) {
  pulse_.beat(now);
  feed_.look(now);
  own_.step(now);
}

}  // namespace lodesman::console
