#pragma once
// Inside planning: from items of `stages` to steps. plan.hpp is what others include.

#include "base/text/unique_names.hpp"
#include "pipeline/expressions.hpp"
#include "pipeline/plan.hpp"

namespace facetmill::pipeline {

/// The --set options: each changes every stage of its name.
class Overrides {
  public:
    Overrides(const PlanSettings& settings, Problems& problems);

    /// Changes the value of a stage that is known by these names. Bare values become maps first.
    void apply(const std::vector<std::string>& names, const StageInfo& stage, Value& given,
               Problems& problems);
    /// Complains of targets that no stage answered to, and of baselines to update that no stage has.
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

/// Where in the pipeline a list of stages stands.
struct Position {
    std::string path;   ///< "stages[5].branch.far"
    std::string prefix; ///< of the names of its steps: "far/"
};

class Planner {
  public:
    Planner(const PlanSettings& settings, Problems& problems)
        : settings_(settings), problems_(problems), overrides_(settings, problems) {}

    /// Plans a list of stages. has_scene: whether a stage before has loaded one; updated.
    Steps steps(const Value& list, const Scope& scope, const Position& position, bool& has_scene);
    /// Arms for all combinations of the values of a foreach. parts: the names that variable `part` runs over;
    /// none: it is unknown yet, and one arm stands for all.
    std::vector<Arm> foreach_arms(const Value& variables, const Value& body, const Scope& scope,
                                  const Position& position,
                                  const std::optional<std::vector<std::string>>& parts, bool has_scene);
    /// The files that were included, as a plan reads them.
    const std::vector<PlannedFile>& included() const { return included_; }
    void finish() const { overrides_.check_all_used(names_, problems_); }

  private:
    /// Counts one more step; false, after a problem (E-FOREACH), when there are too many.
    bool count_step(const Mark& where);
    /// Appends what the item at that position says.
    void step(const Value& item, const Scope& scope, const Position& position, bool& has_scene, Steps& steps);
    void plan_stage(Step& step, const Value::Entry& entry, const Scope& scope, bool& has_scene);
    void plan_branch(Step& step, const Value::Entry& entry, const Scope& scope, const Position& inner,
                     bool& has_scene);
    void plan_foreach(Step& step, const Value& item, const Value::Entry& entry, const Scope& scope,
                      const Position& inner, bool& has_scene);
    /// base: the key of the step's stage, which gives it its name unless the item does.
    void common_keys(Step& step, const Value& item, const Scope& scope, const std::string& base,
                     const Position& position);
    void name_step(Step& step, const Value* given, const Scope& scope, const std::string& base,
                   const Position& position);
    void read_only(const Value& only, const Scope& scope, PartFilter& filter);
    /// The stages of the file that an item includes.
    Steps include(const Value& item, const Value::Entry& entry, const Scope& scope, const Position& position,
                  bool& has_scene);
    /// From a file that is open, the pipeline among them, to the innermost; empty: it is not open.
    std::vector<std::filesystem::path> chain_to(const std::filesystem::path& file) const;
    /// Not, after a problem, when that would be without end, or through very many files.
    bool may_include(const std::filesystem::path& file, const Mark& where);
    /// The document in a file, its paths relative to the pipeline's folder; null after a problem. Throws
    /// missing.
    const Value* fragment(const std::filesystem::path& file, const Mark& where);
    std::string unique_name(const std::string& base, const std::string& prefix, const Mark& explicit_at);

    const PlanSettings& settings_;
    Problems& problems_;
    Overrides overrides_;
    std::size_t steps_ = 0; ///< planned so far: nested foreach multiply
    UniqueNames used_names_{'-'};
    std::set<std::string> names_;                      ///< by which --set may name the steps
    std::map<std::filesystem::path, Value> fragments_; ///< that were read
    std::vector<std::filesystem::path> open_;          ///< included, the innermost last
    std::vector<PlannedFile> included_;
};

/// The common key `when`: a truth, a comparison of expressions, or predicates on the scene.
Condition read_condition(const Value& value, const Scope& scope, Problems& problems);

/// Checks the format, `requires` and the keys of a file of stages.
void check_head(const Value& document, const std::vector<std::string>& keys, Problems& problems);

/// Whether the version satisfies a range like ">=0.3,<2"; none when the range cannot be read.
std::optional<bool> satisfies(const std::string& version, const std::string& range);

} // namespace facetmill::pipeline
