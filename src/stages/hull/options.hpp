#pragma once
// The options of hull, and the names of its results.

#include "geometry/hull/hull.hpp"
#include "stage/stage.hpp"

namespace facetmill::hull_stage {

enum class Engine { none, unreal, godot, unity, other };

struct HullOptions {
    enum class Per { part, scene };

    HullShape shape = HullShape::hull;
    Per per = Per::part;
    std::optional<std::int64_t> max_vertices;
    Engine engine = Engine::none;
    bool keep = false;
};

void declare_hull(Declare<HullOptions>& d);

/// The name by which the engine knows the collision shape of a part.
[[nodiscard]] std::string collider_name(const HullOptions& o, const std::string& part);

} // namespace facetmill::hull_stage
