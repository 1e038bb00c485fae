#include "stage/as_loaded.hpp"
#include "stage/contract.hpp"
#include "stage/stage.hpp"
#include "stages/ensure/help.hpp"

namespace facetmill::ensure_stage {

namespace {

struct EnsureOptions {
    Assertions assertions;
    std::optional<DeviationLimits> deviation;
};

void declare(Declare<EnsureOptions>& d) {
    declare_properties(d, &EnsureOptions::assertions, "ensure");
    d.group("deviation", &EnsureOptions::deviation,
            "The largest distance from the surface to the scene as loaded, in both directions. As a common "
            "key, ensure measures from the input of its stage.",
            declare_deviation);
}

Scene run(Scene scene, const EnsureOptions& o, Context& context) {
    if (!o.assertions.all.empty())
        for (auto& check : evaluate(resolved(o.assertions, scene, context),
                                    inspect(scene, o.assertions.settings()), context.name()))
            context.check(std::move(check));
    if (o.deviation) {
        const Mark& here = context.where();
        check_deviation(*o.deviation, {here, here, here}, surface_as_loaded(context), scene, context);
    }
    return scene;
}

struct EnsureStage : StageOf<run> {
    void verify(const Value& given, Problems& problems) const override {
        if (o.deviation) verify_deviation(*o.deviation, given.mark, problems);
        verify_any(!o.assertions.all.empty() || o.deviation, given, "ensure", problems);
    }
    bool compares_with_load() const override { return o.deviation.has_value(); }
};

const RegisterStage registered = make_stage<EnsureStage>(
    {.name = "ensure",
     .about = help::ensure::about,
     .details = help::ensure::details,
     .examples = {"ensure: {closed: true}", "ensure: {faces: {max: 5000}, components: 1}",
                  "ensure: {deviation: 0.5%}", "ensure: {unit: mm, bounds: {max: [20cm, 20cm, 5cm]}}"},
     .checks = true,
     .keeps_scene = true,
     .lines = LinesPolicy::work},
    declare);

} // namespace

} // namespace facetmill::ensure_stage
