#include "stages/validate/judge.hpp"

#include "base/progress.hpp"
#include "base/text/words.hpp"
#include "geometry/clean/clean.hpp"
#include "geometry/edit/surgery.hpp"
#include "io/codec.hpp"
#include "mesh/topology.hpp"
#include "stage/context.hpp"
#include "stage/read_written.hpp"
#include "stages/validate/check_evidence.hpp"
#include "stages/validate/failed_copy.hpp"
#include "stages/validate/known_failures.hpp"

#include <fmt/format.h>
#include <span>
#include <utility>

namespace facetmill::validate_stage {

namespace {

/// Calls body with a scene of the parts with these indices. Parts are moved in and out, not copied.
template <class Body>
void with_parts(Scene& scene, std::span<const std::size_t> indices, Body&& body) {
    Scene chosen{{}, scene.materials, scene.unit, scene.up, {}};
    for (const std::size_t i : indices) chosen.parts.push_back(std::move(scene.parts[i]));
    body(chosen);
    for (std::size_t k = 0; k < indices.size(); ++k) scene.parts[indices[k]] = std::move(chosen.parts[k]);
}

/// The approximate time to judge each part, relative to the others.
std::vector<double> lengths_of(const Scene& scene, const std::vector<std::size_t>& parts) {
    std::vector<double> lengths;
    lengths.reserve(parts.size());
    for (const std::size_t i : parts)
        lengths.push_back(1 + static_cast<double>(scene.parts[i].mesh.face_count()));
    return lengths;
}

class Judge {
  public:
    Judge(JudgeSettings settings, Context& context) : s_(std::move(settings)), context_(context) {
        if (s_.baseline && !s_.update_baseline) known_ = KnownFailures::read(*s_.baseline);
    }

    ValidateReport run(Scene& scene) {
        s_.assertions = resolved(std::move(s_.assertions), scene, context_);
        const SceneTrail& trail = context_.trail();
        require_written(s_.limits, context_);
        std::vector<std::string> judged, not_judged;
        for (const WrittenScene& file : trail.written) {
            const bool holds_it = file.scene == trail.scene && judge_file(file, scene);
            (holds_it ? judged : not_judged).push_back(file.path);
            if (file.scene != trail.scene) judge_limits_of(file, scene);
        }
        file_.clear();
        if (judged.empty()) judge_scene(scene);
        if (s_.assertions.all.empty()) not_judged.clear();
        if (!judged.empty())
            context_.say(fmt::format("checked the written file, read back: {}", join_texts(judged)));
        else if (!not_judged.empty())
            context_.say(fmt::format("checked the scene in memory, not {}", join_texts(not_judged)));
        finish();
        report_.fails = any_;
        return report_;
    }

  private:
    std::vector<std::size_t> selected_of(const Scene& scene) const {
        std::vector<std::size_t> selected;
        for (std::size_t i = 0; i < scene.parts.size(); ++i)
            if (context_.selects(scene.parts[i], scene)) selected.push_back(i);
        return selected;
    }

    /// Judges a file of the current scene. Returns false if the file does not hold all that is to be judged.
    bool judge_file(const WrittenScene& file, const Scene& scene) {
        if (io::codec_named(file.format)->can.honours("tiles")) { // levels of detail repeat the surface
            judge_limits_of(file, scene);
            return false;
        }
        Scene there = read_written(file, scene, context_);
        file_ = file.path;
        take_limits(LimitsOf::file, {there, records_of(file)});
        const std::size_t wanted = selected_of(scene).size(), found = selected_of(there).size();
        if (found == 0 && wanted > 0) return false; // the file does not keep the names that `only` gives
        judge_scene(there);
        return file.is_whole && (wanted == scene.parts.size() || wanted == found);
    }

    void judge_limits_of(const WrittenScene& file, const Scene& scene) {
        if (s_.limits.of_files().empty()) return;
        const Scene there = s_.limits.need_contents() ? read_written(file, scene, context_) : Scene{};
        file_ = file.path;
        take_limits(LimitsOf::file, {there, records_of(file)});
    }

