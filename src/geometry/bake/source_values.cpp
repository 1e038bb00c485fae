#include "geometry/bake/source_values.hpp"

#include "base/math/portable_math.hpp"
#include "geometry/normals/normals.hpp"
#include "geometry/normals/tangents.hpp"
#include "parallel/parallel.hpp"

#include <fmt/format.h>

namespace facetmill {

void prepare_bake_source(BakeSource& source) {
    if (!source.mesh.find("NORMAL", Domain::wedge))
        give_normals(source.mesh, NormalKind::smooth, 40 * pi / 180);
    if (source.mesh.find("TANGENT", Domain::wedge)) return;
    for (const MaterialLook& look : source.looks)
        if (look.normal_texture) {
            (void)give_tangents(source.mesh, look.normal_texture.set);
            return;
        }
}

namespace baking {

FloatColumn::FloatColumn(const Attribute* a) {
    if (!a) return;
    components = static_cast<std::size_t>(a->components);
    domain = a->domain;
    numbers.resize(a->size() * components);
    parallel_for(a->size(), [&](std::size_t i) {
        for (std::size_t c = 0; c < components; ++c)
            numbers[i * components + c] = static_cast<float>(a->value(i, static_cast<int>(c)));
    });
}

/// A place with its wedges and steps.
struct SourceReader::Point {
    const SourcePlace& place;
    const TexelSteps& steps;
    std::array<Index, 3> wedges;
    std::array<Vec3, 3> corners;
};

namespace {

const Attribute* colours_of(const Mesh& mesh) {
    for (const Attribute& a : mesh.attributes)
        if (a.role == Role::colour && a.components >= 3) return &a;
    return nullptr;
}

/// The grey that pictures give to surfaces without a material and colours.
constexpr std::array<float, 4> plain_surface{0.72F, 0.74F, 0.78F, 1};

float multiplied(float a, float b) { return std::clamp(a * b, 0.0F, 1.0F); }

/// The barycentric coordinates of a direction in the plane of a triangle, by least squares.
std::array<double, 2> along_edges(const Vec3& e1, const Vec3& e2, const Vec3& d) {
    const double a = dot(e1, e1), b = dot(e1, e2), c = dot(e2, e2), det = a * c - b * b;
    if (!(det > 0)) return {0, 0};
    const double x = dot(e1, d), y = dot(e2, d);
    return {(c * x - b * y) / det, (a * y - b * x) / det};
}

} // namespace

SourceReader::SourceReader(const BakeSource& source) : source_(source) {
    const Mesh& mesh = source.mesh;
    const Attribute* colours = colours_of(mesh);
    colours_ = FloatColumn(colours);
    normals_ = FloatColumn(mesh.find("NORMAL", Domain::wedge));
    tangents_ = FloatColumn(mesh.find("TANGENT", Domain::wedge));
    const std::size_t primitives = std::max<std::size_t>(1, mesh.primitives.size());
    looks_.resize(primitives);
    coloured_.resize(primitives);
    std::vector<std::uint8_t> sides(primitives);
    for (std::size_t p = 0; p < primitives; ++p) {
        const Index material = p < mesh.primitives.size() ? mesh.primitives[p].material : none;
        coloured_[p] = colours && (p >= mesh.primitives.size() || mesh.primitives[p].has(colours->name));
        looks_[p].metalness = 0;
        if (material == none && !coloured_[p]) looks_[p].base = plain_surface;
        if (material < source.looks.size()) looks_[p] = source.looks[material];
        if (material < source.double_sided.size()) sides[p] = source.double_sided[material];
        for (const Texture* t : {&looks_[p].base_texture, &looks_[p].normal_texture, &looks_[p].rough_texture,
                                 &looks_[p].emissive_texture, &looks_[p].occlusion_texture}) {
            if (!*t) continue;
            const auto set = static_cast<std::size_t>(std::clamp(t->set, 0, 255));
            if (uvs_.size() <= set) uvs_.resize(set + 1);
            if (!uvs_[set])
                uvs_[set] = FloatColumn(mesh.find(fmt::format("TEXCOORD_{}", set), Domain::wedge));
        }
    }
    if (mesh.find(primitive_attribute, Domain::face)) {
        primitives_.resize(mesh.face_count());
        for (std::size_t f = 0; f < primitives_.size(); ++f)
            primitives_[f] =
                std::min(mesh.primitive_of(static_cast<Index>(f)), static_cast<Index>(primitives - 1));
    }
    sides_.resize(mesh.face_count());
    for (std::size_t f = 0; f < sides_.size(); ++f)
        sides_[f] = sides[primitives_.empty() ? 0 : primitives_[f]];
}

template <std::size_t N>
std::array<double, N> SourceReader::mixed(const FloatColumn& column, const Point& point) const {
    std::array<double, N> sum{};
    const std::size_t n = std::min(N, column.components);
    for (std::size_t k = 0; k < 3; ++k) {
        const Index i = column.domain == Domain::face    ? point.place.face
                        : column.domain == Domain::wedge ? point.wedges[k]
                                                         : source_.mesh.vertex_of_wedge(point.wedges[k]);
        const float* numbers = &column.numbers[std::size_t{i} * column.components];
        for (std::size_t c = 0; c < n; ++c)
            sum[c] += point.place.weights[k] * static_cast<double>(numbers[c]);
    }
    return sum;
}

Texel SourceReader::sampled(const Texture& texture, const Point& point) const {
    const auto set = static_cast<std::size_t>(std::clamp(texture.set, 0, 255));
    if (set >= uvs_.size() || !uvs_[set] || uvs_[set].components < 2) return texture.sampled(0, 0, {});
    const FloatColumn& uvs = uvs_[set];
    const std::array<double, 2> uv = mixed<2>(uvs, point);
    TextureFootprint footprint;
    const Vec3 e1 = point.corners[1] - point.corners[0], e2 = point.corners[2] - point.corners[0];
    const auto number = [&](std::size_t k, std::size_t c) {
        const Index i =
            uvs.domain == Domain::vertex ? source_.mesh.vertex_of_wedge(point.wedges[k]) : point.wedges[k];
        return static_cast<double>(uvs.numbers[std::size_t{i} * uvs.components + c]);
    };
    const auto step = [&](const Vec3& d, double& du, double& dv) {
        const auto [a, b] = along_edges(e1, e2, d);
        du = a * (number(1, 0) - number(0, 0)) + b * (number(2, 0) - number(0, 0));
        dv = a * (number(1, 1) - number(0, 1)) + b * (number(2, 1) - number(0, 1));
    };
    step(point.steps.right, footprint.du_dx, footprint.dv_dx);
    step(point.steps.down, footprint.du_dy, footprint.dv_dy);
    return texture.sampled(uv[0], uv[1], footprint);
}

Vec3 SourceReader::normal(const Point& point, const MaterialLook& look) const {
    Vec3 normal;
    if (normals_) {
        const auto n = mixed<3>(normals_, point);
        normal = normalised({n[0], n[1], n[2]});
    }
    if (dot(normal, normal) == 0)
        normal = normalised(cross(point.corners[1] - point.corners[0], point.corners[2] - point.corners[0]));
    if (!look.normal_texture || !tangents_ || tangents_.components < 4) return normal;
    const Texel t = sampled(look.normal_texture, point);
    const auto tangent = mixed<4>(tangents_, point);
    const Vec3 along = normalised({tangent[0], tangent[1], tangent[2]});
    const Vec3 across = cross(normal, along) * (tangent[3] < 0 ? -1.0 : 1.0);
    const double scale = look.normal_scale;
    const auto number = [&](std::size_t c) { return 2 * static_cast<double>(t[c]) - 1; };
    const Vec3 bumped =
        normalised(along * (number(0) * scale) + across * (number(1) * scale) + normal * number(2));
    return dot(bumped, bumped) > 0 ? bumped : normal;
}

SourceValues SourceReader::at(const SourcePlace& place, const TexelSteps& steps) const {
    const Mesh& mesh = source_.mesh;
    const std::size_t first = 3 * std::size_t{place.face};
    Point point{place, steps, {}, {}};
    for (std::size_t k = 0; k < 3; ++k) {
        point.wedges[k] = mesh.corners[first + k];
        point.corners[k] = mesh.positions[mesh.vertex_of_wedge(point.wedges[k])];
    }
    const std::size_t primitive = primitives_.empty() ? 0 : primitives_[place.face];
    const MaterialLook& look = looks_[primitive];
    SourceValues v;
    v.base = look.base;
    if (look.base_texture) {
        const Texel t = sampled(look.base_texture, point);
        for (std::size_t c = 0; c < 4; ++c) v.base[c] *= t[c];
    }
    if (coloured_[primitive]) {
        const auto colour = mixed<4>(colours_, point);
        for (std::size_t c = 0; c < std::min<std::size_t>(4, colours_.components); ++c)
            v.base[c] *= static_cast<float>(std::clamp(colour[c], 0.0, 1.0));
    }
    if (look.alpha == MaterialLook::Alpha::opaque) v.base[3] = 1;
    if (look.alpha == MaterialLook::Alpha::mask) v.base[3] = v.base[3] < look.cutoff ? 0 : 1;
    v.emission = look.emissive;
    if (look.emissive_texture) {
        const Texel t = sampled(look.emissive_texture, point);
        for (std::size_t c = 0; c < 3; ++c) v.emission[c] *= t[c];
    }
    v.roughness = std::clamp(look.roughness, 0.0F, 1.0F);
    v.metalness = std::clamp(look.metalness, 0.0F, 1.0F);
    if (look.rough_texture) {
        const Texel t = sampled(look.rough_texture, point);
        v.roughness = multiplied(v.roughness, t[1]);
        v.metalness = multiplied(v.metalness, t[2]);
    }
    if (look.occlusion_texture) {
        v.occlusion = 1 + look.occlusion_strength * (sampled(look.occlusion_texture, point)[0] - 1);
        v.has_occlusion = true;
    }
    v.normal = normal(point, look);
    v.facet = normalised(cross(point.corners[1] - point.corners[0], point.corners[2] - point.corners[0]));
    return v;
}

} // namespace baking

} // namespace facetmill
