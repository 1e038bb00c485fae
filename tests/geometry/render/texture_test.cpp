#include "geometry/render/texture.hpp"
#include "support/catch.hpp"

#include "geometry/render/render.hpp"
#include "geometry/render/srgb.hpp"
#include "support/run_stage.hpp"

#include <cmath>

using namespace facetmill;
using test::scene_of;

namespace {

using Rgba = std::array<std::uint8_t, 4>;

std::shared_ptr<const TextureImage> image_of(int width, int height, const std::vector<Rgba>& pixels,
                                             bool srgb = false, int max_side = 4096) {
    std::vector<std::uint8_t> bytes;
    for (const Rgba& p : pixels) bytes.insert(bytes.end(), p.begin(), p.end());
    return texture_image(width, height, std::move(bytes), srgb, max_side);
}

/// Red on the left, green on the right, blue below red, white below green.
Texture four_colours() {
    Texture t;
    t.image = image_of(2, 2, {{255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {255, 255, 255, 255}});
    return t;
}

/// A square from 0 to 1 in x and y, seen along -z by 100 x 100 pixels, with glTF texture coordinates: v
/// grows downwards.
Scene textured_square(float from = 0, float to = 1) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.corners = {0, 1, 2, 3};
    mesh.face_offsets = {0, 4};
    mesh.attributes.push_back({"TEXCOORD_0", Domain::wedge, Role::uv, 2, false,
                               std::vector<float>{from, to, to, to, to, from, from, from}});
    mesh.primitives.resize(1);
    mesh.primitives[0].material = 0;
    Scene scene = scene_of(mesh);
    scene.up = UpAxis::y;
    scene.materials.emplace_back();
    return scene;
}

PictureSettings front(MaterialLook look) {
    PictureSettings s;
    s.width = s.height = 100;
    s.from = Vec3{0, 0, 1};
    s.edges = EdgeLines::no;
    s.materials = std::make_shared<const ResolvedMaterials>(ResolvedMaterials{std::move(look)});
    return s;
}

Rgba rgba_at(const Picture& picture, int x, int y) {
    const std::uint8_t* p = &picture.rgba[4 * static_cast<std::size_t>(y * picture.width + x)];
    return {p[0], p[1], p[2], p[3]};
}

MaterialLook unlit(Texture texture) {
    MaterialLook look;
    look.base_texture = std::move(texture);
    look.unlit = true;
    return look;
}

} // namespace

TEST_CASE("bytes of sRGB go to linear light and back", "[geometry]") {
    CHECK(linear_of(0) == 0);
    CHECK(linear_of(255) == 1);
    for (int i = 0; i < 256; ++i) {
        const double x = i / 255.0;
        const double expected = x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
        CHECK(linear_of(static_cast<std::uint8_t>(i)) == Approx(expected).margin(1e-7));
        CHECK(srgb_of(linear_of(static_cast<std::uint8_t>(i))) == i);
    }
    CHECK(srgb_of(-1) == 0);
    CHECK(srgb_of(2) == 255);
    CHECK(srgb_of(NAN) == 0);
    CHECK(srgb_of(0.5f) == 188);
}

TEST_CASE("mip levels are means in linear light", "[geometry]") {
    const auto checks =
        image_of(2, 2, {{0, 0, 0, 255}, {255, 255, 255, 255}, {255, 255, 255, 255}, {0, 0, 0, 255}}, true);
    REQUIRE(checks->levels.size() == 2);
    CHECK(checks->levels[1].rgba == std::vector<std::uint8_t>{188, 188, 188, 255}); // half the light
    // Transparent pixels do not affect the colour.
    const auto leaf = image_of(2, 1, {{0, 255, 0, 255}, {255, 0, 0, 0}});
    CHECK(leaf->levels[1].rgba == std::vector<std::uint8_t>{0, 255, 0, 128});
    // An odd side: each pixel is weighted by its covered area.
    const auto odd = image_of(3, 1, {{0, 0, 0, 255}, {255, 0, 0, 255}, {255, 0, 0, 255}});
    CHECK(odd->levels[1].rgba[0] == 170);
    CHECK(image_of(8, 2, std::vector<Rgba>(16), false, 4)->levels.front().width == 4);
}

