#include "report/viewer.hpp"
#include "support/catch.hpp"

#include "geometry/clip/clip.hpp"
#include "mesh/shapes.hpp"
#include "mesh/surface.hpp"
#include "parallel/parallel.hpp"
#include "support/run_stage.hpp"

using namespace facetmill;
using report::ViewedScenes;
using test::scene_of;

TEST_CASE("a view has a scene before and those after it, each once", "[report]") {
    ViewedScenes viewed(3);
    CHECK(viewed.json().is_null());
    CHECK(report::viewer_section(viewed.json()).empty());
    const Scene before = scene_of(shapes::icosphere(2), Unit::mm), after = scene_of(shapes::icosphere(1));
    const FaceTree tree(surface_of(before), FaceTree::Use::near);
    viewed.add_before(before, "a.ply", nullptr);
    viewed.add_after(after, "b.glb", nullptr, {&tree, "a.ply"});
    viewed.add_after(after, "b.stl", nullptr, {&tree, "a.ply"});
    viewed.add_after(scene_of(Mesh{}), "empty.ply", nullptr, {&tree, "a.ply"});
    const Json json = viewed.json();
    REQUIRE(json["scenes"].size() == 2);
    CHECK(json["scenes"][0]["name"] == "a.ply");
    CHECK(json["scenes"][0]["before"] == true);
    CHECK(json["scenes"][0]["unit"] == "mm");
    CHECK(!json["scenes"][0].contains("deviation"));
    CHECK(json["scenes"][1]["name"] == "b.glb, b.stl");
    CHECK(json["scenes"][1]["triangles"] == 80);
    CHECK(json["scenes"][1]["faces"] == 80);
    CHECK(json["scenes"][1]["largest"].get<double>() < 1e-6); // its vertices are among the other's
    CHECK(json["left_out"] == "");
}

TEST_CASE("a view shows a file with its own up axis if the scene has none", "[report]") {
    Mesh tower = shapes::icosphere(1);
    for (Vec3& p : tower.positions) p.z *= 3;
    const Scene scene = scene_of(std::move(tower));
    ViewedScenes viewed(2);
    viewed.add_before(scene, "a.obj", nullptr);
    viewed.add_after(scene, "a.glb", nullptr, {.file_up = UpAxis::y});
    const Json json = viewed.json();
    REQUIRE(json["scenes"].size() == 2);
    CHECK(json["scenes"][0]["up"] == Json({0.0, 0.0, 1.0}));
    CHECK(json["scenes"][1]["up"] == Json({0.0, 1.0, 0.0}));
}

TEST_CASE("a scene that was moved or made larger is another one to a view", "[report]") {
    const Scene ball = scene_of(shapes::icosphere(1));
    ViewedScenes viewed(4);
    viewed.add_before(ball, "ball", nullptr);
    viewed.add_after(ball, "same", nullptr);
    for (const double scale : {2.0, 1.0}) {
        Scene other = ball;
        for (Vec3& p : other.parts[0].mesh.positions) p = p * scale + Vec3{3, 0, 0};
        viewed.add_after(other, "other", nullptr);
    }
    const Json json = viewed.json();
    REQUIRE(json["scenes"].size() == 3);
    CHECK(json["scenes"][0]["name"] == "ball, same");
}

TEST_CASE("what closes a cut has no distance in a view, and does not widen the scale", "[report]") {
    const Mesh ball = shapes::icosphere(4);
    ClipSettings settings;
    settings.planes = {{{0, 0, 1}, {0, 0, 0.25}}};
    settings.cap = settings.cap_numbers = true;
    Mesh mesh = clip(ball, settings).front;
    mesh.positions.push_back({0, 0, 0.25}); // a corner of a cap inside the ball
    mesh.corners.back() = static_cast<Index>(mesh.vertex_count() - 1);
    REQUIRE(mesh.find("cut_id", Domain::face)->value(mesh.face_count() - 1, 0) == 1);
    const Scene half = scene_of(std::move(mesh));
    const FaceTree tree(surface_of(ball), FaceTree::Use::near);
    const auto with_caps_above = [&](std::optional<Index> last_cap) {
        ViewedScenes viewed(2);
        viewed.add_after(half, "half", nullptr, {&tree, "ball", last_cap});
        return viewed.json()["scenes"][0];
    };
    const auto caps = [](const Json& scene) {
        std::size_t count = 0;
        for (const Json& group : scene["groups"])
            if (group["cap"].get<bool>()) count += group["count"].get<std::size_t>();
        return count;
    };
    CHECK(with_caps_above({})["largest"].get<double>() > 0.01);
    CHECK(caps(with_caps_above({})) == 0);
    CHECK(with_caps_above(0)["largest"].get<double>() < 1e-6);
    CHECK(caps(with_caps_above(0)) > 0);
    CHECK(caps(with_caps_above(1)) == 0); // the reference has this one
}

