#include "support/catch.hpp"

#include "geometry/render/font.hpp"
#include "geometry/render/legend.hpp"
#include "geometry/render/render.hpp"
#include "geometry/render/srgb.hpp"
#include "mesh/shapes.hpp"
#include "parallel/parallel.hpp"
#include "support/run_stage.hpp"

using namespace facetmill;
using test::scene_of;

namespace {

struct Pixel {
    int r, g, b, a;
};

Pixel at(const Picture& picture, int x, int y) {
    const std::uint8_t* p = &picture.rgba[4 * static_cast<std::size_t>(y * picture.width + x)];
    return {p[0], p[1], p[2], p[3]};
}

std::size_t covered(const Picture& picture) {
    std::size_t count = 0;
    for (std::size_t i = 3; i < picture.rgba.size(); i += 4) count += picture.rgba[i] > 127;
    return count;
}

/// Whether the pixel shows the inner side: far more red than blue.
bool inner(const Pixel& p) { return p.r > p.b + 60; }

} // namespace

TEST_CASE("a sphere is a disc of the area that a disc has", "[geometry]") {
    const Picture picture = picture_of(scene_of(shapes::icosphere(5)));
    REQUIRE(picture.rgba.size() == 480U * 360U * 4U);
    CHECK(at(picture, 0, 0).a == 0);
    const Pixel middle = at(picture, 240, 180);
    CHECK(middle.a == 255);
    CHECK_FALSE(inner(middle));
    // It fills 92 % of the height.
    const double radius = 0.46 * 360;
    CHECK(static_cast<double>(covered(picture)) == Approx(3.14159 * radius * radius).epsilon(0.01));
    // Lit from the upper left.
    CHECK(at(picture, 180, 100).r > at(picture, 300, 260).r + 40);
}

TEST_CASE("the inner side of a surface is orange, unless its material is double-sided", "[geometry]") {
    Scene scene = scene_of(shapes::icosphere(3));
    auto& corners = scene.parts[0].mesh.corners;
    for (std::size_t c = 0; c < corners.size(); c += 3) std::swap(corners[c], corners[c + 1]);
    CHECK(inner(at(picture_of(scene), 240, 180)));
    Material& material = scene.materials.emplace_back();
    material.double_sided = true;
    material.base_colour[0] = material.base_colour[1] = 0;
    scene.parts[0].mesh.primitives.resize(1);
    scene.parts[0].mesh.primitives[0].material = 0;
    const Pixel blue = at(picture_of(scene), 240, 180);
    CHECK(blue.r == 0);
    CHECK(blue.b > 100);
}

namespace {

/// A flat square in the plane z = 0 that faces +z, seen from +z at about 20 pixels per side.
Scene square(bool turned = false) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.corners = {0, 1, 2, 3};
    if (turned) mesh.corners = {3, 2, 1, 0};
    mesh.face_offsets = {0, 4};
    return scene_of(mesh);
}

PictureSettings seen_from(const Vec3& from, Shading shading = Shading::sides) {
    PictureSettings s;
    s.width = s.height = 100;
    s.from = from;
    s.shading = shading;
    s.edges = EdgeLines::no;
    return s;
}

/// The shade of grey that a cosine gives, by the stated formula.
int shade(double cosine) {
    const double linear = 0.72 * (0.16 + 0.84 * std::max(0.0, cosine));
    return static_cast<int>(255 * (1.055 * std::pow(linear, 1 / 2.4) - 0.055) + 0.5);
}

/// The width and height of the covered pixels.
std::pair<int, int> size_of(const Picture& picture) {
    int left = picture.width, right = -1, top = picture.height, bottom = -1;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            if (at(picture, x, y).a > 127) {
                left = std::min(left, x);
                right = std::max(right, x);
                top = std::min(top, y);
                bottom = std::max(bottom, y);
            }
    return {right - left + 1, bottom - top + 1};
}

} // namespace

