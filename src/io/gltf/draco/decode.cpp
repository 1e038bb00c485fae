#include "io/gltf/draco/draco.hpp"

#include "base/parallel.hpp"

#include <draco/compression/decode.h>
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

DracoColumn column_of(const ::draco::Mesh& mesh, const ::draco::PointAttribute& attribute) {
    DracoColumn column;
    column.kind = kind_of(attribute.attribute_type());
    column.id = attribute.unique_id();
    column.components = attribute.num_components();
    column.normalised = attribute.normalized();
    column.data = empty_for(attribute.data_type());
    const std::size_t points = mesh.num_points(), width = attribute.num_components();
    if (points > 0 && attribute.size() == 0) fail("an attribute has no values");
    std::visit(
        [&](auto& numbers) {
            numbers.resize(points * width);
            parallel_for(points, [&](std::size_t i) {
                const auto value = attribute.mapped_index(::draco::PointIndex(static_cast<std::uint32_t>(i)));
                if (value.value() >= attribute.size())
                    fail("an attribute has fewer values than the mesh has points");
                if (!attribute.ConvertValue(value, static_cast<std::int8_t>(width), &numbers[i * width]))
                    fail("an attribute's value does not fit its type");
            });
        },
        column.data);
    if (const auto* metadata =
            mesh.GetAttributeMetadataByAttributeId(mesh.GetAttributeIdByUniqueId(column.id)))
        metadata->GetEntryString("name", &column.name);
    return column;
}

std::unique_ptr<::draco::Mesh> decode(Span bytes) {
    ::draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const auto type = ::draco::Decoder::GetEncodedGeometryType(&buffer);
    if (!type.ok()) fail(type.status().error_msg());
    if (type.value() != ::draco::TRIANGULAR_MESH) fail("it is a point cloud, and a mesh was expected");
    ::draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) fail(decoded.status().error_msg());
    return std::move(decoded).value();
}

} // namespace

bool is_draco(Span bytes) { return as_text(bytes.first(std::min<std::size_t>(bytes.size(), 5))) == "DRACO"; }

DracoMesh decode_draco(Span bytes) {
    DracoMesh result;
    try {
        const auto mesh = decode(bytes);
        result.points = mesh->num_points();
        result.triangles.resize(std::size_t{3} * mesh->num_faces());
        for (std::uint32_t f = 0; f < mesh->num_faces(); ++f)
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t point = mesh->face(::draco::FaceIndex(f))[k].value();
                if (point >= result.points)
                    fail(fmt::format("face {} refers to point {} of {}", f, point, result.points));
                result.triangles[std::size_t{3} * f + static_cast<std::size_t>(k)] = point;
            }
        for (int a = 0; a < mesh->num_attributes(); ++a)
            result.columns.push_back(column_of(*mesh, *mesh->attribute(a)));
    } catch (const std::bad_alloc&) {
        fail("it asks for more memory than there is");
    } catch (const std::length_error&) {
        fail("it asks for more memory than there is");
    }
    return result;
}

} // namespace facetmill::io
