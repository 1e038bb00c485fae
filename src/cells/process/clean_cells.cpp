#include "cells/process/clean_cells.hpp"

#include "base/math/random.hpp"
#include "base/progress.hpp"
#include "base/sort_unique.hpp"
#include "base/text/readable_numbers.hpp"
#include "cells/hierarchy/hierarchy.hpp"
#include "cells/partition/cell_border_walk.hpp"
#include "cells/process/border_closure.hpp"
#include "cells/process/clean_source.hpp"
#include "cells/process/split_source.hpp"
#include "cells/sources/pieces.hpp"
#include "cells/sources/unite.hpp"
#include "geometry/edit/moved.hpp"
#include "geometry/edit/surgery.hpp"
#include "geometry/inspect/evidence.hpp"
#include "mesh/topology.hpp"
#include "parallel/memory.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <unordered_set>
#include <utility>

namespace facetmill::cells {

namespace {

constexpr const char *sheet_name = "sheet",        ///< [faces] component number
    *source_name = "facetmill_source",             ///< [vertices] number in the gathered mesh
        *border_closure_name = "facetmill_collar"; ///< [faces] 1 for faces of the collar
constexpr std::uint32_t no_sheet = UINT32_MAX;

/// A set of positions by their hashes. A hash collision only causes a needless check.
class PlaceSet {
  public:
    /// most: the limit in bytes, beyond which it throws a limit error (E-MEMORY).
    explicit PlaceSet(std::uint64_t most) : most_(most) {}
    void add(const Vec3& p) {
        constexpr std::uint64_t bytes_of_entry = 56; // memory of an allocated node and its buckets
        names_.insert(name_of_place(p));
        if (names_.size() * bytes_of_entry > most_)
            throw out_of_memory(
                fmt::format("clean: more than {} places have defects, but --memory allows only {} for them",
                            grouped(names_.size()), sized(most_)),
                "give more memory, or use load with weld: exact, which welds without it");
    }
    bool has(const Vec3& p) const { return names_.contains(name_of_place(p)); }
    bool empty() const { return names_.empty(); }

  private:
    std::unordered_set<std::uint64_t> names_;
    std::uint64_t most_;
};

/// Finds the positions at which clean may have work, and sums the area.
class UnsoundPlaces final : public RimVisitor {
  public:
    UnsoundPlaces(PlaceSet& places, const Transform& transform) : places_(places), transform_(transform) {}
    double area = 0; ///< area after the transform
    void read(Cell& cell) override { area += surface_size(cell.mesh, transform_, false).area; }
    void look(const Mesh& mesh, const std::vector<Turn>& turns) override {
        std::vector<std::uint8_t> unsound(mesh.vertex_count(), 0);
        const EdgeTable edges = build_edges(mesh);
        for (Index e = 0; e < edges.size(); ++e) {
            const auto corners = edges.corners_of(e);
            const auto& [low, high] = edges.edges[e];
            if (corners.size() != 2 || mesh.vertex(corners[0]) == mesh.vertex(corners[1]))
                unsound[low] = unsound[high] = 1;
        }
        const auto mark = [&](Index f) {
            for (const Index v : mesh.face_wedges(f)) unsound[v] = 1;
        };
        for (Index f = 0; f < mesh.face_count(); ++f)
            if (is_degenerate(mesh, f)) mark(f);
        for (const Index f : duplicate_faces(mesh)) mark(f);
        const std::vector<Index> fans = fans_at_vertices(mesh, edges);
        for (Index v = 0; v < unsound.size(); ++v)
            if (turns[v] == Turn::now && (unsound[v] || fans[v] != 1)) places_.add(mesh.positions[v]);
    }

