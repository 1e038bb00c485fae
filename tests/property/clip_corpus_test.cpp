// The laws of clip over real and hard meshes, when FACETMILL_CORPUS names a folder of them.
#include "base/math/random.hpp"
#include "geometry/clip/clip.hpp"
#include "geometry/inspect/inspect.hpp"
#include "geometry/section/section.hpp"
#include "io/codec.hpp"
#include "mesh/invariants.hpp"
#include "support/catch.hpp"
#include "support/corpus.hpp"
#include "support/sums.hpp"

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <limits>

using namespace facetmill;
namespace fs = std::filesystem;

namespace {

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

/// Every third plane goes through a vertex, and every third is axis-aligned through a vertex.
Plane some_plane(std::uint64_t key, const Mesh& mesh, const Box& box) {
    Plane plane = oblique_plane(key, box);
    if (key % 3 == 0) return plane;
    plane.through = mesh.positions[hashed(29, key) % mesh.vertex_count()];
    if (key % 3 == 2)
        for (std::size_t i = 0; i < 3; ++i) plane.normal[i] = i == key / 3 % 3 ? 1 : 0;
    return plane;
}

struct ClipCounts {
    std::size_t files = 0, meshes = 0, cuts = 0, caps = 0, manifold = 0, through_vertices = 0, pinched = 0,
                tangled = 0, rows = 0, read_back = 0, sums = 0;
};

/// Points of the cut are off their edges by a unit or two in the last place of their coordinates. All faces
/// at the cut share them, so the volume error is that times the area.
bool adds_up(const Mesh& whole, const ClipResult& r, double area) {
    const Box box = whole.bounds();
    const Vec3 o = box.centre();
    const double reach = length(box.min) + length(box.max);
    const long double lost =
        test::volume_about(r.front, o) + test::volume_about(r.back, o) - test::volume_about(whole, o);
    return std::fabs(static_cast<double>(lost)) <= 4 * 2.2e-16 * reach * area;
}

/// The total perimeter of the faces that the plane meets, because these get new points.
double length_of_cut(const Mesh& mesh, const Plane& plane) {
    double sum = 0;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        bool above = false, below = false;
        double around = 0;
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) {
            const double s = side(plane, mesh.point(c));
            above |= s >= 0;
            below |= s <= 0;
            around +=
                length(mesh.point(c + 1 == mesh.face_end(f) ? mesh.face_begin(f) : c + 1) - mesh.point(c));
        }
        if (above && below) sum += around;
    }
    return sum;
}

/// Without caps the two sides have the area of the whole, except for rounding of points on cut edges. Faces
/// in the plane stay on one side.
bool areas_add_up(const Mesh& whole, const ClipResult& r, const Plane& plane) {
    const auto uncapped = [](const Mesh& side) {
        const Attribute* cut = side.find("cut_id", Domain::face);
        return test::area_where(side, [&](Index f) { return !cut || cut->value(f, 0) == 0; });
    };
    const Box box = whole.bounds();
    const double reach = length(box.min) + length(box.max);
    const long double all = test::area_where(whole, [](Index) { return true; });
    const auto lost = static_cast<double>(uncapped(r.front) + uncapped(r.back) - all);
    return std::fabs(lost) <= 8 * 2.2e-16 * reach * length_of_cut(whole, plane) +
                                  64 * std::numeric_limits<long double>::epsilon() * all;
}

/// Whether contours of the section meet: the mesh crosses or touches itself there. Doubly covered regions
/// have two caps.
bool tangled(const Mesh& mesh, const Plane& plane) {
    SectionSettings settings;
    settings.plane = plane;
    const Section cut = section(mesh, settings).at(0);
    return cut.contact != polygon::Contact::none || cut.collapsed > 0;
}

bool edge_manifold_too(const ClipResult& r, const Properties& front, const Properties& back, bool tangled,
                       ClipCounts& counts) {
    if (tangled && r.on_plane == 0) {
        ++counts.tangled;
        return true;
    }
    if (r.on_plane > 0) { // a plane through a vertex or an edge may connect touching contours
        ++counts.through_vertices;
        counts.pinched += !front.edge_manifold || !back.edge_manifold;
        return true;
    }
    ++counts.manifold;
    return front.edge_manifold && back.edge_manifold;
}

