#include "stage/read_written.hpp"

#include "io/convert.hpp"

namespace facetmill {

Scene read_written(const WrittenScene& written, const Scene& like, Context& context) {
    io::ReadLog log;
    Scene scene =
        io::read_scene(context.outputs().staged(*written.file), {}, log, io::codec_named(written.format));
    if (scene.unit == Unit::unknown) scene.unit = written.unit;
    if (scene.up == UpAxis::unknown) scene.up = written.up;
    if (like.unit == Unit::unknown) scene.unit = Unit::unknown; // the file's was guessed
    if (like.up == UpAxis::unknown) scene.up = UpAxis::unknown;
    io::convert(scene, {like.unit, like.up});
    return scene;
}

} // namespace facetmill
