#include "stage/assertions.hpp"
#include "stage/stage.hpp"

namespace facetmill {

namespace {

struct EnsureOptions {
    Assertions assertions;
};

void declare(Declare<EnsureOptions>& d) { declare_properties(d, &EnsureOptions::assertions, "ensure"); }

Scene run(Scene scene, const EnsureOptions& o, Context& context) {
    for (auto& check : evaluate(o.assertions, inspect(scene, o.assertions.settings()), context.name()))
        context.check(std::move(check));
    return scene;
}

void verify(const EnsureOptions& o, const Value& given, Problems& problems) {
    if (o.assertions.all.empty() && !given.deferred)
        problems.add(given.mark, "E-MISSING", "ensure needs at least one property", "ensure: {closed: true}");
}

const RegisterStage registered{make_stage<EnsureOptions>(
    {.name = "ensure",
     .about = "A contract: the properties must hold here, or the run fails.",
     .details =
         "The same assertions as the common key `ensure`, as a stage of its own: what it says must hold for "
         "the scene at this place. Use validate to judge with evidence, per part, or as a warning only. The "
         "mesh is passed on as it is.",
     .examples = {"ensure: {closed: true}", "ensure: {faces: {max: 5000}, components: 1}"},
     .checks = true},
    declare, run, StageHooks<EnsureOptions>{.files = {}, .verify = verify})};

} // namespace

} // namespace facetmill
