#include "geometry/boolean/lost_faces.hpp"

#include "geometry/boolean/touched_cells.hpp"
#include "geometry/spatial/box_tree.hpp"
#include "geometry/spatial/rays.hpp"
#include "mesh/topology.hpp"

#include <bit>

namespace facetmill::clean_steps {

namespace {

constexpr std::size_t least_faces = 4096; ///< for fewer faces, a full search is as fast
/// A room is tested only if it has at least this share of the faces (1/64), so few rooms are tested.
constexpr std::size_t most_rooms = 64;

/// The rooms between marked cells, with a number for each cell.
class Rooms {
  public:
    explicit Rooms(const TouchedCells& touched) {
        std::size_t runs = 0;
        for (std::size_t row = 0; row < rows; ++row) {
            const std::uint64_t open = ~touched.row(row);
            starts_[row] = open & ~(open << 1);
            first_[row] = static_cast<Index>(runs);
            runs += static_cast<std::size_t>(std::popcount(starts_[row]));
        }
        DisjointSets sets(runs);
        for (std::size_t row = 0; row < rows; ++row)
            for (const std::size_t next :
                 {row % cells_along + 1 < cells_along ? row + 1 : rows, row + cells_along}) {
                if (next >= rows) continue;
                const std::uint64_t both = ~(touched.row(row) | touched.row(next));
                for (std::uint64_t left = both & ~(both << 1); left != 0; left &= left - 1)
                    sets.join(run_of(row, std::countr_zero(left)), run_of(next, std::countr_zero(left)));
            }
        number_.resize(runs);
        for (Index run = 0; run < runs; ++run) { // the root of a set is its lowest run
            const Index root = sets.find(run);
            number_[run] = root == run ? static_cast<Index>(count_++) : number_[root];
        }
    }

    std::size_t count() const { return count_; }
    /// The room of an unmarked cell.
    Index of(const Cell& c) const { return number_[run_of(c[0] * cells_along + c[1], c[2])]; }

  private:
    static constexpr std::size_t rows = cells_along * cells_along;

    /// The run of open cells along the last axis that contains an open cell.
    Index run_of(std::size_t row, int at) const {
        const std::uint64_t up_to = starts_[row] << (cells_along - 1 - static_cast<std::size_t>(at));
        return first_[row] + static_cast<Index>(std::popcount(up_to)) - 1;
    }

    std::array<std::uint64_t, rows> starts_; ///< start bits of the runs
    std::array<Index, rows> first_;          ///< number of each row's first run
    std::vector<Index> number_;              ///< [runs] rooms
    std::size_t count_ = 0;
};

class Losing {
  public:
    Losing(const Mesh& mesh, std::span<const std::uint8_t> second, CombineOperation operation)
        : mesh_(mesh), second_(second), operation_(operation), both_(common_box()), cells_(mesh, both_) {}

    std::vector<std::uint8_t> run() {
        std::array<TouchedCells, 2> touched;
        parallel_for(mesh_.face_count(), [&](std::size_t f) { touched[second_[f]].mark(cells_[f]); });
        std::array<std::vector<std::uint8_t>, 2> goes; // [rooms] 1 if the operand's faces are lost
        const std::array rooms{Rooms(touched[1]), Rooms(touched[0])};
        std::vector<Index> room(mesh_.face_count()); // [faces] the room, or none
        parallel_for(room.size(), [&](std::size_t f) {
            const bool is_in_one = !touched[1 - second_[f]].may_meet(cells_[f]);
            room[f] = is_in_one ? rooms[second_[f]].of(cells_[f].low) : none;
        });
        find_views(rooms, room);
        ask();
        bool any = false;
        for (std::size_t k = 0; k < 2; ++k) goes[k].assign(rooms[k].count(), 0);
        for (const View& view : views_) any |= (goes[view.operand][view.room] = is_lost(view)) != 0;
        if (!any) return {};
        std::vector<std::uint8_t> lost(mesh_.face_count());
        parallel_for(lost.size(),
                     [&](std::size_t f) { lost[f] = room[f] != none && goes[second_[f]][room[f]]; });
        return lost;
    }

  private:
    /// A test ray from a vertex of an operand, in a room between the faces of the other.
    struct View {
        Vec3 from;
        Cell cell;
        std::size_t operand;
        Index room;
        int winding = 0; ///< winding number of the other operand around the vertex
    };

