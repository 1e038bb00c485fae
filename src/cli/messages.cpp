#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages cli_messages{
    {"E-COMMAND", "facetmill has no command with this name.", "Run `facetmill --help` to list the commands.",
     ErrorKind::usage},
    {"E-DEPFILE", "A path contains characters that the syntax of a depfile cannot express.",
     "Rename the file.", ErrorKind::output},
    {"E-EXISTS", "The file to be created already exists.", "Choose another name, or move the file away.",
     ErrorKind::usage},
    {"E-OPTION", "The command has no option with this name.",
     "Use the name that the message suggests, or run `facetmill COMMAND --help` to list all.",
     ErrorKind::usage},
    {"E-PIPE", "The one-liner cannot be parsed: stages, brackets or values do not match.",
     "Separate stages with `!` or `+`. See the examples of `facetmill pipe --help`.", ErrorKind::usage},
};

} // namespace facetmill
