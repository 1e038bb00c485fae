// Triangles and vertices in an order for caches: the same faces, fewer vertices transformed.
#include "base/math/random.hpp"
#include "io/gltf/encode/encode.hpp"
#include "mesh/shapes.hpp"
#include "parallel/parallel.hpp"
#include "support/catch.hpp"
#include "support/gltf.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

using namespace facetmill;

namespace {

/// A sphere with randomly ordered faces.
Mesh shuffled_sphere() {
    Mesh mesh = shapes::icosphere(4);
    for (std::size_t f = mesh.face_count() - 1; f > 0; --f) {
        const std::size_t other = hashed(7, f) % (f + 1);
        std::swap_ranges(mesh.corners.begin() + static_cast<std::ptrdiff_t>(3 * f),
                         mesh.corners.begin() + static_cast<std::ptrdiff_t>(3 * f + 3),
                         mesh.corners.begin() + static_cast<std::ptrdiff_t>(3 * other));
    }
    std::vector<float> ids(mesh.vertex_count());
    for (std::size_t v = 0; v < ids.size(); ++v) ids[v] = static_cast<float>(v);
    mesh.attributes.push_back({"_id", Domain::vertex, Role::generic, 1, false, std::move(ids)});
    return mesh;
}

bool before(const Vec3& a, const Vec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

/// Uses meshopt, which enables that order, without rounding.
io::WriteSettings ordered() {
    io::WriteSettings settings;
    settings.meshopt = {.on = true, .extension = {}, .filters = false};
    return settings;
}

} // namespace

TEST_CASE("an order for caches transforms fewer vertices", "[io]") {
    const Mesh mesh = shuffled_sphere();
    for (const bool manifold : {false, true}) {
        io::gltf::Builder builder(Json::object(), nullptr);
        io::Written written;
        io::gltf::EncodeSettings settings;
        settings.manifold = manifold;
        settings.order = io::TriangleOrder::draw;
        const io::VertexCacheUse cache = io::gltf::encode_mesh(builder, mesh, settings, written).cache;
        CHECK(written.warnings.empty());
        CHECK(cache.triangles == 5120);
        CHECK(cache.vertices == 2562);
        CHECK(cache.before > 5120 * 2); // without order nearly every corner is transformed
        CHECK(cache.after < 5120 * 0.75);
        CHECK(cache.after >= 2562);
    }
}

TEST_CASE("a large mesh is ordered in stretches, as well as in one piece", "[io]") {
    const Mesh mesh = shapes::grid(520, 520); // 540,800 triangles
    std::vector<io::Bytes> files;
    for (const int threads : {1, 3}) {
        set_threads(threads);
        io::gltf::Builder builder(Json::object(), nullptr);
        io::Written written;
        io::gltf::EncodeSettings settings;
        settings.order = io::TriangleOrder::draw;
        const io::VertexCacheUse cache = io::gltf::encode_mesh(builder, mesh, settings, written).cache;
        CHECK(cache.triangles == mesh.face_count());
        CHECK(cache.after < 0.74 * static_cast<double>(mesh.face_count()));
        files.push_back(test::written(test::scene_in_metres(mesh), "glb").files[0].bytes);
    }
    set_threads(0);
    CHECK(files[0] == files[1]);
    const auto faces_of = [](const Mesh& m) {
        std::vector<std::array<Vec3, 3>> faces(m.face_count());
        for (std::size_t f = 0; f < faces.size(); ++f) {
            for (std::size_t k = 0; k < 3; ++k)
                faces[f][k] = m.positions[m.vertex(static_cast<Index>(3 * f + k))];
            std::rotate(faces[f].begin(), std::min_element(faces[f].begin(), faces[f].end(), before),
                        faces[f].end());
        }
        std::sort(faces.begin(), faces.end(), [](const auto& a, const auto& b) {
            return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), before);
        });
        return faces;
    };
    CHECK(faces_of(test::read_bytes(files[0], "glb").parts.at(0).mesh) == faces_of(mesh));
}

