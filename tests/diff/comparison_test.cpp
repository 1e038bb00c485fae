#include "support/catch.hpp"

#include "diff/comparison.hpp"
#include "io/convert.hpp"
#include "mesh/shapes.hpp"

using namespace facetmill;
using report::Comparison;
using report::ComparisonSettings;

namespace {

Scene scene_called(Mesh mesh, const char* name = "part") {
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
    const Comparison same = report::compare(scene_called(shapes::uv_cube()), scene_called(shapes::uv_cube()));
    CHECK_FALSE(same.differs());
    CHECK(different(same).empty());
    CHECK(same.deviation->maximum() < 1e-15);
    CHECK(report::to_text(same, "a", "b", false).starts_with("a and b agree\n"));
    CHECK(report::to_json(same, "a", "b")["same"] == true);
}

TEST_CASE("the same surface cut otherwise differs in counts alone", "[report]") {
    const Scene quads = scene_called(shapes::quad_cube()), triangles = scene_called(shapes::cube());
    const Comparison d = report::compare(quads, triangles);
    CHECK(different(d) == "counts: edges, counts: faces, counts: triangles");
    CHECK(d.differs());
    ComparisonSettings settings;
    settings.ignored = {"counts"};
    CHECK_FALSE(report::compare(quads, triangles, settings).differs());
    CHECK(report::to_text(report::compare(quads, triangles, settings), "a", "b", false)
              .starts_with(
                  "a and b agree in everything that was requested\n  counts: 3 different (ignored)\n"));
}

TEST_CASE("surfaces may be apart by the limit", "[report]") {
    Scene moved = scene_called(shapes::grid(4, 3)); // diagonal 5
    moved.parts[0].transform.m[2][3] = 0.05;
    const Scene sheet = scene_called(shapes::grid(4, 3));
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
    Scene a = scene_called(shapes::uv_cube()), b = a;
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
        Scene a = scene_called(mesh), b = a;
        for (std::size_t c = 0; c < b.parts[0].mesh.corners.size(); c += 3)
            std::swap(b.parts[0].mesh.corners[c], b.parts[0].mesh.corners[c + 1]);
        CHECK(different(report::compare(a, b)) == "geometry: reversed");
    }
}

TEST_CASE("one component or part turned inside out is enough to differ", "[report]") {
    Scene a = scene_called(shapes::icosphere(1));
    for (Vec3& p : a.parts[0].mesh.positions) p = p * 3;
    append(a.parts[0].mesh, shapes::cube());
    a.parts.push_back(scene_called(shapes::grid(3, 2)).parts[0]);
    const auto turned = [](Mesh mesh, std::size_t from) {
        for (std::size_t c = from; c < mesh.corners.size(); c += 3)
            std::swap(mesh.corners[c], mesh.corners[c + 1]);
        return mesh;
    };
    Scene b = a, c = a;
    b.parts[0].mesh = turned(a.parts[0].mesh, 240);
    c.parts[1].mesh = turned(a.parts[1].mesh, 0);
    CHECK(different(report::compare(a, a)).empty());
    for (const auto& [other, note] : {std::pair(b, "1 of 3 components, the first at face 80 of 'part'"),
                                      std::pair(c, "1 of 3 components, the first at face 0 of 'part'")}) {
        const auto found = report::compare(a, other);
        CHECK(different(found) == "geometry: reversed");
        for (const auto& d : found.lines)
            if (d.name == "reversed") CHECK(d.note == note);
    }
}

TEST_CASE("topology is compared property by property", "[report]") {
    Mesh open = shapes::cube();
    open.corners.resize(30);
    const std::string found = different(report::compare(scene_called(shapes::cube()), scene_called(open)));
    CHECK(found.find("topology: closed") != std::string::npos);
    CHECK(found.find("topology: boundary_loops") != std::string::npos);
    CHECK(found.find("topology: components") == std::string::npos);
}

TEST_CASE("something differs from nothing", "[report]") {
    const Comparison d = report::compare(scene_called(shapes::cube()), scene_called({}));
    CHECK(d.differs());
    CHECK(report::to_json(d, "a", "b")["deviation"]["maximum"].is_null());
}

namespace {

Scene cloud_of(std::vector<Vec3> points) {
    Mesh mesh;
    mesh.positions = std::move(points);
    return scene_called(std::move(mesh));
}

const report::Difference* line(const Comparison& comparison, const std::string& name) {
    for (const auto& d : comparison.lines)
        if (d.name == name) return &d;
    return nullptr;
}

} // namespace

