#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages cells_messages{
    {"E-BUSY",
     "Another batch of this pipeline uses the same output folder, or another run uses the same folder of "
     "kept cells.",
     "Wait until it has ended, or name another folder with `--output-dir` or `--keep-cells`.",
     ErrorKind::output},
    {"E-CELLS",
     "The mesh is larger than the available memory, so facetmill processes it in cells on disk. A stage, an "
     "option or the file format needs the whole mesh in memory.",
     "Put `simplify` or `clip` before the stage, write binary PLY or STL, or give more `--memory`. See "
     "docs/large-meshes.md for the stages that work on cells.",
     ErrorKind::usage},
    {"E-CHANGED", "A file changed while facetmill was reading it a second time.",
     "Run again while no other program writes to the inputs.", ErrorKind::malformed},
    {"E-SCRATCH",
     "The disk is damaged, so temporary data of cells cannot be read back. Or a job of `--cells-job` finds "
     "no cells that match its inputs and options.",
     "Use another disk with `--scratch DIR`. Run the workflow again, because it makes the cells first.",
     ErrorKind::output},
};

} // namespace facetmill
