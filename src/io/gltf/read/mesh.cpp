#include "io/gltf/read/mesh.hpp"

#include "base/fast_json.hpp"
#include "geometry/edit/equal_wedges.hpp"
#include "io/attributes.hpp"
#include "io/gltf/document/nodes.hpp"
#include "io/gltf/draco/draco.hpp"
#include "io/gltf/read/features.hpp"
#include "parallel/memory.hpp"
#include "parallel/parallel.hpp"

#include <fmt/format.h>
#include <utility>

namespace facetmill::io::gltf {

namespace {

/// Vertices with the same accessors, shared by one or more primitives.
struct Block {
    std::size_t first = 0, count = 0; // range of wedges
    std::vector<Vec3> positions;
    std::vector<Attribute> attributes;
};

/// Primitives being merged.
struct Merge {
    Source& source;
    JsonCursor mesh_place;
    std::size_t max_vertices;
    std::vector<Block> blocks;
    std::map<std::string, std::size_t> block_of; // blocks by their accessors' indices, as text
    std::size_t wedges = 0;
    DecodedMesh out;
    std::vector<Index> face_primitive;
    double bytes = 0; ///< memory of all blocks and corners, because few bytes of JSON may refer to the same
                      ///< accessor repeatedly

    void need(double more) {
        bytes += more;
        if (is_much_memory(bytes))
            require_memory(bytes, "reading " + mesh_place.path(), "use a machine with more memory");
    }

