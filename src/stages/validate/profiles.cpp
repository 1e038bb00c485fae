#include "stages/validate/profiles.hpp"

#include <algorithm>
#include <array>

namespace facetmill::validate_stage {

namespace {

const Bound yes{.min = {}, .max = {}, .truth = true};
const Bound no_more_than_none{.min = 0, .max = 0, .truth = {}};
const Bound some{.min = 1, .max = {}, .truth = {}};

using Rows = std::vector<std::pair<std::string, Bound>>;

void add(Rows& rows, const Rows& more) { rows.insert(rows.end(), more.begin(), more.end()); }

/// The properties that every surface should have.
Rows sound_rows() {
    Rows rows;
    for (const Property& p : property_table())
        if (p.soundness == Soundness::surface) rows.emplace_back(p.name, p.truth() ? yes : no_more_than_none);
    rows.emplace_back("faces", some);
    return rows;
}

bool is_asset(Profile profile) { return profile >= Profile::shop; }

/// Most mobile devices draw 100,000 triangles fluently: Khronos, "Asset Creation Guidelines" (3D Commerce).
Rows asset_rows(Profile profile) {
    if (profile == Profile::shop || profile == Profile::ar)
        return {{"triangles", {.min = 1, .max = 100000, .truth = {}}},
                {"uvs_in_range", yes},
                {"uv_overlaps", no_more_than_none},
                {"mirrored_uvs", no_more_than_none}};
    return {{"joint_count", {.min = {}, .max = 256, .truth = {}}}};
}

Rows rows_of(Profile profile) {
    const Rows sound = sound_rows();
    if (is_asset(profile)) {
        Rows rows = rows_of(Profile::web);
        add(rows, asset_rows(profile));
        return rows;
    }
    switch (profile) {
    case Profile::none:
        return sound;
    case Profile::web:
        return {{"finite_attributes", yes},
                {"unit_normals", yes},
                {"weights_normalized", yes},
                {"degenerate_faces", no_more_than_none},
                {"duplicate_faces", no_more_than_none},
                {"isolated_vertices", no_more_than_none},
                {"faces", some}};
    case Profile::solid:
    case Profile::printing:
    case Profile::simulation:
    default:
        break;
    }
    Rows rows = sound;
    add(rows, {{"outward_oriented", yes},
               {"duplicate_faces", no_more_than_none},
               {"folded_faces", no_more_than_none}});
    if (profile == Profile::solid) return rows;
    add(rows, {{"self_intersections", no_more_than_none}, {"isolated_vertices", no_more_than_none}});
    if (profile == Profile::simulation)
        add(rows, {{"t_junctions", no_more_than_none},
                   {"min_angle", {.min = 5, .max = {}, .truth = {}}},
                   {"aspect_ratio", {.min = {}, .max = 20, .truth = {}}}});
    return rows;
}

} // namespace

Assertions profiled(Assertions given, Profile profile, const SceneLimits& limits, const Mark& where) {
    if (profile == Profile::none && (!given.all.empty() || limits.any())) return given;
    for (const auto& [name, bound] : rows_of(profile)) {
        const bool known = std::any_of(given.all.begin(), given.all.end(),
                                       [&name = name](const Assertion& a) { return a.property == name; });
        // Profiles of assets judge optional attributes only if they exist.
        if (!known) given.all.push_back({name, bound, where, profile == Profile::web || is_asset(profile)});
    }
    return given;
}

SceneLimits profiled(SceneLimits given, Profile profile) {
    if (!is_asset(profile)) return given;
    const auto limit = [](std::optional<CountLimit>& slot, std::optional<double> min, double max) {
        if (!slot) slot = CountLimit{{.min = min, .max = max, .truth = {}}};
    };
    const bool for_shops = profile == Profile::shop || profile == Profile::ar;
    limit(given.moved_roots, {}, 0);
    if (profile != Profile::godot) limit(given.odd_textures, {}, 0);
    const double largest = for_shops ? 2048 : profile == Profile::unreal ? 8192 : 16384;
    limit(given.texture_sides, for_shops ? std::optional<double>(512) : std::nullopt, largest);
    if (!for_shops) return given;
    limit(given.materials, {}, 5);
    limit(given.primitives, {}, 5);
    limit(given.parts, {}, 5);
    limit(given.partial_metals, {}, 0);
    limit(given.longest_side, 0.01, 100);
    if (profile == Profile::shop) limit(given.base_colours, 30, 240);
    if (profile == Profile::ar) limit(given.pivot, {}, 1);
    return given;
}

Purpose purpose_of(const Assertions& given, Profile profile, const Mark& where) {
    const Rows rows = rows_of(profile);
    Purpose purpose;
    for (Assertion& assertion : profiled(given, profile, {}, where).all)
        if (std::any_of(rows.begin(), rows.end(),
                        [&](const auto& row) { return row.first == assertion.property; }))
            purpose.assertions.all.push_back(std::move(assertion));
    constexpr std::array names{"none", "solid",  "printing", "web",   "simulation",
                               "shop", "unreal", "unity",    "godot", "ar"}; // as declared
    purpose.name = names[static_cast<std::size_t>(profile)];
    purpose.is_solid = profile != Profile::web && !is_asset(profile);
    return purpose;
}

} // namespace facetmill::validate_stage