  private:
    PlaceSet& places_;
    const Transform& transform_;
};

/// Faces as records of a numbered source.
struct GatheredFaces {
    std::vector<std::uint32_t> numbers;
    std::vector<std::uint32_t> sheets; ///< no_sheet for faces at an unsound position
    io::Bytes records;
};

/// Gathers the faces at unsound positions and their neighbours, and finds the components of the rest.
class RestOfMesh final : public RimVisitor {
  public:
    RestOfMesh(const Partition& partition, const PlaceSet& unsound, const PlaceSet& around)
        : partition_(partition), unsound_(unsound), around_(around) {}

    GatheredFaces gathered;
    Box bounds; ///< bounds of the faces away from unsound positions
    void finish() {
        for (std::uint32_t& sheet : gathered.sheets)
            if (sheet != no_sheet) sheet = sheets_.find(sheet);
    }

    void read(Cell& cell) override {
        const Mesh& mesh = cell.mesh;
        std::vector<std::uint8_t> unsound(mesh.vertex_count()), around(mesh.vertex_count());
        for (Index v = 0; v < unsound.size(); ++v) {
            unsound[v] = unsound_.has(mesh.positions[v]);
            around[v] = around_.has(mesh.positions[v]);
        }
        std::vector<Index> rest;
        std::vector<std::uint8_t> beside(mesh.face_count(),
                                         0); // [faces] true for faces of the rest with a vertex in around_
        for (Index f = 0; f < mesh.face_count(); ++f) {
            bool in_part = false;
            for (const Index v : mesh.face_wedges(f)) {
                in_part |= unsound[v] != 0;
                beside[f] |= around[v];
            }
            if (in_part) continue;
            rest.push_back(f);
            add_corners(bounds, mesh, f);
        }
        std::vector<std::uint32_t> sheet(mesh.face_count(), no_sheet);
        label(cell, rest, sheet);
        gather(sheet, beside);
        cell.mesh.attributes.push_back({sheet_name, Domain::face, Role::index, 1, false, std::move(sheet)});
    }

    void meet(Mesh& mesh) override {
        const auto& sheet = std::get<std::vector<std::uint32_t>>(mesh.find(sheet_name, Domain::face)->data);
        const EdgeTable edges = build_edges(mesh);
        for (Index e = 0; e < edges.size(); ++e) {
            const auto corners = edges.corners_of(e);
            if (corners.size() != 2) continue;
            const std::uint32_t a = sheet[corners[0] / 3], b = sheet[corners[1] / 3];
            if (a != no_sheet && b != no_sheet) sheets_.join(a, b);
        }
    }
    void look(const Mesh&, const std::vector<Turn>&) override {}

  private:
    void label(const Cell& cell, const std::vector<Index>& rest, std::vector<std::uint32_t>& sheet) {
        if (rest.empty()) return;
        Mesh only;
        only.positions = cell.mesh.positions;
        for (const Index f : rest)
            for (const Index v : cell.mesh.face_wedges(f)) only.corners.push_back(v);
        const Components components = face_components(only, false);
        std::vector<std::uint32_t> number(components.count);
        for (std::uint32_t& n : number) n = sheets_.add();
        for (std::size_t i = 0; i < rest.size(); ++i) sheet[rest[i]] = number[components.of_face[i]];
    }

    void gather(const std::vector<std::uint32_t>& sheet, const std::vector<std::uint8_t>& beside) {
        const io::Bytes records = partition_.records(leaf_++);
        const std::size_t size = records.size() / sheet.size();
        const std::vector<std::uint32_t> numbers = numbers_in(partition_.source(), records);
        for (std::size_t f = 0; f < sheet.size(); ++f) {
            if (sheet[f] != no_sheet && !beside[f]) continue;
            gathered.numbers.push_back(numbers[f]);
            gathered.sheets.push_back(sheet[f]);
            const auto record = io::Span(records).subspan(f * size, size);
            gathered.records.insert(gathered.records.end(), record.begin(), record.end());
        }
    }