    void warn(const char* id, const std::string& message, const std::string& hint = {}) {
        out.warnings.push_back({Severity::warning, id, message, {}, hint});
    }
};

/// True if an accessor can be a mesh attribute; matrices of small numbers are padded and not supported.
bool usable(const Accessor& a) {
    const std::string type = a.place.at("type").text();
    return a.component_type != uint32 &&
           (type.substr(0, 3) != "MAT" || (type != "MAT2" && a.component_type == float32));
}

Attribute to_attribute(Merge& merge, const std::string& name, const Accessor& a, std::size_t count) {
    if (a.count != count)
        a.place.fail(fmt::format("{} has {} elements, but POSITION has {}", name, a.count, count));
    Attribute attribute{name,         Domain::wedge, role_of(name),
                        a.components, a.normalised,  decode(merge.source, a)};
    return attribute;
}

void add_accessor_attribute(Merge& merge, Block& block, const std::string& name,
                            const JsonCursor& reference) {
    const Accessor a = accessor(merge.source, reference);
    if (!usable(a))
        return merge.warn("W-ATTRIBUTE",
                          fmt::format("{}: {} has a type that mesh attributes cannot have and is not read",
                                      reference.path(), name));
    block.attributes.push_back(to_attribute(merge, name, a, block.count));
}

void add_targets(Merge& merge, Block& block, const JsonCursor& primitive) {
    const auto targets = primitive.find("targets");
    for (std::size_t t = 0; targets && t < targets->size(); ++t) {
        const JsonCursor target = targets->at(t);
        if (!target.json().is_object()) target.fail("expected an object");
        for (const auto& [name, reference] : target.json().items())
            add_accessor_attribute(merge, block, fmt::format("TARGET_{}_{}", t, name),
                                   JsonCursor(target, {&name, 0}, reference));
    }
}

std::optional<JsonCursor> draco_of(const JsonCursor& primitive) {
    const auto extensions = primitive.find("extensions");
    return extensions ? extensions->find("KHR_draco_mesh_compression") : std::nullopt;
}

void add_vertices(Merge& merge, Block& block) {
    block.first = merge.wedges;
    if (block.count > merge.max_vertices - merge.wedges)
        throw Error(ErrorKind::limit, "E-LIMIT",
                    fmt::format("{}: more than {} vertices", merge.mesh_place.path(), merge.max_vertices));
    merge.wedges += block.count;
    double bytes = sizeof(Vec3);
    for (const auto& a : block.attributes) bytes += a.components * size_of(component_type_of(a.data));
    merge.need(2 * bytes * static_cast<double>(block.count)); // counted twice: in the block and in the mesh
    merge.blocks.push_back(std::move(block));
}

/// The vertices of an uncompressed primitive. Shared vertices are read once.
std::size_t plain_block(Merge& merge, const JsonCursor& primitive) {
    const JsonCursor attributes = primitive.at("attributes");
    const auto targets = primitive.find("targets");
    const std::string key =
        fast_text(attributes.json()) + (targets ? fast_text(targets->json()) : std::string());
    if (const auto known = merge.block_of.find(key); known != merge.block_of.end()) return known->second;
    Block block;
    const Accessor positions = accessor(merge.source, attributes.at("POSITION"));
    if (positions.components != 3) positions.place.fail("POSITION must be VEC3");
    block.count = positions.count;
    if (block.count > merge.max_vertices) add_vertices(merge, block); // throws an error
    block.positions = to_vectors(to_attribute(merge, "POSITION", positions, block.count));
    for (const auto& [name, reference] : attributes.json().items())
        if (name != "POSITION")
            add_accessor_attribute(merge, block, name, JsonCursor(attributes, {&name, 0}, reference));
    add_targets(merge, block, primitive);
    add_vertices(merge, block);
    return merge.block_of[key] = merge.blocks.size() - 1;
}

/// Converts the numbers of a decoded column to the accessor's type, if they differ.
Attribute from_column(const std::string& name, DracoColumn column, const Accessor& promised) {
    Attribute a{
        name, Domain::wedge, role_of(name), column.components, promised.normalised, std::move(column.data)};
    AttributeData wanted = empty_data(promised.component_type);
    if (wanted.index() == a.data.index()) return a;
    std::visit(
        [&](const auto& from, auto& to) {
            using To = typename std::decay_t<decltype(to)>::value_type;
            to.resize(from.size());
            for (std::size_t i = 0; i < from.size(); ++i) {
                const double x = static_cast<double>(from[i]);
                const double low = static_cast<double>(std::numeric_limits<To>::lowest());
                const double high = static_cast<double>(std::numeric_limits<To>::max());
                to[i] = static_cast<To>(std::isnan(x) ? 0.0 : std::min(std::max(x, low), high));
            }
        },
        a.data, wanted);
    a.data = std::move(wanted);
    return a;
}

/// The vertices and indices of a Draco primitive. Attributes missing in the payload come from their
/// accessors.
std::size_t draco_block(Merge& merge, const JsonCursor& primitive, const JsonCursor& draco,
                        std::vector<Index>& indices) {
    DracoMesh decoded;
    try {
        decoded = decode_draco(merge.source.view(draco.at("bufferView")), DracoContents::mesh,
                               merge.source.decoded);
    } catch (const Error& e) {
        Diagnostic why = e.diagnostics().front();
        why.message = draco.path() + ": " + why.message;
        throw Error(e.kind(), std::vector{std::move(why)});
    }
    Block block;
    block.count = decoded.points;
    indices = std::move(decoded.triangles);
    const JsonCursor attributes = primitive.at("attributes"), ids = draco.at("attributes");
    bool positions = false;
    for (const auto& [name, reference] : attributes.json().items()) {
        const JsonCursor place(attributes, {&name, 0}, reference);
        const auto id = ids.find(name.c_str());
        if (!id) {
            add_accessor_attribute(merge, block, name, place);
            continue;
        }
        const Accessor promised = accessor(merge.source, place);
        const auto column =
            std::find_if(decoded.columns.begin(), decoded.columns.end(),
                         [wanted = id->natural()](const DracoColumn& c) { return c.id == wanted; });
        if (column == decoded.columns.end())
            id->fail(fmt::format("the Draco data has no attribute {}", id->natural()));
        if (column->components != promised.components)
            id->fail(fmt::format("the Draco data has {} components, the accessor {}", column->components,
                                 promised.components));
        Attribute attribute = from_column(name, std::move(*column), promised);
        if (name == "POSITION") {
            if (attribute.components != 3) promised.place.fail("POSITION must be VEC3");
            block.positions = to_vectors(attribute);
            positions = true;
        } else if (usable(promised)) {
            block.attributes.push_back(std::move(attribute));
        }
    }
    if (!positions) draco.fail("POSITION is not among the compressed attributes");
    add_targets(merge, block, primitive);
    add_vertices(merge, block);
    return merge.blocks.size() - 1;
}

/// The two ends of each line of a primitive with this mode. An incomplete last pair of a list is ignored.
std::vector<Index> ends_of_lines(const std::vector<Index>& indices, std::uint64_t mode) {
    enum Mode : std::uint64_t { list = 1, loop = 2 };
    std::vector<Index> ends;
    for (std::size_t i = 0; i + 1 < indices.size(); i += mode == list ? 2 : 1)
        ends.insert(ends.end(), {indices[i], indices[i + 1]});
    if (mode == loop && indices.size() > 1) ends.insert(ends.end(), {indices.back(), indices.front()});
    return ends;
}

/// Converts strips and fans to a list, without the degenerate triangles that connect strips.
std::vector<Index> as_list(const std::vector<Index>& indices, std::uint64_t mode) {
    std::vector<Index> list;
    for (std::size_t i = 2; i < indices.size(); ++i) {
        Index a = mode == 6 ? indices[0] : indices[i - 2], b = indices[i - 1];
        const Index c = indices[i];
        if (mode == 5 && i % 2 == 1) std::swap(a, b);
        if (mode == 5 && (a == b || b == c || a == c)) continue;
        list.insert(list.end(), {a, b, c});
    }
    return list;
}

Primitive primitive_info(const Merge& merge, const JsonCursor& primitive, const Block& block) {
    Primitive info;
    if (const auto material = primitive.find("material"))
        info.material =
            static_cast<Index>(material->index(count_of(merge.source.json(), "materials"), "material"));
    info.attributes.push_back("POSITION"); // needed because an empty list would mean all attributes
    for (const auto& a : block.attributes) info.attributes.push_back(a.name);
    Json kept;
    if (const auto extras = primitive.find("extras")) kept["extras"] = extras->json();
    if (const auto extensions = primitive.find("extensions")) {
        Json others = extensions->json();
        others.erase("KHR_draco_mesh_compression");
        if (!others.empty()) kept["extensions"] = std::move(others);
    }
    if (!kept.is_null()) info.json = to_string(kept);
    return info;
}

void add_primitive(Merge& merge, const JsonCursor& primitive) {
    const auto mode = primitive.natural_or("mode", 4);
    std::vector<Index> indices;
    std::size_t b;
    if (const auto draco = draco_of(primitive)) {
        b = draco_block(merge, primitive, *draco, indices);
    } else {
        b = plain_block(merge, primitive);
        if (const auto reference = primitive.find("indices")) {
            indices = decode_indices(merge.source, *reference, merge.blocks[b].count);
        } else {
            indices.resize(merge.blocks[b].count);
            for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = static_cast<Index>(i);
        }
    }
    if (mode != 4) indices = as_list(indices, mode);
    if (indices.size() % 3 != 0) {
        merge.warn("W-INCOMPLETE", fmt::format("{}: {} indices are left over after the last triangle",
                                               primitive.path(), indices.size() % 3));
        indices.resize(indices.size() / 3 * 3);
    }
    Mesh& mesh = merge.out.mesh;
    if (indices.size() > std::size_t{none} - 1 - mesh.corners.size())
        throw Error(ErrorKind::limit, "E-LIMIT", merge.mesh_place.path() + ": more than 4294967294 corners");
    merge.need((sizeof(Index) + sizeof(Index) / 3.0) * static_cast<double>(indices.size()));
    const Index first = static_cast<Index>(merge.blocks[b].first);
    const std::size_t before = mesh.corners.size();
    if (before == 0 && first == 0) {
        mesh.corners = std::move(indices);
    } else {
        mesh.corners.resize(before + indices.size());
        parallel_for(indices.size(), [&](std::size_t i) { mesh.corners[before + i] = first + indices[i]; });
    }
    if (!mesh.primitives.empty()) { // a single primitive does not need it
        merge.face_primitive.resize(before / 3, 0);
        merge.face_primitive.resize(mesh.corners.size() / 3, static_cast<Index>(mesh.primitives.size()));
    }
    mesh.primitives.push_back(primitive_info(merge, primitive, merge.blocks[b]));
}

void add_line_primitive(Merge& merge, const JsonCursor& primitive) {
    const std::size_t b = plain_block(merge, primitive);
    const std::size_t count = merge.blocks[b].count;
    const auto reference = primitive.find("indices");
    std::vector<Index> indices;
    if (reference)
        indices = decode_indices(merge.source, *reference, count);
    else
        for (Index i = 0; i < count; ++i) indices.push_back(i);
    merge.need(3.0 * sizeof(Index) * static_cast<double>(indices.size()));
    const auto mode = primitive.natural_or("mode", 4);
    if (mode == 1 && indices.size() % 2 != 0)
        merge.warn("W-INCOMPLETE", primitive.path() + ": an index is left over after the last line");
    Mesh& mesh = merge.out.mesh;
    const auto first = static_cast<Index>(merge.blocks[b].first);
    for (const Index end : ends_of_lines(indices, mode)) mesh.lines.push_back(first + end);
    mesh.line_primitive.resize(mesh.line_count(), static_cast<Index>(mesh.primitives.size()));
    mesh.primitives.push_back(primitive_info(merge, primitive, merge.blocks[b]));
}

/// One primitive of points, in the order of its indices.
void add_points_primitive(Merge& merge, const JsonCursor& primitive) {
    const std::size_t b = plain_block(merge, primitive);
    Block& block = merge.blocks[b];
    if (const auto reference = primitive.find("indices")) {
        const std::vector<Index> order = decode_indices(merge.source, *reference, block.count);
        merge.need(static_cast<double>(order.size() * sizeof(Vec3)));
        std::vector<Vec3> positions;
        positions.reserve(order.size());
        for (const Index i : order) positions.push_back(block.positions[i]);
        block.positions = std::move(positions);
        for (Attribute& a : block.attributes) a = selected(a, order);
        merge.wedges += order.size() - block.count;
        block.count = order.size();
    }
    merge.out.mesh.primitives.push_back(primitive_info(merge, primitive, block));
}

/// The attribute of that name for the whole mesh, in a type that fits the values of all blocks.
Attribute& common_attribute(Mesh& mesh, const Attribute& part) {
    if (Attribute* known = mesh.find(part.name, Domain::wedge)) {
        if (known->data.index() != part.data.index() || known->normalised != part.normalised) {
            known->data = std::vector<float>{};
            known->normalised = false;
        }
        known->components = std::max(known->components, part.components);
        return *known;
    }
    mesh.attributes.push_back({part.name, part.domain, part.role, part.components, part.normalised, {}});
    std::visit([&](const auto& v) { mesh.attributes.back().data = std::decay_t<decltype(v)>{}; }, part.data);
    return mesh.attributes.back();
}

void copy_into(Attribute& to, const Attribute& from, std::size_t first) {
    const bool same = to.data.index() == from.data.index() && to.components == from.components;
    const std::size_t width = static_cast<std::size_t>(to.components);
    std::visit(
        [&](auto& numbers) {
            using Numbers = std::decay_t<decltype(numbers)>;
            using T = typename Numbers::value_type;
            if (same) {
                const auto& source = std::get<Numbers>(from.data);
                std::copy(source.begin(), source.end(),
                          numbers.begin() + static_cast<std::ptrdiff_t>(first * width));
                return;
            }
            const double opaque = to.normalised ? static_cast<double>(std::numeric_limits<T>::max()) : 1.0;
            for (std::size_t i = 0; i < from.size(); ++i)
                for (std::size_t c = 0; c < width; ++c) {
                    const bool there = c < static_cast<std::size_t>(from.components);
                    // Copies raw numbers of the same type. Otherwise value() gives fractions, which float32
                    // can hold.
                    const double x = !there ? (to.role == Role::colour ? opaque : 0.0)
                                     : to.data.index() == from.data.index()
                                         ? static_cast<double>(std::get<Numbers>(
                                               from.data)[i * static_cast<std::size_t>(from.components) + c])
                                         : from.value(i, static_cast<int>(c));
                    numbers[(first + i) * width + c] = static_cast<T>(x);
                }
        },
        to.data);
}

void join_blocks(Merge& merge) {
    Mesh& mesh = merge.out.mesh;
    if (merge.blocks.size() == 1) { // the common case: nothing to copy
        mesh.positions = std::move(merge.blocks.front().positions);
    } else {
        for (auto& block : merge.blocks) {
            mesh.positions.insert(mesh.positions.end(), block.positions.begin(), block.positions.end());
            std::vector<Vec3>().swap(block.positions);
        }
    }
    for (const auto& block : merge.blocks)
        for (const auto& a : block.attributes) common_attribute(mesh, a);
    for (auto& a : mesh.attributes) {
        std::visit([&](auto& v) { v.resize(merge.wedges * static_cast<std::size_t>(a.components)); }, a.data);
        for (const auto& block : merge.blocks)
            for (const auto& part : block.attributes)
                if (part.name == a.name) copy_into(a, part, block.first);
    }
    const auto all_same = [&](const Primitive& p) {
        return p.attributes == mesh.primitives.front().attributes;
    };
    if (std::all_of(mesh.primitives.begin(), mesh.primitives.end(), all_same))
        for (auto& p : mesh.primitives) p.attributes.clear();
    if (mesh.primitives.size() > 1 && mesh.lines.empty())
        mesh.attributes.push_back({std::string(primitive_attribute), Domain::face, Role::index, 1, false,
                                   std::move(merge.face_primitive)});
}

} // namespace

Role role_of(std::string_view semantic) {
    const auto starts = [&](std::string_view prefix) { return semantic.substr(0, prefix.size()) == prefix; };
    if (starts("TARGET_")) return Role::morph_vector;
    if (semantic == "NORMAL") return Role::normal;
    if (semantic == "TANGENT") return Role::tangent;
    if (starts("TEXCOORD_")) return Role::uv;
    if (starts("COLOR_")) return Role::colour;
    if (starts("JOINTS_")) return Role::joints;
    if (is_feature_id(semantic)) return Role::index;
    return starts("WEIGHTS_") ? Role::weights : Role::generic;
}

DecodedMesh decode_mesh(Source& source, std::size_t index, std::size_t max_vertices) {
    Merge merge{source,
                item(source.json(), "meshes", index),
                std::min<std::size_t>(max_vertices, none - 1),
                {},
                {},
                0,
                {},
                {},
                0};
    const JsonCursor primitives = merge.mesh_place.at("primitives");
    std::size_t skipped = 0;
    const Drawn main = kind_of_mesh(merge.mesh_place);
    bool points = false; // of points, only the first primitive is read: part_kinds gives each its mesh
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        const JsonCursor primitive = primitives.at(i);
        const Drawn kind = kind_of(primitive);
        if (kind == Drawn::none)
            ++skipped;
        else if (kind != main || std::exchange(points, kind == Drawn::points))
            continue; // read elsewhere
        else if (kind == Drawn::triangles)
            add_primitive(merge, primitive);
        else if (kind == Drawn::lines)
            add_line_primitive(merge, primitive);
        else
            add_points_primitive(merge, primitive);
    }
    if (skipped > 0)
        merge.warn("W-SKIPPED",
                   fmt::format("{}: the document keeps {} without positions unchanged, and stages ignore {}",
                               merge.mesh_place.path(),
                               skipped == 1 ? "a primitive" : fmt::format("{} primitives", skipped),
                               skipped == 1 ? "it" : "them"));
    join_blocks(merge);
    Mesh& mesh = merge.out.mesh;
    if (mesh.primitives.size() == 1) mesh.line_primitive.clear();
    if (main != Drawn::triangles) return std::move(merge.out);
    if (!merge_as_told(source, merge.mesh_place, mesh, merge.out.warnings)) weld_exact(mesh);
    merge_equal_wedges(mesh);
    return std::move(merge.out);
}

