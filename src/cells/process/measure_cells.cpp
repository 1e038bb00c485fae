#include "cells/process/measure_cells.hpp"

#include "cells/partition/cell_border_walk.hpp"
#include "cells/process/inspect_cells.hpp"
#include "cells/storage/number_file.hpp"
#include "geometry/measure/pieces.hpp"
#include "mesh/placement.hpp"

namespace facetmill::cells {

namespace {

class CellMeasurement final : RimVisitor {
  public:
    CellMeasurement(const Partition& partition, const Transform& transform, const CellResources& means,
                    const EdgeSettings& settings)
        : partition_(partition), means_(means), settings_(settings), transform_(transform),
          box_(box_of_cells(partition, transform)), scale_(even_scale(box_)), mass_(box_),
          area_(means.scratch), angle_(means.scratch), aspect_ratio_(means.scratch), length_(means.scratch),
          turn_(means.scratch), gaussian_(means.scratch), mean_(means.scratch) {}

    CellMeasures run() {
        walk_cell_borders(partition_, means_, *this);
        found_.mass = mass_.result(closed_);
        found_.faces.area = area_.statistics();
        found_.faces.angle = angle_.statistics();
        found_.faces.aspect_ratio = aspect_ratio_.statistics();
        found_.edges.length = length_.statistics();
        found_.edges.turn = turn_.statistics();
        found_.curvature.of_gaussian = gaussian_.statistics();
        found_.curvature.of_mean = mean_.statistics();
        if (!scale_.none()) {
            unscale(found_.faces, scale_);
            unscale(found_.edges, scale_);
            unscale(found_.curvature, scale_);
        }
        return std::move(found_);
    }

  private:
    std::uint64_t bytes_per_face() const override { return 500; }

    void read(Cell& cell) override {
        const Mesh world = in_world_of(cell.mesh);
        mass_.add(world);
        const FaceValues values = face_values(scale_.none() ? world : scale_(world));
        area_.add(values.area);
        angle_.add(values.angle);
        aspect_ratio_.add(values.aspect_ratio);
        FaceKinds& kinds = found_.faces.kinds;
        for (std::size_t k = 0; k < kinds.of_kind.size(); ++k) kinds.of_kind[k] += values.kinds.of_kind[k];
        kinds.non_planar += values.kinds.non_planar;
        kinds.deviation = std::max(kinds.deviation, values.kinds.deviation);
        found_.faces.signed_area += values.signed_area;
    }

    void look(const Mesh& mesh, const std::vector<Turn>& turns) override {
        Mesh world = in_world_of(mesh);
        if (!scale_.none()) world = scale_(world);
        closed_ = closed_ && connectivity_of(world, turns).uncancelled_edges == 0;
        const EdgeValues edges = edge_values(world, settings_, turns);
        length_.add(edges.length);
        turn_.add(edges.turn);
        EdgeResult& sum = found_.edges;
        sum.convex += edges.counts.convex;
        sum.concave += edges.counts.concave;
        sum.flat += edges.counts.flat;
        sum.feature += edges.counts.feature;
        sum.boundary += edges.counts.boundary;
        sum.non_manifold += edges.counts.non_manifold;
        const CurvatureValues curvature = curvature_values(world, turns);
        gaussian_.add(curvature.gaussian);
        mean_.add(curvature.mean);
        found_.curvature.total += curvature.total;
    }

    Mesh in_world_of(const Mesh& mesh) const {
        Mesh world = bare(mesh);
        apply(world, transform_);
        return world;
    }

    const Partition& partition_;
    const CellResources& means_;
    const EdgeSettings& settings_;
    const Transform& transform_;
    Box box_;
    PowerScale scale_;
    MassPieces mass_;
    bool closed_ = true;
    CellMeasures found_;
    NumberFile area_, angle_, aspect_ratio_, length_, turn_, gaussian_, mean_;
};

} // namespace

CellMeasures measure_cells(const Partition& partition, const Transform& transform, const CellResources& means,
                           const EdgeSettings& settings) {
    return CellMeasurement(partition, transform, means, settings).run();
}

} // namespace facetmill::cells
