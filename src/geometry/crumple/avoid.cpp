#include "base/error.hpp"
#include "base/numbers.hpp"
#include "base/parallel.hpp"
#include "base/random.hpp"
#include "geometry/crumple/crumple.hpp"
#include "geometry/inspect/evidence.hpp"
#include "geometry/intersect/self_intersections.hpp"
#include "mesh/face.hpp"
#include "mesh/topology.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace facetmill {

namespace {

// Vertices by the place that they start from: what is at one place moves together.

/// Places of all sheets, numbered by their keys.
struct CrumplePlaces {
    Index count = 0;
    std::vector<std::vector<Index>> of_vertex; ///< [sheets][vertices]

    explicit CrumplePlaces(std::span<const CrumpleSheet> sheets);
};

CrumplePlaces::CrumplePlaces(std::span<const CrumpleSheet> sheets) {
    struct Item {
        std::uint64_t key;
        std::uint32_t sheet;
        Index vertex;
    };
    std::vector<Item> items;
    for (std::size_t s = 0; s < sheets.size(); ++s) {
        const auto& keys = sheets[s].moves.keys;
        for (Index v = 0; v < keys.size(); ++v) items.push_back({keys[v], static_cast<std::uint32_t>(s), v});
        of_vertex.emplace_back(keys.size());
    }
    radix_sort(items, [](const Item& i) { return i.key; });
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (i == 0 || items[i].key != items[i - 1].key) ++count;
        of_vertex[items[i].sheet][items[i].vertex] = count - 1;
    }
}

constexpr std::uint8_t last_level = 9; ///< no move at all
constexpr int patient_rounds = 8;      ///< after these, the places around are lowered too
constexpr int widening_rounds = 16;    ///< after these, twice as far around in every round
/// Pairs of triangles with boxes that meet, for each face, that are looked at before shares fall in larger
/// steps: enough for moves as long as the faces' edges.
constexpr std::size_t pairs_a_face = 48;
/// The same in one round: where there are more, faces are drawn out too far to be told apart one by one.
constexpr std::size_t pairs_a_round = 32;
/// As many times the pairs before the move are looked at in any case, in all and in one round: faces may lie
/// close.
constexpr std::size_t times_before = 3, times_before_a_round = 2;
constexpr std::uint8_t large_step = 3; ///< to an eighth
constexpr int large_rounds = 3;        ///< after these, to nothing
// Of the longest edge of a face: where moves draw two of its corners apart by more, it is nearly sure to meet
// others, so many that looking for them all would take most of the time.
constexpr double max_stretch = 8;

double share_of(std::uint8_t level) { return level == last_level ? 0 : 1.0 / (1 << level); }

Vec3 rounded(const Vec3& p) { return {as_float32(p.x), as_float32(p.y), as_float32(p.z)}; }

/// A sheet as it is tested: vertices at one place are one.
class TestSheet {
  public:
    TestSheet(const CrumpleSheet& sheet, const std::vector<Index>& places, std::size_t max_pairs)
        : sheet_(sheet), places_(places), max_pairs_(max_pairs) {
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
        remember_exempt();
        flat_.resize(mesh_.face_count());
        parallel_for(flat_.size(), [&](std::size_t f) { flat_[f] = is_flat(static_cast<Index>(f)); });
    }

    std::size_t exempt() const { return exempt_.size(); }
    std::size_t pairs_before() const { return pairs_before_; }
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

    /// The new pairs among faces that were touched, as many as are listed; a face that lost its area is a
    /// pair with itself.
    std::vector<std::pair<Index, Index>> new_pairs() const {
        // With so many listed, one new pair at least is among them when there is any.
        auto pairs = find(touched_, exempt_.size() + max_pairs_).pairs;
        std::erase_if(pairs,
                      [&](const auto& p) { return std::binary_search(exempt_.begin(), exempt_.end(), p); });
        for (Index f = 0; f < touched_.size(); ++f)
            if (touched_[f] && !flat_[f] && is_flat(f)) pairs.emplace_back(f, f);
        return pairs;
    }

    /// [faces] 1 for those of which the moves, by the shares at the levels, draw two corners apart by more
    /// than so many times the longest edge.
    std::vector<std::uint8_t> overstretched(const std::vector<std::uint8_t>& levels, double stretch) const {
        std::vector<std::uint8_t> faces(mesh_.face_count());
        const auto moved = [&](Index v) { return sheet_.moves.moves[v] * share_of(levels[places_[v]]); };
        parallel_for(faces.size(), [&](std::size_t i) {
            const auto f = static_cast<Index>(i);
            double longest = 0, farthest = 0; // squared
            for (Index c = mesh_.face_begin(f); c < mesh_.face_end(f); ++c) {
                const Index u = mesh_.corners[c], v = mesh_.corners[next_corner(mesh_, f, c)];
                const Vec3 edge = before_[v] - before_[u], apart = moved(v) - moved(u);
                longest = std::max(longest, dot(edge, edge));
                farthest = std::max(farthest, dot(apart, apart));
            }
            faces[f] = farthest > stretch * stretch * longest;
        });
        return faces;
    }

