#include "io/gltf/draco/draco.hpp"
#include "io/gltf/draco/dequantise.hpp"
#include "io/gltf/draco/quantise.hpp"

#include "io/gltf/gltf.hpp"

#include "base/hash.hpp"
#include "base/progress.hpp"
#include "parallel/allocation_cap.hpp"
#include "parallel/memory.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <draco/compression/decode.h>
#include <draco/compression/expert_encode.h>
#include <draco/compression/point_cloud/point_cloud_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>
#include <fmt/format.h>
#include <new>
#include <stdexcept>

namespace facetmill::io {

namespace {

[[noreturn]] void fail(const std::string& why) {
    throw Error(ErrorKind::malformed, "E-DRACO", "the Draco data cannot be decoded: " + why);
}

DracoKind kind_of(::draco::GeometryAttribute::Type type) {
    switch (type) {
    case ::draco::GeometryAttribute::POSITION:
        return DracoKind::position;
    case ::draco::GeometryAttribute::NORMAL:
        return DracoKind::normal;
    case ::draco::GeometryAttribute::TEX_COORD:
        return DracoKind::uv;
    case ::draco::GeometryAttribute::COLOR:
        return DracoKind::colour;
    default:
        return DracoKind::generic;
    }
}

AttributeData empty_for(::draco::DataType type) {
    switch (type) {
    case ::draco::DT_INT8:
        return std::vector<std::int8_t>{};
    case ::draco::DT_BOOL:
    case ::draco::DT_UINT8:
        return std::vector<std::uint8_t>{};
    case ::draco::DT_INT16:
        return std::vector<std::int16_t>{};
    case ::draco::DT_UINT16:
        return std::vector<std::uint16_t>{};
    case ::draco::DT_INT32:
    case ::draco::DT_INT64:
        return std::vector<std::int32_t>{};
    case ::draco::DT_UINT32:
    case ::draco::DT_UINT64:
        return std::vector<std::uint32_t>{};
    case ::draco::DT_FLOAT64:
        return std::vector<double>{};
    default:
        return std::vector<float>{};
    }
}

/// False when the value does not fit its type or its memory.
template <class T>
bool copy_value(const ::draco::PointAttribute& attribute, ::draco::AttributeValueIndex value,
                std::size_t width, T* to) {
    if (attribute.data_type() != ::draco::DT_BOOL)
        return attribute.ConvertValue(value, static_cast<std::int8_t>(width), to);
    const std::uint8_t* bytes = attribute.GetAddress(value); // the library loads any byte as a bool
    if (!attribute.IsAddressValid(bytes + width - 1)) return false;
    std::transform(bytes, bytes + width, to, [](std::uint8_t byte) { return T(byte != 0); });
    return true;
}

DracoColumn column_of(const ::draco::PointCloud& mesh, const ::draco::PointAttribute& attribute) {
    DracoColumn column;
    column.kind = kind_of(attribute.attribute_type());
    column.id = attribute.unique_id();
    column.components = attribute.num_components();
    column.normalised = attribute.normalized();
    column.data = empty_for(attribute.data_type());
    const std::size_t points = mesh.num_points();
    if (points > 0 && attribute.size() == 0) fail("an attribute has no values");
    const auto computed = dequantised(attribute);
    if (computed) {
        column.components = computed->components;
        column.data = std::vector<float>{};
    }
    const auto width = static_cast<std::size_t>(column.components);
    std::visit(
        [&](auto& numbers) {
            numbers.resize(points * width);
            parallel_for(points, [&](std::size_t i) {
                const auto value = attribute.mapped_index(::draco::PointIndex(static_cast<std::uint32_t>(i)));
                if (value.value() >= attribute.size())
                    fail("an attribute has fewer values than the mesh has points");
                if (computed)
                    std::copy_n(&computed->numbers[value.value() * width], width, &numbers[i * width]);
                else if (!copy_value(attribute, value, width, &numbers[i * width]))
                    fail("an attribute's value does not fit its type");
            });
        },
        column.data);
    if (const auto* metadata =
            mesh.GetAttributeMetadataByAttributeId(mesh.GetAttributeIdByUniqueId(column.id)))
        metadata->GetEntryString("name", &column.name);
    return column;
}

std::uint32_t decode_count(::draco::DecoderBuffer& buffer, bool variable) {
    std::uint32_t count = 0;
    if (!(variable ? ::draco::DecodeVarint(&count, &buffer) : buffer.Decode(&count)))
        fail("it ends in its header");
    return count;
}

/// Refuses what the library's decoder of k-d trees takes without a look: attributes without components, and
/// more points in the tree than the header has, which it would write beyond the end. The buffer is behind the
/// number of points.
void check_tree(::draco::DecoderBuffer& buffer, std::uint32_t points) {
    constexpr std::uint32_t most_numbers = 256; // of a point: memory grows with its square
    const auto byte = [&] {
        std::uint8_t value = 0;
        if (!buffer.Decode(&value)) fail("it ends in its header");
        return value;
    };
    if (buffer.bitstream_version() < DRACO_BITSTREAM_VERSION(2, 3))
        fail("its points are in a k-d tree of an old version");
    if (byte() != 1) fail("its points are in several k-d trees");
    const std::uint32_t attributes = decode_count(buffer, true);
    std::uint32_t numbers = 0;
    for (std::uint32_t a = 0; a < attributes; ++a) {
        byte(); // what the attribute is
        byte(); // the type of its numbers
        const std::uint8_t components = byte();
        byte();                     // normalised
        decode_count(buffer, true); // its id
        if (components == 0) fail("an attribute has no components");
        numbers += components;
        if (numbers > most_numbers) fail("its points have more than 256 numbers each");
    }
    byte();                      // the level of compression
    decode_count(buffer, false); // bits of a number
    const std::uint32_t in_tree = decode_count(buffer, false);
    if (attributes == 0 || in_tree != points)
        fail(fmt::format("its tree has {} points, and its header {}", in_tree, points));
}

/// Reads the numbers of faces and points that the data promises, and refuses what its bytes cannot hold or
/// memory cannot: the library takes the memory before it finds the faces. Returns
/// how many bytes the library may ask for at once: other numbers in the data say how many bits of a texture's
/// orientation there are, or how many symbols, and it takes and fills what they ask for, however few bytes
/// are left.
std::size_t check_counts(::draco::DecoderBuffer buffer, bool is_mesh) {
    ::draco::DracoHeader header;
    const auto status = ::draco::PointCloudDecoder::DecodeHeader(&buffer, &header);
    if (!status.ok()) fail(status.error_msg());
    const auto version = DRACO_BITSTREAM_VERSION(header.version_major, header.version_minor);
    buffer.set_bitstream_version(version);
    ::draco::GeometryMetadata ignored;
    if (version >= DRACO_BITSTREAM_VERSION(1, 3) && (header.flags & METADATA_FLAG_MASK) &&
        !::draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &ignored))
        fail("its metadata is damaged");
    const std::size_t bytes = static_cast<std::size_t>(buffer.remaining_size());
    const bool sequential = header.encoder_method == ::draco::MESH_SEQUENTIAL_ENCODING;
    std::uint32_t faces = 0, points = 0;
    if (!is_mesh) {
        points = decode_count(buffer, false);
        if (header.encoder_method == ::draco::POINT_CLOUD_KD_TREE_ENCODING && points > 0)
            check_tree(buffer, points);
    } else if (sequential) {
        const bool variable = version >= DRACO_BITSTREAM_VERSION(2, 2);
        faces = decode_count(buffer, variable);
        points = decode_count(buffer, variable);
    } else {
        std::uint8_t traversal = 0;
        if (!buffer.Decode(&traversal)) fail("it ends in its header");
        if (version < DRACO_BITSTREAM_VERSION(2, 2))
            decode_count(buffer, version >= DRACO_BITSTREAM_VERSION(2, 0));
        const bool variable = version >= DRACO_BITSTREAM_VERSION(2, 0);
        points = decode_count(buffer, variable);
        faces = decode_count(buffer, variable);
    }
    // The entropy coding gives much for a byte, 40 faces of a flat grid of two million; a thousand are no
    // mesh.
    constexpr std::size_t most = 1024;
    if (faces > most * bytes || points > most * bytes)
        fail(fmt::format("{} bytes cannot hold {} faces and {} points", bytes, faces, points));
    require_memory(150.0 * faces + 100.0 * points, "decoding Draco data", "use a machine with more memory");
    constexpr std::size_t point_bytes = 512; // 127 components of four bytes, as many as are written
    return at_most_memory_there((std::size_t{1} << 20) + 64 * std::size_t{faces} + point_bytes * points +
                                256 * bytes);
}

/// A draco::Mesh where is_mesh says so.
std::unique_ptr<::draco::PointCloud> decode(::draco::DecoderBuffer buffer, bool is_mesh, bool quantised) {
    ::draco::Decoder decoder;
    if (quantised) keep_quantised(decoder);
    if (!is_mesh) {
        auto decoded = decoder.DecodePointCloudFromBuffer(&buffer);
        if (!decoded.ok()) fail(decoded.status().error_msg());
        return std::move(decoded).value();
    }
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) fail(decoded.status().error_msg());
    return std::move(decoded).value();
}

