#include "geometry/remesh/remesh.hpp"

#include "base/math/numbers.hpp"
#include "base/math/portable_math.hpp"
#include "base/progress.hpp"
#include "geometry/edit/equal_wedges.hpp"
#include "geometry/intersect/self_intersections.hpp"
#include "geometry/normals/normals.hpp"
#include "geometry/remesh/features.hpp"
#include "geometry/remesh/passes.hpp"
#include "geometry/remesh/sizing.hpp"
#include "geometry/transfer/transfer.hpp"
#include "mesh/topology.hpp"
#include "parallel/memory.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

using namespace remeshing;

RemeshSettings completed(RemeshSettings s, const Mesh& mesh) {
    if (s.length > 0) return s;
    if (!(s.max_length > 0)) s.max_length = mesh.bounds().diagonal() / 20;
    if (!(s.min_length > 0)) s.min_length = s.tolerance;
    s.min_length = std::min(s.min_length, s.max_length);
    return s;
}

/// Sharp lines shorter than this are noise: two edges, but never more than a 20th of the diagonal.
double longest_noise(const RemeshSettings& s, const Mesh& mesh) {
    return std::min(2 * (s.length > 0 ? s.length : s.min_length), mesh.bounds().diagonal() / 20);
}

constexpr double most_faces = 700e6; // three half edges for each, numbered in 32 bits, and a reserve

/// Refuses a result that is too large, before any work on it.
void refuse_giant_result(double faces) {
    constexpr double bytes_per_face = 200; // of the working mesh at its largest
    const char* const hint = "give a larger length or tolerance";
    if (!(faces <= most_faces))
        throw Error(
            ErrorKind::limit, "E-LIMIT",
            fmt::format("remesh: the result would have about {:.3g} faces, but at most {:.3g} are possible",
                        faces, most_faces),
            hint);
    if (is_much_memory(bytes_per_face * faces))
        require_memory(bytes_per_face * faces, fmt::format("remesh: a result of about {:.3g} faces", faces),
                       hint);
}

void iterate(WorkingMesh& m, const Anchor& anchor, int iterations) {
    for (int i = 0; i < iterations; ++i) {
        ProgressScope::report(static_cast<double>(i) / iterations);
        split_long_edges(m, anchor);
        collapse_short_edges(m, anchor);
        m.compact();
        flip_towards_six(m);
        relocate(m, anchor);
    }
    constexpr int refinements = 2;
    for (int i = 0; i < refinements; ++i) {
        flip_for_shape(m);
        relocate(m, anchor);
    }
    flip_for_shape(m);
}

/// Gives corners on the two sides of a seam separate wedges.
void set_wedges_at_seams(Mesh& out, const WorkingMesh& m) {
    DisjointSets sets(m.corners.size());
    for (Index h = 0; h < m.corners.size(); ++h) {
        const Index twin = m.twins[h];
        if (twin == none || m.flags[h] & seam || twin < h) continue;
        sets.join(h, WorkingMesh::next(twin));
        sets.join(WorkingMesh::next(h), twin);
    }
    std::vector<Index> wedge_of(m.corners.size(), none);
    for (Index c = 0; c < m.corners.size(); ++c) {
        Index& wedge = wedge_of[sets.find(c)];
        if (wedge == none) {
            wedge = static_cast<Index>(out.wedge_vertex.size());
            out.wedge_vertex.push_back(m.corners[c]);
        }
        out.corners[c] = wedge;
    }
}

/// The finished mesh with the attributes of the input.
Mesh finished(const Mesh& input, const FaceTree& tree, const LaidOut& laid, AttributeChanges& changes) {
    const WorkingMesh& m = laid.mesh;
    Mesh out;
    out.positions = m.points;
    out.corners = m.corners;
    if (input.has_seams()) set_wedges_at_seams(out, m);
    out.primitives = input.primitives;
    if (input.attributes.empty() || out.corners.empty()) return out;
    const NearestSources sources = nearest_sources(input, tree, out, {laid.regions_of_faces, m.regions});
    changes = inherit_attributes(out, input, sources.provenance);
    if (input.has_seams()) {
        merge_equal_wedges(out);
        normalise_wedges(out);
    }
    return out;
}

void measure_edges(const WorkingMesh& m, RemeshResult& result) {
    double sum = 0;
    std::size_t count = 0;
    result.shortest = HUGE_VAL;
    for (Index h = 0; h < m.corners.size(); ++h) {
        if (!m.stands(h)) continue;
        const double size = m.edge_length(h);
        result.shortest = std::min(result.shortest, size);
        result.longest = std::max(result.longest, size);
        sum += size;
        ++count;
        result.feature_edges += (m.flags[h] & feature) != 0;
    }
    if (count == 0) result.shortest = 0;
    result.mean = count > 0 ? sum / static_cast<double>(count) : 0;
}

