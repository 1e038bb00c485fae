#include "geometry/crumple/tested_sheet.hpp"

#include "base/progress.hpp"
#include "geometry/inspect/evidence.hpp"
#include "mesh/face.hpp"

#include <fmt/format.h>
#include <map>

namespace facetmill {

TestSheet::TestSheet(const CrumpleSheet& sheet, const std::vector<Index>& places, std::size_t max_pairs,
                     bool stays_open, const TestSheet* alike)
    : sheet_(sheet), places_(places), max_pairs_(max_pairs), stays_open_(stays_open) {
    before_.resize(from().vertex_count());
    parallel_for(before_.size(), [&](std::size_t v) {
        const Vec3 p = as_float32(from().positions[v]);
        before_[v] = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    });
    weld();
    if (alike && is_same_before(*alike)) {
        exempt_ = alike->exempt_;
        pairs_before_ = alike->pairs_before_;
        flat_ = alike->flat_;
        frame_ = alike->frame_;
    } else {
        remember_exempt();
    }
}

void TestSheet::place(const std::vector<std::uint8_t>& levels, const std::vector<std::uint8_t>& changed,
                      std::vector<std::uint8_t> again) {
    touched_ = std::move(again);
    touched_.resize(face_count());
    if (changed.empty()) std::fill(touched_.begin(), touched_.end(), 1);
    parallel_for(changed.empty() ? 0 : touched_.size(), [&](std::size_t i) {
        const auto f = static_cast<Index>(i);
        for (Index c = from().face_begin(f); c < from().face_end(f); ++c)
            if (changed[places_[from().vertex(c)]]) touched_[f] = 1;
    });
    if (!open_) return;
    Mesh& mesh = open_->mesh;
    parallel_for(mesh.positions.size(), [&](std::size_t v) {
        const Index first = first_[v];
        if (changed.empty() || changed[places_[first]]) mesh.positions[v] = at(first, levels);
    });
    open_->search.move_to(mesh, changed.empty() ? std::vector<std::uint8_t>{} : touched_);
}

std::vector<std::pair<Index, Index>> TestSheet::new_pairs(const std::vector<std::uint8_t>& levels) {
    Open& in = open(levels);
    // If this many pairs are listed, the list contains a new pair if any exists.
    auto pairs = find(in, touched_, exempt_.size() + max_pairs_).pairs;
    std::erase_if(pairs,
                  [&](const auto& p) { return std::binary_search(exempt_.begin(), exempt_.end(), p); });
    for (Index f = 0; f < touched_.size(); ++f)
        if (touched_[f] && !flat_[f] && is_degenerate(in.mesh, f)) pairs.emplace_back(f, f);
    close();
    return pairs;
}

std::vector<std::uint8_t> TestSheet::overstretched(const std::vector<std::uint8_t>& levels,
                                                   double stretch) const {
    std::vector<std::uint8_t> faces(face_count());
    const auto moved = [&](Index v) { return sheet_.moves.moves[v] * share_of(levels[places_[v]]); };
    parallel_for(faces.size(), [&](std::size_t i) {
        const auto f = static_cast<Index>(i);
        double longest = 0, farthest = 0; // squared
        Index u = corner(from().face_end(f) - 1);
        Vec3 before_u = before(u), moved_u = moved(u);
        for (Index c = from().face_begin(f); c < from().face_end(f); ++c) {
            const Index v = corner(c);
            const Vec3 before_v = before(v), moved_v = moved(v);
            const Vec3 edge = before_v - before_u, apart = moved_v - moved_u;
            longest = std::max(longest, dot(edge, edge));
            farthest = std::max(farthest, dot(apart, apart));
            before_u = before_v;
            moved_u = moved_v;
        }
        faces[f] = farthest > stretch * stretch * longest;
    });
    return faces;
}

MeetingFaces TestSheet::in_trouble(const std::vector<std::uint8_t>& levels) {
    if (std::find(touched_.begin(), touched_.end(), 1) == touched_.end())
        return {false, std::vector<std::uint8_t>(face_count()), 0};
    const std::size_t most = std::max(pairs_a_round * face_count(), times_before_a_round * pairs_before_);
    Open& in = open(levels);
    auto found = in.search.faces(touched_, exempt_, most);
    if (!found.too_many)
        parallel_for(found.faces.size(), [&](std::size_t f) {
            if (touched_[f] && !flat_[f] && is_degenerate(in.mesh, static_cast<Index>(f))) found.faces[f] = 1;
        });
    close();
    return found;
}

bool TestSheet::mark(const std::vector<std::uint8_t>& faces, std::size_t rings,
                     std::vector<std::uint8_t>& marked) const {
    if (std::find(faces.begin(), faces.end(), 1) == faces.end()) return false;
    std::vector<std::uint8_t> mine(from().vertex_count());
    const auto mark_face = [&](Index f) {
        for (Index c = from().face_begin(f); c < from().face_end(f); ++c) mine[corner(c)] = 1;
    };
    for (Index f = 0; f < faces.size(); ++f)
        if (faces[f]) mark_face(f);
    for (std::size_t ring = 0; ring < rings; ++ring) {
        const std::vector<std::uint8_t> inner = mine;
        for (Index f = 0; f < faces.size(); ++f)
            for (Index c = from().face_begin(f); c < from().face_end(f); ++c)
                if (inner[corner(c)]) {
                    mark_face(f);
                    break;
                }
        if (mine == inner) break;
    }
    for (std::size_t v = 0; v < mine.size(); ++v)
        if (mine[v]) marked[places_[v]] = 1;
    return true;
}

std::vector<Vec3> TestSheet::positions(const std::vector<std::uint8_t>& levels) const {
    std::vector<Vec3> all(from().vertex_count());
    parallel_for(all.size(), [&](std::size_t v) { all[v] = at(first_[v], levels); });
    return all;
}

Vec3 TestSheet::at(Index vertex, const std::vector<std::uint8_t>& levels) const {
    const double share = levels.empty() ? 0 : share_of(levels[places_[vertex]]);
    if (share == 0) return before(vertex);
    return as_float32(from().positions[vertex] + sheet_.moves.moves[vertex] * share);
}

Mesh TestSheet::mesh_at(const std::vector<std::uint8_t>& levels) const {
    Mesh mesh;
    mesh.face_offsets = from().face_offsets;
    mesh.corners.resize(from().corner_count());
    parallel_for(mesh.corners.size(),
                 [&](std::size_t c) { mesh.corners[c] = corner(static_cast<Index>(c)); });
    mesh.positions.resize(from().vertex_count());
    parallel_for(mesh.positions.size(), [&](std::size_t v) {
        mesh.positions[v] = levels.empty() ? before(static_cast<Index>(v)) : at(first_[v], levels);
    });
    return mesh;
}

TestSheet::Open& TestSheet::open(const std::vector<std::uint8_t>& levels) {
    if (!open_) {
        open_.emplace(mesh_at(levels), frame_);
        frame_ = open_->search.frame();
    }
    return *open_;
}

void TestSheet::close() {
    if (!stays_open_) open_.reset();
}

void TestSheet::weld() {
    const std::size_t n = from().vertex_count();
    std::vector<Index> order(n);
    for (std::size_t v = 0; v < n; ++v) order[v] = static_cast<Index>(v);
    radix_sort(
        order, [&](Index v) { return places_[v]; }, 32);
    first_.resize(n);
    for (std::size_t i = 0, j = 0; i < n; i = j) {
        for (; j < n && places_[order[j]] == places_[order[i]]; ++j) {
            std::size_t k = i;
            while (!(before(order[k]) == before(order[j]))) ++k;
            first_[order[j]] = order[k];
        }
    }
}

bool TestSheet::is_same_before(const TestSheet& other) const {
    const Mesh &a = from(), &b = other.from();
    return first_ == other.first_ && a.positions == b.positions && a.corners == b.corners &&
           a.wedge_vertex == b.wedge_vertex && a.face_offsets == b.face_offsets;
}

void TestSheet::remember_exempt() {
    Open& in = open({});
    const auto found = find(in, {}, max_pairs_);
    if (found.count > found.pairs.size())
        throw Error(
            ErrorKind::limit, "E-LIMIT",
            fmt::format("crumple: {} pairs of faces already intersect, but only {} can be distinguished from "
                        "new ones",
                        found.count, max_pairs_),
            "clean removes duplicate faces; self_intersections: allow does not search for intersections");
    exempt_ = found.pairs;
    pairs_before_ = found.box_pairs;
    flat_.resize(face_count());
    parallel_for(flat_.size(),
                 [&](std::size_t f) { flat_[f] = is_degenerate(in.mesh, static_cast<Index>(f)); });
    close();
}

SelfIntersections TestSheet::find(Open& in, const std::vector<std::uint8_t>& among, std::size_t limit) const {
    SelfIntersectionSettings settings;
    settings.limit = limit;
    settings.among = among;
    auto found = in.search.pairs(settings);
    std::sort(found.pairs.begin(), found.pairs.end());
    return found;
}

std::vector<TestSheet> tests_of(std::span<const CrumpleSheet> sheets, const CrumplePlaces& places,
                                std::size_t max_pairs, std::size_t max_open) {
    std::vector<TestSheet> tests;
    tests.reserve(sheets.size()); // reserved, because pointers refer to the elements
    std::map<std::pair<std::size_t, std::size_t>, const TestSheet*> last; // sheets by size
    std::size_t open = 0;
    ProgressSteps of_sheets(std::vector<double>(sheets.size(), 1));
    for (std::size_t s = 0; s < sheets.size(); ++s) {
        const Mesh& mesh = *sheets[s].mesh;
        open += mesh.corner_count() - 2 * mesh.face_count();
        const TestSheet*& alike = last[{mesh.vertex_count(), mesh.corner_count()}];
        alike =
            &tests.emplace_back(sheets[s], places.of_vertex[s], max_pairs, s == 0 || open <= max_open, alike);
        of_sheets.next();
    }
    return tests;
}

} // namespace facetmill
