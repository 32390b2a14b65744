// taut compare: variants of one scene side by side, with a table and a picture.

#include "taut/report/compare.hpp"
#include "taut/cli/command.hpp"
#include "taut/cli/device_option.hpp"
#include "taut/cli/interrupt.hpp"
#include "taut/cli/numbers.hpp"
#include "taut/cli/output.hpp"
#include "taut/cli/run_result.hpp"
#include "taut/report/image.hpp"
#include "taut/report/picture.hpp"
#include "taut/runtime/base/atomic_file.hpp"
#include "taut/scene/settings.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

struct CompareCommand
{
    std::string scene, device;
    std::vector<std::string> variants, settings;
    fs::path folder;
    std::optional<std::uint32_t> frames;
    bool json = false, no_picture = false;
};

std::string trimmed(const std::string& text)
{
    const std::size_t first = text.find_first_not_of(' '), last = text.find_last_not_of(' ');
    return first == std::string::npos ? std::string() : text.substr(first, last - first + 1);
}

/// "label: key=value; key=value". The setting "device" names the device.
Variant read_variant(const CompareCommand& command, const std::string& text)
{
    const std::size_t colon = text.find(':');
    if (colon == std::string::npos)
        throw Error(ErrorCode::bad_input,
                    "--variant \"" + text + "\" has no label; write \"label: key=value; key=value\"");
    Variant variant;
    variant.label = trimmed(text.substr(0, colon));
    if (variant.label.empty())
        throw Error(ErrorCode::bad_input, "--variant \"" + text + "\" has an empty label");
    std::vector<std::string> settings = command.settings;
    std::string device = command.device;
    for (std::size_t at = colon + 1; at < text.size();)
    {
        const std::size_t end = std::min(text.find(';', at), text.size());
        const std::string setting = trimmed(text.substr(at, end - at));
        at = end + 1;
        if (setting.starts_with("device="))
            device = setting.substr(7);
        else if (!setting.empty())
            settings.push_back(setting);
    }
    variant.scene = resolve_file(command.scene, settings);
    variant.device = open_device(device);
    return variant;
}

std::uint64_t frames_of(const CompareCommand& command, const Scene& scene)
{
    if (command.frames)
        return *command.frames;
    return static_cast<std::uint64_t>(std::max(std::ceil(scene.duration / scene.timestep - 1e-6), 0.0));
}

/// The last frame of every variant that ran, labelled, under one camera, in lines. False: nothing can draw.
bool draw(const std::vector<Variant>& variants, const std::vector<CompareRow>& rows, double time,
          const fs::path& file)
{
    constexpr std::uint32_t kWidth = 400, kHeight = 400, kMostInARow = 5;
    constexpr glm::u8vec3 kInk{70, 76, 84};
    std::vector<PictureMoment> moments;
    for (const CompareRow& row : rows)
        if (row.refusal.empty())
            moments.push_back({time, row.positions});
    if (moments.empty())
        return false;
    try
    {
        const auto tiles = static_cast<std::uint32_t>(moments.size());
        const std::uint32_t lines = (tiles + kMostInARow - 1) / kMostInARow;
        const std::uint32_t columns = (tiles + lines - 1) / lines;
        Image sheet = make_image(kWidth * columns, kHeight * lines, {255, 255, 255});
        std::uint32_t tile = 0;
        for (std::size_t k = 0; k < rows.size(); ++k)
            if (rows[k].refusal.empty())
            {
                // Vertices may differ from variant to variant, so each has its own drawing of the scene.
                Pictures pictures(variants[k].scene);
                const Shot shot = frame_shot(variants[k].scene, moments, kWidth, kHeight);
                Image picture = pictures.draw(PictureMoment{time, rows[k].positions}, shot);
                label(picture, rows[k].label, 12, 12, 2, kInk);
                place(sheet, picture, tile % columns * kWidth, tile / columns * kHeight);
                ++tile;
            }
        write_png(file, sheet);
        return true;
    }
    catch (const Error& error)
    {
        if (error.code() == ErrorCode::io)
            throw;
        warn(std::string("no picture: ") + error.what());
        return false;
    }
}

