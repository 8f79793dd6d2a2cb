// What JSON files of scenes and runs hold beside plain values: vectors and places.
#pragma once

#include "mysim/json.h"
#include "mysim/types.h"

namespace crosscheck {

/// Of three numbers. Throws InputError as JsonField does.
Vec3 vec3_of(const JsonField& field);
/// 3 x count, of count triples of numbers. Throws InputError as JsonField does.
Points points_of(const JsonField& field, int count);

/// Three numbers, and one triple for each column.
Json json_of(const Vec3& v);
Json json_of(const Points& p);

}  // namespace crosscheck
