#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages outputs_messages{
    {"E-DUPLICATE-OUTPUT",
     "Two stages, reports, pipelines or assets of a batch write the same file. Names that differ only in "
     "case count as equal.",
     "Give each file its own name. In a `foreach`, use the index of the variable: `${lod.index}`.",
     {ErrorKind::usage, ErrorKind::output}},
    {"E-OVERWRITE",
     "An output would overwrite an input.",
     "Give the output another name, or write elsewhere with `--output-dir`.",
     {ErrorKind::usage, ErrorKind::output}},
    {"E-SPACE", "The disk has no space left for the output.",
     "Free some space, or write to another path. For `run`, `batch` and `pipe`, you can also give another "
     "`--output-dir`.",
     ErrorKind::output},
    {"E-WRITE", "facetmill cannot write a file or standard output.",
     "Check the permissions and the disk, or write to another path. For `run`, `batch` and `pipe`, you can "
     "also give another `--output-dir`.",
     ErrorKind::output},
};

} // namespace facetmill
