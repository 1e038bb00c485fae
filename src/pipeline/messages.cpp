#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages pipeline_messages{
    {"E-CHECK", "A check of `validate` or `ensure` failed.",
     "Compare the expected and the found value in the message. `clean` repairs many faults, and `severity: "
     "warn` makes the failure a warning.",
     ErrorKind::check},
    {"E-DUPLICATE", "A map contains the same key twice.",
     "Keep one of them. The message gives the position of the first.", ErrorKind::usage},
    {"E-DUPLICATE-INPUT", "Two inputs read standard input.", "Give one of them as a file.", ErrorKind::usage},
    {"E-EXPANSION",
     "A pipeline has too many values after its aliases are expanded, or it is nested too deeply.",
     "Use fewer aliases, or use a `foreach`.", ErrorKind::usage},
    {"E-EXPORT",
     "A run cannot be exported to a workflow. None of its outputs is known in advance, the engine cannot "
     "represent a file name, or `--keep-cells` has no work to divide.",
     "Add a report to the pipeline, as in `report: \"${input.stem}.json\"`. Otherwise rename the file, or "
     "use `facetmill batch`.",
     ErrorKind::usage},
    {"E-EXPRESSION", "An expression `${...}` cannot be parsed, or its variable has no such property.",
     "Write `${name}` or `${name.property}`. Write `$${` for a literal `${`.", ErrorKind::usage},
    {"E-FOREACH", "A `foreach` has no list of values, or its lists have too many combinations.",
     "Give lists with fewer values, as in `foreach: {lod: [50%, 25%]}`.", ErrorKind::usage},
    {"E-FORMAT-VERSION", "The pipeline does not declare format 1.", "Begin it with `facetmill: 1`.",
     ErrorKind::usage},
    {"E-INCLUDE",
     "A file includes itself, directly or through other files, or the includes are nested too deeply.",
     "Remove the `include` from one of the files that the message names.", ErrorKind::usage},
    {"E-INVARIANT",
     "A stage produced a mesh that breaks an invariant. Only a hidden option enables this check.",
     "Report this bug with the pipeline and the input.", ErrorKind::bug},
    {"E-LIMITS",
     "`validate: {limits: ...}` limits the bytes, draw calls or pixels of written files, and no `write` "
     "comes "
     "before it.",
     "Put `write` before `validate`. If the check fails, the file does not appear. If `write` has a "
     "condition, give "
     "`validate` the same.",
     {ErrorKind::usage, ErrorKind::stage}},
    {"E-NAME", "A name is already in use, or contains characters that are not allowed.",
     "Choose a unique name without `. / [ ]`.", ErrorKind::usage},
    {"E-ORDER", "A stage needs a scene, but no earlier stage loads one.", "Begin with `load` or `generate`.",
     ErrorKind::usage},
    {"E-PARAM", "A param is not declared, has no value, or has an invalid declaration.",
     "Set it with `-D name=value`. Run `facetmill plan PIPELINE` to list the params with their values.",
     ErrorKind::usage},
    {"E-REQUIRES", "The pipeline requires another release of facetmill.",
     "Install a release that its key `requires` allows.", ErrorKind::usage},
    {"E-SAVE", "The one-liner cannot be saved, because its inputs are known only at run time.",
     "Save the pipeline in the working directory.", ErrorKind::usage},
    {"E-SET", "`--set` does not match a stage of the pipeline, or cannot change this value.",
     "Run `facetmill plan` to list the stages by name.", ErrorKind::usage},
    {"E-STAGE", "No stage has this name, or an item of the pipeline has no stage or several stages.",
     "Run `facetmill stages` to list the stages. Give each item of a pipeline exactly one stage.",
     ErrorKind::usage},
    {"E-STRICT",
     "A warning counts as an error because of `--strict`, or the id given to `--strict` is unknown.",
     "Check the warning. Run `facetmill explain` to list the ids.",
     {ErrorKind::usage, ErrorKind::check}},
    {"E-UNQUOTED", "An expression inside `{}` or `[]` is not quoted.", "Write it in quotes: `\"${x}\"`.",
     ErrorKind::usage},
    {"E-VARIABLE", "No variable has this name.",
     "Declare it under `params`, or use it inside the `foreach` that defines it.", ErrorKind::usage},
    {"E-WHEN", "A condition cannot be parsed, or compares values that cannot be compared.",
     "Write for example `when: \"${flag}\"`, `when: ${quality} == high` or `when: {closed: false}`.",
     ErrorKind::usage},
    {"E-YAML", "The text of a pipeline is not valid YAML, or uses YAML that pipelines do not support.",
     "Correct the line given in the message.", ErrorKind::usage},
    {"W-CHECK", "An assertion with `severity: warn` failed.",
     "Examine the check. `severity: error` makes the failure an error."},
    {"W-NOTHING", "A pipeline writes no file, checks nothing and has no report, so running it has no effect.",
     "End it with `write` or `validate`, or give `--report`."},
    {"W-ONLY", "`only`, or a `foreach` over parts, selects no part.",
     "Use one of the names of parts that the message lists."},
    {"W-PLACEHOLDER",
     "The name of an output has a placeholder of other programs, such as `{input.stem}`, which facetmill "
     "keeps as text. It replaces only `${input.stem}`, or `@{input.stem}` in `facetmill pipe`.",
     "Write an expression with `$` (or `@`). Use `--quiet=W-PLACEHOLDER` if the name is intended."},
};

} // namespace facetmill