    /// Looks at these faces only; the others count as not touched.
    void touch_only(std::vector<std::uint8_t> faces) { touched_ = std::move(faces); }

    /// Those of all new pairs among faces that were touched, unless there is too much to look at.
    MeetingFaces in_trouble() const {
        const std::size_t most =
            std::max(pairs_a_round * mesh_.face_count(), times_before_a_round * pairs_before_);
        auto found = self_intersecting_faces(mesh_, touched_, exempt_, most);
        if (found.too_many) return found;
        parallel_for(found.faces.size(), [&](std::size_t f) {
            if (touched_[f] && !flat_[f] && is_flat(static_cast<Index>(f))) found.faces[f] = 1;
        });
        return found;
    }

    /// Marks the places of the faces, and of all that so many rings of faces around them touch. Whether there
    /// are any.
    bool mark(const std::vector<std::uint8_t>& faces, std::size_t rings,
              std::vector<std::uint8_t>& marked) const {
        if (std::find(faces.begin(), faces.end(), 1) == faces.end()) return false;
        std::vector<std::uint8_t> mine(mesh_.positions.size());
        const auto mark_face = [&](Index f) {
            for (const Index v : mesh_.face_wedges(f)) mine[v] = 1;
        };
        for (Index f = 0; f < faces.size(); ++f)
            if (faces[f]) mark_face(f);
        for (std::size_t ring = 0; ring < rings; ++ring) {
            const std::vector<std::uint8_t> inner = mine;
            for (Index f = 0; f < mesh_.face_count(); ++f)
                for (const Index v : mesh_.face_wedges(f))
                    if (inner[v]) {
                        mark_face(f);
                        break;
                    }
            if (mine == inner) break;
        }
        for (std::size_t v = 0; v < mine.size(); ++v)
            if (mine[v]) marked[places_[v]] = 1;
        return true;
    }

    const std::vector<std::uint8_t>& touched() const { return touched_; }
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

    void remember_exempt() {
        const auto found = find({}, max_pairs_);
        if (found.count > found.pairs.size())
            throw Error(
                ErrorKind::limit, "E-LIMIT",
                fmt::format(
                    "crumple: {} pairs of faces intersect already, and at most {} can be told from new ones",
                    found.count, max_pairs_),
                "clean removes duplicate faces; self_intersections: allow does not search for intersections");
        exempt_ = found.pairs;
        pairs_before_ = found.box_pairs;
    }

    SelfIntersections find(const std::vector<std::uint8_t>& among, std::size_t limit) const {
        SelfIntersectionSettings settings;
        settings.limit = limit;
        settings.among = among;
        auto found = find_self_intersections(mesh_, settings);
        std::sort(found.pairs.begin(), found.pairs.end());
        return found;
    }

    const CrumpleSheet& sheet_;
    const std::vector<Index>& places_;
    std::size_t max_pairs_;
    std::vector<Vec3> before_;                    ///< [vertices] rounded
    std::vector<Index> first_;                    ///< [vertices]
    Mesh mesh_;                                   ///< corners go to the first of equal vertices
    std::vector<std::pair<Index, Index>> exempt_; ///< ascending
    std::size_t pairs_before_ = 0;                ///< of triangles with boxes that meet
    std::vector<std::uint8_t> flat_, touched_;    ///< [faces]
};

/// Lowers the marked places by a step of levels; whether any was still above the last.
bool lower(const std::vector<std::uint8_t>& marked, std::vector<std::uint8_t>& levels,
           std::uint8_t step = 1) {
    bool any = false;
    for (std::size_t p = 0; p < marked.size(); ++p)
        if (marked[p] && levels[p] < last_level) {
            levels[p] = static_cast<std::uint8_t>(std::min<int>(last_level, levels[p] + step));
            any = true;
        }
    return any;
}

/// The rings of faces around those in trouble that are lowered with them.
std::size_t rings_in(int round) {
    if (round < patient_rounds) return 0;
    return std::size_t{1} << std::clamp(round - widening_rounds, 0, 32);
}