/// A draco::Mesh, or the points of a cloud where contents allows it.
std::unique_ptr<::draco::PointCloud> decode(Span bytes, DracoContents contents) {
    ::draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const auto type = ::draco::Decoder::GetEncodedGeometryType(&buffer);
    if (!type.ok()) fail(type.status().error_msg());
    const bool is_mesh = type.value() == ::draco::TRIANGULAR_MESH;
    if (!is_mesh && contents == DracoContents::mesh) fail("it is a point cloud, and a mesh was expected");
    const AllocationCap cap(check_counts(buffer, is_mesh));
    auto cloud = decode(buffer, is_mesh, true);
    return has_lost_types(*cloud) ? decode(buffer, is_mesh, false) : std::move(cloud);
}

} // namespace

bool is_draco(Span bytes) { return as_text(bytes.first(std::min<std::size_t>(bytes.size(), 5))) == "DRACO"; }

namespace {

void add_triangles(const ::draco::Mesh& mesh, DracoMesh& result) {
    result.triangles.resize(std::size_t{3} * mesh.num_faces());
    const auto face = [&](std::size_t f) -> const ::draco::Mesh::Face& {
        return mesh.face(::draco::FaceIndex(static_cast<std::uint32_t>(f)));
    };
    const std::size_t faces = mesh.num_faces();
    const std::size_t bad = parallel_reduce(
        faces, faces,
        [&](std::size_t begin, std::size_t end) {
            for (std::size_t f = begin; f < end; ++f)
                for (std::size_t k = 0; k < 3; ++k) {
                    const std::uint32_t point = face(f)[k].value();
                    if (point >= result.points) return f;
                    result.triangles[3 * f + k] = point;
                }
            return faces;
        },
        [](std::size_t x, std::size_t y) { return std::min(x, y); });
    if (bad < faces)
        fail(fmt::format("face {} refers to one of points {}, {} and {}, of {}", bad, face(bad)[0].value(),
                         face(bad)[1].value(), face(bad)[2].value(), result.points));
}

} // namespace

