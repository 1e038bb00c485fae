#include "stage/options/snap.hpp"
#include "stage/stage.hpp"
#include "stages/clip/help.hpp"
#include "stages/clip/parts.hpp"

namespace facetmill {

namespace {

struct ClipOptions : CutterOption {
    Keep keep = Keep::front;
    bool cap = false;
    std::string cap_material = "cap";
    bool triangulate = false;
    Coplanar coplanar = Coplanar::keep;
    Snap snap = Snap::automatic;
};

void declare(Declare<ClipOptions>& d) {
    declare_cutter(d);
    d.choice<Keep>(
        "keep", &ClipOptions::keep,
        {{"inside", Keep::front, "of a box: the same as front"},
         {"outside", Keep::back, "of a box: the same as back"},
         {"front", Keep::front, "what lies on the side that the normal points to, or inside the box"},
         {"back", Keep::back, "what lies on the other side, or around the box"},
         {"both", Keep::both,
          "both, as parts NAME.front and NAME.back (NAME.inside, NAME.outside); with several planes the back "
          "is everything that is not in front of all of them"}},
        "Which side is kept.");
    declare_cap(d, &ClipOptions::cap, &ClipOptions::cap_material);
    d.option("triangulate", &ClipOptions::triangulate,
             "Cut all faces into triangles; without this, a cut triangle may become a quad.");
    declare_space(d);
    d.choice<Coplanar>("coplanar", &ClipOptions::coplanar,
                       {{"keep", Coplanar::keep, "they stay"}, {"drop", Coplanar::drop, "they go"}},
                       "What is done with faces of open parts that lie in the plane. Those of closed parts "
                       "are kept when they face away from what is kept.");
    declare_snap(d, &ClipOptions::snap, "a plane");
}

void declare_plane_field(DeclareFields<Plane>& d) {
    d.field("normal", &Plane::normal, "The direction of its front.");
    d.field("through", &Plane::through, "A point on it.");
    d.field("offset", &Plane::offset, "Its distance from that point along the normal.").unit("scene units");
}

void declare_report(DeclareFields<ClipReport>& d) {
    d.list("planes", &ClipReport::planes, "The planes, in the world.", declare_plane_field)
        .only_when("they stand in the world (space: world)");
    d.field("cut_faces", &ClipReport::cut_faces, "Faces that were cut.");
    d.field("cap_faces", &ClipReport::cap_faces, "Faces of caps.");
    d.field("open_contours", &ClipReport::open_contours,
            "Contours that were not capped because they are open.");
    d.field("on_plane", &ClipReport::on_plane, "Vertices that lie on a plane.");
    d.field("snapped", &ClipReport::snapped, "Those that do so within the rounding of float32.");
    d.field("remembered", &ClipReport::remembered, "Those that an earlier clip placed there.");
}

Scene run(Scene scene, const ClipOptions& o, Context& context, ClipReport& report) {
    PartsToClip how;
    how.settings.keep = o.keep;
    how.settings.convex = o.box || (o.keep == Keep::both && o.planes.size() > 1);
    how.settings.cap = o.cap;
    how.settings.triangulate = o.triangulate;
    how.settings.coplanar = o.coplanar;
    how.settings.snap = o.snap == Snap::automatic;
    how.cap_material = o.cap_material;
    if (o.box) {
        how.front = ".inside";
        how.back = ".outside";
    }
    report = clip_parts(scene, Cutter(o, scene, context), how, context);
    return scene;
}

const RegisterStage clip_stage = make_stage<ClipOptions>(
    {.name = "clip",
     .about = help::clip::about,
     .details = help::clip::details,
     .examples = {"clip: z=0.2", "clip: {plane: {normal: [0, 0, 1], through: centre}, cap: true}",
                  "clip: {planes: [x=10%, [-1, 0, 0, 0.5]], cap: true}",
                  "clip: {plane: z=centre, keep: both, cap: true}",
                  "clip: {planes: [x=20%, y=20%], keep: both, cap: true}",
                  "clip: {box: {min: [0, 0, 0], max: [1, 1, 0.5]}, cap: true}",
                  "clip: {box: {centre: [0, 0, 0], size: [2, 1, 1], angle: 30deg}, keep: outside}"},
     .may_lose = MayLose::all},
    declare, declare_report, run, StageHooks<ClipOptions>{.files = {}, .verify = verify_cutter});

} // namespace

} // namespace facetmill
