#include "base/progress.hpp"
#include "geometry/crumple/crumple.hpp"
#include "geometry/crumple/first_stretch.hpp"
#include "geometry/crumple/tested_sheet.hpp"

#include <algorithm>
#include <utility>

namespace facetmill {

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

namespace {

constexpr int patient_rounds = 8;   ///< after this many rounds, the surrounding positions are lowered too
constexpr int widening_rounds = 16; ///< after this many rounds, the surroundings double in every round
/// Box pairs per face that are examined before shares fall in larger steps: enough for moves as long as the
/// faces' edges.
constexpr std::size_t pairs_a_face = 32;
/// In any case, this many times the box pairs before the move are examined, because faces may be close
/// together.
constexpr std::size_t times_before = 3;
constexpr std::uint8_t large_step = 3; ///< large steps lower to an eighth
constexpr int large_rounds = 3;        ///< after this many large steps, moves fall to 0

/// The rings of faces around intersecting faces that are lowered with them.
std::size_t rings_in(int round) {
    if (round < patient_rounds) return 0;
    return std::size_t{1} << std::clamp(round - widening_rounds, 0, 32);
}

/// Finds new pairs that the full moves would make. If a few of the overstretched faces already have new
/// pairs, returns these; otherwise examines all faces.
void look(std::vector<TestSheet>& tests, const std::vector<std::uint8_t>& levels, AvoidResult& result) {
    constexpr std::size_t few = 64;
    const auto look_at = [&](std::size_t s) {
        const auto pairs = tests[s].new_pairs(levels);
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
        tests[s].touch_only(std::vector<std::uint8_t>(tests[s].face_count(), 1));
    }
    for (std::size_t s = 0; s < tests.size(); ++s) look_at(s);
}

/// How the positions of intersecting faces are lowered in a round.
struct Lowering {
    std::uint8_t step = 1; ///< number of levels
    std::size_t rings = 0; ///< rings of surrounding faces that are lowered too
};

/// Chooses the lowering by the total number of rounds and the total work.
class Patience {
  public:
    explicit Patience(const std::vector<TestSheet>& tests) {
        for (const TestSheet& test : tests)
            most_ += std::max(pairs_a_face * test.face_count(), times_before * test.pairs_before());
    }
    /// The lowering for the next round, after examining this many more box pairs.
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

/// Marks the positions that are about to be lowered in large steps.
void note(const std::vector<std::uint8_t>& marked, const std::vector<std::uint8_t>& levels,
          std::vector<std::uint8_t>& coarse) {
    for (std::size_t p = 0; p < marked.size(); ++p)
        if (marked[p] && levels[p] < last_level) coarse[p] = 1;
}

/// Lowers positions until no new faces intersect.
class Separation {
  public:
    /// `coarse`: [positions] 1 if lowered in large steps before; `stretch`: the stretch so far.
    Separation(std::vector<TestSheet>& tests, std::vector<std::uint8_t>& levels, FacesOfSheets& found,
               AvoidResult& result, std::vector<std::uint8_t> coarse, double stretch)
        : tests_(tests), levels_(levels), found_(found), result_(result), patience_(tests),
          coarse_(std::move(coarse)), stretch_(stretch) {}

    /// Adds the faces that intersect in the first complete round to `found`.
    void run() {
        ProgressRounds rounds;
        for (bool is_first = true;; ++result_.rounds, rounds.next()) {
            std::vector<MeetingFaces> trouble;
            std::size_t box_pairs = 0;
            bool too_many = false;
            ProgressSteps of_sheets(std::vector<double>(tests_.size(), 1));
            for (TestSheet& test : tests_) {
                const MeetingFaces& meeting = trouble.emplace_back(test.in_trouble(levels_));
                box_pairs += meeting.box_pairs;
                too_many |= meeting.too_many;
                of_sheets.next();
            }
            const ProgressScope silent(nullptr); // the search takes the time
            result_.box_pairs += box_pairs;
            const Lowering how = patience_.next(box_pairs);
            FacesOfSheets again(tests_.size());
            const std::vector<std::uint8_t> changed =
                too_many ? calm_down(trouble, how, again)
                         : lower_meeting(trouble, how, std::exchange(is_first, false));
            if (changed.empty()) break;
            for (std::size_t s = 0; s < tests_.size(); ++s)
                tests_[s].place(levels_, changed, std::move(again[s]));
        }
        result_.coarse = static_cast<std::size_t>(std::count(coarse_.begin(), coarse_.end(), 1));
    }

