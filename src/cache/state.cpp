#include "cache/state.hpp"

#include "base/hash.hpp"
#include "cache/fields.hpp"

namespace facetmill::cache {

template <>
struct Members<Memory> {
    static void each(auto& memory, auto&& take) {
        auto& [record, inputs, absent, scene, told_name, bounds] = memory;
        take(record, inputs, absent, scene, told_name, bounds);
    }
};

namespace {

template <class T>
io::Bytes bytes_of(const T& value) {
    ByteWriter writer;
    writer(value);
    return std::move(writer.bytes);
}

template <class T>
std::optional<T> read_from(io::Span bytes) {
    try {
        T value;
        ByteReader reader(bytes);
        reader(value);
        reader.end();
        return value;
    } catch (const Corrupt&) {
        return {};
    } catch (const Json::exception&) { // a value of another type than was written
        return {};
    }
}

std::size_t size_of(const Mesh& mesh) {
    std::size_t bytes = mesh.positions.size() * sizeof(Vec3);
    for (const auto* indices :
         {&mesh.wedge_vertex, &mesh.corners, &mesh.face_offsets, &mesh.lines, &mesh.line_primitive})
        bytes += indices->size() * sizeof(Index);
    for (const auto& attribute : mesh.attributes)
        std::visit([&](const auto& all) { bytes += all.size() * sizeof(all[0]); }, attribute.data);
    return bytes;
}

} // namespace

io::Bytes encoded(const Scene& scene) {
    ByteWriter writer;
    writer.bytes.reserve(size_of(scene));
    writer(scene);
    return std::move(writer.bytes);
}
std::string digest_of(const Scene& scene) {
    Sha256 sum;
    ByteWriter writer([&](io::Span bytes) { sum.add(bytes); });
    writer(scene);
    writer.flush();
    return sum.digest();
}
std::optional<Scene> decoded_scene(io::Span bytes) { return read_from<Scene>(bytes); }

io::Bytes encoded(const Memory& memory) { return encoded(memory, memory.record); }
io::Bytes encoded(const Memory& memory, const report::StageRecord& record) {
    ByteWriter writer;
    Members<Memory>::each(memory, [&](const auto&, const auto&... others) { writer(record, others...); });
    return std::move(writer.bytes);
}
std::optional<Memory> decoded_memory(io::Span bytes) { return read_from<Memory>(bytes); }

std::size_t size_of(const Scene& scene) {
    constexpr std::size_t of_the_rest = 1 << 10;
    std::size_t bytes = of_the_rest;
    for (const auto& part : scene.parts) {
        bytes += size_of(part.mesh);
        if (!part.cuts) continue;
        for (const auto& cut : part.cuts->entries) bytes += cut.points.size() * sizeof(Vec3);
    }
    for (const auto& document : scene.documents) {
        bytes += document->json.size();
        for (const auto& buffer : document->buffers) bytes += buffer.size();
        for (const auto& [name, file] : document->files) bytes += file.size();
    }
    return bytes;
}

std::string key_of(const std::vector<std::string>& texts) { return sha256(bytes_of(texts)); }

} // namespace facetmill::cache
