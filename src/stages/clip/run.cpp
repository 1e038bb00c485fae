#include "stages/clip/parts.hpp"
#include "stage/options/snap.hpp"
#include "stage/stage.hpp"

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
         {"front", Keep::front, "what lies on the side that the normal points to, or in the box"},
         {"back", Keep::back, "what lies on the other side, or around the box"},
         {"both", Keep::both,
          "both, as parts NAME.front and NAME.back (NAME.inside, NAME.outside); of several planes the back "
          "is all that is not in front of every one"}},
        "Which side stays.");
    declare_cap(d, &ClipOptions::cap, &ClipOptions::cap_material);
    d.option("triangulate", &ClipOptions::triangulate,
             "Leave triangles only; without it a cut triangle may become a quad.");
    declare_space(d);
    d.choice<Coplanar>(
        "coplanar", &ClipOptions::coplanar,
        {{"keep", Coplanar::keep, "they stay"}, {"drop", Coplanar::drop, "they go"}},
        "Faces of open parts that lie in the plane. Those of closed parts stay when they look away "
        "from what stays.");
    declare_snap(d, &ClipOptions::snap, "a plane");
}

void declare_plane_field(DeclareFields<Plane>& d) {
    d.field("normal", &Plane::normal, "The way that its front looks.");
    d.field("through", &Plane::through, "A point on it.");
    d.field("offset", &Plane::offset, "How far it stands from that point along the normal.")
        .unit("scene units");
}

void declare_report(DeclareFields<ClipReport>& d) {
    d.list("planes", &ClipReport::planes, "The planes, in the world.", declare_plane_field)
        .only_when("they stand in the world (space: world)");
    d.field("cut_faces", &ClipReport::cut_faces, "Faces that were cut.");
    d.field("cap_faces", &ClipReport::cap_faces, "Faces of caps.");
    d.field("open_contours", &ClipReport::open_contours, "Contours that were not capped, as they are open.");
    d.field("on_plane", &ClipReport::on_plane, "Vertices that lie on a plane.");
    d.field("snapped", &ClipReport::snapped, "Those of them that do so within the rounding of float32.");
    d.field("remembered", &ClipReport::remembered, "Those of them that a clip before put there.");
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
     .about = "Clips by planes and boxes, with watertight caps.",
     .details =
         "Every vertex is classified once, by the exact sign of its distance, so neighbours always agree and "
         "a vertex on the plane is neither in front nor behind. Each cut edge gets one new vertex, shared by "
         "all faces there. Triangles, quads and larger faces, convex or not, are cut directly. A closed part "
         "that is capped stays closed, whatever it looks like: with several planes in a row, non-manifold, "
         "or crossing itself (where it covers a place twice, so does its cap). Points that a clip made on a "
         "plane count as on it when the plane comes again, in this stage or a later one, until a stage moves "
         "them.\n\n"
         "Planes stand in the scene; parts with a node transform are cut where they stand. A closed part's "
         "face in the plane stays only when it looks away from what stays. A contour that does not close "
         "cannot be capped: it is named (W-CAP-OPEN) and the rest is done. A plane that misses says so "
         "(W-CLIP-ALL, W-CLIP-NOTHING); a part of which nothing is kept stays as an empty part.\n\n"
         "A box keeps what is in it, or around it: the two fit exactly, and with caps both are closed. So it "
         "is with several planes and keep: both; keep: back alone is what is behind each of them.\n\n"
         "New vertices and wedges are interpolated, once per edge and pair of wedges, so seams stay seams; "
         "pieces copy the attributes of their face. Caps have a primitive and material of their own, the "
         "plane's normal, planar texture coordinates when the part has TEXCOORD_0, and zeros in other face "
         "attributes; the face attributes cut_id (the plane's number; 0 elsewhere) and group tell them "
         "apart.\n\n"
         "Source: the note on clipping facets by a plane (1997).",
     .examples = {"clip: z=0.2", "clip: {plane: {normal: [0, 0, 1], through: centre}, cap: true}",
                  "clip: {planes: [x=10%, [-1, 0, 0, 0.5]], cap: true}",
                  "clip: {plane: z=centre, keep: both, cap: true}",
                  "clip: {planes: [x=20%, y=20%], keep: both, cap: true}",
                  "clip: {box: {min: [0, 0, 0], max: [1, 1, 0.5]}, cap: true}",
                  "clip: {box: {centre: [0, 0, 0], size: [2, 1, 1], angle: 30deg}, keep: outside}"}},
    declare, declare_report, run, StageHooks<ClipOptions>{.files = {}, .verify = verify_cutter});

} // namespace

} // namespace facetmill