Json to_json(const CompareRow& row)
{
    Json json = {{"label", row.label}, {"method", row.method}, {"executor", row.executor}};
    json["refusal"] = row.refusal;
    json["status"] = row.refusal.empty() ? to_string(row.report.status)
                     : row.interrupted   ? to_string(Status::interrupted)
                                         : "refused";
    json["interrupted"] = row.interrupted;
    json["step_ms"] = row.step_ms;
    json["worst_stretch"] = row.worst_stretch;
    json["worst_rms_stretch"] = row.worst_rms_stretch;
    json["max_stretch"] = row.report.max_stretch;
    json["rms_stretch"] = row.report.rms_stretch;
    if (row.report.volume.any)
    {
        json["volume_ratio"] = {{"min", row.smallest_volume}, {"mean", row.mean_volume},
                                {"final", row.report.volume.ratio}};
        json["inverted_elements"] = row.report.volume.inverted;
    }
    json["energy"] = row.report.kinetic_energy + row.report.potential_energy;
    json["highest_energy"] = row.highest_energy;
    json["primal_residual"] = known(row.residuals.primal);
    json["dual_residual"] = known(row.residuals.dual);
    json["difference"] = row.difference ? Json(*row.difference) : Json();
    json["series"] = series_json(row.series);
    return json;
}

int compare_variants(const CompareCommand& command)
{
    if (command.variants.empty())
        throw Error(ErrorCode::bad_input,
                    "--variant is missing; write --variant \"label: key=value\", once a variant");
    std::vector<Variant> variants;
    for (const std::string& text : command.variants)
    {
        Variant next = read_variant(command, text);
        for (const Variant& other : variants)
            if (other.label == next.label)
                throw Error(ErrorCode::bad_input,
                            "two --variant are called \"" + next.label + "\"; labels tell rows apart");
        variants.push_back(std::move(next));
    }
    const std::uint64_t frames = frames_of(command, variants.front().scene);
    if (!command.folder.empty())
        make_folder(command.folder); // before minutes of work
    const InterruptGuard guard;
    const std::vector<CompareRow> rows = compare(variants, frames, [&] { return !guard.interrupted(); });
    Json json = {{"scene", command.scene}, {"frames", frames}, {"variants", Json::array()}};
    bool ran = false;
    for (const CompareRow& row : rows)
    {
        json["variants"].push_back(to_json(row));
        ran = ran || (row.refusal.empty() && sound(row.report.status));
    }
    if (!command.folder.empty())
    {
        write_file(command.folder / "compare.csv", compare_csv(rows));
        write_file(command.folder / "compare_series.csv", compare_series_csv(rows));
        write_svg(command.folder / "compare_series.svg",
                  compare_series_plot(fs::path(command.scene).stem().string(), rows));
        write_file(command.folder / "compare.md", compare_markdown(rows));
        write_file(command.folder / "compare.json", to_text(json));
        if (!command.no_picture)
            draw(variants, rows, static_cast<double>(frames) * variants.front().scene.timestep,
                 command.folder / "compare.png");
    }
    std::cout << (command.json ? to_text(json) : compare_markdown(rows));
    return ran ? kDone : kNotSound;
}

} // namespace

void add_compare(CLI::App& app, Command& chosen)
{
    CLI::App* command = app.add_subcommand("compare", "Run variants of one scene side by side");
    const auto options = std::make_shared<CompareCommand>();
    command->add_option("scene", options->scene, "Scene file (JSON)")->required();
    command->add_option(
        "--variant", options->variants,
        "\"label: method.type=acad; method.substeps=20\", once a variant; device=D names its device");
    command->add_option("--set", options->settings, "A value of the scene for all variants: gravity=[0,0,0]");
    add_device_option(*command, options->device);
    add_costs_option(*command);
    command->add_option("--frames", options->frames, "Time steps to run (default: the scene's duration)")
        ->check(whole_number(0));
    command->add_option("--out", options->folder,
                        "Folder for compare.csv, .md, .json and .png, compare_series.csv and .svg");
    command->add_flag("--no-picture", options->no_picture, "Draw no picture");
    command->add_flag("--json", options->json, "Print one JSON object");
    command->callback([&chosen, options] { chosen = [options] { return compare_variants(*options); }; });
}

} // namespace taut::cli
