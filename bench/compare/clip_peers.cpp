// clip_peers list: the peers. clip_peers run PEER MESH: clips a closed mesh by an oblique plane through its
// centre, in this process, and prints as JSON what it took. bench/compare/clip.py makes a table of it.

#include "compare/cgal_clip.hpp"
#include "compare/clock.hpp"
#include "geometry/clip/clip.hpp"
#include "geometry/section/section.hpp"
#include "io/codec.hpp"

#include <fmt/format.h>
#include <fstream>
#include <functional>
#include <map>
#include <string>

using namespace facetmill;

namespace {

/// Value of a line of /proc/self/status, in bytes.
std::size_t status(const std::string& name) {
    std::ifstream file("/proc/self/status");
    for (std::string word; file >> word;)
        if (word == name + ":") {
            std::size_t kilobytes = 0;
            file >> kilobytes;
            return kilobytes * 1024;
        }
    return 0;
}

/// What a call took: time, and how far memory went above what was there before.
struct Meter {
    bench::Clock clock;
    std::size_t above = 0, bytes_in = 0, bytes_out = 0;

    template <class Call>
    void measure(Call&& call) {
        std::ofstream("/proc/self/clear_refs") << 5; // the peak starts again from here
        const std::size_t before = status("VmRSS");
        clock.start();
        call();
        clock.stop();
        const std::size_t peak = status("VmHWM");
        above = peak > before ? peak - before : 0;
    }
};

std::size_t bytes_of(const Mesh& mesh) {
    return mesh.positions.size() * sizeof(Vec3) +
           (mesh.corners.size() + mesh.face_offsets.size()) * sizeof(Index);
}

Plane oblique(const Mesh& mesh) { return {{1, 0.7, 0.3}, mesh.bounds().centre(), 0}; }

std::size_t ours(Mesh mesh, Keep keep, Meter& meter) {
    ClipSettings settings;
    settings.planes = {oblique(mesh)};
    settings.keep = keep;
    settings.cap = true;
    meter.bytes_in = bytes_of(mesh);
    ClipResult result;
    meter.measure([&] { result = clip(std::move(mesh), settings); });
    meter.bytes_out = bytes_of(result.front) + bytes_of(result.back);
    return result.front.face_count() + result.back.face_count();
}

std::size_t sections(const Mesh& mesh, Meter& meter) {
    SectionSettings settings{oblique(mesh), {}, {}};
    const double reach = 0.35 * mesh.bounds().diagonal();
    for (int i = 0; i < 100; ++i) settings.heights.push_back(reach * (2.0 * i / 99 - 1));
    std::size_t contours = 0;
    meter.measure([&] {
        for (const Section& s : section(mesh, settings)) contours += s.contours.size();
    });
    return contours;
}

std::size_t cgal(const Mesh& mesh, Meter& meter) {
    bench::CgalClip peer(mesh);
    const Plane plane = oblique(mesh);
    meter.measure([&] { peer.clip(-plane.normal, plane.through); });
    return peer.face_count();
}

using Peer = std::function<std::size_t(const Mesh&, Meter&)>;

const std::map<std::string, Peer> peers{
    {"facetmill clip, capped", [](const Mesh& m, Meter& t) { return ours(m, Keep::front, t); }},
    {"facetmill clip, both sides capped", [](const Mesh& m, Meter& t) { return ours(m, Keep::both, t); }},
    {"facetmill 100 sections", sections},
    {"CGAL clip, clip_volume", cgal},
};

int run(const std::string& name, const char* path) {
    const auto peer = peers.find(name);
    if (peer == peers.end()) {
        fmt::print(stderr, "no peer '{}'\n", name);
        return 2;
    }
    io::ReadLog log;
    const Mesh mesh = io::read_scene(io::Input::open(path), {}, log).parts.at(0).mesh;
    Meter meter;
    const std::size_t count = peer->second(mesh, meter);
    fmt::print(
        "{{\"wall\": {:.4f}, \"cpu\": {:.4f}, \"faces\": {}, \"above\": {}, \"in\": {}, \"out\": {}}}\n",
        meter.clock.wall_seconds, meter.clock.cpu_seconds, count, meter.above, meter.bytes_in,
        meter.bytes_out);
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    const std::string command = argc > 1 ? argv[1] : "";
    if (command == "list") {
        for (const auto& [name, peer] : peers) fmt::print("{}\n", name);
        return 0;
    }
    if (command == "run" && argc == 4) return run(argv[2], argv[3]);
    fmt::print(stderr, "usage: clip_peers list | clip_peers run PEER MESH\n");
    return 2;
}
