// KHR_mesh_quantization and meshopt compression: values read back are within half a step of the written
// values, wherever the mesh is.
#include "base/math/portable_math.hpp"
#include "base/math/random.hpp"
#include "io/codec.hpp"
#include "io/gltf/document/accessor.hpp"
#include "io/gltf/document/shorten.hpp"
#include "io/gltf/numbers/compress.hpp"
#include "io/gltf/numbers/quantise.hpp"
#include "io/images/png.hpp"
#include "io/read_back.hpp"
#include "mesh/separate_wedges.hpp"
#include "mesh/shapes.hpp"
#include "mesh/transform.hpp"
#include "support/catch.hpp"
#include "support/gltf.hpp"
#include "support/run_stage.hpp"

using namespace facetmill;

namespace {

io::WriteSettings with_bits(int position, int normal, int uv, int colour, int weights) {
    io::WriteSettings settings;
    settings.quantize = {.on = true,
                         .position_bits = position,
                         .normal_bits = normal,
                         .uv_bits = uv,
                         .colour_bits = colour,
                         .weight_bits = weights};
    settings.order = io::TriangleOrder::keep; // vertices are compared by their numbers
    return settings;
}

void add(Mesh& mesh, const char* name, Role role, int components, std::vector<float> numbers) {
    mesh.attributes.push_back({name, Domain::vertex, role, components, false, std::move(numbers)});
}

/// A torus with every kind of attribute, and a number for each vertex that nothing rounds.
Mesh dressed(std::uint64_t seed) {
    Mesh mesh = shapes::torus(16, 12);
    std::uint64_t drawn = 0;
    const auto number = [&](double low, double high) {
        return static_cast<float>(low + (high - low) * uniform(hashed(seed, drawn++)));
    };
    std::vector<float> normals, tangents, uv, colours, weights, deltas, ids;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
        const Vec3 n = normalised({number(-1, 1), number(-1, 1), number(-1, 1)});
        const Vec3 t = normalised({number(-1, 1), number(-1, 1), number(-1, 1)});
        for (std::size_t c = 0; c < 3; ++c) {
            normals.push_back(static_cast<float>(n[c]));
            tangents.push_back(static_cast<float>(t[c]));
            colours.push_back(number(0, 1));
            deltas.push_back(number(-0.5, 0.5));
        }
        tangents.push_back(v % 2 == 0 ? 1.0F : -1.0F);
        for (int c = 0; c < 2; ++c) uv.push_back(number(0, 1));
        const float w = number(0.34, 1); // the largest weight comes first
        weights.insert(weights.end(), {w, (1 - w) / 2, (1 - w) / 2, 0});
        ids.push_back(static_cast<float>(v));
    }
    add(mesh, "NORMAL", Role::normal, 3, std::move(normals));
    add(mesh, "TANGENT", Role::tangent, 4, std::move(tangents));
    add(mesh, "TEXCOORD_0", Role::uv, 2, std::move(uv));
    add(mesh, "COLOR_0", Role::colour, 3, std::move(colours));
    add(mesh, "WEIGHTS_0", Role::weights, 4, std::move(weights));
    mesh.attributes.push_back({"JOINTS_0", Domain::vertex, Role::joints, 4, false,
                               std::vector<std::uint16_t>(4 * mesh.vertex_count(), 1)});
    add(mesh, "TARGET_0_POSITION", Role::morph_vector, 3, std::move(deltas));
    add(mesh, "_id", Role::generic, 1, std::move(ids));
    return mesh;
}

/// The largest difference between an attribute's numbers and the given vertex numbers.
double difference(const Mesh& mesh, const Mesh& given, const char* name, double scale = 1) {
    const Attribute& here = *mesh.find(name, Domain::wedge);
    const Attribute& there = *given.find(name, Domain::vertex);
    const Attribute& ids = *mesh.find("_id", Domain::wedge);
    double most = 0;
    for (std::size_t w = 0; w < mesh.wedge_count(); ++w)
        for (int c = 0; c < here.components; ++c)
            most = std::max(most, std::abs(here.value(w, c) * scale -
                                           there.value(static_cast<std::size_t>(ids.value(w, 0)), c)));
    return most;
}

/// The largest difference of a coordinate in the world.
double moved(const Part& part, const Part& given) {
    const Attribute& ids = *part.mesh.find("_id", Domain::wedge);
    double most = 0;
    for (Index w = 0; w < part.mesh.wedge_count(); ++w) {
        const Vec3 is = part.transform.point(part.mesh.positions[part.mesh.vertex_of_wedge(w)]);
        const auto id = static_cast<std::size_t>(ids.value(w, 0));
        const Vec3 was = given.transform.point(given.mesh.positions[id]);
        for (std::size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(is[c] - was[c]));
    }
    return most;
}

