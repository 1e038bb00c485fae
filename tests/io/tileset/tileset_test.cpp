#include "io/tileset/tileset.hpp"

#include "geometry/inspect/inspect.hpp"
#include "io/convert.hpp"
#include "io/gltf/document/container.hpp"
#include "io/read_back.hpp"
#include "io/tileset/frame.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/temporary.hpp"

#include <cstdio>
#include <cstring>
#include <functional>
#include <map>
#include <set>
#include <tuple>

namespace tileset_test {

using namespace facetmill;
using namespace facetmill::test;

namespace {

Scene ball(const Vec3& at = {}) {
    Scene scene;
    scene.unit = Unit::m;
    scene.up = UpAxis::z;
    Part& part = scene.parts.emplace_back();
    part.name = "ball";
    part.mesh = shapes::icosphere(4); // 5120 faces
    for (std::size_t axis = 0; axis < 3; ++axis) part.transform.m[axis][3] = at[axis];
    return scene;
}

io::Written written(const Scene& scene, io::WriteSettings settings = {}) {
    settings.title = "tileset";
    settings.tiles.faces = 400;
    return io::codec_named("3d-tiles")->write(scene, settings);
}

Json json_of(const io::Written& all) { return parse_json(io::as_text(all.files.front().bytes)); }

/// A tileset and its files on disk.
struct OnDisk {
    TemporaryDirectory folder;
    std::filesystem::path path;

