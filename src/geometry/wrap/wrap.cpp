#include "geometry/wrap/wrap.hpp"

#include "base/error.hpp"
#include "base/math/predicates.hpp"
#include "base/text/readable_numbers.hpp"
#include "geometry/cgal/alpha_wrap.hpp"
#include "geometry/inspect/connectivity.hpp"
#include "geometry/intersect/self_intersections.hpp"
#include "geometry/spatial/rays.hpp"
#include "geometry/spatial/solid_grid.hpp"
#include "geometry/wrap/nearest_attributes.hpp"
#include "mesh/power_scale.hpp"
#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

/// Adds a triangle. Without area, adds its segment or point instead.
void add_face(WrapInput& input, Index a, Index b, Index c) {
    const auto& p = input.positions;
    if (!is_finite(p[a]) || !is_finite(p[b]) || !is_finite(p[c])) return;
    if (!collinear(p[a], p[b], p[c])) {
        input.triangles.push_back({a, b, c});
        return;
    }
    std::array<Index, 2> longest{a, a};
    for (const auto& side : {std::array{a, b}, std::array{b, c}, std::array{c, a}})
        if (const Vec3 d = p[side[1]] - p[side[0]], e = p[longest[1]] - p[longest[0]]; dot(d, d) > dot(e, e))
            longest = side;
    if (p[longest[0]] == p[longest[1]])
        input.points.push_back(a);
    else
        input.segments.push_back(longest);
}

/// The faces of a mesh, or its lines, or its points.
WrapInput input_of(const Mesh& mesh) {
    WrapInput input;
    input.positions = mesh.positions;
    const Mesh flat = mesh.all_triangles() ? Mesh{} : triangulated(mesh);
    const Mesh& triangles = mesh.all_triangles() ? mesh : flat;
    input.triangles.reserve(triangles.face_count());
    for (Index f = 0; f < triangles.face_count(); ++f)
        add_face(input, triangles.vertex(3 * f), triangles.vertex(3 * f + 1), triangles.vertex(3 * f + 2));
    for (std::size_t l = 0; l < mesh.line_count(); ++l) {
        const Index a = mesh.vertex_of_wedge(mesh.lines[2 * l]),
                    b = mesh.vertex_of_wedge(mesh.lines[2 * l + 1]);
        add_face(input, a, a, b);
    }
    if (mesh.corners.empty() && mesh.lines.empty())
        for (Index v = 0; v < mesh.vertex_count(); ++v)
            if (is_finite(mesh.positions[v])) input.points.push_back(v);
    return input;
}

bool nothing_in(const WrapInput& input) {
    return input.triangles.empty() && input.segments.empty() && input.points.empty();
}

/// Everything in the input as triangles, some without area.
Surface surface_of(const WrapInput& input) {
    Surface surface;
    surface.positions = input.positions;
    surface.corners.reserve(3 * (input.triangles.size() + input.segments.size() + input.points.size()));
    for (const auto& t : input.triangles) surface.corners.insert(surface.corners.end(), t.begin(), t.end());
    for (const auto& [a, b] : input.segments) surface.corners.insert(surface.corners.end(), {a, b, b});
    for (const Index v : input.points) surface.corners.insert(surface.corners.end(), {v, v, v});
    return surface;
}

double face_estimate(const Surface& surface, double alpha) {
    const Box box = surface.bounds();
    constexpr std::size_t most_cells = std::size_t{1} << 20;
    const SolidGrid grid(surface, std::max(alpha, box.longest_side() / 256), most_cells);
    const double per_side = grid.cell_size() / alpha;
    constexpr double faces_per_cell = 3; // a torus has 2, a sheet, which gets two sides, about twice as many
    return faces_per_cell * static_cast<double>(grid.touched()) * per_side * per_side;
}

[[noreturn]] void refuse_size(double faces, bool is_estimate, const WrapSettings& s) {
    throw Error(ErrorKind::limit, "E-WRAP-LARGE",
                fmt::format("wrap: the wrap {} {:.3g} faces, but max_faces is {}",
                            is_estimate ? "would have about" : "has more than", faces, grouped(s.max_faces)),
                "raise max_faces, or use a larger alpha: twice the alpha gives about a quarter of the faces");
}

[[noreturn]] void fail_certificate(const std::string& why) {
    throw Error(ErrorKind::stage, "E-WRAP", "wrap: " + why,
                "use a larger offset, or move the part to the origin if its coordinates are far from it");
}

