#include "cells/sources/face_source.hpp"

#include "cells/partition/partition.hpp"
#include "cells/process/clean_source.hpp"
#include "cells/process/crumple_source.hpp"
#include "cells/process/split_source.hpp"
#include "io/outputs/outputs.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/cells.hpp"
#include "support/failure.hpp"
#include "support/meshes.hpp"
#include "support/surface.hpp"
#include "support/temporary.hpp"

#include <cmath>
#include <fmt/format.h>

using namespace facetmill;
using namespace facetmill::cells;

namespace {

/// The files' parts as one mesh of triangles, in the world.
Mesh read_whole(const std::vector<std::filesystem::path>& paths, io::Weld weld = io::Weld::automatic) {
    Mesh all;
    for (const auto& path : paths) {
        io::ReadLog log;
        io::ReadSettings settings;
        settings.weld = weld;
        for (const Part& part : io::read_scene(io::Input::open(path), settings, log).parts) {
            Mesh mesh = triangulated(part.mesh);
            apply(mesh, part.transform);
            for (Index& corner : mesh.corners) corner = mesh.vertex_of_wedge(corner);
            mesh.wedge_vertex.clear();
            mesh.attributes.clear();
            mesh.primitives.clear();
            append(all, mesh);
        }
    }
    return all;
}

Mesh read_in_cells(const std::vector<std::filesystem::path>& paths, std::uint64_t most,
                   io::Weld weld = io::Weld::automatic) {
    io::ReadSettings settings;
    settings.weld = weld;
    const auto folder = paths.front().parent_path();
    const Partition partition(open_faces(paths, settings, folder), {folder, std::uint64_t{64} << 20}, most);
    return test::rejoined(partition);
}

/// The error of reading in memory or in cells: the id and the line.
std::string failure_of(const std::filesystem::path& path, bool cells) {
    try {
        if (cells)
            read_in_cells({path}, 100);
        else
            read_whole({path});
    } catch (const Error& error) {
        const Diagnostic& d = error.diagnostics().front();
        return fmt::format("{}:{}", d.id, d.where.line);
    }
    return "none";
}

/// A closed mesh with polygons of three to five corners, whose coordinates are exact as float32.
Mesh polygons() {
    Mesh mesh = test::noisy_icosphere(4, 0.01, 7);
    for (Vec3& p : mesh.positions) p = {double(float(p.x)), double(float(p.y)), double(float(p.z))};
    mesh.attributes.clear();
    const auto n = static_cast<Index>(mesh.positions.size());
    for (const Vec3& p : {Vec3{2, 0, 0}, Vec3{3, 0, 0}, Vec3{3, 1, 0}, Vec3{2.5, 0.25, 0}, Vec3{2, 1, 0}})
        mesh.positions.push_back(p);
    add_face(mesh, std::vector<Index>{n, n + 1, n + 2, n + 3, n + 4});
    add_face(mesh, std::vector<Index>{n, n + 1, n + 2, n + 4});
    return mesh;
}

} // namespace

TEST_CASE("files of all formats come in cells as they come in memory", "[cells]") {
    const test::TemporaryDirectory folder;
    for (const auto& [name, ascii] :
         {std::pair{"m.obj", false}, std::pair{"m.off", false}, std::pair{"m.ply", false},
          std::pair{"t.ply", true}, std::pair{"m.stl", false}, std::pair{"t.stl", true},
          std::pair{"m.glb", false}, std::pair{"m.gltf", false}}) {
        INFO(name);
        Scene scene;
        scene.parts.emplace_back().mesh = polygons();
        const auto path = folder / name;
        for (const auto& file : io::codec_for(path)->write(scene, {.ascii = ascii, .title = "m"}).files)
            io::write_now(file.name.extension() == ".bin" ? folder / file.name.string() : path, file.bytes);
        const Mesh whole = read_whole({path}), cells = read_in_cells({path}, 200);
        CHECK(cells.vertex_count() == whole.vertex_count());
        CHECK(test::triangles_of(cells) == test::triangles_of(whole));
    }
}

TEST_CASE("text is read through a window that is smaller than the file", "[cells]") {
    const test::TemporaryDirectory folder;
    const Mesh mesh = shapes::grid(200, 200); // each file has more than a megabyte
    for (const char* name : {"m.obj", "m.off", "m.ply"}) {
        INFO(name);
        Scene scene;
        scene.parts.emplace_back().mesh = test::with_noise(mesh, 0.1, 3);
        const auto path = folder / name;
        io::write_now(
            path,
            io::codec_for(path)->write(scene, {.ascii = true, .double_positions = true}).files.front().bytes);
        CHECK(std::filesystem::file_size(path) > (1 << 20));
        CHECK(test::triangles_of(read_in_cells({path}, 10000)) == test::triangles_of(read_whole({path})));
    }
}

