#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages report_messages{
    {"E-REPORT", "The suffix of a report is not a known report format.",
     "Use .json, .html, .md, .xml (JUnit) or .txt.", ErrorKind::usage},
};

} // namespace facetmill
