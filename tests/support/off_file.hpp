#pragma once
// Meshes as files, for stages that read a second mesh.

#include "mesh/mesh.hpp"
#include "support/temporary.hpp"

#include <fmt/format.h>

namespace facetmill::test {

/// Writes the positions and triangles to the file, and returns its path.
inline std::string off_file(const std::filesystem::path& path, const Mesh& mesh) {
    std::string text = fmt::format("OFF\n{} {} 0\n", mesh.vertex_count(), mesh.face_count());
    for (const Vec3& p : mesh.positions) text += fmt::format("{} {} {}\n", p.x, p.y, p.z);
    for (Index f = 0; f < mesh.face_count(); ++f)
        text +=
            fmt::format("3 {} {} {}\n", mesh.vertex(3 * f), mesh.vertex(3 * f + 1), mesh.vertex(3 * f + 2));
    put(path, text);
    return path.string();
}

} // namespace facetmill::test
