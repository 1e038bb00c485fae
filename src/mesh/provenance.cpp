#include "mesh/provenance.hpp"

#include "base/error.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace facetmill {

namespace {

/// The old elements from which a new element comes, with weights that sum to one.
struct Parents {
    std::span<const Index> sources;
    std::span<const double> weights;
};

/// A provenance with the number of old elements: the counts of each kind, and the parents of any element.
struct Ancestry {
    const Provenance& element_provenance;
    bool identity;
    std::span<const Index> copied; ///< old indices; empty with identity
    std::size_t copies;

    Ancestry(const Provenance& l, std::size_t old) : Ancestry(l, l.identity, l.copies, old) {}
    Ancestry(const Provenance& mixed, bool same, std::span<const Index> from, std::size_t old)
        : element_provenance(mixed), identity(same), copied(from), copies(same ? old : from.size()) {}
    std::size_t mixed() const { return element_provenance.edges.size() + element_provenance.mixes(); }
    std::size_t size() const { return copies + mixed(); }

    /// Parents of mixed element i (edges first); `sources` and `weights` hold the parents of an edge.
    Parents parents(std::size_t i, std::array<Index, 2>& sources, std::array<double, 2>& weights) const {
        if (i < element_provenance.edges.size()) {
            const auto& e = element_provenance.edges[i];
            sources = {e.a, e.b};
            weights = {1 - e.t, e.t};
            return {sources, weights};
        }
        i -= element_provenance.edges.size();
        const std::size_t begin = element_provenance.mix_offsets[i],
                          n = element_provenance.mix_offsets[i + 1] - begin;
        return {{element_provenance.mix_sources.data() + begin, n},
                {element_provenance.mix_weights.data() + begin, n}};
    }

    /// Calls body(new element, its parents) for every mixed element, in parallel unless they are chained.
    template <class Body>
    void for_mixed(Body&& body) const {
        const auto one = [&](std::size_t i) {
            std::array<Index, 2> sources;
            std::array<double, 2> weights;
            body(copies + i, parents(i, sources, weights));
        };
        if (!element_provenance.chained) return parallel_for(mixed(), one);
        for (std::size_t i = 0; i < mixed(); ++i) one(i);
    }
};

template <class T>
void copy_elements(std::vector<T>& to, const std::vector<T>& from, const Ancestry& ancestry, std::size_t k) {
    if (ancestry.identity) {
        parallel_chunks(ancestry.copies * k, [&](std::size_t begin, std::size_t end) {
            std::copy(&from[begin], from.data() + end, &to[begin]);
        });
        return;
    }
    parallel_for(ancestry.copies,
                 [&](std::size_t i) { std::copy_n(&from[ancestry.copied[i] * k], k, &to[i * k]); });
}

constexpr std::size_t max_components = 16; // glTF's MAT4; wider attributes are mixed piece by piece

/// The weighted sums of components [c, c + n) over the parents.
template <class T>
void mix_components(const T* from, std::size_t k, std::size_t c, std::size_t n, const Parents& parents,
                    double* sums) {
    std::fill_n(sums, n, 0.0);
    for (std::size_t p = 0; p < parents.sources.size(); ++p)
        for (std::size_t i = 0; i < n; ++i)
            sums[i] += parents.weights[p] * static_cast<double>(from[parents.sources[p] * k + c + i]);
}

/// Scales the first three sums to unit length (to the type's maximum for normalised integers). If they
/// cancel, uses the first parent's direction.
template <class T>
void renormalise(double* sums, const T* first_parent) {
    double scale = 1;
    if constexpr (std::is_integral_v<T>) scale = static_cast<double>(std::numeric_limits<T>::max());
    const Vec3 unit = normalised({sums[0], sums[1], sums[2]});
    if (dot(unit, unit) > 0)
        for (std::size_t i = 0; i < 3; ++i) sums[i] = unit[i] * scale;
    else
        for (std::size_t i = 0; i < 3; ++i) sums[i] = static_cast<double>(first_parent[i]);
}

template <class T>
void mix_element(const Attribute& a, const std::vector<T>& from, T* to, const Parents& parents) {
    const auto k = static_cast<std::size_t>(a.components);
    const T* first_parent = &from[parents.sources[0] * k];
    if (a.role == Role::index || parents.sources.size() == 1) {
        std::copy_n(first_parent, k, to);
        return;
    }
    double sums[max_components];
    for (std::size_t c = 0; c < k; c += max_components) {
        const std::size_t n = std::min(max_components, k - c);
        mix_components(from.data(), k, c, n, parents, sums);
        if (c == 0 && k >= 3 && (a.role == Role::normal || a.role == Role::tangent))
            renormalise(sums, first_parent);
        if (c == 0 && k == 4 && a.role == Role::tangent) sums[3] = static_cast<double>(first_parent[3]);
        for (std::size_t i = 0; i < n; ++i) to[c + i] = as_component<T>(sums[i]);
    }
}

/// The attribute of the new elements, in a single pass.
Attribute inherited(const Attribute& from, const Ancestry& ancestry) {
    Attribute to{from.name, from.domain, from.role, from.components, from.normalised, {}};
    const auto k = static_cast<std::size_t>(from.components);
    std::visit(
        [&](const auto& old) {
            std::decay_t<decltype(old)> renewed(ancestry.size() * k);
            copy_elements(renewed, old, ancestry, k);
            const auto& parents = ancestry.element_provenance.chained ? renewed : old;
            if (from.role != Role::joints &&
                from.role != Role::weights) // joints and weights are mixed together
                ancestry.for_mixed(
                    [&](std::size_t i, const Parents& p) { mix_element(from, parents, &renewed[i * k], p); });
            to.data = std::move(renewed);
        },
        from.data);
    return to;
}

struct Influence {
    double joint, weight;
};

/// The joint sets of a mesh and their weights, paired by the number at the end of their names.
struct Skin {
    std::vector<const Attribute*> joints, weights;
    std::vector<Attribute*> new_joints, new_weights;

