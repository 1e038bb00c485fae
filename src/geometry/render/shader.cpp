#include "geometry/render/shader.hpp"

#include "base/math/whole_number.hpp"
#include "geometry/render/srgb.hpp"

namespace facetmill {

namespace {

constexpr Colour inner_side{0.75f, 0.3f, 0.12f};
constexpr double ambient = 0.16, direct = 0.84;

Texel opaque(const Colour& c) { return {c[0], c[1], c[2], 1}; }

std::pair<double, double> coordinates_at(const Attribute& uv, const FacePlace& place) {
    double u = 0, v = 0; // doubles, because floats are too coarse for differences far from zero
    for (std::size_t k = 0; k < 3; ++k) {
        u += place.weights[k] * uv.value(place.wedges[k], 0);
        v += place.weights[k] * uv.value(place.wedges[k], 1);
    }
    return {u, v};
}

} // namespace

/// The derivatives between neighbouring pixels give the footprint of textures.
struct Shader::Spot {
    const PartDrawing& part;
    const CanvasTriangle& t;
    Index face;
    const MaterialLook* look;
    FacePlace at, right, below;
    bool front, double_sided;

    Spot(const PartDrawing& p, const View& view, const CanvasTriangle& triangle, Index f, double x, double y)
        : part(p), t(triangle), face(f), look(p.painter().look(f)), at(p.place(view, t, f, x, y)),
          front(p.front(t.p)), double_sided(p.painter().double_sided(f)) {
        if (!look) return;
        right = p.place(view, t, f, x + Canvas::samples, y);
        below = p.place(view, t, f, x, y + Canvas::samples);
    }
};

Vec3 Shader::facing_normal(const std::array<Vec3, 3>& p) const {
    const Vec3 a = view_.place(p[0]), b = view_.place(p[1]), c = view_.place(p[2]);
    const Vec3 n = normalised(cross(b - a, c - a));
    return dot(n, view_.to_viewer(a)) < 0 ? -n : n;
}

Texel Shader::textured(const Spot& spot, const Texture& texture) const {
    const Attribute* uv = spot.part.coordinates(spot.face, texture.set);
    if (!uv) return {1, 1, 1, 1};
    const auto [u, v] = coordinates_at(*uv, spot.at);
    const auto [u_right, v_right] = coordinates_at(*uv, spot.right);
    const auto [u_below, v_below] = coordinates_at(*uv, spot.below);
    return texture.sampled(u, v, {u_right - u, v_right - v, u_below - u, v_below - v});
}

Texel Shader::base_colour(const Spot& spot, bool inside) const {
    Texel colour = spot.part.painter().of(spot.at);
    if (spot.look && spot.look->base_texture) {
        const Texel t = textured(spot, spot.look->base_texture);
        for (std::size_t c = 0; c < 4; ++c) colour[c] *= t[c];
    }
    if (inside)
        for (std::size_t c = 0; c < 3; ++c) colour[c] = inner_side[c];
    return colour;
}

/// The directions in which u and v grow on the surface, perpendicular to the normal.
std::optional<std::pair<Vec3, Vec3>> Shader::tangents(const Spot& spot, const Vec3& normal) const {
    const Texture& texture = spot.look->normal_texture;
    if (const auto own = texture.set == 0 ? spot.part.tangent(view_, spot.at) : std::nullopt) {
        const Vec3 t = normalised(own->first - normal * dot(normal, own->first));
        // The canvas' axes are left-handed: y points down.
        return std::pair(t, cross(t, normal) * own->second);
    }
    const Attribute* uv = spot.part.coordinates(spot.face, texture.set);
    if (!uv) return {};
    std::array<Vec3, 3> p, w;
    for (std::size_t k = 0; k < 3; ++k) {
        p[k] = view_.place(spot.t.p[k]);
        w[k] = {uv->value(spot.at.wedges[k], 0), uv->value(spot.at.wedges[k], 1), 0};
    }
    const Vec3 e = p[1] - p[0], f = p[2] - p[0], a = w[1] - w[0], b = w[2] - w[0];
    const double area = a.x * b.y - b.x * a.y;
    if (area == 0) return {};
    // In glTF v grows downwards, and the green of a normal map points up.
    const Vec3 along_u = (e * b.y - f * a.y) / area, against_v = (e * b.x - f * a.x) / area;
    return std::pair(normalised(along_u - normal * dot(normal, along_u)),
                     normalised(against_v - normal * dot(normal, against_v)));
}

/// The normal, perturbed by the normal map.
Vec3 Shader::bumped(const Spot& spot, const Vec3& normal) const {
    const auto axes = tangents(spot, normal);
    if (!axes) return normal;
    const Texel t = textured(spot, spot.look->normal_texture);
    const double scale = spot.look->normal_scale;
    const Vec3 n{(2.0 * t[0] - 1) * scale, (2.0 * t[1] - 1) * scale, 2.0 * t[2] - 1};
    const Vec3 bent = axes->first * n.x + axes->second * n.y + normal * n.z;
    return length(bent) > 0 && is_finite(bent) ? normalised(bent) : normal;
}

const LastFacings::Facing& Shader::facing(std::uint32_t number, const PartDrawing& part,
                                          LastFacings& last) const {
    LastFacings::Facing& facing = last.at(number);
    if (facing.number == number) return facing;
    const auto corners = part.corners(number - part.first());
    return facing = {number, part.front(corners), facing_normal(corners)};
}

/// The normal of the visible side. facing: facing_normal.
Vec3 Shader::normal_at(const Spot& spot, const Vec3& facing) const {
    Vec3 outer = facing; // points to the viewer; the outer normal of a front face
    if (const auto own = spot.part.normal(view_, spot.at))
        outer = *own;
    else if (!spot.front)
        outer = -outer;
    if (spot.look && spot.look->normal_texture) outer = bumped(spot, outer);
    return spot.front ? outer : -outer;
}

/// The cosine between the normal and the light, or 0 for light from behind. right_side: materials show the
/// visible side.
double Shader::in_light(const Vec3& normal, bool right_side) const {
    static const Vec3 light = normalised(Vec3{-0.35, -0.55, 0.75}); // light from the viewer's upper left
    double amount = dot(normal, light);
    if (settings_.shading == Shading::one_sided && !right_side) amount = -amount;
    if (settings_.shading == Shading::absolute) amount = std::abs(amount);
    return std::max(0.0, amount);
}

/// The brightness of a point in the light, including ambient light, as a share of its colour.
double Shader::lit(const Spot& spot, const Vec3& normal) const {
    double around = ambient;
    if (spot.look && spot.look->occlusion_texture)
        around *= 1 + spot.look->occlusion_strength * (textured(spot, spot.look->occlusion_texture)[0] - 1);
    return around + direct * in_light(normal, spot.front || spot.double_sided);
}

/// The x, y and z of the face's own world normal, mapped to the range from 0 to 1. The result is linear, so
/// that the stored sRGB bytes are exact.
Colour Shader::of_direction(const Spot& spot, const Vec3& facing) const {
    const Vec3 n = spot.front ? facing : -facing;
    const Vec3 world = view_.right * n.x - view_.up * n.y + view_.towards * n.z;
    Colour colour{};
    for (std::size_t c = 0; c < 3; ++c)
        colour[c] = linear_of(whole_number<std::uint8_t>(std::floor(255 * (0.5 + 0.5 * world[c]) + 0.5)));
    return colour;
}

/// Like `colour`, for a face with a single colour: without textures, vertex colours or vertex normals.
Texel Shader::plain(const Texel& paint, const LastFacings::Facing& facing, bool double_sided,
                    float open) const {
    const bool right_side = facing.front || double_sided;
    const float amount = static_cast<float>(ambient + direct * in_light(facing.normal, right_side)) * open;
    Texel colour = settings_.shading == Shading::sides && !right_side ? opaque(inner_side) : paint;
    for (std::size_t c = 0; c < 3; ++c) colour[c] *= amount;
    colour[3] = 1;
    return colour;
}

Texel Shader::colour(std::uint32_t number, double x, double y, float open, LastFacings& last) const {
    const PartDrawing& part = drawing_.part_of(number);
    const Index i = number - part.first();
    if (!part.has_faces()) return part.painter().of(part.vertex_place(i));
    if (const Texel* paint = part.painter().plain(i); paint && !part.has_normals())
        return plain(*paint, facing(number, part, last), part.painter().double_sided(i), open);
    const CanvasTriangle t = part.triangle(i);
    const Spot spot(part, view_, t, i, x, y);
    const Vec3& facing_it = facing(number, part, last).normal;
    if (part.painter().by_normal()) return opaque(of_direction(spot, facing_it));
    const bool inside = settings_.shading == Shading::sides && !spot.front && !spot.double_sided;
    Texel colour = base_colour(spot, inside);
    if (!spot.look || spot.look->alpha != MaterialLook::Alpha::blend) colour[3] = 1;
    if (spot.look && spot.look->unlit && !inside) return colour;
    const auto amount = static_cast<float>(lit(spot, normal_at(spot, facing_it))) * open;
    for (std::size_t c = 0; c < 3; ++c) colour[c] *= amount;
    if (!spot.look || inside) return colour;
    Texel glow{1, 1, 1, 1};
    if (spot.look->emissive_texture) glow = textured(spot, spot.look->emissive_texture);
    for (std::size_t c = 0; c < 3; ++c) colour[c] += spot.look->emissive[c] * glow[c];
    return colour;
}

bool Shader::is_solid(const PartDrawing& part, const CanvasTriangle& t, Index face, double x,
                      double y) const {
    const Spot spot(part, view_, t, face, x, y);
    return base_colour(spot, false)[3] >= spot.look->cutoff;
}

} // namespace facetmill
