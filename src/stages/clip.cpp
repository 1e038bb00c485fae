#include "geometry/clip.hpp"

#include "stage/cap_option.hpp"
#include "stage/cutter_option.hpp"
#include "stage/stage.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

enum class Snap { automatic, none };

struct ClipOptions : CutterOption {
    Keep keep = Keep::front;
    bool cap = false;
    std::string cap_material = "cap";
    bool triangulate = false;
    Coplanar coplanar = Coplanar::keep;
    Snap snap = Snap::automatic;
};

void declare_rest(Declare<ClipOptions>& d) {
    d.option("triangulate", &ClipOptions::triangulate,
             "Leave triangles only; without it a cut triangle may become a quad.");
    declare_space(d);
    d.choice<Coplanar>(
        "coplanar", &ClipOptions::coplanar,
        {{"keep", Coplanar::keep, "they stay"}, {"drop", Coplanar::drop, "they go"}},
        "Faces of open parts that lie in the plane. Those of closed parts stay when they look away "
        "from what stays.");
    d.choice<Snap>(
         "snap", &ClipOptions::snap,
         {{"auto", Snap::automatic,
           "positions that are 32-bit floats count as on a plane within one float's rounding of the "
           "part's bounds: the z = 0.1 of an STL is not the 0.1 of a pipeline"},
          {"0", Snap::none, "only what is exactly on it does"}},
         "What counts as on a plane.")
        .option()
        .schema = {{"enum", {"auto", "0", 0}}};
}

void declare(Declare<ClipOptions>& d) {
    declare_cutter(d);
    d.choice<Keep>(
        "keep", &ClipOptions::keep,
        {{"inside", Keep::front, "of a box: the same as front"},
         {"outside", Keep::back, "of a box: the same as back"},
         {"front", Keep::front, "what lies on the side that the normal points to, or in the box"},
         {"back", Keep::back, "what lies on the other side, or around the box"},
         {"both", Keep::both,
          "both, as parts NAME.front and NAME.back (NAME.inside, NAME.outside); of several planes the back "
          "is all that is not in front of every one"}},
        "Which side stays.");
    declare_cap(d, &ClipOptions::cap, &ClipOptions::cap_material);
    declare_rest(d);
}

/// What users should know of a clip: open contours, everything kept, nothing kept.
void warn(const Part& part, const ClipResult& r, bool had_faces, Context& context) {
    warn_of_open("clip", part, r.open, context);
    if (!r.changed && had_faces)
        context.warn("W-CLIP-ALL", fmt::format("clip: no plane met part '{}', all of it was kept", part.name),
                     "check the plane's place and side; info prints the bounds");
    if (had_faces && r.front.face_count() + r.back.face_count() == 0)
        context.warn("W-CLIP-NOTHING", fmt::format("clip: nothing of part '{}' was kept", part.name),
                     "check the plane's place and side; keep: back keeps the other side");
}

class ClipRun {
  public:
    ClipRun(Scene& scene, const ClipOptions& o, Context& context)
        : scene_(scene), o_(o), context_(context), cutter_(o, scene, context) {}

    void run() {
        context_.for_each_part(scene_, [&](Part& part) { clip_part(part); });
        if (count_.cap_faces > 0) add_material(scene_, o_.cap_material);
        for (std::size_t k = backs_.size(); k-- > 0;)
            scene_.parts.insert(scene_.parts.begin() + static_cast<std::ptrdiff_t>(backs_[k].first) + 1,
                                std::move(backs_[k].second));
        Json& result = context_.result();
        result["cut_faces"] = count_.cut_faces;
        result["cap_faces"] = count_.cap_faces;
        result["open_contours"] = open_;
        result["on_plane"] = count_.on_plane;
        result["snapped"] = count_.snapped;
        result["remembered"] = count_.remembered;
    }

