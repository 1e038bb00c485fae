#include "geometry/pyramid/pyramid.hpp"

#include "base/progress.hpp"
#include "geometry/deviation/deviation.hpp"
#include "geometry/edit/equal_wedges.hpp"
#include "geometry/edit/surgery.hpp"
#include "geometry/pyramid/cut_faces.hpp"
#include "geometry/simplify/simplify.hpp"
#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace facetmill {

namespace {

/// Extra triangles for each held vertex, because held vertices need their own triangles.
constexpr std::size_t faces_of_held = 3;
/// A tile beyond this multiple of its target is simplified without keeping topology.
constexpr std::size_t too_large = 2;

/// A tile with the numbers of its vertices in the whole mesh; `none` for vertices of this tile alone.
struct TilePiece {
    Mesh mesh;
    std::vector<Index> numbers; ///< [vertices] numbers in the whole mesh
};

/// The first and the last leaf with a vertex at each vertex position.
struct LeavesOfPlaces {
    std::vector<Index> place;       ///< [vertices] the lowest coincident vertex
    std::vector<Index> first, last; ///< [vertices] first and last leaf, for the lowest coincident vertex

    LeavesOfPlaces(const Mesh& mesh, const std::vector<Index>& leaf_of_face) : place(lowest_at_place(mesh)) {
        first.assign(mesh.vertex_count(), none);
        last.assign(mesh.vertex_count(), 0);
        for (Index f = 0; f < mesh.face_count(); ++f)
            for (const Index w : mesh.face_wedges(f)) {
                const Index p = place[mesh.vertex_of_wedge(w)];
                first[p] = std::min(first[p], leaf_of_face[f]);
                last[p] = std::max(last[p], leaf_of_face[f]);
            }
    }
    /// Whether a leaf outside the tile has a vertex at the same position.
    bool shared(Index vertex, const FaceCut& tile) const {
        const Index p = place[vertex];
        return first[p] < tile.first_leaf || last[p] >= tile.last_leaf;
    }
};

/// A mesh per leaf, with the numbers of its vertices.
std::vector<TilePiece> pieces_of(const Mesh& mesh, const std::vector<Index>& leaf_of_face,
                                 std::size_t leaves) {
    constexpr const char* number = "number in the pyramid";
    Mesh numbered = mesh;
    std::vector<std::uint32_t> all(mesh.vertex_count());
    std::iota(all.begin(), all.end(), std::uint32_t{0});
    numbered.attributes.push_back({number, Domain::vertex, Role::index, 1, false, std::move(all)});
    std::vector<TilePiece> pieces(leaves);
    std::vector<Mesh> meshes = separated(numbered, leaf_of_face, leaves);
    for (std::size_t i = 0; i < leaves; ++i) {
        TilePiece& piece = pieces[i];
        piece.mesh = std::move(meshes[i]);
        piece.numbers = std::get<std::vector<std::uint32_t>>(piece.mesh.find(number, Domain::vertex)->data);
        piece.mesh.drop(number, Domain::vertex);
    }
    return pieces;
}

/// Merges pieces: merges vertices with the same number, and their equal wedges.
TilePiece joined(const std::vector<const TilePiece*>& pieces) {
    TilePiece all;
    for (const TilePiece* piece : pieces) {
        append(all.mesh, piece->mesh);
        all.numbers.insert(all.numbers.end(), piece->numbers.begin(), piece->numbers.end());
    }
    std::vector<Index> target(all.numbers.size()), known;
    std::iota(target.begin(), target.end(), Index{0});
    for (Index v = 0; v < target.size(); ++v)
        if (all.numbers[v] != none) known.push_back(v);
    std::sort(known.begin(), known.end(), [&](Index a, Index b) {
        return all.numbers[a] != all.numbers[b] ? all.numbers[a] < all.numbers[b] : a < b;
    });
    for (std::size_t i = 1; i < known.size(); ++i)
        if (all.numbers[known[i]] == all.numbers[known[i - 1]]) target[known[i]] = target[known[i - 1]];
    std::size_t left = 0;
    for (Index v = 0; v < target.size(); ++v)
        if (target[v] == v) all.numbers[left++] = all.numbers[v];
    all.numbers.resize(left);
    merge_vertices(all.mesh, target);
    merge_equal_wedges(all.mesh);
    return all;
}

void put_on_steps(Mesh& mesh, double step) {
    if (step > 0)
        for (Vec3& p : mesh.positions)
            for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = std::round(p[axis] / step) * step;
}

SimplifyResult simplified(const Mesh& mesh, std::vector<std::uint8_t> held, std::size_t faces) {
    SimplifySettings settings;
    const auto count = static_cast<std::size_t>(std::count(held.begin(), held.end(), 1));
    settings.faces = std::max(faces, faces_of_held * count);
    settings.lock.vertices = std::move(held);
    settings.lock.apart = true;
    SimplifyResult r = simplify(mesh, settings);
    if (r.mesh.face_count() <= too_large * *settings.faces) return r;
    settings.topology = SimplifySettings::Topology::allow;
    SimplifyResult fewer = simplify(mesh, settings);
    return fewer.mesh.face_count() > 0 && fewer.mesh.face_count() < r.mesh.face_count() ? std::move(fewer)
                                                                                        : std::move(r);
}

class PyramidMaker {
  public:
    PyramidMaker(const Mesh& mesh, const PyramidSettings& settings, const std::vector<std::uint8_t>& held)
        : settings_(settings), held_(held), cuts_(cut_faces(mesh, settings.faces)),
          tiles_(cuts_.tiles.size()), pieces_(tiles_.size()), leaves_(mesh, cuts_.leaf_of_face) {
        std::vector<TilePiece> at_leaves = pieces_of(mesh, cuts_.leaf_of_face, cuts_.leaves);
        for (std::size_t t = 0; t < tiles_.size(); ++t) {
            const FaceCut& cut = cuts_.tiles[t];
            tiles_[t].name = cut.name;
            tiles_[t].children = cut.children;
            if (cut.children.empty()) pieces_[t] = std::move(at_leaves[cut.first_leaf]);
        }
    }

