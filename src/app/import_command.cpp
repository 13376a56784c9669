#include "app/commands.h"
#include "app/import_formats.h"
#include "app/progress.h"
#include "app/text.h"
#include "base/error.h"
#include "formats/file_names.h"

#include <algorithm>
#include <iostream>
#include <numeric>
#include <string>

namespace isoglass {

namespace {

void requireFiles(const std::vector<std::filesystem::path>& inputs) {
    for (const auto& input : inputs) {
        if (!std::filesystem::exists(input)) throw Error("there is no such file", input.string());
        if (std::filesystem::is_directory(input)) {
            throw Error("this is a folder", input.string(), "name the files in it");
        }
    }
}

/// Puts the files in the order of the numbers in their names, which become the times.
void takeTimesFromNames(std::vector<std::filesystem::path>& files, ImportOptions& options) {
    const std::vector<double> numbers = numbersInNames(files);
    std::vector<std::size_t> order(files.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return numbers[i]; });
    std::vector<std::filesystem::path> sorted;
    options.times.clear();
    for (const std::size_t i : order) {
        sorted.push_back(files[i]);
        options.times.push_back(numbers[i]);
    }
    files = std::move(sorted);
}

std::unique_ptr<FrameSource> openSource(const ImportCommand& command) {
    requireFiles(command.inputs);
    std::vector<std::filesystem::path> files = command.inputs;
    ImportOptions options = command.options;
    if (command.timeFromName) {
        takeTimesFromNames(files, options);
    } else if (options.times.empty() && !std::ranges::is_sorted(files, naturalLess)) {
        // The shell gives "t10" before "t2". Times on the command line belong to the order given there.
        std::ranges::sort(files, naturalLess);
        printNote("the files were put in the order of their names: " + files.front().string() + " to " +
                  files.back().string());
    }
    const ImportFormat& format = findImportFormat(files.front());
    if (!options.height.empty() && !format.takesHeights)
        throw Error(std::string(format.name) + " files have no heights", "--height " + options.height,
                    "leave it out: only variables of NetCDF files can be heights");
    return format.open(files, options);
}

}  // namespace

void runImport(const ImportCommand& command) {
    if (command.out.extension() != ".vdb") {
        throw Error("a series has the extension .vdb", command.out.string(), "name it so");
    }
    const auto source = openSource(command);
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
