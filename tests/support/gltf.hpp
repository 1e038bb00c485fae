#pragma once
// Helpers of the glTF tests: make scenes of a single mesh, write and read in memory, compare the drawn
// geometry.

#include "base/json.hpp"
#include "io/codec.hpp"
#include "mesh/invariants.hpp"

#include <algorithm>
#include <array>
#include <cstring>

namespace facetmill::test {

inline Scene scene_in_metres(Mesh mesh, std::string name = "thing") {
    Scene scene;
    scene.unit = Unit::m;
    scene.up = UpAxis::y;
    Part part;
    part.name = std::move(name);
    part.mesh = std::move(mesh);
    scene.parts.push_back(std::move(part));
    return scene;
}

inline io::Written written(const Scene& scene, const char* codec, io::WriteSettings settings = {}) {
    settings.title = settings.title.empty() ? "out" : settings.title;
    return io::codec_named(codec)->write(scene, settings);
}

inline io::Bytes to_bytes(std::string_view text) {
    const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
    return {bytes.begin(), bytes.end()};
}

inline Scene read_bytes(io::Bytes bytes, const char* codec, io::ReadLog* log = nullptr) {
    io::ReadLog own;
    return io::codec_named(codec)->read(io::Input::of("test", std::move(bytes)), {}, log ? *log : own);
}

inline Scene read_text(std::string_view text, io::ReadLog* log = nullptr) {
    return read_bytes(to_bytes(text), "gltf", log);
}

/// Writes a GLB and reads it back.
inline Scene again(const Scene& scene, const io::WriteSettings& settings = {}) {
    return read_bytes(written(scene, "glb", settings).files.at(0).bytes, "glb");
}

/// The JSON of a written GLB.
inline std::string json_of(const io::Bytes& glb) {
    std::uint32_t length = 0;
    std::memcpy(&length, glb.data() + 12, 4);
    return {reinterpret_cast<const char*>(glb.data()) + 20, length};
}

/// The faces as lists of corners (float positions and all wedge attributes), sorted. Independent of
/// numbering.
inline std::vector<std::vector<float>> drawn(const Mesh& mesh) {
    std::vector<std::vector<float>> faces;
    std::vector<const Attribute*> attributes;
    for (const auto& a : mesh.attributes)
        if (a.domain == Domain::wedge) attributes.push_back(&a);
    std::sort(attributes.begin(), attributes.end(), [](auto* a, auto* b) { return a->name < b->name; });
    for (Index f = 0; f < mesh.face_count(); ++f) {
        std::vector<std::vector<float>> corners;
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) {
            const Vec3 p = mesh.point(c);
            std::vector<float> corner{static_cast<float>(p.x), static_cast<float>(p.y),
                                      static_cast<float>(p.z)};
            for (const auto* a : attributes)
                for (int k = 0; k < a->components; ++k)
                    corner.push_back(static_cast<float>(a->value(mesh.corners[c], k)));
            corners.push_back(std::move(corner));
        }
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
        std::vector<float> face;
        for (const auto& c : corners) face.insert(face.end(), c.begin(), c.end());
        faces.push_back(std::move(face));
    }
    std::sort(faces.begin(), faces.end());
    return faces;
}

} // namespace facetmill::test