  private:
    /// [positions] 1 if lowered; empty if no faces intersect.
    std::vector<std::uint8_t> lower_meeting(const std::vector<MeetingFaces>& trouble, const Lowering& how,
                                            bool is_first) {
        std::vector<std::uint8_t> marked(levels_.size());
        bool more = false;
        for (std::size_t s = 0; s < tests_.size(); ++s) {
            if (is_first) add(trouble[s].faces, found_[s]);
            more |= tests_[s].mark(trouble[s].faces, how.rings, marked);
        }
        if (!more) return {};
        if (how.step > 1) note(marked, levels_, coarse_);
        if (!lower(marked, levels_, how.step)) // if nothing moves, all pairs existed before
            throw Error(ErrorKind::bug, "E-BUG", "crumple: faces that do not move intersect");
        return marked;
    }

    /// If too many pairs would have to be examined, halves the allowed stretch repeatedly until some
    /// positions are lowered. If the round limit is reached, or all faces keep their shape, stops all moves
    /// of these faces. Returns [positions] 1 if lowered. again: receives the faces that must be tested again.
    std::vector<std::uint8_t> calm_down(const std::vector<MeetingFaces>& trouble, const Lowering& how,
                                        FacesOfSheets& again) {
        for (std::size_t s = 0; s < tests_.size(); ++s)
            again[s] = trouble[s].too_many ? tests_[s].touched() : trouble[s].faces;
        const std::vector<std::uint8_t> before = levels_;
        while (how.step == 1 && stretch_ > least_stretch) {
            stretch_ /= 2;
            FacesOfSheets found(tests_.size());
            const auto lowered = slacken(tests_, levels_, stretch_, found);
            if (levels_ == before) continue;
            note(lowered, before, coarse_);
            return lowered;
        }
        std::vector<std::uint8_t> marked(levels_.size());
        for (std::size_t s = 0; s < tests_.size(); ++s)
            if (trouble[s].too_many) tests_[s].mark(tests_[s].touched(), how.rings, marked);
        note(marked, levels_, coarse_);
        if (!lower(marked, levels_, last_level))
            throw Error(ErrorKind::bug, "E-BUG", "crumple: too many faces do not move");
        return marked;
    }

    std::vector<TestSheet>& tests_;
    std::vector<std::uint8_t>& levels_;
    FacesOfSheets& found_;
    AvoidResult& result_;
    Patience patience_;
    std::vector<std::uint8_t> coarse_;
    double stretch_;
};

/// Moves vertices as far as possible without new intersections.
void avoid(std::span<const CrumpleSheet> sheets, std::vector<TestSheet>& tests,
           std::vector<std::uint8_t>& levels, std::size_t max_pairs, AvoidResult& result) {
    FacesOfSheets found(tests.size());
    ProgressSteps steps({1, 3});
    slacken(tests, levels, max_stretch, found);
    const double stretch = first_stretch(sheets, tests, levels, max_pairs);
    std::vector<std::uint8_t> coarse(levels.size());
    if (stretch < max_stretch) coarse = slacken(tests, levels, stretch, found);
    for (TestSheet& test : tests) test.place(levels, {});
    steps.next();
    Separation(tests, levels, found, result, std::move(coarse), stretch).run();
    for (const auto& faces : found)
        result.found += static_cast<std::size_t>(std::count(faces.begin(), faces.end(), 1));
}

} // namespace

void hold_joint_vertices(std::span<CrumpleSheet> sheets) {
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

double avoid_intersections_memory(double triangles, double largest) {
    constexpr double kept = 100, searched = 200;
    const double stay =
        std::max(largest, static_cast<double>(max_open_triangles)); // the first sheet always stays
    return kept * triangles + searched * std::min(triangles, stay + largest);
}

AvoidResult avoid_intersections(std::span<CrumpleSheet> sheets, bool only_look, std::size_t max_pairs,
                                std::size_t max_open) {
    AvoidResult result;
    const CrumplePlaces places(sheets);
    std::vector<std::uint8_t> levels(places.count);
    ProgressSteps steps({1, 2});
    std::vector<TestSheet> tests = tests_of(sheets, places, max_pairs, max_open);
    for (const TestSheet& test : tests) result.exempt += test.exempt();
    steps.next();
    if (only_look) {
        for (TestSheet& test : tests) test.place(levels, {});
        look(tests, levels, result);
        result.left = result.found;
    } else {
        avoid(sheets, tests, levels, max_pairs, result);
    }
    for (std::size_t s = 0; s < sheets.size(); ++s) {
        auto& positions = sheets[s].mesh->positions;
        for (std::size_t v = 0; v < positions.size(); ++v) ++result.shares[levels[places.of_vertex[s][v]]];
        positions = tests[s].positions(levels);
    }
    return result;
}

} // namespace facetmill
