#include "geometry/boolean/combine.hpp"

#include "geometry/boolean/lost_faces.hpp"
#include "geometry/boolean/trial.hpp"
#include "geometry/inspect/evidence.hpp"
#include "geometry/orient/orient.hpp"
#include "mesh/face.hpp"
#include "parallel/memory.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <functional>

namespace facetmill {

namespace {

using namespace clean_steps;

/// Temporary face attribute: the mesh that a face came from.
constexpr std::string_view mesh_name = "facetmill:mesh";

Mesh all_of(std::vector<Mesh> meshes) {
    Mesh all;
    for (Index i = 0; i < meshes.size(); ++i) {
        meshes[i].attributes.push_back({std::string(mesh_name), Domain::face, Role::index, 1, false,
                                        std::vector<std::uint32_t>(meshes[i].face_count(), i)});
        if (i == 0)
            all = std::move(meshes[i]);
        else
            append(all, std::exchange(meshes[i], {}));
    }
    return all;
}

std::span<const std::uint32_t> mesh_of_faces(const Mesh& mesh) {
    return std::get<std::vector<std::uint32_t>>(mesh.find(mesh_name, Domain::face)->data);
}

/// Removes faces without area from surfaces that stay closed without them. Returns true if no such face
/// existed.
bool take_out_degenerate(Work& work) {
    const auto is_any = [&](std::size_t begin, std::size_t end) {
        int any = 0;
        for (auto f = static_cast<Index>(begin); f < end && any == 0; ++f) any = is_degenerate(work.mesh, f);
        return any;
    };
    if (parallel_reduce(work.mesh.face_count(), 0, is_any, std::bit_or<>()) == 0) return true;
    take_out_flat(work);
    remove_degenerate(work);
    return false;
}

/// A failure for the first face whose component is not a solid.
std::optional<CombineFailure> misfit(const Mesh& mesh, const Solids& solids) {
    if (std::find(solids.closed.begin(), solids.closed.end(), 0) == solids.closed.end()) return {};
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const Index p = solids.components.of_face[f];
        if (!solids.closed[p])
            return CombineFailure{fmt::format("it {}", solids.why_not[p]), mesh_of_faces(mesh)[f],
                                  corner_mean(mesh, f)};
    }
    return {};
}

/// A failure for the first mesh with a negative volume, because among other meshes it would count as a
/// cavity.
std::optional<CombineFailure> turned_over(const Mesh& mesh, const Solids& solids, std::size_t meshes) {
    std::vector<double> volumes(meshes, 0);
    std::vector<Index> first(meshes, none);
    std::vector<std::uint8_t> counted(solids.components.count, 0);
    const auto mesh_of = mesh_of_faces(mesh);
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const Index p = solids.components.of_face[f], m = mesh_of[f];
        if (first[m] == none) first[m] = f;
        if (!std::exchange(counted[p], 1)) volumes[m] += solids.six_volumes[p];
    }
    for (Index m = 0; m < meshes; ++m)
        if (volumes[m] < 0) return CombineFailure{"it is inside out", m, corner_mean(mesh, first[m])};
    return {};
}

class Combining {
  public:
    Combining(std::vector<Mesh> meshes, const CombineSettings& settings)
        : settings_(settings), meshes_(meshes.size()) {
        if (meshes_ == 2 && settings_.operation == CombineOperation::unite) settings_.second = 1;
        work_.mesh = all_of(std::move(meshes));
    }

