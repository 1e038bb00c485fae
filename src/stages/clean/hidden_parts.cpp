#include "stages/clean/hidden_parts.hpp"

#include "base/text/readable_numbers.hpp"
#include "geometry/edit/surgery.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "io/gltf/gltf.hpp"
#include "io/gltf/read/animation_poses.hpp"
#include "io/gltf/read/skinned_pose.hpp"
#include "mesh/face.hpp"
#include "stage/bind_pose.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::clean_stage {

namespace {

constexpr std::size_t most_triangles = std::size_t{1} << 26; // of all instances

/// Calls work, and ignores a document whose nodes or animations are malformed, which no viewer can show.
template <class Work>
void unless_malformed(Work&& work) {
    try {
        work();
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::malformed) throw;
    }
}

/// [parts] 1: viewers draw the part, and nothing moves it.
std::vector<std::uint8_t> judged_parts(const Scene& scene) {
    std::vector<io::PartView> views(scene.parts.size());
    unless_malformed([&] { views = io::part_views(scene); });
    const bool any_drawn =
        std::any_of(views.begin(), views.end(), [](const io::PartView& v) { return v.is_drawn(); });
    std::vector<std::uint8_t> judged(views.size());
    for (std::size_t i = 0; i < views.size(); ++i) {
        const Part& part = scene.parts[i];
        bool moves = views[i].animated;
        if (!moves && part.document >= 0 && has_poses(part))
            unless_malformed([&] {
                const auto& document = scene.documents.at(static_cast<std::size_t>(part.document));
                moves = !io::AnimationPoses(*document, 2).of(part).empty();
            });
        judged[i] = !moves && (views[i].is_drawn() || !any_drawn);
    }
    return judged;
}

/// Adds a mesh at a place, with numbers from first_face.
void add_surface(Surface& all, const Surface& mesh, const Transform& place, Index first_face) {
    const std::size_t triangles = all.size() + mesh.size(), points = all.positions.size();
    if (triangles > most_triangles || points + mesh.positions.size() > 3 * most_triangles)
        throw Error(
            ErrorKind::limit, "E-LIMIT",
            fmt::format("clean: hidden faces of more than {} triangles, with all instances, cannot be found",
                        grouped(most_triangles)),
            "clean parts of the scene in separate runs");
    for (const Vec3& p : mesh.positions) all.positions.push_back(place.point(p));
    for (const Index v : mesh.corners) all.corners.push_back(static_cast<Index>(points) + v);
    for (std::size_t t = 0; t < mesh.size(); ++t) all.faces.push_back(first_face + mesh.face(t));
}

} // namespace

HiddenOfParts::HiddenOfParts(const CleanOptions& o, const Scene& scene, Context& context) {
    if (!o.hidden) return;
    const double diagonal = scene.bounds().diagonal();
    const double gap = o.gap ? context.resolve(*o.gap, scene, "gap") : diagonal / 100;
    if (!(gap > 0)) return; // a single point hides nothing
    first_.reserve(scene.parts.size());
    Index first = 0;
    for (const Part& part : scene.parts) {
        first_.push_back(first);
        first += static_cast<Index>(part.mesh.face_count());
    }
    const std::vector<std::uint8_t> judged = judged_parts(scene);
    keeps_.assign(judged.size(), 0);
    for (std::size_t i = 0; i < judged.size(); ++i) keeps_[i] = !judged[i];
    const auto pose = io::posed(scene);
    Surface all;
    add_parts(pose ? *pose : scene, judged, all);
    const FaceTree tree(all, FaceTree::Use::rays);
    found_ = hidden_faces(all, tree, scene.face_count(), {.gap = gap});
}

void HiddenOfParts::add_parts(const Scene& shown, const std::vector<std::uint8_t>& judged, Surface& all) {
    std::vector<std::uint8_t> placed(judged.size());
    std::optional<std::size_t> known; // all places of a part follow each other
    Surface surface;
    const auto add = [&](std::size_t i, const Transform& place) {
        placed[i] = 1;
        if (known != i) surface = filled_surface(shown.parts[i].mesh);
        known = i;
        add_surface(all, surface, place, first_[i]);
    };
    unless_malformed([&] {
        io::for_each_place_of_instances(shown, [&](std::size_t i, const Transform& place, double times) {
            if (!judged[i]) return;
            add(i, place);
            if (times > 1) keeps_[i] = 1; // these are a sample of its instances
        });
    });
    for (std::size_t i = 0; i < judged.size(); ++i)
        if (judged[i] && !placed[i]) add(i, shown.parts[i].transform);
}

std::optional<HiddenCounts> HiddenOfParts::remove(Part& part, std::size_t number) const {
    if (first_.empty()) return {};
    HiddenCounts counts{0, 0, found_.outer_rays, found_.face_rays};
    if (keeps_[number]) return counts;
    std::vector<std::uint8_t> gone(part.mesh.face_count());
    for (Index f = 0; f < gone.size(); ++f) {
        gone[f] = found_.flags[first_[number] + f];
        if (!gone[f]) continue;
        ++counts.faces;
        counts.area += length(area_vector(part.mesh, f, part.transform)) / 2;
    }
    if (counts.faces > 0) part.mesh = keep_faces(part.mesh, faces_without(gone));
    return counts;
}

} // namespace facetmill::clean_stage