TEST_CASE("the cosine between normal and light shades a face, or its absolute value", "[geometry]") {
    const double facing = 0.75 / std::sqrt(0.35 * 0.35 + 0.55 * 0.55 + 0.75 * 0.75);
    const auto middle = [](const Scene& scene, Shading shading) {
        return at(picture_of(scene, seen_from({0, 0, 1}, shading)), 50, 50).r;
    };
    CHECK(middle(square(), Shading::one_sided) == shade(facing));
    CHECK(middle(square(true), Shading::one_sided) == shade(0));
    CHECK(middle(square(true), Shading::absolute) == shade(facing));
    Scene both = square(true);
    both.materials.emplace_back().double_sided = true;
    both.parts[0].mesh.primitives.resize(1);
    both.parts[0].mesh.primitives[0].material = 0;
    CHECK(middle(both, Shading::one_sided) == shade(facing));
    // Doubled faces: the front is visible, whichever comes first.
    for (const bool first : {false, true}) {
        Scene doubled = square(first);
        append(doubled.parts[0].mesh, square(!first).parts[0].mesh);
        CHECK(middle(doubled, Shading::one_sided) == shade(facing));
    }
}

TEST_CASE("absolute values hide which way faces run", "[geometry]") {
    Scene good = scene_of(shapes::icosphere(3)), bad = good;
    auto& corners = bad.parts[0].mesh.corners;
    for (std::size_t c = 0; c < corners.size(); c += 9) std::swap(corners[c], corners[c + 1]);
    PictureSettings s;
    s.shading = Shading::absolute;
    CHECK(picture_of(good, s).rgba == picture_of(bad, s).rgba);
    s.shading = Shading::one_sided;
    CHECK_FALSE(picture_of(good, s).rgba == picture_of(bad, s).rgba);
}

TEST_CASE("a scene is seen by the camera of another", "[geometry]") {
    const Scene whole = scene_of(shapes::icosphere(4));
    PictureSettings settings;
    settings.camera = camera_of(whole);
    const Picture same = picture_of(whole, settings);
    CHECK(same.rgba == picture_of(whole).rgba);
    Mesh small = shapes::icosphere(4);
    for (Vec3& p : small.positions) p = p * 0.5;
    const Picture half = picture_of(scene_of(small), settings);
    CHECK(half.scale == same.scale);
    CHECK(static_cast<double>(covered(half)) == Approx(static_cast<double>(covered(same)) / 4).epsilon(0.02));
}

TEST_CASE("a box has its sides where the viewer stands", "[geometry]") {
    Mesh box = shapes::cube();
    for (Vec3& p : box.positions) p = {4e6 + 4.6 * p.x, 2 * p.y, 2.5 * p.z};
    Scene scene = scene_of(box);
    scene.up = UpAxis::z;
    const auto size = [&](Viewpoint viewpoint) {
        PictureSettings s;
        s.width = s.height = 1000;
        s.viewpoint = viewpoint;
        return size_of(picture_of(scene, s));
    };
    using Size = std::pair<int, int>;
    CHECK(size(Viewpoint::front) == Size{920, 500});
    CHECK(size(Viewpoint::back) == Size{920, 500});
    CHECK(size(Viewpoint::left) == Size{736, 920});
    CHECK(size(Viewpoint::right) == Size{736, 920});
    CHECK(size(Viewpoint::top) == Size{920, 400});
    CHECK(size(Viewpoint::bottom) == Size{920, 400});
    scene.up = UpAxis::y;
    CHECK(size(Viewpoint::front) == Size{920, 400});
    CHECK(picture_of(scene, seen_from({0, 0, 5})).scale == Approx(92.0 / 4.6));
    // Left and right are not swapped: a square to the right of the box appears on the right.
    Scene two = square();
    two.up = UpAxis::y;
    two.parts[0].mesh.positions[2] = two.parts[0].mesh.positions[1] = {1, 0.5, 0};
    PictureSettings front;
    front.viewpoint = Viewpoint::front;
    const Picture narrow_right = picture_of(two, front);
    CHECK(at(narrow_right, 240 - 150, 40).a == 255);
    CHECK(at(narrow_right, 240 + 150, 40).a == 0);
}

