#include "geometry/inspect/inspect.hpp"

#include "base/progress.hpp"
#include "geometry/inspect/connectivity.hpp"
#include "geometry/inspect/evidence.hpp"
#include "geometry/inspect/measures.hpp"
#include "geometry/intersect/self_intersections.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "mesh/equal_meshes.hpp"
#include "mesh/power_scale.hpp"
#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <type_traits>

namespace facetmill {

using inspect_room::value_of;
using inspect_room::vertices_without_lines;

namespace {

/// Sums over faces. Chunks are added in order.
struct FaceSums {
    std::int64_t triangles = 0, degenerate = 0, repeating = 0;
    double area = 0, volume = 0; ///< six times the volume
    void add(const FaceSums& b) {
        triangles += b.triangles;
        degenerate += b.degenerate;
        repeating += b.repeating;
        area += b.area;
        volume += b.volume;
    }
};

bool repeats_a_vertex(const Mesh& mesh, Index f) {
    const Index begin = mesh.face_begin(f), end = mesh.face_end(f);
    for (Index a = begin; a < end; ++a)
        for (Index b = begin; b < a; ++b)
            if (mesh.vertex(a) == mesh.vertex(b)) return true;
    return false;
}

/// Adds the triangle p, a, b of a polygon to its area vector and to the volume relative to origin.
void add_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& origin, Vec3& area,
                  double& volume) {
    const Vec3 product = cross(a - p, b - p);
    area += product;
    volume += dot(p - origin, product);
}

double polygon_area(const Mesh& mesh, const std::vector<Vec3>& positions, Index f,
                    std::vector<Vec3>& corners) {
    corners.clear();
    for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
        corners.push_back(positions[mesh.vertex(c)]);
    return covered_area(corners);
}

FaceSums face_sums(const Mesh& mesh, const std::vector<Vec3>& positions, const Vec3& origin) {
    return parallel_reduce(
        mesh.face_count(), FaceSums{},
        [&](std::size_t first, std::size_t last) {
            FaceSums sums;
            std::vector<Vec3> corners;
            for (std::size_t i = first; i < last; ++i) {
                const auto f = static_cast<Index>(i);
                const Index begin = mesh.face_begin(f), end = mesh.face_end(f);
                Vec3 area;
                for (Index c = begin + 1; c + 1 < end; ++c)
                    add_triangle(positions[mesh.vertex(begin)], positions[mesh.vertex(c)],
                                 positions[mesh.vertex(c + 1)], origin, area, sums.volume);
                sums.area +=
                    end - begin == 3 ? safe_length(area) / 2 : polygon_area(mesh, positions, f, corners);
                sums.triangles += end - begin == 3;
                sums.degenerate += is_degenerate(mesh, f);
                sums.repeating += end - begin == 3 && repeats_a_vertex(mesh, f);
            }
            return sums;
        },
        [](FaceSums a, const FaceSums& b) {
            a.add(b);
            return a;
        });
}

/// The sums for boxes of any size. Area and volume are rounded once more.
FaceSums far_face_sums(const Mesh& mesh, const std::vector<Vec3>& positions, const Box& box) {
    const PowerScale even = even_scale(box), axes = axis_scale(box);
    const auto sums_of = [&](const PowerScale& scale) {
        const Vec3 origin = box.empty() ? Vec3{} : (scale(box.min) + scale(box.max)) * 0.5;
        return scale.none() ? face_sums(mesh, positions, origin) : face_sums(mesh, scale(positions), origin);
    };
    FaceSums sums = sums_of(even);
    if (!even.none()) sums.area = unscaled(sums.area, 2 * even.powers[0]);
    if (!axes.none()) sums.volume = unscaled(sums_of(axes).volume, axes.volume());
    return sums;
}

/// Properties that do not depend on the transform. repeating: triangles that have a vertex twice.
void inspect_as_it_is(Properties& p, const Mesh& mesh, std::int64_t repeating,
                      const InspectSettings& settings) {
    ProgressSteps steps({4, 1, settings.self_intersections ? 12.0 : 0.0});
    const Connectivity connectivity = connectivity_of(mesh);
    steps.next();
    set_connectivity(p, connectivity);
    p.boundary_loops = connectivity.boundary_loops;
    p.isolated_vertices = mesh.lines.empty() ? connectivity.isolated_vertices
                                             : static_cast<std::int64_t>(vertices_without_lines(mesh).size());
    // Triangles with three different vertices are compared at common vertices; other faces by the hash of
    // their vertices.
    p.duplicate_faces = mesh.all_triangles() && repeating == 0
                            ? connectivity.duplicate_triangles
                            : static_cast<std::int64_t>(duplicate_faces(mesh).size());
    p.components = static_cast<std::int64_t>(component_count(mesh));
    p.euler = p.vertices - connectivity.isolated_vertices - p.edges + p.faces;
    if (p.closed && p.edge_manifold && p.vertex_manifold && p.oriented) p.genus = p.components - p.euler / 2;
    steps.next();
    if (settings.self_intersections) {
        const auto found = find_self_intersections(mesh, {.limit = 0, .separate_touching = true});
        p.self_intersections = static_cast<std::int64_t>(found.count);
        p.touching = static_cast<std::int64_t>(found.touching);
    }
}

/// positions: the mesh's positions, or transformed. A mirroring transform reverses the faces, as in glTF.
/// alike: the properties of an equal mesh with any transform, or null.
Properties inspect_placed(const Mesh& mesh, const std::vector<Vec3>& positions, bool mirrored,
                          const InspectSettings& settings, const Properties* alike) {
    Properties p;
    if (alike) p = *alike;
    p.volume.reset();
    p.requested.clear();
    p.vertices = static_cast<std::int64_t>(mesh.vertex_count());
    p.wedges = static_cast<std::int64_t>(mesh.wedge_count());
    p.faces = static_cast<std::int64_t>(mesh.face_count());
    p.bounds = box_of(positions);
    ProgressSteps steps({1, settings.self_intersections ? 17.0 : 5.0});
    const FaceSums sums = far_face_sums(mesh, positions, p.bounds);
    steps.next();
    p.triangles = sums.triangles;
    p.degenerate_faces = sums.degenerate;
    p.area = sums.area;
    p.lines = static_cast<std::int64_t>(mesh.line_count());
    if (!alike) inspect_as_it_is(p, mesh, sums.repeating, settings);
    if (p.closed) p.volume = (mirrored ? -sums.volume : sums.volume) / 6;
    return p;
}

/// A member as a number; none for a box.
struct MemberValue {
    const Properties& of;
    template <class T>
    std::optional<double> operator()(T Properties::*member) const {
        return number(of.*member);
    }
    std::optional<double> operator()(std::monostate) const { return {}; }

