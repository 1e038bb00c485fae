#include "geometry/thicken/thicken.hpp"

#include "base/math/angle.hpp"
#include "base/math/portable_math.hpp"
#include "geometry/edit/split_non_manifold.hpp"
#include "geometry/edit/surgery.hpp"
#include "geometry/inspect/connectivity.hpp"
#include "geometry/inspect/evidence.hpp"
#include "geometry/intersect/self_intersections.hpp"
#include "geometry/spatial/closest_point.hpp"
#include "geometry/spatial/rays.hpp"
#include "geometry/thicken/doubled.hpp"
#include "geometry/thicken/moved_surface.hpp"
#include "geometry/thicken/redrawn_flats.hpp"
#include "geometry/thicken/resolve.hpp"
#include "mesh/component_volumes.hpp"
#include "mesh/face.hpp"
#include "mesh/mesh.hpp"
#include "mesh/placement.hpp"
#include "mesh/provenance.hpp"
#include "mesh/topology.hpp"
#include "mesh/transform.hpp"
#include "mesh/wedges.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>
#include <map>

namespace facetmill {

namespace {

/// A symmetric 3 x 3 system a x = b, by cofactors.
struct System {
    double a[3][3] = {};
    Vec3 b;
    double weight = 0;

    /// Adds the equation n . x = 1 with a weight.
    void add(const Vec3& n, double w) {
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) a[i][j] += w * n[i] * n[j];
            b[i] += w * n[i];
        }
        weight += w;
    }
    /// The least-squares solution; if it is not unique, the solution nearest to start. Uses proximal steps,
    /// each solved exactly.
    Vec3 solve(Vec3 start) const {
        const double pull = 1e-4 * weight;
        const Vec3 r0{a[0][0] + pull, a[0][1], a[0][2]}, r1{a[1][0], a[1][1] + pull, a[1][2]},
            r2{a[2][0], a[2][1], a[2][2] + pull};
        const Vec3 c0 = cross(r1, r2), c1 = cross(r2, r0), c2 = cross(r0, r1);
        const double det = dot(r0, c0);
        for (int step = 0; step < 4; ++step) {
            const Vec3 rhs = b + start * pull;
            start = (c0 * rhs.x + c1 * rhs.y + c2 * rhs.z) / det;
        }
        return start;
    }
};

/// The angle of face f at corner c, in the world.
double angle_at(const Mesh& mesh, Index f, Index c, const Transform& to_world) {
    const Vec3 u = to_world.vector(mesh.point(previous_corner(mesh, f, c)) - mesh.point(c)),
               v = to_world.vector(mesh.point(next_corner(mesh, f, c)) - mesh.point(c));
    return angle_between(u, v);
}

struct Directions {
    std::vector<Vec3> of_vertex; ///< the vertex moves for a distance of 1 in the world
    std::size_t limited = 0, still = 0;
};

Directions directions(const Mesh& mesh, double limit, const Transform& to_world) {
    const Transform back = inverse(to_world).value_or(Transform{});
    const double front = to_world.determinant() < 0 ? -1 : 1; // faces of a mirrored part keep their front
    const auto corners = corners_at_vertices(mesh);
    const auto faces = corner_faces(mesh);
    Directions d;
    d.of_vertex.resize(mesh.vertex_count());
    std::vector<std::uint8_t> kind(mesh.vertex_count(), 0); // 1: limited, 2: still
    parallel_for(mesh.vertex_count(), [&](std::size_t v) {
        System system;
        Vec3 mean;
        for (const Index c : corners.of(static_cast<Index>(v))) {
            const Vec3 n = normalised(area_vector(mesh, faces[c], to_world)) * front;
            const double angle = angle_at(mesh, faces[c], c, to_world);
            if (!(dot(n, n) > 0) || !(angle > 0)) continue;
            system.add(n, angle);
            mean += n * angle;
        }
        mean = normalised(mean);
        if (!(dot(mean, mean) > 0)) {
            kind[v] = 2;
            return;
        }
        Vec3 way = system.solve(mean);
        const double far = length(way);
        if (!(far <= limit)) {
            way = far < HUGE_VAL ? way * (limit / far) : mean;
            kind[v] = 1;
        }
        if (!(dot(way, mean) > 0)) {
            way = mean;
            kind[v] = 1;
        }
        d.of_vertex[v] = back.vector(way);
    });
    d.limited = static_cast<std::size_t>(std::count(kind.begin(), kind.end(), 1));
    d.still = static_cast<std::size_t>(std::count(kind.begin(), kind.end(), 2));
    return d;
}