double step_of(const Mesh& mesh, int bits) {
    const Vec3 e = mesh.bounds().extent();
    return std::max({e.x, e.y, e.z}) / ((1 << bits) - 1);
}

Json json_of(const io::Written& written) { return Json::parse(test::json_of(written.files.at(0).bytes)); }

/// A wedge for each corner.
void separate_corners(Mesh& mesh) {
    std::vector<Index> own(mesh.corners.size());
    for (Index c = 0; c < own.size(); ++c) own[c] = c;
    separate_wedges(mesh, own);
}

/// Reads a document with a torus at a node, after changing it.
template <class Change>
Scene torus_in(Change&& change) {
    const Scene scene = test::scene_in_metres(dressed(1));
    io::WriteSettings settings;
    settings.order = io::TriangleOrder::keep; // vertices are compared by their numbers
    const Scene plain = test::again(scene, settings);
    Json json = Json::parse(plain.documents.at(0)->json);
    change(json);
    // As a GLB again, with the bytes that it had.
    const auto& bytes = plain.documents[0]->buffers.at(0);
    json["buffers"][0]["uri"] = "data:application/octet-stream;base64," + io::base64(bytes);
    return test::read_text(json.dump());
}

} // namespace

TEST_CASE("quantized attributes are within half a step", "[io]") {
    const std::vector<std::array<int, 5>> cases = {
        {14, 8, 12, 8, 8}, {8, 2, 1, 1, 8}, {16, 16, 16, 16, 16}, {5, 12, 10, 10, 9}};
    for (const bool meshopt : {false, true})
        for (const auto& [position, normal, uv, colour, weights] : cases) {
            INFO(meshopt << " " << position << " " << normal);
            io::WriteSettings settings = with_bits(position, normal, uv, colour, weights);
            settings.meshopt = {.on = meshopt, .extension = {}, .filters = false};
            Scene scene = test::scene_in_metres(dressed(static_cast<std::uint64_t>(position)));
            scene.parts[0].transform.m[1][3] = 3;
            const Part part = test::again(scene, settings).parts.at(0);
            const Mesh& given = scene.parts[0].mesh;
            constexpr double slack = 1 + 1e-6; // of float32's rounding of a step
            const double step = step_of(given, position);
            CHECK(moved(part, scene.parts[0]) <= step / 2 * slack);
            CHECK(difference(part.mesh, given, "TARGET_0_POSITION", step) <= step / 2 * slack);
            const auto half = [](int bits, int stored) { // of a step of the bits, and of the integers
                const double steps = (1 << bits) - 1, most = (1 << stored) - 1;
                return 0.5 / steps + (bits == stored ? 0 : 0.5 / most) + 1e-7;
            };
            CHECK(difference(part.mesh, given, "NORMAL") <= half(normal - 1, normal <= 8 ? 7 : 15));
            CHECK(difference(part.mesh, given, "TANGENT") <= half(normal - 1, normal <= 8 ? 7 : 15));
            CHECK(difference(part.mesh, given, "TEXCOORD_0") <= half(uv, uv <= 8 ? 8 : 16));
            CHECK(difference(part.mesh, given, "COLOR_0") <= half(colour, colour <= 8 ? 8 : 16));
            CHECK(difference(part.mesh, given, "_id") == 0);
            const Attribute& stored = *part.mesh.find("WEIGHTS_0", Domain::wedge);
            CHECK(std::string(stored.type()) == (weights <= 8 ? "uint8" : "uint16"));
            const double whole = weights <= 8 ? 255 : 65535;
            CHECK(difference(part.mesh, given, "WEIGHTS_0") <=
                  1 / whole + 1e-7); // shares are rounded together
            for (std::size_t w = 0; w < stored.size(); ++w) {
                double sum = 0;
                for (int c = 0; c < 4; ++c) sum += stored.value(w, c) * whole;
                REQUIRE(std::abs(sum - whole) < 1e-6);
            }
        }
}

