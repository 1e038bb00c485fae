// The laws of clip over real and hard meshes, when FACETMILL_CORPUS names a folder of them.
#include "base/random.hpp"
#include "geometry/clip.hpp"
#include "geometry/inspect.hpp"
#include "io/codec.hpp"
#include "mesh/invariants.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>

using namespace facetmill;
namespace fs = std::filesystem;

namespace {

std::vector<fs::path> mesh_files(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file() && io::codec_for(entry.path())) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

Scene read_or_nothing(const fs::path& file) {
    try {
        io::ReadLog log;
        return io::read_scene(io::Input::open(file), {}, log);
    } catch (const Error&) {
        return {}; // malformed files are io's own tests
    }
}

Plane oblique_plane(std::uint64_t key, const Box& box) {
    const auto number = [&](int which) {
        return uniform(hashed(hashed(23, key), static_cast<std::uint64_t>(which)));
    };
    Plane plane;
    for (int i = 0; i < 3; ++i) {
        const auto axis = static_cast<std::size_t>(i);
        plane.normal[axis] = number(i) - 0.5;
        plane.through[axis] = box.min[axis] + (0.1 + 0.8 * number(3 + i)) * box.extent()[axis];
    }
    return plane;
}

/// Every third plane goes through a vertex, every third along an axis through one.
Plane some_plane(std::uint64_t key, const Mesh& mesh, const Box& box) {
    Plane plane = oblique_plane(key, box);
    if (key % 3 == 0) return plane;
    plane.through = mesh.positions[hashed(29, key) % mesh.vertex_count()];
    if (key % 3 == 2)
        for (std::size_t i = 0; i < 3; ++i) plane.normal[i] = i == key / 3 % 3 ? 1 : 0;
    return plane;
}

struct Counts {
    std::size_t files = 0, meshes = 0, cuts = 0, caps = 0;
};

void check_laws(const Mesh& mesh, std::uint64_t planes, Counts& counts) {
    const Properties whole = inspect(mesh);
    if (!whole.closed || mesh.face_count() == 0) return;
    ++counts.meshes;
    // Rounding moves each point of the cut by some units in the last place of its coordinates.
    const double reach = length(whole.bounds.min) + length(whole.bounds.max);
    const double rounding = 1e-12 * whole.area * reach;
    for (std::uint64_t key = 0; key < planes; ++key) {
        ClipSettings settings;
        settings.planes = {some_plane(key, mesh, whole.bounds)};
        settings.keep = Keep::both;
        settings.cap = true;
        CAPTURE(key, mesh.face_count());
        const ClipResult r = clip(mesh, settings);
        ++counts.cuts, counts.caps += r.cap_faces > 0;
        const Properties front = inspect(r.front), back = inspect(r.back);
        CHECK(r.open.empty());
        CHECK(front.closed);
        CHECK(back.closed);
        CHECK(broken_invariants(r.front).empty());
        // A face that is not flat has no volume below it of its own; its pieces come near to it only.
        if (!mesh.all_triangles()) continue;
        CHECK(std::fabs(front.volume.value_or(0) + back.volume.value_or(0) - whole.volume.value_or(0)) <=
              rounding);
    }
}

} // namespace

TEST_CASE("closed meshes of the corpus stay closed and their sides add up", "[property]") {
    const char* folder = std::getenv("FACETMILL_CORPUS");
    if (!folder) {
        std::cout << "skipped: FACETMILL_CORPUS does not name a folder of meshes\n";
        return;
    }
    const char* planes = std::getenv("FACETMILL_CORPUS_PLANES");
    Counts counts;
    for (const fs::path& file : mesh_files(folder)) {
        CAPTURE(file.string());
        const Scene scene = read_or_nothing(file);
        ++counts.files;
        for (const Part& part : scene.parts)
            check_laws(part.mesh, planes ? static_cast<std::uint64_t>(std::atoi(planes)) : 6, counts);
    }
    std::cout << counts.files << " files, " << counts.meshes << " closed meshes, " << counts.cuts << " cuts, "
              << counts.caps << " with caps\n";
}
