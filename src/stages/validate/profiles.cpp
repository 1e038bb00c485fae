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

Rows rows_of(Profile profile) {
    const Rows sound = sound_rows();
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
        // The web profile judges optional attributes only if they exist.
        if (!known) given.all.push_back({name, bound, where, profile == Profile::web});
    }
    return given;
}

Purpose purpose_of(const Assertions& given, Profile profile, const Mark& where) {
    const Rows rows = rows_of(profile);
    Purpose purpose;
    for (Assertion& assertion : profiled(given, profile, {}, where).all)
        if (std::any_of(rows.begin(), rows.end(),
                        [&](const auto& row) { return row.first == assertion.property; }))
            purpose.assertions.all.push_back(std::move(assertion));
    constexpr std::array names{"none", "solid", "printing", "web", "simulation"}; // as declared
    purpose.name = names[static_cast<std::size_t>(profile)];
    purpose.is_solid = profile != Profile::web;
    return purpose;
}

} // namespace facetmill::validate_stage