TEST_CASE("meshopt's filters keep attributes within half a step", "[io]") {
    for (const bool quantize : {true, false}) {
        INFO(quantize);
        io::WriteSettings settings = with_bits(14, 8, 12, 8, 8);
        settings.quantize.on = quantize;
        settings.meshopt.on = true;
        const Scene scene = test::scene_in_metres(dressed(5));
        const io::Written written = test::written(scene, "glb", settings);
        CHECK(written.warnings.empty());
        const Scene again = test::read_bytes(written.files[0].bytes, "glb");
        const Mesh &mesh = again.parts.at(0).mesh, &given = scene.parts[0].mesh;
        const double step = step_of(given, 14), float_step = 1.0 / (1 << 23);
        CHECK(moved(again.parts[0], scene.parts[0]) <= (quantize ? step / 2 * (1 + 1e-6) : 2 * float_step));
        CHECK(difference(mesh, given, "_id") == 0);
        // Half a step h = 0.5 / 127 in two coordinates is up to h sqrt(6) on the octahedron. Its faces are 1
        // / sqrt(3) from the centre, so this is h sqrt(18) on the sphere. Rounding to int8 adds half a step.
        const double of_octahedron = (std::sqrt(18.0) + 1) * 0.5 / 127;
        for (const char* name : {"NORMAL", "TANGENT"})
            CHECK(difference(mesh, given, name) <= (quantize ? of_octahedron : 2 * float_step));
        CHECK(difference(mesh, given, "TEXCOORD_0") <= (quantize ? 0.5 / 4095 + 0.5 / 65535 : float_step));
        const Json json = json_of(written);
        const Json required = json["extensionsRequired"];
        CHECK(std::count(required.begin(), required.end(), "EXT_meshopt_compression") == 1);
        CHECK(std::count(required.begin(), required.end(), "KHR_mesh_quantization") == (quantize ? 1 : 0));
        REQUIRE(json["buffers"].size() == 2);
        CHECK(json["buffers"][1]["extensions"]["EXT_meshopt_compression"]["fallback"] == true);
        CHECK(json["buffers"][1]["byteLength"].get<std::size_t>() >
              json["buffers"][0]["byteLength"].get<std::size_t>());
    }
}

TEST_CASE("a node that something depends on gets the grid's transform below it", "[io]") {
    io::WriteSettings settings = with_bits(14, 8, 12, 8, 8);
    const auto nodes = [&](auto&& change) {
        const Scene scene = torus_in(change);
        const io::Written written = test::written(scene, "glb", settings);
        const Scene again = test::read_bytes(written.files[0].bytes, "glb");
        CHECK(again.parts.at(0).name == scene.parts.at(0).name);
        CHECK(moved(again.parts[0], scene.parts[0]) <=
              step_of(scene.parts[0].mesh, 14) * greatest_stretch(scene.parts[0].transform));
        io::read_back(io::Input::of("a.glb", written.files[0].bytes), *io::codec_named("glb"), scene,
                      settings);
        return json_of(written);
    };
    // A single part uses the grid, whatever its transform.
    CHECK(nodes([](Json& j) { j["nodes"][0]["rotation"] = {0.6, 0, 0, 0.8}; })["nodes"].size() == 1);
    CHECK(nodes([](Json& j) {
              j["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 3, 0, 4, 5, 6, 1};
          })["nodes"]
              .size() == 1);
    const Json parent = nodes([](Json& j) {
        j["nodes"][0]["translation"] = {1, 2, 3};
        j["nodes"][0]["children"] = {1};
        j["nodes"].push_back({{"name", "child"}});
    });
    CHECK(parent["nodes"][0]["translation"] == Json::array({1, 2, 3}));
    CHECK(parent["nodes"][0]["children"] == Json::array({1, 2}));
    CHECK_FALSE(parent["nodes"][0].contains("mesh"));
    const Json animated = nodes([](Json& j) {
        const Json& primitive = j["meshes"][0]["primitives"][0];
        const Json positions = primitive["attributes"]["POSITION"], id = primitive["attributes"]["_id"];
        j["nodes"][0]["weights"] = {0.5};
        j["animations"] = {
            {{"channels",
              {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}},
               {{"sampler", 1}, {"target", {{"node", 0}, {"path", "weights"}}}}}},
             {"samplers", {{{"input", id}, {"output", positions}}, {{"input", id}, {"output", id}}}}}};
    });
    CHECK(animated["animations"][0]["channels"][0]["target"]["node"] == 0);
    CHECK(animated["animations"][0]["channels"][1]["target"]["node"] == 1);
    CHECK(animated["nodes"][1]["weights"] == Json::array({0.5}));
    CHECK_FALSE(animated["nodes"][0].contains("weights"));
}

