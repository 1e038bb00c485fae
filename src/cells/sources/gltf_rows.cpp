// glTF as rows: positions and triangles of plain accessors, read from the file in pieces, in world space.

#include "cells/sources/gltf_rows.hpp"

#include "cells/sources/rows.hpp"
#include "io/gltf/document/accessor.hpp"
#include "io/gltf/document/container.hpp"
#include "io/gltf/document/nodes.hpp"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <map>
#include <set>

namespace facetmill::cells {

namespace gltf = io::gltf;

namespace {

constexpr int triangle_list = 4;

gltf::Chunks chunks_of(const io::Input& input) {
    if (gltf::is_glb(input.bytes())) return gltf::split_glb(input.bytes());
    gltf::Chunks chunks;
    chunks.json = io::as_text(input.bytes());
    return chunks;
}

std::optional<std::string> why_accessor_not(const Json& json, const gltf::JsonCursor& reference) {
    const gltf::Source source(json, {});
    const gltf::Accessor a = gltf::accessor(source, reference);
    if (a.place.find("sparse")) return fmt::format("{} is sparse", a.place.path());
    const auto view = a.place.find("bufferView");
    if (!view) return fmt::format("{} has no bytes", a.place.path());
    const std::size_t number = view->index(gltf::count_of(json, "bufferViews"), "buffer view");
    const gltf::JsonCursor place = gltf::item(json, "bufferViews", number);
    if (gltf::meshopt_extension(place)) return "its buffers are compressed";
    const gltf::JsonCursor buffer =
        gltf::item(json, "buffers", place.at("buffer").index(gltf::count_of(json, "buffers"), "buffer"));
    if (gltf::is_data_uri(buffer.text_or("uri", ""))) return "its buffers are text (data URIs)";
    return {};
}

std::optional<std::string> why_primitive_not(const Json& json, const gltf::JsonCursor& primitive) {
    if (const auto extensions = primitive.find("extensions"))
        for (const char* name : {"KHR_draco_mesh_compression", "EXT_mesh_manifold"})
            if (extensions->find(name)) return fmt::format("{} uses {}", primitive.path(), name);
    if (!gltf::makes_triangles(primitive)) return {}; // the primitive is skipped
    if (primitive.natural_or("mode", triangle_list) != triangle_list)
        return fmt::format("{} has triangle strips or fans", primitive.path());
    const gltf::JsonCursor position = primitive.at("attributes").at("POSITION");
    const gltf::Source source(json, {});
    if (gltf::accessor(source, position).component_type != gltf::float32)
        return "its positions are quantized";
    if (const auto why = why_accessor_not(json, position)) return why;
    const auto indices = primitive.find("indices");
    return indices ? why_accessor_not(json, *indices) : std::nullopt;
}

/// Calls take(placement, primitive) for each primitive with triangles.
template <class Take>
void each_primitive(const Json& json, Take&& take) {
    for (const gltf::Placement& placement : gltf::placements(json, gltf::node_frames(json))) {
        const gltf::JsonCursor primitives =
            gltf::item(json, "meshes", static_cast<std::size_t>(placement.mesh)).at("primitives");
        for (std::size_t i = 0; i < primitives.size(); ++i)
            if (gltf::makes_triangles(primitives.at(i))) take(placement, primitives.at(i));
    }
}

bool any(const Json& json, gltf::Drawn kind) {
    for (const gltf::Placement& placement : gltf::placements(json, gltf::node_frames(json))) {
        const gltf::JsonCursor primitives =
            gltf::item(json, "meshes", static_cast<std::size_t>(placement.mesh)).at("primitives");
        for (std::size_t i = 0; i < primitives.size(); ++i)
            if (gltf::kind_of(primitives.at(i)) == kind) return true;
    }
    return false;
}

class GltfReader final : public RowReader {
  public:
    GltfReader(const io::Input& input, const io::ReadSettings& settings)
        : input_(input), identity_(settings.weld == io::Weld::off     ? Identity::number
                                   : settings.weld == io::Weld::exact ? Identity::place
                                                                      : Identity::place_in_group),
          chunks_(chunks_of(input_)), json_(gltf::parse_document(chunks_.json)) {}

