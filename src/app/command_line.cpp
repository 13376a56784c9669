#include "app/command_line.h"

#include "app/commands.h"
#include "app/import_formats.h"
#include "app/stop_signal.h"
#include "app/view/controls.h"
#include "base/error.h"
#include "scene/transparency.h"

#include <CLI/CLI.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <exception>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace isoglass {

namespace {

constexpr int kFailure = 1;
constexpr int kWrongUsage = 2;

/// Splits "A<separator>B"; CLI11 turns the exception into a usage error that names the option.
std::pair<std::string, std::string> splitPair(const std::string& text, char separator,
                                              const std::string& form) {
    const std::size_t place = text.find(separator);
    if (place == std::string::npos) throw CLI::ValidationError("'" + text + "' does not read " + form);
    return {text.substr(0, place), text.substr(place + 1)};
}

template <typename Number>
Number number(const std::string& text, const std::string& form) {
    Number value{};
    if (!CLI::detail::lexical_cast(text, value))
        throw CLI::ValidationError("'" + text + "' does not read " + form);
    return value;
}

glm::ivec2 imageSize(const std::string& text) {
    const auto [width, height] = splitPair(text, 'x', "WxH");
    return {number<int>(width, "WxH"), number<int>(height, "WxH")};
}

void addImport(CLI::App& app, std::function<void()>& run) {
    auto command = std::make_shared<ImportCommand>();
    CLI::App* verb = app.add_subcommand("import", "Turn a foreign series into one of IsoGlass");
    verb->footer(listImportFormats());
    verb->add_option(
            "INPUT", command->inputs,
            "One file, or several of one format, a key frame each, in the order of the numbers in their "
            "names; with --times in the order given")
        ->required();
    verb->add_option("-o,--output", command->out, "The series to write (.vdb)")->required();
    verb->add_option("--variable", command->options.variable,
                     "The variable to read, or a formula of several, such as 'speed = sqrt(U^2 + V^2)'");
    verb->add_option("--height", command->options.height,
                     "Variable or formula of the samples' world z, such as '(PH + PHB) / 9.81'");
    CLI::Option* times = verb->add_option("--times", command->options.times,
                                          "Times of the key frames, instead of the source's")
                             ->delimiter(',');
    verb->add_flag("--time-from-name", command->timeFromName,
                   "The number that tells the files' names apart is the time of each")
        ->excludes(times);
    verb->add_flag("!--no-levels", command->sparsity.levels,
                   "Leave out the coarser levels, which help where the disk is slow: the file gets smaller");
    verb->add_option("--tolerance", command->sparsity.tolerance,
                     "Largest change of a sample that may make the series sparser")
        ->check(CLI::NonNegativeNumber);
    verb->add_option_function<std::string>(
        "--keep",
        [command](const std::string& text) {
            const auto [low, high] = splitPair(text, ':', "LO:HI");
            command->sparsity.keep = ValueRange{number<float>(low, "LO:HI"), number<float>(high, "LO:HI")};
            if (!(command->sparsity.keep->min <= command->sparsity.keep->max)) {
                throw CLI::ValidationError("--keep: LO must not be above HI");
            }
        },
        "Keep what surfaces with iso-values from LO to HI need, and no more");
    verb->callback([command, &run] { run = [command] { runImport(*command); }; });
}

void addExport(CLI::App& app, std::function<void()>& run) {
    auto command = std::make_shared<ExportCommand>();
    CLI::App* verb = app.add_subcommand("export", "Write a series as plain numbers with a JSON description");
    verb->add_option("SERIES", command->series, "Series of IsoGlass (.vdb)")->required();
    verb->add_option("-o,--output", command->out,
                     "The description (.json); the samples go into a .raw beside it")
        ->required();
    verb->callback([command, &run] { run = [command] { runExport(*command); }; });
}

void addInfo(CLI::App& app, std::function<void()>& run) {
    auto command = std::make_shared<InfoCommand>();
    CLI::App* verb = app.add_subcommand("info", "Describe series: sizes, times, units, range, memory");
    verb->add_option("SERIES", command->series, "Series of IsoGlass (.vdb)")->required();
    verb->add_flag("--json", command->json, "Print JSON");
    verb->callback([command, &run] { run = [command] { runInfo(*command); }; });
}

constexpr const char* kShowLevels = "Colour the surfaces by the level of detail of their cells";

void addRender(CLI::App& app, const CommonOptions& common, std::function<void()>& run) {
    auto command = std::make_shared<RenderCommand>();
    CLI::App* verb = app.add_subcommand("render", "Render a scene to pictures or a video, without a window");
    verb->add_option("SCENE", command->scene, "Scene file (.json)")->required();
    verb->add_option("-o,--output", command->out, "still.png, frame-{frame}.png or film.mp4")->required();
    verb->add_option_function<std::string>(
        "--frames",
        [command](const std::string& text) {
            const auto [first, last] = splitPair(text, ':', "A:B");
            command->frames =
                FrameRange{number<std::int64_t>(first, "A:B"), number<std::int64_t>(last, "A:B")};
        },
        "Frames A to B, from 0, both included");
    verb->add_option_function<std::string>(
        "--size", [command](const std::string& text) { command->size = imageSize(text); },
        "Size of the image, WxH pixels");
    const auto names = transparencyMethodNames();
    verb->add_option_function<std::string>(
            "--method",
            [command](const std::string& name) { command->method = transparencyMethodNamed(name); },
            "Composition: auto, 2-pass, 3-pass, 4-pass, peel or exact")
        ->check(CLI::IsMember(std::vector<std::string>(names.begin(), names.end())));
    verb->add_flag("--show-levels", command->showLevels, kShowLevels);
    verb->callback([command, &common, &run] { run = [command, &common] { runRender(*command, common); }; });
}

void addView(CLI::App& app, const CommonOptions& common, std::function<void()>& run) {
    auto command = std::make_shared<ViewCommand>();
    CLI::App* verb = app.add_subcommand("view", "Show a scene, a series or a mesh in a window");
    verb->add_option("SCENE", command->file,
                     "Scene file (.json), a series of IsoGlass (.vdb), or a mesh (.ply, .obj, .stl, .off)")
        ->required();
    verb->add_option_function<std::string>(
        "--size", [command](const std::string& text) { command->size = imageSize(text); },
        "Size of the window, WxH; default: that of the scene's image");
    verb->add_flag("--show-levels", command->showLevels, kShowLevels);
    verb->footer("In the window:\n" + std::string(viewerHelp()));
    verb->callback([command, &common, &run] { run = [command, &common] { runView(*command, common); }; });
}

void addMeshView(CLI::App& verb, const std::shared_ptr<MeshCommand>& command) {
    CLI::Option* eye = verb.add_option_function<std::vector<double>>(
        "--eye",
        [command](const std::vector<double>& at) {
            command->eye = glm::dvec3(at[0], at[1], at[2]);
            if (!std::isfinite(glm::dot(*command->eye, *command->eye)))
                throw CLI::ValidationError("--eye: a coordinate is not finite");
        },
        "Where the mesh will be seen from, in any direction: x,y,z in the series' coordinates");
    eye->delimiter(',')->expected(3);
    CLI::Option* pixels = verb.add_option("--pixels", command->cellPixels,
                                          "With --eye: size of a cell on the screen, in pixels");
    pixels->check(CLI::PositiveNumber);
    CLI::Option* error = verb.add_option(
        "--error-pixels", command->errorPixels,
        "With --eye, instead of --pixels: displacement of the surface on the screen, in pixels; the "
        "data choose the size of the cells");
    error->check(CLI::PositiveNumber)->excludes(pixels);
    CLI::Option* size = verb.add_option_function<std::string>(
        "--size",
        [command](const std::string& text) {
            command->size = imageSize(text);
            if (command->size.x <= 0 || command->size.y <= 0)
                throw CLI::ValidationError("--size: an image has at least one pixel");
        },
        "With --eye: size of the image, WxH pixels");
    CLI::Option* fov = verb.add_option("--fov", command->fovDegrees,
                                       "With --eye: vertical angle of view in degrees; default: 30");
    fov->check(CLI::Range(1e-3, 179.0));
    eye->needs(size);
    for (CLI::Option* option : {pixels, error, size, fov}) option->needs(eye);
}

void addMesh(CLI::App& app, const CommonOptions& common, std::function<void()>& run) {
    auto command = std::make_shared<MeshCommand>();
    CLI::App* verb = app.add_subcommand(
        "mesh", "Write one iso-surface to a mesh file, at full resolution or as fine as a view needs");
    verb->add_option("SERIES", command->series, "Series of IsoGlass (.vdb)")->required();
    verb->add_option("--iso", command->iso, "Iso-value")->required();
    CLI::Option* time = verb->add_option("--time", command->time,
                                         "Time in the series' own units; default: the first key frame");
    verb->add_option("-o,--output", command->out, "Mesh file: .ply, .obj, .stl or .off; with --series: .csv")
        ->required();
    CLI::Option* series =
        verb->add_flag("--series", command->wholeSeries,
                       "Instead of a mesh write a table (CSV) of its area, enclosed volume, "
                       "components and Euler number over time")
            ->excludes(time);
    verb->add_option("--steps", command->steps, "With --series: moments from one key frame to the next")
        ->check(CLI::Range(1, 1'000'000))
        ->needs(series);
    verb->add_flag("--below", command->insideIsBelow, "The inside is where the field is below the iso-value");
    addMeshView(*verb, command);
    verb->callback([command, &common, &run] {
        if (command->eye && !(command->cellPixels > 0 || command->errorPixels > 0))
            throw CLI::ValidationError("--eye: add --pixels or --error-pixels, how fine the mesh has to be");
        run = [command, &common] { runMesh(*command, common); };
    });
}

void addValidate(CLI::App& app, std::function<void()>& run, int& status) {
    auto command = std::make_shared<ValidateCommand>();
    CLI::App* verb = app.add_subcommand(
        "validate",
        "Say what is wrong with a scene and its series, or with a series: all of it, and where; reads every "
        "key frame");
    verb->add_option("FILE", command->file, "Scene file (.json) or series (.vdb)")->required();
    verb->add_flag("--json", command->json, "Print JSON");
    verb->callback([command, &run, &status] {
        run = [command, &status] { status = runValidate(*command) ? 0 : kFailure; };
    });
}

void addPlan(CLI::App& app, const CommonOptions& common, std::function<void()>& run) {
    auto command = std::make_shared<PlanCommand>();
    CLI::App* verb =
        app.add_subcommand("plan", "Say what the first frame of the scene takes, how long, and why");
    verb->add_option("SCENE", command->scene, "Scene file (.json)")->required();
    verb->add_flag("--json", command->json, "Print JSON");
    verb->callback([command, &common, &run] { run = [command, &common] { runPlan(*command, common); }; });
}

void addBench(CLI::App& app, const CommonOptions& common, std::function<void()>& run) {
    auto command = std::make_shared<BenchCommand>();
    CLI::App* verb = app.add_subcommand("bench", "Run the benchmarks");
    verb->add_option("NAME", command->names, "Run those whose name contains one of these");
    verb->add_flag("--json", command->json, "Print a line of JSON for each");
    verb->add_option("--repetitions", command->repetitions, "Runs that the median is taken of")
        ->check(CLI::PositiveNumber);
    verb->callback([command, &common, &run] { run = [command, &common] { runBench(*command, common); }; });
}

/// CLI11 escapes nothing and ends its messages without a full stop, so they fit one line.
int reportUsage(const CLI::App& app, const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app.exit(error);
    // CLI11 misses the command before it looks at what stands there instead.
    const std::vector<std::string> rest = app.remaining();
    const bool unknownCommand = app.get_subcommands().empty() && !rest.empty();
    const std::string what = unknownCommand ? "there is no command '" + rest.front() + "'" : error.what();
    std::cerr << "isoglass: error: " << what << " (command line)\n"
              << "Run 'isoglass --help' or 'isoglass COMMAND --help'.\n";
    return kWrongUsage;
}

}  // namespace

