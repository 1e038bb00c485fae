#include "io/footprint/dxf.hpp"

#include "base/math/numbers.hpp"
#include "base/text/spelling.hpp"
#include "io/text.hpp"

#include <cmath>
#include <fmt/format.h>

namespace facetmill::io {

namespace {

/// Metres of the values of $INSUNITS, from 1.
constexpr double metres_of_insunits[] = {0.0254,
                                         0.3048,
                                         1609.344,
                                         0.001,
                                         0.01,
                                         1,
                                         1000,
                                         2.54e-8,
                                         2.54e-5,
                                         0.9144,
                                         1e-10,
                                         1e-9,
                                         1e-6,
                                         0.1,
                                         10,
                                         100,
                                         1e9,
                                         149597870700.0,
                                         9460730472580800.0,
                                         3.0856775814913673e16,
                                         1200.0 / 3937,
                                         100.0 / 3937,
                                         3600.0 / 3937,
                                         6336000.0 / 3937};

class DxfParser {
  public:
    DxfParser(std::string_view text, const std::string& name) : text_(text, name, "E-DXF") {}

    DxfFile parse() {
        while (next())
            if (group_.code == 0)
                start();
            else
                field();
        end_entity();
        if (section_ == Section::entities) text_.fail("the file ends within the list of entities");
        return std::move(file_);
    }

  private:
    enum class Section { other, header, tables, blocks, entities };

    /// Reads the next group: a code and a value on separate lines.
    bool next() {
        if (text_.at_end()) return false;
        group_.code = text_.integer("a group code");
        if (!text_.next_line()) text_.fail("the file ends after a group code");
        group_.line = text_.line();
        group_.value = text_.rest_of_line();
        text_.next_line();
        return true;
    }

    void start() {
        end_entity();
        const std::string_view type = group_.value;
        if (type == "SECTION" || type == "ENDSEC" || type == "EOF") {
            section_ = Section::other;
            names_section_ = type == "SECTION";
        } else if (section_ == Section::tables) {
            is_layer_ = type == "LAYER";
        } else if (section_ == Section::blocks && type == "BLOCK") {
            begin_block();
        } else if (section_ == Section::blocks && type == "ENDBLK") {
            end_block();
        } else if (section_ == Section::entities || in_block_) {
            file_.entities.push_back({type, group_.line, file_.groups.size(), 0});
            in_entity_ = true;
        }
    }

    void field() {
        if (names_section_ && group_.code == 2) {
            begin_section();
        } else if (in_entity_) {
            file_.groups.push_back(group_);
        } else if (section_ == Section::header) {
            header();
        } else if (is_layer_) {
            layer();
        } else if (in_block_ && file_.entities.size() == block_.first) {
            if (group_.code == 2) block_name_ = lower_case(std::string(group_.value));
            if (group_.code == 10) block_.base.x = number();
            if (group_.code == 20) block_.base.y = number();
        }
    }

    void begin_section() {
        names_section_ = false;
        section_ = group_.value == "HEADER"     ? Section::header
                   : group_.value == "TABLES"   ? Section::tables
                   : group_.value == "BLOCKS"   ? Section::blocks
                   : group_.value == "ENTITIES" ? Section::entities
                                                : Section::other;
        if (section_ == Section::entities) file_.drawing.first = file_.entities.size();
    }

    void end_entity() {
        if (in_entity_) file_.entities.back().end = file_.groups.size();
        if (section_ == Section::entities) file_.drawing.end = file_.entities.size();
        in_entity_ = is_layer_ = false;
    }

    void begin_block() {
        in_block_ = true;
        block_name_.clear();
        block_ = {{}, file_.entities.size(), 0};
    }

    void end_block() {
        in_block_ = false;
        block_.end = file_.entities.size();
        file_.blocks[block_name_] = block_;
    }

    void header() {
        if (group_.code == 9) is_unit_ = group_.value == "$INSUNITS";
        if (!is_unit_ || group_.code != 70) return;
        const auto unit = parse_integer(group_.value).value_or(0);
        if (unit >= 1 && unit <= static_cast<std::int64_t>(std::size(metres_of_insunits)))
            file_.metres = metres_of_insunits[unit - 1];
    }

    void layer() {
        if (group_.code == 2) layer_ = lower_case(std::string(group_.value));
        const auto value =
            group_.code == 70 || group_.code == 62 ? parse_integer(group_.value) : std::nullopt;
        if (!value) return;
        // Bit 1 of 70: frozen. A negative colour: off.
        if (group_.code == 70 ? (*value & 1) != 0 : *value < 0) file_.hidden_layers.insert(layer_);
    }

    double number() const {
        const auto x = parse_real(group_.value);
        if (!x || !std::isfinite(*x))
            text_.fail(fmt::format("expected a number, found {}", in_quotes(group_.value)));
        return *x;
    }

    Text text_;
    DxfGroup group_;
    DxfFile file_;
    Section section_ = Section::other;
    bool names_section_ = false, in_entity_ = false, in_block_ = false, is_layer_ = false, is_unit_ = false;
    DxfBlock block_;
    std::string block_name_, layer_;
};

} // namespace

DxfFile parse_dxf(std::string_view text, const std::string& name) { return DxfParser(text, name).parse(); }

} // namespace facetmill::io