TEST_CASE("clouds of as many points differ when a point is elsewhere", "[report]") {
    const Scene a = cloud_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}),
                b = cloud_of({{0, 0, 0}, {1, 0, 0}, {0, 9, 0}});
    const Comparison same = report::compare(a, a), other = report::compare(a, b);
    CHECK_FALSE(same.differs());
    CHECK(same.deviation->forward.vertices == 3);
    CHECK(different(other) == "geometry: deviation maximum");
    CHECK(other.deviation->forward.maximum == 1);
    CHECK(other.deviation->backward.maximum == 8);
    const Json json = report::to_json(other, "a", "b");
    CHECK(json["geometry_of"] == Json{{"a", "points"}, {"b", "points"}});
    ComparisonSettings settings;
    settings.rms = ComparisonSettings::Limit{4.6, false}; // sqrt(64 / 3) is 4.62
    CHECK(different(report::compare(a, b, settings)) == "geometry: deviation rms");
    settings.rms->amount = 4.62;
    CHECK_FALSE(report::compare(a, b, settings).differs());
}

TEST_CASE("a cloud is measured against a surface", "[report]") {
    const Scene sheet = scene_called(shapes::grid(4, 3)), cloud = cloud_of({{1, 1, 0.5}, {2, 1.5, 0.25}});
    const Comparison d = report::compare(cloud, sheet);
    CHECK(d.deviation->forward.maximum == 0.5);
    CHECK(d.deviation->forward.mean == 0.375);
    CHECK(d.deviation->backward.maximum > 1);
    CHECK(report::to_json(d, "a", "b")["geometry_of"]["b"] == "surface");
    CHECK(report::compare(cloud, scene_called({})).differs());
    CHECK_FALSE(report::compare(scene_called({}), scene_called({})).differs());
}

TEST_CASE("points beside a surface are measured to all of the other scene", "[report]") {
    Mesh with_one = shapes::grid(4, 3), with_another = with_one;
    with_one.positions.push_back({1, 1, 2});
    with_another.positions.push_back({1, 1, 2.5});
    ComparisonSettings settings;
    settings.ignored = {"counts", "topology"};
    CHECK(different(report::compare(scene_called(with_one), scene_called(with_another))) ==
          "geometry: isolated vertices maximum");
    CHECK(
        line(report::compare(scene_called(with_one), scene_called(with_another)), "isolated vertices maximum")
            ->a == 0.5);
    const Comparison lost =
        report::compare(scene_called(with_one), scene_called(shapes::grid(4, 3)), settings);
    CHECK(line(lost, "isolated vertices maximum")->a == 2);
    CHECK(line(lost, "isolated vertices maximum")->b == 0);
    CHECK(lost.deviation->maximum() < 1e-15);
    CHECK_FALSE(report::compare(scene_called(with_one), scene_called(with_one), settings).differs());
}

TEST_CASE("numbers that are none agree with themselves alone", "[report]") {
    const auto with = [](std::vector<double> values) {
        Scene scene = scene_called(shapes::tetrahedron());
        scene.parts[0].mesh.attributes.push_back({"q", Domain::vertex, Role::generic, 1, false, values});
        return scene;
    };
    const Scene a = with({NAN, HUGE_VAL, -HUGE_VAL, 1});
    CHECK_FALSE(report::compare(a, a).differs());
    for (const auto& values : std::vector<std::vector<double>>{
             {1, HUGE_VAL, -HUGE_VAL, 1}, {NAN, -HUGE_VAL, -HUGE_VAL, 1}, {NAN, HUGE_VAL, -HUGE_VAL, NAN}}) {
        CHECK(different(report::compare(a, with(values))) == "attributes: q (vertex)");
        CHECK(different(report::compare(with(values), a)) == "attributes: q (vertex)");
    }
}

TEST_CASE("normals are compared in the world", "[report]") {
    const Scene a = scene_called(shapes::uv_cube());
    Scene turned = a, baked = a;
    Transform quarter;
    quarter.m[0][0] = 0;
    quarter.m[0][1] = -1;
    quarter.m[1][0] = 1;
    quarter.m[1][1] = 0;
    turned.parts[0].transform = quarter;
    apply(baked.parts[0].mesh, quarter);
    CHECK(different(report::compare(turned, baked)).empty());
    CHECK(different(report::compare(a, turned)).find("NORMAL") != std::string::npos);
}

