#include "geometry/simplify/input.hpp"

#include "geometry/orient/orient.hpp"
#include "geometry/simplify/attributes.hpp"

#include <numeric>

namespace facetmill::simplification {

namespace {

using Stop = SimplifyResult::Stop;
using Method = SimplifySettings::Method;

/// Removes the unused vertices, and renumbers the vertex locks. Changes nothing if no single vertex is
/// locked.
SimplifyLocks by_used_vertices(SimplifyLocks lock, Mesh& mesh) {
    if (lock.vertices.empty()) return lock;
    std::vector<std::uint8_t> used(mesh.vertex_count()), locked;
    for (Index c = 0; c < mesh.corner_count(); ++c) used[mesh.vertex(c)] = 1;
    for (std::size_t v = 0; v < used.size(); ++v)
        if (used[v]) locked.push_back(lock.vertices[v]);
    drop_unused(mesh);
    lock.vertices = std::move(locked);
    return lock;
}

/// Restores the normals of a flat-shaded mesh, and records the changes to normals.
void settle_normals(Mesh& mesh, const NormalSeams& seams, AttributeChanges& changes) {
    using Shading = NormalSeams::Shading;
    if (seams.shading == Shading::as_given) return;
    if (seams.shading == Shading::faceted) set_facet_normals(mesh);
    for (AttributeChange& change : changes) {
        if (change.domain != Domain::wedge) continue;
        if (change.attribute == "NORMAL")
            change = {change.attribute, change.domain, AttributeChange::Kind::recomputed,
                      seams.shading == Shading::faceted ? "flat shading: the normals of the new faces"
                                                        : "area-weighted where seams below the feature angle "
                                                          "were merged, interpolated elsewhere"};
        else if (change.attribute == "TANGENT")
            change = {change.attribute, change.domain, AttributeChange::Kind::interpolated,
                      "the first tangent of each merged normal seam, mixed at new elements"};
    }
}

void turn_round(Mesh& mesh, std::size_t f) { std::swap(mesh.corners[3 * f + 1], mesh.corners[3 * f + 2]); }

} // namespace

SimplifyInput::SimplifyInput(Mesh given, const SimplifySettings& settings)
    : given_(std::move(given)), settings_(settings), lock_(by_used_vertices(settings.lock, given_)),
      seams_(merge_seams()), used_(prepared()) {
    start_.shading = seams_.shading;
    start_.merged_wedges = seams_.merged;
    start_.faces_given = given_.face_count();
    start_.faces_before = start_.faces_after = faces();
    start_.vertices_before = start_.vertices_after = vertices();
    if (settings.method != Method::constrained) start_.largest_error = 0;
}

State SimplifyInput::state(bool rollback, const std::vector<float>* limits) {
    State s = laid_out();
    if (borders_) s.features->side_of_wedge = &borders_->sides();
    if (settings_.method == Method::quadric || settings_.method == Method::quadric_endpoints) {
        set_quadrics(s);
        s.quadrics->attributes =
            attribute_error(s, mesh(), settings_.weights, seams_.shading != NormalSeams::Shading::faceted);
    }
    resize_large(s.edges.cost, s.tri.size(),
                 never); // allocated now, because computing the quadrics temporarily needs more memory
    s.rules = {.endpoints = settings_.method == Method::quadric_endpoints,
               .changes_topology = settings_.topology == SimplifySettings::Topology::allow,
               .apart = lock_.apart && !lock_.vertices.empty() ? &lock_.vertices : nullptr};
    if (settings_.max_quadric_error && s.quadrics) {
        const double max_error = *settings_.max_quadric_error * s.frame.scale;
        s.bounds.max_squared_error = max_error * max_error;
    }
    if (rollback || carries_attributes(mesh())) s.log.emplace().features = feature_corners(s);
    if (limits) {
        s.bounds.limits.emplace();
        for (const Index v : s.source) s.bounds.limits->push_back((*limits)[v]);
    }
    return s;
}

SimplifyResult SimplifyInput::unchanged(Stop stop) const {
    SimplifyResult r = start_;
    r.stop = stop;
    r.unchanged = true;
    r.mesh = given_;
    if (!lock_.vertices.empty()) {
        r.sources.resize(given_.vertex_count());
        std::iota(r.sources.begin(), r.sources.end(), Index{0});
    }
    r.changes = kept_changes(given_.attributes);
    return r;
}

SimplifyResult SimplifyInput::result(Stop stop, const Shape& shape, const std::optional<Log>& log,
                                     const Outcome& done) const {
    SimplifyResult r = start_;
    r.stop = stop;
    r.passes = done.passes;
    r.collapses = done.collapses;
    if (r.largest_error) r.largest_error = std::sqrt(done.largest) / shape.frame.scale;
    Finished finished = finish(shape, mesh(), log ? &*log : nullptr);
    if (!lock_.vertices.empty()) r.sources = shape.source;
    if (borders_) borders_->separate(finished.mesh, finished.wedges, finished.changes, r.sources);
    r.mesh = std::move(finished.mesh);
    for (std::size_t f = 0; f < r.mesh.face_count() && !turned_.empty(); ++f)
        if (turned_[shape.face_source[f]]) turn_round(r.mesh, f);
    r.changes = std::move(finished.changes);
    r.faces_after = r.mesh.face_count();
    r.vertices_after = r.mesh.vertex_count();
    settle_normals(r.mesh, seams_, r.changes);
    return r;
}

NormalSeams SimplifyInput::merge_seams() {
    NormalSeams seams;
    if (given_.has_seams() && given_.find("NORMAL", Domain::wedge)) {
        seams = merge_normal_seams(own_.emplace(given_), settings_.feature_angle);
        if (seams.merged == 0) own_.reset();
    }
    return seams;
}

const Mesh& SimplifyInput::prepared() {
    if (!given_.all_triangles()) own_ = triangulated(mesh());
    return mesh();
}

State SimplifyInput::laid_out() {
    if (settings_.method == Method::cluster)
        return carries_attributes(mesh()) ? classified() : lay_out(mesh(), used_);
    State s = classified();
    if (join_borders(s)) s = classified();
    if (orient_faces(s)) s = classified();
    return s;
}

State SimplifyInput::classified() const {
    // The length of an edge ignores the outline, but the quadrics of other methods include it. If topology
    // may change, holes may close, and small components may vanish with their corners.
    const bool corners =
        settings_.method == Method::shortest_edge && settings_.topology == SimplifySettings::Topology::keep;
    State s = lay_out(mesh(), used_);
    classify(s, mesh(), lock_, corners ? std::optional(settings_.feature_angle) : std::nullopt);
    return s;
}

bool SimplifyInput::join_borders(const State& s) {
    if (borders_ || lock_.boundary || settings_.method == Method::constrained) return false;
    const std::vector<Index> target = CoincidentBorders::find(s, mesh());
    if (target.empty()) return false;
    if (!own_) own_.emplace(given_);
    borders_.emplace(*own_, target);
    used_ = UsedVertices(*own_);
    for (Index v = 0; v < lock_.vertices.size(); ++v) lock_.vertices[target[v]] |= lock_.vertices[v];
    return true;
}

bool SimplifyInput::orient_faces(const State& s) {
    const bool pinned =
        std::find(s.features->kind.begin(), s.features->kind.end(), Kind::pinned) != s.features->kind.end();
    if (!pinned || !turned_.empty()) return false;
    std::vector<std::uint8_t> turned = consistent_flips(mesh());
    start_.turned = static_cast<std::size_t>(std::count(turned.begin(), turned.end(), 1));
    if (start_.turned == 0) return false;
    if (!own_) own_.emplace(given_);
    for (std::size_t f = 0; f < turned.size(); ++f)
        if (turned[f]) turn_round(*own_, f);
    turned_ = std::move(turned);
    return true;
}

} // namespace facetmill::simplification