void check(const RemeshSettings& s) {
    const auto refuse = [](const char* option, double found) {
        throw_refusal(
            "remesh",
            Refusal{option, fmt::format("{} is out of range: {}", option, to_string(found)), {}, "E-RANGE"});
    };
    if (!(s.length >= 0) || !std::isfinite(s.length)) refuse("length", s.length);
    if (!(s.tolerance >= 0) || !std::isfinite(s.tolerance)) refuse("tolerance", s.tolerance);
    if (!(s.length > 0) && !(s.tolerance > 0)) refuse("length", s.length);
    if (s.iterations < 0) refuse("iterations", s.iterations);
}

SelfIntersections intersections_of(Surface surface) {
    constexpr std::size_t listed = 100000;
    const std::size_t faces = surface.size();
    return find_self_intersections(std::move(surface), faces, {.limit = listed});
}

/// Halves the intended lengths at the faces of the input that are nearest to intersecting faces.
void shorten(std::vector<double>& sizes, const Mesh& input, const FaceTree& tree, const WorkingMesh& m,
             const SelfIntersections& found) {
    std::vector<std::uint8_t> near(sizes.size());
    for (const auto& [f, g] : found.pairs)
        for (const Index face : {f, g})
            for (Index k = 0; k < 3; ++k) {
                const Closest at = closest_point(tree, m.points[m.corners[3 * face + k]]);
                if (at.face == none) continue;
                for (Index c = 0; c < 3; ++c) near[input.vertex(3 * at.face + c)] = 1;
            }
    for (Index v = 0; v < sizes.size(); ++v)
        if (near[v]) sizes[v] /= 2;
}

/// Iterates, again with shorter edges where faces of the result intersect, unless the input intersects
/// itself. The layout of the mesh, with sizes, becomes the result.
void remesh_until_sound(const Mesh& mesh, const FaceTree& tree, const RemeshSettings& settings, LaidOut& laid,
                        RemeshResult& result) {
    std::vector<double> sizes = laid.mesh.sizes;
    constexpr int most_retries = 3;
    for (int retry = 0;; ++retry) {
        WorkingMesh& m = laid.mesh;
        iterate(m, Anchor(mesh, tree, m), settings.iterations);
        m.compact();
        const SelfIntersections found = intersections_of({m.points, m.corners, {}});
        if (found.count > 0 && retry == 0)
            result.input_intersects = intersections_of(surface_of(mesh)).count > 0;
        result.intersections = found.count;
        result.retries = retry;
        if (found.count == 0 || result.input_intersects || retry == most_retries) return;
        shorten(sizes, mesh, tree, m, found);
        LaidOut again = lay_out(mesh, settings.feature_angle, longest_noise(settings, mesh));
        grade(again.mesh, sizes);
        const double expected = expected_faces(again.mesh, sizes);
        if (!(expected <= most_faces)) return; // this result stays, with a warning
        again.mesh.sizes = sizes;
        again.mesh.hints.assign(again.mesh.points.size(), none);
        result.expected_faces = expected;
        laid = std::move(again);
    }
}

/// Restores the normals of a flat-shaded mesh.
void settle_flat_normals(Mesh& mesh, AttributeChanges& changes) {
    if (!mesh.find("NORMAL", Domain::wedge)) return;
    set_facet_normals(mesh);
    for (AttributeChange& change : changes)
        if (change.attribute == "NORMAL" && change.domain == Domain::wedge) {
            change.kind = AttributeChange::Kind::recomputed;
            change.why = "flat shading: the normals of the new faces";
        }
}

} // namespace

RemeshResult remesh(Mesh mesh, const RemeshSettings& given) {
    check(given);
    const RemeshSettings settings = completed(given, mesh);
    RemeshResult result;
    ProgressSteps steps({2, 10, 2});
    if (!mesh.all_triangles()) mesh = triangulated(mesh);
    NormalSeams::Shading shading = NormalSeams::Shading::as_given;
    if (mesh.has_seams() && mesh.find("NORMAL", Domain::wedge))
        shading = merge_normal_seams(mesh, settings.feature_angle).shading;
    LaidOut laid = lay_out(mesh, settings.feature_angle, longest_noise(settings, mesh));
    WorkingMesh& m = laid.mesh;
    m.sizes = intended_sizes(m, settings);
    m.hints.assign(m.points.size(), none);
    result.expected_faces = expected_faces(m, m.sizes);
    result.locked_edges = laid.locked_edges;
    result.dropped_faces = laid.dropped_faces;
    refuse_giant_result(result.expected_faces);
    const FaceTree tree(surface_of(mesh), FaceTree::Use::near);
    if (tree.empty() || !(result.expected_faces > 0)) {
        result.changes = kept_changes(mesh.attributes);
        result.mesh = std::move(mesh);
    } else {
        steps.next();
        remesh_until_sound(mesh, tree, settings, laid, result);
        steps.next();
        measure_edges(m, result);
        result.mesh = finished(mesh, tree, laid, result.changes);
    }
    if (shading == NormalSeams::Shading::faceted) settle_flat_normals(result.mesh, result.changes);
    return result;
}

} // namespace facetmill
