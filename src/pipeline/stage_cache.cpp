#include "pipeline/stage_cache.hpp"

#include "base/hash.hpp"
#include "base/math/numbers.hpp"
#include "base/stopwatch.hpp"
#include "base/text/glob.hpp"
#include "mesh/invariants.hpp"
#include "mesh/power_scale.hpp"
#include "parallel/memory.hpp"
#include "platform/build_id.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::pipeline {

namespace fs = std::filesystem;

namespace {

/// Storing may use this share of the time that it saves.
constexpr double share_for_storing = 0.1;

/// Appends everything in a value that parsing or reports may use, including spellings, but no marks.
void spell(const Value& value, std::vector<std::string>& out) {
    out.push_back(fmt::format("{}{}{} {} {}", static_cast<int>(value.kind), value.quoted ? "q" : "",
                              value.deferred ? "d" : "", value.items.size(), value.entries.size()));
    out.push_back(value.text);
    for (const auto& item : value.items) spell(item, out);
    for (const auto& entry : value.entries) {
        out.push_back(entry.key);
        spell(entry.value, out);
    }
}

/// The options as a map sorted by name, in any input form, with defaults added.
Value as_map(const Step& step) {
    Value map = step.given;
    const Option* primary = step.info->options->primary();
    if (!map.is_map() && !map.is_null() && primary && !step.info->options->shorthand)
        map = Value::map({{primary->name, {}, map}});
    if (map.is_map() || map.is_null())
        for (const auto& [name, text] : default_texts(step))
            if (!map.find(name)) map.set(name, Value::scalar(text));
    std::sort(map.entries.begin(), map.entries.end(),
              [](const Value::Entry& a, const Value::Entry& b) { return a.key < b.key; });
    return map;
}

std::vector<fs::path> files_to_load(const Step& step, const Folders& places) {
    std::vector<fs::path> files;
    for (const auto& input : step.stage->files().inputs) {
        const auto matches = expand_glob(places.input(input.text));
        files.insert(files.end(), matches.begin(), matches.end());
    }
    return files;
}

/// True if the stage names files, except files that it loads.
bool names_files(const Step& step) {
    const StageFiles named = step.stage->files();
    const auto is_named = [](const PathText& path) { return !path.text.empty(); };
    return std::any_of(named.inputs.begin(), named.inputs.end(), is_named) ||
           std::any_of(named.outputs.begin(), named.outputs.end(), is_named) || named.materials ||
           named.images;
}

bool are_files(const std::vector<fs::path>& all) {
    return std::all_of(all.begin(), all.end(), [](const fs::path& path) {
        std::error_code ignored;
        return path != "-" && fs::is_regular_file(path, ignored);
    });
}

bool is_unchanged(const report::FileRecord& file) {
    std::error_code error;
    if (!fs::is_regular_file(file.path, error) || fs::file_size(file.path, error) != file.bytes) return false;
    try {
        return sha256(io::Input::open(file.path).stored()) == file.sha256;
    } catch (const Error&) {
        return false;
    }
}

bool are_unchanged(const cache::Memory& memory) {
    std::error_code ignored;
    return std::all_of(memory.inputs.begin(), memory.inputs.end(), is_unchanged) &&
           std::none_of(memory.absent.begin(), memory.absent.end(),
                        [&](const std::string& path) { return fs::exists(path, ignored); });
}

/// Storing needs a copy of the scene. It must be a small part of the available memory, so that caching never
/// makes a run fail.
bool has_memory_for(std::size_t bytes) {
    constexpr std::uint64_t parts = 4;
    const auto there = available_memory();
    return !there || bytes <= *there / parts;
}

bool same_mark(const Mark& a, const Mark& b) {
    return a.source == b.source && a.line == b.line && a.column == b.column && a.length == b.length;
}

/// The entries that the stage added to a list of the run.
template <class T>
std::vector<T> since(const std::vector<T>& all, std::size_t first) {
    return {all.begin() + static_cast<std::ptrdiff_t>(std::min(first, all.size())), all.end()};
}

} // namespace

