#include "support/catch.hpp"

#include "mesh/shapes.hpp"
#include "support/run_stage.hpp"
#include "support/temporary.hpp"

using namespace facetmill;
using test::run_stage;
using test::scene_of;

namespace {

Json probed(const std::string& options, Scene scene) {
    return run_stage("probe", options, std::move(scene)).record.result;
}

std::string probe_refusal(const std::string& options, Scene scene = scene_of(shapes::cube())) {
    try {
        run_stage("probe", options, std::move(scene));
    } catch (const Error& e) {
        const auto& d = e.diagnostics().front();
        return d.id + " " + d.message;
    }
    return "none";
}

} // namespace

TEST_CASE("points are inside, outside or on, with the closest face", "[stages]") {
    const Json r =
        probed("[[0.5, 0.5, 0.75], [0.5, 0.5, 3], [1, 0.25, 0.25]]", scene_of(shapes::quad_cube()));
    CHECK((r["inside"] == 1 && r["outside"] == 1 && r["on"] == 1));
    CHECK(r["answers"][0]["side"] == "inside");
    CHECK(r["answers"][0]["winding"] == 1);
    CHECK(r["answers"][0]["distance"] == 0.25);
    CHECK(r["answers"][0]["closest"] == Json({0.5, 0.5, 1.0}));
    CHECK(r["answers"][1]["part"] == "part");
    CHECK(r["distance"]["maximum"] == 2);
}

TEST_CASE("one point, also as a one-liner has it, and a tolerance", "[stages]") {
    CHECK(probed("[0.5, 0.5, 1.1]", scene_of(shapes::cube()))["outside"] == 1);
    CHECK(probed("\"0.5,0.5,0.5\"", scene_of(shapes::cube()))["inside"] == 1);
    CHECK(probed("{points: [0.5, 0.5, 1.1], tolerance: 0.2}", scene_of(shapes::cube()))["on"] == 1);
}

TEST_CASE("an open surface is warned of", "[stages]") {
    const auto run = run_stage("probe", "[1, 1, 1]", scene_of(shapes::grid(2, 2)));
    CHECK(run.record.warnings.at(0).id == "W-PROBE-OPEN");
    CHECK(run.record.result["unknown"] == 1);
    CHECK(run.record.result["answers"][0]["distance"] == 1);
}

TEST_CASE("the vertices of one part are asked of the others", "[stages]") {
    Scene scene = scene_of(shapes::cube());
    scene.parts.push_back(scene_of(shapes::tetrahedron()).parts[0]);
    scene.parts[1].name = "tool";
    scene.parts[1].transform = {{{0.01, 0, 0, 0.5}, {0, 0.01, 0, 0.5}, {0, 0, 0.01, 0.5}}};
    const Json r = probed("{points_of: tool}", scene);
    CHECK((r["count"] == 4 && r["inside"] == 4));
    CHECK(probe_refusal("{points_of: nothing}", scene) == "E-PART 'points_of' selects no part of the scene");
}

TEST_CASE("segments and rays have hits in order, with part and face", "[stages]") {
    Scene scene = scene_of(shapes::quad_cube());
    scene.parts.push_back(scene.parts[0]);
    scene.parts[1].name = "second";
    scene.parts[1].transform.m[2][3] = 4;
    const Json segment = probed("{segments: [0.5, 0.5, -1, 0.5, 0.5, 9]}", scene)["answers"][0];
    REQUIRE(segment["hits"].size() == 4);
    CHECK(segment["hits"][0]["t"] == 0.1);
    CHECK(segment["hits"][0]["enters"] == true);
    CHECK(segment["hits"][2]["part"] == "second");
    CHECK(segment["hits"][2]["face"].get<int>() < 6);
    const Json ray = probed("{rays: [0.5, 0.5, -2, 0, 0, 5], hits: first}", scene);
    CHECK(ray["answers"][0]["hits"].size() == 1);
    CHECK(ray["answers"][0]["hits"][0]["t"] == 2); // a distance
    CHECK(ray["answers"][0]["direction"] == Json({0.0, 0.0, 5.0}));
    CHECK((ray["hit"] == 1 && ray["missed"] == 0));
}

