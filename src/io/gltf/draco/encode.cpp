#include "io/gltf/draco/draco.hpp"

#include <cmath>
#include <cstring>
#include <draco/compression/expert_encode.h>
#include <fmt/format.h>

namespace facetmill::io {

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

int add_column(::draco::Mesh& mesh, const DracoColumn& column) {
    return std::visit(
        [&](const auto& numbers) {
            const std::size_t stride = sizeof(numbers[0]) * static_cast<std::size_t>(column.components);
            Attribute attribute;
            attribute.Init(type_of(column), nullptr, static_cast<std::uint8_t>(column.components),
                           data_type(column.data), column.normalised, static_cast<std::int64_t>(stride), 0);
            const int id = mesh.AddAttribute(attribute, true, mesh.num_points());
            if (!numbers.empty())
                mesh.attribute(id)->buffer()->Write(0, numbers.data(), numbers.size() * sizeof(numbers[0]));
            return id;
        },
        column.data);
}

/// Positions have a value per vertex and a mapping from points: Draco then knows which points are one vertex.
int add_positions(::draco::Mesh& mesh, const DracoInput& input) {
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

struct Encoded {
    bool ok = false;
    Bytes bytes;
    std::string why;
};

Encoded encode(const ::draco::Mesh& mesh, const DracoInput& input, const DracoSettings& settings,
               bool sequential, int position, const std::vector<int>& columns) {
    ::draco::ExpertEncoder encoder(mesh);
    encoder.SetSpeedOptions(settings.speed, settings.speed);
    encoder.SetEncodingMethod(sequential ? ::draco::MESH_SEQUENTIAL_ENCODING
                                         : ::draco::MESH_EDGEBREAKER_ENCODING);
    encoder.SetAttributeExplicitQuantization(position, settings.position_bits, 3, input.origin, input.range);
    for (std::size_t c = 0; c < columns.size(); ++c)
        if (std::holds_alternative<std::vector<float>>(input.columns[c].data))
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
    float range = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        input.origin[i] = static_cast<float>(box.min[i]);
        if (static_cast<double>(input.origin[i]) > box.min[i])
            input.origin[i] = std::nextafter(input.origin[i], -HUGE_VALF);
        const double extent = box.max[i] - static_cast<double>(input.origin[i]);
        float rounded = static_cast<float>(extent);
        if (static_cast<double>(rounded) < extent) rounded = std::nextafter(rounded, HUGE_VALF);
        range = std::max(range, rounded);
    }
    input.range = range > 0 ? range : 1;
}

DracoOutput encode_draco(const DracoInput& input, const DracoSettings& settings) {
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
    for (const auto& column : input.columns) columns.push_back(add_column(mesh, column));

    DracoOutput output;
    output.position_id = mesh.attribute(position)->unique_id();
    for (const int id : columns) output.ids.push_back(mesh.attribute(id)->unique_id());
    std::string why;
    for (const bool sequential : {false, true}) {
        if (input.keep_order && !sequential) continue;
        Encoded encoded = encode(mesh, input, settings, sequential, position, columns);
        why = encoded.why;
        if (!encoded.ok) continue;
        DracoMesh decoded = decode_draco(encoded.bytes);
        if (decoded.triangles.size() != input.triangles.size()) continue;
        output.bytes = std::move(encoded.bytes);
        output.decoded = std::move(decoded);
        output.sequential = sequential;
        return output;
    }
    throw Error(ErrorKind::stage, "E-DRACO",
                "Draco cannot encode the mesh" + (why.empty() ? why : ": " + why), "write without draco");
}

} // namespace facetmill::io