TEST_CASE("edges of polygons are drawn, those of their triangles are not", "[geometry]") {
    PictureSettings with = seen_from({0, 0, 1});
    with.edges = EdgeLines::all;
    const Picture lines = picture_of(square(), with), none_drawn = picture_of(square(), seen_from({0, 0, 1}));
    CHECK(at(lines, 50, 50).r == at(none_drawn, 50, 50).r);
    CHECK(at(lines, 4, 50).r < at(none_drawn, 4, 50).r);
    const Scene cut = scene_of(triangulated(square().parts[0].mesh));
    CHECK(at(picture_of(cut, with), 50, 50).r < at(none_drawn, 50, 50).r);
}

TEST_CASE("pictures are painted by attributes", "[geometry]") {
    Scene scene = square();
    Mesh& mesh = scene.parts[0].mesh;
    mesh.attributes.push_back(
        {"heat", Domain::wedge, Role::generic, 1, false, std::vector<float>{0, 10, 10, 0}});
    mesh.attributes.push_back({"group", Domain::face, Role::index, 1, false, std::vector<std::uint32_t>{3}});
    PictureSettings s = seen_from({0, 0, 1});
    s.attribute = "heat";
    const Picture heat = picture_of(scene, s);
    CHECK(heat.has_attribute);
    CHECK(heat.range.low == 0);
    CHECK(heat.range.high == 10);
    CHECK_FALSE(heat.range.percentiles);
    const Pixel cold = at(heat, 6, 50), hot = at(heat, 93, 50);
    CHECK(cold.b > cold.g + 40);
    CHECK(hot.r > hot.b + 100);
    s.attribute = "group";
    const Pixel red = at(picture_of(scene, s), 50, 50);
    CHECK(red.r > red.g + 60);
    s.attribute = "nothing";
    CHECK_FALSE(picture_of(scene, s).has_attribute);
    CHECK(picture_of(scene, s).rgba == picture_of(scene, seen_from({0, 0, 1})).rgba);
    mesh.attributes.push_back({"COLOR_0", Domain::wedge, Role::colour, 4, false,
                               std::vector<float>{1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}});
    const Pixel coloured = at(picture_of(scene, seen_from({0, 0, 1})), 50, 50);
    CHECK(coloured.r > 150);
    CHECK(coloured.g == 0);
    s = seen_from({0, 0, 1});
    s.paint = Paint::normal; // +z: x and y in the middle, blue full
    const Pixel direction = at(picture_of(scene, s), 50, 50);
    CHECK(std::abs(direction.r - 128) <= 1);
    CHECK(std::abs(direction.g - 128) <= 1);
    CHECK(direction.b == 255);
    s.shows = [](const Part&) { return false; };
    CHECK(covered(picture_of(scene, s)) == 0);
}

TEST_CASE("pictures stand in rows", "[geometry]") {
    PictureSettings s = seen_from({0, 0, 1});
    s.ground = {1, 1, 1};
    const Picture left = picture_of(square(), s), right = picture_of({}, s);
    const Picture sheet = sheet_of({left, right, right}, 2);
    CHECK(sheet.width == 200);
    CHECK(sheet.height == 200);
    CHECK(sheet.rgba.size() == 4 * left.rgba.size());
    CHECK(at(sheet, 50, 50).r == at(left, 50, 50).r);
    CHECK(at(sheet, 150, 50).r == 255);
    CHECK(at(sheet, 150, 50).a == 255);
    CHECK(at(sheet, 50, 150).a == 255);
    CHECK(at(sheet, 150, 150).a == 0);
}