/// The side of a face in the solid.
enum class Face : std::uint8_t { front, back, neither };

/// Measures world distances from the vertices and centres of front faces to the back faces. face: [faces]
/// the side of each face.
std::optional<ThickenResult::Wall> measure(const Mesh& solid, const Transform& to_world,
                                           const std::vector<Face>& face) {
    Mesh back;
    back.positions = solid.positions;
    back.wedge_vertex = solid.wedge_vertex;
    for (Vec3& p : back.positions) p = to_world.point(p);
    std::vector<std::uint8_t> of_front(solid.vertex_count(), 0);
    std::vector<Vec3> points;
    for (Index f = 0; f < face.size(); ++f) {
        if (face[f] == Face::back) add_face(back, solid.face_wedges(f));
        if (face[f] != Face::front) continue;
        for (Index c = solid.face_begin(f); c < solid.face_end(f); ++c) of_front[solid.vertex(c)] = 1;
    }
    for (Index v = 0; v < of_front.size(); ++v)
        if (of_front[v]) points.push_back(back.positions[v]);
    for (Index f = 0; f < face.size(); ++f)
        if (face[f] == Face::front) points.push_back(to_world.point(corner_mean(solid, f)));
    const FaceTree tree(surface_of(back));
    double sum = 0, least = HUGE_VAL;
    std::size_t count = 0;
    for (const auto& c : closest_points(tree, points))
        if (c.distance < HUGE_VAL) {
            sum += c.distance;
            least = std::min(least, c.distance);
            ++count;
        }
    if (count == 0) return {};
    return ThickenResult::Wall{least, sum / static_cast<double>(count)};
}

/// The diagonal of the box around all vertices, in the world.
double size_of(const Mesh& mesh, const Transform& to_world) {
    Box box;
    for (const Vec3& p : mesh.positions) box.add(to_world.point(p));
    return box.empty() ? 0 : length(box.max - box.min);
}

/// Counts edges with more faces in one direction than in the other.
std::size_t unbalanced_edges(const Mesh& mesh, const EdgeTable& edges) {
    std::size_t count = 0;
    for (Index e = 0; e < edges.size(); ++e) {
        int balance = 0;
        for (const Index c : edges.corners_of(e)) balance += mesh.vertex(c) == edges.edges[e].low ? 1 : -1;
        count += balance != 0;
    }
    return count;
}

/// The effects of a move along the normals on the surface's faces, in world space.
struct Moved {
    std::vector<std::uint8_t> turned, vanished; ///< [faces], or empty for no move
    RedrawnFlats flats;
};

Moved moved_by(const Mesh& surface, const std::vector<Vec3>& ways, double distance,
               const Transform& to_world) {
    if (distance == 0) return {};
    Mesh from = bare(surface);
    const std::vector<Vec3> moved = moved_positions(surface, ways, distance);
    std::vector<Vec3> to(moved.size());
    parallel_for(to.size(), [&](std::size_t v) {
        from.positions[v] = to_world.point(surface.positions[v]);
        to[v] = to_world.point(moved[v]);
    });
    Moved m;
    m.turned = turned_faces(from, to);
    m.flats = redrawn_flats(surface, moved, m.turned);
    const double along =
        to_world.determinant() < 0 ? -distance : distance; // mirrored faces have inward normals
    m.vanished = vanished_components(from, m.turned, along);
    return m;
}

/// Counts the turned faces that did not vanish.
void count_turned(const Moved& moved, const Mesh& surface, const Transform& to_world, ThickenResult& r) {
    for (Index f = 0; f < moved.turned.size(); ++f) {
        if (!moved.turned[f] || moved.vanished[f]) continue;
        if (r.turned++ == 0) r.first_turned = to_world.point(corner_mean(surface, f));
    }
}

