#include "geometry/preview/preview.hpp"
#include "support/catch.hpp"

#include "mesh/shapes.hpp"
#include "parallel/parallel.hpp"
#include "support/measure.hpp"
#include "support/run_stage.hpp"

#include <algorithm>
#include <set>

using namespace facetmill;
using test::scene_of;

namespace {

using Place = std::tuple<double, double, double>;

std::set<Place> places_of(const std::vector<Vec3>& points) {
    std::set<Place> out;
    for (const Vec3& p : points) out.insert({p.x, p.y, p.z});
    return out;
}

bool is_subset(const Mesh& preview, const std::vector<Vec3>& of) {
    const std::set<Place> mine = places_of(preview.positions), all = places_of(of);
    return std::includes(all.begin(), all.end(), mine.begin(), mine.end());
}

PreviewSettings at_most(std::size_t faces) {
    PreviewSettings settings;
    settings.faces = faces;
    return settings;
}

} // namespace

TEST_CASE("a preview of few faces has them all, where they stand", "[geometry]") {
    Scene scene = scene_of(shapes::quad_cube());
    scene.parts[0].transform.m[0][3] = 5;
    scene.parts.push_back(scene.parts[0]);
    scene.parts[1].transform = {{{-1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}}; // mirrored
    const Preview preview = preview_of(scene);
    CHECK(preview.faces == 24);
    CHECK(preview.mesh.face_count() == 24);
    CHECK(preview.mesh.vertex_count() == 16);
    CHECK(preview.mesh.bounds().min.x == -1);
    CHECK(preview.mesh.bounds().max.x == 6);
    CHECK(test::volume(preview.mesh) == Approx(2)); // neither is inside out
    CHECK(preview.paints.size() == 1);
    CHECK(preview.mesh.find("NORMAL", Domain::wedge) == nullptr);
}

TEST_CASE("a preview of many faces has few, between vertices of the scene", "[geometry]") {
    const Mesh sphere = shapes::icosphere(7); // 327,680 faces
    const Scene scene = scene_of(sphere);
    for (const std::size_t faces : {std::size_t{5000}, std::size_t{100000}}) { // by a grid first, and not
        set_threads(1);
        const Preview preview = preview_of(scene, at_most(faces));
        set_threads(3);
        const Preview other = preview_of(scene, at_most(faces));
        set_threads(0);
        CHECK(preview.faces == 327680);
        CHECK(preview.mesh.face_count() <= faces + faces / 4);
        CHECK(preview.mesh.face_count() > faces / 2);
        CHECK(is_subset(preview.mesh, sphere.positions));
        CHECK(std::abs(test::volume(preview.mesh) / test::volume(sphere) - 1) < 0.01);
        CHECK(preview.mesh.positions == other.mesh.positions);
        CHECK(preview.mesh.corners == other.mesh.corners);
    }
}

TEST_CASE("many small parts become few faces, too", "[geometry]") {
    Scene scene;
    for (int i = 0; i < 3000; ++i) {
        Part& part = scene.parts.emplace_back();
        part.mesh = shapes::cube();
        part.transform.m[0][3] = i % 60 * 2;
        part.transform.m[1][3] = i / 60 * 2;
    }
    const Preview preview = preview_of(scene, at_most(6000));
    CHECK(preview.faces == 36000);
    CHECK(preview.mesh.face_count() <= 7500);
    CHECK(preview.mesh.face_count() > 0);
    CHECK(preview.mesh.bounds().extent().x > 100);
}

TEST_CASE("a preview keeps colours and materials apart", "[geometry]") {
    Mesh mesh = shapes::cube();
    mesh.attributes.push_back({"Col", Domain::face, Role::colour, 3, true, std::vector<std::uint8_t>(36, 0)});
    mesh.attributes[0].set_value(4, 0, 1); // one red face
    mesh.primitives.resize(2);
    mesh.primitives[0].material = 1;
    mesh.primitives[1].material = 7; // not among the scene's
    std::vector<std::uint32_t> of(12);
    of[11] = 1;
    mesh.attributes.push_back({std::string(primitive_attribute), Domain::face, Role::index, 1, false, of});
    Scene scene = scene_of(mesh);
    scene.materials.resize(2);
    const Preview preview = preview_of(scene);
    REQUIRE(preview.paints.size() == 2);
    CHECK(preview.paints[0].material == 1);
    CHECK(preview.paints[0].coloured);
    CHECK(preview.paints[1].material == none);
    const Attribute* colours = preview.mesh.find("COLOR_0", Domain::wedge);
    REQUIRE(colours);
    std::size_t red = 0;
    for (std::size_t i = 0; i < colours->size(); ++i) red += colours->value(i, 0) == 1;
    CHECK(red == 3);
}

TEST_CASE("a preview lays textures on as their materials say", "[geometry]") {
    auto materials = std::make_shared<ResolvedMaterials>(1);
    Texture& texture = (*materials)[0].base_texture;
    texture.image = texture_image(1, 1, {255, 0, 0, 255}, false, 16);
    texture.transform = {2, 0, 10, 0, 1, 0};
    Mesh mesh = shapes::uv_cube();
    mesh.primitives.resize(1);
    mesh.primitives[0].material = 0;
    Scene scene = scene_of(mesh);
    scene.materials.resize(1);
    PreviewSettings settings;
    settings.materials = materials;
    const Preview laid_on = preview_of(scene, settings);
    const Attribute* uv = laid_on.mesh.find("TEXCOORD_0", Domain::wedge);
    REQUIRE(uv);
    double largest = 0;
    for (std::size_t i = 0; i < uv->size(); ++i) largest = std::max(largest, uv->value(i, 0));
    CHECK(largest == Approx(12));
    CHECK(laid_on.mesh.find("NORMAL", Domain::wedge) != nullptr);

    // A scene with far more faces than requested gets the texture as vertex colours.
    scene.parts[0].mesh = shapes::icosphere(5);
    Mesh& sphere = scene.parts[0].mesh;
    sphere.attributes.push_back(
        {"TEXCOORD_0", Domain::wedge, Role::uv, 2, false, std::vector<float>(2 * sphere.wedge_count())});
    sphere.primitives = mesh.primitives;
    settings.faces = 500;
    const Preview baked = preview_of(scene, settings);
    CHECK(baked.mesh.find("TEXCOORD_0", Domain::wedge) == nullptr);
    const Attribute* colours = baked.mesh.find("COLOR_0", Domain::wedge);
    REQUIRE(colours);
    CHECK(colours->value(0, 0) == 1);
    CHECK(colours->value(0, 1) == 0);
}

TEST_CASE("a preview of points, of nothing, and of what is not finite", "[geometry]") {
    CHECK(preview_of(Scene{}).mesh.vertex_count() == 0);
    Mesh cloud;
    for (int i = 0; i < 1000; ++i) cloud.positions.push_back({double(i), 0, 0});
    cloud.attributes.push_back(
        {"COLOR_0", Domain::vertex, Role::colour, 3, false, std::vector<float>(3000, 0.25f)});
    const Preview points = preview_of(scene_of(cloud), at_most(100));
    CHECK(points.mesh.vertex_count() == 100);
    CHECK(points.mesh.face_count() == 0);
    REQUIRE(points.mesh.find("COLOR_0", Domain::wedge));
    CHECK(points.mesh.find("COLOR_0", Domain::wedge)->value(99, 1) == 0.25);

    Mesh one;
    one.positions = {{1, 2, 3}};
    CHECK(preview_of(scene_of(one)).mesh.vertex_count() == 1);

    Mesh broken = shapes::cube();
    broken.positions[0].x = std::nan("");
    broken.attributes.push_back(
        {"NORMAL", Domain::wedge, Role::normal, 3, false, std::vector<float>(24, NAN)});
    broken.attributes.push_back(
        {"COLOR_0", Domain::wedge, Role::colour, 4, false, std::vector<float>(32, NAN)});
    const Preview rest = preview_of(scene_of(broken));
    CHECK(rest.mesh.face_count() > 0);
    CHECK(rest.mesh.face_count() < 12);
    for (const Vec3& p : rest.mesh.positions) CHECK(is_finite(p));
    for (const Attribute& a : rest.mesh.attributes) CHECK(std::isfinite(a.value(0, 0)));
}

TEST_CASE("lines and single points come after the triangles of a preview, with their colours", "[geometry]") {
    Scene scene = scene_of(shapes::uv_cube());
    scene.materials.resize(2);
    scene.materials[1].base_colour[1] = 0.5;
    scene.materials[1].base_colour[2] = 0;
    Mesh lines;
    lines.positions = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {HUGE_VAL, 0, 0}};
    lines.lines = {0, 1, 1, 2, 2, 3}; // the last has no further point
    lines.primitives = {{none, {}, {}}, {1, {}, {}}};
    lines.line_primitive = {0, 1, 1};
    scene.parts.emplace_back().mesh = lines;
    scene.parts.back().transform.m[2][3] = 7;
    Mesh cloud;
    cloud.positions = {{5, 5, 5}, {6, 6, 6}};
    cloud.attributes.push_back(
        {"COLOR_0", Domain::vertex, Role::colour, 3, false, std::vector<float>{1, 0, 0, 0, 0, 1}});
    scene.parts.emplace_back().mesh = cloud;

    const Preview preview = preview_of(scene);
    CHECK(preview.faces == 12);
    CHECK(preview.all_lines == 3);
    CHECK(preview.all_dots == 2);
    CHECK(preview.first_loose == 24);
    CHECK(preview.first_dot == 28);
    const Mesh& mesh = preview.mesh;
    REQUIRE(mesh.wedge_count() == 30);
    const auto place = [&](Index w) { return mesh.positions[mesh.vertex_of_wedge(w)]; };
    CHECK(place(24) == Vec3{0, 0, 7});
    CHECK(place(27) == Vec3{2, 2, 7});
    CHECK(place(29) == Vec3{6, 6, 6});
    const Attribute* colours = mesh.find("COLOR_0", Domain::wedge);
    REQUIRE(colours);
    const auto colour = [&](std::size_t w) {
        return std::array{colours->value(w, 0), colours->value(w, 1), colours->value(w, 2)};
    };
    CHECK(colour(0) == std::array{1.0, 1.0, 1.0}); // leaves the faces' own
    CHECK(colour(24)[0] == Approx(loose_colour[0]));
    CHECK(colour(26) == std::array{1.0, 0.5, 0.0});
    CHECK(colour(28) == std::array{1.0, 0.0, 0.0});
    for (const Attribute& a : mesh.attributes)
        if (a.domain == Domain::wedge)
            CHECK(std::get<std::vector<float>>(a.data).size() ==
                  30U * static_cast<std::size_t>(a.components));

    scene.parts.erase(scene.parts.begin());
    const Preview alone = preview_of(scene, at_most(1)); // one line, one point
    CHECK(alone.mesh.face_count() == 0);
    CHECK(alone.mesh.vertex_count() == 3);
    CHECK(alone.first_dot == 2);
    CHECK(alone.all_lines == 3);
}
