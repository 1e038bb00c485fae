#include "cells/partition/gather.hpp"

#include "base/progress.hpp"
#include "base/text/readable_numbers.hpp"
#include "cells/hierarchy/hierarchy.hpp"
#include "cells/sources/pieces.hpp"
#include "parallel/memory.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>

namespace facetmill::cells {

namespace {

/// Sorts vertices by their names.
void sort_vertices(Cell& cell) {
    std::vector<Index> order(cell.names.size()), number(cell.names.size());
    std::iota(order.begin(), order.end(), Index{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](Index a, Index b) { return cell.names[a] < cell.names[b]; });
    std::vector<Vec3> positions;
    positions.reserve(order.size());
    for (Index v = 0; v < order.size(); ++v) {
        number[order[v]] = v;
        positions.push_back(cell.mesh.positions[order[v]]);
    }
    cell.mesh.positions = std::move(positions);
    for (Index& corner : cell.mesh.corners) corner = number[corner];
    for (Attribute& a : cell.mesh.attributes)
        if (a.domain != Domain::face) a.select(order);
}

/// Throws a limit error (E-MEMORY).
void require_memory_for(std::uint64_t faces, const CellResources& means) {
    if (memory_in_core(faces) > means.memory)
        throw out_of_memory(
            fmt::format("the kept mesh has more than {} triangles and needs {}, but --memory allows {}",
                        grouped(faces), sized(memory_in_core(faces)), sized(means.memory)),
            "keep less, or give more memory");
}

} // namespace

Cell with_faces(Cell cell, const std::vector<Index>& faces) {
    const Mesh& mesh = cell.mesh;
    std::vector<Index> kept, number(mesh.vertex_count(), none);
    Cell some;
    some.mesh.corners.reserve(3 * faces.size());
    for (const Index f : faces)
        for (const Index v : mesh.face_wedges(f)) {
            if (number[v] == none) {
                number[v] = static_cast<Index>(kept.size());
                kept.push_back(v);
            }
            some.mesh.corners.push_back(number[v]);
        }
    for (const Index v : kept) {
        some.mesh.positions.push_back(mesh.positions[v]);
        some.names.push_back(cell.names[v]);
        some.home.push_back(cell.home[v]);
    }
    for (Attribute& a : cell.mesh.attributes) {
        a.select(a.domain == Domain::face ? faces : kept);
        some.mesh.attributes.push_back(std::move(a));
    }
    return some;
}

Mesh gathered(const Partition& partition,
              const std::function<bool(const Vec3&, const Vec3&, const Vec3&)>& keep,
              const CellResources& means) {
    std::vector<Cell> cells;
    std::uint64_t count = 0;
    std::vector<Index> faces;
    const std::size_t leaves = partition.tree().leaves.size();
    for (std::uint32_t leaf = 0; leaf < leaves; ++leaf, ProgressScope::report_item(leaf, leaves)) {
        Cell cell = partition.cell(leaf);
        faces.clear();
        for (Index f = 0; f < cell.mesh.face_count(); ++f)
            if (keep(cell.mesh.point(3 * f), cell.mesh.point(3 * f + 1), cell.mesh.point(3 * f + 2)))
                faces.push_back(f);
        count += faces.size();
        require_memory_for(count, means);
        if (!faces.empty()) cells.push_back(with_faces(std::move(cell), faces));
    }
    if (cells.empty()) return {};
    Cell all = joined(std::move(cells), 0);
    sort_vertices(all);
    return std::move(all.mesh);
}

Mesh gathered(FaceSource& source,
              const std::function<std::size_t(const Vec3&, const Vec3&, const Vec3&)>& weight,
              const CellResources& means) {
    io::Bytes kept;
    std::uint64_t count = 0;
    const std::size_t size = source.record_size();
    each_batch(source, static_cast<std::size_t>(means.memory / 8), [&](io::Span records) {
        const Mesh mesh = source.piece(records).mesh;
        for (Index f = 0; f < mesh.face_count(); ++f) {
            const std::size_t its = weight(mesh.point(3 * f), mesh.point(3 * f + 1), mesh.point(3 * f + 2));
            if (its == 0) continue;
            count += its;
            const auto record = records.subspan(f * size, size);
            kept.insert(kept.end(), record.begin(), record.end());
        }
        require_memory_for(count, means);
    });
    if (kept.empty()) return {};
    Mesh mesh = source.piece(kept).mesh;
    mesh.attributes.clear();
    return mesh;
}

} // namespace facetmill::cells