/// Replaces the faces of flat patches on both sides. Returns how many faces the front has. The doubled
/// surface has no walls yet.
std::size_t redraw(Doubled& d, const Mesh& surface, const RedrawnFlats& front, const RedrawnFlats& back) {
    if (front.empty() && back.empty()) return surface.face_count();
    const auto wedges = static_cast<Index>(surface.wedge_count());
    std::vector<Index> ring;
    d.mesh.corners.clear();
    d.mesh.face_offsets = {0};
    d.provenance.faces.clear();
    const auto add = [&](Index source) {
        d.mesh.corners.insert(d.mesh.corners.end(), ring.begin(), ring.end());
        d.mesh.face_offsets.push_back(static_cast<Index>(d.mesh.corners.size()));
        d.provenance.faces.push_back(source);
    };
    for_each_face(surface, front, [&](std::span<const Index> face, Index source) {
        ring.assign(face.begin(), face.end());
        add(source);
    });
    const std::size_t of_front = d.provenance.faces.size();
    for_each_face(surface, back, [&](std::span<const Index> face, Index source) {
        ring.assign(face.begin(), face.end());
        std::reverse(ring.begin() + 1, ring.end());
        for (Index& w : ring) w += wedges;
        add(source);
    });
    normalise_offsets(d.mesh);
    return of_front;
}

/// [components] A point within a face of each: the centre of its largest triangle. Components that only
/// touch meet at edges, so no other component passes through the point.
std::vector<Vec3> points_within_faces(const Surface& surface, const Components& components) {
    std::vector<Vec3> points(components.count);
    std::vector<double> largest(components.count, -1);
    for (std::size_t t = 0; t < surface.size(); ++t) {
        const Vec3 &a = surface.point(t, 0), &b = surface.point(t, 1), &c = surface.point(t, 2);
        const Index component = components.of_face[surface.face(t)];
        const double size = length(cross(b - a, c - a));
        if (!(size > largest[component])) continue;
        largest[component] = size;
        points[component] = (a + b + c) / 3;
    }
    return points;
}

/// Counts closed components of the solid that bound no material. No two components may intersect, but they
/// may touch. A component is correct if the surface winds once around points on its inner side and not
/// around its outer side.
std::size_t buried_components(const Mesh& solid, const EdgeTable& edges) {
    const Components components = face_components(solid, edges);
    if (components.count < 2) return 0;
    const std::vector<double> volume = six_volumes(solid, components);
    const Surface surface = surface_of(solid);
    const std::vector<Vec3> points = points_within_faces(surface, components);
    const FaceTree rays(surface, FaceTree::Use::rays);
    std::vector<std::uint8_t> buried(components.count, 0);
    parallel_for(
        buried.size(),
        [&](std::size_t p) {
            int around = 0;
            visit_along_axis(rays, points[p], 0, true,
                             [&](Index f, int way) { around += components.of_face[f] == p ? 0 : way; });
            buried[p] = around != (volume[p] < 0 ? 1 : 0);
        },
        64); // each component gets a ray
    return static_cast<std::size_t>(std::count(buried.begin(), buried.end(), 1));
}

/// The number of components with flagged faces.
std::size_t components_of(const Mesh& mesh, const std::vector<std::uint8_t>& flags) {
    const Components components = face_components(mesh, false);
    std::vector<std::uint8_t> has(components.count, 0);
    for (Index f = 0; f < flags.size(); ++f)
        if (flags[f]) has[components.of_face[f]] = 1;
    return static_cast<std::size_t>(std::count(has.begin(), has.end(), 1));
}

std::int64_t euler_number(const Mesh& mesh) {
    const Connectivity c = connectivity_of(mesh);
    return static_cast<std::int64_t>(mesh.vertex_count()) - c.isolated_vertices - c.edges +
           static_cast<std::int64_t>(mesh.face_count());
}

/// Compares the sides of a rebuilt solid with its surface. No side may vanish.
std::optional<ThickenResult::Topology> changed_topology(const Mesh& surface, const ResolvedSolid& solid) {
    const std::int64_t wanted = euler_number(surface);
    for (const bool back : {false, true}) {
        std::vector<std::uint8_t> others(solid.is_back);
        for (auto& other : others) other = other != static_cast<std::uint8_t>(back);
        const std::int64_t found = euler_number(keep_faces(solid.mesh, faces_without(others)));
        if (found != wanted) return ThickenResult::Topology{wanted, found};
    }
    return {};
}

