#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "io/attributes.hpp"
#include "io/image_files.hpp"
#include "io/material_document.hpp"
#include "io/ply/ply.hpp"
#include "io/text.hpp"

#include <array>
#include <bit>
#include <fmt/format.h>
#include <limits>
#include <numeric>
#include <type_traits>

namespace facetmill::io::ply {

namespace {

std::optional<Type> type_named(std::string_view name) {
    static constexpr std::pair<std::string_view, Type> names[] = {
        {"float", Type::float32},   {"float32", Type::float32}, {"double", Type::float64},
        {"float64", Type::float64}, {"uchar", Type::uint8},     {"uint8", Type::uint8},
        {"char", Type::int8},       {"int8", Type::int8},       {"ushort", Type::uint16},
        {"uint16", Type::uint16},   {"short", Type::int16},     {"int16", Type::int16},
        {"uint", Type::uint32},     {"uint32", Type::uint32},   {"int", Type::int32},
        {"int32", Type::int32}};
    for (const auto& [known, type] : names)
        if (known == name) return type;
    return {};
}

Type read_type(Text& text) {
    const std::string_view word = text.word_on_line();
    if (const auto type = type_named(word)) return *type;
    text.fail(fmt::format("expected a type (char, uchar, short, ushort, int, uint, float, double), found {}",
                          in_quotes(word)));
}

Property read_property(Text& text) {
    Property p;
    Text ahead = text;
    if (ahead.word_on_line() == "list") {
        text = ahead;
        p.list = true;
        p.count_type = read_type(text);
        if (p.count_type == Type::float32 || p.count_type == Type::float64)
            text.fail("expected an integer type for the length of a list");
    }
    p.type = read_type(text);
    p.name = text.rest_of_line();
    if (p.name.empty()) text.fail("expected the name of a property");
    return p;
}

Element read_element(Text& text) {
    Element e;
    e.name = text.word_on_line();
    e.line = text.line();
    if (text.at_line_end()) text.fail("expected the name and the count of an element");
    const std::int64_t count = text.integer("a count");
    if (count < 0) text.fail(fmt::format("expected a count, found {}", count));
    e.count = static_cast<std::size_t>(count);
    return e;
}

Encoding read_encoding(Text& text) {
    const std::string_view word = text.word_on_line();
    if (word == "ascii") return Encoding::ascii;
    if (word == "binary_little_endian") return Encoding::little_endian;
    if (word == "binary_big_endian") return Encoding::big_endian;
    text.fail(
        fmt::format("expected ascii, binary_little_endian or binary_big_endian, found {}", in_quotes(word)));
}

} // namespace

std::size_t size_of(Type type) {
    static constexpr std::size_t sizes[] = {4, 8, 1, 1, 2, 2, 4, 4};
    return sizes[static_cast<std::size_t>(type)];
}

AttributeData array_of(Type type) {
    switch (type) {
    case Type::float32:
        return std::vector<float>{};
    case Type::float64:
        return std::vector<double>{};
    case Type::uint8:
        return std::vector<std::uint8_t>{};
    case Type::int8:
        return std::vector<std::int8_t>{};
    case Type::uint16:
        return std::vector<std::uint16_t>{};
    case Type::int16:
        return std::vector<std::int16_t>{};
    case Type::uint32:
        return std::vector<std::uint32_t>{};
    case Type::int32:
        break;
    }
    return std::vector<std::int32_t>{};
}

Header read_header(const Input& input) {
    Text text(as_text(input.bytes()), input.name(), "E-PLY");
    Header header;
    if (text.word_on_line() != "ply") text.fail("expected 'ply' as the first word");
    bool format = false;
    while (text.next_line()) {
        const std::string_view word = text.word_on_line();
        if (word == "format") {
            header.encoding = read_encoding(text);
            format = true;
        } else if (word == "element") {
            header.elements.push_back(read_element(text));
        } else if (word == "property") {
            if (header.elements.empty()) text.fail("a property without an element");
            header.elements.back().properties.push_back(read_property(text));
        } else if (word == "end_header") {
            if (!format) text.fail("the header has no 'format' line");
            header.lines = text.line();
            text.next_line();
            header.size = text.offset();
            return header;
        } else if (word == "comment") {
            if (text.word_on_line() == "TextureFile") header.textures.emplace_back(text.rest_of_line());
        } else if (word != "obj_info" && !word.empty()) {
            text.fail(
                fmt::format("expected element, property, comment or end_header, found {}", in_quotes(word)));
        }
    }
    text.fail("the header does not end: there is no 'end_header'");
}

// --- The properties of an element as attributes of a mesh

/// An element with its values; properties are taken out of it one after another.
struct Table {
    const Element* element = nullptr;
    std::vector<Column> columns;
    std::vector<bool> taken;