    explicit OnDisk(const io::Written& all) : path(folder.path() / "tileset.json") {
        for (const io::OutputFile& file : all.files) {
            std::filesystem::create_directories((folder.path() / file.name).parent_path());
            put(folder.path() / file.name, io::as_text(file.bytes));
        }
    }
    Scene read() const {
        io::ReadLog log;
        return io::read_scene(io::Input::open(path), {}, log);
    }
};

/// A box as the tileset has it, in the world.
Box box_of_tile(const Json& tile, const Vec3& at) {
    const Json& b = (tile.contains("content") && tile["content"].contains("boundingVolume")
                         ? tile["content"]
                         : tile)["boundingVolume"]["box"];
    Box box;
    for (const double side : {-1.0, 1.0})
        box.add(at + Vec3{b[0].get<double>() + side * b[3].get<double>(),
                          b[1].get<double>() + side * b[7].get<double>(),
                          b[2].get<double>() + side * b[11].get<double>()});
    return box;
}

/// Tiles that are refined down to a depth of the tree, each other one a level less, as one mesh in the world.
void add_cut(const OnDisk& disk, const Json& tile, const Vec3& at, int depth, Mesh& all) {
    if (depth > 0 && tile.contains("children")) {
        int other = 0;
        for (const Json& child : tile["children"]) add_cut(disk, child, at, depth - 1 - other++ % 2, all);
        return;
    }
    io::ReadLog log;
    const Scene scene = io::read_scene(
        io::Input::open(disk.folder.path() / tile["content"]["uri"].get<std::string>()), {}, log);
    const Box box = box_of_tile(tile, at);
    Box found;
    for (const Part& part : scene.parts) {
        Mesh mesh = part.mesh;
        apply(mesh, io::turn_up(UpAxis::y, UpAxis::z) * part.transform);
        for (Vec3& p : mesh.positions) found.add(p = p + at);
        append(all, mesh);
    }
    CHECK(found.min == box.min);
    CHECK(found.max == box.max);
}

/// Box and error of each tile, by level and place.
void add_tiles(const Json& tile, std::map<std::string, Json>& all) {
    const std::string uri = tile["content"]["uri"];
    std::uint64_t x = 0, y = 0;
    const std::string digits = uri.substr(9, uri.size() - 13); // tileset/r....glb
    for (const char digit : digits) {
        x = 2 * x + (digit == '1' || digit == '3');
        y = 2 * y + (digit == '2' || digit == '3');
    }
    all[std::to_string(digits.size()) + "-" + std::to_string(x) + "-" + std::to_string(y)] = {
        tile["boundingVolume"]["box"], tile["geometricError"]};
    if (tile.contains("children"))
        for (const Json& child : tile["children"]) add_tiles(child, all);
}

double double_at(io::Span bytes, std::size_t at) {
    double value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

/// The same from subtree files, for tiles that have files. Reads them independently of the tested code.
std::map<std::string, Json> tiles_of_subtrees(const io::Written& written, std::size_t levels) {
    std::map<std::string, Json> all;
    std::set<std::string> names;
    for (const io::OutputFile& file : written.files) names.insert(file.name.string());
    for (const io::OutputFile& file : written.files) {
        if (file.name.extension() != ".subtree") continue;
        const io::Span bytes = file.bytes;
        std::uint64_t text = 0;
        std::memcpy(&text, bytes.data() + 8, sizeof text);
        const Json json = parse_json(io::as_text(bytes.subspan(24, text)));
        const io::Span binary = bytes.subspan(24 + text);
        const auto view = [&](const Json& index) {
            const Json& v = json["bufferViews"][index.get<std::size_t>()];
            return binary.subspan(v["byteOffset"], v["byteLength"]);
        };
        const io::Span bits = view(json["tileAvailability"]["bitstream"]);
        const Json& columns = json["propertyTables"][0]["properties"];
        const io::Span boxes = view(columns["boundingBox"]["values"]),
                       errors = view(columns["geometricError"]["values"]);
        std::uint64_t level = 0, x = 0, y = 0;
        REQUIRE(std::sscanf(file.name.stem().c_str(), "%lu-%lu-%lu", &level, &x, &y) == 3);
        std::size_t place = 0, row = 0;
        for (std::uint64_t down = 0; down < levels; ++down)
            for (std::uint64_t m = 0; m < std::uint64_t{1} << (2 * down); ++m, ++place) {
                if ((std::to_integer<int>(bits[place / 8]) >> (place % 8) & 1) == 0) continue;
                std::uint64_t mx = 0, my = 0;
                for (std::uint64_t bit = 0; bit < down; ++bit) {
                    mx |= (m >> (2 * bit) & 1) << bit;
                    my |= (m >> (2 * bit + 1) & 1) << bit;
                }
                const std::string name = std::to_string(level + down) + "-" +
                                         std::to_string((x << down) + mx) + "-" +
                                         std::to_string((y << down) + my);
                CHECK(names.count("tileset/" + name + ".glb") == 1);
                Json box;
                for (std::size_t i = 0; i < 12; ++i) box.push_back(double_at(boxes, 8 * (12 * row + i)));
                all[name] = {box, double_at(errors, 8 * row)};
                ++row;
            }
        CHECK(json["propertyTables"][0]["count"] == row);
        CHECK(json["tileAvailability"]["availableCount"] == row);
    }
    return all;
}

Vec3 origin_of(const Json& tileset) {
    if (!tileset["root"].contains("transform")) return {};
    const Json& t = tileset["root"]["transform"];
    return {t[12].get<double>(), t[13].get<double>(), t[14].get<double>()};
}

} // namespace

TEST_CASE("tiles of several levels fit, far from the origin and under compression", "[io][tileset]") {
    io::WriteSettings plain, draco, meshopt;
    draco.draco.on = true;
    meshopt.meshopt.on = meshopt.quantize.on = true;
    for (const auto& settings : {plain, draco, meshopt})
        for (const Vec3& at : {Vec3{}, Vec3{500000, 5800000, 100}}) {
            const io::Written all = written(ball(at), settings);
            const Json tileset = json_of(all);
            const OnDisk disk(all);
            for (int depth = 0; depth < 4; ++depth) {
                Mesh cut;
                add_cut(disk, tileset["root"], origin_of(tileset), depth, cut);
                weld_exact(cut);
                CAPTURE(depth, settings.draco.on, settings.meshopt.on, at.x);
                CHECK(inspect(cut).closed);
                CHECK(inspect(cut).components == 1);
            }
        }
}

TEST_CASE("a tileset is explicit, refined by REPLACE, with errors that fall to 0", "[io][tileset]") {
    const io::Written all = written(ball());
    const Json tileset = json_of(all);
    CHECK(tileset["asset"]["version"] == "1.1");
    CHECK(tileset["root"]["refine"] == "REPLACE");
    std::size_t tiles = 0;
    const std::function<void(const Json&, double)> visit = [&](const Json& tile, double above) {
        ++tiles;
        const double error = tile["geometricError"];
        CHECK(error <= above);
        CHECK((error == 0) == !tile.contains("children"));
        if (tile.contains("children"))
            for (const Json& child : tile["children"]) visit(child, error);
    };
    visit(tileset["root"], tileset["geometricError"]);
    REQUIRE(all.tiles);
    CHECK(all.tiles->tiles == tiles);
    CHECK(all.files.size() == tiles + 1);
    CHECK(all.tiles->error == tileset["root"]["geometricError"]);
}

TEST_CASE("a tileset is read as its finest tiles, one closed part", "[io][tileset]") {
    const Scene scene = ball({500000, 5800000, 100});
    const io::Written all = written(scene);
    const OnDisk disk(all);
    const Scene back = disk.read();
    REQUIRE(back.parts.size() == 1);
    CHECK(back.up == UpAxis::z);
    CHECK(back.face_count() == scene.face_count());
    CHECK(back.parts[0].mesh.vertex_count() == scene.parts[0].mesh.vertex_count());
    CHECK(inspect(back.parts[0].mesh).closed);
    const io::ReadBack result =
        io::read_back(io::Input::open(disk.path), *io::codec_named("3d-tiles"), scene, {});
    CHECK(result.position_error < 1e-6);
    CHECK(result.losses.empty());
}

TEST_CASE("an implicit tileset names the tiles of the explicit one, with their boxes and errors",
          "[io][tileset]") {
    Scene scene = ball({500000, 5800000, 100});
    scene.parts[0].mesh = shapes::icosphere(5);
    io::WriteSettings settings;
    settings.tiles.faces = 100; // five levels
    settings.tiles.implicit = true;
    for (const bool many_levels : {false, true}) {
        if (many_levels) scene.parts[0].mesh = shapes::icosphere(7); // more than one subtree file has
        settings.title = "tileset";
        const io::Written implicit = io::codec_named("3d-tiles")->write(scene, settings);
        settings.tiles.implicit = false;
        const io::Written explicitly = io::codec_named("3d-tiles")->write(scene, settings);
        settings.tiles.implicit = true;
        std::size_t subtrees = 0;
        for (const io::OutputFile& file : implicit.files) subtrees += file.name.extension() == ".subtree";
        CHECK((subtrees > 1) == many_levels);
        CHECK(implicit.files.size() - subtrees == explicitly.files.size());
        const OnDisk disk(implicit);
        const Scene back = disk.read();
        CHECK(back.face_count() == scene.face_count());
        CHECK(inspect(back.parts[0].mesh).closed);
        CHECK(back.bounds().min == OnDisk(explicitly).read().bounds().min);
        const Json root = json_of(implicit)["root"];
        CHECK(root["implicitTiling"]["subdivisionScheme"] == "QUADTREE");
        CHECK(!root.contains("children"));
        CHECK(!root["content"].contains("boundingVolume"));
        std::map<std::string, Json> listed;
        add_tiles(json_of(explicitly)["root"], listed);
        CHECK(tiles_of_subtrees(implicit, root["implicitTiling"]["subtreeLevels"]) == listed);
    }
}

TEST_CASE("implicit tilings of others: octrees, JSON subtrees, constants, several contents, ADD",
          "[io][tileset]") {
    const TemporaryDirectory folder;
    const io::Written one = io::codec_named("glb")->write(ball(), {});
    for (const char* name : {"a-0-0-0-0.glb", "a-1-1-0-1.glb", "a-1-0-0-0.glb", "b-1-0-0-0.glb"})
        put(folder.path() / name, io::as_text(one.files.front().bytes));
    put(folder.path() / "bits.bin", std::string("\x43\0\x43\0", 4)); // places 0, 1 and 6
    put(folder.path() / "s-0-0-0-0.json", R"({
        "buffers": [{"uri": "bits.bin", "byteLength": 4}],
        "bufferViews": [{"buffer": 0, "byteLength": 2}, {"buffer": 0, "byteOffset": 2, "byteLength": 2}],
        "tileAvailability": {"bitstream": 0}, "contentAvailability": [{"bitstream": 1}, {"constant": 1}],
        "childSubtreeAvailability": {"constant": 0}})");
    const auto faces = [&](const std::string& refine, const std::string& contents) {
        const auto path = folder.path() / "tileset.json";
        put(path,
            R"({"asset": {"version": "1.1"}, "geometricError": 1, "root": {"refine": ")" + refine +
                R"(", "boundingVolume": {"box": [0,0,0,1,0,0,0,1,0,0,0,1]}, "geometricError": 1, )" +
                contents +
                R"("implicitTiling": {"subdivisionScheme": "OCTREE", "subtreeLevels": 2, "availableLevels": 2,
                         "subtrees": {"uri": "s-{level}-{x}-{y}-{z}.json"}}}})");
        io::ReadLog log;
        return io::read_scene(io::Input::open(path), {}, log).face_count();
    };
    const std::string a = R"("content": {"uri": "a-{level}-{x}-{y}-{z}.glb"}, )";
    CHECK(faces("REPLACE", a) == 2 * 5120);
    CHECK(faces("ADD", a) == 3 * 5120);
    put(folder.path() / "b-1-1-0-1.glb", io::as_text(one.files.front().bytes));
    const std::string both =
        R"("contents": [{"uri": "a-{level}-{x}-{y}-{z}.glb"}, {"uri": "b-{level}-{x}-{y}-{z}.glb"}], )";
    CHECK(faces("REPLACE", both) == 4 * 5120);
    const auto refused = [&](const std::string& contents) {
        return failure([&] { faces("REPLACE", contents); });
    };
    CHECK(refused(R"("content": {"uri": "a-{level}-{x}-{y}.glb"}, )").find("expected {z} in the template") !=
          std::string::npos);
    CHECK(refused(R"("content": {"uri": "../a-{level}-{x}-{y}-{z}.glb"}, )").find("E-URI") !=
          std::string::npos);
}