std::string key_after(const std::string& key, const Step& step) {
    std::vector<std::string> texts{code_id(), key, step.info->name};
    spell(as_map(step), texts);
    return cache::key_of(texts);
}

bool StageCache::may_recall(const Step& step) const {
    if (step.info->checks) return false;
    if (step.info->loads) return !loads_run_ && are_files(files_to_load(step, places_));
    return !names_files(step);
}

/// The key of a scene that was not made by a stage with a key is its digest. It is computed on demand,
/// because a scene that is only loaded and written needs none.
void StageCache::know_key(SceneState& flow) {
    if (!flow.key.empty()) return;
    flow.key = cache::digest_of(flow.scene);
    if (!flow.loaded) return;
    auto& [name, memory] = *flow.loaded;
    memory.scene = flow.key;
    flow.memories.emplace_back(name, cache::encoded(memory));
    flow.loaded.reset();
}

void StageCache::before_arms(SceneState& flow, const std::vector<Arm>& arms) const {
    const auto asks = [&](const Arm& arm) {
        const Steps& steps = *arm.steps;
        return !steps.empty() && steps.front().stage && may_recall(steps.front());
    };
    if (store_ && flow.is_here() && !flow.without_cache && std::any_of(arms.begin(), arms.end(), asks))
        know_key(flow);
}

/// The flow's key must be known.
std::string StageCache::key_of(const Step& step, const SceneState& flow, double load_diagonal) const {
    std::vector<std::string> texts{code_id(), flow.key, step.info->name, to_string(load_diagonal)};
    spell(as_map(step), texts);
    texts.push_back(std::to_string(step.only.patterns.size()));
    texts.insert(texts.end(), step.only.patterns.begin(), step.only.patterns.end());
    if (step.info->loads)
        for (const auto& file : files_to_load(step, places_)) texts.push_back(file.generic_string());
    if (step.info->loads)
        for (const auto& folder : asset_roots_of({step}, places_))
            texts.push_back("asset_root " + fs::absolute(folder).lexically_normal().generic_string());
    return cache::key_of(texts);
}

bool StageCache::recall(const Step& step, SceneState& flow, RunState& run, report::StageRecord& stage) {
    if (!store_ || flow.without_cache || !may_recall(step)) return false;
    trace_.back().way = TracedStep::Way::ran;
    try {
        return recall_known(step, flow, run, stage);
    } catch (const std::bad_alloc&) { // the stage may need less
        return false;
    } catch (const Error&) { // a file that the stage reports when it runs
        return false;
    }
}

bool StageCache::recall_known(const Step& step, SceneState& flow, RunState& run, report::StageRecord& stage) {
    const double load_diagonal = run.load_diagonal;
    know_key(flow);
    trace_.back().before = flow.key;
    const std::string key = trace_.back().key = key_of(step, flow, load_diagonal);
    const auto bytes = store_->get(key, cache::Kind::memory);
    if (!bytes) return false;
    auto memory = cache::decoded_memory(*bytes);
    if (!memory) store_->reject(key, cache::Kind::memory);
    if (!memory || !are_unchanged(*memory)) return false;
    if (!memory->told_name.empty() && memory->told_name != step.name) return false;
    trace_.back().way = TracedStep::Way::recalled;
    for (const auto& input : memory->inputs) {
        trace_.back().inputs.emplace_back(input.path, input.sha256);
        run.outputs.protect(input.path, input.sha256);
        run.record.inputs.push_back(input);
    }
    run.record.absent.insert(run.record.absent.end(), memory->absent.begin(), memory->absent.end());
    std::swap(stage, memory->record);
    stage.name = std::move(memory->record.name);
    stage.stage = std::move(memory->record.stage);
    stage.path = std::move(memory->record.path);
    stage.options = std::move(memory->record.options);
    for (auto& warning : stage.warnings) warning.where = step.where;
    memory->record = {};
    flow.key = memory->scene;
    if (step.info->loads) run.load_diagonal = diagonal(memory->bounds);
    store_->has(flow.key, cache::Kind::scene); // marks it as used, so that it stays in the store
    flow.recalled.push_back({&step, trace_.size() - 1, load_diagonal, std::move(*memory)});
    return true;
}

