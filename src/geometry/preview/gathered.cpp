#include "geometry/preview/gathered.hpp"

#include "geometry/cut/cap_paint.hpp"
#include "mesh/transform.hpp"

#include <algorithm>

namespace facetmill {

namespace {

const Attribute* normals_in(const Mesh& mesh) {
    const Attribute* a = mesh.find("NORMAL", Domain::wedge);
    return a && a->components == 3 ? a : nullptr;
}

float finite_or(double x, float otherwise) { return std::isfinite(x) ? static_cast<float>(x) : otherwise; }

} // namespace

const Attribute* colours_in(const Mesh& mesh) {
    for (const Attribute& a : mesh.attributes)
        if (a.role == Role::colour && a.components >= 3) return &a;
    return nullptr;
}

PreviewAttributes preview_attributes(const Scene& scene, const ResolvedMaterials* materials) {
    PreviewAttributes out{.normals = true};
    for (const Part& part : scene.parts) {
        if (part.mesh.face_count() > 0 && !normals_in(part.mesh)) out.normals = false;
        out.colours |= colours_in(part.mesh) != nullptr;
    }
    if (materials)
        out.textures = std::any_of(materials->begin(), materials->end(), [](const MaterialLook& look) {
            return static_cast<bool>(look.base_texture);
        });
    return out;
}

struct Gatherer::Placed {
    const Mesh& mesh;
    const Transform& to_world;
    Transform
        normals; ///< from the world to the part; pull_normal with it converts the part's normals to the world
    const Attribute *colours, *own_normals;
    std::vector<Index> vertices, wedges; ///< [the mesh's vertices, wedges] number in the result, or none
    std::vector<Index>
        primitives; ///< [the mesh's primitives, for other faces and for caps] number in the result, or none
    std::vector<Index> wedge_primitive; ///< [wedges] primitive in the result
    std::vector<std::uint8_t> is_cap;   ///< [faces] 1 for caps; or empty