TEST_CASE("a face of 10,000 corners and lines that go on are read as in memory", "[cells]") {
    const test::TemporaryDirectory folder;
    std::string obj, face = "f";
    for (int i = 0; i < 10000; ++i) {
        const double angle = 2 * 3.141592653589793 * i / 10000;
        obj += fmt::format("v {} {} 0\n", std::cos(angle), std::sin(angle));
        face += i % 100 == 99 ? fmt::format(" \\\n{}", i + 1) : fmt::format(" {}", i + 1);
    }
    test::put(folder / "m.obj", "f 3 2 1\n" + obj + face + "\nf -1 -2 -3/4/5\nf 1 2\n");
    const Mesh whole = read_whole({folder / "m.obj"});
    CHECK(whole.face_count() == 9998 + 2);
    CHECK(test::triangles_of(read_in_cells({folder / "m.obj"}, 100)) == test::triangles_of(whole));
}

TEST_CASE("several files are one mesh, joined where that is asked for", "[cells]") {
    const test::TemporaryDirectory folder;
    const Mesh sphere = test::noisy_icosphere(4, 0.01, 7);
    Mesh halves[2];
    for (Index f = 0; f < sphere.face_count(); ++f) {
        Mesh& half = halves[sphere.point(3 * f).x > 0];
        half.positions = sphere.positions;
        add_face(half, sphere.face_wedges(f));
    }
    std::vector<std::filesystem::path> paths;
    for (const char* name : {"a.ply", "b.ply"}) {
        Scene scene;
        scene.parts.emplace_back().mesh = halves[paths.size()];
        drop_unused(scene.parts.front().mesh);
        paths.push_back(folder / name);
        io::write_now(
            paths.back(),
            io::codec_for(paths.back())->write(scene, {.double_positions = true}).files.front().bytes);
    }
    const Mesh joined = read_in_cells(paths, 200, io::Weld::exact), apart = read_in_cells(paths, 200);
    CHECK(test::triangles_of(joined) == test::triangles_of(sphere));
    CHECK(joined.vertex_count() == sphere.vertex_count());
    CHECK(apart.vertex_count() == read_whole(paths).vertex_count());
    CHECK(test::count(joined).open == 0);
    CHECK(test::count(apart).open > 0);
}

TEST_CASE("broken files end in cells as in memory", "[cells]") {
    const test::TemporaryDirectory folder;
    const std::string cube = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (const auto& [name, text] : std::vector<std::pair<const char*, std::string>>{
             {"missing.obj", cube + "f 1 2 3\nf 1 2 4\nf 1 2 9\n"},
             {"back.obj", cube + "f -4 1 2\n"},
             {"zero.obj", cube + "f 0 1 2\n"},
             {"nan.obj", "v 0 0 nan\n" + cube + "f 1 2 3\n"},
             {"short.obj", "v 0 0\nf 1 1 1\n"},
             {"word.obj", cube + "f 1 2 x\n"},
             {"counts.off", "OFF\n100 100 0\n0 0 0\n"},
             {"index.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"},
             {"list.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n999999999 0 1 2\n"},
             {"negative.off", "OFF\n3 -1 0\n0 0 0\n1 0 0\n0 1 0\n"},
             {"inf.off", "OFF\n3 1 0\n0 0 inf\n1 0 0\n0 1 0\n3 0 1 2\n"},
             {"end.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float "
                         "y\nproperty float z\nelement face 1\nproperty list uchar int "
                         "vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n"},
             {"type.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float "
                          "y\nproperty float z\nproperty uchar red\nelement face 1\nproperty list uchar int "
                          "vertex_indices\nend_header\n0 0 0 1\n1 0 0 300\n0 1 0 1\n3 0 1 2\n"},
             {"index.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float "
                           "y\nproperty float z\nelement face 1\nproperty list uchar int "
                           "vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n"},
             {"end.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1"},
             {"word.stl", "solid x\nfacet normal 0 0 1\nouter lop\nvertex 0 0 0\n"},
             {"byte.stl", std::string(1, '\x7f')},
             {"head.stl", std::string(83, '\x7f')},
             {"count.stl", std::string(83, '\0') + '\x01'}}) {
        INFO(name);
        test::put(folder / name, text);
        CHECK(failure_of(folder / name, true) == failure_of(folder / name, false));
        CHECK(failure_of(folder / name, true) != "none");
    }
}