StageCache::Before StageCache::before(const Step& step, const SceneState& flow, const RunState& run) const {
    Before before;
    if (store_ && !flow.without_cache && may_recall(step) && !trace_.empty()) before.key = trace_.back().key;
    before.inputs = run.record.inputs.size();
    before.absent = run.record.absent.size();
    before.outputs = run.record.outputs.size();
    before.staged = run.outputs.files().size();
    before.checks = run.record.checks.size();
    before.warnings = run.record.warnings.size();
    before.unrepeatable = run.unrepeatable;
    before.load_diagonal = run.load_diagonal;
    return before;
}

void StageCache::keep(const Step& step, SceneState& flow, const RunState& run,
                      const report::StageRecord& stage, const Before& before, std::optional<Box>& drawn) {
    if (!store_) return;
    know_documents(flow.scene);
    for (const auto& input : since(run.record.inputs, before.inputs))
        trace_.back().inputs.emplace_back(input.path, input.sha256);
    const bool loads = step.info->loads;
    const bool reads = run.record.inputs.size() != before.inputs ||
                       run.record.absent.size() != before.absent || run.load_diagonal != before.load_diagonal;
    const bool does_more =
        run.record.outputs.size() != before.outputs || run.outputs.files().size() != before.staged ||
        run.record.checks.size() != before.checks || run.record.warnings.size() != before.warnings ||
        run.unrepeatable != before.unrepeatable || (reads && !loads);
    const bool at_step = std::all_of(stage.warnings.begin(), stage.warnings.end(),
                                     [&](const Diagnostic& d) { return same_mark(d.where, step.where); });
    if (before.key.empty() || does_more || !at_step) return flow.replaced();
    try {
        keep_known(step, flow, run, stage, before, drawn);
    } catch (const std::bad_alloc&) { // the scene itself is there
        flow.replaced();
    }
}

void StageCache::keep_known(const Step& step, SceneState& flow, const RunState& run,
                            const report::StageRecord& stage, const Before& before,
                            std::optional<Box>& drawn) {
    flow.key = step.info->loads ? "" : before.key;
    flow.unsaved += stage.seconds;
    cache::Memory memory;
    memory.inputs = since(run.record.inputs, before.inputs);
    memory.absent = since(run.record.absent, before.absent);
    memory.scene = flow.key;
    const bool tells_name =
        std::any_of(stage.warnings.begin(), stage.warnings.end(), [&](const Diagnostic& warning) {
            return warning.message.find(step.name) != std::string::npos;
        });
    if (tells_name) memory.told_name = step.name;
    if (!drawn) drawn = io::drawn_bounds(flow.scene);
    memory.bounds = *drawn;
    if (step.info->loads) {
        memory.record = stage;
        flow.loaded = {before.key, std::move(memory)};
    } else {
        flow.memories.emplace_back(before.key, cache::encoded(memory, stage));
    }
    store_scene(flow);
}

void StageCache::store_scene(SceneState& flow) {
    std::size_t bytes = cache::size_of(flow.scene);
    double seconds = store_->seconds_to_begin() + store_->seconds_for(bytes);
    for (const auto& [name, memory] : flow.memories) seconds += store_->seconds_for(memory.size());
    if (!store_->is_usable()) return;
    if (seconds > share_for_storing * flow.unsaved && !store_->settings().everything) return;
    if (!has_memory_for(bytes)) return;
    const Stopwatch watch;
    know_key(flow);
    if (!store_->has(flow.key, cache::Kind::scene)) {
        if (!store_->put(flow.key, cache::Kind::scene, cache::encoded(flow.scene))) return;
        store_->took(bytes, watch.seconds());
    }
    for (const auto& [name, memory] : flow.memories) store_->put(name, cache::Kind::memory, memory);
    flow.spend(watch.seconds() / share_for_storing);
    flow.begin_anew();
}

