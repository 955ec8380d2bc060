// SPDX-License-Identifier: Apache-2.0
// JSON Schemas of the console's own topics: each member says its unit, and may be null where its
// value is not known. Pure functions; any thread.
#pragma once

#include "mid_level/recording/viewer_json.h"

namespace lodesman::console {

[[nodiscard]] inline viewer::Json typed_schema(const char* type, const char* description) {
  viewer::Json types = viewer::Json::array();
  types.push_back(type);
  types.push_back("null");
  return {{"type", types}, {"description", description}};
}
[[nodiscard]] inline viewer::Json number_schema(const char* description) {
  return typed_schema("number", description);
}
[[nodiscard]] inline viewer::Json text_schema(const char* description) {
  return typed_schema("string", description);
}
[[nodiscard]] inline viewer::Json flag_schema(const char* description) {
  return typed_schema("boolean", description);
}
[[nodiscard]] inline viewer::Json list_schema(const char* description, const viewer::Json& items) {
  viewer::Json schema = typed_schema("array", description);
  schema["items"] = items;
  return schema;
}
// [x, y].
[[nodiscard]] inline viewer::Json point_schema(const char* description) {
  return list_schema(description, {{"type", "number"}});
}
[[nodiscard]] inline viewer::Json points_schema(const char* description) {
  return list_schema(description, point_schema("[x, y]"));
}
[[nodiscard]] inline viewer::Json object_schema(const char* title, const viewer::Json& members) {
  viewer::Json schema = typed_schema("object", title);
  schema["title"] = title;
  schema["properties"] = members;
  return schema;
}
[[nodiscard]] inline viewer::Shape named_shape(const char* title, const viewer::Json& members) {
  viewer::Json schema = object_schema(title, members);
  schema["type"] = "object";
  return {title, schema};
}
[[nodiscard]] inline viewer::Shape open_shape(const char* title, const char* description) {
  return {title, {{"title", title}, {"type", "object"}, {"description", description}}};
}

}  // namespace lodesman::console
