#include "io/gltf/encode/encode.hpp"

#include "geometry/triangulate/crossing_faces.hpp"
#include "io/flatten.hpp"
#include "io/gltf/document/item_references.hpp"
#include "io/gltf/encode/order.hpp"
#include "io/gltf/numbers/alike.hpp"
#include "io/gltf/read/features.hpp"
#include "parallel/parallel.hpp"

#include <cstring>
#include <fmt/format.h>

namespace facetmill::io::gltf {

namespace {

/// Numbers the wedges of a table.
class Numbering {
  public:
    explicit Numbering(std::size_t wedges) : number_(wedges, none) {}
    /// Collects the distinct wedges of the corners into the table, ascending. The table must be empty.
    void collect(Table& table, const std::vector<Index>& corners) {
        std::vector<Index>& wedges = table.wedges;
        for (const Index w : corners)
            if (number_[w] == none) {
                number_[w] = 0;
                wedges.push_back(w);
            }
        if (wedges.size() > number_.size() / 16) { // scanning all numbers is faster than sorting these
            wedges.clear();
            for (Index w = 0; w < number_.size(); ++w)
                if (number_[w] != none) wedges.push_back(w);
        } else {
            std::sort(wedges.begin(), wedges.end());
        }
        for (Index i = 0; i < table.wedges.size(); ++i) number_[table.wedges[i]] = i;
    }
    void renumber(Table& table) const {
        for (Index& w : table.indices) w = number_[w];
    }
    void forget(const Table& table) {
        for (const Index w : table.wedges) number_[w] = none;
    }

