#pragma once
// Runs a random scene through a random chain of stages and checks rules that always hold. The result is a
// sound scene, or an Error that is not a bug. Stages keep their promises of closedness, results do not
// depend on the number of threads, and files read back.

#include "base/hash.hpp"
#include "mesh/invariants.hpp"
#include "mesh/power_scale.hpp"
#include "parallel/parallel.hpp"
#include "support/measure.hpp"
#include "support/random_options.hpp"
#include "support/random_scene.hpp"
#include "support/temporary.hpp"

#include <cstring>
#include <set>

namespace facetmill::test {

struct Link {
    const StageInfo* stage;
    Value value;
};

/// A random test: the scene and the stages.
struct Chain {
    Scene scene;
    std::vector<Link> links;

    /// "clip: {plane: 'x=10%'} ! relax: {}"
    std::string described() const {
        std::string text;
        for (const auto& link : links)
            text += (text.empty() ? "" : " ! ") + link.stage->name + ": " + text_of(link.value);
        return text;
    }
};

/// One to three stages. `only` is the name of the first, unless empty.
inline Chain random_chain(Draw& draw, const std::string& only = {}) {
    std::vector<const StageInfo*> all;
    for (const auto& stage : stages())
        if (!stage.name.starts_with("test-")) all.push_back(&stage); // skip stages of other tests
    Chain chain{random_scene(draw), {}};
    for (std::size_t n = 1 + draw.below(3); n > 0; --n) {
        const StageInfo* stage =
            only.empty() || !chain.links.empty() ? draw.one_of(all) : &stage_for_test(only);
        if (auto value = random_options(draw, *stage)) chain.links.push_back({stage, std::move(*value)});
    }
    return chain;
}

/// A digest of all scene data that stages may change.
inline std::string digest(const Scene& scene) {
    std::string bytes;
    const auto add = [&](const auto& values) {
        const auto size = static_cast<std::uint64_t>(values.size());
        bytes.append(reinterpret_cast<const char*>(&size), sizeof size);
        using T = typename std::decay_t<decltype(values)>::value_type;
        bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    };
    for (const Part& part : scene.parts) {
        add(part.name);
        bytes.append(reinterpret_cast<const char*>(&part.transform), sizeof part.transform);
        add(part.mesh.positions);
        add(part.mesh.wedge_vertex);
        add(part.mesh.corners);
        add(part.mesh.face_offsets);
        for (const auto& a : part.mesh.attributes) {
            add(a.name);
            std::visit(add, a.data);
        }
        for (const auto& p : part.mesh.primitives) add(p.json + "|" + std::to_string(p.material));
    }
    for (const auto& m : scene.materials) add(m.name);
    for (const auto& d : scene.documents) add(d->json);
    return sha256(std::as_bytes(std::span(bytes)));
}

/// Files for `load` and other stages in the test's folder.
inline void put_files(const std::filesystem::path& folder) {
    for (const char* format : {"ply", "obj", "stl", "glb"}) {
        io::WriteSettings settings;
        settings.title = "in";
        const auto files =
            io::codec_named(format)->write(scene_of(with_uv_seams(shapes::icosphere(1))), settings).files;
        const auto& bytes = files.front().bytes;
        put(folder / ("in." + std::string(format)),
            {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    }
}

/// Whether the stage keeps edges of at most two faces manifold.
inline bool keeps_edge_manifold(const Link& link) {
    static const std::set<std::string> names{"orient", "relax", "simplify", "textures", "transform"};
    return names.contains(link.stage->name);
}

/// Whether the stage keeps closed parts closed.
inline bool keeps_closed(const Link& link) {
    static const std::set<std::string> names{"crumple",  "orient",    "relax",       "simplify", "split",
                                             "textures", "transform", "triangulate", "two-sided"};
    const std::string options = text_of(link.value);
    const auto has = [&](const char* word) { return options.find(word) != std::string::npos; };
    if (link.stage->name == "simplify" && (has("allow") || has("cluster") || has("constrained")))
        return false;
    return names.contains(link.stage->name);
}

/// Whether the stage returns its scene unchanged.
inline bool keeps_scene(const StageInfo& stage) {
    static const std::set<std::string> names{"probe", "render", "section", "write"};
    return stage.checks || names.contains(stage.name);
}

inline bool all_closed(const Scene& scene) {
    return std::all_of(scene.parts.begin(), scene.parts.end(), [](const Part& p) { return closed(p.mesh); });
}
inline bool all_edge_manifold(const Scene& scene) {
    return std::all_of(scene.parts.begin(), scene.parts.end(),
                       [](const Part& p) { return edge_manifold(p.mesh); });
}

/// The log of a chain, which must not depend on the number of threads, and the fault.
struct Outcome {
    std::string told, wrong;
    std::size_t stages_done = 0; ///< the next stage refused
    Scene scene;
};

/// The fault of the scene after a stage; empty if none.
inline std::string fault_after(const Link& link, const Scene& before, const Scene& after) {
    const auto broken = broken_invariants(after);
    if (!broken.empty()) return "invariant: " + broken.front();
    if (keeps_scene(*link.stage) && digest(before) != digest(after))
        return "the scene did not pass on unchanged";
    if (keeps_closed(link)) {
        if (all_closed(before) && !all_closed(after)) return "closed before, open after";
        if (keeps_edge_manifold(link) && all_edge_manifold(before) && !all_edge_manifold(after))
            return "edge-manifold before, not after";
    }
    return {};
}

inline bool is_finding(const Error& error) {
    if (error.kind() == ErrorKind::bug || error.kind() == ErrorKind::malformed) return true;
    return error.diagnostics().front().id == "E-READBACK";
}

/// Runs the chain in the folder. Ends at the first stage that refuses, or whose result is not finite.
inline Outcome run_chain(const Chain& chain, const std::filesystem::path& folder) {
    Outcome outcome;
    RunState state;
    state.places = {folder, folder};
    Scene scene = chain.scene;
    state.load_diagonal = diagonal(scene.bounds());
    for (const Link& link : chain.links) {
        report::StageRecord record;
        record.name = record.stage = link.stage->name;
        Problems problems;
        const auto use = use_of(*link.stage, link.value, problems);
        const Scene before = scene;
        try {
            const PartFilter all;
            Context context(state, record, all, scene.bounds(), {});
            scene = perform(*use, std::move(scene), context);
        } catch (const Error& error) {
            outcome.told += link.stage->name + ": " + error.what() + "\n";
            if (is_finding(error)) outcome.wrong = link.stage->name + ": " + error.what();
            return outcome;
        } catch (const std::exception& error) {
            outcome.wrong = link.stage->name + ": escaped: " + error.what();
            return outcome;
        }
        outcome.told += link.stage->name + ": " +
                        record.result.dump(-1, ' ', true, Json::error_handler_t::replace) + "\n";
        for (const auto& w : record.warnings) outcome.told += w.id + " " + w.message + "\n";
        if (not_finite(scene)) { // a run refuses it
            outcome.told += "not finite\n";
            return outcome;
        }
        outcome.wrong = fault_after(link, before, scene);
        if (!outcome.wrong.empty()) outcome.wrong = link.stage->name + ": " + outcome.wrong;
        if (!outcome.wrong.empty()) return outcome;
        ++outcome.stages_done;
        outcome.told += digest(scene) + "\n";
    }
    for (const auto& file : state.outputs.files())
        outcome.told += file->target.string() + " " + file->sha256 + "\n";
    outcome.scene = std::move(scene);
    return outcome;
}

/// Writes the scene in a format and reads it back. Returns the fault; empty if none.
inline std::string fault_of_file(const Scene& scene, const char* format) {
    if (scene.face_count() == 0) return {};
    try {
        Scene copy = scene;
        const auto options = Value::map({{"path", {}, Value::scalar(std::string("back.") + format)}});
        TemporaryDirectory folder;
        const Chain chain{std::move(copy), {{&stage_for_test("write"), options}}};
        const Outcome outcome = run_chain(chain, folder.path());
        return outcome.wrong;
    } catch (const Error& error) {
        return is_finding(error) ? error.what() : "";
    }
}

/// The fault of a random chain (empty if none), and the number of completed stages.
struct Verdict {
    std::string wrong;
    std::size_t stages_done = 0;
};

/// Runs the chain with one and with three threads, and writes its result to a file of the format.
inline Verdict judge(const Chain& chain, const std::filesystem::path& folder, const char* format) {
    set_threads(1);
    const Outcome one = run_chain(chain, folder);
    Verdict verdict{one.wrong, one.stages_done};
    if (verdict.wrong.empty()) verdict.wrong = fault_of_file(one.scene, format);
    set_threads(3);
    if (verdict.wrong.empty() && run_chain(chain, folder).told != one.told)
        verdict.wrong = "another result with three threads";
    set_threads(0);
    return verdict;
}

} // namespace facetmill::test
