#pragma once
// Points as reports have them.

#include "base/json.hpp"
#include "base/vec.hpp"

namespace facetmill {

/// [x, y, z]
inline Json point_json(const Vec3& p) { return Json::array({p.x, p.y, p.z}); }

} // namespace facetmill