    CombineResult run() {
        const bool had_area = take_out_degenerate(work_);
        constexpr std::uint64_t bytes_a_pair = 32;  // the following steps need the same memory again
        constexpr std::uint64_t bytes_a_face = 170; // measured memory per face
        const std::uint64_t bytes = memory_left().value_or(std::uint64_t{4} << 30);
        if (work_.mesh.face_count() > 0 && bytes < bytes_a_face * work_.mesh.face_count())
            return short_of_memory(fmt::format("combine {} faces", work_.mesh.face_count()), 0);
        const std::size_t most = std::max<std::uint64_t>(1, bytes / (2 * bytes_a_pair));
        const auto place = lowest_at_place(work_.mesh);
        std::vector<std::uint8_t> lost = what_is_lost();
        auto [found, rings] = crossings_and_rings(work_.mesh, place, most, lost);
        if (found.count > found.pairs.size())
            return short_of_memory(fmt::format("list the {} pairs of faces that intersect", found.count),
                                   found.pairs[0].first);
        Solids solids = find_solids(work_.mesh, {}, std::move(rings), had_area);
        if (auto failure = misfit(work_.mesh, solids)) return failed(std::move(*failure));
        if (auto failure = turned_over(work_.mesh, solids, meshes_)) return failed(std::move(*failure));
        for (const auto& pair : overlaps_at_edges(work_.mesh, solids.rings, solids.edges))
            found.pairs.push_back(pair);
        std::sort(found.pairs.begin(), found.pairs.end());
        found.pairs.erase(std::unique(found.pairs.begin(), found.pairs.end()), found.pairs.end());
        make_one_cluster(solids);
        Operands operands = operands_of(solids);
        operands.lost = std::move(lost);
        if (settings_.operation == CombineOperation::subtract) {
            turn_what_is_taken();
            solids.edges = LooseEdges(work_.mesh, solids.rings); // rebuilt for new corners
        }
        return combine(solids, found, operands);
    }

  private:
    static void make_one_cluster(Solids& solids) {
        solids.cluster.assign(solids.components.count, 0);
        solids.at.assign(1, {});
        solids.meets_unfit.assign(1, 0);
    }

    Operands operands_of(const Solids& solids) const {
        Operands operands{settings_.operation, std::vector<std::uint8_t>(solids.components.count, 0)};
        const auto meshes = mesh_of_faces(work_.mesh);
        for (Index f = 0; f < meshes.size(); ++f)
            if (meshes[f] >= settings_.second) operands.second[solids.components.of_face[f]] = 1;
        return operands;
    }

    /// [faces] 1 for faces of the second operand.
    std::vector<std::uint8_t> second_faces() const {
        const auto meshes = mesh_of_faces(work_.mesh);
        std::vector<std::uint8_t> flags(meshes.size());
        for (Index f = 0; f < meshes.size(); ++f) flags[f] = meshes[f] >= settings_.second;
        return flags;
    }

    std::vector<std::uint8_t> what_is_lost() const {
        if (settings_.second >= meshes_) return {};
        return lost_faces(work_.mesh, second_faces(), settings_.operation);
    }

    void turn_what_is_taken() { turned_ = flip_faces(work_.mesh, second_faces()); }

    CombineResult combine(const Solids& solids, const SelfIntersections& found, const Operands& operands) {
        const CleanSettings settings;
        const Vec3 at = found.pairs.empty()
                            ? Vec3{}
                            : corner_mean(work_.mesh, found.pairs[0].first); // position of a failure
        Trial trial(std::move(work_), solids, settings);
        Failures failures = trial.run(found, &operands);
        std::size_t crowded = 0;
        if (failures.empty()) failures = trial.open_clusters(crowded);
        if (failures.empty() && crowded > 0)
            failures.emplace(0, "the result, rounded, would not be edge-manifold");
        if (!failures.empty()) {
            CombineResult result = failed({failures.begin()->second, none, at});
            result.short_of_memory = trial.is_short_of_memory();
            return result;
        }
        return result_of(trial.finish());
    }

    CombineResult result_of(Work work) const {
        CombineResult result;
        const auto meshes = mesh_of_faces(work.mesh);
        result.mesh_of_face.assign(meshes.begin(), meshes.end());
        work.mesh.drop(mesh_name, Domain::face);
        forget_change(work.changes, mesh_name);
        result.changes = changes_in_sequence(turned_, std::move(work.changes));
        result.mesh = std::move(work.mesh);
        result.cut_faces = work.counts.refined_faces;
        result.covered_faces = work.counts.covered_faces;
        return result;
    }

    CombineResult short_of_memory(const std::string& to_do, Index face) const {
        CombineResult result =
            failed({"there is not enough memory to " + to_do, none, corner_mean(work_.mesh, face)});
        result.short_of_memory = true;
        return result;
    }

    static CombineResult failed(CombineFailure failure) {
        CombineResult result;
        result.failure = std::move(failure);
        return result;
    }

    CombineSettings settings_;
    std::size_t meshes_;
    Work work_;
    AttributeChanges turned_;
};

} // namespace

CombineResult combine(std::vector<Mesh> meshes, const CombineSettings& settings) {
    return Combining(std::move(meshes), settings).run();
}

} // namespace facetmill
