// simplify_peers run PEER IN OUT RATIO: simplifies by one library, in this process, and prints what it took.
// simplify_peers judge REFERENCE MESH: how far it is from the reference and whether it is sound.
// Both print one line of JSON; bench/compare/simplify.py makes a table of them. simplify_peers list: the
// peers.

#include "compare/clock.hpp"
#include "geometry/deviation/deviation.hpp"
#include "geometry/inspect/inspect.hpp"
#include "geometry/simplify/simplify.hpp"
#include "io/codec.hpp"
#include "io/outputs/outputs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <functional>
#include <map>
#include <meshoptimizer.h>
#include <sys/resource.h>

#ifdef FACETMILL_COMPARE_CGAL
#include "compare/cgal_peer.hpp"
#endif

using namespace facetmill;
using bench::Clock;

namespace {

Mesh read(const char* path) {
    io::ReadLog log;
    return io::read_scene(io::Input::open(path), {}, log).parts.at(0).mesh;
}

void write(const Mesh& mesh, const char* path) {
    std::ofstream out(path, std::ios::binary);
    out << "ply\nformat binary_little_endian 1.0\nelement vertex " << mesh.vertex_count()
        << "\nproperty double x\nproperty double y\nproperty double z\nelement face " << mesh.face_count()
        << "\nproperty list uchar int vertex_indices\nend_header\n";
    out.write(reinterpret_cast<const char*>(mesh.positions.data()),
              static_cast<std::streamsize>(mesh.positions.size() * sizeof(Vec3)));
    for (Index f = 0; f < mesh.face_count(); ++f) {
        out.put(3);
        out.write(reinterpret_cast<const char*>(&mesh.corners[3 * f]), 12);
    }
}

using Peer = std::function<Mesh(Mesh, double ratio, Clock&)>;

Mesh ours(Mesh mesh, double ratio, SimplifySettings::Method method, Clock& clock) {
    clock.start();
    Mesh result = simplify(std::move(mesh), {.method = method, .ratio = ratio}).mesh;
    clock.stop();
    return result;
}

enum class Meshopt { plain, update, sloppy }; // update: positions are optimised too

Mesh meshopt(Mesh mesh, double ratio, Meshopt how, Clock& clock) {
    std::vector<float> points;
    for (const Vec3& p : mesh.positions)
        for (std::size_t i = 0; i < 3; ++i) points.push_back(static_cast<float>(p[i]));
    const std::size_t n = mesh.positions.size();
    std::vector<unsigned> indices = mesh.corners, result(indices.size());
    const std::size_t target = static_cast<std::size_t>(static_cast<double>(indices.size() / 3) * ratio) * 3;
    clock.start();
    std::size_t count = 0;
    if (how == Meshopt::update) {
#if MESHOPTIMIZER_VERSION >= 1000
        result = indices;
        count = meshopt_simplifyWithUpdate(result.data(), result.size(), points.data(), n, 12, nullptr, 0,
                                           nullptr, 0, nullptr, target, 1e9f, 0, nullptr);
#endif
    } else if (how == Meshopt::sloppy) {
#if MESHOPTIMIZER_VERSION >= 1000
        count = meshopt_simplifySloppy(result.data(), indices.data(), indices.size(), points.data(), n, 12,
                                       nullptr, target, 1e9f, nullptr);
#endif
    } else {
        count = meshopt_simplify(result.data(), indices.data(), indices.size(), points.data(), n, 12, target,
                                 1e9f, 0, nullptr);
    }
    clock.stop();
    Mesh out;
    for (std::size_t v = 0; v < n; ++v)
        out.positions.push_back({points[3 * v], points[3 * v + 1], points[3 * v + 2]});
    out.corners.assign(result.begin(), result.begin() + static_cast<std::ptrdiff_t>(count));
    drop_unused(out);
    return out;
}

std::map<std::string, Peer> peers() {
    using Method = SimplifySettings::Method;
    std::map<std::string, Peer> all;
    const auto own = [&](const char* name, Method method) {
        all[name] = [method](Mesh m, double ratio, Clock& c) { return ours(std::move(m), ratio, method, c); };
    };
    own("facetmill quadric", Method::quadric);
    own("facetmill quadric-endpoints", Method::quadric_endpoints);
    own("facetmill shortest-edge", Method::shortest_edge);
    own("facetmill cluster", Method::cluster);
    all[fmt::format("meshoptimizer {}.{} simplify", MESHOPTIMIZER_VERSION / 1000,
                    MESHOPTIMIZER_VERSION / 10 % 100)] = [](Mesh m, double ratio, Clock& c) {
        return meshopt(std::move(m), ratio, Meshopt::plain, c);
    };
#if MESHOPTIMIZER_VERSION >= 1000
    all["meshoptimizer simplifyWithUpdate"] = [](Mesh m, double ratio, Clock& c) {
        return meshopt(std::move(m), ratio, Meshopt::update, c);
    };
    all["meshoptimizer simplifySloppy"] = [](Mesh m, double ratio, Clock& c) {
        return meshopt(std::move(m), ratio, Meshopt::sloppy, c);
    };
#endif
#ifdef FACETMILL_COMPARE_CGAL
    for (const bool quadric : {true, false})
        all[quadric ? "CGAL Garland-Heckbert" : "CGAL shortest edge, midpoint"] =
            [quadric](Mesh m, double ratio, Clock& c) {
                bench::CgalPeer peer(m);
                c.start();
                peer.simplify(ratio, quadric);
                c.stop();
                return peer.mesh();
            };
#endif
    return all;
}

int run(const char* name, const char* in, const char* out, double ratio) {
    const auto all = peers();
    const auto peer = all.find(name);
    if (peer == all.end()) {
        fmt::print(stderr, "no peer '{}'\n", name);
        return 2;
    }
    const Mesh mesh = read(in);
    Clock clock;
    const Mesh result = peer->second(mesh, ratio, clock);
    write(result, out);
    rusage use{};
    getrusage(RUSAGE_SELF, &use);
    fmt::print("{{\"wall\": {:.4f}, \"cpu\": {:.4f}, \"faces\": {}, \"peak_bytes\": {}}}\n",
               clock.wall_seconds, clock.cpu_seconds, result.face_count(), use.ru_maxrss * 1024);
    return 0;
}

int judge(const char* reference, const char* path) {
    const Mesh a = read(reference), b = read(path);
    const DeviationResult d = deviation(a, b);
    const Properties p = inspect(b, {.self_intersections = true});
    fmt::print("{{\"rms_percent\": {:.6f}, \"max_percent\": {:.6f}, \"faces\": {}, \"closed\": {}, "
               "\"manifold\": {}, \"genus\": {}, \"self_intersections\": {}}}\n",
               d.percent(d.rms()), d.percent(d.maximum()), p.faces, p.closed,
               p.edge_manifold && p.vertex_manifold, p.genus ? fmt::to_string(*p.genus) : "null",
               *p.self_intersections);
    return 0;
}

} // namespace

int main(int count, char** words) {
    const std::string what = count > 1 ? words[1] : "";
    try {
        if (what == "run" && count == 6) return run(words[2], words[3], words[4], std::stod(words[5]));
        if (what == "judge" && count == 4) return judge(words[2], words[3]);
        if (what == "list" && count == 2) {
            for (const auto& [name, _] : peers()) fmt::print("{}\n", name);
            return 0;
        }
    } catch (const std::exception& e) {
        fmt::print(stderr, "{}\n", e.what());
        return 1;
    }
    fmt::print(stderr, "simplify_peers run PEER IN OUT RATIO | judge REFERENCE MESH | list\n");
    return 2;
}
