#include "support/catch.hpp"

#include "io/codec.hpp"
#include "io/outputs/outputs.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "support/run_stage.hpp"
#include "support/temporary.hpp"

#include <map>
#include <sstream>

using namespace facetmill;
using test::run_stage;
using test::scene_of;

namespace {

std::string measure_refusal(const std::string& options) {
    try {
        run_stage("measure", options, scene_of(shapes::cube()));
    } catch (const Error& e) {
        return e.what();
    }
    return "none";
}

} // namespace

TEST_CASE("measure reports the mass of a cube where the world has it", "[stages]") {
    Scene scene = scene_of(shapes::quad_cube());
    scene.parts[0].transform = {{{2, 0, 0, 5}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    const auto r = run_stage("measure", "{density: 3}", std::move(scene)).record.result;
    const Json& total = r["total"];
    CHECK(total["shell"]["area"] == 10);
    CHECK(total["shell"]["principal"]["moments"][0].get<double>() > 0);
    CHECK(total["solid"]["volume"].get<double>() == Approx(2));
    CHECK(total["solid"]["mass"].get<double>() == Approx(6));
    CHECK(total["solid"]["centroid"][0].get<double>() == Approx(6));
    CHECK(total["solid"]["inertia"][0][0].get<double>() == Approx(1)); // m/12 (1 + 1)
    CHECK(total["solid"]["principal"]["moments"][2].get<double>() == Approx(2.5));
    CHECK(r["parts"][0]["faces"]["kinds"]["quad"] == 6);
    CHECK(r["parts"][0]["edges"]["turn"]["maximum"].get<double>() == Approx(90));
    CHECK(r["parts"][0]["curvature"]["total_in_turns"].get<double>() == Approx(2));
}

TEST_CASE("an open part has no solid, nor has the whole then", "[stages]") {
    Scene scene = scene_of(shapes::cube());
    scene.parts.push_back(scene_of(shapes::grid(1, 1)).parts[0]);
    const auto r = run_stage("measure", "{}", std::move(scene)).record.result;
    CHECK(r["parts"][0]["solid"].is_object());
    CHECK(r["parts"][1]["solid"].is_null());
    CHECK(r["total"]["solid"].is_null());
    CHECK(r["total"]["shell"]["area"] == 7);
}

TEST_CASE("a solid inside out is warned of, an empty scene has nothing", "[stages]") {
    Mesh turned = shapes::cube();
    for (std::size_t c = 0; c < turned.corners.size(); c += 3)
        std::swap(turned.corners[c], turned.corners[c + 1]);
    const auto r = run_stage("measure", "{}", scene_of(turned));
    CHECK(r.record.warnings.at(0).id == "W-INSIDE-OUT");
    CHECK(run_stage("measure", "{}", {}).record.result["total"]["shell"]["centroid"].is_null());
    CHECK(run_stage("measure", "{}", scene_of({})).record.result["total"]["shell"]["area"] == 0);
}

TEST_CASE("what is measured is kept as attributes when asked for", "[stages]") {
    const auto plain = run_stage("measure", "{}", scene_of(shapes::uv_cube()));
    CHECK(plain.scene.parts[0].mesh.attributes.size() == shapes::uv_cube().attributes.size());
    CHECK_FALSE(plain.scene.parts[0].changed);
    const auto r = run_stage("measure", "{attributes: [area, gaussian_curvature, wall_thickness]}",
                             scene_of(shapes::uv_cube(), Unit::mm));
    const Mesh& mesh = r.scene.parts[0].mesh;
    CHECK(broken_invariants(mesh).empty());
    CHECK(mesh.find("area", Domain::face)->value(3, 0) == 0.5);
    CHECK(mesh.find("gaussian_curvature", Domain::vertex)->value(0, 0) > 0);
    CHECK(mesh.find("wall_thickness", Domain::face)->value(7, 0) == Approx(1));
    CHECK(r.scene.parts[0].changed);
    const Json& kept = r.record.result["parts"][0]["attributes"];
    REQUIRE(kept.size() == 3);
    CHECK(kept[2]["name"] == "wall_thickness");
    CHECK(kept[2]["unit"] == "mm");
    CHECK(kept[2]["missing"] == 0);
    CHECK(kept[2]["values"]["count"] == 12);
    const auto again = run_stage("measure", "{attributes: area}", r.scene);
    CHECK(again.scene.parts[0].mesh.attributes.size() == mesh.attributes.size());
}

TEST_CASE("where there is no number, attributes have the one that is given", "[stages]") {
    const auto r =
        run_stage("measure", "{attributes: wall_thickness, missing: -1}", scene_of(shapes::grid(2, 2)));
    CHECK(r.mesh().find("wall_thickness", Domain::face)->value(5, 0) == -1);
    const Json& kept = r.record.result["parts"][0]["attributes"][0];
    CHECK(kept["missing"] == 8);
    CHECK(kept["values"]["count"] == 0);
    const auto none = run_stage("measure", "{attributes: mean_curvature}", scene_of(shapes::grid(2, 2)));
    CHECK(std::isnan(none.mesh().find("mean_curvature", Domain::vertex)->value(0, 0)));
}

TEST_CASE("deviation is kept from another file, or from the scene as loaded", "[stages]") {
    test::TemporaryDirectory directory;
    const auto other = directory / "other.off";
    io::write_now(other, io::codec_for(other)->write(scene_of(shapes::icosphere(4)), {}).files.front().bytes);
    Mesh large = shapes::icosphere(4);
    for (Vec3& p : large.positions) p = p * 1.5;
    const auto r =
        run_stage("measure", "{attributes: deviation, with: " + other.string() + "}", scene_of(large));
    const auto* a = r.mesh().find("deviation", Domain::vertex);
    REQUIRE(a);
    for (std::size_t i = 0; i < a->size(); ++i) CHECK(a->value(i, 0) == Approx(0.5).epsilon(0.01));
    CHECK(r.state->record.inputs.size() == 1);
    Problems problems;
    for (const auto& [options, expected] : {std::pair{"deviation", true}, {"area", false}}) {
        const auto given =
            test::use_of(test::stage_for_test("measure"), test::options({{"attributes", options}}), problems);
        CHECK(given->compares_with_load() == expected);
    }
    using test::problems_of;
    CHECK(problems_of("measure", test::options({{"attributes", "thickness"}}))
              .ends_with("| 'thickness' is called 'wall_thickness' here"));
    CHECK(
        problems_of("measure", test::options({{"attributes", "aera"}})).ends_with("| did you mean 'area'?"));
    CHECK(problems_of("measure", test::options({{"with", "a.off"}})).find("needs the attribute deviation") !=
          std::string::npos);
    CHECK(problems_of("measure", test::options({{"missing", "1"}})).find("needs attributes") !=
          std::string::npos);
}

TEST_CASE("measure writes all as JSON and the faces as a table", "[stages]") {
    test::TemporaryDirectory directory;
    const auto json = (directory / "a.json").string(), csv = (directory / "a.csv").string();
    const auto r = run_stage("measure", "{path: [" + json + ", " + csv + "]}", scene_of(shapes::quad_cube()));
    r.state->outputs.commit();
    CHECK(Json::parse(test::get(json)) == r.record.result);
    const std::string table = test::get(csv);
    CHECK(table.starts_with(
        "part,face,corners,area,x,y,z,nx,ny,nz,off_plane,kind,planar,signed_area,ix_centroid,iy_centroid,ixy_"
        "centroid,"
        "ix_origin,iy_origin,ixy_origin,largest,smallest,major_x,major_y,major_z\npart,0,4,1,"));
    CHECK(std::count(table.begin(), table.end(), '\n') == 7);
}

TEST_CASE("the table of faces tells the kind, the signed area and the second moments", "[stages]") {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {3, 0, 0}, {0, 2, 0}, {0, 0, 1}, {2, 2, 1}, {2, 0, 1}, {0, 1, 1}};
    add_face(mesh, std::vector<Index>{0, 2, 1});    // clockwise
    add_face(mesh, std::vector<Index>{3, 4, 5, 6}); // crosses itself
    test::TemporaryDirectory directory;
    const auto csv = (directory / "a.csv").string();
    const auto r = run_stage("measure", "{path: " + csv + "}", scene_of(mesh));
    r.state->outputs.commit();
    std::istringstream table(test::get(csv));
    std::string line;
    std::vector<std::map<std::string, std::string>> rows;
    std::vector<std::string> names;
    while (std::getline(table, line)) {
        std::istringstream cells(line + ",");
        std::vector<std::string> row;
        for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
        if (names.empty()) {
            names = row;
            continue;
        }
        REQUIRE(row.size() == names.size());
        auto& named = rows.emplace_back();
        for (std::size_t i = 0; i < row.size(); ++i) named[names[i]] = row[i];
    }
    REQUIRE(rows.size() == 2);
    CHECK(rows[0]["kind"] == "triangle");
    CHECK(rows[0]["planar"] == "true");
    CHECK(rows[0]["area"] == "3");
    CHECK(rows[0]["signed_area"] == "-3");
    CHECK(std::stod(rows[0]["ix_origin"]) == Approx(2));
    CHECK(std::stod(rows[0]["ixy_origin"]) == Approx(1.5));
    CHECK(std::stod(rows[0]["ix_centroid"]) == Approx(24.0 / 36));
    CHECK(rows[1]["kind"] == "self_intersecting");
    CHECK(std::stod(rows[1]["area"]) ==
          Approx(4.0 / 3 + 1.0 / 3)); // both enclosed regions count, whatever their winding
    CHECK(std::stod(rows[1]["signed_area"]) == Approx(-5.0 / 3));
    CHECK(std::stod(rows[1]["x"]) == Approx((4.0 / 3 * (14.0 / 9) + 1.0 / 3 * (2.0 / 9)) / (5.0 / 3)));
    CHECK(std::stod(rows[1]["iy_origin"]) > 0);
    const Json& faces = r.record.result["parts"][0]["faces"];
    CHECK(faces["kinds"]["self_intersecting"] == 1);
    CHECK(faces["signed_area"][2].get<double>() == Approx(-3 - 1)); // the second has 2 clockwise, 1 not: -1
}

TEST_CASE("measure refuses what it cannot use", "[stages]") {
    CHECK(measure_refusal("{density: 0}").find("E-RANGE") != std::string::npos);
    CHECK(measure_refusal("{path: a.xls}").find("measure cannot write 'a.xls'") != std::string::npos);
}

TEST_CASE("measure says the main numbers on the terminal", "[stages]") {
    using Lines = std::vector<std::string>;
    Scene scene = scene_of(shapes::cube());
    scene.unit = Unit::mm;
    CHECK(run_stage("measure", "{}", scene).record.said ==
          Lines{"area 6 mm2, volume 1 mm3, centroid 0.5 0.5 0.5",
                "edges 1 to 1.41421 (mean 1.13807), angles 45 to 90 (mean 60)",
                "12 convex, 0 concave, 6 flat and 0 boundary edges, 12 feature edges"});
    scene.parts.push_back(scene_of(shapes::grid(2, 1)).parts[0]);
    scene.parts[1].name = "sheet";
    const auto said = run_stage("measure", "{density: 2}", scene).record.said;
    CHECK(said == Lines{"area 8 mm2, open (no volume), centroid 0.625 0.5 0.375",
                        "part: area 6 mm2, volume 1 mm3, mass 2, centroid 0.5 0.5 0.5",
                        "sheet: area 2 mm2, open (no volume), centroid 1 0.5 0"});
    CHECK(run_stage("measure", "{}", Scene{}).record.said == Lines{"nothing to measure"});
}
