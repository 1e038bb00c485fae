#include "io/gltf/draco/dequantise.hpp"
#include "io/gltf/draco/draco.hpp"

#include "base/hash.hpp"
#include "parallel/allocation_cap.hpp"
#include "parallel/memory.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <draco/compression/decode.h>
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
    const std::uint8_t* bytes = attribute.GetAddress(value); // the library would load any byte as a bool
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

/// Refuses input that the library's k-d tree decoder does not check. The input may have attributes without
/// components, or more points in the tree than in the header, which would overflow memory. The buffer is
/// positioned after the number of points.
void check_tree(::draco::DecoderBuffer& buffer, std::uint32_t points) {
    constexpr std::uint32_t most_numbers = 256; // numbers per point; memory grows with the square
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
        byte(); // attribute kind
        byte(); // number type
        const std::uint8_t components = byte();
        byte();                     // normalised
        decode_count(buffer, true); // id
        if (components == 0) fail("an attribute has no components");
        numbers += components;
        if (numbers > most_numbers) fail("its points have more than 256 numbers each");
    }
    byte();                      // compression level
    decode_count(buffer, false); // bits per number
    const std::uint32_t in_tree = decode_count(buffer, false);
    if (attributes == 0 || in_tree != points)
        fail(fmt::format("its tree has {} points, but its header gives {}", in_tree, points));
}

/// Reads the declared numbers of faces and points. Refuses numbers that the bytes or the memory cannot hold,
/// because the library allocates before it decodes. Returns the number of bytes that the library may request
/// at once. Other numbers in the data, such as texture orientations or symbols, also make it allocate,
/// however few bytes are left.
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
    // Entropy coding is very compact: about 40 faces per byte for a flat grid of two million. A thousand per
    // byte is not a real mesh.
    constexpr std::size_t most = 1024;
    if (faces > most * bytes || points > most * bytes)
        fail(fmt::format("{} bytes cannot hold {} faces and {} points", bytes, faces, points));
    require_memory(150.0 * faces + 100.0 * points, "decoding Draco data", "use a machine with more memory");
    constexpr std::size_t point_bytes = 512; // 127 components of four bytes, the maximum that is written
    return at_most_memory_there((std::size_t{1} << 20) + 64 * std::size_t{faces} + point_bytes * points +
                                256 * bytes);
}

/// Returns a draco::Mesh if is_mesh is set.
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

/// Returns a draco::Mesh, or the points of a cloud if contents allows it.
std::unique_ptr<::draco::PointCloud> decode(Span bytes, DracoContents contents) {
    ::draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const auto type = ::draco::Decoder::GetEncodedGeometryType(&buffer);
    if (!type.ok()) fail(type.status().error_msg());
    const bool is_mesh = type.value() == ::draco::TRIANGULAR_MESH;
    if (!is_mesh && contents == DracoContents::mesh) fail("it is a point cloud, but a mesh was expected");
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

std::size_t entries_of(const ::draco::Metadata& metadata) {
    std::size_t count = metadata.entries().size();
    for (const auto& [name, below] : metadata.sub_metadatas()) count += entries_of(*below);
    return count;
}

/// The number of entries of metadata, without the names of attributes.
std::size_t unread_metadata(const ::draco::PointCloud& cloud) {
    const ::draco::GeometryMetadata* const all = cloud.GetMetadata();
    if (!all) return 0;
    std::size_t count = entries_of(*all);
    for (const auto& attribute : all->attribute_metadatas())
        count += entries_of(*attribute) - attribute->entries().count("name");
    return count;
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
        result.metadata = unread_metadata(*cloud);
    } catch (const std::bad_alloc&) {
        fail("it needs more memory than is available, or than its faces and points justify");
    } catch (const std::length_error&) {
        fail("it needs more memory than is available, or than its faces and points justify");
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

} // namespace facetmill::io
