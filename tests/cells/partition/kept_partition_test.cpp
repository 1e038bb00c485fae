#include "cells/partition/kept_partition.hpp"

#include "base/hash.hpp"
#include "cells/hierarchy/hierarchy.hpp"
#include "cells/hierarchy/hierarchy_nodes.hpp"
#include "cells/storage/input_stamps.hpp"
#include "geometry/edit/moved.hpp"
#include "io/outputs/outputs.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/meshes.hpp"
#include "support/temporary.hpp"

#include <fstream>

using namespace facetmill;
using namespace facetmill::cells;

namespace {

struct KeptRun {
    std::vector<std::string> told;
    std::uint64_t faces = 0, vertices = 0;
    HierarchyResult result;
};

/// Runs a program with or without kept cells.
KeptRun run_kept(const std::filesystem::path& path, const std::filesystem::path& kept, char key = 'a',
                 std::size_t target = 900) {
    KeptRun run;
    CellResources means{path.parent_path(), std::uint64_t{1} << 30};
    means.key = std::string(64, key);
    if (!kept.empty())
        means.kept = std::make_shared<CellFolder>(
            CellFolder::Settings{kept, false, [&](const std::string& what) { run.told.push_back(what); }});
    const auto partition = kept_partition(
        open_faces({path}, {}, path.parent_path(), std::size_t{1} << 28, means.kept != nullptr), means, 700);
    run.faces = partition->faces();
    run.vertices = partition->vertices();
    SimplifySettings settings;
    settings.faces = target;
    run.result = simplify_cells(*partition, settings, means);
    return run;
}

bool is_same(const HierarchyResult& a, const HierarchyResult& b) {
    return a.mesh.positions == b.mesh.positions && a.mesh.corners == b.mesh.corners && a.error == b.error &&
           a.collapses == b.collapses && a.turned == b.turned && a.levels == b.levels && a.cells == b.cells;
}

} // namespace

TEST_CASE("a kept partition gives what a new one gives", "[cells]") {
    const test::TemporaryDirectory folder;
    Scene scene;
    scene.parts.emplace_back().mesh = test::noisy_icosphere(5, 0.01, 7);
    for (const char* name : {"m.ply", "m.stl", "m.obj"}) {
        const auto path = folder / name, kept = folder / (std::string(name) + ".kept");
        io::write_now(path, io::codec_for(path)->write(scene, {}).files.front().bytes);
        const KeptRun without = run_kept(path, {}), first = run_kept(path, kept),
                      again = run_kept(path, kept);
        CHECK(is_same(first.result, without.result));
        CHECK(is_same(again.result, without.result));
        CHECK(again.faces == without.faces);
        CHECK(again.vertices == without.vertices);
        CHECK(first.told.empty());
        REQUIRE(again.told.size() == 2);
        CHECK(again.told[0].find("cells reused from") != std::string::npos);
        CHECK(again.told[1].find("simplified cells reused from") != std::string::npos);
        for (const auto& entry : std::filesystem::directory_iterator(kept)) { // one after the other
            if (entry.path().extension() == ".lock") continue;
            std::filesystem::remove(entry.path());
            CHECK(is_same(run_kept(path, kept).result, without.result));
        }
        const KeptRun other = run_kept(path, kept, 'b');
        REQUIRE(other.told.size() == 2);
        CHECK(other.told[0].find("belong to other options: they are made again") != std::string::npos);
        CHECK(other.told[1].find("from other inputs or options removed") != std::string::npos);
        CHECK(is_same(other.result, without.result));
    }
}

