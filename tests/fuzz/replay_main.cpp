#include "fuzz/fuzz.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

// Runs a target on the files of its corpus, in any compiler's build: what the fuzzer once found stays found.

namespace {

std::vector<std::uint8_t> contentOf(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

int main(int argumentCount, char** arguments) {
    isoglass::fuzz::require(argumentCount == 2, "one argument names the folder of the corpus");
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(arguments[1])) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    isoglass::fuzz::require(!files.empty(), "the corpus holds a file");
    for (const auto& file : files) {
        std::printf("%s\n", file.filename().c_str());
        std::fflush(stdout);
        isoglass::fuzz::run(contentOf(file));
    }
    return 0;
}
