#pragma once
// The fields of each stored record. The bindings name every member, so a new member does not compile until it
// is added here.

#include "cache/archive.hpp"
#include "mesh/cut_memory.hpp"
#include "mesh/scene.hpp"
#include "report/record.hpp"

namespace facetmill::cache {

#define FACETMILL_STORED(Type, ...)                                                                          \
    template <>                                                                                              \
    struct Members<Type> {                                                                                   \
        static void each(auto& record, auto&& take) {                                                        \
            auto& [__VA_ARGS__] = record;                                                                    \
            take(__VA_ARGS__);                                                                               \
        }                                                                                                    \
    };

FACETMILL_STORED(Vec3, x, y, z)
FACETMILL_STORED(Box, min, max)
FACETMILL_STORED(Transform, m)
FACETMILL_STORED(Plane, normal, through, offset)
FACETMILL_STORED(CutMemory, entries)
FACETMILL_STORED(CutMemory::Entry, plane, reach, points)
FACETMILL_STORED(Attribute, name, domain, role, components, normalised, data)
FACETMILL_STORED(Primitive, material, attributes, json)
FACETMILL_STORED(Mesh, positions, wedge_vertex, corners, face_offsets, attributes, primitives, lines,
                 line_primitive)
FACETMILL_STORED(Material, name, base_colour, double_sided, document, index)
FACETMILL_STORED(Document, json, buffers, files, name)
FACETMILL_STORED(Part, name, mesh, transform, document, node, source_mesh, skinned, changed, cuts)
FACETMILL_STORED(Scene, parts, materials, unit, up, documents)

FACETMILL_STORED(AttributeChange, attribute, domain, kind, why)
FACETMILL_STORED(report::Brief, parts, vertices, faces, bounds)
FACETMILL_STORED(report::ResolvedLength, option, given, is)
FACETMILL_STORED(report::PartChange, part, change)
FACETMILL_STORED(io::ByteKinds, geometry, textures, json)
FACETMILL_STORED(report::FileRecord, path, bytes, sha256, read_back, kinds)

/// Stored without its mark, which comes from the step.
template <>
struct Members<Diagnostic> {
    static void each(auto& record, auto&& take) {
        auto& [severity, id, message, where, hint, out_of_memory] = record;
        static_cast<void>(where);
        take(severity, id, message, hint, out_of_memory);
    }
};

/// Stored without data that the run sets for every stage: its name, position and options, times, pictures.
template <>
struct Members<report::StageRecord> {
    static void each(auto& record, auto&& take) {
        auto& [name, stage, path, before, after, attribute_changes, warnings, options, result, resolved, said,
               skipped, seconds, picture, camera, deviation, peak_memory] = record;
        static_cast<void>(name);
        static_cast<void>(stage);
        static_cast<void>(path);
        static_cast<void>(options);
        static_cast<void>(skipped);
        static_cast<void>(seconds);
        static_cast<void>(picture);
        static_cast<void>(camera);
        static_cast<void>(deviation);
        static_cast<void>(peak_memory);
        take(before, after, attribute_changes, warnings, result, resolved, said);
    }
};

#undef FACETMILL_STORED

template <>
inline constexpr Unit last<Unit> = Unit::foot;
template <>
inline constexpr UpAxis last<UpAxis> = UpAxis::z;
template <>
inline constexpr Domain last<Domain> = Domain::face;
template <>
inline constexpr Role last<Role> = Role::index;
template <>
inline constexpr Severity last<Severity> = Severity::note;
template <>
inline constexpr AttributeChange::Kind last<AttributeChange::Kind> = AttributeChange::Kind::dropped;

} // namespace facetmill::cache