    Skin(const Mesh& from, Mesh& to) {
        for (const auto& a : from.attributes) {
            if (a.role != Role::joints) continue;
            const auto suffix = a.name.substr(std::min(a.name.size(), a.name.rfind('_')));
            for (const auto& b : from.attributes)
                if (b.role == Role::weights && b.domain == a.domain && b.components == a.components &&
                    b.name.ends_with(suffix)) {
                    joints.push_back(&a);
                    weights.push_back(&b);
                    new_joints.push_back(to.find(a.name, a.domain));

                    new_weights.push_back(to.find(b.name, b.domain));
                    break;
                }
        }
    }
};

/// Sums the weights of equal joints and sorts the strongest first, ties by joint.
void unite(std::vector<Influence>& all) {
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
        return a.joint < b.joint;
    }); // adjacent joints are then summed
    std::size_t kept = 0;
    for (const auto& i : all) {
        if (kept > 0 && all[kept - 1].joint == i.joint)
            all[kept - 1].weight += i.weight;
        else
            all[kept++] = i;
    }
    all.resize(kept);
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
        return a.weight != b.weight ? a.weight > b.weight : a.joint < b.joint;
    });
}

/// Adds the rounding error of fractional weights to the strongest weight, so that they still sum to one.
void settle_rounding(const Skin& skin, std::size_t element) {
    double rest = 1;
    for (const auto* w : skin.new_weights)
        for (int c = 0; c < w->components; ++c) rest -= w->value(element, c);
    Attribute& first = *skin.new_weights[0];
    if (first.normalised) first.set_value(element, 0, first.value(element, 0) + rest);
}