    std::size_t count() const { return element ? element->count : 0; }
    const Property& property(std::size_t p) const { return element->properties[p]; }

    /// The columns of these names, when all are there; they are taken then.
    std::vector<std::size_t> take(std::initializer_list<std::string_view> names, bool list = false);
};

namespace {

/// A number of a file as T: what is beyond T's range becomes its nearest end.
template <class T, class S>
T fitted(S value) {
    if constexpr (std::is_same_v<T, S> || std::is_floating_point_v<T>) {
        return static_cast<T>(value);
    } else {
        const auto x = static_cast<double>(value);
        constexpr auto low = static_cast<double>(std::numeric_limits<T>::min());
        constexpr auto high = static_cast<double>(std::numeric_limits<T>::max());
        return x >= low ? static_cast<T>(std::min(x, high))
                        : std::numeric_limits<T>::min(); // not a number: the lowest
    }
}

/// Columns side by side, as T.
template <class T>
std::vector<T> interleaved(const Table& table, const std::vector<std::size_t>& columns) {
    std::vector<T> all(table.count() * columns.size());
    for (std::size_t c = 0; c < columns.size(); ++c)
        std::visit(
            [&](const auto& values) {
                parallel_for(table.count(),
                             [&](std::size_t i) { all[i * columns.size() + c] = fitted<T>(values[i]); });
            },
            table.columns[columns[c]].values);
    return all;
}

Attribute attribute_of(const Table& table, const std::vector<std::size_t>& columns, std::string name,
                       Domain domain) {
    Attribute a;
    a.name = std::move(name);
    a.domain = domain;
    a.components = static_cast<int>(columns.size());
    const AttributeData& first = table.columns[columns[0]].values;
    std::visit(
        [&](const auto& values) {
            using T = typename std::decay_t<decltype(values)>::value_type;
            a.data = interleaved<T>(table, columns);
        },
        first);
    a.role = role_of(a.name, a.components, a.data);
    a.normalised =
        a.data.index() > 1 && (a.role == Role::colour || a.role == Role::uv || a.role == Role::weights);
    return a;
}

bool same_type(const Table& table, const std::vector<std::size_t>& columns) {
    for (const std::size_t c : columns)
        if (table.property(c).type != table.property(columns[0]).type) return false;
    return true;
}

} // namespace

std::vector<std::size_t> Table::take(std::initializer_list<std::string_view> names, bool list) {
    std::vector<std::size_t> found;
    for (const auto name : names)
        for (std::size_t p = 0; p < columns.size(); ++p)
            if (!taken[p] && property(p).name == name && property(p).list == list) {
                found.push_back(p);
                break;
            }
    if (found.size() != names.size()) return {};
    for (const std::size_t p : found) taken[p] = true;
    return found;
}

void add_colours(Table& table, Mesh& mesh, Domain domain) {
    for (const auto& [r, g, b, a] :
         {std::array{"red", "green", "blue", "alpha"}, std::array{"r", "g", "b", "a"},
          std::array{"diffuse_red", "diffuse_green", "diffuse_blue", "diffuse_alpha"}}) {
        auto columns = table.take({r, g, b, a});
        if (columns.empty()) columns = table.take({r, g, b});
        if (columns.empty()) continue;
        const Type type = table.property(columns[0]).type;
        Attribute colour{"COLOR_0", domain, Role::colour, static_cast<int>(columns.size()), false, {}};
        if (same_type(table, columns) && type == Type::uint16) {
            colour.data = interleaved<std::uint16_t>(table, columns);
            colour.normalised = true;
        } else if (type == Type::float32 || type == Type::float64)
            colour.data = interleaved<float>(table, columns);
        else {
            colour.data = interleaved<std::uint8_t>(table, columns);
            colour.normalised = true;
        }
        add_attribute(mesh, std::move(colour));
        return;
    }
}

/// Names of texture coordinates of vertices.
constexpr std::pair<const char*, const char*> texture_points[] = {
    {"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}};

void add_normals(Table& table, Mesh& mesh) {
    if (const auto columns = table.take({"nx", "ny", "nz"}); !columns.empty())
        add_attribute(mesh,
                      {"NORMAL", Domain::wedge, Role::normal, 3, false, interleaved<float>(table, columns)});
}

void add_uvs(Table& table, Mesh& mesh) {
    for (const auto& [u, v] : texture_points) {
        const auto columns = table.take({u, v});
        if (columns.empty()) continue;
        auto uv = interleaved<float>(table, columns);
        for (std::size_t i = 1; i < uv.size(); i += 2) uv[i] = 1 - uv[i];
        add_attribute(mesh, {"TEXCOORD_0", Domain::wedge, Role::uv, 2, false, std::move(uv)});
        return;
    }
}

void add_others(Table& table, Mesh& mesh, Domain domain) {
    for (std::size_t p = 0; p < table.columns.size(); ++p) {
        if (table.taken[p] || table.property(p).list) continue;
        std::vector<std::size_t> columns{p};
        std::string name = table.property(p).name;
        if (name.ends_with("_0")) {
            const std::string stem = name.substr(0, name.size() - 2);
            for (std::size_t q = p + 1; q < table.columns.size() && columns.size() < 16; ++q)
                if (!table.taken[q] && !table.property(q).list &&
                    table.property(q).type == table.property(p).type &&
                    table.property(q).name == fmt::format("{}_{}", stem, columns.size()))
                    columns.push_back(q);
            if (columns.size() > 1) name = stem;
        }
        for (const std::size_t q : columns) table.taken[q] = true;
        add_attribute(mesh, attribute_of(table, columns, name, domain));
    }
}

// --- read

namespace {

class Builder {
  public:
    Builder(const Input& input, const ReadSettings& settings, ReadLog& log)
        : input_(input), settings_(settings), log_(log) {}
    Scene read();

  private:
    [[noreturn]] void fail(const Element& e, std::string message) const {
        malformed(input_.name(), e.line, "E-PLY", std::move(message));
    }
    void skipped(const std::string& what) {
        log_.warnings.push_back({Severity::warning, "W-SKIPPED", what + " cannot be kept: skipped",
                                 file_mark(input_.name()), ""});
    }
    void set_positions();
    void set_faces();
    void set_lines();
    std::size_t index_column();
    void add_strips();
    void add_corner_uvs();
    void add_textures(Scene& scene, const Header& header);
    std::vector<Index> texture_of_faces(std::size_t textures);
    void report_lists(const Table& table);
    void add_parts(Scene& scene);

    const Input& input_;
    const ReadSettings& settings_;
    ReadLog& log_;
    Table vertices_, faces_, strips_, edges_;
    Mesh mesh_;
    bool corner_uvs_ = false; ///< texture coordinates are of corners of faces
};

void Builder::set_positions() {
    if (!vertices_.element) malformed(input_.name(), 0, "E-PLY", "there is no element 'vertex'");
    const Element& e = *vertices_.element;
    if (e.count > settings_.max_vertices || e.count >= none)
        beyond_limit(input_.name(), fmt::format("{} vertices are more than the {} that can be held", e.count,
                                                std::min<std::size_t>(settings_.max_vertices, none - 1)));
    std::vector<std::size_t> columns = vertices_.take({"x", "y", "z"});
    if (columns.empty()) fail(e, "element 'vertex' lacks one of the properties x, y and z");
    mesh_.positions.resize(e.count);
    for (std::size_t c = 0; c < 3; ++c)
        std::visit(
            [&](const auto& values) {
                parallel_for(e.count,
                             [&](std::size_t i) { mesh_.positions[i][c] = static_cast<double>(values[i]); });
            },
            vertices_.columns[columns[c]].values);
}

std::size_t Builder::index_column() {
    for (const char* name : {"vertex_indices", "vertex_index"})
        if (const auto found = faces_.take({name}, true); !found.empty()) return found[0];
    fail(*faces_.element, "element 'face' has no list 'vertex_indices'");
}

void Builder::set_faces() {
    if (faces_.count() == 0) return;
    const Column& column = faces_.columns[index_column()];
    const std::size_t faces = faces_.count(), corners = column.begin(faces - 1) + column.size(faces - 1);
    if (corners >= none || faces >= none)
        beyond_limit(input_.name(), fmt::format("{} corners are too many", corners));
    mesh_.corners.resize(corners);
    const std::size_t vertices = mesh_.vertex_count();
    const std::size_t bad = std::visit(
        [&](const auto& values) {
            return parallel_reduce(
                corners, corners,
                [&](std::size_t begin, std::size_t end) {
                    for (std::size_t c = begin; c < end; ++c) {
                        const auto v = static_cast<double>(values[c]);
                        if (!(v >= 0 && v < static_cast<double>(vertices))) return c;
                        mesh_.corners[c] = static_cast<Index>(values[c]);
                    }
                    return corners;
                },
                [](std::size_t a, std::size_t b) { return std::min(a, b); });
        },
        column.values);
    if (bad < corners) {
        std::size_t f = 0;
        while (column.begin(f) + column.size(f) <= bad) ++f;
        const auto index =
            std::visit([&](const auto& values) { return static_cast<double>(values[bad]); }, column.values);
        fail(*faces_.element,
             fmt::format("face {} of {} names vertex {}, there are {}", f, faces, index, vertices));
    }
    if (column.offsets.empty() && column.each == 3) return;
    mesh_.face_offsets.resize(faces + 1);
    for (std::size_t f = 0; f <= faces; ++f)
        mesh_.face_offsets[f] = static_cast<Index>(f == faces ? corners : column.begin(f));
}

/// Edges are lines between two vertices.
void Builder::set_lines() {
    if (edges_.count() == 0) return;
    const auto columns = edges_.take({"vertex1", "vertex2"});
    if (columns.empty()) return skipped(fmt::format("element 'edge' ({})", edges_.count()));
    if (edges_.count() >= none / 2)
        beyond_limit(input_.name(), fmt::format("{} edges are too many", edges_.count()));
    mesh_.lines.resize(2 * edges_.count());
    for (std::size_t end = 0; end < 2; ++end)
        std::visit(
            [&](const auto& values) {
                for (std::size_t i = 0; i < edges_.count(); ++i) {
                    const auto v = static_cast<double>(values[i]);
                    if (!(v >= 0 && v < static_cast<double>(mesh_.vertex_count())))
                        fail(*edges_.element, fmt::format("edge {} of {} names vertex {}, there are {}", i,
                                                          edges_.count(), v, mesh_.vertex_count()));
                    mesh_.lines[2 * i + end] = static_cast<Index>(values[i]);
                }
            },
            edges_.columns[columns[end]].values);
    for (std::size_t p = 0; p < edges_.columns.size(); ++p)
        if (!edges_.taken[p])
            skipped(fmt::format("the property '{}' of element 'edge'", edges_.property(p).name));
}

/// Triangle strips: every index after the second makes a triangle with the two before it, every other one
/// turned over; a negative index starts anew; triangles with a repeated vertex only link strips.
void Builder::add_strips() {
    if (strips_.count() == 0) return;
    std::vector<std::size_t> found = strips_.take({"vertex_indices"}, true);
    if (found.empty()) found = strips_.take({"vertex_index"}, true);
    if (found.empty()) fail(*strips_.element, "element 'tristrips' has no list 'vertex_indices'");
    const Column& column = strips_.columns[found[0]];
    for (std::size_t s = 0; s < strips_.count(); ++s) {
        Index a = none, b = none;
        bool turned = false;
        for (std::size_t i = column.begin(s); i < column.begin(s) + column.size(s); ++i) {
            const auto index =
                std::visit([&](const auto& values) { return static_cast<double>(values[i]); }, column.values);
            if (!(index < static_cast<double>(mesh_.vertex_count())))
                fail(*strips_.element,
                     fmt::format("a strip names vertex {}, there are {}", index, mesh_.vertex_count()));
            if (index < 0) {
                a = b = none;
                turned = false;
                continue;
            }
            const auto c = static_cast<Index>(index);
            if (a != none) {
                const std::array<Index, 3> face = turned ? std::array{b, a, c} : std::array{a, b, c};
                if (a != b && b != c && c != a) add_face(mesh_, face);
                turned = !turned;
            }
            a = b;
            b = c;
        }
    }
}

/// Texture coordinates per corner (MeshLab's face list texcoord) make seams.
void Builder::add_corner_uvs() {
    const auto found = faces_.take({"texcoord"}, true);
    if (found.empty()) return;
    const Column& column = faces_.columns[found[0]];
    std::vector<std::uint64_t> keys(mesh_.corner_count(), 0);
    std::visit(
        [&](const auto& values) {
            for (Index f = 0; f < faces_.count(); ++f) {
                if (column.size(f) != 2 * std::size_t{mesh_.face_size(f)}) continue;
                for (std::size_t k = 0; k < mesh_.face_size(f); ++k) {
                    const auto u = static_cast<float>(values[column.begin(f) + 2 * k]);
                    const auto v = 1 - static_cast<float>(values[column.begin(f) + 2 * k + 1]);
                    keys[mesh_.face_begin(f) + k] = std::uint64_t{std::bit_cast<std::uint32_t>(u)} << 32 |
                                                    std::bit_cast<std::uint32_t>(v);
                }
            }
        },
        column.values);
    Wedges wedges = make_wedges(mesh_.vertex_count(), std::move(mesh_.corners), keys);
    mesh_.corners = std::move(wedges.corners);
    mesh_.wedge_vertex = std::move(wedges.wedge_vertex);
    std::vector<float> uv(wedges.keys.size() * 2, 0.0F);
    for (std::size_t w = 0; w < wedges.keys.size(); ++w) {
        if (wedges.keys[w] == no_key) continue;
        uv[2 * w] = std::bit_cast<float>(static_cast<std::uint32_t>(wedges.keys[w] >> 32));
        uv[2 * w + 1] = std::bit_cast<float>(static_cast<std::uint32_t>(wedges.keys[w]));
    }
    add_attribute(mesh_, {"TEXCOORD_0", Domain::wedge, Role::uv, 2, false, std::move(uv)});
    corner_uvs_ = true;
}

/// The number of each face's texture (MeshLab's texnumber), `textures` for those of none; 0 where faces do
/// not tell.
std::vector<Index> Builder::texture_of_faces(std::size_t textures) {
    std::vector<Index> numbers(mesh_.face_count(), 0);
    if (faces_.count() != numbers.size()) return numbers; // faces of strips
    const auto found = faces_.take({"texnumber"});
    if (found.empty()) return numbers;
    std::visit(
        [&](const auto& values) {
            for (std::size_t f = 0; f < numbers.size(); ++f) {
                const auto number = static_cast<double>(values[f]);
                const bool known = number >= 0 && number < static_cast<double>(textures);
                numbers[f] = static_cast<Index>(known ? number : static_cast<double>(textures));
            }
        },
        faces_.columns[found[0]].values);
    return numbers;
}

/// None, with a warning, when it cannot be read or is of no kind that glTF has.
std::optional<Bytes> texture_bytes(const Input& input, const std::string& texture, ReadLog& log) {
    auto bytes = read_image(input, relative_path_of(texture), texture, "TextureFile", log);
    const std::string type = bytes ? media_type(*bytes) : "";
    if (!bytes || type == "image/png" || type == "image/jpeg") return bytes;
    log.warnings.push_back(
        {Severity::warning, "W-IMAGE",
         fmt::format("the texture '{}' is neither PNG nor JPEG, as glTF requires, and is not kept", texture),
         file_mark(input.name()), ""});
    return {};
}

std::optional<Material> material_of(MaterialDocument& document, const Input& input,
                                    const std::string& texture, ReadLog& log) {
    const auto bytes = texture_bytes(input, texture, log);
    if (!bytes) return {};
    const auto relative = relative_path_of(texture);
    return document.add({{"name", relative->stem().string()},
                         {"pbrMetallicRoughness",
                          {{"baseColorTexture", {{"index", document.texture(*relative, *bytes, false)}}},
                           {"metallicFactor", 0}}}},
                        0);
}

/// Materials from the images that comments name, a primitive for each that faces use. Without texture
/// coordinates they mean nothing.
void Builder::add_textures(Scene& scene, const Header& header) {
    if (header.textures.empty()) return;
    const std::vector<Index> numbers = texture_of_faces(header.textures.size());
    if (!mesh_.find("TEXCOORD_0", Domain::wedge)) {
        log_.warnings.push_back(
            {Severity::warning, "W-IMAGE",
             fmt::format("the texture '{}' is not read: the file has no texture coordinates",
                         header.textures[0]),
             file_mark(input_.name()), ""});
        return;
    }
    MaterialDocument document(input_.name());
    std::vector<Index> primitive_of(header.textures.size() + 1, none), of_face;
    for (const Index number : numbers) {
        Index& primitive = primitive_of[number];
        if (primitive == none) {
            primitive = static_cast<Index>(mesh_.primitives.size());
            Primitive& p = mesh_.primitives.emplace_back();
            if (number < header.textures.size())
                if (auto material = material_of(document, input_, header.textures[number], log_)) {
                    p.material = static_cast<Index>(scene.materials.size());
                    scene.materials.push_back(*std::move(material));
                }
        }
        of_face.push_back(primitive);
    }
    if (mesh_.primitives.size() > 1)
        mesh_.attributes.push_back(
            {std::string(primitive_attribute), Domain::face, Role::index, 1, false, std::move(of_face)});
    if (!document.empty()) scene.documents.push_back(document.finish());
}

void Builder::report_lists(const Table& table) {
    for (std::size_t p = 0; p < table.columns.size(); ++p)
        if (!table.taken[p] && table.property(p).list && table.count() > 0)
            skipped(
                fmt::format("the list '{}' of element '{}'", table.property(p).name, table.element->name));
}

Scene Builder::read() {
    const Header header = read_header(input_);
    Body body(input_, header);
    std::vector<double> lengths;
    for (const Element& e : header.elements)
        lengths.push_back(static_cast<double>(e.count * e.properties.size()));
    lengths.push_back(std::accumulate(lengths.begin(), lengths.end(), 1.0) / 2); // the mesh of it
    ShareOfSteps steps(lengths);
    for (const Element& e : header.elements) {
        Table table{&e, body.read(e), std::vector<bool>(e.properties.size(), false)};
        Table* place = e.name == "vertex"      ? &vertices_
                       : e.name == "face"      ? &faces_
                       : e.name == "tristrips" ? &strips_
                       : e.name == "edge"      ? &edges_
                                               : nullptr;
        if (place && place->element) fail(e, fmt::format("element '{}' is declared twice", e.name));
        if (place)
            *place = std::move(table);
        else if (e.count > 0)
            skipped(fmt::format("element '{}' ({})", e.name, e.count));
        steps.next();
    }
    set_positions();
    set_faces();
    set_lines();
    add_corner_uvs();
    add_normals(vertices_, mesh_);
    add_uvs(vertices_, mesh_);
    add_colours(vertices_, mesh_, Domain::wedge);
    add_others(vertices_, mesh_, Domain::wedge);
    if (mesh_.has_seams())
        for (auto& a : mesh_.attributes)
            if (a.name != "TEXCOORD_0") extend_to_wedges(a, mesh_.wedge_vertex, mesh_.vertex_count());
    if (faces_.count() > 0 && strips_.count() > 0)
        fail(*strips_.element, "faces and strips in one file cannot be read");
    add_strips();
    Scene scene;
    add_textures(scene, header);
    if (faces_.count() > 0) {
        add_colours(faces_, mesh_, Domain::face);
        add_others(faces_, mesh_, Domain::face);
    }
    report_lists(vertices_);
    report_lists(faces_);
    drop_short_faces(mesh_, input_.name(), log_);
    normalise_offsets(mesh_);
    add_parts(scene);
    return scene;
}

constexpr const char* part_of_lines = "lines"; ///< beside that of the faces or points

/// Points that no line uses are points, as they are without the lines.
bool is_lines_alone(const Mesh& mesh) {
    if (mesh.face_count() > 0) return false;
    const std::vector<std::uint8_t> used = marked_ends_of_lines(mesh);
    return std::find(used.begin(), used.end(), 0) == used.end();
}

void Builder::add_parts(Scene& scene) {
    Mesh lines;
    if (mesh_.line_count() > 0 && !is_lines_alone(mesh_)) lines = split_lines(mesh_);
    scene.parts.emplace_back().mesh = std::move(mesh_);
    if (lines.line_count() == 0) return;
    if (corner_uvs_) lines.drop("TEXCOORD_0", Domain::wedge);
    Part& part = scene.parts.emplace_back();
    part.name = part_of_lines;
    part.mesh = std::move(lines);
}

} // namespace

Scene read(const Input& input, const ReadSettings& settings, ReadLog& log) {
    return Builder(input, settings, log).read();
}

namespace {

/// Texture coordinates, without which images mean nothing; and what says which face has which image.
bool has_property(const Header& header, std::string_view element, std::string_view name) {
    for (const auto& e : header.elements)
        if (e.name == element)
            for (const auto& p : e.properties)
                if (p.name == name) return true;
    return false;
}

bool has_elements(const Header& header, std::string_view element) {
    return std::any_of(header.elements.begin(), header.elements.end(),
                       [&](const Element& e) { return e.name == element && e.count > 0; });
}

bool has_texture_points(const Header& header) {
    for (const auto& [u, v] : texture_points)
        if (has_property(header, "vertex", u) && has_property(header, "vertex", v)) return true;
    return has_property(header, "face", "texcoord");
}

/// Where faces are numbered, all images: which numbers there are is known only when all is read.
std::vector<NamedImage> images_of(const std::filesystem::path& path,
                                  const std::vector<std::filesystem::path>& asset_roots) {
    const Input input = Input::open(path).with_asset_roots(asset_roots);
    const Header header = read_header(input);
    ReadLog ignored; // reading the file will tell
    MaterialDocument document(input.name());
    const bool numbered = has_property(header, "face", "texnumber");
    const std::size_t n =
        numbered ? header.textures.size() : std::min<std::size_t>(header.textures.size(), 1);
    for (std::size_t i = 0; i < n; ++i) material_of(document, input, header.textures[i], ignored);
    return document.images();
}

const RegisterCodec codec({
    .name = "ply",
    .about = "Stanford polygon file, text or binary; all attributes are kept",
    .extensions = {"ply"},
    .can = {.polygons = true,
            .points = true,
            .lines = true,
            .text = true,
            .big_endian = true,
            .full_precision = true,
            .attributes = "all, one value at a vertex"},
    .sniff =
        [](Span bytes) {
            const std::string_view text = as_text(bytes);
            return text.starts_with("ply\n") || text.starts_with("ply\r") || text.starts_with("ply ") ? 2 : 0;
        },
    .read = read,
    .write = write,
    .peek =
        [](const Input& input, FileHeader& header) {
            const Header read = read_header(input);
            for (const auto& texture : read.textures)
                if (const auto relative = relative_path_of(texture))
                    if (const auto path = path_below(input, *relative)) header.files.push_back(*path);
            header.parts = {""};
            if (has_elements(read, "edge") && has_property(read, "edge", "vertex1") &&
                has_property(read, "edge", "vertex2"))
                header.parts.emplace_back(part_of_lines);
            if (read.textures.empty() || !has_texture_points(read) || input.path().empty()) return;
            header.images = [path = input.path(), roots = input.asset_roots()] {
                return images_of(path, roots);
            };
            header.has_materials = [images = header.images] { return !images().empty(); };
        },
});
} // namespace

} // namespace facetmill::io::ply