TEST_CASE("a view stands as the picture beside it", "[report]") {
    Scene scene = scene_of(shapes::icosphere(1));
    scene.up = UpAxis::unknown;
    const auto up_of = [&](UpAxis stated) {
        ViewedScenes viewed(1);
        Camera camera;
        camera.up = {1, 0, 0};
        camera.front = {0, 1, 0};
        viewed.stand_as(camera, stated);
        viewed.add_before(scene, "a", nullptr);
        return viewed.json()["scenes"][0]["up"];
    };
    CHECK(up_of(UpAxis::unknown) == Json({1.0, 0.0, 0.0}));
    CHECK(up_of(UpAxis::y) != Json({1.0, 0.0, 0.0}));
}

TEST_CASE("a view tells how many triangles are shown, and stays small", "[report]") {
    const Scene sphere = scene_of(shapes::icosphere(7));
    Json first;
    for (const int threads : {1, 3}) {
        set_threads(threads);
        ViewedScenes viewed(2);
        viewed.add_before(sphere, "a", nullptr);
        const Json json = viewed.json();
        if (first.is_null()) first = json;
        CHECK(json == first);
    }
    set_threads(0);
    CHECK(first["scenes"][0]["faces"] == 327680);
    CHECK(first["scenes"][0]["triangles"] <= 75000);
    CHECK(first.dump().size() < 800000);

    ViewedScenes many(20);
    for (int i = 0; i < 20; ++i)
        many.add_after(scene_of(shapes::torus(10 + i, 20)), "out" + std::to_string(i), nullptr);
    CHECK(many.json()["scenes"].size() == 7);
    CHECK(many.json()["left_out"] == "13 further outputs not shown here.");
}

TEST_CASE("a texture of several materials is in a view once, in a size that fits", "[report]") {
    auto materials = std::make_shared<ResolvedMaterials>(3);
    (*materials)[0].base_texture.image =
        texture_image(1024, 1024, std::vector<std::uint8_t>(4 << 20, 128), true, 4096);
    (*materials)[2] = (*materials)[1] = (*materials)[0];
    (*materials)[1].alpha = MaterialLook::Alpha::blend;
    (*materials)[1].base = {1, 0, 0, 0.5f};
    Scene scene = scene_of(shapes::uv_cube());
    scene.materials.resize(3);
    scene.materials[1].double_sided = true;
    Part other = scene.parts[0];
    scene.parts.resize(3, other);
    for (Index m = 0; m < 3; ++m) scene.parts[m].mesh.primitives = {{m, {}, {}}};
    ViewedScenes viewed(1);
    viewed.add_after(scene, "a.glb", materials);
    const Json json = viewed.json();
    REQUIRE(json["textures"].size() == 2); // with alpha and without
    CHECK(json["textures"][0]["src"].get<std::string>().starts_with("data:image/jpeg;base64,"));
    CHECK(json["textures"][1]["src"].get<std::string>().starts_with("data:image/webp;base64,"));
    CHECK(json["textures"][0]["wrap"] == Json({"repeat", "repeat"}));
    const Json& groups = json["scenes"][0]["groups"];
    REQUIRE(groups.size() == 3);
    CHECK(groups[0]["texture"] == 0);
    CHECK(groups[1]["texture"] == 1);
    CHECK(groups[2]["texture"] == 0);
    CHECK(groups[1]["alpha"] == "blend");
    CHECK(groups[1]["double_sided"] == true);
    CHECK(groups[1]["base"] == Json({1.0, 0.0, 0.0, 0.5}));
}

TEST_CASE("no name of a scene ends its element in the page", "[report]") {
    ViewedScenes viewed(1);
    viewed.add_after(scene_of(shapes::cube()), "</script><script>alert(1)</script>.ply", nullptr);
    const std::string page = report::viewer_section(viewed.json());
    CHECK(page.starts_with("<section class=\"viewer\" hidden>"));
    CHECK(page.find("alert(1)<") == std::string::npos);
    CHECK(page.find("\\u003c/script>\\u003cscript>alert(1)") != std::string::npos);
}