DracoMesh decode_draco(Span bytes, DracoContents contents) {
    DracoMesh result;
    try {
        const auto cloud = decode(bytes, contents);
        result.points = cloud->num_points();
        if (const auto* mesh = dynamic_cast<const ::draco::Mesh*>(cloud.get())) add_triangles(*mesh, result);
        for (int a = 0; a < cloud->num_attributes(); ++a)
            result.columns.push_back(column_of(*cloud, *cloud->attribute(a)));
    } catch (const std::bad_alloc&) {
        fail("it asks for more memory than there is, or than its faces and points can need");
    } catch (const std::length_error&) {
        fail("it asks for more memory than there is, or than its faces and points can need");
    }
    return result;
}

void DracoDecodings::add(Span bytes, std::shared_ptr<const DracoMesh> mesh) {
    meshes_.emplace(sha256(bytes), std::move(mesh));
}

DracoMesh DracoDecodings::decode(Span bytes, DracoContents contents) const {
    const auto known = meshes_.find(sha256(bytes));
    return known == meshes_.end() ? decode_draco(bytes, contents) : *known->second;
}

DracoMesh decode_draco(Span bytes, DracoContents contents, const Decodings* known) {
    const auto* decodings = dynamic_cast<const DracoDecodings*>(known);
    return decodings ? decodings->decode(bytes, contents) : decode_draco(bytes, contents);
}

