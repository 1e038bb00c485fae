#pragma once
// The properties of a mesh used by info, validate, ensure, when, the report and the manual: a struct of
// values, and a table with one row for each.

#include "mesh/scene.hpp"
#include "options/synonyms.hpp"

#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace facetmill {

struct Property;
struct Location;
struct LocationQuery;
struct Evidence;
struct EvidenceQuery;

/// The values of properties. For a scene, the values of its parts are joined according to each property's
/// row; bounds, area and volume are in world space.
struct Properties {
    std::int64_t vertices = 0, wedges = 0, edges = 0, faces = 0, triangles = 0;
    std::int64_t lines = 0;      ///< of parts without faces
    std::int64_t components = 0; ///< connected through vertices; isolated vertices are not counted
    std::int64_t euler = 0;      ///< V - E + F, V without isolated vertices
    std::optional<std::int64_t>
        genus; ///< when closed, edge- and vertex-manifold and oriented: components - euler / 2
    std::int64_t boundary_loops = 0, boundary_edges = 0;
    bool closed = true;          ///< at every edge the directions of its faces cancel
    bool edge_manifold = true;   ///< at most two faces at an edge
    bool vertex_manifold = true; ///< the faces around each vertex form one fan: edges link them all
    bool oriented =
        true; ///< neighbours agree: the faces that run along an edge either way differ by at most one
    std::int64_t degenerate_faces = 0; ///< exactly zero area (repeated vertex, or collinear: exact test)
    std::int64_t duplicate_faces = 0;  ///< faces beyond the first with the same set of vertices
    std::int64_t isolated_vertices = 0;
    std::optional<std::int64_t> self_intersections; ///< pairs of faces; only on request
    std::optional<std::int64_t> touching;           ///< pairs that touch only; with self_intersections
    double area = 0;
    std::optional<double> volume; ///< signed, when closed
    Box bounds;
    std::optional<std::int64_t> parts, materials; ///< these four of a scene only
    std::optional<Unit> unit;
    std::optional<UpAxis> up;
    /// The requested properties that apply, with their values.
    std::vector<std::pair<const Property*, double>> requested;
};

struct InspectSettings {
    bool self_intersections = false;
    std::vector<const Property*> requested = {}; ///< measured only on request
    /// The mesh is one of several components of a solid: one of negative volume is a cavity of it.
    bool part_of_solid = false;

    /// Asks for whatever the property needs.
    void request(const Property& property);
};

/// Properties of a mesh in its own space. O(n log n) at most, parallel, never throws for a valid mesh (NaN
/// included).
[[nodiscard]] Properties inspect(const Mesh& mesh, const InspectSettings& settings = {});
/// Inspects a part in world space; its transform affects area, volume and bounds.
[[nodiscard]] Properties inspect(const Part& part, const InspectSettings& settings = {});
/// Of all parts in world space (closedness is a property of a part: docs/architecture.md, "What flows").
[[nodiscard]] Properties inspect(const Scene& scene, const InspectSettings& settings = {});

/// Properties of the components of a mesh with most faces, in its own space, the largest first (of equal ones
/// the one of the lowest face); isolated vertices belong to none. O(n log n).
[[nodiscard]] std::vector<Properties> inspect_components(const Mesh& mesh, std::size_t limit);

/// The kind of a property's value, which decides its unit and the valid conditions.
enum class PropertyKind {
    count,  ///< a whole number
    number, ///< any number, without a unit
    angle,  ///< in degrees
    length, ///< in scene units
    area,   ///< in square scene units
    volume, ///< in cubic scene units
    truth,  ///< true or false
    word,   ///< one of several
    box,    ///< two corners, in scene units
};
/// "degrees", "scene units"; empty where there is none.
[[nodiscard]] std::string_view unit_of(PropertyKind kind);

/// How the values of parts are combined to the value of a scene.
enum class Join {
    sum,
    sum_if_all, ///< of a scene only when every part has one
    least,
    most,
    all,      ///< a truth holds when it holds for all parts
    around,   ///< a box around all
    of_scene, ///< parts have none: it is about the scene
};

