#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages batch_messages{
    {"E-ARCHIVE",
     "A file in an archive has a name that leads out of the archive's folder, or that occurs twice. Or an "
     "output "
     "to pack is outside the output folder.",
     "Make the archive again from inside its folder, with relative names. Write outputs below the output "
     "folder.",
     {ErrorKind::malformed, ErrorKind::output}},
    {"E-TABLE",
     "A table of params for a batch cannot be read. A row has too few or too many cells, a quote is not "
     "closed, or a column name is missing or repeated. Or a feature of a GeoJSON is not a polygon.",
     "Correct the row given in the message. Start a CSV file with a line of param names, or write YAML as a "
     "list of maps.",
     ErrorKind::malformed},
    {"W-PRUNE",
     "A batch with `--prune` kept outputs that it might have removed. Assets failed or did not run, so their "
     "outputs are unknown, or the inputs cannot be reached.",
     "Repair or leave out the assets that fail, mount the missing disk, and run the batch again."},
    {"W-STATE",
     "A batch cannot record in the output folder which assets are done, so the next batch will process them "
     "again.",
     "Free some space on the disk. The outputs themselves are complete."},
};

} // namespace facetmill
