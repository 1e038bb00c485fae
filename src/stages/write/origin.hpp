#pragma once
// Moves the origin of a file's coordinates. Because float32 numbers are coarse far from the origin, mesh
// positions become relative to a nearby point, and nodes are translated by that point.

#include "io/codec.hpp"
#include "options/declaration.hpp"
#include "stage/context.hpp"

#include <map>

namespace facetmill {

struct OriginOption {
    enum class Kind { automatic, keep, point };
    Kind kind = Kind::automatic;
    Vec3 point;
};

template <>
struct OptionType<OriginOption> {
    static constexpr OptionKind kind = OptionKind::point;
    static constexpr Dimension dimension = Dimension::none;
    static bool parse(const Value& value, OriginOption& out, Problems& problems);
    static std::string print(const OriginOption& value);
    static Json schema();
    static std::optional<double> magnitude(const OriginOption&) { return {}; }
};

namespace write_stage {

struct OriginReport {
    Vec3 offset;
    std::size_t parts = 0;
};

/// Moves the origin of parts to a world point: subtracts it from the positions and adds it to the transform.
/// automatic: uses a point near the centre, for parts that float32 would round by more than a millionth of
/// the scene's diagonal. Skinned parts, and all parts of documents with animations or instancing, stay
/// unchanged (W-ORIGIN if a point was requested). moved: receives the moved parts and their previous
/// positions.
[[nodiscard]] std::optional<OriginReport> move_origin(Scene& scene, const OriginOption& option,
                                                      Context& context,
                                                      std::map<std::size_t, std::vector<Vec3>>& moved);

} // namespace write_stage

} // namespace facetmill