TEST_CASE("subtree files that are too short, lie or ask for too much are refused", "[io][tileset]") {
    const TemporaryDirectory folder;
    const auto refused = [&](const std::string& subtree, const std::string& levels = "2") {
        put(folder.path() / "s-0-0-0.subtree", subtree);
        const auto path = folder.path() / "tileset.json";
        put(path, R"({"asset": {"version": "1.1"}, "geometricError": 1, "root": {
            "content": {"uri": "{level}-{x}-{y}.glb"}, "implicitTiling": {"subdivisionScheme": "QUADTREE",
            "subtreeLevels": )" +
                      levels +
                      R"(, "availableLevels": 9, "subtrees": {"uri": "s-{level}-{x}-{y}.subtree"}}}})");
        return failure([&] {
            io::ReadLog log;
            io::read_scene(io::Input::open(path), {}, log);
        });
    };
    const auto has = [](const std::string& message, const char* part) {
        return message.find(part) != std::string::npos;
    };
    const auto json = [](const std::string& tiles) {
        return R"({"buffers": [{"byteLength": 8}], "bufferViews": [{"buffer": 0, "byteLength": 0}],
                   "contentAvailability": [{"constant": 1}], "childSubtreeAvailability": {"constant": 1},
                   "tileAvailability": )" +
               tiles + "}";
    };
    CHECK(has(refused("subt"), "has 24 bytes"));
    CHECK(has(refused(std::string("subt\2\0\0\0", 8) + std::string(16, 0)), "version 1"));
    CHECK(has(refused(std::string("subt\1\0\0\0", 8) + std::string(16, '\xff')), "its header announces"));
    CHECK(has(refused("{"), "E-JSON"));
    CHECK(has(refused("{}"), "tileAvailability"));
    CHECK(has(refused(json(R"({"constant": 0})")), "leaves out the first tile"));
    CHECK(has(refused(json(R"({"bitstream": 0})")), "has 0 bytes, but 5 tiles need 1"));
    CHECK(has(refused(json(R"({"bitstream": 1})")), "E-GLTF"));
    CHECK(has(refused(json(R"({"constant": 2})")), "E-GLTF"));
    CHECK(has(refused(json(R"({"constant": 1})")), "E-FILE")); // the subtrees below
    CHECK(has(refused(json(R"({"constant": 1})"), "40"), "E-LIMIT"));
    CHECK(has(refused(json(R"({"constant": 1})"), "0"), "at least one level"));
}

