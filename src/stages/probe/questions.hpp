#pragma once
// What probe asks and what it asks it of, from its options and the scene.

#include "geometry/probe/probe.hpp"
#include "stages/probe/options.hpp"

namespace facetmill {

/// The surface that is asked, and the parts that bring points with them.
struct Questions {
    std::vector<const Part*> surface, sources;
};

/// Usage error (E-PART) when points_of names no part.
Questions questions_of(const Scene& scene, const ProbeOptions& o, const Context& context);

/// The points of the option or its file, or the vertices of the sources; world space.
std::vector<Vec3> points_asked(const ProbeOptions& o, const Questions& q, Context& context);
/// The segments or rays of the option or its file.
std::vector<Line> lines_asked(const ProbeOptions& o, Context& context);
/// Rays from the vertices of all parts of the surface along the attribute `along`, of length 1. Stage error
/// (E-ATTRIBUTE) when a part has no such attribute.
std::vector<Line> lines_along(const ProbeOptions& o, const Questions& q);
/// The corners of a face, parts counted through, in world space. Usage error (E-FACE) when there is no such
/// face.
std::vector<Vec3> facet_asked(const Questions& q, std::int64_t number);

} // namespace facetmill