TEST_CASE("positions without a node for their grid stay float32, and that is said", "[io]") {
    io::WriteSettings settings = with_bits(14, 8, 12, 8, 8);
    const auto type = [&](auto&& change) {
        const io::Written written = test::written(torus_in(change), "glb", settings);
        const bool said =
            std::any_of(written.changes.begin(), written.changes.end(), [](const AttributeChange& c) {
                return c.attribute == "POSITION" && c.why.rfind("stays float32", 0) == 0;
            });
        const Json json = json_of(written);
        const Json& primitive = json["meshes"][0]["primitives"][0];
        const Json& positions = json["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
        const Json& normals = json["accessors"][primitive["attributes"]["NORMAL"].get<std::size_t>()];
        CHECK(normals["componentType"] == 5120);
        CHECK(said == (positions["componentType"] == 5126));
        return positions["componentType"].get<int>();
    };
    CHECK(type([](Json&) {}) == 5123);
    CHECK(type([](Json& j) {
              j["skins"] = {{{"joints", {1}}}};
              j["nodes"][0]["skin"] = 0;
              j["nodes"].push_back(Json::object());
          }) == 5126);
}

TEST_CASE("texture coordinates beyond the unit square are signed, or stay float32", "[io]") {
    for (const auto& [low, high, type] :
         {std::tuple(0.0F, 1.0F, "uint16"), {-0.5F, 1.0F, "int16"}, {0.0F, 1.5F, "float32"}}) {
        Scene scene = test::scene_in_metres(dressed(2));
        auto& uv = std::get<std::vector<float>>(scene.parts[0].mesh.find("TEXCOORD_0", Domain::vertex)->data);
        uv[0] = low;
        uv[1] = high;
        const Mesh mesh = test::again(scene, with_bits(14, 8, 12, 8, 8)).parts.at(0).mesh;
        CHECK(std::string(mesh.find("TEXCOORD_0", Domain::wedge)->type()) == type);
        CHECK(difference(mesh, scene.parts[0].mesh, "TEXCOORD_0") <= 0.5 / 4095 + 0.5 / 32767);
    }
}

TEST_CASE("a grid far from the origin loses nothing to float32", "[io]") {
    Scene scene = test::scene_in_metres(dressed(3));
    for (Vec3& p : scene.parts[0].mesh.positions) p = p * 0.1 + Vec3{455000.123, 5427000.456, 80};
    const Part part = test::again(scene, with_bits(14, 8, 12, 8, 8)).parts.at(0);
    CHECK(moved(part, scene.parts[0]) <=
          step_of(scene.parts[0].mesh, 14) / 2 + 2e-9); // the rounding of doubles at these coordinates
}

TEST_CASE("what is quantized or compressed already stays as it is", "[io]") {
    for (const auto extension : {io::MeshoptSettings::Extension::ext, io::MeshoptSettings::Extension::khr}) {
        io::WriteSettings settings = with_bits(14, 8, 12, 8, 8);
        settings.meshopt = {.on = true, .extension = extension, .filters = true};
        const auto first = test::written(test::scene_in_metres(dressed(4)), "glb", settings).files[0].bytes;
        const io::Written second = test::written(test::read_bytes(first, "glb"), "glb", settings);
        CHECK(second.files[0].bytes == first);
        settings.meshopt.on = false;
        const io::Written plainly = test::written(test::read_bytes(first, "glb"), "glb", settings);
        REQUIRE(plainly.warnings.size() == 1);
        CHECK(plainly.warnings[0].id == "W-MESHOPT");
        const Json json = json_of(plainly);
        CHECK(json["extensionsRequired"] == Json::array({"KHR_mesh_quantization"}));
        CHECK(json["buffers"].size() == 1);
    }
}

TEST_CASE("rotations and paths of animations are compressed within 16 bits", "[io]") {
    std::vector<float> times, turns, places;
    for (int i = 0; i < 64; ++i) {
        const double angle = 0.05 * i;
        times.push_back(static_cast<float>(i) / 24);
        for (const double x : {0.0, sine(angle), 0.0, cosine(angle)}) turns.push_back(static_cast<float>(x));
        for (const double x : {angle, 100 + angle, sine(angle)}) places.push_back(static_cast<float>(x));
    }
    Scene scene = torus_in([&](Json& j) {
        const auto add_numbers = [&](const std::vector<float>& numbers, const char* type, int width) {
            const auto bytes = std::as_bytes(std::span(numbers));
            const std::size_t buffer = j["buffers"].size();
            j["buffers"].push_back({{"byteLength", bytes.size()},
                                    {"uri", "data:application/octet-stream;base64," + io::base64(bytes)}});
            j["bufferViews"].push_back({{"buffer", buffer}, {"byteLength", bytes.size()}});
            Json accessor = {{"bufferView", j["bufferViews"].size() - 1},
                             {"componentType", 5126},
                             {"count", numbers.size() / static_cast<std::size_t>(width)},
                             {"type", type}};
            if (width == 1) {
                accessor["min"] = {times.front()};
                accessor["max"] = {times.back()};
            }
            j["accessors"].push_back(std::move(accessor));
            return j["accessors"].size() - 1;
        };
        const auto input = add_numbers(times, "SCALAR", 1), rotation = add_numbers(turns, "VEC4", 4),
                   translation = add_numbers(places, "VEC3", 3);
        j["animations"] = {
            {{"channels",
              {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}},
               {{"sampler", 1}, {"target", {{"node", 0}, {"path", "translation"}}}}}},
             {"samplers",
              {{{"input", input}, {"output", rotation}}, {{"input", input}, {"output", translation}}}}}};
    });
    io::WriteSettings settings = with_bits(16, 8, 12, 8, 8);
    settings.meshopt.on = true;
    const Scene again = test::again(scene, settings);
    const Json json = Json::parse(again.documents.at(0)->json);
    io::gltf::Source source(json, again.documents[0]->buffers);
    const auto numbers = [&](std::size_t sampler, const char* which) {
        const io::gltf::JsonCursor place(json["animations"][0]["samplers"][sampler][which], "");
        const io::gltf::Accessor a = io::gltf::accessor(source, place);
        return Attribute{"", {}, {}, a.components, a.normalised, io::gltf::decode(source, a)};
    };
    CHECK(std::get<std::vector<float>>(numbers(0, "input").data) == times);
    const Attribute rotation = numbers(0, "output"), translation = numbers(1, "output");
    CHECK(std::string(rotation.type()) == "int16");
    for (std::size_t i = 0; i < times.size(); ++i) {
        double same = 0, norm = 0, given = 0;
        for (int c = 0; c < 4; ++c) {
            same += rotation.value(i, c) * turns[4 * i + static_cast<std::size_t>(c)];
            norm += rotation.value(i, c) * rotation.value(i, c);
            given += double{turns[4 * i + static_cast<std::size_t>(c)]} *
                     turns[4 * i + static_cast<std::size_t>(c)];
        }
        // Either sign is the same rotation; the cosine of half the angle between is 1 - angle^2 / 8.
        CHECK(std::abs(same) > (1 - 2e-9) * std::sqrt(norm * given));
        for (int c = 0; c < 3; ++c)
            CHECK(std::abs(translation.value(i, c) - places[3 * i + static_cast<std::size_t>(c)]) <=
                  3.2 / 65536); // of the greatest extent, 64 * 0.05, at the bits of positions
    }
}

