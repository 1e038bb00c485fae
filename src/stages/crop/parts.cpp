#include "stages/crop/parts.hpp"

#include "mesh/placement.hpp"
#include "stage/both_sides.hpp"
#include "stage/options/cap.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

class CropRun {
  public:
    CropRun(Scene& scene, const Footprint& footprint, const PartsToCrop& how, Context& context)
        : scene_(scene), footprint_(footprint), both_(how.both), settings_(how.settings), context_(context),
          sides_(scene) {
        if (settings_.cap) set_cap(settings_, scene, how.cap_material);
    }

    CropReport run(const std::string& cap_material) {
        report_.rings = footprint_.rings().size();
        report_.footprint_area = footprint_.area();
        report_.axis = std::string(1, "xyz"[settings_.axis]);
        context_.for_each_part(scene_, [&](Part& part) { crop_part(part); });
        if (report_.cap_faces > 0) add_material(scene_, cap_material);
        sides_.insert();
        return report_;
    }

  private:
    void crop_part(Part& part) {
        settings_.to_world = effective(part);
        settings_.memory = part.cuts ? *part.cuts : CutMemory{};
        const std::size_t faces = part.mesh.face_count();
        std::vector<CropResult> sides;
        if (both_)
            sides = crop_both(part.mesh, footprint_, settings_);
        else
            sides.push_back(crop(part.mesh, footprint_, settings_));
        warn(part, sides, faces);
        report_.faces_before += faces;
        report_.cut_faces += sides[0].cut_faces;
        report_.snapped += sides[0].snapped;
        CutMemory memory;
        for (CropResult& r : sides) {
            report_.faces_after += r.mesh.face_count();
            report_.cap_faces += r.cap_faces;
            report_.open_contours += r.open.size();
            context_.attribute_changes(part, r.changes);
            for (auto& entry : r.memory.entries) memory.add(entry.plane, std::move(entry.points));
        }
        if (!memory.entries.empty()) part.cuts = std::make_shared<const CutMemory>(std::move(memory));
        part.mesh = {};
        if (both_) sides_.part_in_two(part, ".inside", ".outside", std::move(sides[1].mesh));
        part.mesh = std::move(sides[0].mesh);
    }

    void warn(const Part& part, const std::vector<CropResult>& sides, std::size_t faces) {
        constexpr const char* hint =
            "check the position of the footprint and the axis; info prints the bounds";
        std::size_t left = 0;
        bool changed = false;
        for (const CropResult& r : sides) {
            warn_of_open("crop", part, r.open, context_);
            left += r.mesh.face_count();
            changed |= r.mesh.face_count() > 0 && r.changed;
        }
        if (faces > 0 && left == 0)
            context_.warn("W-CROP-NOTHING", fmt::format("crop: nothing of part '{}' was kept", part.name),
                          hint);
        else if (faces > 0 && !changed)
            context_.warn(
                "W-CROP-ALL",
                fmt::format("crop: the outline does not cut part '{}'; all of it was kept", part.name), hint);
    }

    Scene& scene_;
    const Footprint& footprint_;
    bool both_;
    CropSettings settings_;
    Context& context_;
    BothSides sides_;
    CropReport report_;
};

} // namespace

CropReport crop_parts(Scene& scene, const Footprint& footprint, const PartsToCrop& how, Context& context) {
    return CropRun(scene, footprint, how, context).run(how.cap_material);
}

} // namespace facetmill