// --- encode

namespace {

using Attribute = ::draco::GeometryAttribute;

Attribute::Type type_of(const DracoColumn& column) {
    // Draco's octahedral coding of normals is for floats; other normals go as plain numbers.
    const bool floats = std::holds_alternative<std::vector<float>>(column.data);
    switch (column.kind) {
    case DracoKind::position:
        return Attribute::POSITION;
    case DracoKind::normal:
        return floats && column.components == 3 ? Attribute::NORMAL : Attribute::GENERIC;
    case DracoKind::uv:
        return floats && column.components == 2 ? Attribute::TEX_COORD : Attribute::GENERIC;
    case DracoKind::colour:
        return Attribute::COLOR;
    default:
        return Attribute::GENERIC;
    }
}

::draco::DataType data_type(const AttributeData& data) {
    static constexpr ::draco::DataType types[] = {::draco::DT_FLOAT32, ::draco::DT_FLOAT64, ::draco::DT_UINT8,
                                                  ::draco::DT_INT8,    ::draco::DT_UINT16,  ::draco::DT_INT16,
                                                  ::draco::DT_UINT32,  ::draco::DT_INT32};
    return types[data.index()];
}

/// The points, those of one vertex behind each other, in their order.
std::vector<Index> points_by_vertex(const DracoInput& input) {
    std::vector<std::size_t> first(input.vertices.size() / 3 + 1);
    for (const Index v : input.point_vertex) ++first[v];
    exclusive_scan(first);
    std::vector<Index> points(input.point_vertex.size());
    for (Index p = 0; p < points.size(); ++p) points[first[input.point_vertex[p]]++] = p;
    return points;
}

/// For each point the first one of its vertex that has the same bytes: Draco sees a seam of an attribute
/// where the points of a vertex have different values of it, whatever these are. Only the last few of a
/// vertex are compared, so that it stays linear.
std::vector<Index> first_with_value(const char* bytes, std::size_t stride, const DracoInput& input,
                                    const std::vector<Index>& points) {
    constexpr std::size_t compared = 32;
    std::vector<Index> first(points.size());
    std::size_t begin = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Index p = points[i];
        if (input.point_vertex[p] != input.point_vertex[points[begin]]) begin = i;
        first[p] = p;
        for (std::size_t k = std::max(begin, i - std::min(i, compared)); k < i && first[p] == p; ++k)
            if (std::memcmp(bytes + stride * points[k], bytes + stride * p, stride) == 0)
                first[p] = first[points[k]];
    }
    return first;
}

int add_column(::draco::PointCloud& mesh, const DracoColumn& column, const DracoInput& input,
               const std::vector<Index>& points) {
    return std::visit(
        [&](const auto& numbers) {
            const std::size_t stride = sizeof(numbers[0]) * static_cast<std::size_t>(column.components);
            Attribute attribute;
            attribute.Init(type_of(column), nullptr, static_cast<std::uint8_t>(column.components),
                           data_type(column.data), column.normalised, static_cast<std::int64_t>(stride), 0);
            const auto* bytes = reinterpret_cast<const char*>(numbers.data());
            const std::vector<Index> first = first_with_value(bytes, stride, input, points);
            std::vector<Index> value(first.size());
            Index values = 0;
            for (Index p = 0; p < first.size(); ++p)
                if (first[p] == p) value[p] = values++;
            const int id = mesh.AddAttribute(attribute, false, values);
            auto* added = mesh.attribute(id);
            for (Index p = 0; p < first.size(); ++p) {
                if (first[p] == p)
                    added->buffer()->Write(static_cast<std::int64_t>(value[p] * stride), bytes + p * stride,
                                           stride);
                added->SetPointMapEntry(::draco::PointIndex(p),
                                        ::draco::AttributeValueIndex(value[first[p]]));
            }
            return id;
        },
        column.data);
}

