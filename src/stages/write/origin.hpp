#pragma once
// Where the coordinates of a file count from: float32 numbers far from the origin are coarse, so meshes there
// count from a point near them, and their nodes stand at that point.

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

/// Moves the origin of parts to a point of the world: what is subtracted from the positions is added to the
/// transform. automatic: a point near the centre, for parts that float32 would round by more than a millionth
/// of the scene's diagonal. Skinned parts keep theirs, as do, with the rest of a document, those under
/// animations and instancing (W-ORIGIN where a point is asked for). moved: the parts and the positions that
/// they had.
[[nodiscard]] std::optional<OriginReport> move_origin(Scene& scene, const OriginOption& option,
                                                      Context& context,
                                                      std::map<std::size_t, std::vector<Vec3>>& moved);

} // namespace write_stage

} // namespace facetmill
