#include "geometry/inspect/qualities.hpp"

#include "base/portable_math.hpp"
#include "base/parallel.hpp"
#include "base/random.hpp"
#include "geometry/edit/around_edge.hpp"
#include "geometry/inspect/attribute_qualities.hpp"
#include "geometry/inspect/boundary.hpp"
#include "geometry/clean/steps.hpp"
#include "geometry/orient/orient.hpp"
#include "geometry/inspect/place_keys.hpp"
#include "mesh/power_scale.hpp"
#include "geometry/intersect/self_intersections.hpp"
#include "geometry/inspect/uv_overlaps.hpp"
#include "geometry/inspect/wall_thickness.hpp"
#include "mesh/bare.hpp"

#include <algorithm>
#include <array>

namespace facetmill {

namespace {

using Pairs = std::vector<std::pair<Index, Index>>;

constexpr double degrees = 180 / pi;

/// Calls body(a, b, c) for the triangles of a face.
template <class Body>
void each_triangle(const Mesh& mesh, Index f, Body&& body) {
    const Index begin = mesh.face_begin(f);
    for (Index c = begin + 1; c + 1 < mesh.face_end(f); ++c)
        body(mesh.point(begin), mesh.point(c), mesh.point(c + 1));
}

double angle(const Vec3& at, const Vec3& b, const Vec3& c) {
    return arc_tangent(length(cross(b - at, c - at)), dot(b - at, c - at)) * degrees;
}

double corner_angle(const Mesh& mesh, Index f, Index c) {
    return angle(mesh.point(c), mesh.point(c == mesh.face_begin(f) ? mesh.face_end(f) - 1 : c - 1),
                 mesh.point(next_corner(mesh, f, c)));
}

double aspect_ratio(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double x = length(b - a), y = length(c - b), z = length(a - c),
                 area = length(cross(b - a, c - a)) / 2;
    const double longest = std::max({x, y, z});
    return area > 0 ? longest * (x + y + z) / (4 * std::sqrt(3.0) * area) : HUGE_VAL;
}

double planarity(const Mesh& mesh, Index f) {
    if (mesh.face_size(f) == 3) return 0;
    const Vec3 normal = normalised(area_vector(mesh, f));
    Vec3 middle;
    for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) middle += mesh.point(c) / mesh.face_size(f);
    double farthest = 0;
    for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
        farthest = std::max(farthest, std::abs(dot(mesh.point(c) - middle, normal)));
    return farthest;
}

/// The value of one face, for qualities that are the least or the largest of all faces.
double of_face(const Mesh& mesh, Quality q, Index f) {
    const bool least = info_of(q).join == Join::least;
    double value = least ? HUGE_VAL : 0;
    const auto take = [&](double x) { value = least ? std::min(value, x) : std::max(value, x); };
    if (q == Quality::planarity) return planarity(mesh, f);
    if (q == Quality::aspect_ratio)
        each_triangle(mesh, f,
                      [&](const Vec3& a, const Vec3& b, const Vec3& c) { take(aspect_ratio(a, b, c)); });
    else
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
            take(q == Quality::min_angle || q == Quality::max_angle
                     ? corner_angle(mesh, f, c)
                     : length(mesh.point(next_corner(mesh, f, c)) - mesh.point(c)));
    return value;
}

std::vector<double> face_values(const Mesh& mesh, Quality q) {
    if (const PowerScale scale = even_scale(mesh.bounds()); !scale.none()) {
        auto values = face_values(scale(mesh), q);
        if (info_of(q).measure == Measure::length)
            for (double& x : values) x = unscaled(x, scale.powers[0]);
        return values;
    }
    if (q == Quality::wall_thickness) return wall_thickness(mesh);
    std::vector<double> values(mesh.face_count());
    parallel_for(values.size(), [&](std::size_t f) { values[f] = of_face(mesh, q, static_cast<Index>(f)); });
    return values;
}

/// The pairs of neighbours that lie on each other, the lower face first.
Pairs folded_faces(const Mesh& mesh) {
    const auto edges = build_edges(mesh);
    const auto faces = corner_faces(mesh);
    std::vector<std::uint8_t> folded(edges.size(), 0);
    parallel_for(edges.size(), [&](std::size_t e) {
        const auto corners = edges.corners_of(static_cast<Index>(e));
        if (corners.size() != 2) return;
        const Index f = faces[corners[0]], g = faces[corners[1]];
        if (f == g || is_degenerate(mesh, f) || is_degenerate(mesh, g)) return;
        const Vec3 &u = mesh.positions[edges.edges[e].low], &v = mesh.positions[edges.edges[e].high];
        const Vec3 p = beside_edge(mesh, f, corners[0]), q = beside_edge(mesh, g, corners[1]);
        folded[e] = orientation_3d(u, v, p, q) == 0 && on_same_side(u, v, p, q);
    });
    Pairs list;
    for (Index e = 0; e < folded.size(); ++e)
        if (folded[e])
            list.push_back(std::minmax(faces[edges.corners_of(e)[0]], faces[edges.corners_of(e)[1]]));
    std::sort(list.begin(), list.end());
    return list;
}

/// The intersecting pairs that lie in one plane.
Pairs coplanar_overlaps(const Mesh& mesh) {
    Pairs list;
    for (const auto& [f, g] :
         find_self_intersections(mesh, {.limit = std::size_t{1} << 24, .apart = true}).pairs) {
        const Index begin = mesh.face_begin(f);
        bool flat = true;
        for (Index c = mesh.face_begin(g); c < mesh.face_end(g); ++c)
            for (Index k = begin + 1; k + 1 < mesh.face_end(f); ++k)
                flat = flat && orientation_3d(mesh.point(begin), mesh.point(k), mesh.point(k + 1),
                                              mesh.point(c)) == 0;
        if (flat) list.emplace_back(f, g);
    }
    return list;
}

std::vector<Index> inward_faces(const Mesh& mesh) {
    const OrientResult r = orient(bare(mesh), {});
    std::vector<Index> list;
    for (const auto& piece : r.pieces)
        if (!piece.orientable || piece.flipped > 0) list.push_back(piece.first_face);
    return list;
}

std::optional<double> count(const Pairs& list) { return static_cast<double>(list.size()); }

constexpr std::array<QualityInfo, quality_count> table{{
    {"min_angle", Join::least, "The smallest angle of a face, in degrees.", Measure::angle},
    {"max_angle", Join::most, "The largest angle of a face, in degrees.", Measure::angle},
    {"aspect_ratio", Join::most, "The worst ratio of longest edge to inner radius; 1 for equal sides."},
    {"shortest_edge", Join::least, "The length of the shortest edge.", Measure::length},
    {"longest_edge", Join::most, "The length of the longest edge.", Measure::length},
    {"planarity", Join::most, "How far a corner lies from the mean plane of its polygon, at most.",
     Measure::length},
    {"folded_faces", Join::sum, "Pairs of neighbours folded flat onto each other, exactly.", Measure::count},
    {"t_vertices", Join::sum, "Vertices exactly on an open edge of another face.", Measure::count},
    {"boundary_length", Join::sum, "The length of all open edges.", Measure::length},
    {"longest_boundary", Join::most, "The length of the longest chain of open edges.", Measure::length},
    {"outward", Join::all, "Every piece has its front outside (cavities: inside), as orient would turn it."},
    {"coplanar_overlaps", Join::sum, "Pairs of faces that overlap in one plane, exactly.", Measure::count},
    {"wall_thickness", Join::least, "The least way through the solid, from the middles of faces straight in.",
     Measure::length},
    {"uvs_in_range", Join::all, "All texture coordinates lie within 0 and 1."},
    {"uv_overlaps", Join::sum,
     "Pairs of faces that overlap in the first set of texture coordinates, exactly.", Measure::count},
    {"finite_attributes", Join::all, "No attribute has a number that is not finite."},
    {"unit_normals", Join::all, "All normals and tangents have length 1, to 1/127."},
    {"weights_sum", Join::all, "The joint weights of every wedge sum to 1, to 1/255."},
    {"joints", Join::most, "Joints that the weights refer to: the highest number and one.", Measure::count},
    {"extent", Join::most, "The longest side of a part's box.", Measure::length},
}};

} // namespace