    const Partition& partition_;
    const PlaceSet &unsound_, &around_;
    std::uint32_t leaf_ = 0;
    DisjointSets sheets_;
};

/// Sorts the faces into the order of the source.
GatheredFaces in_order(const GatheredFaces& all) {
    std::vector<std::size_t> order(all.numbers.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return all.numbers[a] < all.numbers[b]; });
    GatheredFaces sorted;
    sorted.records.reserve(all.records.size());
    const std::size_t size = all.records.size() / std::max<std::size_t>(1, order.size());
    for (const std::size_t i : order) {
        sorted.numbers.push_back(all.numbers[i]);
        sorted.sheets.push_back(all.sheets[i]);
        const auto record = io::Span(all.records).subspan(i * size, size);
        sorted.records.insert(sorted.records.end(), record.begin(), record.end());
    }
    return sorted;
}

class CellCleaning {
  public:
    CellCleaning(std::unique_ptr<Partition>& partition, const CleanSettings& settings,
                 const CellResources& means, const Transform& transform, std::uint64_t most)
        : partition_(partition), settings_(settings), means_(means), transform_(transform), most_(most),
          plain_(partition->shared_source()), before_(partition->vertices()), unsound_(means.memory / 8),
          around_(means.memory / 8) {}

    CleanedCells run() {
        const std::vector<Attribute> attributes = partition_->cell(0).mesh.attributes;
        require_countable("clean", static_cast<double>(partition_->faces() + means_.memory / bytes_of_face),
                          "clean parts of it");
        numbered_ = numbered_source(plain_, settings_.weld != Nearness::off);
        placed_ = std::make_unique<Partition>(numbered_, means_, most_);
        UnsoundPlaces search(unsound_, transform_);
        walk_cell_borders(*placed_, means_, search);
        area_ = search.area;
        CleanResult result = unsound_.empty() ? untouched(attributes) : cleaned_part();
        const bool replaces = result.counts.total() > 0 || spared_ > 0;
        const std::size_t welded =
            before_ - placed_->vertices() - spared_; // vertices that needed no decision of clean
        result.counts.welded_vertices += welded;
        if (result.counts.welded_vertices > 0 && !attributes.empty())
            refuse("vertices at the same position have different attributes, which cells cannot keep "
                   "separate after welding",
                   "weld: off, or give more memory");
        const std::uint64_t in_file = plain_->contents().vertices;
        if (settings_.isolated && in_file > before_) result.counts.isolated_vertices += in_file - before_;
        if (replaces)
            replace(std::exchange(result.mesh, {}));
        else if (welded > 0)
            partition_ = std::move(placed_);
        result.mesh = {};
        return {std::move(result), search.area, std::max(0.0, area_)}; // a negative remainder is rounding
    }

  private:
    static constexpr std::uint64_t bytes_of_face = 600; ///< memory of clean and of the gathered faces

    static CleanResult untouched(const std::vector<Attribute>& attributes) {
        CleanResult result;
        result.changes = kept_changes(attributes);
        return result;
    }

    /// The result with its mesh, which includes the collar.
    CleanResult cleaned_part() {
        gather();
        Mesh unsound = unsound_faces();
        unsound_area_ = area_of(unsound);
        CleanResult part = clean(with_border_closure(std::move(unsound)), settings_);
        for (const char* own : {source_name, border_closure_name}) forget_change(part.changes, own);
        return part;
    }

    [[noreturn]] static void refuse(const char* why, const char* hint) {
        throw Error(ErrorKind::usage, "E-CELLS", fmt::format("clean: {}", why), hint);
    }

    void require_room(std::uint64_t faces) const {
        if (faces * bytes_of_face > means_.memory / 2)
            throw out_of_memory(
                fmt::format("clean: {} triangles near defects need {} at once, but --memory allows {}",
                            grouped(faces), sized(2 * faces * bytes_of_face), sized(means_.memory)),
                "give more memory, or use load with weld: exact, which welds without it");
    }