    Placed(const Mesh& m, const Transform& t, const std::optional<Index>& last_cap)
        : mesh(m), to_world(t), normals(inverse(t).value_or(Transform{})), colours(colours_in(m)),
          own_normals(normals_in(m)), vertices(m.vertex_count(), none), wedges(m.wedge_count(), none),
          primitives(2 * std::max<std::size_t>(1, m.primitives.size()), none),
          wedge_primitive(m.wedge_count(), none) {
        if (last_cap) is_cap = later_caps(m, *last_cap);
    }
};

Gatherer::Gatherer(const Scene& scene, const ResolvedMaterials* materials, PreviewAttributes wanted)
    : scene_(scene), materials_(materials), wanted_(wanted) {}

Index Gatherer::primitive_for(Placed& placed, Index face) {
    const Mesh& mesh = placed.mesh;
    const Index own = mesh.primitives.empty() ? 0 : mesh.primitive_of(face);
    const bool cap = !placed.is_cap.empty() && placed.is_cap[face] != 0;
    const std::size_t last = placed.primitives.size() / 2 - 1;
    Index& known = placed.primitives[2 * std::min<std::size_t>(own, last) + (cap ? 1 : 0)];
    if (known != none) return known;
    PreviewPaint paint;
    paint.cap = cap;
    if (own < mesh.primitives.size()) paint.material = mesh.primitives[own].material;
    if (paint.material >= scene_.materials.size()) paint.material = none;
    paint.coloured =
        placed.colours && (own >= mesh.primitives.size() || mesh.primitives[own].has(placed.colours->name));
    const auto same = std::find_if(out_.paints.begin(), out_.paints.end(), [&](const PreviewPaint& p) {
        return p.material == paint.material && p.coloured == paint.coloured && p.cap == paint.cap;
    });
    known = static_cast<Index>(same - out_.paints.begin());
    if (same == out_.paints.end()) out_.paints.push_back(paint);
    return known;
}

void Gatherer::push_attributes(const Placed& placed, Index face, Index wedge, const PreviewPaint& paint) {
    if (wanted_.normals) {
        Vec3 n;
        for (int c = 0; c < 3; ++c)
            n[static_cast<std::size_t>(c)] = finite_or(placed.own_normals->value(wedge, c), 0);
        n = normalised(placed.normals.pull_normal(n));
        for (std::size_t c = 0; c < 3; ++c) normals_.push_back(finite_or(n[c], 0));
    }
    const MaterialLook* look =
        materials_ && paint.material < materials_->size() ? &(*materials_)[paint.material] : nullptr;
    const Texture* texture = look && look->base_texture ? &look->base_texture : nullptr;
    double u = 0, v = 0;
    if (texture)
        if (const Attribute* uv =
                placed.mesh.find("TEXCOORD_" + std::to_string(texture->set), Domain::wedge)) {
            u = finite_or(uv->value(wedge, 0), 0);
            v = finite_or(uv->value(wedge, 1), 0);
        }
    if (wanted_.colours || wanted_.baked) {
        std::array<float, 4> colour{1, 1, 1, 1};
        if (paint.coloured) {
            const Attribute& own = *placed.colours;
            const std::size_t at = own.domain == Domain::face     ? face
                                   : own.domain == Domain::vertex ? placed.mesh.vertex_of_wedge(wedge)
                                                                  : wedge;
            for (int c = 0; c < std::min(own.components, 4); ++c)
                colour[static_cast<std::size_t>(c)] = std::clamp(finite_or(own.value(at, c), 0), 0.0f, 1.0f);
        }
        if (wanted_.baked && texture) {
            constexpr double step = 1.0 / 512;
            const Texel t = texture->sampled(u, v, {step, 0, 0, step});
            for (std::size_t c = 0; c < 4; ++c) colour[c] *= t[c];
        }
        colours_.insert(colours_.end(), colour.begin(), colour.end());
    }
    if (!wanted_.textures) return;
    const std::array<double, 6> m = texture ? texture->transform : std::array<double, 6>{1, 0, 0, 0, 1, 0};
    coordinates_.push_back(finite_or(m[0] * u + m[1] * v + m[2], 0));
    coordinates_.push_back(finite_or(m[3] * u + m[4] * v + m[5], 0));
}

Index Gatherer::wedge_for(Placed& placed, Index corner, Index primitive) {
    const Mesh& mesh = placed.mesh;
    const Index wedge = mesh.corners[corner], vertex = mesh.vertex_of_wedge(wedge);
    const bool of_faces =
        placed.colours && placed.colours->domain == Domain::face && (wanted_.colours || wanted_.baked);
    if (placed.wedges[wedge] != none && placed.wedge_primitive[wedge] == primitive && !of_faces)
        return placed.wedges[wedge];
    Mesh& out = out_.mesh;
    if (placed.vertices[vertex] == none) {
        placed.vertices[vertex] = static_cast<Index>(out.positions.size());
        out.positions.push_back(placed.to_world.point(mesh.positions[vertex]));
    }
    placed.wedges[wedge] = static_cast<Index>(out.wedge_vertex.size());
    placed.wedge_primitive[wedge] = primitive;
    out.wedge_vertex.push_back(placed.vertices[vertex]);
    push_attributes(placed, corner / 3, wedge, out_.paints[primitive]);
    return placed.wedges[wedge];
}

void Gatherer::add(const Mesh& triangles, const Transform& to_world, std::span<const Index> corners) {
    Placed placed(triangles, to_world, wanted_.last_cap);
    const bool mirrored = to_world.determinant() < 0;
    for (std::size_t c = 0; c + 2 < corners.size(); c += 3) {
        std::array<Index, 3> face{corners[c], corners[c + 1], corners[c + 2]};
        if (mirrored) std::swap(face[1], face[2]);
        if (!std::all_of(face.begin(), face.end(),
                         [&](Index corner) { return is_finite(to_world.point(triangles.point(corner))); }))
            continue;
        const Index primitive = primitive_for(placed, face[0] / 3);
        for (const Index corner : face) out_.mesh.corners.push_back(wedge_for(placed, corner, primitive));
        primitives_.push_back(primitive);
    }
}

Preview Gatherer::finish() {
    Mesh& mesh = out_.mesh;
    const auto put = [&](const char* name, Role role, int components, std::vector<float>& data) {
        if (!data.empty())
            mesh.attributes.push_back({name, Domain::wedge, role, components, false, std::move(data)});
    };
    put("NORMAL", Role::normal, 3, normals_);
    put("COLOR_0", Role::colour, 4, colours_);
    put("TEXCOORD_0", Role::uv, 2, coordinates_);
    for (std::size_t i = 0; i < out_.paints.size(); ++i)
        mesh.primitives.push_back({out_.paints[i].material, {}, {}});
    if (!primitives_.empty())
        mesh.attributes.push_back(
            {std::string(primitive_attribute), Domain::face, Role::index, 1, false, std::move(primitives_)});
    return std::move(out_);
}

} // namespace facetmill
