#include "mesh/attribute_changes.hpp"
#include "support/catch.hpp"

using namespace facetmill;

namespace {

using Kind = AttributeChange::Kind;

const AttributeChange kept_uv{"TEXCOORD_0", Domain::wedge, Kind::kept, ""};
const AttributeChange mixed_uv{"TEXCOORD_0", Domain::wedge, Kind::interpolated, "mixed at new elements"};
const AttributeChange lost_uv{"TEXCOORD_0", Domain::wedge, Kind::dropped, "no place for it"};
const AttributeChange kept_id{"id", Domain::face, Kind::kept, ""};
const AttributeChange vertex_id{"id", Domain::vertex, Kind::recomputed, "counted anew"};

} // namespace

TEST_CASE("attribute changes: operations side by side: once mixed is mixed", "[mesh]") {
    AttributeChanges all = {kept_uv, kept_id};
    merge_changes(all, {mixed_uv, vertex_id});
    CHECK(all == AttributeChanges{mixed_uv, kept_id, vertex_id}); // one name in two domains is two attributes
    merge_changes(all, {kept_uv});
    CHECK(all == AttributeChanges{mixed_uv, kept_id, vertex_id});
    merge_changes(all, {lost_uv});
    CHECK(all.front() == lost_uv); // the later one of two that changed it
}

TEST_CASE("attribute changes: in sequence, what the second step kept is as the first left it", "[mesh]") {
    CHECK(changes_in_sequence({mixed_uv, vertex_id}, {kept_uv, kept_id}) ==
          AttributeChanges{mixed_uv, kept_id});
    CHECK(changes_in_sequence({mixed_uv}, {lost_uv}) == AttributeChanges{lost_uv});
    CHECK(changes_in_sequence({}, {kept_uv}) == AttributeChanges{kept_uv});
}

TEST_CASE("attribute changes: kept ones, and one to forget", "[mesh]") {
    AttributeChanges all =
        kept_changes({{"id", Domain::face, Role::index, 1, false, std::vector<std::uint32_t>{}},
                      {"id", Domain::vertex, Role::index, 1, false, std::vector<std::uint32_t>{}},
                      {"TEXCOORD_0", Domain::wedge, Role::uv, 2, false, std::vector<float>{}}});
    REQUIRE(all.size() == 3);
    CHECK(all[0] == kept_id);
    CHECK(all[2] == kept_uv);
    forget_change(all, "id");
    CHECK(all == AttributeChanges{kept_uv});
}