/// Whether a boolean, or a count of defects, is part of soundness.
enum class Soundness {
    none,
    file,   ///< property that writing to a file must not lose
    surface ///< as file, and required of every surface for further processing
};

/// A mesh that is measured.
struct Measured {
    const Mesh& world;            ///< where it stands
    const Mesh& local;            ///< as it is: its orientation counts, mirrored by its node or not
    const Properties& properties; ///< all that is measured without a request
    const InspectSettings& settings;
};

/// One property: all that is known of it, in one row. Its value is either a member of Properties, which the
/// one pass of inspect fills, or has a function of its own, called on request.
struct Property {
    using Member = std::variant<std::monostate, std::int64_t Properties::*, bool Properties::*,
                                double Properties::*, std::optional<std::int64_t> Properties::*,
                                std::optional<double> Properties::*, std::optional<Unit> Properties::*,
                                std::optional<UpAxis> Properties::*, Box Properties::*>;
    using LocationsOf = std::vector<Location> (*)(const Mesh& local, const LocationQuery& query);
    using EvidenceOf = std::vector<Evidence> (*)(const Scene& scene, const EvidenceQuery& query);

    std::string_view name; ///< as users write it
    /// What other programs call it, and call the opposite of it, separated by blanks. For hints only.
    std::string_view also_called = {}, opposite = {};
    PropertyKind kind = PropertyKind::count;
    Join join = Join::sum;
    std::string_view help; ///< for the manual
    std::string_view hint; ///< the stage that fixes it
    std::string_view mend =
        {}; ///< stages as `facetmill pipe` takes them that do so; empty: none does for sure
    Member member = {};
    bool costly = false;    ///< a member that needs InspectSettings::self_intersections
    bool is_size = false;   ///< how much there is, rather than how it hangs together
    bool where_any = false; ///< a count that is reported only if it is not 0
    Soundness soundness = Soundness::none;
    /// On request: the value; none when it does not apply (no faces, no such attribute). Truths as 0 and 1.
    std::optional<double> (*measure)(const Measured& mesh) = nullptr;
    /// On request: the value of each face; the property is the least or most of them, as they join. Infinity
    /// where it does not apply. The mesh is near 1 in size; lengths are scaled back.
    std::vector<double> (*of_faces)(const Mesh& mesh) = nullptr;
    /// The locations where it fails, null if it has none (properties with of_faces have their own search).
    LocationsOf locations = nullptr;
    /// The evidence of a failed check; null: locations, else the contributions of the parts.
    EvidenceOf evidence = nullptr;
    /// The number of locations is shown next to the value, because the value does not include it.
    bool counts_locations = false;
    double lowest = 0, highest = HUGE_VAL; ///< no mesh has a value beyond
    /// For a word: the possible words, by the enumeration's value.
    std::vector<std::string_view> (*words)() = nullptr;

    bool truth() const { return kind == PropertyKind::truth; }
    bool of_scene() const { return join == Join::of_scene; }
    bool on_request() const { return measure || of_faces; }
    /// The value: truths as 0 and 1, words by their place in `words`; none for a box, when it was not asked
    /// for and when it does not apply (volume of an open mesh).
    std::optional<double> get(const Properties& properties) const;
};

/// In the order in which `info` and the report list them; see "The rooms" in docs/architecture.md.
[[nodiscard]] std::span<const Property> property_table();
[[nodiscard]] std::vector<Synonyms> synonyms_of(const Property& property);
/// The names of all properties, for hints.
[[nodiscard]] std::vector<KnownName> known_properties();
/// Null when there is none of that name.
[[nodiscard]] const Property* property_named(std::string_view name);

/// [faces] The values of a property that faces have (Property::of_faces), of meshes of any size. Parallel.
[[nodiscard]] std::vector<double> face_values(const Mesh& mesh, const Property& property);

/// The value for a mesh in world space of a property that is measured on request. Parallel.
[[nodiscard]] std::optional<double> measure(const Mesh& mesh, const Property& property);

} // namespace facetmill
