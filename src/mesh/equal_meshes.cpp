#include "mesh/equal_meshes.hpp"

#include "base/math/random.hpp"

#include <bit>
#include <functional>
#include <type_traits>
#include <unordered_map>

namespace facetmill {

namespace {

template <class T>
std::string_view bytes_in(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

std::string_view bytes_in(const AttributeData& data) {
    return std::visit([](const auto& values) { return bytes_in(values); }, data);
}

bool are_equal(const Attribute& a, const Attribute& b) {
    return a.name == b.name && a.domain == b.domain && a.role == b.role && a.components == b.components &&
           a.normalised == b.normalised && a.data.index() == b.data.index() &&
           bytes_in(a.data) == bytes_in(b.data);
}

bool are_equal(const Mesh& a, const Mesh& b, bool with_primitives) {
    return bytes_in(a.positions) == bytes_in(b.positions) &&
           bytes_in(a.wedge_vertex) == bytes_in(b.wedge_vertex) &&
           bytes_in(a.corners) == bytes_in(b.corners) &&
           bytes_in(a.face_offsets) == bytes_in(b.face_offsets) && bytes_in(a.lines) == bytes_in(b.lines) &&
           bytes_in(a.line_primitive) == bytes_in(b.line_primitive) &&
           (with_primitives
                ? a.primitives == b.primitives
                : std::equal(
                      a.primitives.begin(), a.primitives.end(), b.primitives.begin(), b.primitives.end(),
                      [](const Primitive& p, const Primitive& q) { return p.attributes == q.attributes; })) &&
           std::equal(a.attributes.begin(), a.attributes.end(), b.attributes.begin(), b.attributes.end(),
                      [](const Attribute& x, const Attribute& y) { return are_equal(x, y); });
}

/// A hash of all arrays. Meshes with equal hashes are nearly always equal.
std::uint64_t hash_of(const Mesh& mesh) {
    std::uint64_t h = 0;
    const auto add = [&](std::string_view bytes) { h = hashed(h, std::hash<std::string_view>{}(bytes)); };
    add(bytes_in(mesh.positions));
    add(bytes_in(mesh.wedge_vertex));
    add(bytes_in(mesh.corners));
    add(bytes_in(mesh.face_offsets));
    add(bytes_in(mesh.lines));
    for (const Attribute& a : mesh.attributes) add(bytes_in(a.data));
    return h;
}

/// Gives each of the parts, which are as large as each other, the first equal one.
void find_among(const std::vector<std::size_t>& parts, const Scene& scene, bool with_primitives,
                std::vector<std::size_t>& first) {
    std::unordered_map<std::uint64_t, std::vector<std::size_t>> by_hash;
    for (const std::size_t p : parts) {
        const Mesh& mesh = scene.parts[p].mesh;
        auto& firsts = by_hash[hash_of(mesh)];
        const auto found = std::find_if(firsts.begin(), firsts.end(), [&](std::size_t other) {
            return are_equal(scene.parts[other].mesh, mesh, with_primitives);
        });
        first[p] = found == firsts.end() ? p : *found;
        if (found == firsts.end()) firsts.push_back(p);
    }
}

} // namespace

DistinctParts::DistinctParts(const Scene& scene) : DistinctParts(scene, true) {}

DistinctParts distinct_geometry(const Scene& scene) { return {scene, false}; }

DistinctParts::DistinctParts(const Scene& scene, bool with_primitives) : first(scene.parts.size()) {
    std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> by_size;
    for (std::size_t p = 0; p < first.size(); ++p) {
        first[p] = p;
        const Mesh& mesh = scene.parts[p].mesh;
        by_size[{mesh.vertex_count(), mesh.corner_count()}].push_back(p);
    }
    for (const auto& [size, parts] : by_size)
        if (parts.size() > 1) find_among(parts, scene, with_primitives, first);
    count();
}

void DistinctParts::count() {
    uses.assign(first.size(), 0);
    for (const std::size_t p : first) ++uses[p];
}

std::uint64_t key_of(double number) { return std::bit_cast<std::uint64_t>(number == 0 ? 0.0 : number); }

std::array<std::uint64_t, 9> axes_in_world(const Transform& to_world) {
    const Vec3 x = to_world.vector({1, 0, 0}), y = to_world.vector({0, 1, 0}), z = to_world.vector({0, 0, 1});
    return {key_of(x.x), key_of(x.y), key_of(x.z), key_of(y.x), key_of(y.y),
            key_of(y.z), key_of(z.x), key_of(z.y), key_of(z.z)};
}

DistinctParts distinct_shapes(const Scene& scene) {
    return DistinctParts(scene).split_by(
        [&](std::size_t p) { return axes_in_world(scene.parts[p].transform); });
}

} // namespace facetmill
