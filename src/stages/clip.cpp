#include "geometry/clip.hpp"

#include "stage/plane_option.hpp"
#include "stage/stage.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

enum class Space { world, local };

struct ClipOptions {
    std::optional<PlaneOption> plane;
    std::vector<PlaneOption> planes;
    Keep keep = Keep::front;
    bool cap = false;
    bool triangulate = false;
    Space space = Space::world;
    Coplanar coplanar = Coplanar::keep;
};

void declare(Declare<ClipOptions>& d) {
    d.group("plane", &ClipOptions::plane, "The plane to clip by.", declare_plane).primary();
    d.option("planes", &ClipOptions::planes, "Several planes, each as for plane; one after the other.");
    d.exactly_one({"plane", "planes"});
    d.choice<Keep>("keep", &ClipOptions::keep,
                   {{"front", Keep::front, "what lies on the side that the normal points to"},
                    {"back", Keep::back, "what lies on the other side"},
                    {"both", Keep::both, "both, as parts NAME.front and NAME.back; for one plane"}},
                   "Which side stays.");
    d.option("cap", &ClipOptions::cap,
             "Close what the cut opens with faces in the plane, of a material 'cap'.");
    d.option("triangulate", &ClipOptions::triangulate,
             "Leave triangles only; without it a cut triangle may become a quad.");
    d.choice<Space>(
        "space", &ClipOptions::space,
        {{"world", Space::world, "planes stand in the scene"},
         {"local", Space::local, "planes stand in each part's own space, before its node's transform"}},
        "What coordinates, centre and extent refer to.");
    d.choice<Coplanar>(
        "coplanar", &ClipOptions::coplanar,
        {{"keep", Coplanar::keep, "they stay"}, {"drop", Coplanar::drop, "they go"}},
        "Faces of open parts that lie in the plane. Those of closed parts stay when they look away "
        "from what stays.");
}

void verify(const ClipOptions& o, const Value& given, Problems& problems) {
    const Value* planes = given.is_map() ? given.find("planes") : nullptr;
    if (o.plane) {
        const Value* plane = given.is_map() ? given.find("plane") : &given;
        verify_plane(*o.plane, plane ? plane->mark : given.mark, problems);
    }
    for (std::size_t i = 0; i < o.planes.size(); ++i) {
        const bool listed = planes && planes->is_list() && i < planes->items.size();
        verify_plane(o.planes[i], listed ? planes->items[i].mark : given.mark, problems);
    }
    if (o.keep == Keep::both && o.planes.size() > 1)
        problems.add(planes ? planes->mark : given.mark, "E-PLANE",
                     "clip: keep: both takes exactly one plane",
                     "clip once for every plane, or keep the front or the back");
}

/// The planes for one part, in its own space.
std::vector<Plane> planes_for(const Part& part, const ClipOptions& o, const std::vector<Plane>& world,
                              const Scene& scene, Context& context) {
    std::vector<Plane> planes;
    if (o.space == Space::world)
        for (const Plane& p : world) planes.push_back(part.skinned ? p : pulled_back(p, part.transform));
    else if (o.plane)
        planes.push_back(resolve_plane(*o.plane, scene, context, "plane", &part));
    else
        for (const PlaneOption& p : o.planes)
            planes.push_back(resolve_plane(p, scene, context, "planes", &part));
    return planes;
}

Json as_json(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }

/// What users should know of a clip: open contours, everything kept, nothing kept.
void warn(const Part& part, const ClipResult& r, bool had_faces, std::size_t faces, Context& context) {
    for (const OpenContour& open : r.open) {
        const Vec3 at = part.skinned ? open.at : part.transform.point(open.at);
        context.warn(
            "W-CAP-OPEN",
            fmt::format("clip: a contour of {} edges of part '{}' is open and was not capped; it ends at "
                        "({:.6g}, {:.6g}, {:.6g})",
                        open.edges, part.name, at.x, at.y, at.z),
            "the part has a hole where the plane meets it; fill it first");
    }
    if (!r.changed && had_faces)
        context.warn("W-CLIP-ALL", fmt::format("clip: no plane met part '{}', all of it was kept", part.name),
                     "check the plane's place and side; info prints the bounds");
    if (had_faces && faces == 0)
        context.warn("W-CLIP-NOTHING", fmt::format("clip: nothing of part '{}' was kept", part.name),
                     "check the plane's place and side; keep: back keeps the other side");
}

/// The number of the material 'cap', which is appended when the scene has none.
Index cap_material(Scene& scene) {
    for (Index i = 0; i < scene.materials.size(); ++i)
        if (scene.materials[i].name == "cap") return i;
    Material cap;
    cap.name = "cap";
    scene.materials.push_back(cap);
    return static_cast<Index>(scene.materials.size() - 1);
}