TEST_CASE("wrap says what is outside of a texture", "[geometry]") {
    Texture t = four_colours();
    t.nearest = true;
    const auto red_at = [&](double u) { return t.sampled(u, 0.25, {})[0] > 0.5f; };
    CHECK(red_at(0.25));
    CHECK_FALSE(red_at(0.75));
    CHECK(red_at(1.25));
    CHECK(red_at(-0.75));
    CHECK_FALSE(red_at(-0.25));
    t.wrap_u = TextureWrap::mirror;
    CHECK_FALSE(red_at(1.25));
    CHECK(red_at(1.75));
    CHECK(red_at(-0.25));
    t.wrap_u = TextureWrap::clamp;
    CHECK(red_at(-5));
    CHECK_FALSE(red_at(1.75));
    CHECK(t.sampled(NAN, HUGE_VAL, {})[3] == 1);
    CHECK(t.sampled(1e300, 0, {})[3] == 1);
}

TEST_CASE("neighbours are mixed, unless the sampler says nearest", "[geometry]") {
    Texture t = four_colours();
    CHECK(t.sampled(0.5, 0.25, {})[0] == Approx(0.5));
    CHECK(t.sampled(0.5, 0.25, {})[1] == Approx(0.5));
    t.nearest = true;
    CHECK(t.sampled(0.49, 0.25, {})[0] == 1);
    // From afar it is the mean of all pixels, with either filter.
    const Texel far = t.sampled(0.3, 0.3, {2, 0, 0, 2});
    CHECK(far[0] == Approx(0.5).margin(0.005));
    CHECK(far[2] == Approx(0.5).margin(0.005));
}

TEST_CASE("KHR_texture_transform moves coordinates", "[geometry]") {
    Texture t = four_colours();
    t.nearest = true;
    t.transform = {1, 0, 0.5, 0, 1, 0};
    CHECK(t.sampled(0.25, 0.25, {})[1] == 1); // green, half an image further
    t.transform = {0, 1, 0, -1, 0, 0};        // a quarter turn: (u, v) -> (v, -u)
    CHECK(t.sampled(0.25, 0.25, {})[2] == 1); // (0.25, -0.25), which is (0.25, 0.75): blue
}

TEST_CASE("a fine texture does not alias", "[geometry]") {
    std::vector<Rgba> checks;
    for (int y = 0; y < 512; ++y)
        for (int x = 0; x < 512; ++x)
            checks.push_back((x + y) % 2 ? Rgba{255, 255, 255, 255} : Rgba{0, 0, 0, 255});
    Texture t;
    t.image = image_of(512, 512, checks, true);
    const Picture picture = picture_of(textured_square(0, 3), front(unlit(t)));
    for (int y = 10; y < 90; y += 7)
        for (int x = 10; x < 90; x += 7) CHECK(std::abs(rgba_at(picture, x, y)[0] - 188) <= 2);
}

TEST_CASE("a texture is drawn upright and in its own colours", "[geometry]") {
    Texture t = four_colours();
    t.nearest = true;
    const Picture picture = picture_of(textured_square(), front(unlit(t)));
    CHECK(rgba_at(picture, 25, 25) == Rgba{255, 0, 0, 255});
    CHECK(rgba_at(picture, 75, 25) == Rgba{0, 255, 0, 255});
    CHECK(rgba_at(picture, 25, 75) == Rgba{0, 0, 255, 255});
    CHECK(rgba_at(picture, 75, 75) == Rgba{255, 255, 255, 255});
    // Factors and colours of vertices multiply it.
    Scene scene = textured_square();
    scene.parts[0].mesh.attributes.push_back(
        {"COLOR_0", Domain::wedge, Role::colour, 3, false, std::vector<float>(12, 0.5f)});
    MaterialLook half = unlit(t);
    half.base = {1, 0.5f, 1, 1};
    const Picture darker = picture_of(scene, front(half));
    CHECK(rgba_at(darker, 25, 25)[0] == 188);
    CHECK(rgba_at(darker, 75, 25)[1] == 137); // a quarter of the light
}