TEST_CASE("a tileset is recognised by its members, and a glTF by its own", "[io][tileset]") {
    const auto codec = [](const std::string& text) {
        const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
        const io::Codec* found = io::sure_codec(io::Input::of("a.json", {bytes.begin(), bytes.end()}));
        return found ? found->name : "none";
    };
    const std::string rest = R"("geometricError":1,"root":{"boundingVolume":{"box":[]},"geometricError":0}})";
    CHECK(codec(R"({"asset":{"version":"1.1"},)" + rest) == "3d-tiles");
    CHECK(codec("\xEF\xBB\xBF {\"asset\":{\"version\":\"1.1\"}," + rest) == "3d-tiles");
    // A schema that is longer than 64 kB, with a text that looks like another member.
    const std::string schema =
        R"("schema":{"id":"\"nodes\":","description":")" + std::string(70000, 'x') + "\"},";
    CHECK(codec(R"({"asset":{"version":"1.1"},)" + schema + rest) == "3d-tiles");
    CHECK(codec(R"({"asset":{"version":"2.0","extras":{"geometricError":1,"root":2}},"nodes":[]})") ==
          "gltf");
}

TEST_CASE("nested tilesets are placed by the tiles above them, with the axes that they state",
          "[io][tileset]") {
    const TemporaryDirectory folder;
    Scene box = ball(); // from (0, -3, 0) to (1, 0, 2) with z up
    Mesh mesh = shapes::cube();
    for (Vec3& p : mesh.positions) p = {p.x, 3 * p.y - 3, 2 * p.z};
    box.parts[0].mesh = mesh;
    io::WriteSettings settings;
    settings.title = "box";
    io::convert(box, {Unit::m, UpAxis::y});
    put(folder.path() / "box.glb",
        io::as_text(io::codec_named("glb")->write(box, settings).files.front().bytes));
    const std::string head = R"({"asset": {"version": "1.1")", rest = R"(}, "geometricError": 1, "root": )";
    const auto bounds_of = [&](const std::string& outer, const std::string& inner) {
        put(folder.path() / "inner.json", inner);
        put(folder.path() / "tileset.json", outer);
        io::ReadLog log;
        const Box bounds = io::read_scene(io::Input::open(folder.path() / "tileset.json"), {}, log).bounds();
        CHECK(log.files.size() == 2); // the nested tileset and the tile
        return bounds;
    };
    const std::string outer =
        head + rest + R"({"refine": "ADD", "transform": [0,1,0,0, -1,0,0,0, 0,0,1,0, 100,0,0,1],
        "children": [{"content": {"uri": "inner.json"}}]}})";
    const std::string root =
        R"({"transform": [1,0,0,0, 0,1,0,0, 0,0,1,0, 10,0,0,1], "content": {"uri": "box.glb"}}})";
    const Box turned = bounds_of(outer, head + rest + root);
    CHECK(turned.min == Vec3{100, 10, 0});
    CHECK(turned.max == Vec3{103, 11, 2});
    // The file has the box with y up: from (0, 0, 0) to (1, 2, 3).
    const Box as_it_is = bounds_of(outer, head + R"(, "gltfUpAxis": "Z")" + rest + root);
    CHECK(as_it_is.min == Vec3{98, 10, 0});
    CHECK(as_it_is.max == Vec3{100, 11, 3});
    const Box from_x = bounds_of(outer, head + R"(, "gltfUpAxis": "X")" + rest + root);
    CHECK(from_x.max.z - from_x.min.z == 1);
    CHECK(from_x.max.x - from_x.min.x == 2);
    const std::string itself = head + rest + R"({"content": {"uri": "inner.json"}}})";
    CHECK(failure([&] { bounds_of(itself, itself); }).find("E-TILESET") != std::string::npos);
}