bool is_by_face(Quality q) { return q <= Quality::planarity || q == Quality::wall_thickness; }

const QualityInfo& info_of(Quality quality) { return table[static_cast<std::size_t>(quality)]; }

std::optional<double> measure(const Mesh& mesh, Quality q) {
    if (is_by_face(q)) {
        std::optional<double> best;
        const bool least = info_of(q).join == Join::least;
        for (const double x : face_values(mesh, q))
            if (!best || (least ? x < *best : x > *best)) best = x;
        if (q == Quality::wall_thickness && best == HUGE_VAL) return {};
        return best;
    }
    if (is_of_attributes(q)) return measure_attributes(mesh, q);
    switch (q) {
    case Quality::folded_faces:
        return count(folded_faces(mesh));
    case Quality::t_vertices:
        return static_cast<double>(clean_steps::find_t_vertices(mesh, 0).size());
    case Quality::coplanar_overlaps:
        return count(coplanar_overlaps(mesh));
    case Quality::outward:
        return inward_faces(mesh).empty() ? 1 : 0;
    case Quality::uv_overlaps: {
        const auto overlaps = uv_overlaps(mesh);
        return overlaps ? count(*overlaps) : std::nullopt;
    }
    case Quality::extent: {
        const Vec3 e = mesh.bounds().extent();
        return std::max({e.x, e.y, e.z});
    }
    default: {
        double sum = 0, most = 0;
        for (const BoundaryChain& c : boundary_chains(mesh)) sum += c.length, most = std::max(most, c.length);
        return q == Quality::boundary_length ? sum : most;
    }
    }
}

