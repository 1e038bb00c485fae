#include "geometry/orient/orient.hpp"

#include "geometry/intersect/self_intersections.hpp"
#include "geometry/spatial/components_around.hpp"
#include "geometry/spatial/rays.hpp"
#include "mesh/face.hpp"
#include "mesh/placement.hpp"
#include "mesh/power_scale.hpp"
#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace facetmill {

namespace {

/// The components, and the faces that must be reversed so that neighbours agree.
struct Spread {
    std::vector<OrientedComponent> components;
    std::vector<Index> component_of;
    std::vector<std::uint8_t> flips;
};

/// Searches breadth-first over edges with two faces, from the lowest face of each component.
class Spreader {
  public:
    explicit Spreader(const Mesh& mesh) : mesh_(mesh), edges_(build_edges(mesh)), faces_(corner_faces(mesh)) {
        for (Index e = 0; e < edges_.size(); ++e)
            if (edges_.corners_of(e).size() > 2) look_past_spikes(e);
    }

    Spread run() {
        out_.component_of.assign(mesh_.face_count(), none);
        out_.flips.assign(mesh_.face_count(), 0);
        for (Index f = 0; f < mesh_.face_count(); ++f)
            if (out_.component_of[f] == none) spread_from(f);
        return std::move(out_);
    }

  private:
    /// A face that runs along an edge back and forth (a corner is repeated) does not end at this edge. If
    /// exactly two other faces do, they become neighbours.
    void look_past_spikes(Index e) {
        std::vector<Index> others;
        for (const Index c : edges_.corners_of(e)) {
            const auto back = std::find_if(others.begin(), others.end(), [&](Index d) {
                return faces_[c] == faces_[d] && mesh_.vertex(c) != mesh_.vertex(d);
            });
            if (back == others.end())
                others.push_back(c);
            else
                others.erase(back);
        }
        if (others.size() == 2) {
            across_[others[0]] = others[1];
            across_[others[1]] = others[0];
        }
        for (const Index c : edges_.corners_of(e))
            if (std::find(others.begin(), others.end(), c) == others.end()) across_[c] = none;
    }

    void spread_from(Index first) {
        OrientedComponent component;
        component.first_face = first;
        component.closed = true;
        std::vector<Index> queue{first};
        out_.component_of[first] = static_cast<Index>(out_.components.size());
        for (std::size_t at = 0; at < queue.size(); ++at) visit(queue[at], component, queue);
        component.faces = queue.size();
        const auto turned = static_cast<std::size_t>(
            std::count_if(queue.begin(), queue.end(), [&](Index f) { return out_.flips[f] != 0; }));
        // The front follows the majority of the faces. A component that cannot be oriented stays unchanged.
        const bool other = 2 * turned > queue.size();
        for (const Index f : queue) out_.flips[f] = component.orientable && (out_.flips[f] != 0) != other;
        out_.components.push_back(component);
    }

    void visit(Index f, OrientedComponent& component, std::vector<Index>& queue) {
        for (Index c = mesh_.face_begin(f); c < mesh_.face_end(f); ++c) {
            const Index e = edges_.corner_edge[c];
            if (e == none) continue;
            const auto corners = edges_.corners_of(e);
            Index other = corners[0] == c ? corners.back() : corners[0];
            if (corners.size() != 2) {
                const auto found = across_.find(c);
                component.closed &= found != across_.end();
                if (found == across_.end() || found->second == none) continue;
                other = found->second;
            }
            const Index g = faces_[other];
            const bool turns = (mesh_.vertex(other) == mesh_.vertex(c)) != (out_.flips[f] != 0);
            if (out_.component_of[g] == none) {
                out_.component_of[g] = out_.component_of[f];
                out_.flips[g] = turns;
                queue.push_back(g);
            } else if ((out_.flips[g] != 0) != turns && component.orientable) {
                component.orientable = false;
                component.conflict = mix(mesh_.point(c), mesh_.point(next_corner(mesh_, f, c)), 0.5);
            }
        }
    }

    const Mesh& mesh_;
    EdgeTable edges_;
    std::vector<Index> faces_;
    std::map<Index, Index> across_; ///< for corners at crowded edges, see look_past_spikes
    Spread out_;
};

/// Finds the components of a consistent mesh that must be reversed so that their front is outside.
class Outside {
  public:
    Outside(const Mesh& mesh, Spread& spread, Nested nested)
        : mesh_(mesh), spread_(spread), nested_(nested), rays_(surface_of(mesh), FaceTree::Use::rays),
          faces_(spread.components.size()), scale_(even_scale(mesh.bounds())) {
        for (Index f = 0; f < mesh.face_count(); ++f) faces_[spread.component_of[f]].push_back(f);
    }