    std::vector<PyramidTile> run() {
        std::size_t deepest = 0;
        for (const PyramidTile& tile : tiles_) deepest = std::max(deepest, tile.name.size());
        ProgressSteps steps(std::vector<double>(deepest + 1, 1));
        for (std::size_t level = deepest + 1; level-- > 0; steps.next()) {
            std::vector<std::size_t> here;
            for (std::size_t t = 0; t < tiles_.size(); ++t)
                if (tiles_[t].name.size() == level && !tiles_[t].children.empty()) here.push_back(t);
            ProgressScope::report_next_loop();
            parallel_for(
                here.size(), [&](std::size_t i) { join(here[i]); }, 1);
        }
        for (std::size_t t = 0; t < tiles_.size(); ++t) {
            tiles_[t].mesh = std::move(pieces_[t].mesh);
            tiles_[t].numbers = std::move(pieces_[t].numbers);
        }
        return std::move(tiles_);
    }

  private:
    void join(std::size_t t) {
        PyramidTile& tile = tiles_[t];
        std::vector<const TilePiece*> below;
        double error = 0;
        for (const std::size_t child : tile.children) {
            below.push_back(&pieces_[child]);
            error = std::max(error, tiles_[child].error);
        }
        const TilePiece all = joined(below);
        std::vector<std::uint8_t> held(all.numbers.size());
        for (std::size_t v = 0; v < held.size(); ++v) held[v] = is_held(all.numbers[v], cuts_.tiles[t]);
        CoarserTile coarser = coarser_tile(all.mesh, held, error, settings_);
        tile.error = coarser.error;
        for (const Index source : coarser.sources)
            pieces_[t].numbers.push_back(held[source] ? all.numbers[source] : none);
        pieces_[t].mesh = std::move(coarser.mesh);
    }

    bool is_held(Index number, const FaceCut& tile) const {
        return number != none && ((!held_.empty() && held_[number]) || leaves_.shared(number, tile));
    }

    PyramidSettings settings_;
    const std::vector<std::uint8_t>& held_; ///< [vertices] 1 if held for other meshes; may be empty
    FaceCuts cuts_;
    std::vector<PyramidTile> tiles_;
    std::vector<TilePiece> pieces_; ///< [tiles] pieces
    LeavesOfPlaces leaves_;
};

} // namespace

std::vector<PyramidTile> make_pyramid(const Mesh& mesh, const PyramidSettings& settings,
                                      const std::vector<std::uint8_t>& held) {
    return PyramidMaker(mesh, settings, held).run();
}

CoarserTile coarser_tile(const Mesh& joined, const std::vector<std::uint8_t>& held, double error_below,
                         const PyramidSettings& settings) {
    SimplifyResult r = simplified(joined, held, settings.faces);
    put_on_steps(r.mesh, settings.step);
    DeviationSettings measured;
    measured.samples = joined.face_count();
    measured.means = false;
    const double own = r.unchanged ? 0 : deviation(joined, r.mesh, measured).maximum();
    return {std::move(r.mesh), error_below + own, std::move(r.sources)};
}

} // namespace facetmill
