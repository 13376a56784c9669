#include "app/commands.h"
#include "app/progress.h"
#include "app/text.h"
#include "base/error.h"
#include "formats/raw_export.h"

#include <iostream>

namespace isoglass {

void runExport(const ExportCommand& command) {
    if (command.out.extension() != ".json") {
        throw Error("samples are written as a description, .json, with a .raw beside it",
                    command.out.string(), "name it so");
    }
    const SeriesFile series(command.series);
    const auto frames = static_cast<std::int64_t>(series.description().time.times.size());
    {
        Progress progress("exporting", "key frames", frames);
        writeRaw(series, command.out,
                 [&](std::size_t done, std::size_t) { progress.update(static_cast<std::int64_t>(done)); });
    }
    std::filesystem::path samples = command.out;
    samples.replace_extension(".raw");
    std::cout << command.out.string() << ", " << samples.string() << ": " << series.description().name << ", "
              << frames << " key frames, " << formatBytes(std::filesystem::file_size(samples)) << '\n';
}

}  // namespace isoglass