/// Positions have a value per vertex and a mapping from points: Draco then knows which points are one vertex.
int add_positions(::draco::PointCloud& mesh, const DracoInput& input) {
    Attribute attribute;
    attribute.Init(Attribute::POSITION, nullptr, 3, ::draco::DT_FLOAT32, false, 3 * sizeof(float), 0);
    const std::size_t vertices = input.vertices.size() / 3;
    const int id = mesh.AddAttribute(attribute, false, static_cast<std::uint32_t>(vertices));
    auto* positions = mesh.attribute(id);
    if (vertices > 0)
        positions->buffer()->Write(0, input.vertices.data(), input.vertices.size() * sizeof(float));
    for (std::size_t p = 0; p < input.point_vertex.size(); ++p)
        positions->SetPointMapEntry(::draco::PointIndex(static_cast<std::uint32_t>(p)),
                                    ::draco::AttributeValueIndex(input.point_vertex[p]));
    return id;
}

int bits_of(const DracoColumn& column, const DracoSettings& settings) {
    switch (type_of(column)) {
    case Attribute::NORMAL:
        return settings.normal_bits;
    case Attribute::TEX_COORD:
        return settings.uv_bits;
    case Attribute::COLOR:
        return settings.colour_bits;
    default:
        return settings.generic_bits;
    }
}

/// The input with numbers that are quantised alike on every processor, and the grids of its columns.
struct Settled {
    DracoInput input;
    DracoGrid positions;
    std::vector<std::optional<DracoGrid>> grids; ///< of float columns that are no normals
};

constexpr int whole_bits = 24; // which a float32 holds exactly

bool are_whole(const std::vector<float>& numbers) {
    return std::all_of(numbers.begin(), numbers.end(),
                       [](float x) { return x >= 0 && x < (1 << whole_bits) && x == std::floor(x); });
}

/// The grid whose steps are 1.
DracoGrid whole_numbers(int components) {
    return {std::vector<float>(static_cast<std::size_t>(components), 0.0F), float((1 << whole_bits) - 1),
            whole_bits};
}

/// octahedral: how normals are quantised; else as plain numbers.
Settled settle_all(const DracoInput& given, const DracoSettings& settings, bool octahedral) {
    Settled out{given,
                {{given.origin[0], given.origin[1], given.origin[2]},
                 given.range,
                 bits_as_fine(settings.position_bits, given.extent, given.range)},
                {}};
    settle(out.input.vertices, out.positions);
    for (auto& column : out.input.columns) {
        auto& grid = out.grids.emplace_back();
        auto* floats = std::get_if<std::vector<float>>(&column.data);
        if (!floats) continue;
        const int bits = bits_of(column, settings);
        if (octahedral && type_of(column) == Attribute::NORMAL) {
            settle_normals(*floats, bits);
        } else if (column.kind == DracoKind::identifier && are_whole(*floats)) {
            grid = whole_numbers(column.components);
        } else {
            grid = grid_of(*floats, column.components, bits);
            settle(*floats, *grid);
        }
    }
    return out;
}

struct Encoded {
    bool ok = false;
    Bytes bytes;
    std::string why;
};