class ClipRun {
  public:
    ClipRun(Scene& scene, const ClipOptions& o, Context& context) : scene_(scene), o_(o), context_(context) {
        if (o.space == Space::local) return;
        if (o.plane) world_.push_back(resolve_plane(*o.plane, scene, context, "plane"));
        for (const PlaneOption& p : o.planes) world_.push_back(resolve_plane(p, scene, context, "planes"));
        for (const Plane& p : world_)
            context.result()["planes"].push_back(
                {{"normal", as_json(p.normal)}, {"through", as_json(p.through)}, {"offset", p.offset}});
    }

    void run() {
        context_.for_each_part(scene_, [&](Part& part) { clip_part(part); });
        if (cap_faces_ > 0) cap_material(scene_);
        insert_backs();
        context_.result()["cut_faces"] = cut_faces_;
        context_.result()["cap_faces"] = cap_faces_;
        context_.result()["open_contours"] = open_;
    }

  private:
    void clip_part(Part& part) {
        ClipSettings settings;
        settings.planes = planes_for(part, o_, world_, scene_, context_);
        settings.keep = o_.keep;
        settings.cap = o_.cap;
        settings.triangulate = o_.triangulate;
        settings.coplanar = o_.coplanar;
        if (o_.cap) settings.cap_primitive = Primitive{wanted_material(), {}, {}};
        const bool had_faces = part.mesh.face_count() > 0;
        ClipResult r = clip(std::move(part.mesh), settings);
        warn(part, r, had_faces, r.front.face_count() + r.back.face_count(), context_);
        context_.ledger(part, r.fates);
        cut_faces_ += r.cut_faces, cap_faces_ += r.cap_faces, open_ += r.open.size();
        if (o_.keep == Keep::both) {
            const auto at = static_cast<std::size_t>(&part - scene_.parts.data());
            Part back = part;
            back.name += ".back", part.name += ".front";
            back.mesh = std::move(r.back), back.changed = true;
            backs_.emplace_back(at, std::move(back));
        }
        part.mesh = std::move(o_.keep == Keep::back ? r.back : r.front);
    }
    /// Where cap_material is or will be, so that no material appears when no cap was made.
    Index wanted_material() const {
        Index i = 0;
        while (i < scene_.materials.size() && scene_.materials[i].name != "cap") ++i;
        return i;
    }
    void insert_backs() {
        for (std::size_t k = backs_.size(); k-- > 0;)
            scene_.parts.insert(scene_.parts.begin() + static_cast<std::ptrdiff_t>(backs_[k].first) + 1,
                                std::move(backs_[k].second));
    }

    Scene& scene_;
    const ClipOptions& o_;
    Context& context_;
    std::vector<Plane> world_;
    std::vector<std::pair<std::size_t, Part>> backs_; ///< behind which part, and the part
    std::size_t cut_faces_ = 0, cap_faces_ = 0, open_ = 0;
};

Scene run(Scene scene, const ClipOptions& o, Context& context) {
    ClipRun(scene, o, context).run();
    return scene;
}

const RegisterStage clip_stage = make_stage<ClipOptions>(
    {.name = "clip",
     .about = "Clips by planes, with watertight caps.",
     .details =
         "Every vertex is classified once, by the exact sign of its distance, so neighbours always agree and "
         "a "
         "vertex on the plane is neither in front nor behind. Each cut edge gets one new vertex, shared by "
         "all "
         "faces there. Triangles, quads and larger faces, convex or not, are cut directly. A closed part "
         "that is "
         "capped stays closed, whatever it looks like: with several planes in a row, non-manifold, or "
         "crossing "
         "itself (where it covers a place twice, so does its cap).\n\n"
         "Planes stand in the scene; parts with a node transform are cut where they stand. A closed part's "
         "face "
         "in the plane stays only when it looks away from what stays. A contour that does not close cannot "
         "be "
         "capped: it is named (W-CAP-OPEN) and the rest is done. A plane that misses says so (W-CLIP-ALL, "
         "W-CLIP-NOTHING); a part of which nothing is kept stays as an empty part.\n\n"
         "New vertices and wedges are interpolated, once per edge and pair of wedges, so seams stay seams; "
         "pieces "
         "copy the attributes of their face. Caps have a primitive and material 'cap', the plane's normal, "
         "planar "
         "texture coordinates when the part has TEXCOORD_0, and zeros in other face attributes.\n\n"
         "Source: the note on clipping facets by a plane (1997).",
     .examples = {"clip: z=0.2", "clip: {plane: {normal: [0, 0, 1], through: centre}, cap: true}",
                  "clip: {planes: [x=10%, [-1, 0, 0, 0.5]], cap: true}",
                  "clip: {plane: z=centre, keep: both, cap: true}"}},
    declare, run, StageHooks<ClipOptions>{.files = {}, .verify = verify});

} // namespace

} // namespace facetmill