TEST_CASE("the same bytes for any number of threads, however a scene is drawn", "[geometry]") {
    Scene scene = scene_of(shapes::icosphere(4));
    Mesh& ball = scene.parts[0].mesh;
    std::vector<float> heights;
    for (const Vec3& p : ball.positions) heights.push_back(static_cast<float>(p.y));
    ball.attributes.push_back({"height", Domain::vertex, Role::generic, 1, false, heights});
    scene.parts.push_back(square().parts[0]);
    std::vector<PictureSettings> all(11);
    for (std::size_t i = 0; i < 6; ++i) {
        all[i].shading = std::array{Shading::sides, Shading::one_sided, Shading::absolute}[i / 2];
        all[i].normals = i % 2 == 0 ? ShadingNormals::flat : ShadingNormals::smooth;
    }
    all[6].perspective = 0.6;
    all[6].silhouettes = true;
    all[6].edges = EdgeLines::all; // a wireframe over the faces
    all[7].occlusion = false;
    all[8].coarse_occlusion = true;
    all[9].paint = Paint::normal;
    all[10].attribute = "height"; // a heat map
    all[10].legend = true;
    const int before = threads();
    for (const PictureSettings& s : all) {
        set_threads(1);
        const Picture one = picture_of(scene, s);
        CHECK(covered(one) > 1000);
        for (const int count : {2, 3}) {
            set_threads(count);
            CHECK(picture_of(scene, s).rgba == one.rgba);
        }
    }
    set_threads(before);
}

TEST_CASE("a scene that does not say where up is stands on its base", "[geometry]") {
    Mesh box = shapes::cube();
    for (Vec3& p : box.positions) p = {p.x, p.y, 1.5 * p.z};
    Scene scene = scene_of(box);
    PictureSettings front = seen_from({});
    front.from.reset();
    front.viewpoint = Viewpoint::front;
    CHECK(size_of(picture_of(scene, front)).first < 70); // both ends are flat: the longer one, z, is up
    Scene along = scene;                                 // longest along x: y is up, though z is longer
    for (Vec3& p : along.parts[0].mesh.positions) p.x *= 3;
    CHECK(size_of(picture_of(along, front)).second < 35); // 46 with z up
    Mesh& mesh = scene.parts[0].mesh;
    const double lowest = mesh.bounds().min.z;
    for (Index f = 0; f < mesh.face_count();) { // without the side at the lower end of z
        const Index c = 3 * f;
        if (mesh.point(c).z == lowest && mesh.point(c + 1).z == lowest && mesh.point(c + 2).z == lowest)
            mesh.corners.erase(mesh.corners.begin() + c, mesh.corners.begin() + c + 3);
        else
            ++f;
    }
    CHECK(mesh.face_count() == 10);
    CHECK(size_of(picture_of(scene, front)) == std::pair(92, 92)); // y is up
}

TEST_CASE("an open surface is seen from the side that its faces look to", "[geometry]") {
    Scene scene = square(true); // faces -z, which is the back
    PictureSettings s = seen_from({});
    s.from.reset();
    s.viewpoint = Viewpoint::front;
    CHECK_FALSE(inner(at(picture_of(scene, s), 50, 50)));
    scene.up = UpAxis::y; // the front is +z by convention
    CHECK(inner(at(picture_of(scene, s), 50, 50)));
}

TEST_CASE("perspective makes what is near larger, and zoom what is in the middle", "[geometry]") {
    Scene two = square(); // and a second square of the same size far behind it, to the right
    append(two.parts[0].mesh, square().parts[0].mesh);
    for (std::size_t v = 4; v < 8; ++v) two.parts[0].mesh.positions[v] += Vec3{1.5, 0, -4};
    PictureSettings s = seen_from({0, 0, 1});
    const auto height_at = [&](int x, const Picture& picture) {
        int count = 0;
        for (int y = 0; y < picture.height; ++y) count += at(picture, x, y).a > 127;
        return count;
    };
    const Picture parallel = picture_of(two, s);
    CHECK(height_at(20, parallel) == height_at(80, parallel));
    s.perspective = 1;
    const Picture perspective = picture_of(two, s);
    CHECK(height_at(20, perspective) > height_at(90, perspective) + 10);
    PictureSettings near = seen_from({0, 0, 1});
    near.zoom = 8;
    near.at = Vec3{0, 0, 0}; // the corner of the square: the picture's middle
    const Picture corner = picture_of(square(), near);
    CHECK(at(corner, 75, 25).a == 255);
    CHECK(at(corner, 25, 25).a == 0);
    CHECK(at(corner, 75, 75).a == 0);
    CHECK(corner.scale == Approx(8 * 92.0));
}