/// Rebuilds the solid without its folds.
void resolve(Doubled& d, const ThickenMoves& moves, const Transform& to_world, ThickenResult& r) {
    const auto faces_of = [](const std::vector<std::uint8_t>& is_back) {
        std::vector<Face> face(is_back.size());
        std::transform(is_back.begin(), is_back.end(), face.begin(),
                       [](bool back) { return back ? Face::back : Face::front; });
        return face;
    };
    ResolvedSolid solid = r.wall_faces > 0 ? united_solid(d.mesh, to_world, moves.out + moves.in)
                                           : resolved_solid(moves, to_world);
    if (solid.failed) return;
    if (r.wall_faces == 0 && r.filled == 0) r.changed_topology = changed_topology(moves.surface, solid);
    r.changes = changes_in_sequence(r.changes, std::move(solid.changes));
    d.mesh = std::move(solid.mesh);
    if (r.wall_faces == 0) r.wall = measure(d.mesh, to_world, faces_of(solid.is_back));
    r.resolved = true;
    r.turned = r.buried = 0;
    r.first_turned.reset();
    r.self_intersections = find_self_intersections(d.mesh, {.limit = 0, .separate_touching = true}).count;
}

/// The two sides of a solid. Its faces are the faces of the front, the back, and the walls, in this order.
struct Sides {
    Moved front, back;
    std::size_t front_faces = 0, back_faces = 0;

    /// [faces of the solid] 1 for faces of vanished components of their side.
    std::vector<std::uint8_t> gone(const Doubled& d) const {
        std::vector<std::uint8_t> flags(d.mesh.face_count(), 0);
        for (std::size_t f = 0; f < front_faces + back_faces; ++f) {
            const auto& vanished = (f < front_faces ? front : back).vanished;
            if (!vanished.empty()) flags[f] = vanished[d.provenance.faces[f]];
        }
        return flags;
    }
    /// [faces of the surface] 1 if a side vanished.
    std::vector<std::uint8_t> filled(std::size_t faces) const {
        std::vector<std::uint8_t> flags(faces, 0);
        for (const auto* vanished : {&front.vanished, &back.vanished})
            for (std::size_t f = 0; f < vanished->size(); ++f) flags[f] |= (*vanished)[f];
        return flags;
    }
};

/// Whether the wall can be searched for self-intersections. Removes the vanished sides of closed components,
/// so that their other sides bound filled solids, and measures the wall.
bool settle_vanished(Doubled& d, const Mesh& surface, const ThickenSettings& s, const Sides& sides,
                     ThickenResult& r) {
    const std::vector<std::uint8_t> gone = sides.gone(d), filled = sides.filled(surface.face_count());
    std::vector<Face> face(sides.front_faces + sides.back_faces, Face::neither);
    for (std::size_t f = 0; f < face.size(); ++f)
        if (!filled[d.provenance.faces[f]]) face[f] = f < sides.front_faces ? Face::front : Face::back;
    r.wall = measure(d.mesh, s.to_world, face);
    if (std::find(filled.begin(), filled.end(), 1) != filled.end()) {
        r.filled = components_of(surface, filled);
        d.mesh = keep_faces(d.mesh, faces_without(gone));
    }
    return s.self_intersections && !(r.wall && s.thickness > size_of(surface, s.to_world));
}

/// Finds the defects of the solid, and resolves them on request.
void settle(Doubled& d, const Mesh& surface, const std::vector<Vec3>& ways, const ThickenSettings& s,
            double out, Sides sides, ThickenResult& r) {
    count_turned(sides.front, surface, s.to_world, r);
    count_turned(sides.back, surface, s.to_world, r);
    const bool searches = settle_vanished(d, surface, s, sides, r);
    const EdgeTable edges = build_edges(d.mesh);
    r.unbalanced = unbalanced_edges(d.mesh, edges);
    if (!searches) return;
    r.self_intersections = find_self_intersections(d.mesh, {.limit = 0, .separate_touching = true}).count;
    if (r.self_intersections == 0 && r.unbalanced == 0) r.buried = buried_components(d.mesh, edges);
    if (!s.resolve || r.unbalanced > 0 || (r.self_intersections == 0 && r.turned == 0 && r.buried == 0))
        return;
    resolve(d,
            {surface, ways, out, s.thickness - out, std::move(sides.front.vanished),
             std::move(sides.back.vanished)},
            s.to_world, r);
}

/// [vertices of the solid] 1 for vertices that faces of the surface use, on either side.
std::vector<std::uint8_t> vertices_of_faces(const Mesh& surface) {
    const std::size_t n = surface.vertex_count();
    std::vector<std::uint8_t> used(2 * n, 0);
    for (Index c = 0; c < surface.corner_count(); ++c)
        used[surface.vertex(c)] = used[n + surface.vertex(c)] = 1;
    return used;
}