    std::span<const report::FileRecord> records_of(const WrittenScene& file) const {
        return std::span(context_.output_records()).subspan(file.first_record, file.records);
    }

    void take_limits(LimitsOf of, const Limited& limited) {
        for (auto& limit : check_limits(s_.limits, of, limited)) {
            limit.check.file = file_;
            Failure failure = failure_of(limit.check, {}, std::move(limit.keys));
            const auto verdict = known_.judge(failure);
            take(std::move(limit.check), std::move(failure), verdict);
        }
    }

    void judge_scene(Scene& scene) {
        const std::vector<std::size_t> selected = selected_of(scene);
        flags_.clear();
        for (const Part& part : scene.parts) flags_.emplace_back(part.mesh.face_count(), 0);
        flagged_ = false;
        take_limits(LimitsOf::scene, {scene});
        if (s_.per == Per::scene) {
            const ProgressScope all_of_it(0, 1);
            with_parts(scene, selected, [&](const Scene& all) {
                judge(all, {"", "", "", selected, nullptr});
            });
        }
        ProgressSteps steps(lengths_of(scene, selected));
        if (s_.per == Per::part)
            for (const std::size_t i : selected) {
                with_parts(scene, {&i, 1}, [&](const Scene& one) {
                    const std::string& name = one.parts[0].name;
                    judge(one, {name, name, "", {&i, 1}, nullptr});
                });
                steps.next();
            }
        if (s_.per == Per::component)
            for (const std::size_t i : selected) {
                judge_components(scene, i);
                steps.next();
            }
        if (s_.mark && flagged_ && !std::exchange(marked_, true)) write_failed_copy(scene, flags_, *s_.mark);
    }

    /// The subject of a check, and the numbers of its parts and faces in the scene.
    struct Subject {
        std::string name;            ///< the displayed name; components are numbered
        std::string part, component; ///< the stable identity, independent of numbers
        std::span<const std::size_t> parts;
        const std::vector<Index>* faces; ///< the faces of a component of the only part; null: all faces
        bool shared = false; ///< true for an outer component or a cavity of a solid with several components
    };

    Properties properties_of(const Scene& scene, const Subject& subject) const {
        InspectSettings settings = s_.assertions.settings();
        settings.part_of_solid = subject.shared;
        return inspect(scene, settings);
    }

    void judge(const Scene& scene, const Subject& subject) {
        ProgressSteps steps({3, 1});
        auto checks = evaluate(s_.assertions, properties_of(scene, subject), context_.name());
        steps.next();
        for (std::size_t i = 0; i < checks.size(); ++i) {
            report::Check& check = checks[i];
            const Assertion& assertion = s_.assertions.all[i];
            check.part = subject.name;
            check.file = file_;
            if (check.passed) {
                take(std::move(check), {}, {});
                continue;
            }
            Failure failure = failure_of(
                check, subject, s_.baseline ? location_keys(scene, assertion) : std::vector<std::uint64_t>{});
            const auto verdict = known_.judge(failure);
            // If some locations are already known, new locations come first.
            const bool some = verdict.known && !verdict.keys.empty();
            Findings found = some ? Findings{evidence_among(scene, assertion, verdict.keys),
                                             count_locations(scene, assertion)}
                                  : findings_against(scene, assertion);
            check.evidence = std::move(found.evidence);
            check.locations = found.locations;
            if (subject.faces) renumber(*check.evidence, *subject.faces);
            if (!take(std::move(check), std::move(failure), verdict) && s_.mark)
                flag(scene, subject, assertion);
        }
    }

    static Failure failure_of(const report::Check& check, const Subject& subject,
                              std::vector<std::uint64_t> keys) {
        return {.check = check.name,
                .part = subject.part,
                .component = subject.component,
                .expected = check.expected,
                .found = check.found,
                .min = check.min,
                .max = check.max,
                .keys = std::move(keys)};
    }

    static void renumber(report::CheckEvidence& evidence, const std::vector<Index>& faces) {
        for (auto& entry : evidence)
            for (auto* face : {&entry.face, &entry.with})
                if (*face) *face = faces[**face];
    }