    std::vector<std::uint8_t> run() {
        find_depths();
        std::vector<std::uint8_t> turns(spread_.components.size(), 0);
        parallel_for(
            turns.size(),
            [&](std::size_t p) {
                OrientedComponent& component = spread_.components[p];
                if (!component.orientable) return;
                const bool cavity = nested_ == Nested::cavities && component.depth % 2 == 1;
                const double out = component.closed ? volume(p) : votes(p);
                component.undecided = !(out > 0 || out < 0) && has_sides(p);
                turns[p] = cavity ? out > 0 : out < 0;
            },
            1);
        return turns;
    }

  private:
    /// Whether a face of the component has a front: three different corners.
    bool has_sides(std::size_t p) const {
        return std::any_of(faces_[p].begin(), faces_[p].end(), [&](Index f) {
            std::set<Index> vertices;
            for (Index c = mesh_.face_begin(f); c < mesh_.face_end(f); ++c) vertices.insert(mesh_.vertex(c));
            return vertices.size() > 2;
        });
    }

    /// Six times the volume of a closed component; only its sign counts.
    double volume(std::size_t p) const {
        const double plain = volume(p, [](const Vec3& v) { return v; });
        if (std::abs(plain) > 1e-200 && std::isfinite(plain)) return plain;
        Box box;
        for (const Index f : faces_[p]) add_corners(box, mesh_, f);
        return volume(p, axis_scale(box));
    }

    template <class Scale>
    double volume(std::size_t p, const Scale& scale) const {
        const Vec3 origin = scale(mesh_.point(mesh_.face_begin(faces_[p][0])));
        const auto at = [&](Index c) { return scale(mesh_.point(c)) - origin; };
        return parallel_reduce(
            faces_[p].size(), 0.0,
            [&](std::size_t begin, std::size_t end) {
                double six = 0;
                for (std::size_t i = begin; i < end; ++i) {
                    const Index f = faces_[p][i], first = mesh_.face_begin(f);
                    for (Index c = first + 1; c + 1 < mesh_.face_end(f); ++c)
                        six += dot(at(first), cross(at(c), at(c + 1)));
                }
                return six;
            },
            [](double a, double b) { return a + b; });
    }

    /// Finds the number of closed components that contain each closed component. A component that touches or
    /// intersects another is not nested in it, because overlapping solids are not cavities of each other.
    void find_depths() {
        std::vector<std::vector<Index>> around(spread_.components.size());
        parallel_for(
            around.size(),
            [&](std::size_t p) {
                if (spread_.components[p].orientable && spread_.components[p].closed)
                    around[p] = components_around(rays_, mesh_.point(mesh_.face_begin(faces_[p][0])),
                                                  spread_.component_of, [&](Index q) {
                                                      const OrientedComponent& c = spread_.components[q];
                                                      return q != p && c.closed && c.orientable;
                                                  });
            },
            1);
        if (std::all_of(around.begin(), around.end(), [](const auto& a) { return a.empty(); })) return;
        const auto meeting = intersecting_components(around);
        for (Index p = 0; p < around.size(); ++p)
            for (const Index q : around[p])
                spread_.components[p].depth += !meeting.contains({std::min(p, q), std::max(p, q)});
    }

    /// The pairs of possibly nested components whose faces meet.
    std::set<std::pair<Index, Index>>
    intersecting_components(const std::vector<std::vector<Index>>& around) const {
        constexpr std::size_t max_pairs = std::size_t{1} << 24;
        SelfIntersectionSettings settings{.limit = max_pairs};
        settings.among.resize(mesh_.face_count());
        for (Index f = 0; f < mesh_.face_count(); ++f)
            settings.among[f] = !around[spread_.component_of[f]].empty();
        std::set<std::pair<Index, Index>> meeting;
        for (const auto& [f, g] : find_self_intersections(mesh_, settings).pairs) {
            const Index p = spread_.component_of[f], q = spread_.component_of[g];
            if (p != q) meeting.emplace(std::min(p, q), std::max(p, q));
        }
        return meeting;
    }

    /// Casts rays along the axes from faces spread over the component. Returns the share of front sides that
    /// see the outside, minus the share of back sides. Only the component itself blocks rays.
    double votes(std::size_t p) const {
        constexpr std::size_t most = 256;
        const auto& faces = faces_[p];
        const std::size_t samples = std::min(most, faces.size());
        double front = 0;
        for (std::size_t s = 0; s < samples; ++s) {
            const Index f = faces[s * faces.size() / samples];
            const Vec3 area = area_vector_at(mesh_, f, [&](Index c) { return scale_(mesh_.point(c)); }),
                       from = corner_mean(mesh_, f);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double weight = std::abs(area[axis]);
                if (!(weight > 0)) continue;
                const auto free = [&](bool forward) {
                    bool escapes = true;
                    visit_along_axis(rays_, from, axis, forward, [&](Index g, int) {
                        escapes = escapes && (g == f || spread_.component_of[g] != p);
                    });
                    return escapes;
                };
                const bool before = free(area[axis] > 0), behind = free(!(area[axis] > 0));
                front += weight * (static_cast<double>(before) - static_cast<double>(behind));
            }
        }
        return front;
    }