    std::string read(const std::shared_ptr<const ReadFile>& file, RowWriter& out, bool) override {
        file_ = file;
        return gltf::in_file(input_, [&] {
            const gltf::Placement* last = nullptr;
            std::set<std::string> attributes;
            each_primitive(json_, [&](const gltf::Placement& placement, const gltf::JsonCursor& primitive) {
                if (!last || last->name != placement.name) out.begin_group(identity_);
                last = &placement;
                add(primitive, placement.world, out);
                const gltf::JsonCursor named = primitive.at("attributes");
                for (const auto& [name, reference] : named.json().items())
                    if (name != "POSITION") attributes.insert(name);
                if (primitive.find("targets")) attributes.insert("morph targets");
                if (primitive.find("material")) attributes.insert("materials");
            });
            dropped.assign(attributes.begin(), attributes.end());
            if (any(json_, gltf::Drawn::lines)) dropped.emplace_back("lines");
            if (any(json_, gltf::Drawn::points)) dropped.emplace_back("points");
            for (auto& [path, buffer] : buffers_) {
                buffer.sha256 = digest_of(buffer.input, *buffer.file);
                require_as_opened({buffer});
                neighbours.push_back({buffer.input, buffer.sha256, nullptr});
            }
            return digest_of(input_, *file_);
        });
    }

  private:
    static std::string digest_of(const io::Input& input, const ReadFile& file) {
        Sha256 sum;
        Stream all(file, 0, input.bytes().size(), &sum);
        all.skip(all.left());
        return sum.digest();
    }

    /// The location of an accessor's elements.
    struct Elements {
        std::shared_ptr<const ReadFile> file;
        std::uint64_t begin = 0, end = 0, count = 0;
        std::size_t size = 0, stride = 0;
        int type = 0;
    };

    Elements elements(const gltf::JsonCursor& reference) {
        const gltf::Source source(json_, {});
        const gltf::Accessor a = gltf::accessor(source, reference);
        const gltf::JsonCursor view =
            gltf::item(json_, "bufferViews",
                       a.place.at("bufferView").index(gltf::count_of(json_, "bufferViews"), "buffer view"));
        Elements e;
        e.count = a.count;
        e.type = a.component_type;
        e.size = gltf::size_of(a.component_type) * static_cast<std::size_t>(a.components);
        e.stride = static_cast<std::size_t>(view.natural_or("byteStride", e.size));
        if (e.stride < e.size || e.stride > 65536) view.fail("byteStride is out of range");
        const std::uint64_t offset = a.place.natural_or("byteOffset", 0),
                            length = view.at("byteLength").natural();
        if (a.count > 0 && (offset > length || e.size > length - offset ||
                            a.count - 1 > (length - offset - e.size) / e.stride))
            a.place.fail(fmt::format("{} elements of {} bytes do not fit into its buffer view of {} bytes",
                                     a.count, e.size, length),
                         "E-BUFFER");
        open_buffer(view, length, e);
        e.begin += offset;
        return e;
    }

    /// Opens the file of a view and finds the offset of the view.
    void open_buffer(const gltf::JsonCursor& view, std::uint64_t length, Elements& e) {
        const std::size_t number = view.at("buffer").index(gltf::count_of(json_, "buffers"), "buffer");
        const std::string uri = gltf::item(json_, "buffers", number).text_or("uri", "");
        const std::uint64_t offset = view.natural_or("byteOffset", 0);
        std::uint64_t size = 0;
        e.file = file_;
        if (!uri.empty()) {
            const FaceSource::File& buffer =
                opened(gltf::buffer_path(gltf::item(json_, "buffers", number), uri, input_));
            size = buffer.input.bytes().size();
            e.file = buffer.file;
        } else if (number == 0 && chunks_.binary) {
            size = chunks_.binary->size();
            e.begin = static_cast<std::uint64_t>(chunks_.binary->data() - input_.bytes().data());
        }
        if (offset > size || length > size - offset)
            view.fail(fmt::format("bytes {} to {} are beyond the {} bytes of buffers[{}]", offset,
                                  offset + length, size, number),
                      "E-BUFFER");
        e.begin += offset;
        e.end = e.begin + length;
    }

    const FaceSource::File& opened(const std::filesystem::path& path) {
        const auto known = buffers_.find(path);
        return known != buffers_.end() ? known->second
                                       : buffers_.emplace(path, open_input(path)).first->second;
    }

