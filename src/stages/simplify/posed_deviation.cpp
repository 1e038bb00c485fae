#include "stages/simplify/posed_deviation.hpp"

#include "geometry/deviation/deviation.hpp"
#include "mesh/surface.hpp"
#include "stage/bind_pose.hpp"

#include <algorithm>

namespace facetmill::simplify_stage {

namespace {

constexpr std::size_t most_poses = 32, fewest_poses = 4;
constexpr std::size_t posed_faces = 1000000; // of all compared surfaces together
constexpr std::size_t samples = 2000;        // in each direction; all vertices are measured as well

} // namespace

PosedParts::PosedParts(const Scene& scene, const std::vector<std::uint8_t>& selected) {
    for (std::size_t i = 0; i < scene.parts.size(); ++i)
        if (const Part& part = scene.parts[i]; selected[i] && part.document >= 0 && has_poses(part))
            before_.emplace(i, part.mesh);
}

std::optional<PosedDeviation> PosedParts::compare(const Scene& scene, std::size_t number,
                                                  const Part& result) {
    const auto before = before_.find(number);
    if (before == before_.end()) return {};
    std::vector<io::AnimationPoses::Pose> poses;
    try {
        const auto& document = scene.documents.at(static_cast<std::size_t>(result.document));
        Part given = result;
        given.mesh = before->second;
        poses = poses_.try_emplace(result.document, *document, most_poses).first->second.of(given);
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::malformed) throw; // no viewer can play it
    }
    const std::size_t faces = before->second.face_count() + result.mesh.face_count();
    const std::size_t most =
        std::clamp(posed_faces / std::max<std::size_t>(faces, 1), fewest_poses, most_poses);
    if (poses.empty()) return {};
    PosedDeviation largest;
    largest.poses = std::min(most, poses.size());
    const auto surface = [&](const Mesh& mesh, const io::AnimationPoses::Pose& pose) {
        Part part;
        part.transform = result.transform;
        part.mesh = io::posed_mesh(mesh, pose);
        return surface_of(part);
    };
    for (std::size_t i = 0; i < largest.poses; ++i) {
        const auto& pose = poses[largest.poses > 1 ? i * (poses.size() - 1) / (largest.poses - 1) : 0];
        const DeviationResult d = deviation(surface(before->second, pose), surface(result.mesh, pose),
                                            {.samples = samples, .means = false});
        if (i > 0 && !(d.maximum() > largest.maximum)) continue;
        largest.maximum = d.maximum();
        largest.percent = d.percent(d.maximum());
        largest.pose = pose.name;
    }
    return largest;
}

} // namespace facetmill::simplify_stage
