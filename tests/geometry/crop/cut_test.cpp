#include "geometry/crop/cut.hpp"

#include "mesh/shapes.hpp"
#include "support/catch.hpp"

#include <algorithm>

using namespace facetmill;

namespace {

Mesh moved(Mesh mesh, const Vec3& by) {
    for (Vec3& p : mesh.positions) p += by;
    return mesh;
}

/// Parts that have no vertex in common, some with seams, all crossed by one outline; some twice, on two
/// sides.
std::vector<Mesh> parts() {
    return {shapes::uv_cube(), moved(shapes::uv_cube(), {2, 0, 0}), moved(shapes::uv_cube(), {3, 0.1, 0.2})};
}
const Footprint outline({{{0.125, 0.25}, {3.5, 0.25}, {3.75, 0.5}, {3.5, 0.75}, {2.5, 0.5}, {0.125, 0.75}}});

OutlineCut cut(const Mesh& mesh) {
    const CropSettings settings;
    CutMemory memory;
    return cut_at_outline(mesh, CropView(outline, settings), memory);
}

/// The values of each corner of each face.
using Corner = std::array<double, 5>;
std::vector<std::vector<Corner>> faces_of(const OutlineCut& cut) {
    std::vector<std::vector<Corner>> faces;
    const Attribute* uv = cut.mesh.find("TEXCOORD_0", Domain::wedge);
    REQUIRE(uv);
    for (Index f = 0; f < cut.mesh.face_count(); ++f) {
        faces.emplace_back();
        for (const Index w : cut.mesh.face_wedges(f)) {
            const Vec3 p = cut.mesh.positions[cut.mesh.vertex_of_wedge(w)];
            faces.back().push_back({p.x, p.y, p.z, uv->value(w, 0), uv->value(w, 1)});
        }
    }
    return faces;
}

} // namespace

TEST_CASE("parts of a mesh are cut as they are alone", "[geometry]") {
    Mesh all;
    std::vector<std::vector<Corner>> alone;
    std::size_t cut_faces = 0;
    for (const Mesh& part : parts()) {
        const OutlineCut of_part = cut(part);
        const auto faces = faces_of(of_part);
        alone.insert(alone.end(), faces.begin(), faces.end());
        cut_faces += of_part.cut_faces;
        if (all.face_count() == 0)
            all = part;
        else
            append(all, part);
    }
    const OutlineCut together = cut(all);
    CHECK(faces_of(together) == alone);
    CHECK(together.cut_faces == cut_faces);
    CHECK(cut_faces > 10);
}

TEST_CASE("points of a cut are numbered by segments, then by their edges, wherever they are", "[geometry]") {
    Mesh all = parts()[0];
    append(all, parts()[1]);
    append(all, parts()[2]);
    const OutlineCut together = cut(all);
    const auto& segments = outline.tree().edges();
    const auto is_on = [&](Index s, const Vec3& p) {
        const auto& e = segments[s];
        const Vec2 d = e.b - e.a;
        return std::abs(cross(d, Vec2{p.x, p.y} - e.a)) < 1e-9;
    };
    Index s = 0;
    for (std::size_t v = all.vertex_count(); v < together.mesh.vertex_count(); ++v) {
        while (s < segments.size() && !is_on(s, together.mesh.positions[v])) ++s;
        REQUIRE(s < segments.size());
    }
    CHECK(s == segments.size() - 1);
}