/// Throws unless the surface is closed and manifold, encloses the input, and does not meet itself.
void certify(const Mesh& wrapped, const WrapInput& input) {
    const Connectivity c = connectivity_of(wrapped);
    if (c.uncancelled_edges > 0 || c.boundary_edges > 0 || !c.is_manifold() || c.disagreeing_edges > 0)
        fail_certificate("the wrap is not a closed manifold");
    Surface both = surface_of(wrapped);
    const FaceTree tree(both, FaceTree::Use::rays);
    const auto outside = [&](Index v) { return winding(tree, input.positions[v]) != 1; };
    std::vector<std::uint8_t> used(input.positions.size());
    for (const auto& t : input.triangles)
        for (const Index v : t) used[v] = 1;
    for (const auto& s : input.segments)
        for (const Index v : s) used[v] = 1;
    for (const Index v : input.points) used[v] = 1;
    const auto count = parallel_reduce(
        used.size(), std::size_t{0},
        [&](std::size_t begin, std::size_t end) {
            std::size_t n = 0;
            for (std::size_t v = begin; v < end; ++v) n += used[v] && outside(static_cast<Index>(v));
            return n;
        },
        [](std::size_t a, std::size_t b) { return a + b; }, 1024);
    for (const auto& [a, b] : input.segments)
        if (first_hit(tree, {input.positions[a], input.positions[b]}))
            fail_certificate("the wrap meets an edge of the input");
    if (count > 0)
        fail_certificate(fmt::format("{} points of the input are not inside the wrap", grouped(count)));
    const std::size_t faces = both.size();
    SelfIntersectionSettings settings;
    settings.among.assign(faces, 1);
    settings.among.resize(faces + input.triangles.size(), 0);
    const auto shift = static_cast<Index>(both.positions.size());
    both.positions.insert(both.positions.end(), input.positions.begin(), input.positions.end());
    for (const auto& t : input.triangles)
        for (const Index v : t) both.corners.push_back(shift + v);
    const std::size_t all = both.size();
    const SelfIntersections met = find_self_intersections(std::move(both), all, settings);
    if (met.count > 0)
        fail_certificate(
            fmt::format("{} faces of the wrap meet the input or each other", grouped(met.count)));
}

} // namespace

double wrap_face_estimate(const Mesh& mesh, double alpha) {
    const WrapInput input = input_of(mesh);
    return nothing_in(input) ? 0 : face_estimate(surface_of(input), alpha);
}

WrapResult wrap(const Mesh& mesh, const WrapSettings& settings) {
    if (!(settings.alpha > 0 && settings.offset > 0))
        throw Error(ErrorKind::usage, "E-RANGE", "wrap: alpha and offset must be above 0",
                    "give lengths in scene units");
    WrapInput input = input_of(mesh);
    if (nothing_in(input))
        throw Error(ErrorKind::stage, "E-WRAP", "wrap: there are no points to wrap",
                    "exclude the part with only");
    const PowerScale scale = even_scale(surface_of(input).bounds());
    input.positions = scale(input.positions);
    const double alpha = scale({settings.alpha, 0, 0}).x, offset = scale({settings.offset, 0, 0}).x;
    const double estimate = face_estimate(surface_of(input), alpha);
    const auto most = static_cast<double>(settings.max_faces);
    if (!(estimate <= 3 * most)) refuse_size(estimate, true, settings);
    // A closed surface has half as many vertices as faces. Others are left inside its tetrahedra.
    const WrapSize size{alpha, offset, 4 * settings.max_faces, static_cast<std::size_t>(estimate)};
    WrappedSurface surface = alpha_wrap(input, size);
    if (surface.too_large || surface.triangles.size() > settings.max_faces)
        refuse_size(most, false, settings);

    WrapResult out;
    out.mesh.positions = std::move(surface.points);
    out.mesh.corners.reserve(3 * surface.triangles.size());
    for (const auto& t : surface.triangles)
        out.mesh.corners.insert(out.mesh.corners.end(), t.begin(), t.end());
    certify(out.mesh, input);
    out.mesh.positions = scale.inverse()(out.mesh.positions);
    out.components = component_count(out.mesh);
    if (settings.nearest_attributes)
        out.changes = take_nearest_attributes(out.mesh, mesh);
    else
        for (const auto& a : mesh.attributes)
            out.changes.push_back(
                {a.name, a.domain, AttributeChange::Kind::dropped, "attributes: nearest takes it"});
    return out;
}

} // namespace facetmill
