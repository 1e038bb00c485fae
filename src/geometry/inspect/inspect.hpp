#pragma once
// The properties of a mesh used by info, validate, ensure, when, the report and the manual: a struct of
// values, and a table with a row for each property.

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
    std::int64_t lines = 0;      ///< lines of parts without faces
    std::int64_t components = 0; ///< components connected through vertices, without isolated vertices
    std::int64_t euler = 0;      ///< V - E + F, where V excludes isolated vertices
    std::optional<std::int64_t>
        genus; ///< components - euler / 2, if closed, edge- and vertex-manifold and oriented
    std::int64_t boundary_loops = 0, boundary_edges = 0;
    bool closed = true;          ///< the directions of the faces cancel at every edge
    bool edge_manifold = true;   ///< at most two faces at an edge
    bool vertex_manifold = true; ///< the faces around each vertex form a single fan
    bool oriented = true; ///< neighbours agree: at each edge, the numbers of faces in both directions differ
                          ///< by at most one
    std::int64_t degenerate_faces =
        0; ///< faces with exactly zero area (a repeated vertex, or collinear corners by an exact test)
    std::int64_t duplicate_faces = 0; ///< faces beyond the first with the same set of vertices
    std::int64_t isolated_vertices = 0;
    std::optional<std::int64_t> self_intersections; ///< pairs of faces; only on request
    std::optional<std::int64_t> touching;           ///< pairs that only touch; set with self_intersections
    double area = 0;
    std::optional<double> volume; ///< signed volume, if closed
    Box bounds;
    std::optional<std::int64_t> parts, materials; ///< these four exist only for a scene
    std::optional<Unit> unit;
    std::optional<UpAxis> up;
    /// The requested properties that apply, with their values.
    std::vector<std::pair<const Property*, double>> requested;
};

struct InspectSettings {
    bool self_intersections = false;
    std::vector<const Property*> requested = {}; ///< measured only on request
    /// The mesh is one of several components of a solid. A component with negative volume is a cavity.
    bool part_of_solid = false;

    /// Requests everything that the property needs.
    void request(const Property& property);
};

/// Properties of a mesh in its own space. O(n log n) at most, parallel, never throws for a valid mesh (NaN
/// included).
[[nodiscard]] Properties inspect(const Mesh& mesh, const InspectSettings& settings = {});
/// Inspects a part in world space; its transform affects area, volume and bounds.
[[nodiscard]] Properties inspect(const Part& part, const InspectSettings& settings = {});
/// Inspects all parts in world space. Closedness is a property of each part: see docs/architecture.md, "What
/// flows".
[[nodiscard]] Properties inspect(const Scene& scene, const InspectSettings& settings = {});

/// Properties of the components with the most faces, in the mesh's own space, the largest first. Equal
/// components are sorted by their lowest face. Isolated vertices belong to no component. O(n log n).
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
    word,   ///< one of several words
    box,    ///< two corners, in scene units
};
/// The unit as text: "degrees", "scene units"; empty without a unit.
[[nodiscard]] std::string_view unit_of(PropertyKind kind);

/// How the values of parts are combined to the value of a scene.
enum class Join {
    sum,
    sum_if_all, ///< the sum, only if every part has a value
    least,
    most,
    all,      ///< true if true for all parts
    around,   ///< a box around all
    of_scene, ///< parts have no value; it belongs to the scene
};

/// Whether a boolean, or a count of defects, is part of soundness.
enum class Soundness {
    none,
    file,   ///< property that writing to a file must not lose
    surface ///< like `file`, and also required of every surface for further processing
};

/// A mesh that is measured.
struct Measured {
    const Mesh& world; ///< the mesh in world space
    const Mesh& local; ///< the mesh in its own space: only its own orientation counts, not a mirroring node
    const Properties& properties; ///< the properties that are measured without a request
    const InspectSettings& settings;
};

/// A property: a row of the table. Its value is either a member of Properties, which inspect fills in a
/// single pass, or comes from a separate function on request.
struct Property {
    using Member = std::variant<std::monostate, std::int64_t Properties::*, bool Properties::*,
                                double Properties::*, std::optional<std::int64_t> Properties::*,
                                std::optional<double> Properties::*, std::optional<Unit> Properties::*,
                                std::optional<UpAxis> Properties::*, Box Properties::*>;
    using LocationsOf = std::vector<Location> (*)(const Mesh& local, const LocationQuery& query);
    using EvidenceOf = std::vector<Evidence> (*)(const Scene& scene, const EvidenceQuery& query);

    std::string_view name; ///< as users write it
    /// Names in other programs for the property, and for its opposite, separated by blanks. Only for hints.
    std::string_view also_called = {}, opposite = {};
    PropertyKind kind = PropertyKind::count;
    Join join = Join::sum;
    std::string_view help; ///< for the manual
    std::string_view hint; ///< the stage that fixes it
    std::string_view mend =
        {}; ///< stages, in the syntax of `facetmill pipe`, that fix it; empty: no stage certainly does
    Member member = {};
    bool costly = false;    ///< a member that needs InspectSettings::self_intersections
    bool is_size = false;   ///< a measure of size, not of connectivity
    bool where_any = false; ///< a count that is reported only if it is not 0
    Soundness soundness = Soundness::none;
    /// Measures the value on request. None if it does not apply (no faces, no such attribute). Truths are 0
    /// and 1.
    std::optional<double> (*measure)(const Measured& mesh) = nullptr;
    /// Measures the value of each face on request. The property is the minimum or maximum, depending on its
    /// Join. Infinity if it does not apply. The mesh has a size near 1; lengths are scaled back.
    std::vector<double> (*of_faces)(const Mesh& mesh) = nullptr;
    /// Finds the locations where the property fails. Null if it has no locations (properties with of_faces
    /// have their own search).
    LocationsOf locations = nullptr;
    /// Finds the evidence of a failed check. Null: locations, otherwise the contributions of the parts.
    EvidenceOf evidence = nullptr;
    /// The number of locations is shown next to the value, because the value does not include it.
    bool counts_locations = false;
    double lowest = 0, highest = HUGE_VAL; ///< no mesh has a value outside this range
    /// For a word: the possible words, by the enumeration's value.
    std::vector<std::string_view> (*words)() = nullptr;

    bool truth() const { return kind == PropertyKind::truth; }
    bool of_scene() const { return join == Join::of_scene; }
    bool on_request() const { return measure || of_faces; }
    /// The value. Truths are 0 and 1, and words are indices in `words`. None for a box, for a value that was
    /// not requested, and if it does not apply (volume of an open mesh).
    std::optional<double> get(const Properties& properties) const;
};

/// All properties, in the order of `info` and the report; see "The rooms" in docs/architecture.md.
[[nodiscard]] std::span<const Property> property_table();
[[nodiscard]] std::vector<Synonyms> synonyms_of(const Property& property);
/// The names of all properties, for hints.
[[nodiscard]] std::vector<KnownName> known_properties();
/// The property with this name, or null.
[[nodiscard]] const Property* property_named(std::string_view name);

/// [faces] The values of a property of faces (Property::of_faces), for meshes of any size. Parallel.
[[nodiscard]] std::vector<double> face_values(const Mesh& mesh, const Property& property);

/// The value of a property measured on request, for a mesh in world space. Parallel.
[[nodiscard]] std::optional<double> measure(const Mesh& mesh, const Property& property);

} // namespace facetmill