    /// Loads the faces at unsound positions, and their neighbours.
    void gather() {
        std::uint64_t faces = 0;
        for (std::uint32_t leaf = 0; leaf < placed_->tree().leaves.size(); ++leaf) {
            const Mesh mesh = placed_->cell(leaf).mesh;
            std::vector<std::uint8_t> unsound(mesh.vertex_count());
            for (Index v = 0; v < unsound.size(); ++v) unsound[v] = unsound_.has(mesh.positions[v]);
            for (Index f = 0; f < mesh.face_count(); ++f) {
                const auto wedges = mesh.face_wedges(f);
                if (std::none_of(wedges.begin(), wedges.end(), [&](Index v) { return unsound[v] != 0; }))
                    continue;
                ++faces;
                for (const Index v : wedges)
                    if (!unsound[v]) around_.add(mesh.positions[v]);
            }
            require_room(faces);
        }
        RestOfMesh rest(*placed_, unsound_, around_);
        walk_cell_borders(*placed_, means_, rest);
        rest.finish();
        bounds_ = rest.bounds;
        require_room(rest.gathered.numbers.size());
        faces_ = in_order(rest.gathered);
        whole_ = plain_->piece(plain_records(*numbered_, faces_.records));
        faces_.records = {};
        weld_sound_places();
    }

    /// Welds vertices at sound positions; clean decides about the others.
    void weld_sound_places() {
        if (settings_.weld == Nearness::off) return;
        std::vector<Index> sound;
        std::vector<std::uint64_t> unsound;
        for (Index v = 0; v < whole_.names.size(); ++v) {
            whole_.names[v] = name_of_place(whole_.mesh.positions[v]);
            if (unsound_.has(whole_.mesh.positions[v]))
                unsound.push_back(whole_.names[v]);
            else
                sound.push_back(v);
        }
        spared_ = unsound.size() - sorted_once(unsound).size();
        unite(whole_.mesh, whole_.names, std::move(sound));
    }

    double area_of(const Mesh& mesh) const { return surface_size(mesh, transform_, false).area; }

    /// The unchanged faces at unsound positions, with all gathered vertices.
    Mesh unsound_faces() const {
        Mesh mesh;
        mesh.positions = whole_.mesh.positions;
        for (Index f = 0; f < whole_.mesh.face_count(); ++f)
            if (faces_.sheets[f] == no_sheet)
                for (const Index v : whole_.mesh.face_wedges(f)) mesh.corners.push_back(v);
        return mesh;
    }

    /// The mesh of unsound_faces(), followed by the collar.
    Mesh with_border_closure(Mesh mesh) const {
        const Mesh& whole = whole_.mesh;
        std::vector<std::uint8_t> in_part(whole.face_count());
        for (Index f = 0; f < in_part.size(); ++f) in_part[f] = faces_.sheets[f] == no_sheet;
        std::vector<std::uint8_t> in_border_closure(mesh.face_count(), 0);
        std::vector<std::uint32_t> source(whole.vertex_count());
        for (Index v = 0; v < source.size(); ++v) source[v] = v;
        if (mesh.face_count() < placed_->faces()) {
            const Collar border_closure = border_closure_of(whole, in_part, faces_.sheets);
            mesh.positions.insert(mesh.positions.end(), border_closure.points.begin(),
                                  border_closure.points.end());
            mesh.corners.insert(mesh.corners.end(), border_closure.corners.begin(),
                                border_closure.corners.end());
            in_border_closure.resize(mesh.face_count(), 1);
            source.resize(mesh.vertex_count(), none);
        }
        mesh.attributes = whole.attributes;
        for (Attribute& a : mesh.attributes) a.resize(mesh.count(a.domain));
        mesh.attributes.push_back({source_name, Domain::vertex, Role::index, 1, false, std::move(source)});
        mesh.attributes.push_back(
            {border_closure_name, Domain::face, Role::index, 1, false, std::move(in_border_closure)});
        drop_unused(mesh);
        return mesh;
    }

