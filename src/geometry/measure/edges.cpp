// Implements edges, corners and curvature of geometry/measure/measure.hpp.
#include "base/math/angle.hpp"
#include "base/math/portable_math.hpp"
#include "geometry/measure/pieces.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "mesh/aspect_ratio.hpp"
#include "mesh/power_scale.hpp"
#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <limits>

namespace facetmill {

namespace {

constexpr double none_there = std::numeric_limits<double>::quiet_NaN();

std::vector<Vec3> area_vectors(const Mesh& mesh) {
    std::vector<Vec3> areas(mesh.face_count());
    parallel_chunks(areas.size(), [&](std::size_t begin, std::size_t end) {
        std::vector<Vec3> corners;
        for (std::size_t f = begin; f < end; ++f) {
            const auto i = static_cast<Index>(f);
            corners.clear();
            for (Index c = mesh.face_begin(i); c < mesh.face_end(i); ++c) corners.push_back(mesh.point(c));
            areas[f] = polygon::area_vector(corners);
        }
    });
    return areas;
}

/// How the surface turns at an edge. NaN unless the edge has two faces that run along it in opposite
/// directions.
struct EdgeTurns {
    EdgeTable edges;
    std::vector<double> turn;
};

EdgeTurns turns_of(const Mesh& mesh, const std::vector<Vec3>& areas) {
    EdgeTurns t{build_edges(mesh), {}};
    const std::vector<Index> face_of = corner_faces(mesh);
    t.turn.assign(t.edges.size(), none_there);
    parallel_for(t.edges.size(), [&](std::size_t e) {
        const auto corners = t.edges.corners_of(static_cast<Index>(e));
        if (corners.size() != 2 || mesh.vertex(corners[0]) == mesh.vertex(corners[1])) return;
        const Vec3 &m = areas[face_of[corners[0]]], &n = areas[face_of[corners[1]]];
        if (!(dot(m, m) > 0) || !(dot(n, n) > 0)) return;
        const Index c = corners[0];
        const Vec3 along =
            mesh.point(next_corner(mesh, face_of[c], c)) - mesh.point(c); // anticlockwise around m's face
        const double angle = angle_between(m, n);
        t.turn[e] = dot(cross(m, n), along) < 0 ? -angle : angle;
    });
    return t;
}

double length_of(const Mesh& mesh, const EdgeTable::Edge& e) {
    return length(mesh.positions[e.high] - mesh.positions[e.low]);
}

/// The inner angle of a face at a corner. The normal decides which side is inside.
double angle_at(const Vec3& before, const Vec3& at, const Vec3& after, const Vec3& normal) {
    const Vec3 a = after - at, b = before - at;
    if (!(dot(a, a) > 0) || !(dot(b, b) > 0)) return none_there;
    const double angle = angle_between(a, b);
    return dot(cross(a, b), normal) < 0 ? 2 * pi - angle : angle;
}

/// Whether an edge counts if the vertices have these turns.
bool counts(const EdgeTable::Edge& e, std::span<const Turn> turns) {
    if (turns.empty()) return true;
    const Turn a = turns[e.low], b = turns[e.high];
    return (a == Turn::now || b == Turn::now) && a != Turn::before && b != Turn::before;
}

void count_turn(EdgeResult& r, double turn, const EdgeSettings& settings) {
    if (!(turn == turn)) return;
    r.feature += std::abs(turn) > settings.feature_angle;
    if (std::abs(turn) <= settings.flat)
        ++r.flat;
    else
        ++(turn > 0 ? r.convex : r.concave);
}

double area_of_face(const Mesh& mesh, Index f, const Vec3& area) {
    if (mesh.face_size(f) == 3) return safe_length(area);
    std::vector<Vec3> corners;
    face_corners(mesh, f, corners);
    return covered_area(corners);
}

EdgeValues values_of_edges(const Mesh& mesh, EdgeTurns t, const EdgeSettings& settings,
                           std::span<const Turn> turns) {
    EdgeValues values{std::vector<double>(t.edges.size()), std::move(t.turn), {}};
    parallel_for(values.length.size(), [&](std::size_t e) {
        const bool here = counts(t.edges.edges[e], turns);
        values.length[e] = here ? length_of(mesh, t.edges.edges[e]) : none_there;
        if (!here) values.turn[e] = none_there;
    });
    EdgeResult& r = values.counts;
    for (std::size_t e = 0; e < t.edges.size(); ++e) {
        if (!counts(t.edges.edges[e], turns)) continue;
        const std::size_t faces = t.edges.corners_of(static_cast<Index>(e)).size();
        r.boundary += faces == 1;
        r.non_manifold += faces > 2;
        count_turn(r, values.turn[e], settings);
    }
    return values;
}

/// mesh: must consist of triangles. Its first `vertices` vertices are in the input. At the others, faces
/// cross themselves.
CurvatureValues values_of_curvature(const Mesh& mesh, const std::vector<Vec3>& areas, const EdgeTurns& t,
                                    std::size_t vertices, std::span<const Turn> turns_of_vertices);

} // namespace

EdgeValues edge_values(const Mesh& mesh, const EdgeSettings& settings, std::span<const Turn> turns) {
    return values_of_edges(mesh, turns_of(mesh, area_vectors(mesh)), settings, turns);
}

FaceValues face_values(const Mesh& mesh) {
    FaceValues r;
    r.kinds = face_kinds(mesh);
    const std::vector<Vec3> areas = area_vectors(mesh);
    r.area.resize(areas.size());
    r.angle.resize(mesh.corner_count());
    r.aspect_ratio.assign(areas.size(), none_there);
    parallel_for(areas.size(), [&](std::size_t i) {
        const auto f = static_cast<Index>(i);
        r.area[i] = area_of_face(mesh, f, areas[i]);
        const Index begin = mesh.face_begin(f), end = mesh.face_end(f);
        for (Index c = begin; c < end; ++c)
            r.angle[c] = angle_at(mesh.point(previous_corner(c, begin, end)), mesh.point(c),
                                  mesh.point(next_corner(c, begin, end)), areas[i]);
        if (end - begin == 3 && r.area[i] > 0)
            r.aspect_ratio[i] = aspect_ratio(mesh.point(begin), mesh.point(begin + 1), mesh.point(begin + 2));
    });
    for (const Vec3& a : areas) r.signed_area += a;
    return r;
}

CurvatureValues curvature_values(const Mesh& given, std::span<const Turn> turns_of_vertices) {
    const Mesh mesh = triangles_of(given); // vertices where faces cross themselves come last
    const std::vector<Vec3> areas = area_vectors(mesh);
    return values_of_curvature(mesh, areas, turns_of(mesh, areas), given.vertex_count(), turns_of_vertices);
}

namespace {

CurvatureValues values_of_curvature(const Mesh& mesh, const std::vector<Vec3>& areas, const EdgeTurns& t,
                                    std::size_t vertices, std::span<const Turn> turns_of_vertices) {
    const VertexLists corners = corners_at_vertices(mesh);
    std::vector<double> turns(mesh.vertex_count()), missing(mesh.vertex_count());
    std::vector<std::uint8_t> open(mesh.vertex_count());
    for (std::size_t e = 0; e < t.edges.size(); ++e) {
        const auto [low, high] = t.edges.edges[e];
        const std::size_t faces = t.edges.corners_of(static_cast<Index>(e)).size();
        // 1: on a boundary. 2: not manifold, or at a face without a normal.
        if (faces == 1) {
            open[low] |= 1;
            open[high] |= 1;
        }
        if (faces == 1) continue;
        if (!(t.turn[e] == t.turn[e])) {
            open[low] |= 2;
            open[high] |= 2;
            continue;
        }
        const double turn = length_of(mesh, t.edges.edges[e]) * t.turn[e];
        turns[low] += turn;
        turns[high] += turn;
    }
    const auto counts_vertex = [&](std::size_t v) {
        return turns_of_vertices.empty() || v >= turns_of_vertices.size() ||
               turns_of_vertices[v] == Turn::now;
    };
    CurvatureValues r;
    r.gaussian.assign(mesh.vertex_count(), none_there);
    r.mean = r.gaussian;
    parallel_for(mesh.vertex_count(), [&](std::size_t v) {
        if (!counts_vertex(v)) return;
        double angle = 0, area = 0;
        for (const Index c : corners.of(static_cast<Index>(v))) {
            const Index f = c / 3;
            const Vec3& at = mesh.point(c);
            const double corner =
                angle_at(mesh.point(3 * f + (c + 2) % 3), at, mesh.point(3 * f + (c + 1) % 3), areas[f]);
            if (corner == corner) angle += corner;
            area += length(areas[f]);
        }
        if (corners.of(static_cast<Index>(v)).empty()) return;
        missing[v] = ((open[v] & 1) ? pi : 2 * pi) - angle;
        if (open[v] || !(area > 0)) return;
        r.gaussian[v] = missing[v] / (area / 3);
        r.mean[v] = turns[v] / 4 / (area / 3);
    });
    for (const double m : missing) r.total += m;
    r.gaussian.resize(vertices);
    r.mean.resize(vertices);
    return r;
}

/// Converts statistics from scaled coordinates back. The values are lengths to this power.
void unscale(Statistics& s, int power) {
    for (double* x : {&s.minimum, &s.maximum, &s.mean, &s.deviation, &s.median, &s.sum})
        *x = unscaled(*x, power);
}

void unscale(std::vector<double>& numbers, int power) {
    for (double& x : numbers) x = unscaled(x, power);
}

} // namespace

void unscale(EdgeResult& r, const PowerScale& scale) { unscale(r.length, scale.powers[0]); }

void unscale(FaceResult& r, const PowerScale& scale) {
    const int power = scale.powers[0];
    unscale(r.area, 2 * power);
    unscale(r.areas, 2 * power);
    for (std::size_t i = 0; i < 3; ++i) r.signed_area[i] = unscaled(r.signed_area[i], 2 * power);
    r.kinds.deviation = unscaled(r.kinds.deviation, power);
}

void unscale(CurvatureResult& r, const PowerScale& scale) {
    const int power = scale.powers[0];
    unscale(r.gaussian, -2 * power);
    unscale(r.mean, -power);
    unscale(r.of_gaussian, -2 * power);
    unscale(r.of_mean, -power);
}

namespace {

EdgeResult result_of(EdgeValues values, const PowerScale& scale) {
    EdgeResult r = values.counts;
    r.length = statistics(std::move(values.length));
    r.turn = statistics(std::move(values.turn));
    if (!scale.none()) unscale(r, scale);
    return r;
}

CurvatureResult result_of(CurvatureValues values, const PowerScale& scale) {
    CurvatureResult r;
    r.total = values.total;
    r.of_gaussian = statistics(values.gaussian);
    r.of_mean = statistics(values.mean);
    r.gaussian = std::move(values.gaussian);
    r.mean = std::move(values.mean);
    if (!scale.none()) unscale(r, scale);
    return r;
}

} // namespace

EdgeResult measure_edges(const Mesh& mesh, const EdgeSettings& settings) {
    const PowerScale scale = even_scale(mesh.bounds());
    return result_of(edge_values(scale.none() ? mesh : scale(mesh), settings), scale);
}

FaceResult measure_faces(const Mesh& mesh) {
    const PowerScale scale = even_scale(mesh.bounds());
    FaceValues values = face_values(scale.none() ? mesh : scale(mesh));
    FaceResult r;
    r.kinds = values.kinds;
    r.signed_area = values.signed_area;
    r.area = statistics(values.area);
    r.angle = statistics(std::move(values.angle));
    r.aspect_ratio = statistics(std::move(values.aspect_ratio));
    r.areas = std::move(values.area);
    if (!scale.none()) unscale(r, scale);
    return r;
}

CurvatureResult measure_curvature(const Mesh& mesh) {
    const PowerScale scale = even_scale(mesh.bounds());
    return result_of(curvature_values(scale.none() ? mesh : scale(mesh)), scale);
}

EdgesAndCurvature measure_edges_and_curvature(const Mesh& mesh, const EdgeSettings& settings) {
    if (!mesh.all_triangles()) return {measure_edges(mesh, settings), measure_curvature(mesh)};
    const PowerScale scale = even_scale(mesh.bounds());
    const Mesh scaled = scale.none() ? Mesh{} : scale(mesh);
    const Mesh& near_one = scale.none() ? mesh : scaled;
    const std::vector<Vec3> areas = area_vectors(near_one);
    EdgeTurns turns = turns_of(near_one, areas);
    CurvatureValues curvature = values_of_curvature(near_one, areas, turns, mesh.vertex_count(), {});
    return {result_of(values_of_edges(near_one, std::move(turns), settings, {}), scale),
            result_of(std::move(curvature), scale)};
}

} // namespace facetmill