    void add(const gltf::JsonCursor& primitive, const Transform& world, RowWriter& out) {
        const gltf::JsonCursor reference = primitive.at("attributes").at("POSITION");
        const Elements positions = elements(reference);
        const auto base = static_cast<std::uint32_t>(out.vertices());
        Stream from(*positions.file, positions.begin, positions.end);
        for (std::uint64_t v = 0; v < positions.count; ++v) {
            std::array<float, 3> p{};
            std::memcpy(p.data(), from.take(positions.size), sizeof p);
            if (v + 1 < positions.count) from.skip(positions.stride - positions.size);
            const Vec3 at{p[0], p[1], p[2]};
            if (!is_finite(at))
                throw Error(ErrorKind::malformed, "E-NAN",
                            fmt::format("vertex {} of {} is ({}, {}, {}), expected finite numbers", v,
                                        reference.path(), p[0], p[1], p[2]),
                            not_finite_hint);
            out.vertex(world.identity() ? at : world.point(at), {});
        }
        add_faces(primitive, positions.count, base, world.determinant() < 0, out);
    }

    void add_faces(const gltf::JsonCursor& primitive, std::uint64_t vertices, std::uint32_t base,
                   bool mirrored, RowWriter& out) {
        const auto indices = primitive.find("indices");
        Elements e;
        std::optional<Stream> from;
        if (indices) {
            e = elements(*indices);
            from.emplace(*e.file, e.begin, e.end);
        }
        const std::uint64_t count = indices ? e.count : vertices;
        std::array<std::uint32_t, 3> corners{};
        for (std::uint64_t i = 0; i < count / 3 * 3; ++i) {
            std::uint64_t index = i;
            if (from) {
                index = 0; // glTF numbers are little-endian
                std::memcpy(&index, from->take(e.size), e.size);
                if (i + 1 < count) from->skip(e.stride - e.size);
                if (index >= vertices)
                    indices->fail(fmt::format("index {} at {} is beyond the {} vertices", index, i, vertices),
                                  "E-INDEX");
            }
            corners[i % 3] = base + static_cast<std::uint32_t>(index);
            if (i % 3 != 2) continue;
            if (mirrored) std::swap(corners[1], corners[2]);
            out.face(corners);
        }
    }

    io::Input input_;
    std::shared_ptr<const ReadFile> file_;
    Identity identity_;
    gltf::Chunks chunks_;
    Json json_;
    std::map<std::filesystem::path, FaceSource::File> buffers_; ///< buffer files next to the document
};

} // namespace

bool is_gltf(const io::Input& input) {
    if (gltf::is_glb(input.bytes())) return true;
    const io::Codec* codec = io::codec_for(input.path());
    return codec && codec->name == "gltf";
}

std::optional<std::string> why_gltf_not_streamed(const io::Input& input) {
    return gltf::in_file(input, [&]() -> std::optional<std::string> {
        const Json json = gltf::parse_document(chunks_of(input).json);
        for (const char* name : {"EXT_mesh_gpu_instancing", "EXT_meshopt_compression",
                                 "KHR_meshopt_compression", "KHR_draco_mesh_compression"})
            if (gltf::uses_extension(json, name)) return fmt::format("it uses {}", name);
        std::optional<std::string> why = "it has no triangles";
        bool any = false;
        each_primitive(json, [&](const gltf::Placement& placement, const gltf::JsonCursor& primitive) {
            const auto found = placement.skinned ? std::optional<std::string>("it has skins")
                                                 : why_primitive_not(json, primitive);
            if (!any || (!why && found)) why = found;
            any = true;
        });
        return why;
    });
}

std::uint64_t gltf_faces(const io::Input& input) {
    return gltf::in_file(input, [&] {
        const Json json = gltf::parse_document(chunks_of(input).json);
        std::uint64_t faces = 0;
        each_primitive(json, [&](const gltf::Placement&, const gltf::JsonCursor& primitive) {
            const auto indices = primitive.find("indices");
            const gltf::Source source(json, {});
            faces +=
                gltf::accessor(source, indices ? *indices : primitive.at("attributes").at("POSITION")).count /
                3;
        });
        return faces;
    });
}

std::unique_ptr<RowReader> gltf_rows(const io::Input& input, const io::ReadSettings& settings) {
    return std::make_unique<GltfReader>(input, settings);
}

} // namespace facetmill::cells
