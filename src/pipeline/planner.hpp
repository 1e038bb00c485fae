#pragma once
// The planner's internals: from items of `stages` to steps. Other code includes plan.hpp.

#include "base/text/unique_names.hpp"
#include "pipeline/expressions.hpp"
#include "pipeline/plan.hpp"

namespace facetmill::pipeline {

/// The --set options: each changes all stages with its name.
class Overrides {
  public:
    Overrides(const PlanSettings& settings, Problems& problems);

    /// Changes the value of a stage with one of these names. A short-form value becomes a map first.
    void apply(const std::vector<std::string>& names, const StageInfo& stage, Value& given,
               Problems& problems);
    /// Reports targets without a stage, and --update-baseline without a stage with a baseline.
    void check_all_used(const std::set<std::string>& names, Problems& problems) const;

  private:
    struct Override {
        std::string target;
        std::vector<std::string> path; ///< option, nested option ...
        Value value;
        Mark where;
        bool used = false;
    };
    std::vector<Override> all_;
    bool update_baselines_, any_baseline_ = false;
};

/// The position of a list of stages in the pipeline.
struct Position {
    std::string path;   ///< "stages[5].branch.far"
    std::string prefix; ///< prefix of its steps' names: "far/"
};

class Planner {
  public:
    Planner(const PlanSettings& settings, Problems& problems)
        : settings_(settings), problems_(problems), overrides_(settings, problems) {}

    /// Plans a list of stages. has_scene: an earlier stage has loaded a scene; updated.
    Steps steps(const Value& list, const Scope& scope, const Position& position, bool& has_scene);
    /// Arms for all combinations of the values of a foreach. parts: the values of variable `part`; empty:
    /// still unknown, and one arm represents all.
    std::vector<Arm> foreach_arms(const Value& variables, const Value& body, const Scope& scope,
                                  const Position& position,
                                  const std::optional<std::vector<std::string>>& parts, bool has_scene);
    /// The included files, as inputs of the plan.
    const std::vector<PlannedFile>& included() const { return included_; }
    void finish() const { overrides_.check_all_used(names_, problems_); }

  private:
    /// Counts a step; returns false, after a problem (E-FOREACH), if there are too many.
    bool count_step(const Mark& where);
    /// Appends the steps of the item at that position.
    void step(const Value& item, const Scope& scope, const Position& position, bool& has_scene, Steps& steps);
    void plan_stage(Step& step, const Value::Entry& entry, const Scope& scope, bool& has_scene);
    void plan_branch(Step& step, const Value::Entry& entry, const Scope& scope, const Position& inner,
                     bool& has_scene);
    void plan_foreach(Step& step, const Value& item, const Value::Entry& entry, const Scope& scope,
                      const Position& inner, bool& has_scene);
    /// base: the key of the step's stage, which is the step's name unless the item sets a name.
    void common_keys(Step& step, const Value& item, const Scope& scope, const std::string& base,
                     const Position& position);
    void name_step(Step& step, const Value* given, const Scope& scope, const std::string& base,
                   const Position& position);
    void read_only(const Value& only, const Scope& scope, PartFilter& filter);
    /// The stages of an included file.
    Steps include(const Value& item, const Value::Entry& entry, const Scope& scope, const Position& position,
                  bool& has_scene);
    /// The chain from an open file (the pipeline or an include) to the innermost; empty if it is not open.
    std::vector<std::filesystem::path> chain_to(const std::filesystem::path& file) const;
    /// Returns false, after a problem, if including would be recursive, or nested too deeply.
    bool may_include(const std::filesystem::path& file, const Mark& where);
    /// The document in a file, with paths relative to the pipeline's folder, or the text of a built-in
    /// pipeline; null after a problem. Throws a missing-file error.
    const Value* fragment(const std::filesystem::path& file, const Mark& where, std::string_view built_in);
    std::shared_ptr<const SourceText> text_of(const std::filesystem::path& file, const Mark& where);
    std::string unique_name(const std::string& base, const std::string& prefix, const Mark& explicit_at);

    const PlanSettings& settings_;
    Problems& problems_;
    Overrides overrides_;
    std::size_t steps_ = 0; ///< number of steps planned so far; nested foreach multiply
    UniqueNames used_names_{'-'};
    std::set<std::string> names_;                      ///< names of steps that --set may use
    std::map<std::filesystem::path, Value> fragments_; ///< files already read
    std::vector<std::filesystem::path> open_;          ///< files being included, the innermost last
    std::vector<PlannedFile> included_;
};

/// The common key `when`: a truth value, a comparison of expressions, or predicates on the scene.
[[nodiscard]] Condition read_condition(const Value& value, const Scope& scope, Problems& problems);

/// Checks the format, `requires` and the keys of a file of stages.
void check_head(const Value& document, const std::vector<std::string>& keys, Problems& problems);

/// True if the version satisfies a range such as ">=0.3,<2"; none for an invalid range.
[[nodiscard]] std::optional<bool> satisfies(const std::string& version, const std::string& range);

} // namespace facetmill::pipeline