  private:
    ClipSettings settings_for(const Part& part) const {
        ClipSettings settings;
        settings.planes = cutter_.planes_for(part);
        settings.keep = o_.keep;
        settings.convex = o_.box || (o_.keep == Keep::both && o_.planes.size() > 1);
        settings.triangulate = o_.triangulate;
        settings.coplanar = o_.coplanar;
        settings.snap = o_.snap == Snap::automatic;
        if (part.cuts) settings.memory = *part.cuts;
        if (o_.cap) set_cap(settings, scene_, o_.cap_material);
        return settings;
    }
    void clip_part(Part& part) {
        const bool had_faces = part.mesh.face_count() > 0;
        const ClipSettings settings = settings_for(part);
        ClipResult r = clip(std::move(part.mesh), settings);
        warn(part, r, had_faces, context_);
        context_.ledger(part, r.fates);
        count_.cut_faces += r.cut_faces, count_.cap_faces += r.cap_faces, open_ += r.open.size();
        count_.on_plane += r.on_plane, count_.snapped += r.snapped, count_.remembered += r.remembered;
        if (!r.memory.entries.empty()) part.cuts = std::make_shared<const CutMemory>(std::move(r.memory));
        if (o_.keep == Keep::both) {
            Part back = part;
            back.name += o_.box ? ".outside" : ".back", part.name += o_.box ? ".inside" : ".front";
            back.mesh = std::move(r.back), back.changed = true;
            backs_.emplace_back(static_cast<std::size_t>(&part - scene_.parts.data()), std::move(back));
        }
        part.mesh = std::move(o_.keep == Keep::back ? r.back : r.front);
    }

    Scene& scene_;
    const ClipOptions& o_;
    Context& context_;
    Cutter cutter_;
    std::vector<std::pair<std::size_t, Part>> backs_; ///< behind which part, and the part
    ClipResult count_;                                ///< sums of its counts
    std::size_t open_ = 0;
};

Scene run(Scene scene, const ClipOptions& o, Context& context) {
    ClipRun(scene, o, context).run();
    return scene;
}

const RegisterStage clip_stage = make_stage<ClipOptions>(
    {.name = "clip",
     .about = "Clips by planes and boxes, with watertight caps.",
     .details =
         "Every vertex is classified once, by the exact sign of its distance, so neighbours always agree and "
         "a vertex on the plane is neither in front nor behind. Each cut edge gets one new vertex, shared by "
         "all faces there. Triangles, quads and larger faces, convex or not, are cut directly. A closed part "
         "that is capped stays closed, whatever it looks like: with several planes in a row, non-manifold, "
         "or "
         "crossing itself (where it covers a place twice, so does its cap). Points that a clip made on a "
         "plane "
         "count as on it when the plane comes again, in this stage or a later one, until a stage moves "
         "them.\n\n"
         "Planes stand in the scene; parts with a node transform are cut where they stand. A closed part's "
         "face in the plane stays only when it looks away from what stays. A contour that does not close "
         "cannot be capped: it is named (W-CAP-OPEN) and the rest is done. A plane that misses says so "
         "(W-CLIP-ALL, W-CLIP-NOTHING); a part of which nothing is kept stays as an empty part.\n\n"
         "A box keeps what is in it, or around it: the two fit exactly, and with caps both are closed. So it "
         "is "
         "with several planes and keep: both; keep: back alone is what is behind each of them.\n\n"
         "New vertices and wedges are interpolated, once per edge and pair of wedges, so seams stay seams; "
         "pieces copy the attributes of their face. Caps have a primitive and material of their own, the "
         "plane's "
         "normal, planar texture coordinates when the part has TEXCOORD_0, and zeros in other face "
         "attributes; "
         "the face attributes cut_id (the plane's number; 0 elsewhere) and group tell them apart.\n\n"
         "Source: the note on clipping facets by a plane (1997).",
     .examples = {"clip: z=0.2", "clip: {plane: {normal: [0, 0, 1], through: centre}, cap: true}",
                  "clip: {planes: [x=10%, [-1, 0, 0, 0.5]], cap: true}",
                  "clip: {plane: z=centre, keep: both, cap: true}",
                  "clip: {planes: [x=20%, y=20%], keep: both, cap: true}",
                  "clip: {box: {min: [0, 0, 0], max: [1, 1, 0.5]}, cap: true}",
                  "clip: {box: {centre: [0, 0, 0], size: [2, 1, 1], angle: 30deg}, keep: outside}"}},
    declare, run, StageHooks<ClipOptions>{.files = {}, .verify = verify_cutter});

} // namespace

} // namespace facetmill
