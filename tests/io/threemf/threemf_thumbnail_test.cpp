#include "io/images/pixels.hpp"
#include "io/threemf/threemf.hpp"
#include "io/threemf/zip.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/run_stage.hpp"

using namespace facetmill;

TEST_CASE("3MF files have a thumbnail", "[io][bed]") {
    const auto picture = [](const Scene& scene) {
        const io::Written written = io::threemf::write(scene, {.title = "a"});
        io::threemf::Archive archive(written.files.at(0).bytes, "a.3mf");
        const auto relations = archive.file("/_rels/.rels");
        REQUIRE(relations);
        CHECK(io::as_text(*relations).find("/Metadata/thumbnail.png") != std::string_view::npos);
        const auto png = archive.file("/Metadata/thumbnail.png");
        REQUIRE(png);
        auto pixels = io::decoded_image(*png);
        REQUIRE(pixels);
        return *pixels;
    };
    const io::Pixels ball = picture(test::scene_of(shapes::icosphere(3)));
    CHECK(ball.width == 256);
    CHECK(ball.height == 256);
    const auto grey = [&](std::size_t x, std::size_t y) { return ball.rgba[4 * (y * 256 + x)]; };
    CHECK(grey(0, 0) == 255); // white around the ball
    CHECK(grey(128, 128) < 250);
    CHECK(picture(Scene()).width == 256); // nothing to show
}