ThickenResult thicken_sheets(const Mesh& mesh, const ThickenSettings& s) {
    ThickenResult r;
    const auto n = static_cast<Index>(mesh.vertex_count());
    std::vector<Index> back(n), copies(n);
    for (Index v = 0; v < n; ++v) {
        back[v] = n + v;
        copies[v] = v;
    }
    const Directions ways = directions(mesh, s.miter_limit, s.to_world);
    const double out = s.side == ThickenSide::outward   ? s.thickness
                       : s.side == ThickenSide::centred ? s.thickness / 2
                                                        : 0;
    Sides sides{moved_by(mesh, ways.of_vertex, out, s.to_world),
                moved_by(mesh, ways.of_vertex, out - s.thickness, s.to_world)};
    Doubled d = doubled(mesh, back, copies);
    sides.front_faces = redraw(d, mesh, sides.front.flats, sides.back.flats);
    sides.back_faces = d.provenance.faces.size() - sides.front_faces;
    parallel_for(n, [&](std::size_t v) {
        d.mesh.positions[v] += ways.of_vertex[v] * out;
        d.mesh.positions[n + v] += ways.of_vertex[v] * (out - s.thickness);
    });
    WedgeNormals wall_normals;
    r.wall_faces = add_walls(mesh, d, wall_normals);
    r.changes = inherit_attributes(d.mesh, mesh, d.provenance);
    // Set wall normals last, because turn_wedges would also reverse them.
    turn_wedges(d.mesh, mesh.wedge_count(), r.changes);
    set_normals(d.mesh, wall_normals);
    if (!mesh.has_seams() && wall_normals.empty()) d.mesh.wedge_vertex = {};
    drop_unused(d.mesh, vertices_of_faces(mesh));
    r.limited = ways.limited;
    r.still = ways.still;
    settle(d, mesh, ways.of_vertex, s, out, std::move(sides), r);
    r.mesh = std::move(d.mesh);
    return r;
}

} // namespace

ThickenResult thicken(const Mesh& mesh, const ThickenSettings& s) {
    if (mesh.face_count() == 0) {
        ThickenResult same;
        same.mesh = mesh;
        same.changes = kept_changes(mesh.attributes);
        return same;
    }
    if (connectivity_of(mesh).is_manifold()) return thicken_sheets(mesh, s);
    return thicken_sheets(split_non_manifold(mesh), s);
}

namespace {

/// Two directions that form a right-handed frame with the unit vector w.
std::array<Vec3, 2> across(const Vec3& w) {
    const double x = std::abs(w.x), y = std::abs(w.y), z = std::abs(w.z);
    const Vec3 other = x <= y && x <= z ? Vec3{1, 0, 0} : y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
    const Vec3 u = normalised(cross(other, w));
    return {u, cross(w, u)};
}

} // namespace

WiresResult wires(const Mesh& mesh, const WiresSettings& s) {
    const auto table = build_edges(mesh);
    std::vector<EdgeTable::Edge> lines;
    WiresResult r;
    for (Index e = 0; e < table.size(); ++e) {
        if (s.open_only && table.corners_of(e).size() != 1) continue;
        const auto& edge = table.edges[e];
        if (length(mesh.positions[edge.high] - mesh.positions[edge.low]) > 0)
            lines.push_back(edge);
        else
            ++r.skipped;
    }
    r.edges = lines.size();
    const auto n = static_cast<Index>(s.sides);
    const Index points = 2 * n, corners = 4 * n + 2 * n; // quads around, a polygon at each end
    r.mesh.positions.resize(lines.size() * points);
    r.mesh.corners.resize(lines.size() * corners);
    r.mesh.face_offsets.resize(lines.size() * (n + 2) + 1);
    struct Direction {
        double x, y;
    };
    std::vector<Direction> ring(n);
    for (Index i = 0; i < n; ++i) ring[i] = {cosine(2 * pi * i / n), sine(2 * pi * i / n)};
    const Transform back = inverse(s.to_world).value_or(Transform{});
    const double front = s.to_world.determinant() < 0 ? -1 : 1; // a mirrored part keeps its front
    parallel_for(lines.size(), [&](std::size_t l) {
        const Vec3 a = s.to_world.point(mesh.positions[lines[l].low]),
                   b = s.to_world.point(mesh.positions[lines[l].high]);
        const auto [u, v] = across(normalised(b - a));
        const auto first = static_cast<Index>(l * points);
        Index* corner = r.mesh.corners.data() + l * corners;
        Index offset = static_cast<Index>(l * corners);
        Index* offsets = r.mesh.face_offsets.data() + l * (n + 2);
        for (Index i = 0; i < n; ++i) {
            const Vec3 aside = (u * (ring[i].x * front) + v * ring[i].y) * (s.thickness / 2);
            r.mesh.positions[first + i] = back.point(a + aside);
            r.mesh.positions[first + n + i] = back.point(b + aside);
            const Index j = (i + 1) % n;
            *offsets++ = offset;
            offset += 4;
            for (const Index k : {i, j, n + j, n + i}) *corner++ = first + k;
        }
        *offsets++ = offset;
        offset += n;
        for (Index i = n; i-- > 0;) *corner++ = first + i;
        *offsets++ = offset;
        for (Index i = 0; i < n; ++i) *corner++ = first + n + i;
    });
    r.mesh.face_offsets.back() = static_cast<Index>(r.mesh.corners.size());
    normalise_offsets(r.mesh); // needed for a mesh without edges
    return r;
}