/// Whether a side is closed after writing and reading. PLY keeps the faces. STL rounds to float32 and is
/// welded.
bool closed_read_again(const Mesh& mesh, ClipCounts& counts) {
    ++counts.read_back;
    Scene scene;
    scene.parts.emplace_back().mesh = mesh;
    scene.parts[0].name = "side";
    for (const char* name : {"side.ply", "side.stl"}) {
        auto written = io::codec_for(name)->write(scene, {});
        io::ReadLog log;
        io::ReadSettings settings; // files split vertices at seams, so weld them
        settings.weld = io::Weld::exact;
        const Scene again =
            io::read_scene(io::Input::of(name, std::move(written.files.at(0).bytes)), settings, log);
        if (again.parts.size() != 1 || !inspect(again.parts[0].mesh).closed) return false;
    }
    return true;
}

void check_planes(const Mesh& mesh, const Properties& whole, std::uint64_t key, ClipCounts& counts) {
    ClipSettings settings;
    settings.planes = {some_plane(key, mesh, whole.bounds)};
    settings.keep = Keep::both;
    settings.cap = settings.cap_numbers = true;
    CAPTURE(key, mesh.face_count());
    const ClipResult r = clip(mesh, settings);
    ++counts.cuts;
    counts.caps += r.cap_faces > 0;
    const Properties front = inspect(r.front), back = inspect(r.back);
    CHECK(r.open.empty());
    CHECK(front.closed);
    CHECK(back.closed);
    CHECK(broken_invariants(r.front).empty());
    // Faces without area leave no trace in sections, and their caps touch.
    if (whole.edge_manifold && whole.degenerate_faces == 0)
        CHECK(edge_manifold_too(r, front, back, tangled(mesh, settings.planes[0]), counts));
    // A face that is not flat has no defined volume below it, and its pieces only approximate it.
    if (mesh.all_triangles() && !mesh.find("cut_id", Domain::face)) {
        ++counts.sums;
        CHECK(adds_up(mesh, r, whole.area + front.area + back.area));
        CHECK(areas_add_up(mesh, r, settings.planes[0]));
    }
    if (key < 3 && r.front.face_count() > 0) CHECK(closed_read_again(r.front, counts));
}

void check_row(const Mesh& mesh, const Properties& whole, std::uint64_t key, ClipCounts& counts) {
    ClipSettings settings;
    for (std::uint64_t k = 0; k < 4; ++k)
        settings.planes.push_back(some_plane(key * 4 + k, mesh, whole.bounds));
    settings.planes.push_back(settings.planes[0]);
    settings.cap = true;
    settings.snap = key % 2 == 0;
    CAPTURE(key, mesh.face_count());
    const ClipResult r = clip(mesh, settings);
    ++counts.rows;
    CHECK(r.open.empty());
    CHECK(inspect(r.front).closed);
    CHECK(broken_invariants(r.front).empty());
}

void check_clip_laws(const Mesh& mesh, std::uint64_t planes, ClipCounts& counts) {
    const Properties whole = inspect(mesh);
    if (!whole.closed || mesh.face_count() == 0) return;
    ++counts.meshes;
    for (std::uint64_t key = 0; key < planes; ++key) check_planes(mesh, whole, key, counts);
    for (std::uint64_t key = 0; key < (planes + 4) / 5; ++key) check_row(mesh, whole, key, counts);
}

} // namespace

TEST_CASE("closed meshes of the corpus stay closed and their sides add up", "[property]") {
    const auto folder = test::corpus();
    if (!folder) return;
    ClipCounts counts;
    counts.files = test::check_corpus(
        *folder, [&](const Mesh& mesh, std::uint64_t planes) { check_clip_laws(mesh, planes, counts); });
    std::cout << counts.files << " files, " << counts.meshes << " closed meshes, " << counts.cuts << " cuts, "
              << counts.caps << " with caps; edge-manifold meshes: " << counts.manifold
              << " cuts through no vertex stay so, of " << counts.through_vertices
              << " through vertices or edges " << counts.pinched << " do not, " << counts.tangled
              << " where contours meet were not asked; " << counts.rows << " rows of five planes, "
              << counts.read_back << " sides read again, " << counts.sums
              << " cuts of triangles whose areas and volumes add up\n";
}