int runCommandLine(int argc, char** argv) {
    CLI::App app("IsoGlass plays 4D scalar time series as iso-surfaces.", "isoglass");
    CommonOptions common;
    std::function<void()> run;
    int status = 0;
    app.set_version_flag("--version", "isoglass " ISOGLASS_VERSION);
    app.require_subcommand(1);
    app.fallthrough();
    app.add_option("--threads", common.threads, "Threads for the inner loops; default: all cores")
        ->check(CLI::Range(1, 1024));
    app.add_option("--memory", common.memoryBytes, "Budget for key frames, such as 500MB or 2GB")
        ->transform(CLI::AsSizeValue(false));
    addImport(app, run);
    addExport(app, run);
    addInfo(app, run);
    addRender(app, common, run);
    addView(app, common, run);
    addMesh(app, common, run);
    addValidate(app, run, status);
    addPlan(app, common, run);
    addBench(app, common, run);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return reportUsage(app, error);
    }
    installStopSignals();
    try {
        run();
        if (!std::cout.flush()) throw Error("cannot write what was asked for", "standard output");
    } catch (const Stopped& stopped) {
        const std::string kept = stopped.what();
        std::cerr << "isoglass: stopped" << (kept.empty() ? "" : ": " + kept) << std::endl;
        endByStopSignal();
    } catch (const std::exception& error) {
        std::cerr << "isoglass: error: " << error.what() << '\n';
        return kFailure;
    }
    return status;
}

}  // namespace isoglass