TEST_CASE("a face alone tells the cases of a segment and a facet", "[stages]") {
    const Json r =
        probed("{face: 0, segments: [[0.5, 0.5, -1, 0.5, 0.5, 1], [2, 2, -1, 2, 2, 1], [0, 0, 1, 1, 0, 1], "
               "[0.5, 0.5, 0.5, 0.5, 0.5, 2], [0, 0, 0, 1, 0, 0]]}",
               scene_of(shapes::quad_cube()));
    CHECK(r["meetings"] ==
          Json({{"hit", 1}, {"outside facet", 1}, {"parallel", 1}, {"outside segment", 1}, {"in plane", 1}}));
    CHECK(r["answers"][0]["plane"]["t"] == 0.5);
    CHECK(probe_refusal("{face: 6, rays: [0, 0, 0, 1, 0, 0]}", scene_of(shapes::quad_cube())) ==
          "E-FACE face 6 does not exist; the last face is 5");
}

TEST_CASE("rays along an attribute measure walls", "[stages]") {
    const Json r = probed("{along: NORMAL, reverse: true}", scene_of(shapes::uv_cube()));
    CHECK(r["count"] == 8);
    CHECK(r["hit"] == 8); // the sum of normals at a corner is its diagonal, which ends in the corner opposite
    CHECK(r["answers"][0]["hits"][0]["t"].get<double>() == Approx(std::sqrt(3.0)));
    CHECK(probe_refusal("{along: flow}") ==
          "E-ATTRIBUTE part 'part' has no attribute 'flow' of three numbers at vertices");
}

TEST_CASE("normals that a part does not have are those of its faces, in the world", "[stages]") {
    // At a corner of the cube the faces meet in three directions of the same weight.
    const Json r = probed("{along: NORMAL, reverse: true}", scene_of(shapes::quad_cube()));
    CHECK(r["hit"] == 8);
    CHECK(r["answers"][0]["hits"][0]["t"].get<double>() == Approx(std::sqrt(3.0)));
    // A plate at 45 degrees, flattened by its node: its normal is not turned as its points are.
    Scene scene = scene_of(shapes::grid(1, 1));
    Mesh& plate = scene.parts[0].mesh;
    for (Vec3& p : plate.positions) p.z = p.x;
    plate.attributes.push_back(
        {"NORMAL", Domain::vertex, Role::normal, 3, false, std::vector<float>(12, 0.0F)});
    for (std::size_t v = 0; v < 4; ++v) {
        plate.attributes[0].set_value(v, 0, -std::sqrt(0.5));
        plate.attributes[0].set_value(v, 2, std::sqrt(0.5));
    }
    scene.parts[0].transform.m[2][2] = 0.5;
    Scene wall = scene_of(shapes::grid(20, 20)); // ahead, at z = 10
    for (Vec3& p : wall.parts[0].mesh.positions) p += Vec3{-10, -10, 10};
    scene.parts.push_back(wall.parts[0]);
    const auto reach = [&] {
        return probed("{along: NORMAL}", scene)["answers"][0]["hits"][0]["t"].get<double>();
    };
    CHECK(reach() == Approx(10 * std::sqrt(1.25))); // along (-0.5, 0, 1)
    scene.parts[0].mesh.drop("NORMAL", Domain::vertex);
    CHECK(reach() == Approx(10 * std::sqrt(1.25)));
}

TEST_CASE("several rows stand in one line too, and none loses its rest", "[stages]") {
    const auto count = [](const std::string& rows) {
        return probed(rows, scene_of(shapes::cube()))["count"];
    };
    CHECK(count("\"0,0,0; 1,1,1\"") == 2);
    CHECK(count("\"[[0, 0, 0], [1, 1, 1], [2, 2, 2]]\"") == 3);
    CHECK(count("\"[0,0,1]\"") == 1);
    for (const char* rows :
         {"\"0,0,0,1,1,1\"", "\"0,0\"", "\"0,0,0;1\"", "\"0,0,x\"", "\"0,0,0;\"", "\"0,,0\""})
        CHECK(probe_refusal(rows).starts_with("E-TYPE expected rows of 3 numbers"));
    CHECK(probe_refusal("{rays: [[0, 0, 0, 0, 0, 1], [0, 0, 1, 0, 0, 0]]}") ==
          "E-RAY ray 1 has no direction");
}