    std::uint8_t is_lost(const View& view) const {
        const bool within = view.winding >= 1;
        switch (operation_) {
        case CombineOperation::unite:
            return within;
        case CombineOperation::intersect:
            return !within;
        case CombineOperation::subtract:
            break;
        }
        return view.operand == 0 ? within : !within;
    }

    /// The common box of both operands, slightly enlarged.
    Box common_box() const {
        struct Range { // a range of vertices
            Index low = none, high = 0;
            void add(const Range& r) {
                low = std::min(low, r.low);
                high = std::max(high, r.high);
            }
        };
        using Ranges = std::array<Range, 2>;
        const Ranges ranges = parallel_reduce(
            mesh_.face_count(), Ranges{},
            [&](std::size_t begin, std::size_t end) {
                Ranges some;
                for (auto f = static_cast<Index>(begin); f < end; ++f)
                    for (Index c = mesh_.face_begin(f); c < mesh_.face_end(f); ++c)
                        some[second_[f]].add({mesh_.vertex(c), mesh_.vertex(c)});
                return some;
            },
            [](Ranges a, const Ranges& b) {
                for (std::size_t k = 0; k < 2; ++k) a[k].add(b[k]);
                return a;
            });
        Box both;
        std::array<Box, 2> boxes;
        for (std::size_t k = 0; k < 2; ++k)
            if (const auto& [low, high] = ranges[k]; low != none)
                boxes[k] = box_of(std::span(mesh_.positions).subspan(low, high - low + 1));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            both.min[axis] = std::max(boxes[0].min[axis], boxes[1].min[axis]);
            both.max[axis] = std::min(boxes[0].max[axis], boxes[1].max[axis]);
        }
        return both;
    }

    /// Chooses a test vertex in each room with many faces. room: the room of each face.
    void find_views(const std::array<Rooms, 2>& rooms, const std::vector<Index>& room) {
        std::array<std::vector<std::size_t>, 2> count;
        for (std::size_t k = 0; k < 2; ++k) count[k].assign(rooms[k].count(), 0);
        for (Index f = 0; f < mesh_.face_count(); ++f) {
            if (room[f] == none || ++count[second_[f]][room[f]] != mesh_.face_count() / most_rooms) continue;
            const Vec3& from = mesh_.point(mesh_.face_begin(f));
            if (is_finite(from)) views_.push_back({from, cells_.of(from), second_[f], room[f]});
        }
    }

    /// Counts winding numbers by rays along an axis. Polygons are split into fans, whose triangles stay
    /// inside the polygon's box. No test vertex is in such a box, so any surface with the same boundary gives
    /// the same count. Outside the other operand's box, no ray is needed.
    void ask() {
        std::vector<View*> within;
        for (View& view : views_)
            if (boxes_meet({view.from, view.from}, both_)) within.push_back(&view);
        if (within.empty()) return;
        using Windings = std::vector<int>;
        const Windings all = parallel_reduce(
            mesh_.face_count(), Windings(within.size()),
            [&](std::size_t begin, std::size_t end) {
                Windings some(within.size());
                for (auto f = static_cast<Index>(begin); f < end; ++f)
                    for (std::size_t i = 0; i < within.size(); ++i)
                        if (within[i]->operand != second_[f] && may_pass(within[i]->cell, cells_[f]))
                            some[i] += crossings(within[i]->from, f);
                return some;
            },
            [](Windings a, const Windings& b) {
                for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
                return a;
            });
        for (std::size_t i = 0; i < within.size(); ++i) within[i]->winding = all[i];
    }
    static bool may_pass(const Cell& at, const CellRange& range) {
        return range.low[1] <= at[1] && at[1] <= range.high[1] && range.low[2] <= at[2] &&
               at[2] <= range.high[2] && at[0] <= range.high[0];
    }
    int crossings(const Vec3& p, Index f) const {
        const Index begin = mesh_.face_begin(f);
        int sum = 0;
        for (Index c = begin + 1; c + 1 < mesh_.face_end(f); ++c)
            sum += passes_along_axis(p, 0, true, mesh_.point(begin), mesh_.point(c), mesh_.point(c + 1));
        return sum;
    }

    const Mesh& mesh_;
    std::span<const std::uint8_t> second_;
    CombineOperation operation_;
    Box both_;
    FaceCells cells_;
    std::vector<View> views_;
};

} // namespace

std::vector<std::uint8_t> lost_faces(const Mesh& mesh, std::span<const std::uint8_t> second,
                                     CombineOperation operation) {
    if (mesh.face_count() < least_faces) return {};
    return Losing(mesh, second, operation).run();
}

} // namespace facetmill::clean_steps