TEST_CASE("what is not read of a tileset is refused by name", "[io][tileset]") {
    const TemporaryDirectory folder;
    const auto refused = [&](const std::string& root) {
        const auto path = folder.path() / "tileset.json";
        put(path, R"({"asset": {"version": "1.1"}, "geometricError": 1, "root": )" + root + "}");
        return failure([&] {
            io::ReadLog log;
            io::read_scene(io::Input::open(path), {}, log);
        });
    };
    CHECK(refused(R"({"implicitTiling": {}})").find("E-GLTF") != std::string::npos);
    CHECK(refused(R"({"content": {"uri": "../a.glb"}})").find("E-URI") != std::string::npos);
    CHECK(refused(R"({"content": {"uri": "none.glb"}})").find("E-FILE") != std::string::npos);
    CHECK(refused(R"({"content": {}})").find("E-GLTF") != std::string::npos);
    CHECK(refused(R"({"refine": "MAYBE"})").find("E-TILESET") != std::string::npos);
    CHECK(refused(R"({"transform": [1]})").find("E-GLTF") != std::string::npos);
    CHECK(refused("{}").find("E-EMPTY") != std::string::npos);
    put(folder.path() / "a.b3dm", "b3dm and more");
    CHECK(refused(R"({"content": {"uri": "a.b3dm"}})").find("E-TILESET") != std::string::npos);
}