TEST_CASE("where thousands of triangles meet at a vertex each is looked at once", "[io]") {
    constexpr Index sides = 200000; // an order that checks all triangles for each would take a minute
    Mesh fan;
    fan.positions.push_back({0, 0, 1});
    for (Index i = 0; i < sides; ++i) {
        const double angle = 6.283185307179586 * i / sides;
        fan.positions.push_back({std::cos(angle), std::sin(angle), 0});
    }
    for (Index i = 0; i < sides; ++i) {
        const auto at = static_cast<Index>(std::uint64_t{i} * 70001 % sides); // in another order
        fan.corners.insert(fan.corners.end(), {0, 1 + at, 1 + (at + 1) % sides});
    }
    for (const auto order : {io::TriangleOrder::draw, io::TriangleOrder::strips, io::TriangleOrder::size}) {
        io::gltf::Builder builder(Json::object(), nullptr);
        io::Written written;
        io::gltf::EncodeSettings settings;
        settings.order = order;
        const io::VertexCacheUse cache = io::gltf::encode_mesh(builder, fan, settings, written).cache;
        CHECK(cache.triangles == sides);
        CHECK(cache.before >= 2 * sides);
        CHECK(cache.after < 1.3 * sides);
    }
}

TEST_CASE("one order of strips is nearly as small under meshopt as the best of several", "[io]") {
    const Scene scene = test::scene_in_metres(shuffled_sphere());
    const auto bytes = [&](io::TriangleOrder order) {
        io::WriteSettings settings;
        settings.quantize.on = settings.meshopt.on = true;
        settings.order = order;
        return test::written(scene, "glb", settings).files[0].bytes;
    };
    const auto size = bytes(io::TriangleOrder::size), strips = bytes(io::TriangleOrder::strips),
               draw = bytes(io::TriangleOrder::draw);
    CHECK(size.size() <= strips.size());
    CHECK(strips.size() < size.size() * 1.04);
    CHECK(strips.size() < draw.size());
    CHECK(strips == bytes(io::TriangleOrder::strips));
    CHECK(test::drawn(test::read_bytes(strips, "glb").parts.at(0).mesh) ==
          test::drawn(test::read_bytes(size, "glb").parts.at(0).mesh));
}

TEST_CASE("an order for caches keeps faces and attributes", "[io]") {
    const Scene scene = test::scene_in_metres(shuffled_sphere());
    for (const bool manifold : {false, true}) {
        io::WriteSettings settings = ordered();
        settings.mesh_manifold = manifold;
        const io::Written written = test::written(scene, "glb", settings);
        CHECK(written.warnings.empty());
        CHECK(written.files[0].bytes == test::written(scene, "glb", settings).files[0].bytes);
        const Mesh read = test::read_bytes(written.files[0].bytes, "glb").parts.at(0).mesh;
        CHECK(test::drawn(read) == test::drawn(test::again(scene).parts.at(0).mesh));
        Index next = 0; // vertices are in the order of first use
        for (const Index corner : read.corners) {
            CHECK(corner <= next + 2); // meshopt begins a triangle with whichever corner it likes
            next = std::max(next, corner + 1);
        }
    }
}

TEST_CASE("what numbers features by vertices keeps its order", "[io]") {
    Scene scene = test::scene_in_metres(shuffled_sphere());
    const std::vector<Index> corners = scene.parts[0].mesh.corners;
    const auto ids = [&](const char* json) {
        scene.parts[0].mesh.primitives.resize(1);
        scene.parts[0].mesh.primitives[0].json = json;
        const Mesh read = test::again(scene, ordered()).parts.at(0).mesh;
        return std::get<std::vector<float>>(read.find("_id", Domain::wedge)->data);
    };
    const auto given = std::get<std::vector<float>>(scene.parts[0].mesh.find("_id", Domain::vertex)->data);
    CHECK(ids(R"({"extensions":{"EXT_mesh_features":{"featureIds":[{"featureCount":2562}]}}})") == given);
    CHECK(
        ids(R"({"extensions":{"EXT_mesh_features":{"featureIds":[{"featureCount":2562,"attribute":0}]}}})") !=
        given);
}

TEST_CASE("meshes of several primitives are ordered one by one", "[io]") {
    Scene scene = test::scene_in_metres(shuffled_sphere());
    Mesh& mesh = scene.parts[0].mesh;
    std::vector<Index> primitive(mesh.face_count());
    for (std::size_t f = 0; f < primitive.size(); ++f) primitive[f] = static_cast<Index>(f % 3);
    mesh.primitives.resize(3);
    mesh.attributes.push_back(
        {std::string(primitive_attribute), Domain::face, Role::index, 1, false, std::move(primitive)});
    for (const bool manifold : {false, true}) {
        io::WriteSettings settings = ordered();
        settings.mesh_manifold = manifold;
        const Mesh read = test::again(scene, settings).parts.at(0).mesh;
        CHECK(test::drawn(read) == test::drawn(test::again(scene).parts.at(0).mesh));
        std::vector<std::size_t> counts(3);
        for (Index f = 0; f < read.face_count(); ++f) ++counts[read.primitive_of(f)];
        CHECK(counts == std::vector<std::size_t>{1707, 1707, 1706});
    }
}