    void flag(const Scene& scene, const Subject& subject, const Assertion& assertion) {
        for (std::size_t k = 0; k < scene.parts.size(); ++k) {
            std::vector<std::uint32_t> flags(scene.parts[k].mesh.face_count(), 0);
            flag_faces_against(scene.parts[k], assertion, flags);
            for (std::size_t f = 0; f < flags.size(); ++f)
                flags_[subject.parts[k]][subject.faces ? (*subject.faces)[f] : f] |= flags[f];
        }
    }

    void judge_components(const Scene& scene, std::size_t index) {
        const Part& part = scene.parts[index];
        const Components components = face_components(part.mesh, false);
        const Components solids = solid_components(part.mesh);
        std::vector<std::vector<Index>> faces(components.count);
        for (Index f = 0; f < part.mesh.face_count(); ++f) faces[components.of_face[f]].push_back(f);
        std::vector<std::size_t> of_solid(solids.count, 0);
        for (const auto& component : faces) ++of_solid[solids.of_face[component[0]]];
        const auto keys = keys_of_components(part.mesh, components.of_face, components.count);
        std::size_t number = 0;
        for (Mesh& mesh : separated(part.mesh, components.of_face, components.count)) {
            const auto count = static_cast<double>(components.count), before = static_cast<double>(number);
            const ProgressScope share(before / count, (before + 1) / count);
            Scene one{{}, scene.materials, scene.unit, scene.up, {}};
            one.parts.emplace_back().name = part.name;
            one.parts[0].mesh = std::move(mesh);
            one.parts[0].transform = part.transform;
            judge(one, {fmt::format("{}.{}", part.name, number),
                        part.name,
                        fmt::format("{:016x}", keys[number]),
                        {&index, 1},
                        &faces[number],
                        of_solid[solids.of_face[faces[number][0]]] > 1});
            ++number;
        }
    }

    /// Returns whether the check passes or its failure is known.
    bool take(report::Check check, Failure failure, const KnownFailures::Verdict& verdict) {
        check.severity = s_.severity;
        if (!check.passed) {
            if (known_.size() > 0 && failure.locations() > 0) check.fresh = verdict.fresh;
            check.waived = s_.update_baseline || verdict.waived;
            check.passed = check.waived;
            waived_ += check.waived;
            waived_locations_ += failure.locations() - (s_.update_baseline ? 0 : verdict.fresh);
            any_known_ = any_known_ || verdict.known;
            any_ = any_ || !check.passed;
            flagged_ = flagged_ || !check.passed;
            failed_.add(std::move(failure));
        }
        const bool passed = check.passed;
        context_.check(std::move(check));
        return passed;
    }

    void finish() {
        if (s_.update_baseline) failed_.write(context_.outputs(), *s_.baseline);
        if (s_.baseline) tell_of_baseline();
    }

    void tell_of_baseline() {
        const auto gone = known_.gone(failed_);
        report_ = {waived_, waived_locations_, gone.failures, gone.locations};
        if (known_.size() > 0 && any_ && !any_known_)
            context_.warn("W-BASELINE",
                          fmt::format("none of the failures in '{}' occurs here, but others do",
                                      s_.baseline->generic_string()),
                          "check that the baseline belongs to this mesh and these parts");
    }

    JudgeSettings s_;
    Context& context_;
    KnownFailures known_, failed_;
    ValidateReport report_;
    std::size_t waived_ = 0, waived_locations_ = 0;
    std::string file_;                              ///< the judged file; empty: the scene
    bool any_ = false;                              ///< a failure was not waived
    bool flagged_ = false;                          ///< a failure of the judged scene was not waived
    bool marked_ = false;                           ///< the copy is written
    bool any_known_ = false;                        ///< a failure was already known
    std::vector<std::vector<std::uint32_t>> flags_; ///< flags of the parts' faces
};

} // namespace

ValidateReport judge(Scene& scene, JudgeSettings settings, Context& context) {
    return Judge(std::move(settings), context).run(scene);
}

} // namespace facetmill::validate_stage