TEST_CASE("morph weights that round to some from 0 to 1 are stored as 65535ths", "[io]") {
    Mesh mesh = shapes::cube();
    mesh.attributes.push_back({"TARGET_0_POSITION", Domain::wedge, Role::morph_vector, 3, false,
                               std::vector<float>(3 * mesh.vertex_count(), 0.25F)});
    const auto stored = [&](float least) {
        std::vector<float> numbers;
        for (int i = 0; i < 20; ++i) numbers.push_back(static_cast<float>(i));
        for (int i = 0; i < 20; ++i) numbers.push_back(i == 7 ? least : static_cast<float>(i * i % 20) / 19);
        Scene scene = test::again(test::scene_in_metres(mesh));
        auto document = std::make_shared<Document>(*scene.documents.at(0));
        Json json = Json::parse(document->json);
        const auto bytes = std::as_bytes(std::span(numbers));
        document->buffers.emplace_back(bytes.begin(), bytes.end());
        const std::size_t view = json["bufferViews"].size(), accessor = json["accessors"].size();
        json["buffers"].push_back({{"byteLength", bytes.size()}});
        for (const int offset : {0, 80}) {
            json["bufferViews"].push_back({{"buffer", 1}, {"byteOffset", offset}, {"byteLength", 80}});
            json["accessors"].push_back({{"bufferView", view + (offset > 0)},
                                         {"componentType", 5126},
                                         {"count", 20},
                                         {"type", "SCALAR"}});
        }
        json["accessors"][accessor]["min"] = {0};
        json["accessors"][accessor]["max"] = {19};
        json["animations"] = {
            {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}},
             {"samplers", {{{"input", accessor}, {"output", accessor + 1}}}}}};
        document->json = json.dump();
        scene.documents[0] = document;
        io::WriteSettings settings;
        settings.meshopt.on = true;
        const Scene back = test::again(scene, settings);
        const Json written = Json::parse(back.documents.at(0)->json);
        io::gltf::Source source(written, back.documents[0]->buffers);
        const io::gltf::JsonCursor place(written["animations"][0]["samplers"][0]["output"], "");
        const io::gltf::Accessor a = io::gltf::accessor(source, place);
        const Attribute weights{"", {}, {}, a.components, a.normalised, io::gltf::decode(source, a)};
        for (std::size_t i = 0; i < 20; ++i)
            CHECK(std::abs(weights.value(i, 0) - numbers[20 + i]) <= 0.5 / 65535 + 1e-7);
        return std::string(weights.type());
    };
    CHECK(stored(0) == "uint16");
    CHECK(stored(-1.5e-7F) == "uint16"); // as exporters round
    CHECK(stored(-0.125F) == "float32");
}