TEST_CASE("rings mark places, over all else", "[geometry]") {
    PictureSettings s = seen_from({0, 0, 1});
    s.marks = {{0.5, 0.5, -100}, {NAN, 0, 0}};
    const Picture picture = picture_of(square(), s);
    const Pixel ring = at(picture, 50 + 6, 50), middle = at(picture, 50, 50);
    CHECK(ring.r == 200);
    CHECK(ring.g == 20);
    CHECK(middle.g > 150); // inside it the scene is visible
}

TEST_CASE("folds are darker than planes", "[geometry]") {
    Mesh corner; // floor and back wall, seen from above at 45 degrees
    corner.positions = {{0, 0, 0}, {4, 0, 0}, {4, 0, 2}, {0, 0, 2}, {0, 2, 0}, {4, 2, 0}};
    corner.corners = {3, 2, 1, 0, 0, 1, 5, 4};
    corner.face_offsets = {0, 4, 8};
    PictureSettings s = seen_from({0, 1, 1});
    s.width = 200;
    const auto red_at = [&](bool occlusion, int y) {
        s.occlusion = occlusion;
        return at(picture_of(scene_of(corner), s), 100, y).r;
    };
    for (const bool coarse : {false, true}) {
        s.coarse_occlusion = coarse;
        for (const int y : {47, 53}) CHECK(red_at(true, y) < red_at(false, y) - 5);  // at the fold
        for (const int y : {25, 75}) CHECK(red_at(true, y) >= red_at(false, y) - 1); // far from it
    }
    // A plane does not occlude itself, whatever its orientation.
    PictureSettings steep = seen_from({0.2, 3, 1});
    const Picture with = picture_of(square(), steep);
    steep.occlusion = false;
    CHECK(with.rgba == picture_of(square(), steep).rgba);
}

TEST_CASE("outliers do not eat the range of colours", "[geometry]") {
    Scene scene = square();
    Mesh& mesh = scene.parts[0].mesh;
    std::vector<float> values;
    for (int i = 0; i < 1000; ++i) values.push_back(static_cast<float>(i));
    values[999] = 1e6f;
    mesh.attributes.push_back({"heat", Domain::vertex, Role::generic, 1, false, values});
    const auto range = [&](ColourRange::Kind kind) { return value_range(scene, "heat", {kind, 3, 4}, {}); };
    const ValueRange robust = range(ColourRange::Kind::automatic);
    CHECK(robust.percentiles);
    CHECK(robust.low == 9);
    CHECK(robust.high == 989);
    CHECK(robust.max == 1e6);
    CHECK(robust.beyond());
    CHECK(range(ColourRange::Kind::all).high == 1e6);
    CHECK(range(ColourRange::Kind::given).low == 3);
    auto& stored = std::get<std::vector<float>>(mesh.attributes.back().data);
    stored[999] = 999;
    CHECK_FALSE(range(ColourRange::Kind::automatic).percentiles);
    CHECK(range(ColourRange::Kind::percentile).percentiles);
    stored[0] = NAN;
    CHECK(range(ColourRange::Kind::automatic).low == 1);
    CHECK(range(ColourRange::Kind::automatic).missing == 1);
    stored[1] = -1500;
    const auto both_ways = [&](ColourRange::Kind kind) {
        return value_range(scene, "heat", {kind, 3, 4, true}, {});
    };
    CHECK(both_ways(ColourRange::Kind::automatic).low == -1500);
    CHECK(both_ways(ColourRange::Kind::automatic).high == 1500);
    CHECK(both_ways(ColourRange::Kind::percentile).low == -990);
    CHECK(both_ways(ColourRange::Kind::percentile).high == 990);
}