    const Mesh& mesh_;
    Spread& spread_;
    Nested nested_;
    FaceTree rays_;
    std::vector<std::vector<Index>> faces_;
    PowerScale scale_; ///< scale of the areas that weigh votes
};

} // namespace

std::vector<std::uint8_t> consistent_flips(const Mesh& mesh) { return Spreader(mesh).run().flips; }

OrientResult orient(Mesh mesh, const OrientSettings& settings) {
    OrientResult result;
    std::vector<std::uint8_t> flips(mesh.face_count(), 1);
    if (settings.method != OrientMethod::flip) {
        Spread spread = Spreader(mesh).run();
        flips = spread.flips;
        if (settings.method == OrientMethod::outward) {
            Mesh agreed = bare(mesh); // the input of the search for the outside
            flip_faces(agreed, flips);
            const auto turns = Outside(agreed, spread, settings.nested).run();
            for (Index f = 0; f < flips.size(); ++f) flips[f] = flips[f] != turns[spread.component_of[f]];
        }
        for (Index f = 0; f < flips.size(); ++f)
            spread.components[spread.component_of[f]].flipped += flips[f];
        result.components = std::move(spread.components);
    }
    result.flipped = static_cast<std::size_t>(std::count(flips.begin(), flips.end(), 1));
    result.changes = flip_faces(mesh, flips);
    result.mesh = std::move(mesh);
    return result;
}

namespace {

Vec3 vector_of(const Attribute& a, std::size_t i) { return {a.value(i, 0), a.value(i, 1), a.value(i, 2)}; }

/// The sum of the area vectors of the faces at each wedge that a flagged face uses; zero for other wedges.
std::vector<Vec3> faces_at_wedges(const Mesh& mesh, const std::vector<std::uint8_t>& flags) {
    std::vector<std::uint8_t> touched(mesh.wedge_count(), 0);
    for (Index f = 0; f < flags.size(); ++f)
        if (flags[f])
            for (const Index w : mesh.face_wedges(f)) touched[w] = 1;
    std::vector<Vec3> sums(mesh.wedge_count());
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const Vec3 area = area_vector(mesh, f);
        for (const Index w : mesh.face_wedges(f))
            if (touched[w]) sums[w] += area;
    }
    return sums;
}

/// Reverses normals that point against their faces, and the handedness of their tangents.
void turn_normals(Mesh& mesh, const std::vector<Vec3>& faces) {
    Attribute& normals = *mesh.find("NORMAL", Domain::wedge);
    Attribute* tangents = mesh.find("TANGENT", Domain::wedge);
    parallel_for(mesh.wedge_count(), [&](std::size_t w) {
        const Vec3 n = vector_of(normals, w);
        if (!(dot(n, faces[w]) < 0)) return;
        for (int c = 0; c < 3; ++c) normals.set_value(w, c, -n[static_cast<std::size_t>(c)]);
        if (tangents && tangents->components == 4) tangents->set_value(w, 3, -tangents->value(w, 3));
    });
}

} // namespace

AttributeChanges flip_faces(Mesh& mesh, const std::vector<std::uint8_t>& flags) {
    const bool any = std::find(flags.begin(), flags.end(), std::uint8_t{1}) != flags.end();
    AttributeChanges changes;
    for (const auto& a : mesh.attributes) {
        const bool turns = any && (a.role == Role::normal || a.role == Role::tangent);
        changes.push_back({a.name, a.domain,
                           turns ? AttributeChange::Kind::recomputed : AttributeChange::Kind::kept,
                           turns ? "reversed where it pointed against its faces" : ""});
    }
    if (!any) return changes;
    parallel_for(mesh.face_count(), [&](std::size_t f) {
        if (!flags[f]) return;
        const auto corners = mesh.corners.begin();
        std::reverse(corners + mesh.face_begin(static_cast<Index>(f)) + 1,
                     corners + mesh.face_end(static_cast<Index>(f)));
    });
    const Attribute* normals = mesh.find("NORMAL", Domain::wedge);
    if (normals && normals->components == 3) turn_normals(mesh, faces_at_wedges(mesh, flags));
    return changes;
}

} // namespace facetmill
