#include "base/text/markup.hpp"

#include "support/catch.hpp"

using namespace facetmill;

TEST_CASE("escaped texts have only what XML can hold", "[base]") {
    const std::string bad = "\xEF\xBF\xBD";
    CHECK(escaped("a<b>&\"'") == "a&lt;b&gt;&amp;&quot;&#39;");
    CHECK(escaped("one\ttwo\nthree") == "one\ttwo\nthree");
    CHECK(escaped("\x01") == bad);
    CHECK(escaped("\xC3\xA4 \xE2\x82\xAC \xF0\x9F\x98\x80") == "\xC3\xA4 \xE2\x82\xAC \xF0\x9F\x98\x80");
    CHECK(escaped("a\xE4z") == "a" + bad + "z");                 // Latin-1
    CHECK(escaped("\xE2\x82") == bad + bad);                     // cut short
    CHECK(escaped("\xC0\xAF") == bad + bad);                     // spelled longer than needed
    CHECK(escaped("\xED\xA0\x80") == bad + bad + bad);           // a surrogate
    CHECK(escaped("\xF4\x90\x80\x80") == bad + bad + bad + bad); // beyond the last character
    CHECK(escaped("\xE4<") == bad + "&lt;"); // the following character is decoded separately
}

TEST_CASE("a text in Markdown has no markup", "[base]") {
    CHECK(markdown_escaped("a|b *c* _d_ `e` [f](g) <h>\ni\\j") ==
          "a\\|b \\*c\\* \\_d\\_ \\`e\\` \\[f\\](g) &lt;h&gt; i\\\\j");
}

TEST_CASE("a text for a terminal has no commands for it", "[base]") {
    CHECK(for_terminal("one\ttwo\nthree \xC3\xA4") == "one\ttwo\nthree \xC3\xA4");
    CHECK(for_terminal("\x1b[31mred\r\x7f") == "?[31mred??");
    CHECK(for_terminal("\xC2\x9b"
                       "31m\xC2\xA0") == "?31m\xC2\xA0"); // the same command in one character
    CHECK(for_terminal("a\xE4z") == "a?z");               // Latin-1
    CHECK(for_terminal("\xC2") == "?");                   // cut short
}
