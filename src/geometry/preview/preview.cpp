#include "geometry/preview/preview.hpp"

#include "geometry/preview/gathered.hpp"
#include "geometry/preview/grid.hpp"
#include "geometry/preview/loose.hpp"
#include "geometry/simplify/simplify.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

namespace facetmill {

namespace {

/// Scenes with this multiple of the requested triangles go through a grid first, which takes a tenth of the
/// time of simplification. The grid would tear textures, so scenes with textures have a higher limit, and
/// their textures become colours.
constexpr std::size_t many = 2, many_with_textures = 20;

std::size_t triangles_in(const Mesh& mesh) {
    if (mesh.all_triangles()) return mesh.face_count();
    std::size_t sum = 0;
    for (Index f = 0; f < mesh.face_count(); ++f) sum += std::max<std::size_t>(mesh.face_size(f), 2) - 2;
    return sum;
}

/// The area of a mesh in the world. For a large mesh, estimated from every seventh face.
double area_of(const Mesh& mesh, const Transform& to_world) {
    constexpr std::size_t large = 100000, of_large = 7;
    const std::size_t step = mesh.face_count() > large ? of_large : 1;
    return static_cast<double>(step) *
           parallel_reduce(
               mesh.face_count() / step, 0.0,
               [&](std::size_t begin, std::size_t end) {
                   double sum = 0;
                   for (std::size_t f = begin * step; f < end * step; f += step) {
                       const Index first = mesh.face_begin(static_cast<Index>(f)),
                                   last = mesh.face_end(static_cast<Index>(f));
                       Vec3 twice;
                       for (Index c = first + 1; c + 1 < last; ++c)
                           twice += cross(to_world.vector(mesh.point(c) - mesh.point(first)),
                                          to_world.vector(mesh.point(c + 1) - mesh.point(first)));
                       if (const double area = length(twice) / 2; std::isfinite(area)) sum += area;
                   }
                   return sum;
               },
               [](double a, double b) { return a + b; });
}

/// The size of cells so that the surface meets about this many.
double cell_edge(const Scene& scene, std::size_t cells) {
    double area = 0;
    for (const Part& part : scene.parts) area += area_of(part.mesh, part.transform);
    constexpr double met = 1.6; // average number of cells that a plane meets, per cell-sized area
    return std::sqrt(met * area / static_cast<double>(cells));
}

/// The mesh reduced to the triangles with these corners, three each.
Mesh with_corners(Mesh mesh, const std::vector<Index>& corners) {
    std::vector<Index> wedges(corners.size()), faces(corners.size() / 3);
    for (std::size_t c = 0; c < corners.size(); ++c) wedges[c] = mesh.corners[corners[c]];
    for (std::size_t f = 0; f < faces.size(); ++f) faces[f] = corners[3 * f] / 3;
    mesh.corners = std::move(wedges);
    for (Attribute& a : mesh.attributes)
        if (a.domain == Domain::face) a.select(faces);
    drop_unused(mesh);
    return mesh;
}

/// The corners of every n-th face, at most this many faces.
std::vector<Index> every_nth_face(const Mesh& mesh, std::size_t faces) {
    const std::size_t step = (mesh.face_count() + faces - 1) / faces;
    std::vector<Index> corners;
    for (std::size_t f = 0; f < mesh.face_count(); f += step)
        for (std::size_t c = 3 * f; c < 3 * f + 3; ++c) corners.push_back(static_cast<Index>(c));
    return corners;
}

/// Keeps every n-th component, so that about this many faces are left if components are small.
Mesh without_some_components(Mesh mesh, std::size_t faces) {
    const Components components = face_components(mesh);
    const std::size_t step = (mesh.face_count() + faces - 1) / faces;
    if (components.count < 2 * step) return mesh;
    std::vector<Index> corners;
    for (Index f = 0; f < mesh.face_count(); ++f)
        if (components.of_face[f] % step == 0)
            for (Index c = 3 * f; c < 3 * f + 3; ++c) corners.push_back(c);
    return with_corners(std::move(mesh), corners);
}

/// The mesh simplified to at most about this many triangles, with a subset of its vertices.
Mesh reduced(Mesh mesh, std::size_t faces) {
    SimplifySettings settings;
    settings.method = SimplifySettings::Method::quadric_endpoints;
    settings.faces = faces;
    mesh = simplify(std::move(mesh), settings).mesh;
    const std::size_t enough = faces + faces / 4;
    if (mesh.face_count() > enough) mesh = without_some_components(std::move(mesh), faces);
    // The surface is nowhere manifold, so no edge may be collapsed.
    double cell = std::sqrt(area_of(mesh, {}) / static_cast<double>(faces));
    while (mesh.face_count() > enough) {
        auto corners = corners_in_cells(mesh, {}, cell);
        if (corners.empty() || corners.size() == mesh.corner_count()) corners = every_nth_face(mesh, faces);
        mesh = with_corners(std::move(mesh), corners);
        cell *= 1.5;
    }
    return mesh;
}

/// The parts as a single mesh: all of their triangles or, with a cell size, the triangles between the
/// vertices that a grid leaves.
Preview gathered(const Scene& scene, const ResolvedMaterials* materials, const PreviewAttributes& wanted,
                 std::optional<double> cell) {
    Gatherer gatherer(scene, materials, wanted);
    for (const Part& part : scene.parts) {
        if (part.mesh.face_count() == 0) continue;
        const bool as_it_is = part.mesh.all_triangles();
        const Mesh cut = as_it_is ? Mesh{} : triangles_of(part.mesh);
        const Mesh& triangles = as_it_is ? part.mesh : cut;
        std::vector<Index> corners;
        if (cell)
            corners = corners_in_cells(triangles, part.transform, *cell);
        else {
            corners.resize(triangles.corner_count());
            std::iota(corners.begin(), corners.end(), Index{0});
        }
        gatherer.add(triangles, part.transform, corners);
    }
    return gatherer.finish();
}

/// A preview of only the faces.
Preview surface_preview(const Scene& scene, const PreviewSettings& settings) {
    std::size_t faces = 0;
    for (const Part& part : scene.parts) faces += triangles_in(part.mesh);
    if (faces == 0) return {};
    const ResolvedMaterials* materials = settings.materials.get();
    PreviewAttributes wanted = preview_attributes(scene, materials);
    wanted.last_cap = settings.last_cap;
    wanted.baked = wanted.textures && faces > many_with_textures * settings.faces;
    if (wanted.baked) wanted.textures = false;
    std::optional<double> cell;
    if (!wanted.textures && faces > many * settings.faces)
        cell = cell_edge(scene,
                         settings.faces * 3 / 4); // a cell that the surface meets gives almost two triangles
    Preview out = gathered(scene, materials, wanted, cell);
    // A surface of components smaller than a cell has no triangles between cells.
    if (cell && out.mesh.face_count() < settings.faces / 4) out = gathered(scene, materials, wanted, {});
    out.faces = faces;
    if (out.mesh.face_count() > settings.faces) out.mesh = reduced(std::move(out.mesh), settings.faces);
    return out;
}

} // namespace

Preview preview_of(const Scene& scene, const PreviewSettings& settings) {
    Preview out = surface_preview(scene, settings);
    append_loose(out, loose_parts(scene, settings.materials.get(), settings.faces));
    return out;
}

} // namespace facetmill
