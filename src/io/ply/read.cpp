#include "base/progress.hpp"
#include "base/text/words.hpp"
#include "io/attributes.hpp"
#include "io/material_document.hpp"
#include "io/metadata.hpp"
#include "io/ply/ply.hpp"
#include "io/ply/table.hpp"
#include "io/ply/textures.hpp"
#include "io/text.hpp"
#include "io/trailing.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <fmt/format.h>
#include <numeric>

namespace facetmill::io::ply {

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
    void add_textures(Scene& scene, const Header& header, MaterialDocument& document);
    std::vector<Index> texture_of_faces(std::size_t textures);
    void warn_of_splats();
    void report_lists(const Table& table);
    void add_parts(Scene& scene);

    const Input& input_;
    const ReadSettings& settings_;
    ReadLog& log_;
    Table vertices_, faces_, strips_, edges_;
    Mesh mesh_;
    bool corner_uvs_ = false; ///< texture coordinates belong to corners of faces
};

void Builder::set_positions() {
    if (!vertices_.element) malformed(input_.name(), 0, "E-PLY", "there is no element 'vertex'");
    const Element& e = *vertices_.element;
    if (e.count > settings_.max_vertices || e.count >= none)
        beyond_limit(input_.name(),
                     fmt::format("{} vertices are more than the {} that facetmill supports", e.count,
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
        fail(*faces_.element, fmt::format("face {} of {} refers to vertex {}, but the file has {}", f, faces,
                                          index, vertices));
    }
    if (column.offsets.empty() && column.each == 3) return;
    mesh_.face_offsets.resize(faces + 1);
    for (std::size_t f = 0; f <= faces; ++f)
        mesh_.face_offsets[f] = static_cast<Index>(f == faces ? corners : column.begin(f));
}

/// Edges become lines between two vertices.
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
                        fail(*edges_.element,
                             fmt::format("edge {} of {} refers to vertex {}, but the file has {}", i,
                                         edges_.count(), v, mesh_.vertex_count()));
                    mesh_.lines[2 * i + end] = static_cast<Index>(values[i]);
                }
            },
            edges_.columns[columns[end]].values);
    for (std::size_t p = 0; p < edges_.columns.size(); ++p)
        if (!edges_.taken[p])
            skipped(fmt::format("the property '{}' of element 'edge'", edges_.property(p).name));
}

/// Triangle strips: every index after the second makes a triangle with the two before it, and every second
/// triangle is reversed. A negative index starts a new strip; triangles with a repeated vertex only link
/// strips.
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
                fail(*strips_.element, fmt::format("a strip refers to vertex {}, but the file has {}", index,
                                                   mesh_.vertex_count()));
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
    std::size_t other = 0; // lists that do not have two numbers for each corner
    std::visit(
        [&](const auto& values) {
            for (Index f = 0; f < faces_.count(); ++f) {
                if (column.size(f) != 2 * std::size_t{mesh_.face_size(f)}) {
                    other += column.size(f) > 0 ? 1 : 0; // MeshLab writes empty lists for faces without
                    continue;
                }
                for (std::size_t k = 0; k < mesh_.face_size(f); ++k) {
                    const auto u = static_cast<float>(values[column.begin(f) + 2 * k]);
                    const auto v = 1 - static_cast<float>(values[column.begin(f) + 2 * k + 1]);
                    keys[mesh_.face_begin(f) + k] = std::uint64_t{std::bit_cast<std::uint32_t>(u)} << 32 |
                                                    std::bit_cast<std::uint32_t>(v);
                }
            }
        },
        column.values);
    if (other > 0)
        log_.warnings.push_back(
            {Severity::warning, "W-SKIPPED",
             fmt::format(
                 "texture coordinates of {} are skipped, because they do not have two numbers for each "
                 "corner",
                 counted(other, "face")),
             file_mark(input_.name()), "export it again"});
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

/// The texture number of each face (MeshLab's texnumber), with `textures` for faces without a texture. All 0
/// if the faces have no numbers.
std::vector<Index> Builder::texture_of_faces(std::size_t textures) {
    std::vector<Index> numbers(mesh_.face_count(), 0);
    if (faces_.count() != numbers.size()) return numbers; // strips also made faces
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

/// Makes materials from the images that comments name, and a primitive for each image that faces use. Images
/// need texture coordinates.
void Builder::add_textures(Scene& scene, const Header& header, MaterialDocument& document) {
    if (header.textures.empty()) return;
    const std::vector<Index> numbers = texture_of_faces(header.textures.size());
    if (!mesh_.find("TEXCOORD_0", Domain::wedge)) {
        log_.warnings.push_back(
            {Severity::warning, "W-IMAGE",
             fmt::format("the texture '{}' is not read: the file has no texture coordinates",
                         header.textures[0]),
             file_mark(input_.name()),
             "export it with texture coordinates: s and t of vertices, or texcoord of faces"});
        return;
    }
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
}

/// Splats are points with the shape of an ellipsoid. No stage turns or scales that shape.
void Builder::warn_of_splats() {
    for (const char* name : {"rot_0", "rot_3", "scale_0", "scale_2", "opacity", "f_dc_0"})
        if (std::none_of(vertices_.element->properties.begin(), vertices_.element->properties.end(),
                         [&](const Property& p) { return p.name == name; }))
            return;
    log_.warnings.push_back(
        {Severity::warning, "W-SPLATS",
         "the file has Gaussian splats, which are read as points: transforms, other units "
         "and other up axes move them, but keep their shapes and colours",
         file_mark(input_.name()), "crop keeps them whole; turn and scale splats with a splat editor"});
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
    lengths.push_back(std::accumulate(lengths.begin(), lengths.end(), 1.0) /
                      2); // used below for the lines' mesh
    ProgressSteps steps(lengths);
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
    const auto is_bare = [](const Element& e) { return e.properties.empty(); }; // its size is not known
    if (std::none_of(header.elements.begin(), header.elements.end(), is_bare))
        warn_of_trailing(log_, input_.name(), body.left(), "the last element");
    set_positions();
    set_faces();
    set_lines();
    add_corner_uvs();
    add_normals(vertices_, mesh_);
    add_uvs(vertices_, mesh_);
    add_colours(vertices_, mesh_, Domain::wedge, header.own);
    add_others(vertices_, mesh_, Domain::wedge);
    if (mesh_.has_seams())
        for (auto& a : mesh_.attributes)
            if (a.name != "TEXCOORD_0") extend_to_wedges(a, mesh_.wedge_vertex, mesh_.vertex_count());
    if (faces_.count() > 0 && strips_.count() > 0)
        fail(*strips_.element, "faces and strips in one file cannot be read");
    add_strips();
    Scene scene;
    take_stated(scene, header.stated, input_.name(), settings_, log_);
    MaterialDocument document(input_.name());
    add_textures(scene, header, document);
    if (!header.comments.empty()) document.asset()["extras"][comments_key] = header.comments;
    if (!document.empty()) scene.documents.push_back(document.finish());
    if (faces_.count() > 0) {
        add_colours(faces_, mesh_, Domain::face, header.own);
        add_others(faces_, mesh_, Domain::face);
    }
    if (vertices_.element) warn_of_splats();
    report_lists(vertices_);
    report_lists(faces_);
    drop_short_faces(mesh_, input_.name(), log_);
    normalise_offsets(mesh_);
    add_parts(scene);
    return scene;
}

/// Whether lines use every vertex of a mesh without faces. If not, the other vertices are a point cloud, and
/// the lines become a separate part.
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

} // namespace facetmill::io::ply