TEST_CASE("jobs that simplify share out the stations", "[cells]") {
    const test::TemporaryDirectory folder;
    Scene scene;
    scene.parts.emplace_back().mesh = test::noisy_icosphere(5, 0.01, 7);
    const auto path = folder / "m.ply";
    io::write_now(path, io::codec_for(path)->write(scene, {}).files.front().bytes);
    const CellResources means{folder.path(), std::uint64_t{1} << 30};
    const Partition partition(open_faces({path}, {}, folder.path()), means, 300);
    const auto hierarchy_nodes = hierarchy_nodes_of(partition);
    for (const std::size_t jobs : {1, 2, 3, 7, 500}) {
        CAPTURE(jobs);
        std::vector<std::size_t> times(hierarchy_nodes.size());
        std::uint64_t most = 0;
        for (std::size_t number = 1; number <= jobs; ++number) {
            const auto own = hierarchy_nodes_of_job(hierarchy_nodes, {number, jobs});
            std::uint64_t faces = 0;
            for (std::size_t s = 0; s < hierarchy_nodes.size(); ++s) {
                times[s] += own[s];
                if (own[s] && hierarchy_nodes[s].is_leaf()) faces += hierarchy_nodes[s].faces;
                for (const std::size_t child : hierarchy_nodes[s].children) CHECK(own[child] >= own[s]);
            }
            most = std::max(most, faces);
        }
        CHECK(times.back() == 0); // the root is the result
        for (std::size_t s = 0; s < hierarchy_nodes.size(); ++s)
            CHECK((hierarchy_nodes[s].is_leaf() ? times[s] == 1 : times[s] <= 1));
        if (jobs < 10) CHECK(most <= 2 * partition.faces() / jobs);
    }
}

TEST_CASE("jobs leave what a single run makes", "[cells]") {
    const test::TemporaryDirectory folder;
    Scene scene;
    scene.parts.emplace_back().mesh = test::noisy_icosphere(5, 0.01, 7);
    const auto path = folder / "m.ply", kept = folder / "kept";
    io::write_now(path, io::codec_for(path)->write(scene, {}).files.front().bytes);
    const auto expected = run_kept(path, {}).result;
    CHECK(expected.area_before == Approx(surface_size(scene.parts.front().mesh).area).epsilon(1e-6));
    SimplifySettings settings;
    settings.faces = 900;
    std::size_t stamped = 0;
    for (const CellJob job : {CellJob{}, CellJob{2, 2}, CellJob{1, 2}}) {
        CellResources means{path.parent_path(), std::uint64_t{1} << 30};
        means.key = std::string(64, 'a');
        means.job = job;
        means.kept = std::make_shared<CellFolder>(
            CellFolder::Settings{kept, false, {}, job.makes_cells() ? "" : name_of(job)});
        const auto partition = kept_partition(
            open_faces({path}, {}, path.parent_path(), std::size_t{1} << 28, means.kept != nullptr), means,
            700);
        if (!job.makes_cells()) simplify_job(*partition, settings, means, {});
        std::size_t stamps = 0;
        for (const auto& file : std::filesystem::directory_iterator(kept))
            stamps += file.path().filename().string().starts_with("facetmill-job.") &&
                      file.path().extension() != ".lock";
        stamped += job.makes_cells() ? 0 : 1;
        CHECK(stamps == stamped);
    }
    const KeptRun last = run_kept(path, kept);
    CHECK(is_same(last.result, expected));
    CHECK(last.result.area_before == expected.area_before);
    REQUIRE(last.told.size() == 2);
    CHECK(last.told.back().find("simplified cells reused") != std::string::npos);
}

TEST_CASE("inputs that are as they were are not read for their digests", "[cells]") {
    const test::TemporaryDirectory folder;
    Scene scene;
    Mesh& mesh = scene.parts.emplace_back().mesh;
    mesh = test::noisy_icosphere(5, 0.01, 7);
    for (const char* name : {"m.ply", "m.stl"}) {
        const auto path = folder / name, kept = folder / (std::string(name) + ".kept");
        io::write_now(path, io::codec_for(path)->write(scene, {}).files.front().bytes);
        const KeptRun first = run_kept(path, kept);
        const auto stamp = [&](const std::string& digest) {
            const CellFolder opened({kept, false});
            std::vector<FaceSource::File> files{open_input(path)};
            files.front().sha256 = digest;
            InputStamps(files, InputStamps::now() + std::int64_t{10000000000}).store(opened, files);
        };
        stamp(sha256(io::Input::open(path).bytes()));
        KeptRun again = run_kept(path, kept);
        REQUIRE(again.told.size() == 2);
        CHECK(again.told[0].find("cells reused from") != std::string::npos);
        CHECK(is_same(again.result, first.result));
        stamp(std::string(64, '0')); // the stamp is trusted; later readers report the difference
        again = run_kept(path, kept);
        REQUIRE(again.told.size() >= 1);
        CHECK(again.told[0].find("belong to other inputs: they are made again") != std::string::npos);
        again = run_kept(path, kept); // the file was read, so its digest is stored again
        REQUIRE(again.told.size() == 2);
        CHECK(again.told[0].find("cells reused from") != std::string::npos);
        CHECK(is_same(again.result, first.result));
    }
}