TEST_CASE("KHR_meshopt_compression is read, colours and streams of version 1, too", "[io]") {
    // Two colours of 8 bits: luma, two chrominances, alpha below a bit.
    const std::vector<std::uint8_t> coded = {100, 10, 246, 0x80 | 0x7F, 50, 0, 0, 0x80 | 0x00};
    io::Bytes bytes =
        io::gltf::encode_meshopt(std::as_bytes(std::span(coded)), {"ATTRIBUTES", "COLOR", 4, 2}, 0);
    const auto document = [&] {
        return Json{{"bufferViews",
                     {{{"buffer", 1},
                       {"byteLength", 8},
                       {"extensions",
                        {{"KHR_meshopt_compression",
                          {{"buffer", 0},
                           {"byteLength", bytes.size()},
                           {"byteStride", 4},
                           {"mode", "ATTRIBUTES"},
                           {"filter", "COLOR"},
                           {"count", 2}}}}}}}}};
    };
    const Json json = document();
    const std::vector<io::Bytes> buffers{bytes, {}};
    io::gltf::Source source(json, buffers);
    const auto view = source.view(std::size_t{0});
    const std::vector<int> wanted = {120, 90, 100, 255, 50, 50, 50, 0};
    for (std::size_t i = 0; i < 8; ++i) CHECK(std::to_integer<int>(view[i]) == wanted[i]);

    bytes = io::gltf::encode_meshopt(std::as_bytes(std::span(coded)), {"ATTRIBUTES", "COLOR", 4, 2}, 1);
    const Json json_1 = document();
    std::vector<io::Bytes> newer{bytes, {}};
    io::gltf::Source source_1(json_1, newer);
    const auto view_1 = source_1.view(std::size_t{0});
    for (std::size_t i = 0; i < 8; ++i) CHECK(std::to_integer<int>(view_1[i]) == wanted[i]);
    newer[0][1] = std::byte{0x55};
    io::gltf::Source damaged(json_1, newer);
    CHECK_THROWS_AS(damaged.view(std::size_t{0}), Error);
}

TEST_CASE("a compressed view is read by all of its accessors, those of the whole and those of a part",
          "[io]") {
    std::vector<std::uint32_t> numbers(1000);
    for (std::uint32_t i = 0; i < numbers.size(); ++i) numbers[i] = i * i % 997;
    for (const int version : {0, 1}) {
        const io::Bytes bytes = io::gltf::encode_meshopt(std::as_bytes(std::span(numbers)),
                                                         {"ATTRIBUTES", "NONE", 4, 1000}, version);
        const char* name = version == 0 ? "EXT_meshopt_compression" : "KHR_meshopt_compression";
        const Json json = Json::parse(fmt::format(
            R"({{"bufferViews": [{{"buffer": 1, "byteLength": 4000, "extensions": {{"{}": {{"buffer": 0, "byteLength": {},
                "byteStride": 4, "mode": "ATTRIBUTES", "count": 1000}}}}}}],
                "accessors": [{{"bufferView": 0, "count": 1000, "type": "SCALAR", "componentType": 5125}},
                {{"bufferView": 0, "count": 7, "byteOffset": 40, "type": "SCALAR", "componentType": 5125}}]}})",
            name, bytes.size()));
        const auto read = [&](io::gltf::Source& source, const Json& accessor) {
            return io::gltf::decode_indices(source, io::gltf::JsonCursor(accessor, "indices"), 997);
        };
        std::vector<io::Bytes> buffers{bytes, {}};
        const std::vector<Index> part(numbers.begin() + 10, numbers.begin() + 17);
        io::gltf::Source source(json, buffers), other(json, buffers);
        for (int time = 0; time < 3; ++time) CHECK(read(source, 0) == numbers);
        CHECK(read(source, 1) == part);
        CHECK(read(other, 1) == part);
        CHECK(read(other, 0) == numbers);
        buffers[0].back() = ~buffers[0].back();
        buffers[0][1] = std::byte{0x55};
        io::gltf::Source damaged(json, buffers);
        CHECK_THROWS_AS(read(damaged, 0), Error);
    }
}

TEST_CASE("KHR_meshopt_compression has streams of version 1, which are smaller", "[io]") {
    io::WriteSettings settings = with_bits(14, 8, 12, 8, 8);
    Scene scene = test::scene_in_metres(shapes::torus(160, 80));
    settings.meshopt.on = true;
    const std::size_t old = test::written(scene, "glb", settings).files[0].bytes.size();
    settings.meshopt.extension = io::MeshoptSettings::Extension::khr;
    const io::Written written = test::written(scene, "glb", settings);
    CHECK(static_cast<double>(written.files[0].bytes.size()) < 0.95 * static_cast<double>(old));
    const Part part = test::read_bytes(written.files[0].bytes, "glb").parts.at(0);
    CHECK(part.mesh.face_count() == scene.parts[0].mesh.face_count());
    // Under the other name it is decompressed and rewritten.
    settings.meshopt.extension = io::MeshoptSettings::Extension::ext;
    const io::Written again = test::written(test::read_bytes(written.files[0].bytes, "glb"), "glb", settings);
    CHECK(json_of(again)["extensionsRequired"].dump().find("EXT_meshopt") != std::string::npos);
    CHECK(again.files[0].bytes.size() < old + old / 20);
}

