#include "base/numbers.hpp"
#include "base/parallel.hpp"
#include "base/random.hpp"
#include "geometry/crumple.hpp"
#include "geometry/evidence.hpp"
#include "geometry/self_intersections.hpp"
#include "mesh/topology.hpp"

#include <algorithm>

namespace facetmill {

namespace {

constexpr std::uint8_t last_level = 9;      ///< no move at all
constexpr int patient_rounds = 8;           ///< after these, the places around are lowered too
constexpr std::size_t most_pairs = 8 << 20; ///< that a round looks at; what is left comes in the next one

double share_of(std::uint8_t level) { return level == last_level ? 0 : 1.0 / (1 << level); }

Vec3 rounded(const Vec3& p) { return {as_float32(p.x), as_float32(p.y), as_float32(p.z)}; }

/// Numbers for equal keys, over all sheets.
struct Places {
    std::vector<std::uint8_t> levels;          ///< [places]
    std::vector<std::vector<Index>> of_vertex; ///< [sheets][vertices]

    explicit Places(std::span<const CrumpleSheet> sheets) {
        struct Item {
            std::uint64_t key;
            std::uint32_t sheet;
            Index vertex;
        };
        std::vector<Item> items;
        for (std::size_t s = 0; s < sheets.size(); ++s) {
            const auto& keys = sheets[s].moves.keys;
            for (Index v = 0; v < keys.size(); ++v)
                items.push_back({keys[v], static_cast<std::uint32_t>(s), v});
            of_vertex.emplace_back(keys.size());
        }
        radix_sort(items, [](const Item& i) { return i.key; });
        Index count = 0;
        for (std::size_t i = 0; i < items.size(); ++i) {
            if (i > 0 && items[i].key != items[i - 1].key) ++count;
            of_vertex[items[i].sheet][items[i].vertex] = count;
        }
        levels.assign(items.empty() ? 0 : std::size_t{count} + 1, 0);
    }
};

/// A sheet as it is tested: vertices at one place are one.
class TestSheet {
  public:
    TestSheet(const CrumpleSheet& sheet, const std::vector<Index>& places) : sheet_(sheet), places_(places) {
        const Mesh& from = *sheet.mesh;
        const std::size_t n = from.vertex_count();
        before_.resize(n);
        parallel_for(n, [&](std::size_t v) { before_[v] = rounded(from.positions[v]); });
        weld();
        mesh_.face_offsets = from.face_offsets;
        mesh_.corners.resize(from.corner_count());
        parallel_for(from.corner_count(),
                     [&](std::size_t c) { mesh_.corners[c] = first_[from.vertex(static_cast<Index>(c))]; });
        mesh_.positions = before_;
        exempt_ = find(std::vector<std::uint8_t>{}).pairs;
        flat_.resize(mesh_.face_count());
        parallel_for(flat_.size(), [&](std::size_t f) { flat_[f] = is_flat(static_cast<Index>(f)); });
    }

    std::size_t exempt() const { return exempt_.size(); }
    const Mesh& mesh() const { return mesh_; }

    /// Puts the vertices whose level has changed where they belong now, and remembers their faces.
    void place(const std::vector<std::uint8_t>& levels, const std::vector<std::uint8_t>& changed) {
        const auto& moves = sheet_.moves.moves;
        parallel_for(mesh_.positions.size(), [&](std::size_t v) {
            const Index from = first_[v];
            if (!changed.empty() && !changed[places_[from]]) return;
            const Vec3& start = sheet_.mesh->positions[from];
            const double share = share_of(levels[places_[from]]);
            mesh_.positions[v] = share == 0 ? before_[from] : rounded(start + moves[from] * share);
        });
        touched_.assign(mesh_.face_count(), changed.empty());
        parallel_for(changed.empty() ? 0 : touched_.size(), [&](std::size_t f) {
            for (const Index v : mesh_.face_wedges(static_cast<Index>(f)))
                if (changed[places_[v]]) touched_[f] = 1;
        });
    }

    /// The new pairs among faces that were touched; a face that lost its area is a pair with itself.
    std::vector<std::pair<Index, Index>> trouble() const {
        auto pairs = find(touched_).pairs;
        std::sort(pairs.begin(), pairs.end());
        std::erase_if(pairs,
                      [&](const auto& p) { return std::binary_search(exempt_.begin(), exempt_.end(), p); });
        for (Index f = 0; f < touched_.size(); ++f)
            if (touched_[f] && !flat_[f] && is_flat(f)) pairs.emplace_back(f, f);
        return pairs;
    }

