// Vectors and places.
#include "reference/protocol/json_fields.h"

namespace crosscheck {

Vec3 vec3_of(const JsonField& field) {
  const std::vector<double> parts = field.numbers();
  if (parts.size() != 3) field.fail("three numbers");
  return {parts[0], parts[1], parts[2]};
}

Points points_of(const JsonField& field, int count) {
  return Eigen::Map<const Points>(field.triples(static_cast<size_t>(count)).data(), 3, count);
}

Json json_of(const Vec3& v) { return std::span(v.data(), 3); }

Json json_of(const Points& p) {
  Json list = Json::list();
  for (const auto& column : p.colwise()) list.push(std::span(column.data(), 3));
  return list;
}

}  // namespace crosscheck
