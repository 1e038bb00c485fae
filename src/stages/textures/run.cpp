#include "base/hash.hpp"
#include "base/progress.hpp"
#include "base/text/readable_numbers.hpp"
#include "io/images/ktx_workers.hpp"
#include "io/images/pixels.hpp"
#include "parallel/parallel.hpp"
#include "stages/textures/atlas.hpp"
#include "stages/textures/help.hpp"
#include "stages/textures/work.hpp"

#include <fmt/format.h>

namespace facetmill::textures_stage {

namespace {

struct ReportedImage {
    std::string image;
    std::vector<std::string> used_as;
    ImageState before, after;
    std::optional<std::string> kept;
};

struct TexturesReport {
    std::vector<ReportedImage> images;
    std::size_t resized = 0, converted = 0, repacked = 0, unchanged = 0, bytes_before = 0, bytes_after = 0;
    std::optional<AtlasesReport> atlas;
};

/// A set of images with equal bytes, in any documents.
struct Job {
    const io::DocumentImage* image = nullptr; ///< the first of these images
    ImageState before;
    io::ImageUse use;
    std::vector<std::pair<std::size_t, std::size_t>> places; ///< documents and their images
    ProcessedImage processed_image;
};

/// For each document, the materials of parts that the stage does not select.
std::vector<std::set<int>> held_materials(const Scene& scene, const Context& context) {
    std::vector<std::set<int>> held(scene.documents.size());
    for (const Part& part : scene.parts) {
        if (context.selects(part, scene)) continue;
        for (const Primitive& primitive : part.mesh.primitives) {
            if (primitive.material >= scene.materials.size()) continue;
            const Material& material = scene.materials[primitive.material];
            if (material.document >= 0)
                held[static_cast<std::size_t>(material.document)].insert(material.index);
        }
    }
    return held;
}

std::vector<std::vector<io::DocumentImage>> images_of(const Scene& scene, const Context& context) {
    const auto held = held_materials(scene, context);
    std::vector<std::vector<io::DocumentImage>> all;
    for (std::size_t d = 0; d < scene.documents.size(); ++d)
        all.push_back(io::document_images(*scene.documents[d], held[d]));
    return all;
}

std::vector<Job> jobs_of(const std::vector<std::vector<io::DocumentImage>>& images) {
    std::vector<Job> jobs;
    std::map<std::string, std::size_t> known; // index into jobs, by digest
    for (std::size_t d = 0; d < images.size(); ++d)
        for (const io::DocumentImage& image : images[d]) {
            // Images without bytes cannot be shared.
            const std::string key =
                image.bytes.empty() ? fmt::format("{} {}", d, image.index) : sha256(image.bytes);
            const auto [place, fresh] = known.try_emplace(key, jobs.size());
            if (fresh) jobs.push_back({&image, state_of(image.bytes), {}, {}, {}});
            Job& job = jobs[place->second];
            job.use.join(image.use);
            job.places.emplace_back(d, image.index);
        }
    return jobs;
}

/// Adds the image's name to an error of the KTX2 encoder.
Error about_image(const Error& error, const std::string& image) {
    const Diagnostic& first = error.diagnostics().front();
    if (first.id != "E-KTX") return error;
    const auto program = io::ktx_program();
    return {error.kind(), first.id,
            fmt::format("textures: for the image '{}' {} {}", image,
                        program ? program->filename().generic_string() : "ktx", first.message),
            first.hint.empty() ? "run facetmill explain E-KTX" : first.hint};
}

/// Processes several images at once. Their total is limited to the pixels of the largest allowed image,
/// which bounds the memory.
void work(std::vector<Job>& jobs, const TexturesOptions& o) {
    using io::max_pixels;
    for (std::size_t begin = 0; begin < jobs.size();) {
        std::size_t end = begin, pixels = 0;
        for (; end < jobs.size(); ++end) {
            const ImageState& state = jobs[end].before;
            const std::size_t more = std::min(state.width, max_pixels) * std::min(state.height, max_pixels);
            if (end > begin && pixels + more > max_pixels) break;
            pixels += more;
        }
        const auto all = static_cast<double>(jobs.size());
        const ProgressScope share(static_cast<double>(begin) / all, static_cast<double>(end) / all);
        ProgressScope::report_next_loop();
        parallel_for(
            end - begin,
            [&](std::size_t i) {
                Job& job = jobs[begin + i];
                try {
                    job.processed_image = processed_image(job.image->bytes, job.before, job.use, o);
                } catch (const Error& error) {
                    throw about_image(error, job.image->name);
                }
            },
            1);
        begin = end;
    }
}

void put_back(Scene& scene, const std::vector<Job>& jobs) {
    std::vector<std::map<std::size_t, io::Bytes>> replaced(scene.documents.size());
    for (const Job& job : jobs)
        for (const auto& [document, image] : job.places)
            if (!job.processed_image.bytes.empty()) replaced[document][image] = job.processed_image.bytes;
    for (std::size_t d = 0; d < replaced.size(); ++d)
        if (!replaced[d].empty()) scene.documents[d] = io::with_images(*scene.documents[d], replaced[d]);
}

void tell(const std::vector<Job>& jobs, Context& context, TexturesReport& report) {
    for (const Job& job : jobs) {
        const ProcessedImage& w = job.processed_image;
        const bool resized = w.before.width != w.after.width || w.before.height != w.after.height;
        const bool converted = w.before.format != w.after.format;
        report.resized += resized;
        report.converted += converted;
        report.repacked += !resized && !converted && !w.bytes.empty();
        report.unchanged += w.bytes.empty();
        report.bytes_before += w.before.bytes;
        report.bytes_after += w.after.bytes;
        report.images.push_back({job.image->name, job.use.textures, w.before, w.after,
                                 w.why.empty() ? std::nullopt : std::optional(w.why)});
        if (w.warn)
            context.warn("W-TEXTURE-KEPT",
                         fmt::format("textures: the image '{}' {}: {}", job.image->name,
                                     w.bytes.empty() ? "stays unchanged" : "keeps its format", w.why));
    }
}

void declare_state(DeclareFields<ImageState>& d) {
    d.field("format", &ImageState::format,
            "The format: png, jpeg, webp, avif, ktx2 or dds. Empty for others.");
    d.field("width", &ImageState::width, "0 if the image cannot be read.").unit("pixels");
    d.field("height", &ImageState::height, "0 if the image cannot be read.").unit("pixels");
    d.field("bytes", &ImageState::bytes, "The size of the file.").unit("bytes");
}

void declare_image(DeclareFields<ReportedImage>& d) {
    d.field("image", &ReportedImage::image,
            "The name of the image or its file, or its position in the document.");
    d.field("used_as", &ReportedImage::used_as, "The textures of materials that use the image.");
    d.object("before", &ReportedImage::before, "The image before.", declare_state);
    d.object("after", &ReportedImage::after, "The image after.", declare_state);
    d.field("kept", &ReportedImage::kept, "The reason why the image stays unchanged or keeps its format.")
        .only_when("the options asked for more");
}

std::string text_of(const ImageState& s) {
    if (s.bytes == 0) return "missing";
    const std::string size = s.width == 0 ? "" : fmt::format("{} x {} ", s.width, s.height);
    return fmt::format("{}{}, {}", size, s.format.empty() ? "unknown" : s.format, sized(s.bytes));
}

std::string line_of(const ReportedImage& image) {
    std::string line = image.image + ": " + text_of(image.before);
    if (image.before.bytes != image.after.bytes || image.before.format != image.after.format)
        line += " -> " + text_of(image.after);
    return image.kept && image.before.bytes > 0 ? line + " (" + *image.kept + ")" : line;
}

std::vector<std::string> lines_of(const TexturesReport& r) {
    constexpr std::size_t most = 20;
    std::vector<std::string> lines;
    if (r.atlas) lines = lines_of(*r.atlas);
    const std::size_t before = lines.size();
    for (const ReportedImage& image : r.images)
        if (lines.size() < before + most) lines.push_back(line_of(image));
    if (r.images.size() > most)
        lines.push_back(fmt::format("... and {} more, listed in the report", r.images.size() - most));
    if (r.images.empty()) return {"the scene has no images"};
    const std::string repacked = r.repacked > 0 ? fmt::format("{} repacked, ", r.repacked) : "";
    lines.push_back(fmt::format("{} resized, {} in another format, {}{} unchanged: {} -> {}", r.resized,
                                r.converted, repacked, r.unchanged, sized(r.bytes_before),
                                sized(r.bytes_after)));
    return lines;
}

void declare_report(DeclareFields<TexturesReport>& d) {
    d.list("images", &TexturesReport::images, "Each image. Equal images are listed once.", declare_image);
    d.field("resized", &TexturesReport::resized, "Images that became smaller.");
    d.field("converted", &TexturesReport::converted, "Images that got another format.");
    d.field("repacked", &TexturesReport::repacked, "Images that were repacked with the same pixels.");
    d.field("unchanged", &TexturesReport::unchanged, "Images that stayed byte for byte the same.");
    d.field("bytes_before", &TexturesReport::bytes_before, "The size of all images before.").unit("bytes");
    d.field("bytes_after", &TexturesReport::bytes_after, "The size of all images after.").unit("bytes");
    d.object("atlas", &TexturesReport::atlas, "Merged materials.", declare_atlases)
        .only_when("atlas is given");
    d.tell(lines_of);
}

Scene run(Scene scene, const TexturesOptions& o, Context& context, TexturesReport& report) {
    if (o.atlas) report.atlas = make_atlases(scene, o, context);
    const auto images = images_of(scene, context);
    std::vector<Job> jobs = jobs_of(images);
    work(jobs, o);
    put_back(scene, jobs);
    if (wants(o, Format::ktx2))
        context.mark_uncacheable(); // a different version of the program may write different bytes
    tell(jobs, context, report);
    return scene;
}

struct TexturesStage : StageOf<run> {
    void verify(const Value& given, Problems& problems) const override {
        verify_textures(o, given, problems);
    }
};

const RegisterStage registered = make_stage<TexturesStage>(
    {.name = "textures",
     .also_called = "ktx toktx webp avif atlas texture_atlas merge_materials",
     .about = help::textures::about,
     .details = help::textures::details,
     .examples = {"textures: 1024", "textures: {max_size: 2048, format: webp, quality: 75}",
                  "textures: {format: webp, normals: {lossless: true}}", "textures: {repack: true}",
                  "textures: {max_size: 1024, power_of_two: true, format: jpeg, data: {format: keep}}",
                  "textures: {atlas: true, max_size: 4096}"},
     .changes_images = true,
     .lines = LinesPolicy::work,
     .may_lose = MayLose::all}, // the stage moves no vertex, so nothing is compared
    declare_textures, declare_report);

} // namespace

} // namespace facetmill::textures_stage
