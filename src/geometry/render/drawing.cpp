#include "geometry/render/drawing.hpp"

#include "base/error.hpp"
#include "base/math/portable_math.hpp"
#include "geometry/normals/normals.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "mesh/transform.hpp"
#include "parallel/parallel.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

std::uint64_t edge_key(Index a, Index b) { return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b); }

/// The triangles to draw; null if the mesh can be drawn unchanged.
std::shared_ptr<const Mesh> mesh_to_draw(const Mesh& mesh, ShadingNormals normals) {
    const bool smooth =
        normals == ShadingNormals::smooth && mesh.face_count() > 0 && !mesh.find("NORMAL", Domain::wedge);
    if (mesh.all_triangles() && !smooth) return nullptr;
    Mesh own = mesh.all_triangles() ? mesh : triangles_of(mesh);
    if (smooth) give_normals(own, NormalKind::smooth, 40 * pi / 180);
    return std::make_shared<const Mesh>(std::move(own));
}

} // namespace

RealEdges::RealEdges(const Mesh& mesh) {
    if (mesh.all_triangles()) return;
    edges_.reserve(mesh.corner_count());
    for (Index f = 0; f < mesh.face_count(); ++f)
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
            edges_.push_back(
                edge_key(mesh.vertex(c), mesh.vertex(c + 1 < mesh.face_end(f) ? c + 1 : mesh.face_begin(f))));
    std::sort(edges_.begin(), edges_.end());
}

bool RealEdges::has(Index a, Index b) const {
    return edges_.empty() || std::binary_search(edges_.begin(), edges_.end(), edge_key(a, b));
}

PartDrawing::PartDrawing(const Part& part, const Scene& scene, const PictureSettings& settings,
                         const View& view, std::size_t number, const ValueRange& range, std::uint32_t first,
                         bool lines)
    : own_(mesh_to_draw(part.mesh, settings.normals)), mesh_(own_ ? own_.get() : &part.mesh),
      has_faces_(part.mesh.face_count() > 0), mirrored_(part.transform.determinant() < 0), first_(first),
      to_world_(part.transform), points_(mesh_->vertex_count()),
      painter_(std::make_unique<Painter>(*mesh_, scene, settings, number, range)) {
    parallel_for(points_.size(),
                 [&](std::size_t v) { points_[v] = view.of(to_world_.point(mesh_->positions[v])); });
    // Vertices keep their numbers when polygons are cut into triangles, so the edges of the polygons can be
    // found among the edges of the triangles.
    if (lines && has_faces_) lines_ = std::make_unique<RealEdges>(part.mesh);
    if (const Attribute* a = mesh_->find(primitive_attribute, Domain::face))
        primitive_of_face_ = std::get_if<std::vector<std::uint32_t>>(&a->data);
    if (settings.normals != ShadingNormals::flat) normals_ = mesh_->find("NORMAL", Domain::wedge);
    tangents_ = mesh_->find("TANGENT", Domain::wedge);
    for (int set = 0; set < 8; ++set)
        coordinates_.push_back(mesh_->find(fmt::format("TEXCOORD_{}", set), Domain::wedge));
}

FacePlace PartDrawing::place(const View& view, const CanvasTriangle& t, Index face, double x,
                             double y) const {
    FacePlace place;
    place.face = face;
    for (Index k = 0; k < 3; ++k) place.wedges[k] = mesh_->corners[3 * face + k];
    place.weights = t.weights(x, y);
    if (!view.eye) return place;
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += place.weights[k] *= view.nearness(t.p[k].z);
    place.weights = place.weights / sum;
    return place;
}

FacePlace PartDrawing::vertex_place(Index vertex) const {
    FacePlace place;
    if (!mesh_->has_seams()) place.wedges[0] = vertex;
    return place;
}

bool PartDrawing::has(Index face, const Attribute& a) const {
    const std::size_t p = primitive_of_face_ ? (*primitive_of_face_)[face] : 0;
    return p >= mesh_->primitives.size() || mesh_->primitives[p].has(a.name);
}

std::optional<Vec3> PartDrawing::normal(const View& view, const FacePlace& place) const {
    if (!normals_ || normals_->components != 3 || (!own_ && !has(place.face, *normals_))) return {};
    const auto n = mixed<3>(*normals_, *mesh_, place);
    Vec3 world = moved_normal(to_world_, {n[0], n[1], n[2]});
    if (mirrored_) world = -world;
    const Vec3 seen = normalised(view.direction(world));
    if (!(length(seen) > 0.5)) return {};
    return seen;
}

const Attribute* PartDrawing::coordinates(Index face, int set) const {
    if (set < 0 || static_cast<std::size_t>(set) >= coordinates_.size()) return nullptr;
    const Attribute* a = coordinates_[static_cast<std::size_t>(set)];
    return a && a->components == 2 && has(face, *a) ? a : nullptr;
}

std::optional<std::pair<Vec3, double>> PartDrawing::tangent(const View& view, const FacePlace& place) const {
    if (!tangents_ || tangents_->components != 4 || !has(place.face, *tangents_)) return {};
    const auto t = mixed<4>(*tangents_, *mesh_, place);
    const Vec3 seen = normalised(view.direction(to_world_.vector({t[0], t[1], t[2]})));
    if (!(length(seen) > 0.5)) return {};
    return std::pair(seen, t[3] < 0 ? -1.0 : 1.0);
}

std::array<bool, 3> PartDrawing::lines(Index face) const {
    std::array<bool, 3> drawn{};
    for (Index k = 0; lines_ && k < 3; ++k)
        drawn[k] = lines_->has(mesh_->vertex(3 * face + (k + 1) % 3), mesh_->vertex(3 * face + (k + 2) % 3));
    return drawn;
}

SceneDrawing::SceneDrawing(const Scene& scene, const PictureSettings& settings, const View& view,
                           const ValueRange& range) {
    const bool lines = settings.edges == EdgeLines::all ||
                       (settings.edges == EdgeLines::few && scene.face_count() <= settings.few);
    std::size_t next = 0;
    for (const Part& part : scene.parts) {
        if (settings.shows && !settings.shows(part)) continue;
        faces_ += part.mesh.face_count();
        parts_.emplace_back(part, scene, settings, view, parts_.size(), range,
                            static_cast<std::uint32_t>(next), lines);
        next += parts_.back().count();
        if (next >= none)
            throw Error(ErrorKind::limit, "E-LIMIT",
                        "a picture shows at most 4294967294 triangles and points",
                        "render the parts one by one (only)");
    }
}

const PartDrawing& SceneDrawing::part_of(std::uint32_t number) const {
    const auto after = std::upper_bound(parts_.begin(), parts_.end(), number,
                                        [](std::uint32_t n, const PartDrawing& p) { return n < p.first(); });
    return *(after - 1);
}

} // namespace facetmill