void mix_skin(const Skin& skin, std::size_t element, const Parents& parents, std::vector<Influence>& all) {
    if (parents.sources.size() == 1) {
        for (std::size_t s = 0; s < skin.joints.size(); ++s)
            for (int c = 0; c < skin.joints[s]->components; ++c) {
                skin.new_joints[s]->set_value(element, c, skin.joints[s]->value(parents.sources[0], c));
                skin.new_weights[s]->set_value(element, c, skin.weights[s]->value(parents.sources[0], c));
            }
        return;
    }
    all.clear();
    std::size_t slots = 0;
    for (std::size_t s = 0; s < skin.joints.size(); ++s) {
        slots += static_cast<std::size_t>(skin.joints[s]->components);
        for (std::size_t p = 0; p < parents.sources.size(); ++p)
            for (int c = 0; c < skin.joints[s]->components; ++c) {
                const double w = parents.weights[p] * skin.weights[s]->value(parents.sources[p], c);
                if (w > 0) all.push_back({skin.joints[s]->value(parents.sources[p], c), w});
            }
    }
    unite(all);
    if (all.size() > slots) all.resize(slots);
    double sum = 0;
    for (const auto& i : all) sum += i.weight;
    std::size_t slot = 0;
    for (std::size_t s = 0; s < skin.joints.size(); ++s)
        for (int c = 0; c < skin.joints[s]->components; ++c, ++slot) {
            const Influence i =
                slot < all.size() ? Influence{all[slot].joint, all[slot].weight / sum} : Influence{0, 0};
            skin.new_joints[s]->set_value(element, c, i.joint);
            skin.new_weights[s]->set_value(element, c, i.weight);
        }
    if (!all.empty()) settle_rounding(skin, element);
}

void inherit_skin(Mesh& to, const Mesh& from, const Ancestry& ancestry, Domain domain) {
    const Skin skin(ancestry.element_provenance.chained ? to : from, to);
    if (skin.joints.empty() || skin.joints[0]->domain != domain) return;
    ancestry.for_mixed([&](std::size_t element, const Parents& p) {
        thread_local std::vector<Influence> all;
        mix_skin(skin, element, p, all);
    });
}

AttributeChange change_of(const Attribute& a, const Ancestry& ancestry) {
    AttributeChange change{a.name, a.domain, AttributeChange::Kind::kept, {}};
    if (ancestry.mixed() == 0 || a.role == Role::index) return change;
    change.kind = AttributeChange::Kind::interpolated;
    switch (a.role) {
    case Role::normal:
    case Role::tangent:
        change.why = "mixed at new elements, then normalised";
        break;
    case Role::joints:
    case Role::weights:
        change.why = "combined at new elements: the largest are kept, then normalised";
        break;
    case Role::generic:
    case Role::uv:
    case Role::colour:
    case Role::morph_vector:
    case Role::index:
        change.why = "mixed at new elements";
        break;
    }
    return change;
}

void expect_size(const Mesh& to, Domain domain, std::size_t found) {
    if (to.count(domain) != found)
        throw Error(ErrorKind::bug, "E-BUG",
                    std::string("the provenance of the ") + to_string(domain) + " domain has " +
                        std::to_string(found) + " elements, but the mesh has " +
                        std::to_string(to.count(domain)));
}

} // namespace

bool has_attributes(const Mesh& mesh, Domain domain) {
    return std::any_of(mesh.attributes.begin(), mesh.attributes.end(),
                       [&](const Attribute& a) { return a.domain == domain; });
}

AttributeChanges inherit_attributes(Mesh& to, const Mesh& from, const MeshProvenance& provenance) {
    const Provenance unmixed;
    const Ancestry of_vertices(provenance.vertices, from.vertex_count()),
        of_wedges(provenance.wedges_as_vertices ? provenance.vertices : provenance.wedges,
                  from.wedge_count()),
        of_faces(unmixed, provenance.faces_identity, provenance.faces, from.face_count());
    expect_size(to, Domain::vertex, of_vertices.size());
    expect_size(to, Domain::wedge, of_wedges.size());
    if (has_attributes(from, Domain::face)) expect_size(to, Domain::face, of_faces.size());
    const auto ancestry = [&](Domain d) -> const Ancestry& {
        return d == Domain::vertex ? of_vertices : d == Domain::wedge ? of_wedges : of_faces;
    };
    to.primitives = from.primitives;
    to.attributes.clear();
    AttributeChanges changes;
    for (const auto& a : from.attributes) {
        to.attributes.push_back(inherited(a, ancestry(a.domain)));
        changes.push_back(change_of(a, ancestry(a.domain)));
    }
    inherit_skin(to, from, of_wedges, Domain::wedge);
    inherit_skin(to, from, of_vertices, Domain::vertex);
    return changes;
}

} // namespace facetmill