TEST_CASE("what could not be compared is said, and is not the same", "[report]") {
    Scene a = scene_called(shapes::uv_cube()), b = a;
    b.parts[0].mesh.find("TEXCOORD_0", Domain::wedge)->resize(7); // as another number of wedges would
    Comparison d = report::compare(a, b);
    CHECK_FALSE(d.differs());
    CHECK_FALSE(d.complete());
    CHECK_FALSE(line(d, "TEXCOORD_0 (wedge)")->compared);
    const std::string text = report::to_text(d, "a", "b", false);
    CHECK(text.starts_with("a and b agree in everything that was compared\n"));
    CHECK(text.find("not compared: the numbers of elements differ, 24 and 7") != std::string::npos);
    CHECK(report::to_json(d, "a", "b")["complete"] == false);
    d.ignored = {"attributes"};
    CHECK(d.complete());
    d.left_out.push_back({false, "lines"});
    CHECK_FALSE(d.complete());
    CHECK(report::to_text(d, "a", "b", false).find("  not compared: b: lines\n") != std::string::npos);
}

TEST_CASE("materials differ by their looks and by the faces they are on", "[report]") {
    Scene a = scene_called(shapes::grid(2, 1)); // four triangles
    a.materials = {{.name = "red"}, {.name = "blue"}};
    Mesh& mesh = a.parts[0].mesh;
    mesh.primitives.resize(2);
    mesh.primitives[0].material = 0;
    mesh.primitives[1].material = 1;
    const auto assign = [](Scene& scene, std::vector<std::uint32_t> faces) {
        auto& m = scene.parts[0].mesh;
        m.drop(primitive_attribute, Domain::face);
        m.attributes.push_back(
            {std::string(primitive_attribute), Domain::face, Role::index, 1, false, std::move(faces)});
    };
    assign(a, {0, 0, 1, 1});
    CHECK_FALSE(report::compare(a, a).differs());
    Scene materials = a, swapped = a, reordered = a;
    materials.materials[0].base_colour[1] = 0.5;
    materials.materials[1].double_sided = true;
    CHECK(different(report::compare(a, materials)) == "materials: 0 base_colour, materials: 1 double_sided");
    assign(swapped, {1, 1, 0, 0});
    CHECK(different(report::compare(a, swapped)) == "materials: 0 faces, materials: 1 faces");
    assign(reordered, {1, 1, 0, 0});
    auto& corners = reordered.parts[0].mesh.corners;
    std::rotate(corners.begin(), corners.begin() + 6, corners.end());
    CHECK(different(report::compare(a, reordered)).empty());
    assign(swapped, {0, 0, 0, 0});
    CHECK(line(report::compare(a, swapped), "1 faces")->a.is_null());
}

