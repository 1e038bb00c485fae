#pragma once
// What reads bytes that strangers made, each as a function that a fuzzer calls: what is read is sound or
// refused. tests/fuzz/fuzz_bytes.cpp gives them bytes for as long as it is let,
// tests/property/fuzz_corpus_test.cpp those of tests/data/fuzz.

#include "cli/pipe_syntax.hpp"
#include "io/csv.hpp"
#include "io/footprint/footprint.hpp"
#include "io/images/pixels.hpp"
#include "io/threemf/zip.hpp"
#include "support/gltf.hpp"
#include "support/mutations.hpp"
#include "support/planning.hpp"
#include "support/temporary.hpp"

#include <fmt/format.h>
#include <string_view>

namespace facetmill::test {

struct FuzzTarget {
    std::string_view name;
    /// Empty when all is well, else what went wrong.
    std::string (*trouble)(io::Bytes bytes);
};

/// The same of what may throw no other errors than those of a file that is wrong, or of files that it names.
template <class Read>
std::string trouble_of(const Read& read, bool names_files = false) {
    try {
        read();
        return "";
    } catch (const Error& error) {
        const bool fair = error.kind() == ErrorKind::malformed || error.kind() == ErrorKind::limit ||
                          error.kind() == ErrorKind::usage ||
                          (names_files && error.kind() == ErrorKind::missing);
        return fair ? "" : std::string("refused as the wrong kind: ") + error.what();
    } catch (const std::exception& error) {
        return std::string("escaped: ") + error.what();
    }
}

template <const char* Extension>
std::string trouble_of_mesh(io::Bytes bytes) {
    return trouble_reading(std::string("a.") + Extension, std::move(bytes));
}

/// The model of a 3MF archive, packed so that a damage of the archive does not hide it.
inline std::string trouble_of_model(io::Bytes bytes) {
    return trouble_reading("a.3mf", io::threemf::make_archive({{"3D/3dmodel.model", std::move(bytes)}}));
}

/// A PLY that is packed with gzip or zstd.
inline std::string trouble_of_packed(io::Bytes bytes) {
    static const TemporaryDirectory folder;
    put(folder / "a.ply", io::as_text(bytes));
    return trouble_of([&] {
        io::ReadLog log;
        io::read_scene(io::Input::open(folder / "a.ply", std::size_t{1} << 26), {}, log);
    });
}

/// Triangles under EXT_meshopt_compression: the first six bytes choose how many elements of which size,
/// under which mode and filter, the others are the stream.
inline std::string trouble_of_meshopt(io::Bytes bytes) {
    constexpr const char* modes[] = {"ATTRIBUTES", "TRIANGLES", "INDICES"};
    constexpr const char* filters[] = {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL", "COLOR"};
    bytes.resize(std::max<std::size_t>(8, bytes.size()));
    const auto byte = [&](std::size_t i) { return std::to_integer<unsigned>(bytes[i]); };
    const unsigned mode = byte(0) % 3, filter = byte(1) % 5, count = byte(2) + 256 * byte(3);
    const unsigned stride = mode == 0 ? 4 * (1 + byte(4) % 64) : 2 + 2 * (byte(4) % 2);
    const std::size_t length = bytes.size() - 8;
    const std::string view = fmt::format(
        R"({{"buffer":1,"byteOffset":0,"byteLength":{},"byteStride":{},"extensions":{{"EXT_meshopt_compression":
{{"buffer":0,"byteOffset":8,"byteLength":{},"byteStride":{},"count":{},"mode":"{}","filter":"{}"}}}}}})",
        std::size_t{stride} * count, stride, length, stride, count, modes[mode], filters[filter]);
    const bool positions = mode == 0;
    const std::string accessor =
        fmt::format(R"({{"bufferView":0,"count":{},"type":"{}","componentType":{}}})", count,
                    positions ? "VEC3" : "SCALAR",
                    positions     ? stride < 12 ? 5120 : 5126
                    : stride == 2 ? 5123
                                  : 5125);
    std::string json = fmt::format(
        R"({{"asset":{{"version":"2.0"}},"extensionsUsed":["EXT_meshopt_compression","KHR_mesh_quantization"],
"buffers":[{{"byteLength":{}}},{{"byteLength":{}}}],"bufferViews":[{}],"accessors":[{},
{{"count":65535,"type":"VEC3","componentType":5126}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":{}}}{}}}]}}],
"nodes":[{{"mesh":0}}],"scenes":[{{"nodes":[0]}}]}})",
        bytes.size(), std::size_t{stride} * count, view, accessor, positions ? 0 : 1,
        positions ? "" : ",\"indices\":0");
    json.resize((json.size() + 3) / 4 * 4, ' ');
    bytes.resize((bytes.size() + 3) / 4 * 4);
    io::Bytes glb;
    const auto add = [&](std::size_t number) {
        for (int i = 0; i < 4; ++i) glb.push_back(static_cast<std::byte>(number >> (8 * i)));
    };
    for (const std::size_t number :
         {std::size_t{0x46546C67}, std::size_t{2}, 28 + json.size() + bytes.size(), json.size()})
        add(number);
    add(0x4E4F534A);
    const io::Bytes text = to_bytes(json);
    glb.insert(glb.end(), text.begin(), text.end());
    add(bytes.size());
    add(0x004E4942);
    glb.insert(glb.end(), bytes.begin(), bytes.end());
    return trouble_reading("a.glb", std::move(glb));
}

