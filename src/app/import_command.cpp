#include "app/commands.h"
#include "app/progress.h"
#include "app/text.h"
#include "base/error.h"

#include <fstream>
#include <iostream>
#include <string>

namespace isoglass {

namespace {

bool isPvm(const std::filesystem::path& file) {
    std::string magic(3, ' ');
    std::ifstream stream(file, std::ios::binary);
    stream.read(magic.data(), 3);
    return stream && magic == "PVM";
}

std::unique_ptr<FrameSource> openSource(const ImportCommand& command) {
    for (const auto& input : command.inputs) {
        if (!std::filesystem::exists(input)) throw Error("there is no such file", input.string());
        if (std::filesystem::is_directory(input)) {
            throw Error("this is a folder", input.string(), "name the files in it");
        }
    }
    if (isPvm(command.inputs.front())) return openPvm(command.inputs, command.options);
    if (command.inputs.size() > 1) {
        throw Error(
            "a NetCDF series is one file, but " + std::to_string(command.inputs.size()) + " were given",
            command.inputs[1].string(), "name one NetCDF file, or PVM files only");
    }
    return openNetcdf(command.inputs.front(), command.options);
}

}  // namespace

void runImport(const ImportCommand& command) {
    if (command.out.extension() != ".vdb") {
        throw Error("a series has the extension .vdb", command.out.string(), "name it so");
    }
    const auto source = openSource(command);
    if (!command.options.height.empty() && !source->description().lattice.heights) {
        throw Error("only NetCDF files have heights", "--height", "leave it out");
    }
    for (const std::string& note : source->description().notes) printNote(note);
    const auto frames = static_cast<std::int64_t>(source->description().time.times.size());
    SeriesDescription series;
    {
        Progress progress("importing", "key frames", frames);
        series = writeSeries(*source, command.out, command.sparsity, [&](std::size_t done, std::size_t) {
            progress.update(static_cast<std::int64_t>(done));
        });
    }
    std::cout << command.out.string() << ": " << series.name << ", " << frames << " key frames, "
              << formatBytes(std::filesystem::file_size(command.out)) << '\n';
}

}  // namespace isoglass
