#include "geometry/cut/score.hpp"

#include "geometry/cut/cut.hpp"

namespace facetmill {

namespace {

class Scorer {
  public:
    Scorer(const PlaneCut& cut, const ScoreSettings& settings)
        : cut_(cut), mesh_(*cut.mesh), settings_(settings), front_(pieces_on_side(cut, 1)),
          back_(pieces_on_side(cut, -1)) {}

    ScoreResult run() {
        Mesh& out = result_.mesh;
        out.positions = mesh_.positions;
        out.positions.insert(out.positions.end(), cut_.points.begin(), cut_.points.end());
        out.wedge_vertex = mesh_.wedge_vertex;
        out.wedge_vertex.insert(out.wedge_vertex.end(), cut_.wedge_vertex.begin(), cut_.wedge_vertex.end());
        out.corners.reserve(mesh_.corner_count() + front_.wedges.size() + back_.wedges.size());
        out.face_offsets.push_back(0);
        for (Index f = 0; f < mesh_.face_count(); ++f) add(f);
        normalise_offsets(out);
        MeshProvenance provenance;
        provenance.vertices.identity = provenance.wedges.identity = true;
        provenance.vertices.edges = cut_.vertices;
        provenance.wedges.edges = cut_.wedges;
        provenance.faces = result_.source;
        result_.changes = inherit_attributes(out, mesh_, provenance);
        return std::move(result_);
    }

  private:
    void add(Index f) {
        if (next_cut_ < cut_.cut_faces.size() && cut_.cut_faces[next_cut_] == f) {
            ++next_cut_;
            for (; next_front_ < front_.size() && front_.source[next_front_] == f; ++next_front_)
                push(front_.of(next_front_), f, 1);
            for (; next_back_ < back_.size() && back_.source[next_back_] == f; ++next_back_)
                push(back_.of(next_back_), f, -1);
        } else if (next_passing_ < cut_.passing.size() && cut_.passing[next_passing_] == f) {
            passing_with_points(cut_, next_passing_++, polygon_);
            push(polygon_, f, 0);
        } else {
            push(mesh_.face_wedges(f), f, side_of_whole(f));
        }
    }

    int side_of_whole(Index f) const {
        using namespace face_class;
        const std::uint8_t where = cut_.classes[f] & (above | below);
        if (where != 0) return where == above ? 1 : where == below ? -1 : 0;
        if (settings_.flat != FlatSide::by_normal) return settings_.flat == FlatSide::front ? 1 : -1;
        return cut_.classes[f] & flat_above ? 1 : -1;
    }

    void push(std::span<const Index> wedges, Index source, int side) {
        Mesh& out = result_.mesh;
        out.corners.insert(out.corners.end(), wedges.begin(), wedges.end());
        out.face_offsets.push_back(static_cast<Index>(out.corners.size()));
        result_.source.push_back(source);
        result_.sides.push_back(static_cast<std::int8_t>(side));
    }

    const PlaneCut& cut_;
    const Mesh& mesh_;
    const ScoreSettings& settings_;
    Pieces front_, back_;
    std::size_t next_cut_ = 0, next_passing_ = 0, next_front_ = 0, next_back_ = 0;
    std::vector<Index> polygon_;
    ScoreResult result_;
};

} // namespace

ScoreResult score(const Mesh& mesh, const ScoreSettings& settings, CutMemory& memory) {
    check_plane(settings.plane);
    PlaneCut cut = cut_by_plane(mesh, settings.plane, {settings.snap, &memory}, settings.faces);
    if (!cut.meets()) { // the whole mesh is on one side, so classes are not needed
        ScoreResult whole{mesh, {}, {}, {}, 0, 0, 0, 0};
        for (Index f = 0; f < mesh.face_count(); ++f) whole.source.push_back(f);
        whole.sides.assign(mesh.face_count(), cut.above_count > 0 ? std::int8_t{1} : std::int8_t{-1});
        return whole;
    }
    settle_flat_by_normal(cut);
    ScoreResult result = Scorer(cut, settings).run();
    result.cut_faces = cut.cut_faces.size();
    result.on_plane = cut.on_count;
    result.snapped = cut.snapped_count;
    result.remembered = cut.remembered_count;
    remember(memory, cut);
    return result;
}

} // namespace facetmill