TEST_CASE("what is not read in pieces is refused by name", "[cells]") {
    const test::TemporaryDirectory folder;
    test::put(folder / "m.off", std::string("OFF BINARY\n\0\0\0\0\0\0\0\0\0\0\0\0", 23));
    CHECK(why_not_streamed(folder / "m.off").value_or("").find("binary OFF") != std::string::npos);
    test::put(folder / "m.obj", "\xef\xbb\xbfv 0 0 0\n");
    CHECK(why_not_streamed(folder / "m.obj").value_or("").find("UTF-8") != std::string::npos);
    Scene scene;
    scene.parts.emplace_back().mesh = shapes::icosphere(2);
    for (const bool draco : {true, false}) {
        io::WriteSettings settings;
        settings.draco.on = draco;
        settings.quantize.on = !draco;
        io::write_now(folder / "m.glb", io::codec_named("glb")->write(scene, settings).files.front().bytes);
        CHECK(why_not_streamed(folder / "m.glb").value_or("").find(draco ? "draco" : "quantized") !=
              std::string::npos);
    }
    CHECK(why_not_streamed("-"));
}

TEST_CASE("what cells do not carry of lines is named", "[cells]") {
    test::TemporaryDirectory folder;
    Scene scene;
    scene.unit = Unit::m;
    scene.up = UpAxis::y;
    scene.parts.resize(2);
    scene.parts[0].mesh = shapes::cube();
    scene.parts[1].name = "wires";
    scene.parts[1].mesh.positions = {{0, 0, 0}, {5, 5, 5}};
    scene.parts[1].mesh.lines = {0, 1};
    for (const auto& [name, wanted] :
         {std::pair{"ply", "element 'edge' (1)"}, {"glb", "lines"}, {"obj", "lines and points"}}) {
        INFO(name);
        const io::Written written = io::codec_named(name)->write(scene, {});
        const auto path = folder.path() / fmt::format("a.{}", name);
        io::write_now(path, written.files[0].bytes);
        const auto source = open_faces({path}, {}, folder.path());
        CHECK(source->contents().dropped == std::vector<std::string>{wanted});
    }
}

TEST_CASE("digests are those of the files, however far they were read", "[cells]") {
    const test::TemporaryDirectory folder;
    Scene scene;
    scene.parts.emplace_back().mesh = test::noisy_icosphere(3, 0.01, 7);
    Scene with_lines = scene; // PLY stores them after the faces
    with_lines.parts.emplace_back().mesh.positions = {{0, 0, 0}, {0, 0, 1}};
    with_lines.parts.back().mesh.lines = {0, 1};
    for (const char* name : {"m.ply", "lines.ply", "m.stl", "m.obj"}) {
        const auto path = folder / name;
        const Scene& its = name == std::string_view("lines.ply") ? with_lines : scene;
        io::write_now(path, io::codec_for(path)->write(its, {}).files.front().bytes);
        const std::string expected = sha256(io::Input::open(path).bytes());
        const auto opened = [&] { return open_faces({path}, {}, folder.path()); };
        const auto digest = [](const auto& source) {
            source->finish_digests();
            return source->contents().files.front().sha256;
        };
        const auto unread = opened(), scanned = opened(), read = opened(), taken = opened();
        CHECK(digest(unread) == expected);
        scanned->scan(1 << 16);
        CHECK(digest(scanned) == expected);
        read->scan(1 << 16);
        read->each([](const Vec3&, io::Span) {}, 1 << 16);
        CHECK(read->contents().files.front().sha256 == expected);
        taken->take_digests({"known"});
        CHECK(digest(taken) == "known");
        unread->scan(1 << 16); // after all
        unread->each([](const Vec3&, io::Span) {}, 1 << 16);
        CHECK(digest(unread) == expected);
        CHECK(unread->contents().bounds.min == read->contents().bounds.min);
    }
}