TEST_CASE("what was found when cells were made is known when they are taken up", "[cells]") {
    const test::TemporaryDirectory folder;
    Scene scene;
    scene.parts.emplace_back().mesh = test::noisy_icosphere(3, 0.01, 7);
    const auto ply = folder / "m.ply";
    io::write_now(ply, io::codec_for(ply)->write(scene, {.double_positions = true}).files.front().bytes);
    // A face of two corners after the others.
    const io::Bytes bytes = *CellFolder({folder.path(), false}).read("m.ply");
    std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const auto at = text.find("element face 1280");
    REQUIRE(at != std::string::npos);
    text.replace(at, 17, "element face 1281");
    text += std::string("\2\0\0\0\0\1\0\0\0", 9);
    test::put(ply, text);
    for (int run = 0; run < 2; ++run) {
        CellResources means{folder.path(), std::uint64_t{1} << 30};
        means.kept = std::make_shared<CellFolder>(CellFolder::Settings{folder / "kept", false});
        const std::shared_ptr<FaceSource> source = open_faces({ply}, {}, folder.path());
        const auto partition = kept_partition(source, means, 700);
        CHECK(source->contents().skipped_faces == 1);
        CHECK(source->contents().bounds.min == scene.bounds().min);
        CHECK(source->contents().bounds.max == scene.bounds().max);
    }
}

TEST_CASE("cells of an input that grew while it was read are not kept", "[cells]") {
    const test::TemporaryDirectory folder;
    Scene scene;
    scene.parts.emplace_back().mesh = test::noisy_icosphere(5, 0.01, 7);
    for (const char* name : {"m.ply", "m.stl"}) {
        CAPTURE(name);
        const auto path = folder / name, kept = folder / (std::string(name) + ".kept");
        io::write_now(path, io::codec_for(path)->write(scene, {}).files.front().bytes);
        CellResources means{folder.path(), std::uint64_t{1} << 30};
        means.key = std::string(64, 'a');
        means.kept = std::make_shared<CellFolder>(CellFolder::Settings{kept, false});
        const std::shared_ptr<FaceSource> source =
            open_faces({path}, {}, folder.path(), std::size_t{1} << 28, true);
        std::ofstream(path, std::ios::app | std::ios::binary) << "\1\2";
        CHECK(test::failure_id([&] { kept_partition(source, means, 700); }) == "E-CHANGED");
        CHECK_FALSE(std::filesystem::exists(kept / kept_files[0]));
        CHECK_FALSE(std::filesystem::exists(kept / InputStamps::file));
        means.kept.reset(); // releases the lock
        const KeptRun next = run_kept(path, kept);
        CHECK(is_same(next.result, run_kept(path, {}).result));
        CHECK(next.told.empty());
    }
}

TEST_CASE("vertices that are read again must be as they were", "[cells]") {
    const test::TemporaryDirectory folder;
    Scene scene;
    scene.parts.emplace_back().mesh = test::noisy_icosphere(5, 0.01, 7);
    SimplifySettings settings;
    settings.faces = 900;
    for (const char* name : {"m.ply", "m.stl", "m.off"}) {
        CAPTURE(name);
        const auto path = folder / name;
        io::write_now(path, io::codec_for(path)->write(scene, {}).files.front().bytes);
        const CellResources means{folder.path(), std::uint64_t{1} << 30};
        const Partition partition(open_faces({path}, {}, folder.path()), means, 700);
        std::filesystem::rename(path, folder / "elsewhere"); // it is the same
        CHECK(simplify_cells(partition, settings, means).mesh.face_count() == 900);
        std::ofstream(folder / "elsewhere", std::ios::app | std::ios::binary) << "\1\2";
        const bool is_read = path.extension() == ".ply"; // cells of others are not in the file
        CHECK((test::failure_id([&] { simplify_cells(partition, settings, means); }) == "E-CHANGED") ==
              is_read);
        CHECK((test::failure_id([&] { require_unchanged(partition.source().contents().files); }) ==
               "E-CHANGED") == is_read);
    }
}