namespace {

/// The faces with the worst values, the worst first.
std::vector<Index> worst_faces(const Mesh& mesh, Quality q, std::size_t limit,
                               const std::function<bool(double)>& fails) {
    const auto values = face_values(mesh, q);
    std::vector<Index> order;
    for (Index f = 0; f < values.size(); ++f)
        if (!fails || fails(values[f])) order.push_back(f);
    const bool least = info_of(q).join == Join::least;
    const auto end = order.begin() + static_cast<std::ptrdiff_t>(std::min(limit, order.size()));
    std::partial_sort(order.begin(), end, order.end(), [&](Index a, Index b) {
        return values[a] != values[b] ? (values[a] < values[b]) == least : a < b;
    });
    order.erase(end, order.end());
    return order;
}

/// A face of each piece that looks inward; the piece known by its lowest position.
std::vector<Place> inward_pieces(const Mesh& mesh, std::size_t limit) {
    const Components pieces = face_components(mesh, false);
    const auto keys = keys_of_pieces(mesh, pieces.of_face, pieces.count);
    std::vector<Place> places;
    for (const Index f : inward_faces(mesh)) {
        if (places.size() == limit) break;
        places.push_back(place_of(mesh, f));
        places.back().key = keys[pieces.of_face[f]];
    }
    return places;
}

/// The vertices, with the face on whose edge each lies.
std::vector<Place> t_vertices(const Mesh& mesh, std::size_t limit) {
    const auto faces = corner_faces(mesh);
    std::vector<Place> places;
    for (const auto& i : clean_steps::find_t_vertices(mesh, 0)) {
        if (places.size() == limit) break;
        const Vec3& at = mesh.positions[i.vertex];
        const Index face = faces[i.corner];
        const Vec3 &from = mesh.point(i.corner), &to = mesh.point(next_corner(mesh, face, i.corner));
        places.push_back({.face = face, .at = at, .key = hashed(key_of_point(at), key_of_edge(from, to))});
    }
    return places;
}

} // namespace

std::vector<Place> places_against(const Mesh& mesh, Quality q, std::size_t limit,
                                  const std::function<bool(double)>& fails) {
    if (is_of_attributes(q)) return places_against_attributes(mesh, q, limit, fails);
    if (is_by_face(q)) {
        std::vector<Place> places;
        for (const Index f : worst_faces(mesh, q, limit, fails)) places.push_back(place_of(mesh, f));
        return places;
    }
    switch (q) {
    case Quality::folded_faces:
        return places_of_pairs(mesh, folded_faces(mesh), limit);
    case Quality::coplanar_overlaps:
        return places_of_pairs(mesh, coplanar_overlaps(mesh), limit);
    case Quality::uv_overlaps:
        return places_of_pairs(mesh, uv_overlaps(mesh).value_or(Pairs{}), limit);
    case Quality::outward:
        return inward_pieces(mesh, limit);
    case Quality::t_vertices:
        return t_vertices(mesh, limit);
    case Quality::boundary_length:
    case Quality::longest_boundary:
        return places_against(mesh, "boundary_edges", limit);
    default:
        return {};
    }
}

} // namespace facetmill
