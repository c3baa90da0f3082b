#include "report/speed_document.h"

#include "report/advice.h"
#include "report/error_orders.h"
#include "report/recommendation.h"
#include "report/setting_tables.h"
#include "report/speed_plots.h"
#include "report/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

namespace curvewall {
namespace {

// Of the views, which mostly share them.
std::string truthText(const SpeedReport& report) {
    int fewest = 0;
    double noisiest = 0;
    for (const ViewReport& view : report.views) {
        const bool isFirst = fewest == 0;
        fewest = isFirst ? view.truth.supersamples : std::min(fewest, view.truth.supersamples);
        noisiest = isFirst ? view.truth.noiseDb : std::min(noisiest, view.truth.noiseDb);
    }
    return fmt::format(
        "Supersampled PSNR: likeness to a picture of {} exact rays a pixel or more, whose own noise leaves "
        "it at {} dB or better. Beyond that, differences say nothing. It rewards blur, so that it decides "
        "nothing here.",
        fewest, decibelText(noisiest));
}

void addExplanation(std::vector<Block>& blocks, const SpeedReport& report) {
    blocks.emplace_back(Heading{2, "How to read it"});
    List words;
    const auto say = [&words](std::string text) { words.items.push_back(std::move(text)); };
    say("Geometric error: how many pixels away from its place a thing is shown. The largest of all pixels "
        "counts. Beside it stands what 99 pixels in 100 keep. It is measured on what was drawn: the "
        "rasterizer puts corners on a grid of 1/256 px, which may add 0.003 px and is allowed for.");
    say("Image error: the share of wrong pixels. They have a channel off by more than 8 of 255 from the "
        "truth, one exact ray through the centre of each pixel. PSNR and SSIM compare the same pictures. Of "
        "several samples a pixel the supersampled picture is the truth.");
    say("Wrong edges: the same with every surface in one flat colour. Nothing can be wrong there but where "
        "things are; textures and their filters are left out.");
    say("Coverage error: pixels that show nothing where the truth has something all around, or something "
        "where it has nothing; and in a closed room around the eye, pixels that show nothing, or the room "
        "twice. With pixels that show what is not on the display, and those without a number, these are the "
        "faulty pixels.");
    say("Floor of sampling: what stays wrong where the projection is exact, since drawn triangles filter "
        "textures in another way than traced rays. It is estimated in a few small flat windows, so that a "
        "method may come somewhat below.");
    say(truthText(report));
    say("Time: of one frame, warm: the median of several rounds, and the fastest and slowest round. Reading "
        "back and writing files are not in it.");
    say("Grey steps in a plot: the Pareto front. Nothing beats what lies on it in both time and error; the "
        "reference, which the others are judged by, takes no part.");
    blocks.emplace_back(std::move(words));
    blocks.emplace_back(
        Paragraph{fmt::format("Measured with `{}` on {}. Errors are the same wherever this driver runs; "
                              "times are those of this machine.",
                              report.glRenderer.empty() ? "no OpenGL" : report.glRenderer,
                              report.processor.empty() ? "an unnamed processor" : report.processor)});
}

Table floorTable(const ViewReport& view) {
    Table table{{"samples", "wrong pixels, %", "wrong edges, %", "PSNR, dB",
                 fmt::format("PSNR of {} rays, dB", view.truth.supersamples)},
                {}};
    for (const SamplingFloor& floor : view.floors)
        table.rows.push_back({std::to_string(floor.samples), percentText(floor.shareOff),
                              floor.samples == 1 ? percentText(floor.edgesOff) : "–",
                              decibelText(floor.psnrDb), decibelText(floor.supersampledPsnrDb)});
    return table;
}

void addOrders(std::vector<Block>& blocks, const ViewReport& view) {
    const std::vector<ErrorOrder> orders = errorOrders(view);
    if (orders.empty()) return;
    Table table{{"method", "error", "order", "expected", "points"}, {}};
    for (const ErrorOrder& order : orders)
        table.rows.push_back({"`" + order.curve + "`", order.error, fmt::format("{:.2f}", order.order),
                              fmt::format("{:g}", order.expected), std::to_string(order.points)});
    blocks.emplace_back(Heading{3, "How errors fall"});
    blocks.emplace_back(Paragraph{
        "An error of order 2 falls to a quarter when the knob is turned to half; of order -1 it doubles. "
        "Fitted to the points above the floor. Of wrong edges the floor is taken off first."});
    blocks.emplace_back(table);
}

void addFloor(std::vector<Block>& blocks, const ViewReport& view) {
    if (view.floors.empty()) return;
    blocks.emplace_back(Heading{3, "Floor of sampling"});
    blocks.emplace_back(Paragraph{
        "Of plain perspective pictures as dense as this display, where every method projects exactly."});
    blocks.emplace_back(floorTable(view));
}

std::string pictureText(const SettingResult& result) {
    return fmt::format("{}: {}, {} % wrong", settingText(result.setting),
                       pixelsText(result.errors.geometric.maxPx), percentText(result.errors.image.shareOff));
}

void addPictures(std::vector<Block>& blocks, const ViewReport& view) {
    PictureRow crops, maps;
    if (!view.truth.crop.empty()) crops.pictures.push_back({view.truth.crop, "The truth"});
    for (const SettingResult& result : view.settings) {
        if (!result.crop.empty()) crops.pictures.push_back({result.crop, pictureText(result)});
        if (!result.errorMap.empty())
            maps.pictures.push_back({result.errorMap, settingText(result.setting) + ": at most " +
                                                          pixelsText(result.errors.geometric.maxPx)});
    }
    if (!view.truth.picture.empty()) {
        blocks.emplace_back(Heading{3, "The picture"});
        blocks.emplace_back(PictureRow{{{view.truth.picture, "The truth: exact rays"}}});
    }
    if (!crops.pictures.empty()) {
        blocks.emplace_back(Heading{3, "Side by side"});
        blocks.emplace_back(
            Paragraph{"The same place in every picture, enlarged: where they differ most from the truth."});
        blocks.emplace_back(crops);
    }
    if (!maps.pictures.empty()) {
        blocks.emplace_back(Heading{3, "Error by pixel"});
        blocks.emplace_back(Paragraph{
            "The geometric error, darker where it is smaller. All maps have one scale. Grey shows nothing."});
        blocks.emplace_back(maps);
    }
}

void addRefusals(std::vector<Block>& blocks, const ViewReport& view) {
    List reasons;
    for (const SettingResult& result : view.settings) {
        if (result.refusal.empty()) continue;
        // One reason for all that a method's knob may be turned to.
        const std::string reason = fmt::format("`{}`: {}", result.setting.curve(), result.refusal);
        if (std::ranges::find(reasons.items, reason) == reasons.items.end()) reasons.items.push_back(reason);
    }
    if (reasons.items.empty()) return;
    blocks.emplace_back(Heading{3, "Not drawn"});
    blocks.emplace_back(std::move(reasons));
}

std::string fileStem(const ViewReport& view) {
    std::string stem = view.wall + "-" + view.display + "-" + view.scene;
    for (char& c : stem)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '-';
    return stem;
}

void addView(std::vector<Block>& blocks, const ViewReport& view, double tolerancePx,
             const std::string& stem) {
    blocks.emplace_back(Heading{2, viewName(view)});
    blocks.emplace_back(Paragraph{
        fmt::format("{} x {} pixels, projection `{}`.", view.sizePx.x, view.sizePx.y, view.projection)});
    for (Block& block : speedPlots(view, tolerancePx, "plots/" + stem)) blocks.push_back(std::move(block));
    addPictures(blocks, view);
    blocks.emplace_back(Heading{3, "All settings"});
    blocks.emplace_back(settingsTable(view, recommend(view, tolerancePx).best));
    if (Table stages = stagesTable(view); !stages.rows.empty()) {
        blocks.emplace_back(Heading{3, "Where the time goes"});
        blocks.emplace_back(Paragraph{"Milliseconds on the GPU by stage, medians of one measurement."});
        blocks.emplace_back(std::move(stages));
    }
    addOrders(blocks, view);
    addFloor(blocks, view);
    addRefusals(blocks, view);
}

}  // namespace

Document speedDocument(const SpeedReport& report) {
    Document document{"Speed against error", adviceOf(report)};
    addExplanation(document.blocks, report);
    std::vector<std::string> stems;
    for (const ViewReport& view : report.views) {
        std::string stem = fileStem(view);
        // Names that differ in other signs alone would share their files.
        if (const auto same = std::ranges::count(stems, stem)) stem += fmt::format("-{}", same + 1);
        stems.push_back(fileStem(view));
        addView(document.blocks, view, report.tolerancePx, stem);
    }
    return document;
}

}  // namespace curvewall
