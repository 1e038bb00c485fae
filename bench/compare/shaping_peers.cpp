// shaping_peers list: the peers. shaping_peers run PEER MESH: splits or relaxes a closed triangle mesh by one
// library, in this process, and prints as JSON what it took. bench/compare/shaping.py makes a table of it.

#include "compare/clock.hpp"
#include "geometry/relax/relax.hpp"
#include "geometry/split/split.hpp"
#include "io/codec.hpp"
#include "support/openmesh.hpp"

#ifdef FACETMILL_COMPARE_PMP
#include "compare/pmp_peer.hpp"
#endif

#include <OpenMesh/Tools/Smoother/JacobiLaplaceSmootherT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/MidpointT.hh>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <string>

using namespace facetmill;
using bench::Clock;

namespace {

constexpr unsigned rounds = 10; // of every smoother

/// Each gives the number of faces that came out. What a library needs as its own structure is built before
/// the clock starts; ours finds the neighbours while it runs.
using Peer = std::function<std::size_t(Mesh, Clock&)>;

std::size_t split_ours(Mesh mesh, Clock& clock) {
    clock.start();
    const SplitResult result = split(std::move(mesh), {});
    clock.stop();
    return result.mesh.face_count();
}

std::size_t relax_ours(Mesh mesh, Clock& clock) {
    RelaxSettings settings;
    settings.iterations = rounds;
    clock.start();
    const RelaxResult result = relax(std::move(mesh), settings);
    clock.stop();
    return result.mesh.face_count();
}

std::size_t split_openmesh(Mesh mesh, Clock& clock) {
    bench::OpenMeshTriangles theirs = bench::to_openmesh(mesh);
    OpenMesh::Subdivider::Uniform::MidpointT<bench::OpenMeshTriangles> midpoint;
    clock.start();
    midpoint.attach(theirs);
    midpoint(1);
    midpoint.detach();
    clock.stop();
    return theirs.n_faces();
}

std::size_t relax_openmesh(Mesh mesh, Clock& clock) {
    bench::OpenMeshTriangles theirs = bench::to_openmesh(mesh);
    theirs.request_vertex_normals();
    theirs.request_face_normals();
    theirs.update_normals();
    using Smoother = OpenMesh::Smoother::JacobiLaplaceSmootherT<bench::OpenMeshTriangles>;
    clock.start();
    Smoother smoother(theirs);
    smoother.initialize(Smoother::Tangential_and_Normal, Smoother::C0);
    smoother.smooth(rounds);
    clock.stop();
    return theirs.n_faces();
}

#ifdef FACETMILL_COMPARE_PMP
std::size_t pmp(const Mesh& mesh, Clock& clock, const std::function<void(bench::PmpPeer&)>& work) {
    std::vector<double> points;
    for (const Vec3& p : mesh.positions) points.insert(points.end(), {p.x, p.y, p.z});
    bench::PmpPeer peer(points, mesh.corners);
    clock.start();
    work(peer);
    clock.stop();
    return peer.face_count();
}
#endif

std::map<std::string, Peer> peers() {
    std::map<std::string, Peer> all{{"split: facetmill", split_ours},
                                    {"relax: facetmill", relax_ours},
                                    {"split: OpenMesh", split_openmesh},
                                    {"relax: OpenMesh Jacobi", relax_openmesh}};
#ifdef FACETMILL_COMPARE_PMP
    all["split: PMP"] = [](const Mesh& m, Clock& c) {
        return pmp(m, c, [](bench::PmpPeer& p) { p.split_midpoint(); });
    };
    all["relax: PMP explicit"] = [](const Mesh& m, Clock& c) {
        return pmp(m, c, [](bench::PmpPeer& p) { p.smooth(rounds); });
    };
#endif
    return all;
}

int run(const std::string& name, const char* path) {
    const auto all = peers();
    const auto peer = all.find(name);
    if (peer == all.end()) {
        fmt::print(stderr, "no peer '{}'\n", name);
        return 2;
    }
    io::ReadLog log;
    Clock clock;
    const std::size_t faces =
        peer->second(io::read_scene(io::Input::open(path), {}, log).parts.at(0).mesh, clock);
    fmt::print("{{\"wall\": {:.4f}, \"cpu\": {:.4f}, \"faces\": {}}}\n", clock.wall_seconds,
               clock.cpu_seconds, faces);
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    const std::string command = argc > 1 ? argv[1] : "";
    try {
        if (command == "run" && argc == 4) return run(argv[2], argv[3]);
    } catch (const std::exception& e) {
        fmt::print(stderr, "{}\n", e.what());
        return 1;
    }
    if (command == "list") {
        for (const auto& [name, peer] : peers()) fmt::print("{}\n", name);
        return 0;
    }
    fmt::print(stderr, "usage: shaping_peers list | shaping_peers run PEER MESH\n");
    return 2;
}
