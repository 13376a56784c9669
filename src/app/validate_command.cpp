#include "app/commands.h"
#include "app/problems.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <iostream>

namespace isoglass {

namespace {

using Json = nlohmann::ordered_json;

/// By its extension, or by its first bytes: everything else is read as a scene.
bool isSeries(const std::filesystem::path& file) {
    if (file.extension() == ".vdb") return true;
    std::array<char, 4> start{};
    std::ifstream stream(file, std::ios::binary);
    return stream.read(start.data(), start.size()) && std::string_view(start.data(), 4) == " BDV";
}

const char* severityName(Problem::Severity severity) {
    return severity == Problem::Severity::error ? "error" : "warning";
}

void printJson(const ValidateCommand& command, bool series, bool valid,
               const std::vector<Problem>& problems) {
    Json list = Json::array();
    for (const Problem& problem : problems) {
        list.push_back({{"severity", severityName(problem.severity)},
                        {"what", problem.what},
                        {"file", problem.file},
                        {"pointer", problem.pointer},
                        {"place", problem.place},
                        {"hint", problem.hint}});
    }
    const Json json = {{"file", command.file.string()},
                       {"kind", series ? "series" : "scene"},
                       {"valid", valid},
                       {"problems", list}};
    // Names of files need not be UTF-8.
    std::cout << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

void printText(const Problem& problem) {
    std::cerr << "isoglass: " << severityName(problem.severity) << ": " << problem.what << " ("
              << problem.file;
    for (const std::string& more : {problem.pointer, problem.place}) {
        if (!more.empty()) std::cerr << ", " << more;
    }
    std::cerr << ')' << (problem.hint.empty() ? "" : "; " + problem.hint) << '\n';
}

std::string countText(std::ptrdiff_t count, const std::string& noun) {
    return std::to_string(count) + ' ' + noun + (count == 1 ? "" : "s");
}

}  // namespace

bool runValidate(const ValidateCommand& command) {
    const bool series = isSeries(command.file);
    const std::vector<Problem> problems =
        series ? problemsOfSeries(command.file) : problemsOfScene(command.file);
    const auto errors = std::ranges::count(problems, Problem::Severity::error, &Problem::severity);
    const auto warnings = static_cast<std::ptrdiff_t>(problems.size()) - errors;
    if (command.json) {
        printJson(command, series, errors == 0, problems);
        return errors == 0;
    }
    for (const Problem& problem : problems) printText(problem);
    std::cout << command.file.string() << ": "
              << (errors == 0 ? std::string("a valid ") + (series ? "series" : "scene")
                              : countText(errors, "error"));
    if (warnings > 0) std::cout << ", " << countText(warnings, "warning");
    std::cout << '\n';
    return errors == 0;
}

}  // namespace isoglass