TEST_CASE("a unit or an up axis that explains a difference is named", "[report]") {
    const auto box = [](double x, double y, double z) {
        Mesh mesh = shapes::cube();
        for (Vec3& p : mesh.positions) p = {(p.x + 3) * x, (p.y + 5) * y, (p.z + 7) * z};
        return scene_called(mesh);
    };
    const auto hint = [](const Scene& a, const Scene& b) { return report::compare(a, b).hint; };
    const Scene mm = box(100, 200, 300);
    CHECK(hint(mm, mm).empty());
    CHECK(hint(mm, box(0.1, 0.2, 0.3)) ==
          "the bounding boxes match if the first file is scaled by 0.001 "
          "(from mm to m): use --unit mm,m, because neither file states a unit");
    Scene metre = box(0.1, 0.2, 0.3), both = mm;
    metre.unit = Unit::m;
    both.unit = Unit::mm;
    CHECK(hint(mm, metre).ends_with("use --unit mm, because the first file does not state a unit"));
    CHECK(hint(both, box(0.1, 0.2, 0.3))
              .ends_with("use --unit m, because the second file does not state a unit"));
    CHECK(hint(both, metre).ends_with("both files state a unit, and one seems to be wrong"));
    CHECK(hint(box(1, 2, 3),
               [&] {
                   Scene cm = box(30.48, 60.96, 91.44);
                   cm.unit = Unit::cm;
                   return cm;
               }())
              .find("(from ft to cm): use --unit ft") != std::string::npos);
    CHECK(hint(box(1, 2, 3), box(25.4, 50.8, 76.2)).find("scaled by 25.4 (from in to mm)") !=
          std::string::npos);
    CHECK(hint(mm, box(130, 260, 390)).empty());
    CHECK(hint(mm, box(100, 200, 250)).empty());
    Scene z_up = mm;
    for (Vec3& p : z_up.parts[0].mesh.positions) p = {p.x, -p.z, p.y};
    CHECK(hint(mm, z_up) == "the bounding boxes match if the first file is rotated from y up to z up: use "
                            "--up y,z, because neither "
                            "file states an up axis");
    for (Vec3& p : z_up.parts[0].mesh.positions) p = p * 0.001;
    CHECK(hint(mm, z_up).find(
              "scaled by 0.001 (from mm to m) and rotated from y up to z up: use --unit mm,m") !=
          std::string::npos);
    Scene turned = mm;
    for (Vec3& p : turned.parts[0].mesh.positions) p = {p.y, p.z, p.x};
    CHECK(hint(mm, turned) ==
          "the bounding boxes match if the first file is rotated so that its x, y, z become y, z, x "
          "(transform --matrix 0,1,0,0,0,0,1,0,1,0,0,0)");
    for (Vec3& p : turned.parts[0].mesh.positions) p = {-p.x, p.y, p.z}; // mirrored is not turned
    CHECK(hint(mm, turned).empty());
    // A box centred at 0 looks the same in each orientation, except for its contents.
    const auto cube_at_0 = [](const Mesh& inside) {
        Mesh mesh = shapes::cube();
        append(mesh, inside);
        for (Vec3& p : mesh.positions) p = p * 2 - Vec3{1, 1, 1};
        return scene_called(mesh);
    };
    Mesh inside = shapes::cube();
    for (Vec3& p : inside.positions) p = p * 0.5 + Vec3{0.25, 0.05, 0.25};
    const Scene low = cube_at_0(inside);
    Scene lying = low;
    for (Vec3& p : lying.parts[0].mesh.positions) p = {p.x, p.z, -p.y};
    CHECK(hint(low, lying).find("rotated from z up to y up") != std::string::npos);
    Scene cloud = low; // clouds are compared by their vertices
    cloud.parts[0].mesh = {};
    cloud.parts[0].mesh.positions = low.parts[0].mesh.positions;
    Scene lying_cloud = cloud;
    lying_cloud.parts[0].mesh.positions = lying.parts[0].mesh.positions;
    CHECK(hint(cloud, lying_cloud).find("rotated from z up to y up") != std::string::npos);
    ComparisonSettings ignoring;
    ignoring.ignored = {"geometry"};
    CHECK(report::compare(mm, z_up, ignoring).hint.empty());
    CHECK(hint(mm, Scene{}).empty());
}

namespace {

/// A cube around 0, one side of which is cut into many triangles.
Scene cube_with_fine_side(std::size_t axis, double size) {
    Mesh mesh = shapes::cube(), fine = shapes::grid(12, 12);
    mesh.corners.erase(mesh.corners.begin() + 6, mesh.corners.begin() + 12); // z = 1
    for (Vec3& p : fine.positions) p = {p.x / 12, p.y / 12, 1};
    append(mesh, fine);
    for (Vec3& p : mesh.positions) {
        p = (p - Vec3{0.5, 0.5, 0.5}) * size;
        for (std::size_t i = 0; i < axis; ++i) p = {p.y, p.z, p.x};
    }
    return scene_called(mesh);
}

/// A box that is alike in no two ways up.
Scene uneven_box() {
    Mesh mesh = shapes::cube();
    for (Vec3& p : mesh.positions) p = {p.x * 100 + 300, p.y * 200 + 1000, p.z * 300 + 2100};
    return scene_called(mesh);
}

Scene z_to_y(Scene scene) {
    scene.parts[0].transform = io::turn_up(UpAxis::z, UpAxis::y) * scene.parts[0].transform;
    return scene;
}

/// As on the command line: files that state no unit or axis get the given ones.
std::string hint_with(const Scene& a, Scene b, const io::Convention& said_a, const io::Convention& said_b) {
    const auto stated = [](const Scene& scene, const io::Convention& said) {
        return io::Convention{scene.unit == Unit::unknown ? said.unit : scene.unit,
                              scene.up == UpAxis::unknown ? said.up : scene.up};
    };
    ComparisonSettings settings;
    settings.origin = report::Origin{{a.unit, a.up}, {b.unit, b.up}, {}};
    Scene first = a;
    const io::Convention of_a = stated(a, said_a), of_b = stated(b, said_b);
    first.unit = of_a.unit;
    first.up = of_a.up;
    b.unit = of_b.unit;
    b.up = of_b.up;
    settings.origin->of_second = io::convert(b, {b.unit == Unit::unknown ? Unit::unknown : of_a.unit,
                                                 b.up == UpAxis::unknown ? UpAxis::unknown : of_a.up});
    return report::compare(first, b, settings).hint;
}

} // namespace

