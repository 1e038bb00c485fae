#include "cells/kept_partition.hpp"

#include "cells/hierarchy.hpp"
#include "cells/stations.hpp"
#include "geometry/edit/moved.hpp"
#include "io/outputs.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"
#include "support/temporary.hpp"

using namespace facetmill;
using namespace facetmill::cells;

namespace {

struct KeptRun {
    std::vector<std::string> told;
    std::uint64_t faces = 0, vertices = 0;
    HierarchyResult result;
};

/// One run of a program that keeps its cells, or none of them.
KeptRun run_kept(const std::filesystem::path& path, const std::filesystem::path& kept, char key = 'a',
                 std::size_t target = 900) {
    KeptRun run;
    Means means{path.parent_path(), std::uint64_t{1} << 30};
    means.key = std::string(64, key);
    if (!kept.empty())
        means.kept = std::make_shared<CellFolder>(
            CellFolder::Settings{kept, false, [&](const std::string& what) { run.told.push_back(what); }});
    const auto partition = kept_partition(open_faces({path}, {}, path.parent_path()), means, 700);
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
        CHECK(other.told[0].find("of other options: they are made again") != std::string::npos);
        CHECK(other.told[1].find("of other inputs or options removed") != std::string::npos);
        CHECK(is_same(other.result, without.result));
    }
}

TEST_CASE("jobs that simplify share out the stations", "[cells]") {
    const test::TemporaryDirectory folder;
    Scene scene;
    scene.parts.emplace_back().mesh = test::noisy_icosphere(5, 0.01, 7);
    const auto path = folder / "m.ply";
    io::write_now(path, io::codec_for(path)->write(scene, {}).files.front().bytes);
    const Means means{folder.path(), std::uint64_t{1} << 30};
    const Partition partition(open_faces({path}, {}, folder.path()), means, 300);
    const auto stations = stations_of(partition);
    for (const std::size_t jobs : {1, 2, 3, 7, 500}) {
        CAPTURE(jobs);
        std::vector<std::size_t> times(stations.size());
        std::uint64_t most = 0;
        for (std::size_t number = 1; number <= jobs; ++number) {
            const auto own = stations_of_job(stations, {number, jobs});
            std::uint64_t faces = 0;
            for (std::size_t s = 0; s < stations.size(); ++s) {
                times[s] += own[s];
                if (own[s] && stations[s].is_leaf()) faces += stations[s].faces;
                for (const std::size_t child : stations[s].children) CHECK(own[child] >= own[s]);
            }
            most = std::max(most, faces);
        }
        CHECK(times.back() == 0); // the root is the result
        for (std::size_t s = 0; s < stations.size(); ++s)
            CHECK((stations[s].is_leaf() ? times[s] == 1 : times[s] <= 1));
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
        Means means{path.parent_path(), std::uint64_t{1} << 30};
        means.key = std::string(64, 'a');
        means.job = job;
        means.kept = std::make_shared<CellFolder>(
            CellFolder::Settings{kept, false, {}, job.makes_cells() ? "" : name_of(job)});
        const auto partition = kept_partition(open_faces({path}, {}, path.parent_path()), means, 700);
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
