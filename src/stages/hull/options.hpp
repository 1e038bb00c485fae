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
    std::int64_t max_parts = 1;
    Length concavity = Length::percent(2);
    Engine engine = Engine::none;
    bool keep = false;
};

void declare_hull(Declare<HullOptions>& d);

/// The name by which the engine knows a collision shape of a part. number: none if it is the only shape.
[[nodiscard]] std::string collider_name(const HullOptions& o, const std::string& part,
                                        std::optional<std::size_t> number);

} // namespace facetmill::hull_stage
