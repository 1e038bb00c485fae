#include "geometry/evidence.hpp"
#include "stage/assertions.hpp"
#include "stage/stage.hpp"

#include <span>

namespace facetmill {

namespace {

enum class Per { scene, part };

struct ValidateOptions {
    Assertions assertions;
    Severity severity = Severity::error;
    Per per = Per::scene;
};

void declare(Declare<ValidateOptions>& d) {
    declare_properties(d, &ValidateOptions::assertions, "validate");
    d.choice("severity", &ValidateOptions::severity,
             {{"error", Severity::error, "a failed assertion fails the run, exit 1"},
              {"warn", Severity::warning, "it is reported, and the run goes on"}},
             "What a failed assertion means.");
    d.choice("per", &ValidateOptions::per,
             {{"scene", Per::scene, "sums over the parts, and truths of all parts"},
              {"part", Per::part, "each part for itself"}},
             "What the assertions are about.");
}

/// What a bare `validate` asserts: the marks of a sound solid.
Assertions or_sound(Assertions given, const Mark& where) {
    if (!given.all.empty()) return given;
    for (const char* name : {"closed", "edge_manifold", "vertex_manifold", "oriented"})
        given.all.push_back({name, {.min = {}, .max = {}, .truth = true}, where});
    given.all.push_back({"degenerate_faces", {.min = 0, .max = 0, .truth = {}}, where});
    given.all.push_back({"faces", {.min = 1, .max = {}, .truth = {}}, where});
    return given;
}

/// The first places that speak against the property, in the world.
Json evidence_against(const Scene& scene, std::string_view property) {
    constexpr std::size_t most = 10;
    Json evidence = Json::array();
    for (const auto& part : scene.parts)
        for (const Place& place : places_against(part.mesh, property, most - evidence.size())) {
            const Vec3 at = part.transform.point(place.at);
            Json entry = {{"part", part.name}, {"at", {at.x, at.y, at.z}}};
            if (place.face != none) entry["face"] = place.face;
            evidence.push_back(std::move(entry));
        }
    return evidence;
}

void judge(const Scene& scene, const std::string& part_name, const Assertions& assertions, Severity severity,
           Context& context) {
    const Properties properties =
        inspect(scene, {.self_intersections = assertions.needs_self_intersections()});
    for (auto& check : evaluate(assertions, properties, context.name())) {
        check.severity = severity;
        check.part = part_name;
        if (!check.passed) check.evidence = evidence_against(scene, check.name);
        context.check(std::move(check));
    }
}

/// Lends the parts at the given places to body as a scene of their own, without a copy.
template <class Body>
void with_parts(Scene& scene, std::span<const std::size_t> places, Body&& body) {
    Scene chosen{{}, {}, scene.unit, scene.up, {}};
    for (const std::size_t i : places) chosen.parts.push_back(std::move(scene.parts[i]));
    body(chosen);
    for (std::size_t k = 0; k < places.size(); ++k) scene.parts[places[k]] = std::move(chosen.parts[k]);
}

Scene run(Scene scene, const ValidateOptions& o, Context& context) {
    const Assertions assertions = or_sound(o.assertions, context.where());
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < scene.parts.size(); ++i)
        if (context.selects(scene.parts[i], scene)) places.push_back(i);
    if (o.per == Per::scene)
        with_parts(scene, places, [&](const Scene& all) { judge(all, "", assertions, o.severity, context); });
    else
        for (const std::size_t i : places)
            with_parts(scene, {&i, 1}, [&](const Scene& one) {
                judge(one, one.parts[0].name, assertions, o.severity, context);
            });
    return scene;
}

const RegisterStage registered{make_stage<ValidateOptions>(
    {.name = "validate",
     .about = "Judges the mesh: each property given is an assertion, and a failed one fails the run.",
     .details =
         "Every option but severity and per is a property with a bound: a value (euler: 2), a truth (closed: "
         "true) "
         "or a range (faces: {max: 5000}). Without any, the mesh is to be closed, edge- and vertex-manifold, "
         "oriented, free of degenerate faces and not empty. A failed assertion carries evidence: the first faces and "
         "points "
         "that speak against it. The mesh is passed on as it is.\n\n"
         "`euler: 2` is the notes' test for a closed surface; it is one only for genus 0 in one piece: V - E "
         "+ F "
         "is 2 - 2g for a closed piece of genus g, and the pieces add up. `closed: true` says it for all.",
     .examples = {"validate", "validate: {closed: true, euler: 2}",
                  "validate: {faces: {max: 5000}, self_intersections: 0, per: part}"},
     .checks = true},
    declare, run)};

} // namespace

} // namespace facetmill