/// The materials of an OBJ file of one triangle.
inline std::string trouble_of_materials(io::Bytes bytes) {
    static const TemporaryDirectory folder;
    static const std::filesystem::path mesh = [] {
        put(folder / "a.obj", "mtllib a.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n");
        return folder / "a.obj";
    }();
    put(folder / "a.mtl", io::as_text(bytes));
    return trouble_of([&] {
        io::ReadLog log;
        io::read_scene(io::Input::open(mesh), {}, log);
    });
}

/// Polygons to crop by.
inline std::string trouble_of_footprint(io::Bytes bytes) {
    return trouble_of([&] { io::read_footprint(io::Input::of("a.geojson", std::move(bytes))); });
}

/// Points and rays to probe.
inline std::string trouble_of_table(io::Bytes bytes) {
    return trouble_of([&] { io::read_table(io::Input::of("a.csv", std::move(bytes)), 3); });
}

/// Textures: an image of some million pixels at most, so that a run is short.
inline std::string trouble_of_image(io::Bytes bytes) {
    constexpr std::size_t most = std::size_t{1} << 20;
    return trouble_of([&] {
        const auto size = io::image_size(bytes);
        if (size && size->first * size->second > most) return;
        const auto image = io::decoded_image(bytes);
        if (image && image->rgba.size() != 4 * image->width * image->height)
            throw std::logic_error("the pixels do not fill the image");
    });
}

/// A pipeline file, planned; nothing runs.
inline std::string trouble_of_pipeline(io::Bytes bytes) {
    return trouble_of([&] { planned(std::string(io::as_text(bytes))); }, true);
}

/// A one-liner, an argument a line.
inline std::string trouble_of_pipe(io::Bytes bytes) {
    std::vector<std::string> arguments{"pipe"};
    std::istringstream lines{std::string(io::as_text(bytes))};
    for (std::string line; std::getline(lines, line);) arguments.push_back(line.substr(0, line.find('\0')));
    return trouble_of(
        [&] {
            const cli::CommandLine line(std::move(arguments));
            Problems problems;
            const Value document = cli::parse_pipe(line, 1, problems);
            if (!problems.any_errors()) pipeline::make_plan(document, {}, problems);
        },
        true);
}

inline constexpr char gltf_name[] = "gltf", glb_name[] = "glb", obj_name[] = "obj", ply_name[] = "ply",
                      stl_name[] = "stl", off_name[] = "off", drc_name[] = "drc", threemf_name[] = "3mf";

inline constexpr FuzzTarget fuzz_targets[] = {
    {gltf_name, trouble_of_mesh<gltf_name>},
    {glb_name, trouble_of_mesh<glb_name>},
    {obj_name, trouble_of_mesh<obj_name>},
    {ply_name, trouble_of_mesh<ply_name>},
    {stl_name, trouble_of_mesh<stl_name>},
    {off_name, trouble_of_mesh<off_name>},
    {drc_name, trouble_of_mesh<drc_name>},
    {threemf_name, trouble_of_mesh<threemf_name>},
    {"model", trouble_of_model},
    {"meshopt", trouble_of_meshopt},
    {"packed", trouble_of_packed},
    {"mtl", trouble_of_materials},
    {"footprint", trouble_of_footprint},
    {"csv", trouble_of_table},
    {"image", trouble_of_image},
    {"pipeline", trouble_of_pipeline},
    {"pipe", trouble_of_pipe},
};

} // namespace facetmill::test