namespace {

/// The vertices of a face, in either direction, rotated so that the lowest comes first. place: the lowest
/// vertex at the same position.
std::vector<Index> ring_of(const Mesh& mesh, const std::vector<Index>& place, Index f, bool backward) {
    std::vector<Index> ring;
    for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) ring.push_back(place[mesh.vertex(c)]);
    if (backward) std::reverse(ring.begin(), ring.end());
    std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end()), ring.end());
    return ring;
}

/// Flags the faces that have a reversed face at the same positions. Each face is the back of at most one
/// other face.
std::vector<std::uint8_t> faces_with_back(const Mesh& mesh) {
    const auto place = lowest_at_place(mesh);
    std::vector<std::uint8_t> flags(mesh.face_count(), 0);
    Mesh plain; // a fast test for the usual case without duplicates
    plain.positions = mesh.positions;
    plain.corners = mesh.corners;
    plain.face_offsets = mesh.face_offsets;
    for (Index w = 0; w < mesh.wedge_count(); ++w)
        plain.wedge_vertex.push_back(place[mesh.vertex_of_wedge(w)]);
    if (duplicate_faces(plain).empty()) return flags;
    std::map<std::vector<Index>, std::size_t> left; // faces of each ring that are not yet paired as a back
    for (Index f = 0; f < mesh.face_count(); ++f) ++left[ring_of(mesh, place, f, false)];
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const auto back = left.find(ring_of(mesh, place, f, true));
        if (back != left.end() && back->second > 0) {
            --back->second;
            flags[f] = 1;
        }
    }
    return flags;
}

} // namespace

TwoSidedResult two_sided(const Mesh& mesh) {
    const auto done = faces_with_back(mesh); // empty for point clouds
    if (std::count(done.begin(), done.end(), 0) == 0) return {mesh, kept_changes(mesh.attributes)};
    std::vector<std::uint8_t> open(mesh.vertex_count(), 0);
    for (const BoundaryEdge& e : boundary_edges(mesh)) open[e.from] = open[e.to] = 1;
    std::vector<Index> back(mesh.vertex_count()), copies;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        back[v] = open[v] ? v : static_cast<Index>(mesh.vertex_count() + copies.size());
        if (!open[v]) copies.push_back(v);
    }
    Doubled d = doubled(mesh, back, copies);
    TwoSidedResult r;
    const bool plain =
        !mesh.has_seams() && std::none_of(mesh.attributes.begin(), mesh.attributes.end(),
                                          [](const auto& a) { return a.domain == Domain::wedge; });
    if (plain) { // without wedge data, wedges are vertices
        for (Index& c : d.mesh.corners) c = d.mesh.wedge_vertex[c];
        d.mesh.wedge_vertex = {};
        d.provenance.wedges = d.provenance.vertices;
    }
    r.changes = inherit_attributes(d.mesh, mesh, d.provenance);
    if (!plain) turn_wedges(d.mesh, mesh.wedge_count(), r.changes);
    std::vector<std::uint8_t> gone(mesh.face_count(), 0); // backs that already exist
    gone.insert(gone.end(), done.begin(), done.end());
    r.mesh = std::count(gone.begin(), gone.end(), 1) > 0 ? keep_faces(d.mesh, faces_without(gone))
                                                         : std::move(d.mesh);
    return r;
}

} // namespace facetmill
