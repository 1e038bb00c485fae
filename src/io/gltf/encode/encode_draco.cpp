// A primitive under KHR_draco_mesh_compression.
#include "io/gltf/encode/encode.hpp"

#include "base/error.hpp"
#include "io/gltf/draco/draco.hpp"
#include "io/gltf/read/features.hpp"

#include <algorithm>

namespace facetmill::io::gltf {

namespace {

/// A table of the faces that are marked, or of the faces that are not.
Table part_of(const Table& table, const std::vector<bool>& marked, bool wanted) {
    Table part{table.primitive, {}, {}};
    std::vector<Index> number(table.wedges.size(), none);
    for (std::size_t c = 0; c < table.indices.size(); ++c)
        if (marked[c / 3] == wanted) number[table.indices[c]] = 0;
    for (std::size_t w = 0; w < number.size(); ++w) {
        if (number[w] == none) continue;
        number[w] = static_cast<Index>(part.wedges.size());
        part.wedges.push_back(table.wedges[w]);
    }
    for (std::size_t c = 0; c < table.indices.size(); ++c)
        if (marked[c / 3] == wanted) part.indices.push_back(number[table.indices[c]]);
    return part;
}

DracoKind kind_of(const std::string& semantic) {
    if (semantic == "NORMAL") return DracoKind::normal;
    if (semantic.rfind("TEXCOORD_", 0) == 0) return DracoKind::uv;
    if (is_feature_id(semantic)) return DracoKind::identifier;
    return semantic.rfind("COLOR_", 0) == 0 ? DracoKind::colour : DracoKind::generic;
}

/// Stores positions per vertex, so that Draco treats seams as seams and not as gaps.
void set_positions(const Mesh& mesh, const Table& table, DracoInput& input) {
    std::vector<std::pair<Index, Index>> order; // pairs of vertex and point
    for (Index p = 0; p < table.wedges.size(); ++p)
        order.emplace_back(mesh.vertex_of_wedge(table.wedges[p]), p);
    std::sort(order.begin(), order.end());
    std::vector<Index> one_wedge_each;
    input.point_vertex.resize(table.wedges.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i == 0 || order[i].first != order[i - 1].first)
            one_wedge_each.push_back(table.wedges[order[i].second]);
        input.point_vertex[order[i].second] = static_cast<Index>(one_wedge_each.size() - 1);
    }
    input.vertices = positions_of(mesh, one_wedge_each);
}

const DracoColumn& decoded_column(const DracoOutput& output, std::uint32_t id) {
    for (const auto& column : output.decoded->columns)
        if (column.id == id) return column;
    throw Error(ErrorKind::bug, "E-DRACO", "Draco lost an attribute that it was given");
}

} // namespace

std::vector<Table> draco_tables(const Mesh& mesh, std::vector<Table> tables, bool targets,
                                const EncodeSettings& settings, EncodedMesh& out) {
    if (targets) return tables;
    std::vector<Table> all;
    for (Table& table : tables) {
        std::vector<Index> vertices;
        for (const Index w : table.wedges) vertices.push_back(mesh.vertex_of_wedge(w));
        const std::vector<bool> degenerate = degenerate_faces(table.indices, vertices);
        const auto count = static_cast<std::size_t>(std::count(degenerate.begin(), degenerate.end(), true));
        if (count == 0 || count == degenerate.size()) {
            all.push_back(std::move(table));
            continue;
        }
        all.push_back(part_of(table, degenerate, false));
        if (settings.draco.keep_degenerate)
            all.push_back(part_of(table, degenerate, true));
        else
            out.dropped_faces += count;
    }
    return all;
}

void encode_draco_primitive(Builder& builder, const Mesh& mesh, const Table& table,
                            const std::vector<Column>& columns, const EncodeSettings& settings,
                            Json& primitive) {
    DracoInput input;
    set_draco_grid(mesh, input); // uses the whole mesh, so that points on common borders match
    const int bits = bits_or_usual(settings.draco.position_bits);
    if (settings.whole_positions) set_whole_steps(input, bits);
    set_draco_lattice(mesh, settings.lattice.origin, settings.lattice.step, input, bits);
    set_positions(mesh, table, input);
    input.triangles = table.indices;
    std::vector<const Column*> used;
    for (const auto& column : columns) {
        if (column.target >= 0) input.keep_order = true;
        if (column.target >= 0 || !has_column(mesh, table.primitive, column)) continue;
        used.push_back(&column);
        input.columns.push_back({"", kind_of(column.semantic), 0, column.data.components,
                                 column.data.normalised, gathered(mesh, column, table.wedges)});
    }
    DracoOutput output = encode_draco(input, settings.draco);

    const auto accessors = [&] {
        Json ids = object_of("POSITION", output.position_id), attributes = Json::object();
        attributes["POSITION"] = builder.add_accessor(accessor_json(output.positions.data, 3, false, true));
        for (std::size_t c = 0; c < used.size(); ++c) {
            const auto& decoded = decoded_column(output, output.ids[c]);
            ids[used[c]->semantic] = output.ids[c];
            attributes[used[c]->semantic] = builder.add_accessor(
                accessor_json(decoded.data, decoded.components, used[c]->data.normalised, false));
        }
        const bool wide = output.decoded->points > 65535;
        Json made = object_of("attributes", std::move(attributes));
        made["indices"] =
            builder.add_accessor(object_of("componentType", wide ? int(uint32) : int(uint16), "count",
                                           output.decoded->triangles.size(), "type", "SCALAR"));
        made["extensions"]["KHR_draco_mesh_compression"]["attributes"] = std::move(ids);
        return made;
    };
    if (settings.draco.keep_decoded) builder.decoded.add(output.bytes, output.decoded);
    std::string names;
    for (const Column* column : used) names += column->semantic + " ";
    const Json made = builder.add_compressed(std::move(output.bytes), names, accessors);
    primitive["attributes"] = made["attributes"];
    primitive["indices"] = made["indices"];
    if (input.keep_order) primitive["targets"] = add_targets(builder, mesh, columns, table.wedges);
    drop_baseless_targets(builder, primitive);
    primitive["extensions"]["KHR_draco_mesh_compression"] =
        object_of("bufferView", made["extensions"]["KHR_draco_mesh_compression"]["bufferView"], "attributes",
                  made["extensions"]["KHR_draco_mesh_compression"]["attributes"]);
    builder.use_extension("KHR_draco_mesh_compression", true);
}

} // namespace facetmill::io::gltf
