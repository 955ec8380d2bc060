// SPDX-License-Identifier: Apache-2.0
#include "mid_level/config/toml_document.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "mid_level/config/toml_hazard.h"

namespace lodesman {

struct TomlDocument::Impl {
  std::string name;  // of the bottom file, for keys that are missing
  toml::table table;
  std::set<const toml::node*> read;
};

namespace {

[[nodiscard]] std::string file_of(const toml::node& node, const TomlDocument::Impl& document) {
  const auto& path = node.source().path;
  return path ? *path : document.name;
}

[[nodiscard]] std::size_t line_of(const toml::node& node) {
  return node.source().begin.line == 0 ? 1 : node.source().begin.line;
}

[[noreturn]] void refuse_node(const toml::node& node, const TomlDocument::Impl& document,
                              const std::string& key, const std::string& reason) {
  throw StartupError(file_of(node, document), line_of(node), key, reason);
}

[[nodiscard]] std::string number_text(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

[[nodiscard]] std::string range_text(Range range) {
  const bool has_max = range.max < std::numeric_limits<double>::max();
  const std::string low =
      (range.min_excluded ? "greater than " : "at least ") + number_text(range.min);
  return has_max ? low + " and at most " + number_text(range.max) : low;
}

[[nodiscard]] double number_of(const toml::node& node, const TomlDocument::Impl& document,
                               const std::string& key, Range range) {
  const auto value = node.is_number() ? node.value<double>() : std::nullopt;
  if (!value) {
    refuse_node(node, document, key, "must be a number");
  }
  if (!std::isfinite(*value)) {
    refuse_node(node, document, key, "must be finite");
  }
  if (*value < range.min || *value > range.max || (range.min_excluded && *value <= range.min)) {
    refuse_node(node, document, key, "must be " + range_text(range));
  }
  return *value;
}

[[nodiscard]] std::array<double, 2> pair_of(const toml::node& node,
                                            const TomlDocument::Impl& document,
                                            const std::string& key, Range range) {
  const auto* array = node.as_array();
  if (array == nullptr || array->size() != 2) {
    refuse_node(node, document, key, "must be two numbers [x, y]");
  }
  return {number_of((*array)[0], document, key, range),
          number_of((*array)[1], document, key, range)};
}

// Moves nodes, since toml++ forgets where a copied node was written.
// NOLINTNEXTLINE(misc-no-recursion): as deep as the document, which from_text() bounds
void overlay_table(toml::table& base, toml::table& over, const std::string& path,
                   const TomlDocument::Impl& document) {
  for (auto&& [key, node] : over) {
    const std::string here =
        path.empty() ? std::string{key.str()} : path + "." + std::string{key.str()};
    toml::node* old = base.get(key.str());
    if (old == nullptr) {
      refuse_node(node, document, here, "unknown key");
    }
    if (old->is_table() && node.is_table()) {
      overlay_table(*old->as_table(), *node.as_table(), here, document);
    } else {
      node.visit([&, name = key.str()](auto& value) {
        base.insert_or_assign(name, std::move(value));  // clang 14 captures no binding
      });
    }
  }
}

// NOLINTNEXTLINE(misc-no-recursion): as deep as the document, which from_text() bounds
void require_read(const toml::node& node, const TomlDocument::Impl& document,
                  const std::string& path) {
  if (!path.empty() && !document.read.contains(&node)) {
    refuse_node(node, document, path, "unknown key");
  }
  if (const auto* table = node.as_table()) {
    for (auto&& [key, child] : *table) {
      require_read(child, document,
                   path.empty() ? std::string{key.str()} : path + "." + std::string{key.str()});
    }
  } else if (const auto* array = node.as_array()) {
    for (std::size_t i = 0; i < array->size(); ++i) {
      if ((*array)[i].is_table()) {
        require_read((*array)[i], document, path + "[" + std::to_string(i) + "]");
      }
    }
  }
}

}  // namespace

TomlDocument::TomlDocument(std::unique_ptr<Impl> impl) noexcept : impl_{std::move(impl)} {}
TomlDocument::TomlDocument(TomlDocument&&) noexcept = default;
TomlDocument& TomlDocument::operator=(TomlDocument&&) noexcept = default;
TomlDocument::~TomlDocument() = default;

TomlDocument TomlDocument::from_file(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    throw StartupError(path.string(), 1, "file", "cannot be read");
  }
  if (std::filesystem::file_size(path, error) > kMaxBytes) {
    throw StartupError(path.string(), 1, "file", "is larger than 1 MiB");
  }
  std::ifstream stream{path, std::ios::binary};
  if (!stream) {
    throw StartupError(path.string(), 1, "file", "cannot be read");
  }
  std::ostringstream text;
  text << stream.rdbuf();
  return from_text(text.str(), path.string());
}

TomlDocument TomlDocument::from_text(std::string_view text, const std::string& name) {
  if (text.size() > kMaxBytes) {
    throw StartupError(name, 1, "file", "is larger than 1 MiB");
  }
  if (const auto hazard = hazard_of(text)) {
    throw StartupError(name, hazard->line, "toml", std::string{hazard->reason});
  }
  auto impl = std::make_unique<Impl>();
  impl->name = name;
  try {
    impl->table = toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    throw StartupError(name, error.source().begin.line, "toml", std::string{error.description()});
  }
  return TomlDocument{std::move(impl)};
}

void TomlDocument::overlay(TomlDocument over) {
  overlay_table(impl_->table, over.impl_->table, "", *over.impl_);
}

TomlTable TomlDocument::root() const { return {*impl_, &impl_->table, ""}; }

void TomlDocument::require_all_keys_read() const { require_read(impl_->table, *impl_, ""); }

std::string TomlDocument::to_text() const {
  // Literal texts are written wrongly by toml++ 3.3 where they hold quotes and a line end.
  constexpr auto kFlags =
      toml::toml_formatter::default_flags &
      ~(toml::format_flags::allow_literal_strings | toml::format_flags::allow_multi_line_strings);
  std::ostringstream text;
  text << toml::toml_formatter{impl_->table, kFlags} << "\n";
  return text.str();
}

TomlTable::TomlTable(TomlDocument::Impl& document, const void* table, std::string path) noexcept
    : document_{&document}, table_{table}, path_{std::move(path)} {}

std::string TomlTable::path_of(std::string_view key) const {
  return path_.empty() ? std::string{key} : path_ + "." + std::string{key};
}

const void* TomlTable::find(std::string_view key) const {
  const toml::node* node = static_cast<const toml::table*>(table_)->get(key);
  if (node != nullptr) {
    document_->read.insert(node);
  }
  return node;
}

const void* TomlTable::require(std::string_view key) const {
  const void* node = find(key);
  if (node == nullptr) {
    refuse(key, "missing");
  }
  return node;
}

void TomlTable::refuse(std::string_view key, const std::string& reason) const {
  const auto* table = static_cast<const toml::table*>(table_);
  const toml::node* node = table->get(key);
  refuse_node(node != nullptr ? *node : *table, *document_, path_of(key), reason);
}

bool TomlTable::empty() const noexcept { return static_cast<const toml::table*>(table_)->empty(); }

bool TomlTable::has(std::string_view key) const {
  return static_cast<const toml::table*>(table_)->contains(key);
}

double TomlTable::number(std::string_view key, Range range) const {
  return number_of(*static_cast<const toml::node*>(require(key)), *document_, path_of(key), range);
}

double TomlTable::number_or(std::string_view key, Range range, double otherwise) const {
  return has(key) ? number(key, range) : otherwise;
}

std::int64_t TomlTable::integer(std::string_view key, std::int64_t min, std::int64_t max) const {
  const auto* value = static_cast<const toml::node*>(require(key))->as_integer();
  if (value == nullptr) {
    refuse(key, "must be a whole number");
  }
  if (value->get() < min || value->get() > max) {
    refuse(key, "must be from " + std::to_string(min) + " to " + std::to_string(max));
  }
  return value->get();
}

std::int64_t TomlTable::integer_or(std::string_view key, std::int64_t min, std::int64_t max,
                                   std::int64_t otherwise) const {
  return has(key) ? integer(key, min, max) : otherwise;
}

bool TomlTable::boolean(std::string_view key) const {
  const auto* value = static_cast<const toml::node*>(require(key))->as_boolean();
  if (value == nullptr) {
    refuse(key, "must be true or false");
  }
  return value->get();
}

bool TomlTable::boolean_or(std::string_view key, bool otherwise) const {
  return has(key) ? boolean(key) : otherwise;
}

Duration TomlTable::duration(std::string_view key, Range seconds) const {
  return from_seconds(number(key, seconds));
}

std::string TomlTable::text(std::string_view key, std::size_t max_length,
                            std::size_t min_length) const {
  const auto* value = static_cast<const toml::node*>(require(key))->as_string();
  if (value == nullptr) {
    refuse(key, "must be a text");
  }
  if (value->get().size() < min_length || value->get().size() > max_length) {
    refuse(key, "must have " + std::to_string(min_length) + " to " + std::to_string(max_length) +
                    " characters");
  }
  return value->get();
}

std::vector<std::string> TomlTable::texts(std::string_view key, std::size_t max_length,
                                          std::size_t max_count) const {
  const auto* array = static_cast<const toml::node*>(require(key))->as_array();
  const auto is_text = [&](const toml::node& node) {
    const auto* value = node.as_string();
    return value != nullptr && !value->get().empty() && value->get().size() <= max_length;
  };
  if (array == nullptr || array->size() > max_count ||
      !std::all_of(array->begin(), array->end(), is_text)) {
    refuse(key, "must be a list of up to " + std::to_string(max_count) + " texts of 1 to " +
                    std::to_string(max_length) + " characters");
  }
  std::vector<std::string> texts;
  for (const auto& node : *array) {
    texts.push_back(node.as_string()->get());
  }
  return texts;
}

std::size_t TomlTable::choice(std::string_view key,
                              std::initializer_list<std::string_view> words) const {
  const auto* value = static_cast<const toml::node*>(require(key))->as_string();
  std::string known;
  std::size_t index = 0;
  for (const auto word : words) {
    if (value != nullptr && value->get() == word) {
      return index;
    }
    known += (index == 0 ? "" : ", ") + std::string{word};
    ++index;
  }
  refuse(key, "must be one of: " + known);
}

std::array<double, 2> TomlTable::pair(std::string_view key, Range range) const {
  return pair_of(*static_cast<const toml::node*>(require(key)), *document_, path_of(key), range);
}

std::vector<std::array<double, 2>> TomlTable::pairs(std::string_view key, Range range,
                                                    std::size_t min_count,
                                                    std::size_t max_count) const {
  const auto* array = static_cast<const toml::node*>(require(key))->as_array();
  if (array == nullptr || array->size() < min_count || array->size() > max_count) {
    refuse(key, "must be " + std::to_string(min_count) + " to " + std::to_string(max_count) +
                    " points [[x, y], ...]");
  }
  std::vector<std::array<double, 2>> points;
  for (const auto& node : *array) {
    points.push_back(pair_of(node, *document_, path_of(key), range));
  }
  return points;
}

std::vector<std::vector<std::array<double, 2>>> TomlTable::polygons(std::string_view key,
                                                                    Range range,
                                                                    std::size_t min_corners,
                                                                    std::size_t max_corners,
                                                                    std::size_t max_count) const {
  const auto* array = static_cast<const toml::node*>(require(key))->as_array();
  const auto is_list_of_lists = [](const toml::node& node) {
    return node.is_array() && !node.as_array()->empty() && (*node.as_array())[0].is_array();
  };
  std::vector<std::vector<std::array<double, 2>>> polygons;
  if (array != nullptr && !array->empty() && !is_list_of_lists((*array)[0])) {
    polygons.push_back(pairs(key, range, min_corners, max_corners));
    return polygons;
  }
  if (array == nullptr || array->size() > max_count) {
    refuse(key, "must be at most " + std::to_string(max_count) + " polygons [[[x, y], ...], ...]");
  }
  for (const auto& node : *array) {
    const auto* corners = node.as_array();
    if (corners == nullptr || corners->size() < min_corners || corners->size() > max_corners) {
      refuse(key, "each polygon must have " + std::to_string(min_corners) + " to " +
                      std::to_string(max_corners) + " points [x, y]");
    }
    polygons.emplace_back();
    for (const auto& corner : *corners) {
      polygons.back().push_back(pair_of(corner, *document_, path_of(key), range));
    }
  }
  return polygons;
}

TomlTable TomlTable::table(std::string_view key) const {
  const auto* node = static_cast<const toml::node*>(require(key));
  if (!node->is_table()) {
    refuse(key, "must be a table");
  }
  return {*document_, node->as_table(), path_of(key)};
}

std::vector<TomlTable> TomlTable::tables(std::string_view key, std::size_t max_count) const {
  std::vector<TomlTable> list;
  const auto* node = static_cast<const toml::node*>(find(key));
  if (node == nullptr) {
    return list;
  }
  const auto* array = node->as_array();
  if (array == nullptr || array->size() > max_count) {
    refuse(key,
           "must be at most " + std::to_string(max_count) + " [[" + std::string{key} + "]] tables");
  }
  for (std::size_t i = 0; i < array->size(); ++i) {
    const auto* table = (*array)[i].as_table();
    if (table == nullptr) {
      refuse(key, "must be [[" + std::string{key} + "]] tables");
    }
    document_->read.insert(table);
    list.push_back({*document_, table, path_of(key) + "[" + std::to_string(i) + "]"});
  }
  return list;
}

}  // namespace lodesman