TEST_CASE("what is no number is pink, and the legend says so", "[geometry]") {
    const auto pink = [](const Pixel& p) { return p.r > 120 && p.r > p.g + 60 && p.b > p.g + 40; };
    for (const float x : {NAN, HUGE_VALF}) {
        Scene scene = scene_of(shapes::grid(2, 1)); // two squares of two triangles
        scene.parts[0].mesh.attributes.push_back(
            {"heat", Domain::face, Role::generic, 1, false, std::vector<float>{0, 1, x, x}});
        PictureSettings s = seen_from({0, 0, 1});
        s.width = 300;
        s.attribute = "heat";
        s.ground = {1, 1, 1};
        const Picture bare = picture_of(scene, s);
        CHECK(pink(at(bare, 225, 50)));
        CHECK_FALSE(pink(at(bare, 75, 50)));
        s.legend = true;
        const Picture picture = picture_of(scene, s);
        std::size_t swatch = 0; // below the scale
        for (int y = 70; y < 100; ++y)
            for (int x_at = 300 - 17 * 6; x_at < 300; ++x_at) swatch += pink(at(picture, x_at, y));
        CHECK(swatch > 30);
        scene.parts[0].mesh.attributes.back().data = std::vector<float>{0, 1, 2, 3};
        const Picture whole = picture_of(scene, s);
        for (int y = 0; y < 100; ++y)
            for (int x_at = 300 - 17 * 6; x_at < 300; ++x_at) REQUIRE_FALSE(pink(at(whole, x_at, y)));
    }
}

TEST_CASE("a legend stands beside the scene", "[geometry]") {
    Scene scene = square();
    scene.parts[0].mesh.attributes.push_back(
        {"heat", Domain::wedge, Role::generic, 1, false, std::vector<float>{0, 10, 10, 0}});
    PictureSettings s = seen_from({0, 0, 1});
    s.width = 300;
    s.attribute = "heat";
    s.legend = true;
    s.ground = {1, 1, 1};
    const Picture picture = picture_of(scene, s);
    CHECK(picture.width == 300);
    const int bar = 300 - 17 * 6 + 4;
    CHECK(at(picture, bar, 76).b > at(picture, bar, 76).g + 60);  // dark blue below
    CHECK(at(picture, bar, 34).r > at(picture, bar, 34).b + 100); // yellow above
    std::size_t ink = 0;
    for (int y = 25; y < 85; ++y)
        for (int x = bar + 16; x < 300; ++x) ink += at(picture, x, y).r < 100;
    CHECK(ink > 20); // the numbers
    s.legend = false;
    CHECK(at(picture_of(scene, s), 290, 50).r > 200);
    // Identifiers have their colours and numbers, if they are few.
    scene.parts[0].mesh.attributes.push_back(
        {"failed", Domain::face, Role::index, 1, false, std::vector<std::uint32_t>{1}});
    s.attribute = "failed";
    s.legend = true;
    CHECK(value_range(scene, "failed", {}, {}).identifiers == std::vector<std::uint64_t>{1});
    const Picture coloured = picture_of(scene, s);
    const Colour one = distinct_colour(1);
    CHECK(at(coloured, bar, 33).r == srgb_of(one[0]));
    CHECK(at(coloured, bar, 33).b == srgb_of(one[2]));
    s.height = 30;
    CHECK(legend_width(s, value_range(scene, "failed", {}, {})) == 0);
}

TEST_CASE("a legend that does not fit is left out", "[geometry]") {
    PictureSettings s;
    s.legend = true;
    ValueRange range;
    range.known = true;
    range.high = range.max = 10;
    const auto width = [&](int wide, int high) {
        s.width = wide;
        s.height = high;
        return legend_width(s, range);
    };
    CHECK(width(204, 100) == 102);
    CHECK(width(203, 100) == 0);
    CHECK(width(1, 1) == 0);
    CHECK(width(300, 70) == 102);
    CHECK(width(300, 69) == 0);
    s.unit = "mm";
    range.percentiles = true;
    range.max = 20; // three lines below, one more above
    CHECK(width(300, 100) == 0);
    CHECK(width(300, 110) == 102);
    Scene scene = square();
    scene.parts[0].mesh.attributes.push_back(
        {"heat", Domain::wedge, Role::generic, 1, false, std::vector<float>{0, 10, 10, 0}});
    s.attribute = "heat";
    s.width = 300;
    s.height = 40;
    const Picture with = picture_of(scene, s);
    s.legend = false;
    CHECK(with.rgba == picture_of(scene, s).rgba);
}