Encoded encode(::draco::ExpertEncoder& encoder, int method, const Settled& settled,
               const DracoSettings& settings, int position, const std::vector<int>& columns) {
    const DracoInput& input = settled.input;
    encoder.SetSpeedOptions(settings.speed, settings.speed);
    encoder.SetEncodingMethod(method);
    encoder.SetAttributeExplicitQuantization(position, settled.positions.bits, 3, input.origin, input.range);
    for (std::size_t c = 0; c < columns.size(); ++c)
        if (const auto& grid = settled.grids[c])
            encoder.SetAttributeExplicitQuantization(columns[c], grid->bits, input.columns[c].components,
                                                     grid->origin.data(), grid->range);
        else if (std::holds_alternative<std::vector<float>>(input.columns[c].data))
            encoder.SetAttributeQuantization(columns[c], bits_of(input.columns[c], settings));
    ::draco::EncoderBuffer buffer;
    const auto status = encoder.EncodeToBuffer(&buffer);
    if (!status.ok()) return {false, {}, status.error_msg()};
    Bytes bytes(buffer.size());
    std::memcpy(bytes.data(), buffer.data(), buffer.size());
    return {true, std::move(bytes), {}};
}

} // namespace

void set_draco_grid(const Mesh& mesh, DracoInput& input) {
    const Box box = mesh.bounds();
    const auto not_below = [](double x) {
        const auto rounded = static_cast<float>(x);
        return static_cast<double>(rounded) < x ? std::nextafter(rounded, HUGE_VALF) : rounded;
    };
    float range = 0;
    input.extent = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        input.origin[i] = storable_below(-not_below(-box.min[i]));
        range = std::max(range, not_below(box.max[i] - static_cast<double>(input.origin[i])));
        input.extent = std::max(input.extent, not_below(box.max[i] - box.min[i]));
    }
    input.range = storable_above(input.extent > 0 ? range : 1);
}

void set_whole_steps(DracoInput& input, int bits) {
    input.range = input.extent = static_cast<float>((std::int64_t{1} << bits) - 1);
}

void widen_draco_grid(DracoInput& input, double step, int bits) {
    const auto range = static_cast<float>(step * (std::ldexp(1.0, bits) - 1));
    if (!(range > input.range) || !std::isfinite(range)) return;
    input.extent = range;
    input.range = storable_above(range);
}

std::vector<bool> degenerate_faces(const std::vector<Index>& triangles,
                                   const std::vector<Index>& point_vertex) {
    std::vector<bool> degenerate(triangles.size() / 3);
    for (std::size_t f = 0; f < degenerate.size(); ++f) {
        const Index a = point_vertex[triangles[3 * f]], b = point_vertex[triangles[3 * f + 1]],
                    c = point_vertex[triangles[3 * f + 2]];
        degenerate[f] = a == b || b == c || c == a;
    }
    return degenerate;
}

DracoOutput encode_draco(const DracoInput& given, const DracoSettings& settings) {
    ProgressSteps steps({3, 10, 6});
    const Settled settled = settle_all(given, settings, true);
    const DracoInput& input = settled.input;
    ::draco::Mesh mesh;
    mesh.set_num_points(static_cast<std::uint32_t>(input.point_vertex.size()));
    const std::size_t faces = input.triangles.size() / 3;
    mesh.SetNumFaces(faces);
    for (std::size_t f = 0; f < faces; ++f)
        mesh.SetFace(::draco::FaceIndex(static_cast<std::uint32_t>(f)),
                     {::draco::PointIndex(input.triangles[3 * f]),
                      ::draco::PointIndex(input.triangles[3 * f + 1]),
                      ::draco::PointIndex(input.triangles[3 * f + 2])});
    const int position = add_positions(mesh, input);
    std::vector<int> columns;
    const std::vector<Index> points = points_by_vertex(input);
    for (const auto& column : input.columns) columns.push_back(add_column(mesh, column, input, points));

    DracoOutput output;
    output.position_id = mesh.attribute(position)->unique_id();
    for (const int id : columns) output.ids.push_back(mesh.attribute(id)->unique_id());
    std::string why;
    for (const bool sequential : {false, true}) {
        if (input.keep_order && !sequential) continue;
        steps.next();
        ::draco::ExpertEncoder encoder(mesh);
        Encoded encoded = encode(
            encoder, sequential ? ::draco::MESH_SEQUENTIAL_ENCODING : ::draco::MESH_EDGEBREAKER_ENCODING,
            settled, settings, position, columns);
        why = encoded.why;
        if (!encoded.ok) continue;
        steps.next();
        DracoMesh decoded = decode_draco(encoded.bytes);
        if (decoded.triangles.size() != input.triangles.size()) continue;
        output.bytes = std::move(encoded.bytes);
        for (const auto& column : decoded.columns)
            if (column.id == output.position_id) output.positions = column;
        put_on_grid(std::get<std::vector<float>>(output.positions.data), settled.positions);
        output.decoded = std::make_shared<const DracoMesh>(std::move(decoded));
        output.sequential = sequential;
        return output;
    }
    throw Error(ErrorKind::stage, "E-DRACO",
                "Draco cannot encode the mesh" + (why.empty() ? why : ": " + why), "write without draco");
}