TEST_CASE("records alone are those that come with centres", "[cells]") {
    const test::TemporaryDirectory folder;
    Scene scene;
    Mesh& mesh = scene.parts.emplace_back().mesh;
    mesh = test::noisy_icosphere(3, 0.01, 7);
    add_face(mesh, std::vector<Index>{0, 5, 9, 12, 30}); // a polygon
    for (const char* name : {"m.ply", "m.stl", "m.off"}) {
        const auto path = folder / name;
        io::write_now(path, io::codec_for(path)->write(scene, {}).files.front().bytes);
        const std::shared_ptr<FaceSource> plain = open_faces({path}, {}, folder.path());
        plain->scan(1 << 16);
        const auto numbered = numbered_source(plain, false);
        io::Bytes records;
        plain->each_record([&](io::Span r) { records.insert(records.end(), r.begin(), r.end()); }, 1 << 16);
        const std::size_t size = plain->record_size();
        const auto faces = static_cast<std::uint32_t>(records.size() / size);
        Replacement by;
        by.come = plain->piece(io::Span(records).first(2 * size));
        by.gone = {1, 3, 4};
        const std::vector<std::shared_ptr<FaceSource>> sources{
            plain, numbered, split_source(plain, FaceCut{.grid = 3}), crumple_source(plain, {}),
            replaced_source(numbered, faces, std::move(by))};
        for (const auto& source : sources) {
            io::Bytes with, alone;
            source->each([&](const Vec3&, io::Span r) { with.insert(with.end(), r.begin(), r.end()); },
                         1 << 16);
            source->each_record([&](io::Span r) { alone.insert(alone.end(), r.begin(), r.end()); }, 1 << 16);
            CHECK(with.size() > 1000 * source->record_size());
            CHECK(with == alone);
        }
    }
}

TEST_CASE("a name that means another file by now is noticed", "[cells]") {
    const test::TemporaryDirectory folder;
    const auto link = folder / "link.ply";
    const auto point_at = [&](const char* name) {
        std::filesystem::remove(link);
        std::filesystem::create_symlink(name, link);
    };
    for (const std::size_t size : {std::size_t{1000}, std::size_t{100000}}) { // copied, mapped
        CAPTURE(size);
        test::put(folder / "a", std::string(size, 'a'));
        test::put(folder / "b", std::string(size, 'b'));
        test::put(folder / "c", std::string(size + 1, 'a'));
        point_at("a");
        const io::Input seen = io::Input::open(link, 1 << 16);
        CHECK(open_again(seen).file->stamp() == FileStamp::of(folder / "a"));
        for (const char* other : {"b", "c"}) {
            point_at(other);
            CHECK(test::failure_id([&] { open_again(seen); }) == "E-CHANGED");
        }
    }
}

TEST_CASE("an STL is the same as rows, whatever memory it takes, and as records", "[cells]") {
    const test::TemporaryDirectory folder;
    Scene scene;
    Mesh& mesh = scene.parts.emplace_back().mesh;
    mesh = test::noisy_icosphere(5, 0.01, 7);
    mesh.positions[0] = {0.0, mesh.positions[0].y, 0.0};
    const auto path = folder / "m.stl";
    io::Bytes bytes = io::codec_for(path)->write(scene, {}).files.front().bytes;
    const CellResources means{folder.path(), std::uint64_t{1} << 30};
    const auto cells = [&](std::size_t memory, bool kept) {
        const Partition partition(open_faces({path}, {}, folder.path(), memory, kept), means, 700);
        std::vector<Cell> all;
        for (std::uint32_t leaf = 0; leaf < partition.tree().leaves.size(); ++leaf)
            all.push_back(partition.cell(leaf));
        CHECK(partition.vertices() == mesh.vertex_count());
        return all;
    };
    constexpr std::size_t plenty = std::size_t{1} << 28, head = 84, record = 50, normal = 12,
                          bit_of_minus_zero = 3;
    for (const char* kind : {"plain", "minus zero", "attributes"}) {
        CAPTURE(kind);
        if (kind == std::string("minus zero")) // one of the zeros
            for (std::size_t at = head + normal; at < bytes.size(); at += record) {
                if (io::little_endian(bytes, at, 4) != 0) continue; // x of the first corner
                bytes[at + bit_of_minus_zero] ^= std::byte{0x80};
                break;
            }
        if (kind == std::string("attributes")) bytes.back() = std::byte{7};
        io::write_now(path, bytes);
        const auto expected = cells(plenty, true);
        for (const std::size_t memory : {plenty, std::size_t{1} << 16, std::size_t{0}}) {
            const auto found = cells(memory, false);
            REQUIRE(found.size() == expected.size());
            for (std::size_t leaf = 0; leaf < found.size(); ++leaf) {
                const Mesh &a = found[leaf].mesh, &b = expected[leaf].mesh;
                CHECK(std::equal(a.positions.begin(), a.positions.end(), b.positions.begin(),
                                 b.positions.end(), [](const Vec3& p, const Vec3& q) {
                                     return p == q && std::signbit(p.x) == std::signbit(q.x) &&
                                            std::signbit(p.z) == std::signbit(q.z);
                                 }));
                CHECK(a.corners == b.corners);
                CHECK(found[leaf].home == expected[leaf].home);
                CHECK(a.attributes.size() == b.attributes.size());
            }
        }
    }
}