TEST_CASE("a stray vertex that no face has does not make the picture smaller", "[geometry]") {
    const PictureSettings s = seen_from({0, 0, 1});
    Scene stray = square();
    stray.parts[0].mesh.positions.push_back({1e6, 0, 0});
    CHECK(picture_of(stray, s).rgba == picture_of(square(), s).rgba);
    CHECK(picture_of(stray, s).scale == picture_of(square(), s).scale);
    stray.parts[0].mesh.corners.clear(); // points are all drawn
    CHECK(picture_of(stray, s).scale < 1);
}

TEST_CASE("the fitting scale is that beside the legend", "[geometry]") {
    Scene scene = square();
    scene.parts[0].mesh.attributes.push_back(
        {"heat", Domain::wedge, Role::generic, 1, false, std::vector<float>{0, 10, 10, 0}});
    PictureSettings s = seen_from({0, 0, 1});
    s.width = 210;
    s.height = 200; // 108 pixels of width remain
    s.attribute = "heat";
    s.legend = true;
    CHECK(fitting_scale(scene, s) == Approx(0.92 * 108));
    CHECK(picture_of(scene, s).scale == Approx(0.92 * 108));
}

TEST_CASE("numbers of a narrow range are told apart", "[geometry]") {
    using Texts = std::vector<std::string>;
    CHECK(number_texts({0, 2.5, 5}, 14) == Texts{"0", "2.5", "5"});
    CHECK(number_texts({1000.01, 1000.02, 1000.03}, 14) == Texts{"1000.01", "1000.02", "1000.03"});
    CHECK(number_texts({12340, 12345}, 14) == Texts{"12340", "12345"});
    CHECK(number_texts({7, 7}, 14) == Texts{"7", "7"});
    const double large = 9007199254740992; // 2^53: its neighbours are 2 apart
    CHECK(round_numbers(large, large + 4, 9) == std::vector<double>{large, large + 4});
}

TEST_CASE("a character of several bytes is one box", "[geometry]") {
    const auto written = [](const char* text) {
        Picture p;
        p.width = 40;
        p.height = 8;
        p.rgba.assign(4 * 40 * 8, 0);
        write_text(p, 0, 0, 1, text, {1, 2, 3});
        return p.rgba;
    };
    CHECK(written("\xc2\xb5m") == written("\x01m"));
    CHECK(written("\xe2\x82\xac") == written("\x01"));
    CHECK(written("\xc2") == written("\x01")); // cut short
}

TEST_CASE("pictures of what can hardly be seen", "[geometry]") {
    CHECK(covered(picture_of({})) == 0);
    CHECK(covered(picture_of(scene_of({}))) == 0);
    Mesh points;
    points.positions = {{0, 0, 0}, {1, 1, 1}, {HUGE_VAL, 0, 0}, {0, NAN, 0}};
    std::size_t alpha = 0; // two squares of a pixel each, at any position
    const Picture dots = picture_of(scene_of(points));
    for (std::size_t i = 3; i < dots.rgba.size(); i += 4) alpha += dots.rgba[i];
    CHECK(alpha >= 2 * 4 * (255 / 4));
    CHECK(alpha <= 2 * 255);
    Mesh cube = shapes::cube();
    cube.positions[7].x = NAN;
    CHECK(covered(picture_of(scene_of(cube))) > 10000);
    for (Vec3& p : cube.positions) p *= 1e300;
    CHECK(covered(picture_of(scene_of(cube))) > 10000);
    CHECK(covered(picture_of(scene_of(shapes::quad_cube()))) > 10000);
}