  private:
    std::vector<Index> number_;
};

/// A table for each primitive with faces. With `shared`, all tables use the same wedges.
std::vector<Table> tables_of(const Mesh& mesh, bool shared) {
    const std::size_t primitives = std::max<std::size_t>(mesh.primitives.size(), 1);
    std::vector<std::size_t> first(primitives + 1);
    std::vector<Index> faces(mesh.face_count());
    for (Index f = 0; f < mesh.face_count(); ++f) ++first[mesh.primitive_of(f)];
    exclusive_scan(first);
    auto next = first;
    for (Index f = 0; f < mesh.face_count(); ++f) faces[next[mesh.primitive_of(f)]++] = f;

    Numbering numbers(mesh.wedge_count());
    std::vector<Table> tables;
    Table common;
    if (shared) numbers.collect(common, mesh.corners);
    for (std::size_t p = 0; p < primitives; ++p) {
        if (first[p] == first[p + 1]) continue;
        Table table{static_cast<Index>(p), common.wedges, {}};
        table.indices.reserve(3 * (first[p + 1] - first[p]));
        for (std::size_t i = first[p]; i < first[p + 1]; ++i)
            for (const Index w : mesh.face_wedges(faces[i])) table.indices.push_back(w);
        if (!shared) numbers.collect(table, table.indices);
        numbers.renumber(table);
        if (!shared) numbers.forget(table);
        tables.push_back(std::move(table));
    }
    return tables;
}

Bytes index_bytes(const std::vector<Index>& indices, bool wide) {
    Bytes bytes(indices.size() * (wide ? 4 : 2));
    parallel_for(indices.size(), [&](std::size_t i) {
        if (wide) {
            std::memcpy(&bytes[4 * i], &indices[i], 4);
        } else {
            const auto narrow = static_cast<std::uint16_t>(indices[i]);
            std::memcpy(&bytes[2 * i], &narrow, 2);
        }
    });
    return bytes;
}

/// 65535 itself would restart the primitive, so it is not a valid index.
bool needs_wide(std::size_t vertices) { return vertices > 65535; }

Json index_accessor(std::size_t count, bool wide) {
    return {{"componentType", wide ? int(uint32) : int(uint16)}, {"count", count}, {"type", "SCALAR"}};
}

std::size_t add_indices(Builder& builder, const Table& table) {
    const bool wide = needs_wide(table.wedges.size());
    return builder.add_shared(index_bytes(table.indices, wide), element_buffer, 0,
                              index_accessor(table.indices.size(), wide));
}

std::size_t add_positions(Builder& builder, const Mesh& mesh, const std::vector<Index>& wedges, bool exact) {
    Stored stored = plain(positions_of(mesh, wedges), 3, false, true);
    if (!exact) return builder.add_stored(std::move(stored), array_buffer);
    std::vector<Vec3> positions;
    positions.reserve(wedges.size());
    for (const Index w : wedges) positions.push_back(mesh.positions[mesh.vertex_of_wedge(w)]);
    return builder.add_positions(std::move(stored), std::move(positions));
}

Json add_attributes(Builder& builder, const Mesh& mesh, const Table& table,
                    const std::vector<Column>& columns, const EncodeSettings& settings) {
    Json attributes = {{"POSITION", add_positions(builder, mesh, table.wedges, settings.keep_exact)}};
    for (const auto& column : columns)
        if (column.target < 0 && has_column(mesh, table.primitive, column))
            attributes[column.semantic] =
                add_vertex_data(builder, gathered(mesh, column, table.wedges), column.data.components,
                                column.data.normalised, false);
    return attributes;
}

bool is_zero(const AttributeData& data) {
    return std::visit(
        [](const auto& numbers) {
            return std::all_of(numbers.begin(), numbers.end(), [](auto x) { return x == 0; });
        },
        data);
}

/// The primitive's material, extras and extensions from the source.
Json primitive_frame(const Mesh& mesh, Index p, const EncodeSettings& settings, Builder& builder,
                     Written& written) {
    Json out = Json::object();
    if (p >= mesh.primitives.size()) return out;
    const Primitive& info = mesh.primitives[p];
    const int material = info.material == none ? -1 : settings.material(info.material);
    if (material >= 0) out["material"] = material;
    if (info.json.empty()) return out;
    const Json kept = parse_document(info.json);
    if (kept.contains("extras")) out["extras"] = kept["extras"];
    if (!kept.contains("extensions")) return out;
    for (const auto& [name, value] : kept["extensions"].items()) {
        if (name == variants_extension && settings.variants)
            if (Json variants = settings.variants(info, value); !variants.is_null()) {
                out["extensions"][name] = std::move(variants);
                continue;
            }
        std::vector<std::string> lost;
        const Json features =
            settings.keep_features
                ? features_that_hold(
                      name, value,
                      [&](const std::string& a) {
                          return info.has(a) && (mesh.find(a, Domain::wedge) || mesh.find(a, Domain::vertex));
                      },
                      lost)
                : Json(nullptr);
        if (!features.is_null()) {
            out["extensions"][name] = features;
            builder.use_extension(name, false);
        }
        if (!features.is_null() && lost.empty()) continue;
        const std::string what = lost.empty() ? "the extension" : fmt::format("{} of", fmt::join(lost, ", "));
        written.changes.push_back({name, Domain::face, AttributeChange::Kind::dropped,
                                   lost.empty() ? "an extension of a primitive that has changed"
                                                : fmt::format("{} a primitive that has changed", what)});
        written.warnings.push_back(
            {Severity::warning,
             "W-EXTENSION",
             fmt::format("part '{}': {} {} of a primitive {} dropped, because the mesh has changed",
                         settings.name, what, name, lost.empty() ? "is" : "are"),
             {},
             ""});
    }
    return out;
}

/// True if the order of vertices has a meaning: EXT_mesh_features numbers features by vertex if it names
/// neither an attribute nor a texture.
bool keeps_order(const Mesh& mesh, const EncodeSettings& settings) {
    if (settings.order == TriangleOrder::keep) return true;
    for (const Primitive& primitive : mesh.primitives) {
        if (primitive.json.find("EXT_mesh_features") == std::string::npos) continue;
        const Json::json_pointer place("/extensions/EXT_mesh_features/featureIds");
        const Json kept = parse_document(primitive.json);
        if (!kept.contains(place)) continue;
        for (const Json& ids : kept[place])
            if (!ids.contains("attribute") && !ids.contains("texture")) return true;
    }
    return false;
}

/// Writes all primitives' indices into one view, one accessor each: EXT_mesh_manifold then covers them with a
/// single accessor.
void encode_manifold(Builder& builder, const Mesh& mesh, std::vector<Table>& tables,
                     const std::vector<Column>& columns, const EncodeSettings& settings, Written& written,
                     EncodedMesh& out) {
    std::vector<Index> all;
    for (const auto& t : tables) all.insert(all.end(), t.indices.begin(), t.indices.end());
    const bool wide = needs_wide(tables[0].wedges.size());
    const std::size_t view = builder.add_view(index_bytes(all, wide), element_buffer);
    std::map<std::string, std::size_t> accessors; // an accessor per column, shared by the primitives
    const std::size_t position = add_positions(builder, mesh, tables[0].wedges, settings.keep_exact);
    const Json targets = add_targets(builder, mesh, columns, tables[0].wedges);
    std::size_t offset = 0;
    for (const auto& table : tables) {
        Json primitive = primitive_frame(mesh, table.primitive, settings, builder, written);
        primitive["attributes"] = {{"POSITION", position}};
        for (const auto& column : columns) {
            if (column.target >= 0 || !has_column(mesh, table.primitive, column)) continue;
            if (!accessors.count(column.semantic))
                accessors[column.semantic] =
                    add_vertex_data(builder, gathered(mesh, column, table.wedges), column.data.components,
                                    column.data.normalised, false);
            primitive["attributes"][column.semantic] = accessors[column.semantic];
        }
        if (!targets.is_null()) primitive["targets"] = targets;
        drop_baseless_targets(builder, primitive);
        Json accessor = {{"bufferView", view}, {"byteOffset", offset}};
        accessor.update(index_accessor(table.indices.size(), wide));
        offset += table.indices.size() * (wide ? 4 : 2);
        primitive["indices"] = builder.add_accessor(std::move(accessor));
        out.primitives.push_back(std::move(primitive));
    }
    const Json extension =
        manifold_extension(builder, mesh, tables[0].wedges, all, view, position, written, settings.name);
    if (!extension.is_null()) out.extensions = {{"EXT_mesh_manifold", extension}};
}

} // namespace

std::vector<float> positions_of(const Mesh& mesh, const std::vector<Index>& wedges) {
    std::vector<float> out(3 * wedges.size());
    parallel_for(wedges.size(), [&](std::size_t i) {
        const Vec3& p = mesh.positions[mesh.vertex_of_wedge(wedges[i])];
        // -0 would split a vertex for readers that compare bits.
        for (std::size_t c = 0; c < 3; ++c) out[3 * i + c] = static_cast<float>(p[c]) + 0.0f;
    });
    return out;
}

AttributeData gathered(const Mesh& mesh, const Column& column, const std::vector<Index>& wedges) {
    const std::size_t width = static_cast<std::size_t>(column.data.components);
    const bool vertices = column.data.domain == Domain::vertex;
    return std::visit(
        [&](const auto& from) -> AttributeData {
            std::decay_t<decltype(from)> to(wedges.size() * width);
            parallel_for(wedges.size(), [&](std::size_t i) {
                const std::size_t source = vertices ? mesh.vertex_of_wedge(wedges[i]) : wedges[i];
                for (std::size_t c = 0; c < width; ++c) to[i * width + c] = from[source * width + c];
            });
            return to;
        },
        column.data.data);
}

Json accessor_json(const AttributeData& data, int components, bool normalised, bool bounds) {
    return std::visit(
        [&](const auto& numbers) {
            const std::size_t width = static_cast<std::size_t>(components), count = numbers.size() / width;
            Json accessor = object_of("componentType", component_type_of(data));
            if (normalised) accessor["normalized"] = true;
            accessor["count"] = count;
            accessor["type"] = type_name(components);
            if (!bounds || count == 0) return accessor;
            using T = std::decay_t<decltype(numbers[0])>;
            // Integers stay integers in JSON, too.
            using Bound = std::conditional_t<std::is_integral_v<T>, std::int64_t, double>;
            std::vector<Bound> low(numbers.begin(), numbers.begin() + components), high = low;
            for (std::size_t i = 0; i < numbers.size(); ++i) {
                const auto x = static_cast<Bound>(numbers[i]);
                low[i % width] = std::min(low[i % width], x);
                high[i % width] = std::max(high[i % width], x);
            }
            accessor["min"] = low;
            accessor["max"] = high;
            return accessor;
        },
        data);
}

std::size_t add_vertex_data(Builder& builder, const AttributeData& data, int components, bool normalised,
                            bool bounds) {
    return builder.add_stored(plain(data, components, normalised, bounds), array_buffer);
}

Json add_targets(Builder& builder, const Mesh& mesh, const std::vector<Column>& columns,
                 const std::vector<Index>& wedges) {
    Json targets;
    for (const auto& column : columns) {
        if (column.target < 0) continue;
        if (targets.is_null()) targets = Json::array();
        while (targets.size() <= static_cast<std::size_t>(column.target)) targets.push_back(Json::object());
        const AttributeData data = gathered(mesh, column, wedges);
        const bool bounds = column.semantic == "POSITION";
        // An accessor without a view is all zeros, as normals often are that an exporter adds.
        targets[static_cast<std::size_t>(column.target)][column.semantic] =
            is_zero(data)
                ? builder.add_accessor(
                      accessor_json(data, column.data.components, column.data.normalised, bounds))
                : add_vertex_data(builder, data, column.data.components, column.data.normalised, bounds);
    }
    return targets;
}

void drop_baseless_targets(Builder& builder, Json& primitive) {
    if (!primitive.contains("targets")) return;
    const Json& attributes = primitive["attributes"];
    for (Json& target : primitive["targets"]) {
        Json kept = Json::object();
        for (const auto& [semantic, accessor] : target.items()) {
            if (attributes.contains(semantic))
                kept[semantic] = accessor;
            else
                builder.release({{"attributes", {{"baseless", accessor}}}});
        }
        if (kept.empty() && !target.empty()) {
            const Json& like = builder.json()["accessors"][attributes["POSITION"].get<std::size_t>()];
            const Json zero = {0, 0, 0};
            Json zeros = {{"componentType", int(float32)}, {"count", like["count"]}, {"type", "VEC3"}};
            zeros["min"] = zeros["max"] = zero;
            kept["POSITION"] = builder.add_accessor(std::move(zeros));
        }
        target = std::move(kept);
    }
}

bool has_column(const Mesh& mesh, Index primitive, const Column& column) {
    const auto lists = [&](const Primitive& p) { return p.lists(column.data.name); };
    return primitive >= mesh.primitives.size() || mesh.primitives[primitive].has(column.data.name) ||
           std::none_of(mesh.primitives.begin(), mesh.primitives.end(), lists);
}

namespace {

void add_attributes_and_targets(Builder& builder, const Mesh& mesh, const Table& table,
                                const std::vector<Column>& columns, const EncodeSettings& settings,
                                Json& primitive) {
    primitive["attributes"] = add_attributes(builder, mesh, table, columns, settings);
    const Json targets = add_targets(builder, mesh, columns, table.wedges);
    if (!targets.is_null()) primitive["targets"] = targets;
}

void add_arrays(Builder& builder, const Mesh& mesh, const Table& table, const std::vector<Column>& columns,
                const EncodeSettings& settings, Json& primitive) {
    add_attributes_and_targets(builder, mesh, table, columns, settings, primitive);
    drop_baseless_targets(builder, primitive);
    primitive["indices"] = add_indices(builder, table);
}

/// A primitive with all wedges as points. Orders for compression put points next to their neighbours.
Json points_primitive(Builder& builder, const Mesh& mesh, const std::vector<Column>& columns,
                      const EncodeSettings& settings, Written& written) {
    Table table;
    if (orders_points(settings.order) && !keeps_order(mesh, settings))
        table.wedges = points_along_curve(mesh);
    else
        for (Index w = 0; w < mesh.wedge_count(); ++w) table.wedges.push_back(w);
    Json primitive = primitive_frame(mesh, 0, settings, builder, written);
    constexpr int points = 0;
    primitive["mode"] = points;
    add_attributes_and_targets(builder, mesh, table, columns, settings, primitive);
    return primitive;
}

/// Adds the lines of each primitive as a list.
void add_lines(Builder& builder, const Mesh& mesh, const std::vector<Column>& columns,
               const EncodeSettings& settings, Written& written, EncodedMesh& out) {
    std::vector<std::vector<Index>> ends(std::max<std::size_t>(mesh.primitives.size(), 1));
    for (std::size_t l = 0; l < mesh.line_count(); ++l)
        for (const std::size_t end : {2 * l, 2 * l + 1})
            ends[mesh.primitive_of_line(l)].push_back(mesh.lines[end]);
    Numbering numbers(mesh.wedge_count());
    for (Index p = 0; p < ends.size(); ++p) {
        if (ends[p].empty()) continue;
        Table table{p, {}, std::move(ends[p])};
        numbers.collect(table, table.indices);
        numbers.renumber(table);
        numbers.forget(table);
        Json primitive = primitive_frame(mesh, p, settings, builder, written);
        constexpr int list = 1;
        primitive["mode"] = list;
        add_arrays(builder, mesh, table, columns, settings, primitive);
        out.primitives.push_back(std::move(primitive));
    }
}

} // namespace

EncodedMesh encode_mesh(Builder& builder, const Mesh& given, const EncodeSettings& settings,
                        Written& written) {
    EncodedMesh out;
    Mesh cut;
    if (!given.all_triangles()) cut = triangles_of(given);
    const Mesh& mesh = given.all_triangles() ? given : cut;
    if (mesh.vertex_count() == 0) return out;
    require_floats(mesh, fmt::format("part '{}'", settings.name));
    const auto columns = columns_of(mesh, settings.columns, written.changes);
    for (const auto& column : columns)
        out.targets = std::max(out.targets, static_cast<std::size_t>(column.target + 1));
    if (!mesh.lines.empty()) {
        add_lines(builder, mesh, columns, settings, written, out);
        return out;
    }
    if (mesh.face_count() == 0) {
        out.primitives.push_back(points_primitive(builder, mesh, columns, settings, written));
        return out;
    }
    auto tables = tables_of(mesh, settings.manifold && !settings.draco.on);
    const bool free = !settings.draco.on && !keeps_order(mesh, settings);
    if (free && settings.quantize.on && !settings.manifold)
        for (Table& table : tables) merge_alike(mesh, table, columns, settings);
    if (free) order_triangles(mesh, tables, settings.order, settings.manifold, out.cache);
    if (settings.manifold && !settings.draco.on) {
        encode_manifold(builder, mesh, tables, columns, settings, written, out);
        return out;
    }
    if (settings.draco.on) tables = draco_tables(mesh, std::move(tables), out.targets > 0, settings, out);
    for (auto& table : tables) {
        Json primitive = primitive_frame(mesh, table.primitive, settings, builder, written);
        if (settings.draco.on)
            encode_draco_primitive(builder, mesh, table, columns, settings, primitive);
        else
            add_arrays(builder, mesh, table, columns, settings, primitive);
        out.primitives.push_back(std::move(primitive));
    }
    if (out.dropped_faces > 0)
        written.warnings.push_back(
            {Severity::warning,
             "W-FACES",
             fmt::format("part '{}': {} degenerate face{} dropped, since Draco cannot compress {}",
                         settings.name, out.dropped_faces, out.dropped_faces == 1 ? " is" : "s are",
                         out.dropped_faces == 1 ? "it" : "them"),
             {},
             "draco: {degenerate_faces: keep} keeps them in a separate primitive"});
    return out;
}

} // namespace facetmill::io::gltf
