#include "cells/write/write_cells.hpp"

#include "base/progress.hpp"
#include "cells/partition/numbering.hpp"
#include "cells/sources/rows.hpp"
#include "io/flatten.hpp"
#include "io/gltf/document/accessor.hpp"
#include "io/gltf/document/nodes.hpp"
#include "io/ply/ply.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace facetmill::cells {

namespace {

/// The cell as a separate file.
io::Bytes file_of(Mesh mesh, const WritePlace& place, const io::Codec& codec,
                  const io::WriteSettings& settings) {
    Scene scene;
    scene.unit = place.convention.unit;
    scene.up = place.convention.up;
    scene.documents = place.documents;
    Part& part = scene.parts.emplace_back();
    part.mesh = std::move(mesh);
    part.transform = place.transform;
    return std::move(codec.write(scene, settings).files.front().bytes);
}

void check_limit(std::uint64_t count, std::uint64_t most, const char* what, const io::Codec& codec) {
    if (count > most)
        throw Error(
            ErrorKind::limit, "E-SIZE",
            fmt::format("{} {} are more than the {} that {} can count", count, what, most, codec.name),
            "simplify first, or split the input");
}

/// Calls take(cell) for each cell in their order.
template <class Take>
void each_cell(const Partition& partition, Take&& take) {
    const std::size_t n = partition.tree().leaves.size();
    for (std::uint32_t leaf = 0; leaf < n; ++leaf, ProgressScope::report_item(leaf, n))
        take(partition.cell(leaf));
}

/// An upper bound of the header's size in bytes.
std::ptrdiff_t head_of(const io::Bytes& bytes) {
    constexpr std::ptrdiff_t most = 1 << 16;
    return std::min(most, static_cast<std::ptrdiff_t>(bytes.size()));
}

/// The header with these counts.
std::string with_counts(std::string_view header, std::uint64_t vertices, std::uint64_t faces) {
    std::string out;
    while (!header.empty()) {
        const std::string_view line = header.substr(0, header.find('\n'));
        header.remove_prefix(line.size() + 1);
        if (line.starts_with("element vertex"))
            out += fmt::format("element vertex {}\n", vertices);
        else if (line.starts_with("element face"))
            out += fmt::format("element face {}\n", faces);
        else
            out += fmt::format("{}\n", line);
    }
    return out;
}

/// The largest displacement of a coordinate by rounding to float32.
double rounding_of(const Mesh& mesh, const Transform& transform) {
    double most = 0;
    for (const Vec3& p : mesh.positions) {
        const Vec3 q = transform.point(p);
        for (std::size_t axis = 0; axis < 3; ++axis)
            most = std::max(most, std::abs(static_cast<double>(static_cast<float>(q[axis])) - q[axis]));
    }
    return most;
}

void write_ply(const Partition& partition, const WritePlace& place, const io::Codec& codec,
               const io::WriteSettings& settings, const std::function<void(io::Span)>& put,
               double& rounding) {
    check_limit(partition.vertices(), INT32_MAX, "vertices", codec);
    ProgressSteps steps({2, 1});
    Numbering rows(partition.tree());
    bool first = true;
    const bool flipped = place.transform.determinant() < 0;
    io::Bytes some;
    each_cell(partition, [&](Cell cell) {
        const Numbering::Numbers numbers = rows.next(cell);
        if (!settings.double_positions)
            rounding = std::max(rounding, rounding_of(cell.mesh, place.transform));
        const io::Bytes bytes = file_of(std::move(cell.mesh), place, codec, settings);
        const io::ply::Header header = io::ply::read_header(
            io::Input::of("cell", io::Bytes(bytes.begin(), bytes.begin() + head_of(bytes))));
        const std::size_t stride = row_size(header.elements.front().properties);
        if (std::exchange(first, false)) {
            const std::string text = with_counts(io::as_text(io::Span(bytes).first(header.size)),
                                                 partition.vertices(), partition.faces());
            put(std::as_bytes(std::span(text)));
        }
        some.clear();
        for (const Index v : numbers.fresh) {
            const auto row = io::Span(bytes).subspan(header.size + v * stride, stride);
            some.insert(some.end(), row.begin(), row.end());
        }
        put(some);
    });
    steps.next();
    const bool swap = settings.big_endian == (std::endian::native == std::endian::little);
    Numbering again(partition.tree());
    each_cell(partition, [&](const Cell& cell) {
        const Numbering::Numbers numbers = again.next(cell);
        some.clear();
        for (std::size_t c = 0; c + 2 < cell.mesh.corners.size(); c += 3) {
            some.push_back(std::byte{3});
            for (const std::size_t k : {c, flipped ? c + 2 : c + 1, flipped ? c + 1 : c + 2}) {
                const auto number = static_cast<std::uint32_t>(numbers.of[cell.mesh.corners[k]]);
                auto raw = std::bit_cast<std::array<std::byte, 4>>(number);
                if (swap) std::reverse(raw.begin(), raw.end());
                some.insert(some.end(), raw.begin(), raw.end());
            }
        }
        put(some);
    });
}

void write_stl(const Partition& partition, const WritePlace& place, const io::Codec& codec,
               const io::WriteSettings& settings, const std::function<void(io::Span)>& put,
               double& rounding) {
    constexpr std::size_t title = 80;
    check_limit(partition.faces(), UINT32_MAX, "triangles", codec);
    bool first = true;
    each_cell(partition, [&](Cell cell) {
        rounding = std::max(rounding, rounding_of(cell.mesh, place.transform));
        const io::Bytes bytes = file_of(std::move(cell.mesh), place, codec, settings);
        if (std::exchange(first, false)) {
            const auto count = static_cast<std::uint32_t>(partition.faces());
            put(io::Span(bytes).first(title));
            put(std::as_bytes(std::span(&count, 1)));
        }
        put(io::Span(bytes).subspan(title + sizeof(std::uint32_t)));
    });
}

void put_word(io::Bytes& to, std::uint64_t word) {
    for (int shift = 0; shift < 32; shift += 8) to.push_back(static_cast<std::byte>(word >> shift & 0xff));
}

/// The glTF document of a single mesh. Its positions, then its triangles, are in the binary chunk.
std::string document_of(const Box& box, std::uint64_t vertices, std::uint64_t faces,
                        const Transform& transform, const std::string& name) {
    constexpr int array_buffer = 34962, element_array_buffer = 34963;
    const std::uint64_t at = vertices * 12, end = at + faces * 12;
    const auto corner = [](const Vec3& p) { return Json{p.x, p.y, p.z}; };
    Json node = {{"name", name}, {"mesh", 0}};
    if (!transform.identity()) node["matrix"] = io::gltf::matrix(transform);
    const Json json = {
        {"asset", {{"version", "2.0"}, {"generator", "facetmill"}}},
        {"scene", 0},
        {"scenes", {{{"nodes", {0}}}}},
        {"nodes", {node}},
        {"meshes", {{{"name", name}, {"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}}},
        {"accessors",
         {{{"bufferView", 0},
           {"componentType", io::gltf::float32},
           {"count", vertices},
           {"type", "VEC3"},
           {"min", corner(box.min)},
           {"max", corner(box.max)}},
          {{"bufferView", 1},
           {"componentType", io::gltf::uint32},
           {"count", faces * 3},
           {"type", "SCALAR"}}}},
        {"bufferViews",
         {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", at}, {"target", array_buffer}},
          {{"buffer", 0}, {"byteOffset", at}, {"byteLength", end - at}, {"target", element_array_buffer}}}},
        {"buffers", {{{"byteLength", end}}}}};
    std::string text = io::gltf::to_string(json);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    return text;
}

/// The bounding box of the float32 positions relative to the origin.
Box rounded_box(const Partition& partition, const Vec3& origin) {
    Box box;
    each_cell(partition, [&](Cell cell) {
        for (Vec3& p : cell.mesh.positions) p = p - origin;
        io::require_floats(cell.mesh, "the mesh");
        for (const Vec3& p : cell.mesh.positions)
            box.add(Vec3{static_cast<double>(static_cast<float>(p.x)),
                         static_cast<double>(static_cast<float>(p.y)),
                         static_cast<double>(static_cast<float>(p.z))});
    });
    return box;
}

void write_glb(const Partition& partition, const WritePlace& place, const io::WriteSettings& settings,
               const std::function<void(io::Span)>& put, double& rounding) {
    constexpr std::uint64_t headers = 12 + 8 + 8, magic = 0x46546c67, json_chunk = 0x4e4f534a,
                            binary_chunk = 0x004e4942, document = 4096;
    const std::uint64_t data = 12 * (partition.vertices() + partition.faces());
    if (headers + document + data > UINT32_MAX)
        throw Error(ErrorKind::limit, "E-SIZE",
                    fmt::format("a GLB cannot be larger than 4 GiB, but this one would have {} bytes", data),
                    "write PLY, simplify first, or split the input");
    ProgressSteps steps({1, 1, 1});
    Transform there; // translation of the origin
    for (int axis = 0; axis < 3; ++axis) there.m[axis][3] = place.origin[static_cast<std::size_t>(axis)];
    const Transform node = place.transform * there;
    const std::string json = document_of(rounded_box(partition, place.origin), partition.vertices(),
                                         partition.faces(), node, settings.title);
    steps.next();
    io::Bytes some;
    for (const std::uint64_t word :
         {magic, std::uint64_t{2}, headers + json.size() + data, std::uint64_t{json.size()}, json_chunk})
        put_word(some, word);
    put(some);
    put(std::as_bytes(std::span(json)));
    some.clear();
    put_word(some, data);
    put_word(some, binary_chunk);
    put(some);
    Numbering rows(partition.tree()), again(partition.tree());
    each_cell(partition, [&](Cell cell) {
        some.clear();
        const Numbering::Numbers numbers = rows.next(cell);
        for (Vec3& p : cell.mesh.positions) p = p - place.origin;
        for (const Index v : numbers.fresh)
            for (std::size_t axis = 0; axis < 3; ++axis)
                put_word(some,
                         std::bit_cast<std::uint32_t>(static_cast<float>(cell.mesh.positions[v][axis])));
        rounding = std::max(rounding, rounding_of(cell.mesh, {}));
        put(some);
    });
    steps.next();
    each_cell(partition, [&](const Cell& cell) {
        some.clear();
        const Numbering::Numbers numbers = again.next(cell);
        for (const Index corner : cell.mesh.corners) put_word(some, numbers.of[corner]);
        put(some);
    });
}

} // namespace

std::optional<std::string> why_not_written(const io::Codec& codec, const io::WriteSettings& s) {
    if (codec.name != "ply" && codec.name != "stl" && codec.name != "glb")
        return fmt::format("{} cannot be written from cells, only binary PLY, STL and GLB can", codec.name);
    if (s.ascii) return "text cannot be written from cells";
    if (s.draco.on || s.quantize.on || s.meshopt.on) return "compression needs the whole mesh";
    if (s.lods.on || s.mesh_manifold || s.order != io::TriangleOrder::automatic)
        return "lods, mesh_manifold and order need the whole mesh";
    return {};
}

double rounding_of(const Partition& partition, const Transform& transform) {
    double most = 0;
    each_cell(partition, [&](const Cell& cell) { most = std::max(most, rounding_of(cell.mesh, transform)); });
    return most;
}

double write_cells(const Partition& partition, const WritePlace& place, const io::Codec& codec,
                   const io::WriteSettings& settings, const std::function<void(io::Span)>& put) {
    double rounding = 0;
    if (codec.name == "ply")
        write_ply(partition, place, codec, settings, put, rounding);
    else if (codec.name == "stl")
        write_stl(partition, place, codec, settings, put, rounding);
    else
        write_glb(partition, place, settings, put, rounding);
    return rounding;
}

} // namespace facetmill::cells