    /// The cleaned faces that replace the gathered faces.
    Replacement replacement(const Mesh& cleaned) const {
        const auto& in_border_closure =
            std::get<std::vector<std::uint8_t>>(cleaned.find(border_closure_name, Domain::face)->data);
        Mesh mesh = keep_faces(cleaned, faces_without(in_border_closure));
        if (mesh.has_seams())
            refuse("vertices would have several sets of attributes, which cells cannot store",
                   "use non_manifold: off and t_junctions: off to keep them unchanged, or give more memory");
        const auto source =
            std::get<std::vector<std::uint32_t>>(mesh.find(source_name, Domain::vertex)->data);
        mesh.drop(source_name, Domain::vertex);
        mesh.drop(border_closure_name, Domain::face);
        Replacement by;
        for (Index v = 0; v < source.size(); ++v) {
            const bool sound = source[v] != none && !unsound_.has(whole_.mesh.positions[source[v]]);
            by.come.names.push_back(sound ? whole_.names[source[v]] : hashed(hashed(UINT64_MAX, 0), v));
        }
        by.bounds = bounds_;
        by.bounds.add(mesh.bounds());
        by.come.mesh = std::move(mesh);
        for (std::size_t f = 0; f < faces_.numbers.size(); ++f)
            if (faces_.sheets[f] == no_sheet) by.gone.push_back(faces_.numbers[f]);
        return by;
    }

    void replace(const Mesh& cleaned) {
        Replacement by = replacement(cleaned);
        area_ += area_of(by.come.mesh) - unsound_area_;
        whole_ = {};
        faces_ = {};
        const auto faces = static_cast<std::uint32_t>(placed_->faces());
        if (by.gone.size() == faces && by.come.mesh.face_count() == 0)
            throw Error(ErrorKind::stage, "E-EMPTY", "clean: no face of the mesh remains",
                        "use --partition never, because a mesh in memory may become empty");
        placed_.reset(); // release temporary data first
        partition_.reset();
        partition_ =
            std::make_unique<Partition>(replaced_source(numbered_, faces, std::move(by)), means_, most_);
    }

    std::unique_ptr<Partition>& partition_;
    const CleanSettings& settings_;
    const CellResources& means_;
    const Transform& transform_;
    std::uint64_t most_;
    std::shared_ptr<FaceSource> plain_, numbered_;
    std::uint64_t before_;              ///< vertices used by faces
    std::unique_ptr<Partition> placed_; ///< partition of the numbered source
    PlaceSet unsound_, around_;
    GatheredFaces faces_;
    Piece whole_;            ///< the gathered faces
    std::size_t spared_ = 0; ///< vertices minus positions at unsound positions, which clean counts
    Box bounds_;
    double area_ = 0;         ///< area, after the transform, of the faces cleaned so far
    double unsound_area_ = 0; ///< area of the faces at unsound positions, before cleaning
};

} // namespace

std::optional<std::string> why_not_in_cells(const CleanSettings& s) {
    for (const auto& [how, name] :
         {std::pair{s.weld, "weld"}, std::pair{s.t_junctions, "t_junctions"}, std::pair{s.stitch, "stitch"}})
        if (how == Nearness::near)
            return fmt::format("{}: near moves vertices and changes the faces around them, which needs the "
                               "whole mesh; exact does not",
                               name);
    if (s.holes) return "holes: a patch may meet any other face, so filling needs the whole mesh";
    if (s.self_intersections != Untangle::off)
        return "self_intersections needs the whole mesh, because any two faces can intersect";
    for (const auto& [given, name] :
         {std::pair{s.components.has_value(), "components"}, std::pair{s.open_components, "open_components"},
          std::pair{s.inner_components, "inner_components"}})
        if (given) return fmt::format("{}: connected components need the whole mesh", name);
    if (s.single) return "precision: single moves vertices, and needs the whole mesh; full does not";
    return {};
}

CleanedCells clean_cells(std::unique_ptr<Partition>& partition, const CleanSettings& settings,
                         const CellResources& means, const Transform& transform, std::uint64_t most) {
    return CellCleaning(partition, settings, means, transform, most).run();
}

} // namespace facetmill::cells