TEST_CASE("a tileset holds a mesh at one place far away, and says what float32 cannot hold",
          "[io][tileset]") {
    Scene scene = ball();
    for (Vec3& p : scene.parts[0].mesh.positions) p = {5e5, 5e6, 1};
    const OnDisk disk(written(scene));
    CHECK(disk.read().bounds().min == Vec3{5e5, 5e6, 1});
    CHECK(disk.read().bounds().max == Vec3{5e5, 5e6, 1});
    for (Vec3& p : scene.parts[0].mesh.positions)
        p = {5e5, 5e6, 1e300 * (&p == scene.parts[0].mesh.positions.data())};
    CHECK(failure([&] { written(scene); }).find("E-RANGE") != std::string::npos);
}

TEST_CASE("faces that cross themselves are filled in tiles as in other files", "[io][tileset]") {
    Scene scene = ball();
    Mesh& mesh = scene.parts[0].mesh;
    mesh = {};
    mesh.positions = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.corners = {0, 1, 2, 3};
    mesh.face_offsets = {0, 4};
    const OnDisk disk(written(scene));
    CHECK(inspect(disk.read().parts[0].mesh).area == 0.5);
}

TEST_CASE("the frame of a tileset keeps vertices apart, unless the bits are given", "[io][tileset]") {
    io::WriteSettings settings;
    settings.draco.on = true;
    settings.draco.position_bits = 4;
    const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {1, 1e-4, 0}, {0.3, 0.7, 0.1}};
    const auto places = [&] {
        std::vector<Vec3> moved = points;
        io::put_into_frame(moved, io::tileset_frame(points, settings));
        std::sort(moved.begin(), moved.end(), [](const Vec3& a, const Vec3& b) {
            return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
        });
        return std::unique(moved.begin(), moved.end()) - moved.begin();
    };
    CHECK(places() == 4);
    settings.tiles.given_bits = true;
    CHECK(places() == 3);
}

} // namespace tileset_test