    /// Marks the places of the faces; with around, of all faces that touch these.
    void mark(const std::vector<std::pair<Index, Index>>& pairs, bool around,
              std::vector<std::uint8_t>& marked) const {
        std::vector<std::uint8_t> mine(mesh_.positions.size());
        const auto mark_face = [&](Index f) {
            for (const Index v : mesh_.face_wedges(f)) mine[v] = 1;
        };
        for (const auto& [a, b] : pairs) mark_face(a), mark_face(b);
        if (around) {
            const std::vector<std::uint8_t> inner = mine;
            for (Index f = 0; f < mesh_.face_count(); ++f)
                for (const Index v : mesh_.face_wedges(f))
                    if (inner[v]) {
                        mark_face(f);
                        break;
                    }
        }
        for (std::size_t v = 0; v < mine.size(); ++v)
            if (mine[v]) marked[places_[v]] = 1;
    }

    const Vec3& position(std::size_t vertex) const { return mesh_.positions[first_[vertex]]; }

  private:
    /// first_[v]: the first vertex at the place of v that starts at the same point.
    void weld() {
        const std::size_t n = before_.size();
        std::vector<Index> order(n);
        for (std::size_t v = 0; v < n; ++v) order[v] = static_cast<Index>(v);
        radix_sort(
            order, [&](Index v) { return places_[v]; }, 32);
        first_.resize(n);
        for (std::size_t i = 0, j = 0; i < n; i = j) {
            for (; j < n && places_[order[j]] == places_[order[i]]; ++j) {
                std::size_t k = i;
                while (!(before_[order[k]] == before_[order[j]])) ++k;
                first_[order[j]] = order[k];
            }
        }
    }

    bool is_flat(Index f) const { return is_degenerate(mesh_, f); }

    SelfIntersections find(const std::vector<std::uint8_t>& among) const {
        SelfIntersectionSettings settings;
        settings.limit = most_pairs;
        settings.among = among;
        auto found = find_self_intersections(mesh_, settings);
        std::sort(found.pairs.begin(), found.pairs.end());
        return found;
    }

    const CrumpleSheet& sheet_;
    const std::vector<Index>& places_;
    std::vector<Vec3> before_;                    ///< [vertices] rounded
    std::vector<Index> first_;                    ///< [vertices]
    Mesh mesh_;                                   ///< corners go to the first of equal vertices
    std::vector<std::pair<Index, Index>> exempt_; ///< ascending
    std::vector<std::uint8_t> flat_, touched_;    ///< [faces]
};

} // namespace

AvoidResult move_apart(std::span<CrumpleSheet> sheets, bool only_look) {
    AvoidResult result;
    Places places(sheets);
    std::vector<TestSheet> tests;
    tests.reserve(sheets.size());
    for (std::size_t s = 0; s < sheets.size(); ++s) {
        tests.emplace_back(sheets[s], places.of_vertex[s]);
        result.exempt += tests.back().exempt();
        tests.back().place(places.levels, {});
    }
    for (bool more = true; more;) {
        std::vector<std::uint8_t> marked(places.levels.size());
        more = false;
        for (std::size_t s = 0; s < tests.size(); ++s) {
            const auto pairs = tests[s].trouble();
            if (pairs.empty()) continue;
            if (result.rounds == 0) {
                if (result.found == 0) result.first = pairs.front(), result.first_sheet = s;
                result.found += pairs.size();
            }
            more = true;
            tests[s].mark(pairs, result.rounds >= patient_rounds, marked);
        }
        if (!more || only_look) break;
        ++result.rounds;
        for (std::size_t p = 0; p < marked.size(); ++p)
            if (marked[p]) places.levels[p] = std::min<std::uint8_t>(last_level, places.levels[p] + 1);
        for (auto& test : tests) test.place(places.levels, marked);
    }
    result.left = only_look ? result.found : 0;
    for (std::size_t s = 0; s < sheets.size(); ++s) {
        auto& positions = sheets[s].mesh->positions;
        for (std::size_t v = 0; v < positions.size(); ++v)
            ++result.shares[places.levels[places.of_vertex[s][v]]];
        parallel_for(positions.size(), [&](std::size_t v) { positions[v] = tests[s].position(v); });
    }
    return result;
}

} // namespace facetmill
