#include "support/catch.hpp"

#include "docs/man_markdown.hpp"
#include "docs/manual.hpp"

using namespace facetmill::docs;

TEST_CASE("a manual page is told in Markdown", "[docs]") {
    CHECK(
        markdown_of_man(".TH X 5\n.SH TOP KEYS\nIt is\n.BR \\-\\-depfile \" or \" \\(dqx\\(dq .\n.TP\n.BR "
                        "stages \" (needed)\"\n"
                        "The list\n.B of\nthem.\n.SH NEXT\n.nf\n.RS\n\\- a: 1\n.RE\n.fi\n.PP\nEnd\\fR.\n") ==
        "## TOP KEYS\n\nIt is\n`--depfile` or `\"x\"`.\n\n- `stages` (needed):\n  The list\n  `of`\n  "
        "them.\n\n## NEXT\n\n"
        "\n```yaml\n- a: 1\n```\n\n\nEnd.\n");
}

TEST_CASE("the page of pipeline files has no macros left in Markdown", "[docs]") {
    const std::string text = markdown_of_man(pipeline_man_page().text);
    CHECK(text.find("## BRANCH AND FOREACH") != text.npos);
    CHECK(text.find("\n.") == text.npos);
    CHECK(text.find('\\') == text.npos);
}
