#pragma once
// The report and warnings of crumple.

#include "geometry/crumple/crumple.hpp"
#include "geometry/split/split.hpp"
#include "stage/context.hpp"

#include <span>

namespace facetmill::crumple_stage {

/// A part after the split and before the displacement.
struct CrumpledPart {
    Part* part;
    SplitResult pieces;
    std::vector<Vec3> before;
    Transform to_world;
};

struct CrumpleReportPart : CrumpleResult {
    std::string part;
    std::size_t added_faces = 0, held_vertices = 0;
};

struct CrumpleReport {
    std::optional<AvoidResult> self_intersections;
    std::vector<CrumpleReportPart> parts;
};
void declare_crumple_report(DeclareFields<CrumpleReport>& d);

/// Throws a stage error (E-INTERSECTS) with the first pair of faces that would meet. It names the input
/// faces, each of which became grid * grid faces.
[[noreturn]] void refuse_intersections(const AvoidResult& r, std::span<const CrumpledPart> parts,
                                       std::int64_t grid);

/// Warns of an amplitude larger than the edges: the surface stays connected, but faces intersect. mean_edge:
/// the part's mean edge length before the displacement, in world space.
void warn_of_tangles(const std::string& part, double mean_edge, double amplitude, Context& context);
/// Warns if avoiding intersections moves a vertex by more than 1 % of the amplitude. It rounds positions to
/// float32, which is coarse far from the origin.
void warn_of_rounding(const CrumpledPart& part, const CrumpleMoves& moves, double amplitude,
                      Context& context);
/// Warns when shares were lowered in large steps to bound the work.
void warn_of_coarse_steps(const AvoidResult& r, Context& context);
/// Warns of concave quads, which cannot be split n x n without folds.
void warn_of_folds(const CrumpledPart& part, Context& context);
/// Warns if parts are so close that their faces may now intersect.
void warn_of_parts(const Scene& scene, Context& context);

} // namespace facetmill::crumple_stage