TEST_CASE("write refuses quantize and meshopt beside draco", "[stages]") {
    for (const char* options :
         {"{path: a.glb, draco: true, quantize: true}", "{path: a.glb, draco: true, meshopt: true}",
          "{path: a.ply, quantize: true}", "{path: a.obj, meshopt: true}"})
        CHECK_THROWS_AS(test::run_stage("write", options, test::scene_in_metres(shapes::cube())), Error);
}

TEST_CASE("the largest weights of a vertex come first, with their joints", "[io]") {
    Scene scene = test::scene_in_metres(shapes::tetrahedron());
    Mesh& mesh = scene.parts[0].mesh;
    std::vector<float> weights;
    std::vector<std::uint16_t> joints;
    for (int v = 0; v < 4; ++v) {
        weights.insert(weights.end(), {0, 0.25F, 0.75F, 0});
        joints.insert(joints.end(), {9, 5, 7, 9});
    }
    add(mesh, "WEIGHTS_0", Role::weights, 4, weights);
    mesh.attributes.push_back({"JOINTS_0", Domain::vertex, Role::joints, 4, false, joints});
    const Mesh again = test::again(scene, with_bits(14, 8, 12, 8, 8)).parts.at(0).mesh;
    const Attribute &share = *again.find("WEIGHTS_0", Domain::wedge),
                    &joint = *again.find("JOINTS_0", Domain::wedge);
    for (std::size_t w = 0; w < 4; ++w)
        for (const auto& [c, expected, number] :
             {std::tuple(0, 191.0, 7.0), {1, 64.0, 5.0}, {2, 0.0, 0.0}, {3, 0.0, 0.0}}) {
            CHECK(share.value(w, c) * 255 == Approx(expected));
            CHECK(joint.value(w, c) == number);
        }
}

TEST_CASE("texture coordinates under meshopt have a grid of powers of two, wherever they are", "[io]") {
    Scene scene = test::scene_in_metres(dressed(6));
    auto& uv = std::get<std::vector<float>>(scene.parts[0].mesh.find("TEXCOORD_0", Domain::vertex)->data);
    uv[0] = -7.3F;
    uv[1] = 12.6F;
    io::WriteSettings settings = with_bits(14, 8, 12, 8, 8);
    settings.meshopt.on = true;
    const Mesh mesh = test::again(scene, settings).parts.at(0).mesh;
    CHECK(difference(mesh, scene.parts[0].mesh, "TEXCOORD_0") <= 0.5 / 4096);
    const Attribute& stored = *mesh.find("TEXCOORD_0", Domain::wedge);
    for (std::size_t w = 0; w < stored.size(); ++w)
        REQUIRE(stored.value(w, 0) * 4096 == std::floor(stored.value(w, 0) * 4096));
}

TEST_CASE("normals that are bytes go on the octahedron under meshopt", "[io]") {
    io::WriteSettings settings = with_bits(14, 8, 12, 8, 8);
    const Scene scene = test::scene_in_metres(dressed(7));
    const Scene bytes = test::again(scene, settings);
    settings.meshopt.on = true;
    const io::Written written = test::written(bytes, "glb", settings);
    const std::string json = test::json_of(written.files[0].bytes);
    CHECK(json.find("OCTAHEDRAL") != std::string::npos);
    const Mesh mesh = test::read_bytes(written.files[0].bytes, "glb").parts.at(0).mesh;
    const double of_octahedron = (std::sqrt(18.0) + 1) * 0.5 / 127;
    CHECK(difference(mesh, scene.parts[0].mesh, "NORMAL") <= of_octahedron + 0.5 / 127);
}

TEST_CASE("wedges that round to the same bytes are one where attributes are rounded", "[io]") {
    Scene scene = test::scene_in_metres(shapes::cube());
    Mesh& mesh = scene.parts[0].mesh;
    separate_corners(mesh); // a wedge for each corner
    std::vector<float> normals;
    for (std::size_t w = 0; w < mesh.wedge_count(); ++w)
        normals.insert(normals.end(), {1e-5F * static_cast<float>(w), 0, 1});
    mesh.attributes.push_back({"NORMAL", Domain::wedge, Role::normal, 3, false, normals});
    for (const bool meshopt : {false, true}) {
        io::WriteSettings settings;
        CHECK(test::again(scene, settings).parts.at(0).mesh.wedge_count() == 36);
        settings.quantize.on = true;
        settings.meshopt.on = meshopt;
        const Mesh read = test::again(scene, settings).parts.at(0).mesh;
        CHECK(read.wedge_count() == 8);
        CHECK(read.face_count() == 12);
    }
}