TEST_CASE("alpha masks and blends", "[geometry]") {
    Texture t;
    t.image = image_of(2, 1, {{255, 255, 255, 255}, {255, 255, 255, 64}});
    t.nearest = true;
    MaterialLook look = unlit(t);
    look.alpha = MaterialLook::Alpha::mask;
    const Picture mask = picture_of(textured_square(), front(look));
    CHECK(rgba_at(mask, 25, 50)[3] == 255);
    CHECK(rgba_at(mask, 75, 50)[3] == 0);
    look.alpha = MaterialLook::Alpha::opaque;
    CHECK(rgba_at(picture_of(textured_square(), front(look)), 75, 50)[3] == 255);
    look.alpha = MaterialLook::Alpha::blend;
    PictureSettings s = front(look);
    CHECK(rgba_at(picture_of(textured_square(), s), 75, 50)[3] == 64);
    s.ground = {0, 0, 0};
    CHECK(rgba_at(picture_of(textured_square(), s), 75, 50)[0] == srgb_of(64 / 255.0f));
}

TEST_CASE("what blends lies over each other by depth, in whatever order it comes", "[geometry]") {
    // Red over green over blue, each half transparent: 1/2 red, 1/4 green, 1/8 blue.
    Scene scene;
    scene.up = UpAxis::y;
    ResolvedMaterials looks(3);
    for (const std::size_t i : {1U, 0U, 2U}) {
        Scene one = textured_square();
        for (Vec3& p : one.parts[0].mesh.positions) p.z = -0.1 * static_cast<double>(i);
        one.parts[0].mesh.primitives[0].material = static_cast<Index>(i);
        scene.parts.push_back(one.parts[0]);
        looks[i].base = {i == 0 ? 1.0f : 0, i == 1 ? 1.0f : 0, i == 2 ? 1.0f : 0, 0.5f};
        looks[i].alpha = MaterialLook::Alpha::blend;
        looks[i].unlit = true;
    }
    scene.materials.resize(3);
    PictureSettings s = front({});
    s.materials = std::make_shared<const ResolvedMaterials>(looks);
    s.ground = {0, 0, 0};
    const Rgba pixel = rgba_at(picture_of(scene, s), 50, 50);
    CHECK(pixel[0] == srgb_of(0.5f));
    CHECK(pixel[1] == srgb_of(0.25f));
    CHECK(pixel[2] == srgb_of(0.125f));
}

TEST_CASE("normal textures bend the light, and turn with the surface", "[geometry]") {
    MaterialLook flat, bent;
    const auto middle = [](const MaterialLook& look, const Scene& scene) {
        return rgba_at(picture_of(scene, front(look)), 50, 50)[0];
    };
    const int plain = middle(flat, textured_square());
    bent.normal_texture.image = image_of(1, 1, {{60, 128, 230, 255}}); // towards -u: to the light's side
    CHECK(middle(bent, textured_square()) > plain + 3);
    bent.normal_texture.image = image_of(1, 1, {{196, 128, 230, 255}});
    CHECK(middle(bent, textured_square()) < plain - 20);
    bent.normal_texture.image = image_of(1, 1, {{128, 220, 220, 255}}); // up in the image: towards the light
    const int up = middle(bent, textured_square());
    CHECK(up > plain + 5);
    Scene mirrored =
        textured_square(1, 0); // upside down and mirrored: up in the image is down on the surface
    CHECK(middle(bent, mirrored) < plain - 20);
    bent.normal_texture.image = image_of(1, 1, {{128, 128, 255, 255}});
    CHECK(std::abs(middle(bent, textured_square()) - plain) <= 1);
}

TEST_CASE("emissive textures glow, occlusion textures darken the surroundings' light", "[geometry]") {
    Scene turned = textured_square(); // away from the light, so that only the surroundings light it
    PictureSettings s = front({});
    s.shading = Shading::one_sided;
    for (auto& mesh : {&turned.parts[0].mesh}) std::reverse(mesh->corners.begin(), mesh->corners.end());
    const auto middle = [&](const MaterialLook& look) {
        s.materials = std::make_shared<const ResolvedMaterials>(ResolvedMaterials{look});
        return rgba_at(picture_of(turned, s), 50, 50)[0];
    };
    CHECK(middle({}) == srgb_of(0.16f));
    MaterialLook look;
    look.occlusion_texture.image = image_of(1, 1, {{0, 0, 0, 255}});
    look.occlusion_strength = 0.5f;
    CHECK(middle(look) == srgb_of(0.08f));
    look.emissive = {0.5f, 0, 0};
    CHECK(middle(look) == srgb_of(0.58f));
    look.emissive_texture.image = image_of(1, 1, {{0, 255, 255, 255}}, true);
    CHECK(middle(look) == srgb_of(0.08f));
}