// --- weld

namespace {

/// [corners] The vertices that the extension defines, as wedge numbers; empty if it defines none.
std::vector<Index> told_vertices(Source& source, const JsonCursor& extension, const Mesh& mesh) {
    const JsonCursor primitive = extension.at("manifoldPrimitive");
    std::vector<Index> vertices = decode_indices(source, primitive.at("indices"), mesh.positions.size());
    if (vertices.size() != mesh.corners.size()) return {};
    return vertices;
}

} // namespace

bool merge_as_told(Source& source, const JsonCursor& mesh_place, Mesh& mesh,
                   std::vector<ReadWarning>& warnings) {
    const auto extensions = mesh_place.find("extensions");
    const auto extension = extensions ? extensions->find("EXT_mesh_manifold") : std::nullopt;
    if (!extension) return false;
    const auto ignore = [&](const char* why) {
        warnings.push_back({Severity::warning,
                            "W-MANIFOLD",
                            extension->path() + ": " + why + ", so vertices are merged by position",
                            {},
                            "",
                            false});
        return false;
    };
    const std::vector<Index> vertices = told_vertices(source, *extension, mesh);
    if (vertices.empty()) return ignore("it has a different number of indices than the primitives");
    std::vector<Index> vertex_of(mesh.positions.size(), none);
    for (std::size_t c = 0; c < vertices.size(); ++c) {
        Index& v = vertex_of[mesh.corners[c]];
        if (v != none && v != vertices[c])
            return ignore("it puts one vertex of a primitive at two positions");
        v = vertices[c];
        if (!(mesh.positions[v] == mesh.positions[mesh.corners[c]]))
            return ignore("it merges different positions");
    }
    // Unused vertices stay separate; the others are numbered by first occurrence.
    std::vector<Index> number(mesh.positions.size(), none);
    std::vector<Vec3> positions;
    mesh.wedge_vertex.resize(vertex_of.size());
    for (Index w = 0; w < vertex_of.size(); ++w) {
        const Index v = vertex_of[w] == none ? w : vertex_of[w];
        if (number[v] == none) {
            number[v] = static_cast<Index>(positions.size());
            positions.push_back(mesh.positions[v]);
        }
        mesh.wedge_vertex[w] = number[v];
    }
    mesh.positions = std::move(positions);
    normalise_wedges(mesh);
    return true;
}

} // namespace facetmill::io::gltf
