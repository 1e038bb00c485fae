#include "geometry/thicken/resolve.hpp"

#include "geometry/boolean/combine.hpp"
#include "geometry/edit/redrawn_faces.hpp"
#include "geometry/edit/surgery.hpp"
#include "geometry/intersect/self_intersections.hpp"
#include "geometry/thicken/moved_surface.hpp"
#include "geometry/thicken/redrawn_flats.hpp"
#include "mesh/component_volumes.hpp"
#include "mesh/placement.hpp"
#include "mesh/topology.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace facetmill {

namespace {

constexpr int most_halvings = 4;

/// An intermediate side of the wall: a mesh and its attribute changes so far.
struct Side {
    Mesh mesh;
    AttributeChanges changes;
};

std::optional<CombineResult> combined(std::vector<Mesh> meshes, CombineOperation operation, Index second) {
    CombineResult r = combine(std::move(meshes), {operation, second});
    if (r.failure) return {};
    return r;
}

/// Removes small remains of folds: solids or cavities with less volume than a cube with this side (in the
/// world).
void drop_small_pieces(Mesh& mesh, const Transform& to_world, double side) {
    const Components pieces = face_components(mesh, false);
    const std::vector<double> six = six_volumes(mesh, pieces);
    const double scale = std::abs(to_world.determinant()) / 6, least = side * side * side;
    std::vector<std::uint8_t> small(mesh.face_count(), 0);
    for (Index f = 0; f < mesh.face_count(); ++f) small[f] = std::abs(six[pieces.of_face[f]]) * scale < least;
    mesh = keep_faces(mesh, faces_without(small));
}

class Resolver {
  public:
    Resolver(const ThickenMoves& moves, const Transform& to_world) : moves_(moves), to_world_(to_world) {}

    std::optional<ResolvedSolid> run() {
        const auto front = side(moves_.out, moves_.no_front, CombineOperation::unite);
        auto back = side(-moves_.in, moves_.no_back, CombineOperation::intersect);
        if (!front || !back) return {};
        ResolvedSolid r;
        if (back->mesh.face_count() == 0) {
            r.mesh = front->mesh;
            r.changes = front->changes;
            r.is_back.assign(r.mesh.face_count(), 0);
            return r;
        }
        auto solid = combined({front->mesh, std::move(back->mesh)}, CombineOperation::subtract, 1);
        if (!solid) return {};
        r.mesh = std::move(solid->mesh);
        r.is_back.assign(solid->mesh_of_face.begin(), solid->mesh_of_face.end());
        r.changes = front->changes;
        merge_changes(r.changes, back->changes);
        r.changes = changes_in_sequence(r.changes, std::move(solid->changes));
        return r;
    }

  private:
    /// The surface moved by a distance, without the absent faces.
    Mesh moved(double distance, const std::vector<std::uint8_t>& absent) const {
        const Mesh& from = moves_.surface;
        std::vector<Vec3> positions = moved_positions(from, moves_.of_vertex, distance);
        std::vector<std::uint8_t> turned = turned_faces(from, positions);
        const RedrawnFlats flats = redrawn_flats(from, positions, turned);
        RedrawnFaces redrawn(from);
        for_each_face(from, flats, [&](std::span<const Index> wedges, Index source) {
            if (!absent.empty() && absent[source]) return;
            redrawn.mesh.corners.insert(redrawn.mesh.corners.end(), wedges.begin(), wedges.end());
            redrawn.end_face(source);
        });
        normalise_offsets(redrawn.mesh);
        inherit_attributes(redrawn.mesh, from, redrawn.provenance);
        redrawn.mesh.positions = std::move(positions);
        drop_unused(redrawn.mesh);
        return std::move(redrawn.mesh);
    }

    std::optional<Side> side(double distance, const std::vector<std::uint8_t>& absent,
                             CombineOperation operation) {
        Side s{moved(distance, absent), {}};
        if (distance == 0 || s.mesh.face_count() == 0) return s;
        if (!take(s, combined({std::move(s.mesh)}, CombineOperation::unite, none))) return {};
        for (int i = 0; i < most_halvings && meets_surface(s.mesh); ++i) {
            distance /= 2;
            if (!take(s, combined({std::move(s.mesh), moved(distance, absent)}, operation,
                                  operation == CombineOperation::unite ? none : 1)))
                return {};
        }
        drop_small_pieces(s.mesh, to_world_, moves_.out + moves_.in);
        return s;
    }

    static bool take(Side& s, std::optional<CombineResult> r) {
        if (!r) return false;
        s.mesh = std::move(r->mesh);
        s.changes = changes_in_sequence(s.changes, std::move(r->changes));
        return true;
    }

    /// Whether faces of the mesh meet the original surface. The mesh has no intersecting faces itself.
    bool meets_surface(const Mesh& mesh) const {
        Mesh both = bare(mesh);
        append(both, bare(moves_.surface));
        std::vector<std::uint8_t> among(both.face_count(), 0);
        std::fill_n(among.begin(), mesh.face_count(), std::uint8_t{1});
        return find_self_intersections(both,
                                       {.limit = 0, .among = std::move(among), .separate_touching = true})
                   .count > 0;
    }

    const ThickenMoves& moves_;
    const Transform& to_world_;
};

ResolvedSolid failed() {
    ResolvedSolid r;
    r.failed = true;
    return r;
}

} // namespace

ResolvedSolid resolved_solid(const ThickenMoves& moves, const Transform& to_world) {
    return Resolver(moves, to_world).run().value_or(failed());
}

ResolvedSolid united_solid(const Mesh& solid, const Transform& to_world, double thickness) {
    auto r = combined({solid}, CombineOperation::unite, none);
    if (!r) return failed();
    drop_small_pieces(r->mesh, to_world, thickness);
    const std::size_t faces = r->mesh.face_count();
    return {std::move(r->mesh), std::vector<std::uint8_t>(faces, 0), std::move(r->changes)};
}

} // namespace facetmill
