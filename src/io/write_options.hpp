#pragma once
// The options of `write` that only some formats honour. Each is declared next to the codec that honours it.

#include "io/codec.hpp"
#include "options/declaration.hpp"

namespace facetmill::io {

/// ascii and big_endian.
void declare_encoding(Declare<WriteSettings>& d);
/// draco, quantize and meshopt.
void declare_compression(Declare<WriteSettings>& d);
void declare_tiles(Declare<WriteSettings>& d);
/// The order and layout of arrays, textures, names and levels of detail.
void declare_layout(Declare<WriteSettings>& d);

[[nodiscard]] WriteOption draco_option();
[[nodiscard]] WriteOption textures_option();
/// The options for a single mesh in glTF, which tiles honour too.
[[nodiscard]] std::vector<WriteOption> gltf_mesh_options();

/// Adds a group that is on if it is given, unless its value is false.
template <class G, class Fill>
OptionRef declare_switched(Declare<WriteSettings>& d, std::string_view name, G WriteSettings::*member,
                           std::string_view help, Fill fill) {
    OptionRef ref = d.group(name, member, help, fill);
    ref.option().parse = [member, parse = std::move(ref.option().parse)](const Option& self, const Value& v,
                                                                         void* target, Problems& problems) {
        G& group = static_cast<WriteSettings*>(target)->*member = G{};
        group.on = true;
        if constexpr (requires { group.given; }) group.given = true;
        return parse(self, v, target, problems);
    };
    return ref;
}

/// Lets true or false switch a group on or off.
template <class G>
void allow_truth(Declare<G>& d) {
    d.shorthand(ShortForm::truth, "true or false", {{"type", "boolean"}},
                [](const Value& v, G& out, Problems& problems) {
                    return OptionType<bool>::parse(v, out.on, problems);
                });
}

} // namespace facetmill::io