TEST_CASE("files that are aligned are not called turned", "[report]") {
    Scene a = cube_with_fine_side(0, 2), b = cube_with_fine_side(1, 2.004);
    const Comparison found = report::compare(a, b);
    CHECK(different(found).find("geometry: deviation maximum") != std::string::npos);
    CHECK(found.hint.empty());
    for (Scene* scene : {&a, &b}) { // as clouds the means of their vertices are elsewhere
        Mesh cloud;
        cloud.positions = scene->parts[0].mesh.positions;
        scene->parts[0].mesh = cloud;
    }
    CHECK(report::compare(a, b).hint.find("rotated") != std::string::npos);
}

TEST_CASE("an up axis that a file states is not doubted", "[report]") {
    Scene a = uneven_box();
    const Scene turned = z_to_y(a);
    CHECK(report::compare(a, turned).hint.ends_with(
        "rotated from z up to y up: use --up z,y, because neither file states an up axis"));
    a.up = UpAxis::z;
    CHECK(report::compare(a, turned).hint.ends_with(
        "use --up y, because the second file does not state an up axis"));
    a.up = UpAxis::y;
    const std::string matrix = "rotated so that its x, y, z become x, z, -y (transform --matrix "
                               "1,0,0,0,0,0,1,0,0,-1,0,0)";
    CHECK(report::compare(a, turned).hint.ends_with(matrix));
    Scene both = turned;
    both.up = UpAxis::y;
    CHECK(report::compare(a, both).hint.ends_with(matrix));
    CHECK(hint_with(a, turned, {}, {Unit::unknown, UpAxis::z})
              .ends_with("its x, y, z become x, -y, -z (transform --matrix 1,0,0,0,0,-1,0,0,0,0,-1,0)"));
}

TEST_CASE("a hint is of the files, not of what the command line says of them", "[report]") {
    const Scene mm = uneven_box();
    Scene metre = mm;
    for (Vec3& p : metre.parts[0].mesh.positions) p = p * 0.001;
    const io::Convention in_mm{Unit::mm, UpAxis::unknown}, in_m{Unit::m, UpAxis::unknown},
        in_inch{Unit::inch, UpAxis::unknown}, y_up{Unit::unknown, UpAxis::y}, z_up{Unit::unknown, UpAxis::z};
    const std::string say_mm_m =
        "scaled by 0.001 (from mm to m): use --unit mm,m, because neither file states a unit";
    CHECK(hint_with(mm, metre, in_mm, in_mm).ends_with(say_mm_m));
    CHECK(hint_with(mm, metre, in_m, in_mm).ends_with(say_mm_m));
    CHECK(hint_with(mm, metre, in_inch, in_mm).ends_with(say_mm_m));
    CHECK(hint_with(mm, metre, in_mm, in_m).empty());
    CHECK(hint_with(mm, mm, in_mm, in_m) ==
          "the bounding boxes match if the first file is read without --unit");
    Scene stated = mm;
    stated.unit = Unit::mm;
    CHECK(hint_with(stated, metre, in_inch, in_inch)
              .ends_with("use --unit m, because the second file does not state a unit"));
    stated.unit = Unit::m;
    Scene stated_metre = metre;
    stated_metre.unit = Unit::m;
    CHECK(hint_with(stated, stated_metre, in_mm, in_mm)
              .ends_with("both files state a unit, and one seems to be wrong"));
    const std::string say_z_y =
        "rotated from z up to y up: use --up z,y, because neither file states an up axis";
    CHECK(hint_with(mm, z_to_y(mm), y_up, y_up).ends_with(say_z_y));
    CHECK(hint_with(mm, z_to_y(mm), y_up, z_up).ends_with(say_z_y));
    CHECK(hint_with(mm, z_to_y(mm), z_up, y_up).empty());
    CHECK(hint_with(mm, mm, z_up, y_up) == "the bounding boxes match if the first file is read without --up");
    CHECK(hint_with(mm, metre, {Unit::mm, UpAxis::z}, {Unit::mm, UpAxis::y})
              .find("scaled by 0.001 (from mm to m) and read without --up: use --unit mm,m") !=
          std::string::npos);
}