Bytes encode_draco_points(const DracoInput& given, const DracoSettings& settings) {
    const Settled settled = settle_all(given, settings, false); // the tree knows no octahedra
    const DracoInput& input = settled.input;
    ::draco::PointCloud cloud;
    cloud.set_num_points(static_cast<std::uint32_t>(input.point_vertex.size()));
    const int position = add_positions(cloud, input);
    std::vector<int> columns;
    const std::vector<Index> points = points_by_vertex(input);
    for (const auto& column : input.columns) columns.push_back(add_column(cloud, column, input, points));
    std::string why;
    for (const int method :
         {::draco::POINT_CLOUD_KD_TREE_ENCODING, ::draco::POINT_CLOUD_SEQUENTIAL_ENCODING}) {
        ::draco::ExpertEncoder encoder(cloud);
        Encoded encoded = encode(encoder, method, settled, settings, position, columns);
        if (encoded.ok &&
            decode_draco(encoded.bytes, DracoContents::mesh_or_points).points == cloud.num_points())
            return std::move(encoded.bytes);
        why = encoded.why;
    }
    throw Error(ErrorKind::stage, "E-DRACO",
                "Draco cannot encode the points" + (why.empty() ? why : ": " + why), "write PLY or glTF");
}

// --- How many bits of position keep vertices apart.

namespace {

using Place = std::array<std::uint32_t, 3>;

/// The number of different places.
std::size_t count_positions(std::vector<Place>& places) {
    for (const std::size_t i : {0u, 1u, 2u})
        radix_sort(
            places, [i](const Place& p) { return p[i]; }, 32);
    std::atomic<std::size_t> count = 0;
    parallel_chunks(places.size(), [&](std::size_t begin, std::size_t end) {
        std::size_t here = 0;
        for (std::size_t i = begin; i < end; ++i) here += i == 0 || places[i] != places[i - 1];
        count += here;
    });
    return count;
}

/// The step of the grid at each vertex, as it is written, or the coordinates' own bits.
std::vector<Place> places_of(const Mesh& mesh, const DracoInput& grid, std::optional<int> bits) {
    std::vector<Place> places(mesh.vertex_count());
    const float density = bits ? DracoGrid{{}, grid.range, *bits}.density() : 0;
    parallel_for(places.size(), [&](std::size_t v) {
        for (std::size_t i = 0; i < 3; ++i) {
            const float x = static_cast<float>(mesh.positions[v][i]), origin = grid.origin[i];
            places[v][i] = bits ? step_of(settled(x, origin, density), origin, density)
                                : std::bit_cast<std::uint32_t>(x - origin + 0.0f); // -0 is 0
        }
    });
    return places;
}

} // namespace

std::optional<int> bits_that_keep_distinct(const Mesh& mesh, int min_bits) {
    DracoInput grid;
    set_draco_grid(mesh, grid);
    std::vector<Place> places = places_of(mesh, grid, {});
    const std::size_t given = count_positions(places);
    for (int bits = min_bits; bits <= 24; ++bits) {
        places = places_of(mesh, grid, bits);
        if (count_positions(places) == given) return bits;
    }
    return {};
}

} // namespace facetmill::io
