// read_peers PEER FILE REPEAT: reads a mesh file by one library in this process, and prints as JSON the
// fastest times of so many reads, what they gave, and how much memory the first one took. For
// bench/compare/reading.py; without arguments it names the peers.

#include "compare/clock.hpp"
#include "io/codec.hpp"

#include <algorithm>
#include <cstdlib>
#include <draco/compression/decode.h>
#include <fmt/format.h>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <meshoptimizer.h>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <sys/resource.h>

#ifdef FACETMILL_COMPARE_FAST_OBJ
#define FAST_OBJ_IMPLEMENTATION
#include <fast_obj.h>
#endif
#ifdef FACETMILL_COMPARE_RAPIDOBJ
#include <rapidobj/rapidobj.hpp>
#endif

using namespace facetmill;

namespace {

using Json = nlohmann::json;

std::vector<char> bytes_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error("cannot read " + path);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// What a read gave.
struct Given {
    std::size_t faces = 0, bytes = 0; ///< bytes: of positions, corners and attributes in memory; 0: not known
};

std::size_t bytes_of(const Mesh& mesh) {
    std::size_t bytes = mesh.positions.size() * sizeof(Vec3) + mesh.corners.size() * sizeof(Index) +
                        (mesh.face_offsets.size() + mesh.wedge_vertex.size()) * sizeof(Index);
    for (const Attribute& a : mesh.attributes)
        std::visit([&](const auto& v) { bytes += v.size() * sizeof(v[0]); }, a.data);
    return bytes;
}

Given by_facetmill(const std::string& path) {
    io::ReadLog log;
    const Scene scene = io::read_scene(io::Input::open(path), {}, log);
    Given given;
    for (const Part& part : scene.parts) {
        given.faces += part.mesh.face_count();
        given.bytes += bytes_of(part.mesh);
    }
    return given;
}

/// A .drc by Draco's own decoder: no positions in doubles, no checks.
Given by_draco(const std::string& path) {
    const std::vector<char> bytes = bytes_of(path);
    draco::DecoderBuffer buffer;
    buffer.Init(bytes.data(), bytes.size());
    auto mesh = draco::Decoder().DecodeMeshFromBuffer(&buffer);
    if (!mesh.ok()) throw std::runtime_error(mesh.status().error_msg());
    return {mesh.value()->num_faces(), 0};
}

void decode(const Json& view, const char* bytes, std::vector<unsigned char>& to) {
    const std::string mode = view.at("mode"), filter = view.value("filter", "NONE");
    const auto count = view.at("count").get<std::size_t>(), stride = view.at("byteStride").get<std::size_t>(),
               length = view.at("byteLength").get<std::size_t>();
    const auto* from =
        reinterpret_cast<const unsigned char*>(bytes) + view.value("byteOffset", std::size_t{0});
    to.resize(count * stride);
    const int wrong =
        mode == "ATTRIBUTES"  ? meshopt_decodeVertexBuffer(to.data(), count, stride, from, length)
        : mode == "TRIANGLES" ? meshopt_decodeIndexBuffer(to.data(), count, stride, from, length)
                              : meshopt_decodeIndexSequence(to.data(), count, stride, from, length);
    if (wrong != 0) throw std::runtime_error("a stream of meshopt cannot be decoded");
    if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(to.data(), count, stride);
    if (filter == "QUATERNION") meshopt_decodeFilterQuat(to.data(), count, stride);
    if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(to.data(), count, stride);
}

/// The streams of a GLB by meshoptimizer's own decoders, and nothing else of the file.
Given by_meshopt(const std::string& path) {
    const std::vector<char> bytes = bytes_of(path);
    const auto word = [&](std::size_t at) {
        std::uint32_t x = 0;
        std::copy_n(bytes.data() + at, 4, reinterpret_cast<char*>(&x));
        return std::size_t{x};
    };
    const Json json = Json::parse(bytes.data() + 20, bytes.data() + 20 + word(12));
    const char* binary = bytes.data() + 28 + word(12);
    Given given;
    std::vector<unsigned char> to;
    for (const Json& view : json.at("bufferViews")) {
        const Json extensions = view.value("extensions", Json::object());
        if (!extensions.contains("EXT_meshopt_compression")) continue;
        const Json& of = extensions["EXT_meshopt_compression"];
        decode(of, binary, to);
        if (of.at("mode") == "TRIANGLES") given.faces += of.at("count").get<std::size_t>() / 3;
    }
    return given;
}

#ifdef FACETMILL_COMPARE_FAST_OBJ
Given by_fast_obj(const std::string& path) {
    fastObjMesh* mesh = fast_obj_read(path.c_str());
    if (!mesh) throw std::runtime_error("fast_obj cannot read it");
    const Given given{mesh->face_count, 0};
    fast_obj_destroy(mesh);
    return given;
}
#endif

#ifdef FACETMILL_COMPARE_RAPIDOBJ
Given by_rapidobj(const std::string& path) {
    const auto result = rapidobj::ParseFile(path);
    if (result.error) throw std::runtime_error(result.error.code.message());
    Given given;
    for (const auto& shape : result.shapes) given.faces += shape.mesh.num_face_vertices.size();
    return given;
}
#endif

const std::map<std::string, std::function<Given(const std::string&)>> peers = {
    {"facetmill", by_facetmill}, {"draco", by_draco}, {"meshoptimizer", by_meshopt},
#ifdef FACETMILL_COMPARE_FAST_OBJ
    {"fast_obj", by_fast_obj},
#endif
#ifdef FACETMILL_COMPARE_RAPIDOBJ
    {"rapidobj", by_rapidobj},
#endif
};

/// The largest memory of this process so far, in bytes.
std::size_t peak() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

void run(const std::string& peer, const std::string& path, int repeat) {
    const auto& read = peers.at(peer);
    double wall = 1e9, cpu = 1e9;
    std::size_t grown = peak();
    Given given;
    for (int i = 0; i < repeat; ++i) {
        bench::Clock clock;
        clock.start();
        given = read(path);
        clock.stop();
        if (i == 0) grown = peak() - grown;
        wall = std::min(wall, clock.wall_seconds);
        cpu = std::min(cpu, clock.cpu_seconds);
    }
    fmt::print("{{\"wall\": {:.5f}, \"cpu\": {:.5f}, \"faces\": {}, \"bytes\": {}, \"peak\": {}}}\n", wall,
               cpu, given.faces, given.bytes, grown);
}

} // namespace

int main(int argc, char** argv) {
    try {
        if (argc == 4)
            run(argv[1], argv[2], std::atoi(argv[3]));
        else
            for (const auto& [name, read] : peers) fmt::print("{}\n", name);
    } catch (const std::exception& e) {
        fmt::print(stderr, "{}\n", e.what());
        return 1;
    }
    return 0;
}