/// Finds new pairs that the full moves would make: all, or where some faces are overstretched, those of a few
/// such faces, if there are any.
void look(std::vector<TestSheet>& tests, const std::vector<std::uint8_t>& levels, AvoidResult& result) {
    constexpr std::size_t few = 64;
    const auto look_at = [&](std::size_t s) {
        const auto pairs = tests[s].new_pairs();
        if (result.found == 0 && !pairs.empty()) {
            result.first = pairs.front();
            result.first_sheet = s;
        }
        result.found += pairs.size();
    };
    for (std::size_t s = 0; s < tests.size(); ++s) {
        std::vector<std::uint8_t> faces = tests[s].overstretched(levels, max_stretch);
        std::size_t count = 0;
        for (std::uint8_t& f : faces) f = f && ++count <= few;
        if (count == 0) continue;
        tests[s].touch_only(std::move(faces));
        look_at(s);
        result.at_least = result.found > 0;
        if (result.at_least) return;
        tests[s].touch_only(std::vector<std::uint8_t>(tests[s].mesh().face_count(), 1));
    }
    for (std::size_t s = 0; s < tests.size(); ++s) look_at(s);
}

/// [sheets][faces]
using FacesOfSheets = std::vector<std::vector<std::uint8_t>>;

void add(const std::vector<std::uint8_t>& faces, std::vector<std::uint8_t>& to) {
    to.resize(faces.size());
    for (std::size_t f = 0; f < faces.size(); ++f) to[f] |= faces[f];
}

/// Lowers the places of overstretched faces until there are none, and adds those that there were to `found`.
/// [places] 1 for those that were lowered.
std::vector<std::uint8_t> slacken(const std::vector<TestSheet>& tests, std::vector<std::uint8_t>& levels,
                                  double stretch, FacesOfSheets& found) {
    std::vector<std::uint8_t> lowered(levels.size());
    for (bool any = true; any;) {
        std::vector<std::uint8_t> marked(levels.size());
        any = false;
        for (std::size_t s = 0; s < tests.size(); ++s) {
            const auto faces = tests[s].overstretched(levels, stretch);
            any |= tests[s].mark(faces, 0, marked);
            add(faces, found[s]);
        }
        any = any && lower(marked, levels);
        if (any) add(marked, lowered);
    }
    return lowered;
}

/// How the places of faces in trouble are lowered in a round.
struct Lowering {
    std::uint8_t step = 1; ///< levels
    std::size_t rings = 0; ///< of faces around that are lowered with them
};

/// Chooses the lowering by the rounds and by the work, both counted from the first.
class Patience {
  public:
    explicit Patience(const std::vector<TestSheet>& tests) {
        for (const TestSheet& test : tests)
            most_ += std::max(pairs_a_face * test.mesh().face_count(), times_before * test.pairs_before());
    }
    /// For the next round, so many more pairs having been looked at.
    Lowering next(std::size_t box_pairs) {
        seen_ += box_pairs;
        const int round = round_++;
        if (seen_ <= most_) return {1, rings_in(round)};
        const int over = over_++;
        if (over < large_rounds) return {large_step, rings_in(round)};
        return {last_level, std::max(rings_in(round), std::size_t{1} << std::min(over - large_rounds, 32))};
    }

  private:
    std::size_t most_ = 0, seen_ = 0;
    int round_ = 0, over_ = 0;
};

/// Notes the places that are about to be lowered in large steps.
void note(const std::vector<std::uint8_t>& marked, const std::vector<std::uint8_t>& levels,
          std::vector<std::uint8_t>& hurried) {
    for (std::size_t p = 0; p < marked.size(); ++p)
        if (marked[p] && levels[p] < last_level) hurried[p] = 1;
}

/// Lowers places until no new faces meet.
class Separation {
  public:
    Separation(std::vector<TestSheet>& tests, std::vector<std::uint8_t>& levels, FacesOfSheets& found,
               AvoidResult& result)
        : tests_(tests), levels_(levels), found_(found), result_(result), patience_(tests),
          hurried_(levels.size()) {}

    /// Adds the faces that meet in the first round that looks at all to `found`.
    void run() {
        for (bool is_first = true;; ++result_.rounds) {
            std::vector<MeetingFaces> trouble;
            std::size_t box_pairs = 0;
            bool too_many = false;
            for (const TestSheet& test : tests_) {
                const MeetingFaces& meeting = trouble.emplace_back(test.in_trouble());
                box_pairs += meeting.box_pairs;
                too_many |= meeting.too_many;
            }
            result_.box_pairs += box_pairs;
            const Lowering how = patience_.next(box_pairs);
            const std::vector<std::uint8_t> changed =
                too_many ? calm_down(trouble, how)
                         : lower_meeting(trouble, how, std::exchange(is_first, false));
            if (changed.empty()) break;
            for (TestSheet& test : tests_) test.place(levels_, changed);
        }
        result_.hurried = static_cast<std::size_t>(std::count(hurried_.begin(), hurried_.end(), 1));
    }