TEST_CASE("numbers of a grid are short as text", "[io]") {
    for (const double x : {1.0 / 3, 123456789.123, 5e-324, 1e-7, 9.99999999e20, 1.0, 0.1}) {
        const double above = io::gltf::short_above(x);
        CHECK(above >= x);
        CHECK(above <= x * (1 + 2e-7) + 1e-322);
        CHECK(fmt::format("{}", above).size() <= 14);
    }
    CHECK(io::gltf::short_near(0.123456789, 0.001) == 0.12346);
    CHECK(io::gltf::short_near(-1234.5678, 1000) == -1235);
    CHECK_FALSE(std::signbit(io::gltf::short_near(-1e-9, 1)));
    CHECK(io::gltf::short_near(455000.123, 0) == 455000.123);
    const auto spelled = [](double x, double step) { // by the library that spells other numbers
        for (int decimals = 0; decimals < 17; ++decimals)
            if (const double near = std::stod(fmt::format("{:.{}f}", x, decimals));
                std::abs(near - x) <= step / 100)
                return near + 0.0;
        return x;
    };
    for (std::uint64_t i = 0; i < 20000; ++i) { // halves of all decimals among them
        const double whole = static_cast<double>(hashed(i, 1) % 100000) - 50000;
        const double x = std::ldexp(whole, -static_cast<int>(hashed(i, 2) % 12)),
                     step = std::ldexp(1.0, -static_cast<int>(hashed(i, 3) % 40));
        CHECK(io::gltf::short_near(x, step) == spelled(x, step));
    }
    Json json = Json::parse(R"({"a":[1.0,-2.5,1e300],"extras":{"b":1.0},"c":{"d":-3.0}})");
    io::gltf::shorten(json, {});
    CHECK(json.dump() == R"({"a":[1,-2.5,1e+300],"extras":{"b":1.0},"c":{"d":-3}})");
}

TEST_CASE("what named the corners of a mesh that has changed is not written", "[io]") {
    Scene scene = test::scene_in_metres(shapes::torus(40, 30));
    separate_corners(scene.parts[0].mesh);
    std::vector<float> uv;
    for (std::size_t w = 0; w < scene.parts[0].mesh.wedge_count(); ++w)
        uv.insert(uv.end(), {static_cast<float>(w), 0});
    scene.parts[0].mesh.attributes.push_back({"TEXCOORD_0", Domain::wedge, Role::uv, 2, false, uv});
    io::WriteSettings settings;
    settings.mesh_manifold = true;
    Scene manifold = test::again(scene, settings);
    settings.mesh_manifold = false;
    CHECK(json_of(test::written(manifold, "glb", settings)).contains("extensionsUsed")); // unchanged
    settings.meshopt.on = settings.quantize.on = true;
    const io::Written written = test::written(manifold, "glb", settings);
    const Json json = json_of(written);
    CHECK(json["accessors"].size() == 3); // indices, positions, texture coordinates
    CHECK(json["bufferViews"].size() == 3);
    CHECK(json["extensionsUsed"] == Json::array({"KHR_mesh_quantization", "EXT_meshopt_compression"}));
    CHECK(std::count_if(written.changes.begin(), written.changes.end(), [](const AttributeChange& c) {
              return c.attribute == "EXT_mesh_manifold" && c.kind == AttributeChange::Kind::dropped;
          }) == 1);
}

TEST_CASE("where corners are merged is compressed, too", "[io]") {
    Scene scene = test::scene_in_metres(shapes::torus(40, 30));
    Mesh& mesh = scene.parts[0].mesh;
    separate_corners(mesh);
    std::vector<float> uv;
    for (std::size_t w = 0; w < mesh.wedge_count(); ++w) uv.insert(uv.end(), {static_cast<float>(w), 0});
    mesh.attributes.push_back({"TEXCOORD_0", Domain::wedge, Role::uv, 2, false, uv});
    io::WriteSettings settings;
    settings.mesh_manifold = true;
    settings.quantize.on = true;
    settings.meshopt.on = true;
    const io::Written written = test::written(scene, "glb", settings);
    const Json json = json_of(written);
    const Json& accessors = json["accessors"];
    const Json manifold = json["meshes"][0]["extensions"]["EXT_mesh_manifold"];
    const auto view = [&](const char* of) {
        const Json& sparse = accessors[manifold["manifoldPrimitive"]["indices"].get<std::size_t>()]["sparse"];
        return json["bufferViews"][sparse[of]["bufferView"].get<std::size_t>()];
    };
    CHECK(view("indices")["extensions"]["EXT_meshopt_compression"]["mode"] == "INDICES");
    CHECK(view("values")["extensions"]["EXT_meshopt_compression"]["mode"] == "INDICES");
    const Mesh read = test::read_bytes(written.files[0].bytes, "glb").parts.at(0).mesh;
    CHECK(read.vertex_count() == shapes::torus(40, 30).vertex_count());
}
