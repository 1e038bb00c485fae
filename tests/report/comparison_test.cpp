#include "support/catch.hpp"

#include "mesh/shapes.hpp"
#include "report/comparison.hpp"

using namespace facetmill;
using report::Comparison;
using report::ComparisonSettings;

namespace {

Scene scene_of(Mesh mesh, const char* name = "part") {
    Scene scene;
    scene.parts.emplace_back().name = name;
    scene.parts[0].mesh = std::move(mesh);
    return scene;
}

/// The names of the lines that differ.
std::string different(const Comparison& comparison) {
    std::string names;
    for (const auto& d : comparison.lines)
        if (!d.same) names += (names.empty() ? "" : ", ") + d.section + ": " + d.name;
    return names;
}

} // namespace

TEST_CASE("a scene does not differ from itself", "[report]") {
    const Comparison same = report::compare(scene_of(shapes::uv_cube()), scene_of(shapes::uv_cube()));
    CHECK_FALSE(same.differs());
    CHECK(different(same).empty());
    CHECK(same.deviation->maximum() < 1e-15);
    CHECK(report::to_text(same, "a", "b", false).starts_with("a and b agree\n"));
    CHECK(report::to_json(same, "a", "b")["same"] == true);
}

TEST_CASE("the same surface cut otherwise differs in counts alone", "[report]") {
    const Scene quads = scene_of(shapes::quad_cube()), triangles = scene_of(shapes::cube());
    const Comparison d = report::compare(quads, triangles);
    CHECK(different(d) == "counts: edges, counts: faces, counts: triangles");
    CHECK(d.differs());
    ComparisonSettings settings;
    settings.ignored = {"counts"};
    CHECK_FALSE(report::compare(quads, triangles, settings).differs());
    CHECK(report::to_text(report::compare(quads, triangles, settings), "a", "b", false)
              .starts_with("a and b agree in what was asked\n  counts: 3 different (ignored)\n"));
}

TEST_CASE("surfaces may be apart by the limit", "[report]") {
    Scene moved = scene_of(shapes::grid(4, 3)); // diagonal 5
    moved.parts[0].transform.m[2][3] = 0.05;
    const Scene sheet = scene_of(shapes::grid(4, 3));
    CHECK(different(report::compare(sheet, moved)) == "geometry: deviation maximum");
    ComparisonSettings settings;
    settings.maximum = ComparisonSettings::Limit{1.01, true};
    CHECK_FALSE(report::compare(sheet, moved, settings).differs());
    settings.maximum = ComparisonSettings::Limit{0.049, false};
    CHECK(report::compare(sheet, moved, settings).differs());
    settings.maximum.reset();
    settings.rms = ComparisonSettings::Limit{0.9, true};
    CHECK(different(report::compare(sheet, moved, settings)) == "geometry: deviation rms");
    settings.ignored = {"geometry"};
    CHECK_FALSE(report::compare(sheet, moved, settings).deviation.has_value());
}

TEST_CASE("attributes, materials and parts are told by name, attributes by value too", "[report]") {
    Scene a = scene_of(shapes::uv_cube()), b = a;
    b.parts[0].name = "other";
    b.materials.push_back({.name = "red"});
    Attribute* uv = b.parts[0].mesh.find("TEXCOORD_0", Domain::wedge);
    REQUIRE(uv);
    uv->set_value(3, 1, uv->value(3, 1) + 0.25);
    b.parts[0].mesh.drop("NORMAL", Domain::wedge);
    CHECK(different(report::compare(a, b)) == "attributes: NORMAL (wedge), attributes: TEXCOORD_0 (wedge), "
                                              "materials: number, materials: 0, parts: 0");
    ComparisonSettings settings;
    settings.attribute_limit = 0.3;
    settings.ignored = {"materials", "parts"};
    CHECK(different(report::compare(a, b, settings)).starts_with("attributes: NORMAL (wedge), materials"));
    for (const auto& d : report::compare(a, b).lines)
        if (d.name == "TEXCOORD_0 (wedge)") CHECK(d.note == "largest difference 0.25, at element 3");
}

TEST_CASE("a surface turned inside out differs, closed or open", "[report]") {
    for (const Mesh& mesh : {shapes::cube(), shapes::grid(3, 2)}) {
        Scene a = scene_of(mesh), b = a;
        for (std::size_t c = 0; c < b.parts[0].mesh.corners.size(); c += 3)
            std::swap(b.parts[0].mesh.corners[c], b.parts[0].mesh.corners[c + 1]);
        CHECK(different(report::compare(a, b)) == "geometry: turned round");
    }
}

TEST_CASE("topology is compared property by property", "[report]") {
    Mesh open = shapes::cube();
    open.corners.resize(30);
    const std::string found = different(report::compare(scene_of(shapes::cube()), scene_of(open)));
    CHECK(found.find("topology: closed") != std::string::npos);
    CHECK(found.find("topology: boundary_loops") != std::string::npos);
    CHECK(found.find("topology: components") == std::string::npos);
}

TEST_CASE("something differs from nothing", "[report]") {
    const Comparison d = report::compare(scene_of(shapes::cube()), scene_of({}));
    CHECK(d.differs());
    CHECK(report::to_json(d, "a", "b")["deviation"]["maximum"].is_null());
}