TEST_CASE("lines and points without a colour are seen on white and on black", "[geometry]") {
    Scene scene;
    Mesh& mesh = scene.parts.emplace_back().mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0.5, 0, 1}};
    PictureSettings settings = seen_from({0, -1, 0});
    settings.point = 9;
    const auto contrast = [&](float ground) {
        settings.ground = {ground, ground, ground};
        const Picture picture = picture_of(scene, settings);
        float best = 0; // only fully covered pixels, not the background
        for (int y = 0; y < 100; ++y)
            for (int x = 0; x < 100; ++x) {
                const Pixel p = at(picture, x, y), there = at(picture, 0, 0);
                if (p.r == there.r && p.b == there.b) continue;
                const double light = 0.2126 * std::pow(p.r / 255.0, 2.2) +
                                     0.7152 * std::pow(p.g / 255.0, 2.2) +
                                     0.0722 * std::pow(p.b / 255.0, 2.2);
                const double a = std::max<double>(light, static_cast<double>(ground)) + 0.05,
                             b = std::min<double>(light, static_cast<double>(ground)) + 0.05;
                best = std::max(best, static_cast<float>(a / b));
            }
        return best;
    };
    for (const bool lines : {false, true}) {
        if (lines) mesh.lines = {0, 1, 1, 2, 2, 0};
        for (const bool white : {false, true}) { // with glTF's default material
            scene.materials.resize(white);
            mesh.primitives.assign(white, {0, {}, {}});
            for (const float ground : {0.0f, 0.01f, 0.9f, 1.0f}) CHECK(contrast(ground) > 3);
        }
    }
    scene.materials[0].base_colour[1] = scene.materials[0].base_colour[2] = 0;
    settings.ground = {};
    const Picture red = picture_of(scene, settings);
    std::size_t all = 0;
    for (std::size_t i = 0; i < red.rgba.size(); i += 4) {
        if (red.rgba[i + 3] == 0) continue;
        ++all;
        CHECK(red.rgba[i] > 150);
        CHECK(red.rgba[i + 1] == 0);
    }
    CHECK(all > 100);
}

TEST_CASE("numbers that differ by rounding alone have one colour, when that is asked for", "[geometry]") {
    Scene scene = square();
    scene.parts[0].mesh.attributes.push_back(
        {"heat", Domain::vertex, Role::generic, 1, false, std::vector<double>{2, 2 + 1e-7, 2, 2}});
    ColourRange wanted;
    CHECK(value_range(scene, "heat", wanted, {}).low < value_range(scene, "heat", wanted, {}).high);
    wanted.lost = 1e-6;
    const ValueRange one = value_range(scene, "heat", wanted, {});
    CHECK(one.low == one.high);
    CHECK(one.max > one.min);
    wanted.kind = ColourRange::Kind::all;
    CHECK(value_range(scene, "heat", wanted, {}).high == 2 + 1e-7);
}

TEST_CASE("what lies far off makes a crowd of the rest", "[geometry]") {
    Scene scene = scene_of(shapes::icosphere(3));
    PictureSettings s;
    CHECK_FALSE(crowd_of(scene, s));
    CHECK_FALSE(crowd_of(scene_of({}), s));
    Mesh stray; // one triangle
    stray.positions = {{5000, 0, 0}, {5001, 0, 0}, {5000, 1, 0}};
    stray.corners = {0, 1, 2};
    append(scene.parts[0].mesh, stray);
    const auto crowd = crowd_of(scene, s);
    REQUIRE(crowd);
    CHECK(crowd->pixels < 0.5);
    CHECK(length(crowd->middle) < 0.1);
    s.at = crowd->middle;
    s.zoom = crowd->zoom;
    CHECK(covered(picture_of(scene, s)) > 480U * 360U / 20);
    // An undrawn vertex does not make the scene small, and neither does an undrawn part.
    Scene alone = scene_of(shapes::icosphere(3));
    alone.parts[0].mesh.positions.push_back({1e9, 0, 0});
    CHECK_FALSE(crowd_of(alone, {}));
    s.shows = [](const Part& part) { return part.name == "part"; };
    Scene two = scene_of(shapes::icosphere(3));
    two.parts.push_back(scene_of(stray).parts[0]);
    two.parts[1].name = "stray";
    CHECK_FALSE(crowd_of(two, s));
}
