#include "io/gltf/draco/draco.hpp"
#include "io/gltf/draco/quantise.hpp"

#include "base/progress.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <draco/compression/expert_encode.h>

namespace facetmill::io {

namespace {

using Attribute = ::draco::GeometryAttribute;

Attribute::Type type_of(const DracoColumn& column) {
    // Draco's octahedral coding of normals is for floats; other normals are stored as plain numbers.
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

/// The points grouped by vertex, otherwise in order.
std::vector<Index> points_by_vertex(const DracoInput& input) {
    std::vector<std::size_t> first(input.vertices.size() / 3 + 1);
    for (const Index v : input.point_vertex) ++first[v];
    exclusive_scan(first);
    std::vector<Index> points(input.point_vertex.size());
    for (Index p = 0; p < points.size(); ++p) points[first[input.point_vertex[p]]++] = p;
    return points;
}

/// For each point, the first point of its vertex with the same bytes. Draco makes an attribute seam where the
/// points of a vertex have different value indices, whatever the values are. Only the last few points of a
/// vertex are compared, so that the time stays linear.
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

/// Stores positions per vertex with a mapping from points, so that Draco knows which points share a vertex.
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

/// The input with numbers that round identically on every processor, and the grids of its columns.
struct Settled {
    DracoInput input;
    DracoGrid positions;
    std::vector<std::optional<DracoGrid>> grids; ///< grids of float columns except normals
};

constexpr int whole_bits = 24; // integers up to 24 bits are exact in float32

bool are_whole(const std::vector<float>& numbers) {
    return std::all_of(numbers.begin(), numbers.end(),
                       [](float x) { return x >= 0 && x < (1 << whole_bits) && x == std::floor(x); });
}

/// The grid with a step of 1.
DracoGrid whole_numbers(int components) {
    return {std::vector<float>(static_cast<std::size_t>(components), 0.0F), float((1 << whole_bits) - 1),
            whole_bits};
}

/// octahedral: quantises normals for the octahedral coding, otherwise as plain numbers.
Settled settle_all(const DracoInput& given, const DracoSettings& settings, bool octahedral) {
    Settled out{given,
                {{given.origin[0], given.origin[1], given.origin[2]},
                 given.range,
                 bits_as_fine(bits_or_usual(settings.position_bits), given.extent, given.range)},
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
    const int speed = static_cast<int>(settings.speed);
    encoder.SetSpeedOptions(speed, speed);
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
    const Settled settled = settle_all(given, settings, false); // the tree has no octahedral coding
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

} // namespace facetmill::io
