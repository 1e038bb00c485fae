#include "geometry/clean/lost_faces.hpp"

#include "geometry/clean/touched_cells.hpp"
#include "geometry/spatial/box_tree.hpp"
#include "geometry/spatial/rays.hpp"

namespace facetmill::clean_steps {

namespace {

constexpr std::size_t least_faces = 4096; ///< of fewer, all is searched as quickly
/// A room is asked about that has one of so many equal shares of the faces: so there are few such rooms.
constexpr std::size_t most_rooms = 64;

/// The rooms between marked cells: numbered, each cell has the number of its own.
class Rooms {
  public:
    explicit Rooms(const TouchedCells& touched) : of_cell_(cells_along * cells_along * cells_along, none) {
        for (std::size_t cell = 0; cell < of_cell_.size(); ++cell)
            if (of_cell_[cell] == none && !touched.is_marked(at(cell))) fill(cell, touched);
    }

    std::size_t count() const { return count_; }
    Index of(const Cell& c) const { return of_cell_[(c[0] * cells_along + c[1]) * cells_along + c[2]]; }

  private:
    static Cell at(std::size_t cell) {
        const auto number = [](std::size_t n) { return static_cast<std::uint8_t>(n % cells_along); };
        return {number(cell / cells_along / cells_along), number(cell / cells_along), number(cell)};
    }

    void fill(std::size_t first, const TouchedCells& touched) {
        std::vector<std::size_t> waiting{first};
        of_cell_[first] = static_cast<Index>(count_);
        while (!waiting.empty()) {
            const std::size_t cell = waiting.back();
            waiting.pop_back();
            const Cell c = at(cell);
            for (std::size_t axis = 0, step = cells_along * cells_along; axis < 3;
                 ++axis, step /= cells_along)
                for (const int way : {-1, 1}) {
                    if (c[axis] == (way < 0 ? 0 : cells_along - 1)) continue;
                    const std::size_t next = way < 0 ? cell - step : cell + step;
                    if (of_cell_[next] != none || touched.is_marked(at(next))) continue;
                    of_cell_[next] = static_cast<Index>(count_);
                    waiting.push_back(next);
                }
        }
        ++count_;
    }

    std::vector<Index> of_cell_; ///< or none for marked ones
    std::size_t count_ = 0;
};

class Losing {
  public:
    Losing(const Mesh& mesh, std::span<const std::uint8_t> second, CombineOperation operation)
        : mesh_(mesh), second_(second), operation_(operation), both_(common_box()), cells_(mesh, both_) {}

    std::vector<std::uint8_t> run() {
        std::array<TouchedCells, 2> touched;
        parallel_for(mesh_.face_count(), [&](std::size_t f) { touched[second_[f]].mark(cells_[f]); });
        std::array<std::vector<std::uint8_t>, 2> goes; // by room, of the faces of an operand in it
        const std::array rooms{Rooms(touched[1]), Rooms(touched[0])};
        const auto is_in_room = [&](std::size_t f) { return !touched[1 - second_[f]].may_meet(cells_[f]); };
        const auto room_of = [&](std::size_t f) { return rooms[second_[f]].of(cells_[f].low); };
        find_views(rooms, is_in_room, room_of);
        ask();
        bool any = false;
        for (std::size_t k = 0; k < 2; ++k) goes[k].assign(rooms[k].count(), 0);
        for (const View& view : views_) any |= (goes[view.operand][view.room] = is_lost(view)) != 0;
        if (!any) return {};
        std::vector<std::uint8_t> lost(mesh_.face_count());
        parallel_for(lost.size(),
                     [&](std::size_t f) { lost[f] = is_in_room(f) && goes[second_[f]][room_of(f)]; });
        return lost;
    }

  private:
    /// From a vertex of an operand, in a room between the faces of the other.
    struct View {
        Vec3 from;
        Cell cell;
        std::size_t operand;
        Index room;
        int winding = 0; ///< of the other operand
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

    /// What boxes of both operands have in common, or a little more.
    Box common_box() const {
        std::array<Index, 2> low{none, none}, high{0, 0}; // vertices of each
        for (Index f = 0; f < mesh_.face_count(); ++f)
            for (Index c = mesh_.face_begin(f); c < mesh_.face_end(f); ++c) {
                const Index v = mesh_.vertex(c);
                low[second_[f]] = std::min(low[second_[f]], v);
                high[second_[f]] = std::max(high[second_[f]], v);
            }
        Box both;
        std::array<Box, 2> boxes;
        for (std::size_t k = 0; k < 2; ++k)
            for (Index v = low[k]; v <= high[k] && v != none; ++v) boxes[k].add(mesh_.positions[v]);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            both.min[axis] = std::max(boxes[0].min[axis], boxes[1].min[axis]);
            both.max[axis] = std::min(boxes[0].max[axis], boxes[1].max[axis]);
        }
        return both;
    }

    /// A view from each room with many faces.
    template <class InRoom, class RoomOf>
    void find_views(const std::array<Rooms, 2>& rooms, InRoom&& is_in_room, RoomOf&& room_of) {
        std::array<std::vector<std::size_t>, 2> count;
        for (std::size_t k = 0; k < 2; ++k) count[k].assign(rooms[k].count(), 0);
        for (Index f = 0; f < mesh_.face_count(); ++f) {
            if (!is_in_room(f)) continue;
            const Vec3& from = mesh_.point(mesh_.face_begin(f));
            if (++count[second_[f]][room_of(f)] == mesh_.face_count() / most_rooms && is_finite(from))
                views_.push_back({from, cells_.of(from), second_[f], room_of(f)});
        }
    }

    /// By rays along an axis; polygons as fans, whose triangles are all in the box of the polygon: since no
    /// view is from there, any surface between its sides would do. Outside of the box of the other operand no
    /// ray is needed.
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