TEST_CASE("a comparison as a page and as Markdown", "[report]") {
    const Scene a = scene_called(shapes::icosphere(2)), b = scene_called(shapes::icosphere(3));
    const Comparison d = report::compare(a, b);
    const auto pictures = report::comparison_pictures(a, b, "a<1>.ply", "b.ply");
    const std::string page = report::to_html(d, "a<1>.ply", "b.ply", pictures);
    CHECK(page.starts_with("<!DOCTYPE html>"));
    CHECK(page.find("a<1>") == std::string::npos);
    CHECK(page.find("<p class=\"verdict bad\">differ in counts, geometry; the surfaces are up to ") !=
          std::string::npos);
    REQUIRE(pictures.forward);
    REQUIRE(pictures.backward);
    for (const std::string& png :
         {pictures.a, pictures.b, pictures.backward->picture, pictures.forward->close}) {
        REQUIRE(png.starts_with("iVBOR"));
        CHECK(page.find("src=\"data:image/png;base64," + png + "\"") != std::string::npos);
    }
    CHECK(pictures.view["scenes"].size() == 2);
    CHECK(pictures.view["scenes"][1]["reference"] == "a<1>.ply");
    CHECK(page.find("<section class=\"viewer\" hidden>") != std::string::npos);
    CHECK(page.find("data-of=\"first\"") != std::string::npos);
    CHECK(page.find("<td><code>faces</code></td><td>320</td><td>1,280</td>") != std::string::npos);
    CHECK_FALSE(report::comparison_pictures(Scene{}, b, "a", "b").backward);
    CHECK_FALSE(report::comparison_pictures(b, b, "a", "b").backward);
    const std::string text = report::to_markdown(d, "a|b.ply", "b.ply");
    CHECK(
        text.starts_with("## a\\|b.ply and b.ply\n\n**differ in counts, geometry; the surfaces are up to "));
    CHECK(text.find("| differs | faces | 320 | 1,280 |  |\n") != std::string::npos);
    CHECK(text.find("| allowed | deviation rms |") != std::string::npos); // it has no limit
    CHECK(text.find("| same | reversed |") != std::string::npos);
    CHECK(text.find("<details><summary>Line by line</summary>") < text.find("| differs | faces |"));
    // Percentages refer to the same length in both directions.
    CHECK(pictures.backward->diagonal == pictures.forward->diagonal);
    CHECK(page.find("Percentages are of the diagonal of the second") == std::string::npos);
    // Messages about points must not mention surfaces.
    const auto points = [](const char* name, double x) {
        Scene scene = scene_called(Mesh{});
        scene.parts[0].name = name;
        scene.parts[0].mesh.positions = {{x, 0, 0}, {x + 1, 1, 0}};
        return scene;
    };
    const Comparison clouds = report::compare(points("a", 0), points("b", 0.5));
    CHECK(report::to_markdown(clouds, "a", "b").find("; the points are up to ") != std::string::npos);
}

TEST_CASE("lines of other materials differ", "[report]") {
    Mesh wire;
    wire.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
    wire.lines = {0, 1, 1, 2};
    wire.line_primitive = {0, 1};
    wire.primitives.resize(2);
    wire.primitives[0].material = 0;
    Scene a = scene_called(wire);
    a.materials.resize(1);
    Scene b = a;
    CHECK_FALSE(report::compare(a, b).differs());
    std::swap(b.parts[0].mesh.line_primitive[0], b.parts[0].mesh.line_primitive[1]);
    const Comparison swapped = report::compare(a, b);
    CHECK(different(swapped) == "materials: 0 lines, materials: lines of none");
    CHECK(line(swapped, "0 lines")->a == 1);
    b.parts[0].mesh.line_primitive = {0, 0};
    CHECK(different(report::compare(a, b)).find("materials: 0 lines") != std::string::npos);
    // The same lines, listed the other way round, are no difference.
    b = a;
    b.parts[0].mesh.lines = {1, 2, 0, 1};
    b.parts[0].mesh.line_primitive = {1, 0};
    CHECK_FALSE(report::compare(a, b).differs());
}
