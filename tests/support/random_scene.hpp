#pragma once
// Random scenes: small surfaces of every kind, with every kind of damage.

#include "io/codec.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "support/draw.hpp"
#include "support/meshes.hpp"

#include <limits>

namespace facetmill::test {

/// Faces of three to seven corners with random vertices, some of them repeated.
inline Mesh random_polygons(Draw& draw) {
    Mesh mesh;
    const std::size_t vertices = 3 + draw.below(20);
    for (std::size_t v = 0; v < vertices; ++v)
        mesh.positions.push_back({draw.between(-1, 1), draw.between(-1, 1), draw.between(-1, 1)});
    for (std::size_t faces = 1 + draw.below(30); faces > 0; --faces) {
        std::vector<Index> face(3 + (draw.once_in(3) ? draw.below(5) : 0));
        for (Index& v : face) v = static_cast<Index>(draw.below(vertices));
        add_face(mesh, face);
    }
    return mesh;
}

inline Mesh random_shape(Draw& draw) {
    using namespace shapes;
    switch (draw.below(20)) {
    case 0:
        return tetrahedron();
    case 1:
        return cube();
    case 2:
        return quad_cube();
    case 3:
        return uv_cube();
    case 4:
        return octahedron();
    case 5:
    case 6:
        return icosphere(static_cast<int>(draw.below(3)));
    case 7:
        return torus(3 + static_cast<int>(draw.below(12)), 3 + static_cast<int>(draw.below(8)));
    case 8:
        return grid(1 + static_cast<int>(draw.below(6)), 1 + static_cast<int>(draw.below(6)));
    case 9:
        return open_cone(3 + static_cast<int>(draw.below(12)));
    case 10:
        return bowtie();
    case 11:
        return fan3();
    case 12:
        return hourglass();
    case 13:
        return moebius(3 + static_cast<int>(draw.below(8)));
    case 14:
        return crossing();
    case 15:
        return folded_quad();
    case 16:
        return random_triangles(1 + draw.below(30), draw.between(0.05, 1), draw.bits());
    case 17:
        return draw.once_in(8) ? Mesh{} : random_polygons(draw);
    case 18:
        return draw.once_in(10) ? icosphere(5) : icosphere(1); // more faces than a chunk of a parallel loop
    default:
        return with_uv_seams(icosphere(1), 1 + static_cast<int>(draw.below(4)));
    }
}

/// Removes, duplicates and reverses faces, and moves corners to other wedges.
inline Mesh damaged_faces(const Mesh& mesh, Draw& draw) {
    Mesh result = mesh;
    result.corners.clear();
    result.face_offsets.clear();
    std::erase_if(result.attributes, [](const Attribute& a) { return a.domain == Domain::face; });
    const std::size_t rate = 2 + draw.below(30);
    for (Index f = 0; f < mesh.face_count(); ++f) {
        std::vector<Index> face(mesh.face_wedges(f).begin(), mesh.face_wedges(f).end());
        if (draw.once_in(rate)) continue;
        if (draw.once_in(rate)) std::reverse(face.begin(), face.end());
        if (draw.once_in(rate)) add_face(result, face);
        if (draw.once_in(rate))
            face[draw.below(face.size())] = static_cast<Index>(draw.below(mesh.wedge_count()));
        add_face(result, face);
    }
    return result;
}

/// A number of any magnitude, often at a limit of arithmetic.
inline double extreme_number(Draw& draw) {
    static const std::vector<double> all{0,   -0.0, 1,    -1,   1e-308, 5e-324, 1e-160, 1e-30,   1e-7,
                                         1e7, 1e15, 3e38, 4e38, 1e150,  1e160,  1e300,  1.7e308, -1.7e308};
    return draw.once_in(3) ? draw.between(-10, 10) : draw.one_of(all);
}

inline void damage_positions(Mesh& mesh, Draw& draw) {
    if (mesh.positions.empty()) return;
    const auto some = [&]() -> Vec3& { return mesh.positions[draw.below(mesh.positions.size())]; };
    switch (draw.below(9)) {
    case 0:
        mesh = with_noise(std::move(mesh), draw.between(0, 0.3), draw.bits());
        break;
    case 1:
        mesh = snapped(std::move(mesh), draw.between(0.05, 1));
        break;
    case 2:
        some() = some();
        break;
    case 3:
        some()[draw.below(3)] = extreme_number(draw);
        break;
    case 4: {
        const double factor = std::pow(10, draw.between(-20, 20));
        for (Vec3& p : mesh.positions) p *= factor;
        break;
    }
    case 5: {
        const double factor = std::pow(10, draw.between(-300, 300));
        for (Vec3& p : mesh.positions) p *= factor;
        break;
    }
    case 6:
        mesh = moved(std::move(mesh), {extreme_number(draw), 0, draw.between(-100, 100)});
        break;
    case 7: { // flat
        const std::size_t axis = draw.below(3);
        for (Vec3& p : mesh.positions) p[axis] = 0;
        break;
    }
    default:
        mesh.positions[draw.below(mesh.positions.size())] = {};
    }
    for (Vec3& p : mesh.positions) // scaled or moved beyond the range of doubles
        for (std::size_t i = 0; i < 3; ++i)
            if (!std::isfinite(p[i])) p[i] = std::numeric_limits<double>::max();
}

template <class T>
AttributeData random_numbers(std::size_t count, Draw& draw) {
    std::vector<T> data(count);
    const std::uint64_t seed = draw.bits();
    const bool odd = draw.once_in(6);
    for (std::size_t i = 0; i < count; ++i) {
        data[i] = as_component<T>(
            between(std::is_integral_v<T> ? 0 : -1, std::is_integral_v<T> ? 300 : 1, seed, i));
        if constexpr (!std::is_integral_v<T>)
            if (odd && hashed(seed, i) % 5 == 0)
                data[i] = hashed(seed, i) % 2 ? std::numeric_limits<T>::max() : T{0};
    }
    return data;
}

inline void add_random_attribute(Mesh& mesh, Draw& draw) {
    struct Kind {
        const char* name;
        Domain domain;
        Role role;
        int components;
    };
    static const std::vector<Kind> kinds{
        {"NORMAL", Domain::wedge, Role::normal, 3},  {"TANGENT", Domain::wedge, Role::tangent, 4},
        {"TEXCOORD_0", Domain::wedge, Role::uv, 2},  {"TEXCOORD_1", Domain::wedge, Role::uv, 2},
        {"COLOR_0", Domain::wedge, Role::colour, 4}, {"quality", Domain::vertex, Role::generic, 1},
        {"quality", Domain::face, Role::generic, 1}, {"_THREE", Domain::wedge, Role::generic, 3},
        {"group", Domain::face, Role::index, 1}};
    Attribute a;
    const Kind& kind = draw.one_of(kinds);
    if (mesh.find(kind.name, kind.domain)) return;
    a.name = kind.name;
    a.domain = kind.domain;
    a.role = kind.role;
    a.components = kind.components;
    const std::size_t count = mesh.count(kind.domain) * static_cast<std::size_t>(kind.components);
    if (kind.role == Role::index) {
        std::vector<std::uint32_t> labels(count);
        for (auto& label : labels) label = static_cast<std::uint32_t>(draw.below(3));
        a.data = std::move(labels);
    } else if (kind.role == Role::normal || kind.role == Role::tangent || kind.role == Role::uv) {
        a.data = random_numbers<float>(count, draw);
    } else if (kind.role == Role::colour) {
        a.normalised = draw.once_in(2);
        a.data =
            a.normalised ? random_numbers<std::uint8_t>(count, draw) : random_numbers<float>(count, draw);
    } else {
        const std::size_t type = draw.below(4);
        a.data = type == 0   ? random_numbers<float>(count, draw)
                 : type == 1 ? random_numbers<double>(count, draw)
                 : type == 2 ? random_numbers<std::int16_t>(count, draw)
                             : random_numbers<std::uint32_t>(count, draw);
    }
    mesh.attributes.push_back(std::move(a));
}

/// A table of primitives, and the primitive of each face.
inline void add_primitives(Mesh& mesh, std::size_t materials, Draw& draw) {
    if (mesh.find(primitive_attribute, Domain::face)) return;
    const std::size_t count = 1 + draw.below(3);
    mesh.primitives.clear();
    for (std::size_t i = 0; i < count; ++i)
        mesh.primitives.push_back(
            {materials > 0 && !draw.once_in(4) ? static_cast<Index>(draw.below(materials)) : none, {}, {}});
    std::vector<std::uint32_t> of_face(mesh.face_count());
    for (auto& p : of_face) p = static_cast<std::uint32_t>(draw.below(count));
    mesh.attributes.push_back(
        {std::string(primitive_attribute), Domain::face, Role::index, 1, false, std::move(of_face)});
}

inline Mesh random_mesh(Draw& draw) {
    Mesh mesh = random_shape(draw);
    if (draw.once_in(3)) mesh = damaged_faces(mesh, draw);
    for (std::size_t damages = draw.below(3); damages > 0; --damages) damage_positions(mesh, draw);
    if (!mesh.has_seams() && draw.once_in(4)) // unused vertices
        for (std::size_t n = 1 + draw.below(3); n > 0 && mesh.attributes.empty(); --n)
            mesh.positions.push_back({draw.between(-2, 2), draw.between(-2, 2), 0});
    for (std::size_t n = draw.once_in(2) ? draw.below(4) : 0; n > 0; --n) add_random_attribute(mesh, draw);
    return mesh;
}

inline Transform random_transform(Draw& draw) {
    Transform t;
    switch (draw.below(6)) {
    case 0:
        t.m[0][0] = -1; // mirrors
        break;
    case 1:
        for (auto& row : t.m)
            for (double& x : row) x = draw.between(-2, 2);
        break;
    case 2:
        t.m[draw.below(3)][draw.below(4)] = extreme_number(draw);
        break;
    case 3:
        t.m[draw.below(3)][3] = draw.between(-100, 100);
        break;
    default:
        break;
    }
    return t;
}

/// The scene after a round trip through the format, if the format supports it. For glTF it then has a
/// document.
inline Scene through_a_file(Scene scene, const char* format) {
    try {
        const io::Codec& codec = *io::codec_named(format);
        io::WriteSettings settings;
        settings.title = "mesh";
        auto files = codec.write(scene, settings).files;
        io::ReadLog log;
        return io::read_scene(io::Input::of(std::string("mesh.") + format, std::move(files.front().bytes)),
                              {}, log);
    } catch (const Error&) {
        return scene;
    }
}

inline Scene random_scene(Draw& draw) {
    Scene scene;
    if (draw.once_in(3)) scene.unit = draw.once_in(2) ? Unit::mm : Unit::m;
    if (draw.once_in(3)) scene.up = draw.once_in(2) ? UpAxis::y : UpAxis::z;
    for (std::size_t n = draw.below(3); n > 0; --n) {
        Material& material = scene.materials.emplace_back();
        material.name = std::string("material ") + static_cast<char>('a' + n);
        material.base_colour[1] = draw.between(0, 1);
        material.double_sided = draw.once_in(2);
    }
    static const std::vector<const char*> names{"part", "part", "b", "", "x.lod1"};
    for (std::size_t n = draw.once_in(3) ? 1 + draw.below(3) : 1; n > 0; --n) {
        Part& part = scene.parts.emplace_back();
        part.name = draw.one_of(names);
        part.mesh = scene.parts.size() > 1 && draw.once_in(3) ? scene.parts.front().mesh : random_mesh(draw);
        if (draw.once_in(3)) add_primitives(part.mesh, scene.materials.size(), draw);
        if (draw.once_in(2)) part.transform = random_transform(draw);
    }
    if (draw.once_in(3)) scene = through_a_file(std::move(scene), draw.word({"glb", "ply", "obj"}));
    if (not_finite(scene)) // in world space, which readers refuse
        for (Part& part : scene.parts) part.transform = {};
    return scene;
}

} // namespace facetmill::test
