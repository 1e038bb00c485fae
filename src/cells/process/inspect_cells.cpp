#include "cells/process/inspect_cells.hpp"

#include "cells/partition/cell_border_walk.hpp"
#include "geometry/inspect/evidence.hpp"
#include "mesh/power_scale.hpp"
#include "mesh/topology.hpp"

#include <algorithm>
#include <string_view>

namespace facetmill::cells {

namespace {

constexpr const char* set_name = "set"; ///< [faces] the number of their connected set

class CellInspection final : RimVisitor {
  public:
    CellInspection(const Partition& partition, const Transform& transform, const CellResources& means)
        : partition_(partition), transform_(transform), means_(means) {
        middle_ = transform.point(partition.source().contents().bounds.centre());
    }

    Properties run() {
        walk_cell_borders(partition_, means_, *this);
        Properties& p = found_;
        p.vertices = p.wedges = static_cast<std::int64_t>(partition_.vertices());
        p.faces = p.triangles = static_cast<std::int64_t>(partition_.faces());
        set_connectivity(p, sums_);
        p.components = inside_sets_ + static_cast<std::int64_t>(sets_.count());
        p.euler = p.vertices - p.edges + p.faces;
        if (p.closed) p.volume = (transform_.determinant() < 0 ? -volume_ : volume_) / 6;
        if (p.closed && p.edge_manifold && p.vertex_manifold && p.oriented)
            p.genus = p.components - p.euler / 2;
        p.parts = 1;
        p.materials = 0;
        return p;
    }

  private:
    void read(Cell& cell) override {
        add_sums(cell.mesh);
        add_labels(cell);
    }

    /// Adds the sums over single faces.
    void add_sums(const Mesh& mesh) {
        std::vector<Vec3> positions;
        positions.reserve(mesh.positions.size());
        for (const Vec3& p : mesh.positions) {
            positions.push_back(transform_.point(p));
            found_.bounds.add(positions.back());
        }
        double area = 0, volume = 0; // sums of the cell, which add small terms to small terms
        for (Index f = 0; f < mesh.face_count(); ++f) {
            const Vec3 &a = positions[mesh.vertex(3 * f)], &b = positions[mesh.vertex(3 * f + 1)],
                       &c = positions[mesh.vertex(3 * f + 2)];
            const Vec3 product = cross(b - a, c - a);
            area += safe_length(product) / 2;
            volume += dot(a - middle_, product);
            found_.degenerate_faces += is_degenerate(mesh, f);
        }
        found_.area += area;
        volume_ += volume;
    }

    /// Counts sets of connected faces without shared vertices; numbers the other sets.
    void add_labels(Cell& cell) {
        const Components components = face_components(cell.mesh);
        std::vector<std::uint32_t> number(components.count, UINT32_MAX), of_face(cell.mesh.face_count());
        std::vector<bool> goes_on(components.count, false);
        for (std::size_t c = 0; c < cell.mesh.corners.size(); ++c)
            if (cell.home[cell.mesh.corners[c]] != Cell::inner) goes_on[components.of_face[c / 3]] = true;
        for (std::size_t k = 0; k < components.count; ++k) {
            if (goes_on[k])
                number[k] = sets_.add();
            else
                ++inside_sets_;
        }
        for (std::size_t f = 0; f < of_face.size(); ++f) of_face[f] = number[components.of_face[f]];
        cell.mesh.attributes.push_back({set_name, Domain::face, Role::index, 1, false, std::move(of_face)});
    }

    /// Joins the sets of faces that share a vertex.
    void meet(Mesh& mesh) override {
        const auto& of_face = std::get<std::vector<std::uint32_t>>(mesh.find(set_name, Domain::face)->data);
        std::vector<std::uint32_t> met(mesh.vertex_count(), UINT32_MAX);
        for (std::size_t c = 0; c < mesh.corners.size(); ++c) {
            std::uint32_t& first = met[mesh.corners[c]];
            const std::uint32_t set = of_face[c / 3];
            if (first == UINT32_MAX)
                first = set;
            else
                sets_.join(first, set);
        }
    }

    void look(const Mesh& mesh, const std::vector<Turn>& turns) override {
        const Connectivity now = connectivity_of(mesh, turns);
        sums_.edges += now.edges;
        sums_.boundary_edges += now.boundary_edges;
        sums_.uncancelled_edges += now.uncancelled_edges;
        sums_.crowded_edges += now.crowded_edges;
        sums_.disagreeing_edges += now.disagreeing_edges;
        sums_.non_manifold_vertices += now.non_manifold_vertices;
        count_duplicates(mesh, turns);
    }

    /// Faces with the same vertices meet where the first of these vertices is complete.
    void count_duplicates(const Mesh& mesh, const std::vector<Turn>& turns) {
        for (const Index f : duplicate_faces(mesh)) {
            bool now = false, before = false;
            for (const Index v : mesh.face_wedges(f)) {
                now |= turns[v] == Turn::now;
                before |= turns[v] == Turn::before;
            }
            found_.duplicate_faces += now && !before;
        }
    }

    const Partition& partition_;
    const Transform& transform_;
    const CellResources& means_;
    Vec3 middle_;
    Properties found_;
    Connectivity sums_;
    DisjointSets sets_; ///< sets of connected faces, numbered in the order of discovery
    std::int64_t inside_sets_ = 0;
    double volume_ = 0; ///< six times the volume
};

} // namespace

bool inspects(const Property& property) {
    static constexpr std::string_view known[] = {"vertices",
                                                 "wedges",
                                                 "edges",
                                                 "faces",
                                                 "triangles",
                                                 "lines",
                                                 "components",
                                                 "euler",
                                                 "genus",
                                                 "boundary_edges",
                                                 "closed",
                                                 "edge_manifold",
                                                 "vertex_manifold",
                                                 "oriented",
                                                 "degenerate_faces",
                                                 "duplicate_faces",
                                                 "isolated_vertices",
                                                 "area",
                                                 "volume",
                                                 "bounds",
                                                 "parts",
                                                 "materials",
                                                 "unit",
                                                 "up"};
    return std::find(std::begin(known), std::end(known), property.name) != std::end(known);
}

Box box_of_cells(const Partition& partition, const Transform& transform) {
    const Box own = partition.source().contents().bounds;
    Box all;
    bool axes = true;
    for (const auto& row : transform.m) axes &= (row[0] != 0) + (row[1] != 0) + (row[2] != 0) <= 1;
    if (own.empty()) return all;
    if (axes) {
        all.add(transform.point(own.min));
        all.add(transform.point(own.max));
        return all;
    }
    for (std::uint32_t leaf = 0; leaf < partition.tree().leaves.size(); ++leaf)
        for (const Vec3& p : partition.cell(leaf).mesh.positions) all.add(transform.point(p));
    return all;
}

Properties inspect_cells(const Partition& partition, const Transform& transform, const CellResources& means) {
    return CellInspection(partition, transform, means).run();
}

} // namespace facetmill::cells