TEST_CASE("probes are read from a table and answers written as one", "[stages]") {
    test::TemporaryDirectory directory;
    const auto in = (directory / "in.csv").string(), out = (directory / "out.csv").string();
    test::put(in, "x,y,z\n0.5,0.5,0.5\n0.5,0.5,2\n");
    const auto run = run_stage("probe", "{points: " + in + ", path: " + out + ", max_answers: 1}",
                               scene_of(shapes::cube()));
    run.state->outputs.commit();
    CHECK(run.record.result["answers"].size() == 1);
    CHECK(run.state->record.inputs.at(0).path == in);
    const io::Bytes other(1);
    CHECK(test::failure([&] { run.state->outputs.add(in, other); }).find("would overwrite an input") !=
          std::string::npos);
    const std::string table = test::get(out);
    CHECK(table.starts_with(
        "x,y,z,side,winding,distance,closest_x,closest_y,closest_z,part,face\n0.5,0.5,0.5,inside,1,0.5,"));
    CHECK(table.find("0.5,0.5,2,outside,0,1,0.5,0.5,1,part,") != std::string::npos);
    const auto lines = (directory / "lines.csv").string();
    run_stage("probe", "{rays: [0.5, 0.25, -1, 0, 0, 1], path: " + lines + "}", scene_of(shapes::quad_cube()))
        .state->outputs.commit();
    CHECK(test::get(lines).starts_with("line,hit,t,x,y,z,enters,part,face\n0,0,1,0.5,0.25,0,1,part,"));
}

TEST_CASE("probe refuses what it cannot use", "[stages]") {
    CHECK(probe_refusal("{}") ==
          "E-MISSING probe: one of points, points_of, segments, rays, along is needed");
    CHECK(probe_refusal("[1, 2]") == "E-TYPE expected rows of 3 numbers or a .csv file, found a list of 2");
    CHECK(probe_refusal("[1, 2, x]") == "E-TYPE expected rows of 3 numbers or a .csv file, found 'x'");
    CHECK(probe_refusal("{points: [0, 0, 0], face: 1}") == "E-CONFLICT probe: 'face' needs segments or rays");
    CHECK(probe_refusal("{points: [0, 0, 0], path: a.txt}") == "E-FORMAT probe cannot write 'a.txt'");
    CHECK(probe_refusal("{points: [0, 0, 0], reverse: true}") == "E-CONFLICT probe: 'reverse' needs along");
    CHECK(probe_refusal("{points: [0, 0, 0], hits: first}") ==
          "E-CONFLICT probe: 'hits' needs segments or rays");
    CHECK(probe_refusal("{points_of: part}") ==
          "E-PART 'points_of' selects all parts, so no part is left as the surface");
    CHECK(probe_refusal("none.csv").starts_with("E-FILE"));
}

TEST_CASE("probe says the first answers on the terminal", "[stages]") {
    using Lines = std::vector<std::string>;
    const Scene scene = scene_of(shapes::cube());
    const auto said = [&](const char* options) { return run_stage("probe", options, scene).record.said; };
    CHECK(said("{points: [[0.5, 0.5, 2], [0.5, 0.25, 0.5]]}") ==
          Lines{"1 inside, 1 outside; distance 0.25 to 1 (mean 0.625)",
                "0.5 0.5 2: outside, 1 from 0.5 0.5 1 of part face 2",
                "0.5 0.25 0.5: inside, 0.25 from 0.5 0 0.5 of part face 4"});
    CHECK(said("{rays: [[0.25, 0.5, 9, 0, 0, -1], [5, 5, 5, 1, 0, 0]]}") ==
          Lines{"1 hit, 1 missed", "0.25 0.5 9 along 0 0 -1: 2 hits, t 8 at 0.25 0.5 1 on part face 3",
                "5 5 5 along 1 0 0: no hit"});
    CHECK(said("{segments: [0, 0, 5, 1, 0, 5], face: 0}") == Lines{"1 parallel", "0 0 5 to 1 0 5: parallel"});
}
