#pragma once
// Joins meshes in cells, and makes meshes that are hard for cells.

#include "cells/partition/partition.hpp"
#include "io/outputs/outputs.hpp"
#include "support/meshes.hpp"
#include "support/temporary.hpp"

#include <array>

namespace facetmill::test {

/// All cells, merged into a mesh.
Mesh rejoined(const cells::Partition& partition);

/// The faces of a triangle mesh as sorted triples of positions, independent of numbers and order.
std::vector<std::array<double, 9>> triangles_of(const Mesh& mesh);

inline constexpr std::uint64_t cell_memory = std::uint64_t{64} << 20;

/// The mesh in cells of at most this many faces.
inline std::unique_ptr<cells::Partition> cells_of(const TemporaryDirectory& folder, const Mesh& mesh,
                                                  std::uint64_t most) {
    Scene scene;
    scene.parts.emplace_back().mesh = mesh;
    const auto path = folder / "m.ply";
    io::write_now(path, io::codec_for(path)->write(scene, {.double_positions = true}).files.front().bytes);
    return std::make_unique<cells::Partition>(cells::open_faces({path}, {}, folder.path()),
                                              cells::CellResources{folder.path(), cell_memory}, most);
}

/// Removes, reverses and repeats faces, and makes faces share edges and vertices.
inline Mesh nasty(unsigned seed) {
    Mesh mesh = noisy_icosphere(4, 0.02, seed);
    mesh.attributes.clear();
    Mesh other = moved(mesh, {3, 0, 0});
    append(mesh, other);
    append(mesh, Mesh(mesh)); // two separate copies
    const auto n = static_cast<Index>(mesh.vertex_count());
    Mesh out;
    out.positions = mesh.positions;
    unsigned state = seed;
    const auto random = [&](unsigned below) {
        return (state = state * 1664525 + 1013904223) / 65536 % below;
    };
    for (Index f = 0; f < mesh.face_count(); ++f) {
        std::vector<Index> face(mesh.face_wedges(f).begin(), mesh.face_wedges(f).end());
        switch (random(40)) {
        case 0:
            continue; // a hole
        case 1:
            std::swap(face[0], face[1]);
            break;
        case 2:
            add_face(out, face); // repeated
            break;
        case 3:
            face[2] = face[0]; // degenerate
            break;
        case 4:
            face[1] = random(n); // through the other faces
            break;
        default:
            break;
        }
        add_face(out, face);
    }
    drop_unused(out);
    return out;
}

} // namespace facetmill::test
