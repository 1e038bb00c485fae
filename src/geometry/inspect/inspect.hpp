#pragma once
// The properties of a mesh that info, validate, ensure, when and the report share: one struct, one table of
// names.

#include "geometry/inspect/qualities.hpp"
#include "mesh/scene.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

namespace facetmill {

/// All properties of section 7 of the design that are numbers or truths. Of a scene: sums over its parts, and
/// truths that hold for every part; bounds, area and volume in world space.
struct Properties {
    std::int64_t vertices = 0, wedges = 0, edges = 0, faces = 0, triangles = 0;
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
    std::array<std::optional<double>, quality_count> qualities{}; ///< by Quality; only on request
};

struct InspectSettings {
    bool self_intersections = false;
    std::uint32_t qualities = 0; ///< bit q asks for Quality q
};

/// Properties of a mesh in its own space. O(n log n) at most, parallel, never throws for a valid mesh (NaN
/// included).
Properties inspect(const Mesh& mesh, const InspectSettings& settings = {});
/// Of a part in world space; its transform bears on area, volume and bounds.
Properties inspect(const Part& part, const InspectSettings& settings = {});
/// Of all parts in world space (closedness is per part, see the design's section 2).
Properties inspect(const Scene& scene, const InspectSettings& settings = {});

/// What a property is, and so what may be asked of it: a whole number, any number, an angle in degrees or a
/// length, or a range of these; true or false, one of several words, or two corners of a box.
enum class PropertyKind { count, number, angle, length, truth, word, box };

/// An entry of the table of names that users write in validate, ensure and when.
struct Property {
    std::string_view name;
    PropertyKind kind = PropertyKind::count;
    std::string_view help;
    /// The value: truths as 0 and 1, words by their place in `words`; none for a box and when the property
    /// does not apply (volume of an open mesh).
    std::function<std::optional<double>(const Properties&)> get;
    bool costly = false;                      ///< needs InspectSettings::self_intersections
    std::optional<Quality> quality = {};      ///< needs its bit in InspectSettings::qualities
    std::vector<std::string_view> words = {}; ///< of a word
    bool of_scene = false;                    ///< of a scene only; reports tell more of it than the value
    double lowest = 0, highest = HUGE_VAL;    ///< no mesh has a value beyond
    bool truth() const { return kind == PropertyKind::truth; }
};

/// In the order of the design's section 7.
const std::vector<Property>& property_table();
const Property* property_named(std::string_view name);

} // namespace facetmill