  private:
    static std::optional<double> number(const Box&) { return {}; }
    template <class T>
    static std::optional<double> number(const T& value) {
        return static_cast<double>(value);
    }
    template <class T>
    static std::optional<double> number(const std::optional<T>& value) {
        if (!value) return {};
        return static_cast<double>(*value);
    }
};

/// Joins the properties of a part with the properties of the parts before it.
class Joiner {
  public:
    Joiner(Properties& sum, const Properties& part) : sum_(sum), part_(part) {}

    void add(const Property& property) const {
        if (property.on_request())
            add_requested(property);
        else
            std::visit([&](auto member) { add_member(member, property.join); }, property.member);
    }

  private:
    template <class T>
    void add_member(T Properties::*member, Join join) const {
        T& a = sum_.*member;
        const T& b = part_.*member;
        if constexpr (std::is_same_v<T, bool>)
            a = a && b;
        else if constexpr (std::is_same_v<T, Box>)
            a.add(b);
        else if constexpr (std::is_arithmetic_v<T>)
            a += b;
        else if (join == Join::sum_if_all) {
            if constexpr (!std::is_enum_v<typename T::value_type>) {
                if (a && b)
                    *a += *b;
                else
                    a.reset();
            }
        }
    }
    void add_member(std::monostate, Join) const {}

    /// Joins the values if both apply; if only one applies, keeps it.
    void add_requested(const Property& property) const {
        const auto value = property.get(part_);
        if (!value) return;
        const auto at = std::find_if(sum_.requested.begin(), sum_.requested.end(),
                                     [&](const auto& r) { return r.first == &property; });
        if (at == sum_.requested.end()) {
            sum_.requested.emplace_back(&property, *value);
            return;
        }
        double& a = at->second;
        if (property.join == Join::sum || property.join == Join::sum_if_all)
            a += *value;
        else if (property.join == Join::most)
            a = std::max(a, *value);
        else // a truth holds for all parts or not: the minimum of 0 and 1
            a = std::min(a, *value);
    }

    Properties& sum_;
    const Properties& part_;
};

void measure_requested(Properties& p, const Mesh& world, const Mesh& local, const InspectSettings& settings) {
    const Measured measured{world, local, p, settings};
    std::vector<std::pair<const Property*, double>> values;
    ProgressSteps steps(std::vector<double>(settings.requested.size(), 1));
    for (const Property* property : settings.requested) {
        if (const auto value = value_of(*property, measured)) values.emplace_back(property, *value);
        steps.next();
    }
    p.requested = std::move(values);
}

/// Whether a sum over all parts lacks the value of this part.
bool lacks_value(const Property& property, const Properties& part) {
    return property.on_request() && property.join == Join::sum_if_all && !property.get(part);
}

/// The relative times to inspect a mesh and to measure the requested properties.
std::vector<double> lengths_of(const InspectSettings& settings) {
    return {settings.self_intersections ? 18.0 : 6.0, static_cast<double>(settings.requested.size())};
}

} // namespace

void set_connectivity(Properties& p, const Connectivity& c) {
    p.edges = c.edges;
    p.boundary_edges = c.boundary_edges;
    p.closed = c.uncancelled_edges == 0;
    p.edge_manifold = c.crowded_edges == 0;
    p.vertex_manifold = c.non_manifold_vertices == 0;
    p.oriented = c.disagreeing_edges == 0;
}