/// None if memory is insufficient for both the bytes and the scene; running the stages may need less.
std::optional<Scene> StageCache::stored_scene(const std::string& key) {
    try {
        const auto bytes = store_->get(key, cache::Kind::scene);
        if (!bytes) return {};
        auto scene = cache::decoded_scene(*bytes);
        if (scene && broken_invariants(*scene).empty()) return scene;
        store_->reject(key, cache::Kind::scene);
    } catch (const std::bad_alloc&) {
    }
    return {};
}

void StageCache::fetch(SceneState& flow) {
    if (flow.is_here()) return;
    flow.left.reset();
    std::size_t first = flow.recalled.size();
    for (; first > flow.inherited; --first) {
        const std::string& key = flow.recalled[first - 1].memory.scene;
        auto scene = stored_scene(key);
        if (!scene) continue;
        flow.scene = std::move(*scene);
        share_documents(flow.scene);
        break;
    }
    if (flow.origin && first == flow.inherited) {
        fetch(*flow.origin);
        flow.scene = flow.origin->scene;
    }
    const bool again = first < flow.recalled.size();
    run_again(flow, first);
    flow.recalled.clear();
    flow.origin = nullptr;
    flow.inherited = 0;
    if (!again) return;
    try {
        store_scene(flow);
    } catch (const std::bad_alloc&) { // the scene itself is there
    }
}

void StageCache::know_documents(const Scene& scene) {
    for (const auto& document : scene.documents)
        if (std::find(documents_.begin(), documents_.end(), document) == documents_.end())
            documents_.push_back(document);
}

/// Keeps known documents once, with their decoded images. Different documents of the same scene stay
/// separate.
void StageCache::share_documents(Scene& scene) {
    const auto same = [](const Document& a, const Document& b) {
        return a.name == b.name && a.json == b.json && a.files == b.files && a.buffers == b.buffers;
    };
    std::vector<std::shared_ptr<const Document>> free = documents_;
    for (auto& document : scene.documents) {
        const auto known = std::find_if(free.begin(), free.end(),
                                        [&](const auto& other) { return same(*other, *document); });
        if (known == free.end()) continue;
        document = *known;
        free.erase(known);
    }
    know_documents(scene);
}

void StageCache::run_again(SceneState& flow, std::size_t first) {
    for (std::size_t i = first; i < flow.recalled.size(); ++i) {
        const Recalled& recalled = flow.recalled[i];
        const Step& step = *recalled.step;
        trace_[recalled.trace].way = TracedStep::Way::again;
        const Stopwatch watch;
        RunState run; // its output was already reported
        run.places = places_;
        run.load_diagonal = recalled.load_diagonal;
        report::StageRecord record;
        record.name = step.name;
        record.stage = step.info->name;
        Context context(run, record, step.only, io::drawn_bounds(flow.scene), step.where);
        flow.scene = perform(*step.stage, std::move(flow.scene), context);
        const auto same = [](const report::FileRecord& a, const report::FileRecord& b) {
            return a.path == b.path && a.sha256 == b.sha256;
        };
        if (!std::equal(run.record.inputs.begin(), run.record.inputs.end(), recalled.memory.inputs.begin(),
                        recalled.memory.inputs.end(), same))
            throw Error(ErrorKind::malformed, "E-CHANGED", "an input has changed while the pipeline ran",
                        "run it again", step.where);
        flow.unsaved += watch.seconds();
    }
    know_documents(flow.scene);
}

} // namespace facetmill::pipeline