  private:
    /// [places] 1 for those that were lowered; empty when no faces meet.
    std::vector<std::uint8_t> lower_meeting(const std::vector<MeetingFaces>& trouble, const Lowering& how,
                                            bool is_first) {
        std::vector<std::uint8_t> marked(levels_.size());
        bool more = false;
        for (std::size_t s = 0; s < tests_.size(); ++s) {
            if (is_first) add(trouble[s].faces, found_[s]);
            more |= tests_[s].mark(trouble[s].faces, how.rings, marked);
        }
        if (!more) return {};
        if (how.step > 1) note(marked, levels_, hurried_);
        if (!lower(marked, levels_, how.step)) // where nothing moves, all pairs were there before
            throw Error(ErrorKind::bug, "E-BUG", "crumple: faces that do not move came to intersect");
        return marked;
    }

    /// Where there is too much to look at: half as much stretch, or half of that, until some places are
    /// lowered. Without patience left, or where all faces keep their shape, nothing moves of what was to be
    /// looked at. [places] as above.
    std::vector<std::uint8_t> calm_down(const std::vector<MeetingFaces>& trouble, const Lowering& how) {
        constexpr double least_stretch = 1.0 / 64;
        const std::vector<std::uint8_t> before = levels_;
        while (how.step == 1 && stretch_ > least_stretch) {
            stretch_ /= 2;
            FacesOfSheets found(tests_.size());
            const auto lowered = slacken(tests_, levels_, stretch_, found);
            if (levels_ == before) continue;
            note(lowered, before, hurried_);
            return lowered;
        }
        std::vector<std::uint8_t> marked(levels_.size());
        for (std::size_t s = 0; s < tests_.size(); ++s)
            if (trouble[s].too_many) tests_[s].mark(tests_[s].touched(), how.rings, marked);
        note(marked, levels_, hurried_);
        if (!lower(marked, levels_, last_level))
            throw Error(ErrorKind::bug, "E-BUG", "crumple: faces that do not move are too many to look at");
        return marked;
    }

    std::vector<TestSheet>& tests_;
    std::vector<std::uint8_t>& levels_;
    FacesOfSheets& found_;
    AvoidResult& result_;
    Patience patience_;
    std::vector<std::uint8_t> hurried_;
    double stretch_ = max_stretch;
};

/// Moves as far as faces do not come to meet.
void avoid(std::vector<TestSheet>& tests, std::vector<std::uint8_t>& levels, AvoidResult& result) {
    FacesOfSheets found(tests.size());
    slacken(tests, levels, max_stretch, found);
    for (TestSheet& test : tests) test.place(levels, {});
    Separation(tests, levels, found, result).run();
    for (const auto& faces : found)
        result.found += static_cast<std::size_t>(std::count(faces.begin(), faces.end(), 1));
}

} // namespace

void hold_together(std::span<CrumpleSheet> sheets) {
    if (std::all_of(sheets.begin(), sheets.end(), [](const auto& s) { return s.moves.shares.empty(); }))
        return;
    const CrumplePlaces places(sheets);
    std::vector<double> least(places.count, 1);
    for (std::size_t s = 0; s < sheets.size(); ++s)
        for (std::size_t v = 0; v < sheets[s].moves.shares.size(); ++v) {
            double& share = least[places.of_vertex[s][v]];
            share = std::min(share, sheets[s].moves.shares[v]);
        }
    for (std::size_t s = 0; s < sheets.size(); ++s) {
        auto& moves = sheets[s].moves;
        parallel_for(moves.moves.size(), [&](std::size_t v) {
            const double share = least[places.of_vertex[s][v]];
            if (share < 1) moves.moves[v] *= share;
        });
        moves.shares.clear();
    }
}

double move_apart_memory(double triangles) { return 300 * triangles; }

AvoidResult move_apart(std::span<CrumpleSheet> sheets, bool only_look, std::size_t max_pairs) {
    AvoidResult result;
    const CrumplePlaces places(sheets);
    std::vector<std::uint8_t> levels(places.count);
    std::vector<TestSheet> tests;
    tests.reserve(sheets.size());
    for (std::size_t s = 0; s < sheets.size(); ++s) {
        tests.emplace_back(sheets[s], places.of_vertex[s], max_pairs);
        result.exempt += tests.back().exempt();
    }
    if (only_look) {
        for (TestSheet& test : tests) test.place(levels, {});
        look(tests, levels, result);
        result.left = result.found;
    } else {
        avoid(tests, levels, result);
    }
    for (std::size_t s = 0; s < sheets.size(); ++s) {
        auto& positions = sheets[s].mesh->positions;
        for (std::size_t v = 0; v < positions.size(); ++v) ++result.shares[levels[places.of_vertex[s][v]]];
        parallel_for(positions.size(), [&](std::size_t v) { positions[v] = tests[s].position(v); });
    }
    return result;
}

} // namespace facetmill