namespace {

Properties inspect_alike(const Mesh& mesh, const InspectSettings& settings, const Properties* alike) {
    ProgressSteps steps(lengths_of(settings));
    Properties p = inspect_placed(mesh, mesh.positions, false, settings, alike);
    steps.next();
    measure_requested(p, mesh, mesh, settings);
    return p;
}

Properties inspect_alike(const Part& part, const InspectSettings& settings, const Properties* alike) {
    if (part.transform.identity()) return inspect_alike(part.mesh, settings, alike);
    std::vector<Vec3> world(part.mesh.vertex_count());
    parallel_for(world.size(),
                 [&](std::size_t v) { world[v] = part.transform.point(part.mesh.positions[v]); });
    ProgressSteps steps(lengths_of(settings));
    Properties p = inspect_placed(part.mesh, world, part.transform.determinant() < 0, settings, alike);
    steps.next();
    if (settings.requested.empty()) return p;
    Mesh placed = part.mesh;
    placed.positions = std::move(world);
    measure_requested(p, placed, part.mesh, settings);
    return p;
}

} // namespace

Properties inspect(const Mesh& mesh, const InspectSettings& settings) {
    return inspect_alike(mesh, settings, nullptr);
}

Properties inspect(const Part& part, const InspectSettings& settings) {
    return inspect_alike(part, settings, nullptr);
}

Properties inspect(const Scene& scene, const InspectSettings& settings) {
    Properties sum;
    sum.parts = static_cast<std::int64_t>(scene.parts.size());
    sum.materials = static_cast<std::int64_t>(scene.materials.size());
    sum.unit = scene.unit;
    sum.up = scene.up;
    sum.genus = 0;
    sum.volume = 0;
    if (settings.self_intersections) sum.self_intersections = sum.touching = 0;
    std::vector<double> lengths;
    lengths.reserve(scene.parts.size());
    for (const Part& part : scene.parts) lengths.push_back(1 + static_cast<double>(part.mesh.face_count()));
    ProgressSteps steps(std::move(lengths));
    const DistinctParts meshes(scene);
    std::map<std::size_t, Properties> known; // properties of repeated meshes
    std::set<const Property*> incomplete;    // sums that lack the value of a part
    for (std::size_t i = 0; i < scene.parts.size(); ++i) {
        const auto alike = known.find(meshes.first[i]);
        const Properties own =
            inspect_alike(scene.parts[i], settings, alike == known.end() ? nullptr : &alike->second);
        if (meshes.uses[i] > 1) known.emplace(i, own);
        for (const Property& property : property_table()) Joiner(sum, own).add(property);
        for (const Property* property : settings.requested)
            if (lacks_value(*property, own)) incomplete.insert(property);
        steps.next();
    }
    std::erase_if(sum.requested, [&](const auto& value) { return incomplete.contains(value.first); });
    return sum;
}

std::vector<Properties> inspect_components(const Mesh& mesh, std::size_t limit) {
    const Components all = face_components(mesh);
    if (all.count == 1 && limit > 0) return {inspect(mesh)};
    std::vector<std::size_t> faces(all.count, 0);
    for (const Index component : all.of_face) ++faces[component];
    std::vector<Index> order(all.count), number(all.count, none);
    std::iota(order.begin(), order.end(), Index{0});
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return faces[a] > faces[b]; });
    order.resize(std::min(order.size(), limit));
    for (Index i = 0; i < order.size(); ++i) number[order[i]] = i;
    std::vector<Mesh> meshes(order.size());
    std::vector<Index> vertex(mesh.vertex_count(), none), face; // no two components share a vertex
    for (Index f = 0; f < mesh.face_count(); ++f) {
        if (number[all.of_face[f]] == none) continue;
        Mesh& one = meshes[number[all.of_face[f]]];
        face.clear();
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) {
            Index& v = vertex[mesh.vertex(c)];
            if (v == none) {
                v = static_cast<Index>(one.positions.size());
                one.positions.push_back(mesh.point(c));
            }
            face.push_back(v);
        }
        add_face(one, face);
    }
    std::vector<Properties> properties;
    properties.reserve(meshes.size());
    for (const Mesh& one : meshes) properties.push_back(inspect(one));
    return properties;
}

void InspectSettings::request(const Property& property) {
    if (property.costly) self_intersections = true;
    if (property.on_request() && std::find(requested.begin(), requested.end(), &property) == requested.end())
        requested.push_back(&property);
}

std::optional<double> Property::get(const Properties& properties) const {
    if (on_request()) {
        for (const auto& [property, value] : properties.requested)
            if (property == this) return value;
        return {};
    }
    return std::visit(MemberValue{properties}, member);
}

std::optional<double> measure(const Mesh& mesh, const Property& property) {
    const Properties none;
    return value_of(property, {mesh, mesh, none, {}});
}

} // namespace facetmill
